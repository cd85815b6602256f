"""A layer: marks that are made from a simulation, and can be switched."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tissu.live_view.marks import Marks
    from tissu.simulation import Simulation

Draw = Callable[[], "Sequence[Marks]"]


@dataclass(frozen=True, slots=True)
class Layer:
    """Marks that can be switched.

    Attributes:
        name: on the page.
        on: whether it is shown at first.
        offered: whether a simulation has any.
        begin: finds what does not change from step to step, such as which nodes are held, and
            gives what makes the marks of each frame. It is called again when cells were removed or
            parameters were changed.
    """

    name: str
    on: bool
    offered: Callable[[Simulation], bool]
    begin: Callable[[Simulation], Draw]
