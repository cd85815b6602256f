"""The port of a trocar: where its pivot is, and how its axes lie in the scene."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from tissu import units
from tissu.reading import MaybeVector
from tissu.scene.direction import unit_vector
from tissu.scene.effect import vector_in_words
from tissu.scene.field import field
from tissu.scene.part import Part
from tissu.scene.problem import Problem
from tissu.scene.selection import Floats
from tissu.scene.unknown import rule

__all__ = ["Port"]

_ALONG = 0.999
"""cosine from which two directions are taken for the same: 2.6 degrees apart"""


class Port(Part):
    """The hole in the wall of the body that a tool goes through; its pivot stays where it is."""

    at: units.Position = field(kw_only=False)
    """the pivot [m]"""
    axis: units.Direction = field(kw_only=False)
    """direction into the body, and of the tool at rest; of any length but zero"""
    right: MaybeVector[units.Direction] = field(default=None)
    """direction about which the tool pitches; its part along the axis is left out; absent: the x of
    the scene, or its y if the axis lies along x
    """

    @rule("axis")
    def _has_an_axis(self) -> Iterator[Problem]:
        if not any(self.axis):
            text = "found the axis (0, 0, 0); a direction into the body is accepted, such as "
            yield Problem(("axis",), f"{text}[0, 0, -1]")

    @rule("right", "axis")
    def _pitches_across_the_axis(self) -> Iterator[Problem]:
        if self.right is None:
            return
        if not any(self.right) or abs(unit_vector(self.right) @ unit_vector(self.axis)) > _ALONG:
            text = f"found {vector_in_words(self.right)}, which does not lie across the axis "
            text += f"{vector_in_words(self.axis)}; leave it out, or give a direction across it"
            yield Problem(("right",), text)

    def frame(self) -> Floats:
        """Rotation (3, 3) from the port to the scene: its columns are e_X, e_Y and e_Z."""
        z = unit_vector(self.axis)
        along_x = abs(z[0]) > np.sqrt(0.5)
        right = self.right or ((0.0, 1.0, 0.0) if along_x else (1.0, 0.0, 0.0))
        x = unit_vector(right) - (unit_vector(right) @ z) * z
        x /= np.linalg.norm(x)
        return np.column_stack([x, np.cross(z, x), z])

    def words(self) -> str:
        """Where it is."""
        return f"at {vector_in_words(self.at)} m along {vector_in_words(self.axis)}"
