"""What can be done with a pointer; a tool is one file, and one more line here."""

from tissu.live_view.tools.cut import Cut
from tissu.live_view.tools.drag import Drag
from tissu.live_view.tools.instrument import MoveInstrument
from tissu.live_view.tools.lead import Lead
from tissu.live_view.tools.obstacle import MoveObstacle
from tissu.live_view.tools.remove import Remove
from tissu.live_view.tools.tool import Number, Tool

TOOLS: tuple[type[Tool], ...] = (
    Drag,
    Lead,
    MoveObstacle,
    MoveInstrument,
    Cut,
    Remove,
)

__all__ = ["TOOLS", "Number", "Tool"]
