"""The folders of the page; each is one file, and one more line here."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tissu.live_view.panels.cost import CostPanel
from tissu.live_view.panels.look import LookPanel
from tissu.live_view.panels.panel import Panel
from tissu.live_view.panels.parameters import ParametersPanel
from tissu.live_view.panels.record import RecordPanel
from tissu.live_view.panels.run import RunPanel
from tissu.live_view.panels.touch import TouchPanel

if TYPE_CHECKING:
    import viser

    from tissu.live_view.session import Session

FIRST: tuple[type[Panel], ...] = (RunPanel, TouchPanel)
OTHERS: tuple[type[Panel], ...] = (ParametersPanel, LookPanel, CostPanel, RecordPanel)

__all__ = ["Panel", "panels_of"]


def panels_of(gui: viser.GuiApi, session: Session) -> list[Panel]:
    """All folders of a page in their order; trocars have theirs where the simulations have any."""
    kinds = list(FIRST)
    if session.trocars is not None:
        from tissu.live_view.trocars.panel import TrocarsPanel

        kinds.append(TrocarsPanel)
    return [kind(gui, session) for kind in (*kinds, *OTHERS)]
