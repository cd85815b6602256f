"""A tool: what it does when a pointer is pressed, moved and released, and what it draws."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

if TYPE_CHECKING:
    from tissu.live_view.gizmo import Gizmo
    from tissu.live_view.marks import Marks
    from tissu.live_view.pointer import Pointer
    from tissu.simulation import Simulation, StepReport


@dataclass(slots=True)
class Number:
    """A number that a tool works with, and that the page lets be changed.

    Attributes:
        label: what it is called.
        unit: in which it is written.
        value: now, in that unit.
        least: the smallest that is accepted.
    """

    label: str
    unit: str
    value: float
    least: float


class Tool(ABC):
    """A tool is one file: a subclass, and its line in `tools/__init__.py`.

    Every method is called in the thread that owns the simulations, between two steps; an error of
    tissu that it raises is shown on the page.

    Attributes:
        name: on the page.
        hint: one sentence: what a press does.
        on_bodies: whether a press on a body is its own; else it turns the view, or meets a gizmo.
        edits: whether a press changes cells, so that the moment before it is kept to go back to.
        numbers: that the page lets be changed.
    """

    name: ClassVar[str]
    hint: ClassVar[str]
    on_bodies: ClassVar[bool] = True
    edits: ClassVar[bool] = False

    def __init__(self, simulations: Sequence[Simulation]) -> None:
        """Look at the simulations that it will work on."""
        self.numbers: list[Number] = []

    @classmethod
    @abstractmethod
    def offered(cls, simulation: Simulation) -> bool:
        """Whether a simulation can be touched by it."""

    @abstractmethod
    def press(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        """A press on a body."""

    def move(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        """The pointer has moved; moves between two steps are one, to the latest place."""
        return

    def release(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        """The press has ended, whatever ended it."""
        return

    def click(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        """A press and release at one place, on the ray from `eye` to `there`."""
        return

    def gizmos(self, simulations: Sequence[Simulation]) -> list[Gizmo]:
        """Gizmos that stand on the page while the tool is in hand."""
        return []

    def turn(self, simulations: Sequence[Simulation], gizmo: Gizmo) -> None:
        """A hand has moved or turned a gizmo; moves between two steps are one, to the latest."""
        return

    def hear(self, reports: Sequence[StepReport]) -> None:
        """What a step of each simulation reported."""
        return

    def forget(self) -> None:
        """What it did was undone, or the simulations have begun again."""
        return

    def say(self, simulations: Sequence[Simulation]) -> str:
        """What is felt now, for the page; empty: nothing."""
        return ""

    def draw(self, simulations: Sequence[Simulation]) -> Sequence[Sequence[Marks]]:
        """Marks of each simulation, beside the layers of the page."""
        return [() for _ in simulations]
