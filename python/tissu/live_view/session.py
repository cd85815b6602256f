"""What the parts of a page share: the simulations' thread, the tools, and what is shown."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    import viser

    from tissu.live_view.frame import FrameTaker
    from tissu.live_view.recorder import Recorder
    from tissu.live_view.rights import Rights
    from tissu.live_view.runner import Runner
    from tissu.live_view.stage import Stage
    from tissu.live_view.touch import Touch
    from tissu.live_view.trocars.trocars import LiveTrocars
    from tissu.live_view.undo import Undo
    from tissu.simulation import Simulation

T = TypeVar("T")

_SPARE = 0.25
"""Of the time in which the simulation waits for its pace, that a kind of work may take."""


@dataclass(slots=True)
class Session:
    """One view.

    Attributes:
        runner: the thread that owns the simulations.
        taker: of frames, in that thread.
        touch: the tools.
        rights: which page may touch.
        stage: where things stand on the page.
        recorder: of what the page shows.
        begin_again: puts the simulations back to their beginning.
        undo: puts them back to a moment before something was done to them.
        show_edges: whether edges are drawn; at first not those of a very fine surface.
        limits: of the field that is coloured; they grow with its values, and `fit` forgets them.
        trocars: of the simulations; None: they have none.
        on_tool: called with the name of a tool that is taken in hand.
        after_reset: called in the simulations' thread when they have begun again.
    """

    runner: Runner
    taker: FrameTaker
    touch: Touch
    rights: Rights
    stage: Stage
    recorder: Recorder
    begin_again: Callable[[], object]
    undo: Undo
    show_edges: bool = True
    limits: tuple[float, float] | None = None
    trocars: LiveTrocars | None = None
    on_tool: list[Callable[[str], object]] = field(default_factory=list)
    after_reset: list[Callable[[Sequence[Simulation]], object]] = field(default_factory=list)

    def go_back(self, simulations: Sequence[Simulation]) -> None:
        """Undo what was done last, in the thread that owns the simulations."""
        self.undo.back(simulations)
        self.touch.forget()

    def take_in_hand(self, tool: str) -> None:
        """Take another tool in hand, on the page too."""
        for choose in self.on_tool:
            choose(tool)

    def share(self, least: float) -> float:
        """Of a processor, that work for the page may take.

        Args:
            least: what it takes of a simulation that has no time to spare.
        """
        return least + _SPARE * self.runner.spare

    def on_change(self, handle: Any, act: Callable[[Any], object]) -> None:
        """Do something with the value of a widget whenever a page that may touch changes it.

        Of another page the change is taken back.
        """
        kept = handle.value

        async def changed(event: viser.GuiEvent[Any]) -> None:
            nonlocal kept
            if handle.value == kept:
                return
            if not self.rights.may(event.client_id):
                handle.value = kept
                _refuse(event.client)
                return
            kept = handle.value
            act(kept)

        handle.on_update(changed)

    def on_press(self, button: Any, act: Callable[[Any], object]) -> None:
        """Do something with the value of a button when a page that may touch presses it."""

        async def pressed(event: viser.GuiEvent[Any]) -> None:
            if not self.rights.may(event.client_id):
                _refuse(event.client)
                return
            act(button.value)

        button.on_click(pressed)


def _refuse(client: viser.ClientHandle | None) -> None:
    """Say on a page why nothing happens."""
    if client is not None:
        client.add_notification(
            title="This page looks on",
            body="Another page is in control; `--shared` lets every page touch.",
            auto_close_seconds=5.0,
        )
