"""A path on which something is led: a rotation and a displacement from rest, over time."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from tissu import units
from tissu.reading import Many, MaybeVectors
from tissu.scene.direction import scaled
from tissu.scene.field import field
from tissu.scene.part import Part
from tissu.scene.problem import Problem
from tissu.scene.selection import Floats
from tissu.scene.support import IncreasingTimes, Rotation, same_length
from tissu.scene.unknown import rule

__all__ = ["Motion"]

Path = tuple[Floats, Floats, Floats, Floats, Floats]
"""Times (t,), displacements (t, 3), angles (t,), center (3,), axis (3,), as the core takes them."""


class Motion(Part):
    """A path from rest: a rotation, then a displacement, both linear between the times."""

    times: IncreasingTimes
    """strictly increasing times [s]; before the first and after the last it stands still"""
    displacements: MaybeVectors[Many[units.Position]] = field(default=None)
    """displacement from rest at each time [m]; absent: none"""
    rotation: Rotation | None = None
    """rotation from rest; absent: none"""

    @rule("displacements", "rotation")
    def _moves(self) -> Iterator[Problem]:
        if self.displacements is None and self.rotation is None:
            text = "found neither displacements nor rotation; at least one is needed"
            yield Problem((), text)

    @rule("displacements", "times")
    def _displaced_at_each_time(self) -> Iterator[Problem]:
        if self.displacements is not None:
            yield from same_length("displacement", self.displacements, self.times)

    @rule("rotation", "times")
    def _turned_at_each_time(self) -> Iterator[Problem]:
        if self.rotation is not None:
            yield from same_length("rotation angle", self.rotation.angles, self.times)

    def in_core(self) -> Path:
        """The path as the core takes it."""
        moves, turn, still = self.displacements, self.rotation, np.zeros(len(self.times))
        return (
            np.array(self.times),
            np.zeros((len(self.times), 3)) if moves is None else np.array(moves),
            still if turn is None else np.array(turn.angles),
            np.zeros(3) if turn is None else np.array(turn.center),
            scaled((0.0, 0.0, 1.0) if turn is None else turn.axis),
        )

    def words(self) -> str:
        """Until when it moves."""
        return f"moved until {self.times[-1]:g} s"
