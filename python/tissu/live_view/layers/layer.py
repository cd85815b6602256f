"""A layer: marks that are made from a simulation, and can be switched."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tissu.live_view.marks import Marks
    from tissu.simulation import Simulation


@dataclass(frozen=True, slots=True)
class Layer:
    """Marks that can be switched.

    Attributes:
        name: on the page.
        on: whether it is shown at first.
        offered: whether a simulation has any.
        marks: those of a simulation as it stands; called only while the layer is shown.
    """

    name: str
    on: bool
    offered: Callable[[Simulation], bool]
    marks: Callable[[Simulation], Sequence[Marks]]
