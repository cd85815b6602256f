"""From the pointer of a page to the tool in the thread that owns the simulations."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Literal

from tissu.errors import ParameterError
from tissu.live_view.tools import TOOLS, Tool

if TYPE_CHECKING:
    from concurrent.futures import Future

    from tissu.live_view.gizmo import Gizmo
    from tissu.live_view.marks import Marks
    from tissu.live_view.pointer import Pointer
    from tissu.live_view.runner import Runner
    from tissu.simulation import Simulation, StepReport

Phase = Literal["click", "start", "update", "end"]


class Touch:
    """The tools of a view, and the one that is in hand.

    Attributes:
        tools: those that its simulations can be touched with, by name.
        chosen: name of the one in hand; empty: none, and the pointer turns the view.
    """

    def __init__(
        self,
        runner: Runner,
        tools: Sequence[type[Tool]] = TOOLS,
        *,
        more: Sequence[Tool] = (),
        before: Callable[[Sequence[Simulation], bool], object] = lambda simulations, press: None,
    ) -> None:
        """Take the first tool that is offered in hand.

        Args:
            runner: the thread that owns the simulations.
            tools: each is made where a simulation offers it.
            more: tools that are there already.
            before: called in that thread before a tool that edits is used, and told whether this
                is a press or goes on.
        """
        self._runner, self._before = runner, before
        first = runner.simulations[0]
        made = [tool(runner.simulations) for tool in tools if tool.offered(first)]
        self.tools = {tool.name: tool for tool in (*made, *more)}
        self.chosen = next(iter(self.tools), "")
        self._pressed: dict[int, Tool] = {}
        self._moved: dict[int, Pointer] = {}
        self._turned: dict[str, Gizmo] = {}

    @property
    def on_bodies(self) -> bool:
        """Whether the tool in hand is pressed on bodies."""
        tool = self.tools.get(self.chosen)
        return tool is not None and tool.on_bodies

    def choose(self, name: str) -> None:
        """Take another tool in hand.

        Raises:
            ParameterError: no such tool is offered.
        """
        if name and name not in self.tools:
            raise ParameterError(f"found the tool '{name}'; accepted: {', '.join(self.tools)}")
        self.chosen = name

    def feel(self, phase: Phase, pointer: Pointer) -> Future[None] | None:
        """A pointer was pressed, moved or released, or pressed and released at once.

        It is done between two steps.
        """
        if phase == "click":
            return self._runner.ask(lambda simulations: self._click(simulations, pointer))
        if phase == "start":
            return self._runner.ask(lambda simulations: self._press(simulations, pointer))
        if phase == "end":
            return self._runner.ask(lambda simulations: self._release(simulations, pointer))
        waiting = pointer.client in self._moved
        self._moved[pointer.client] = pointer
        if waiting:  # the one that is on its way takes the newest place
            return None
        return self._runner.ask(lambda simulations: self._move(simulations, pointer.client))

    def turn(self, gizmo: Gizmo) -> Future[None] | None:
        """A gizmo was moved or turned; done between two steps."""
        waiting = gizmo.name in self._turned
        self._turned[gizmo.name] = gizmo
        if waiting:
            return None
        return self._runner.ask(lambda simulations: self._turn(simulations, gizmo.name))

    def hear(self, reports: Sequence[StepReport]) -> None:
        """What a step of each simulation reported."""
        for tool in self.tools.values():
            tool.hear(reports)

    def forget(self) -> None:
        """What tools did was undone, or the simulations have begun again."""
        for tool in self.tools.values():
            tool.forget()

    def gizmos(self, simulations: Sequence[Simulation]) -> list[Gizmo]:
        """Those of the tool in hand."""
        tool = self.tools.get(self.chosen)
        return tool.gizmos(simulations) if tool is not None else []

    def say(self, simulations: Sequence[Simulation]) -> str:
        """What the tool in hand feels."""
        tool = self.tools.get(self.chosen)
        return tool.say(simulations) if tool is not None else ""

    def draw(self, simulations: Sequence[Simulation]) -> Sequence[Sequence[Marks]]:
        """What the tool in hand draws on each simulation."""
        tool = self.tools.get(self.chosen)
        return tool.draw(simulations) if tool is not None else [() for _ in simulations]

    def _click(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        tool = self.tools.get(self.chosen)
        if tool is not None:
            self._remember(tool, simulations)
            tool.click(simulations, pointer)

    def _press(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        tool = self.tools.get(self.chosen)
        if tool is None:
            return
        self._pressed[pointer.client] = tool
        self._remember(tool, simulations)
        tool.press(simulations, pointer)

    def _remember(self, tool: Tool, simulations: Sequence[Simulation]) -> None:
        if tool.edits:
            self._before(simulations, True)

    def _move(self, simulations: Sequence[Simulation], client: int) -> None:
        pointer = self._moved.pop(client, None)
        tool = self._pressed.get(client)
        if tool is not None and pointer is not None:
            tool.move(simulations, pointer)

    def _turn(self, simulations: Sequence[Simulation], name: str) -> None:
        gizmo, tool = self._turned.pop(name), self.tools.get(self.chosen)
        if tool is not None:
            if tool.edits:
                self._before(simulations, False)
            tool.turn(simulations, gizmo)

    def _release(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        tool = self._pressed.pop(pointer.client, None)
        if tool is not None:
            tool.release(simulations, pointer)
