"""The folders of the page; each is one file, and one more line here."""

from tissu.live_view.panels.cost import CostPanel
from tissu.live_view.panels.look import LookPanel
from tissu.live_view.panels.panel import Panel
from tissu.live_view.panels.parameters import ParametersPanel
from tissu.live_view.panels.record import RecordPanel
from tissu.live_view.panels.run import RunPanel
from tissu.live_view.panels.touch import TouchPanel

PANELS: tuple[type[Panel], ...] = (
    RunPanel,
    TouchPanel,
    ParametersPanel,
    LookPanel,
    CostPanel,
    RecordPanel,
)

__all__ = ["PANELS", "Panel"]
