"""What each effect costs, what the scene switches on, and what is absent."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tissu.live_view.panels.panel import Panel, table, text

if TYPE_CHECKING:
    import viser

    from tissu.live_view.frame import Frame
    from tissu.live_view.session import Session


class CostPanel(Panel):
    """Milliseconds of each effect, live; effects and what is absent."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Add the widgets to the page."""
        plans = [simulation.plan() for simulation in session.runner.simulations]
        with gui.add_folder("Cost"):
            self._tables = [gui.add_html("") for _ in plans]
        with gui.add_folder("Effects", expand_by_default=False):
            for plan in plans:
                gui.add_html(text(*(str(effect) for effect in plan.effects)))
                gui.add_html(text("absent: " + ", ".join(plan.absent), colour="#777"))

    def show(self, frame: Frame) -> None:
        """The tables."""
        for html, profile in zip(self._tables, frame.profiles, strict=True):
            rows = [
                (f"{row.effect}: {row.stage}", f"{row.ms_per_step:.3f}", f"{100 * row.share:.0f} %")
                for row in profile.rows
            ]
            html.content = table(("effect", "ms a step", "share"), rows)
