"""What can be switched on beside the bodies; a layer is one file, and one more line here."""

from tissu.live_view.layers.contacts import CONTACTS
from tissu.live_view.layers.fixed import FIXED, LED
from tissu.live_view.layers.frames import FRAMES
from tissu.live_view.layers.grabs import GRABS
from tissu.live_view.layers.instruments import INSTRUMENTS
from tissu.live_view.layers.layer import Layer
from tissu.live_view.layers.loads import LOADS
from tissu.live_view.layers.obstacles import OBSTACLES
from tissu.live_view.layers.tissue import TISSUE

LAYERS: tuple[Layer, ...] = (
    *(FIXED, LED, LOADS, GRABS),
    *(OBSTACLES, INSTRUMENTS, CONTACTS),
    *(TISSUE, FRAMES),
)

__all__ = ["LAYERS", "Layer"]
