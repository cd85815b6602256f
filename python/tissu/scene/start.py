"""How a body begins: where its nodes are, and how fast they move."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from tissu import units
from tissu.reading import MaybeVector
from tissu.scene.effect import vector_in_words
from tissu.scene.field import field
from tissu.scene.part import Part
from tissu.scene.selection import Floats

__all__ = ["Start"]

Shape = Literal["rest", "point", "plane", "random", "inside_out"]


class Start(Part):
    """The state of a body at time zero; nodes of supports keep their places and motions."""

    velocity: MaybeVector[units.Velocity] = field(default=None)
    """velocity of all nodes [m/s]; absent: at rest"""
    spin: MaybeVector[units.Spin] = field(default=None)
    """angular velocity about the centre of mass [rad/s]; absent: none"""
    shape: Shape = "rest"
    """positions of the nodes at the start: at rest; all in one point, the centre of mass; flattened
    into the horizontal plane through it; at random within the body's box; or inside out, mirrored
    in that plane
    """
    seed: Annotated[int, Field(ge=0)] = 0
    """seed of the random positions"""

    def words(self) -> str:
        """How it begins, as `check` says it."""
        words: list[str] = [self.shape] if self.shape != "rest" else []
        if self.velocity is not None:
            words.append(f"velocity {vector_in_words(self.velocity)} m/s")
        if self.spin is not None:
            words.append(f"spin {vector_in_words(self.spin)} rad/s")
        return ", ".join(words) or "at rest"

    def state(self, rest: Floats) -> tuple[Floats, Floats]:
        """Positions [m] and velocities [m/s] (n, 3) of all nodes; the centre is that of the nodes.

        Args:
            rest: positions (n, 3) at rest [m].
        """
        centre = rest.mean(axis=0)
        places = rest.copy()
        if self.shape == "point":
            places[:] = centre
        elif self.shape == "plane":
            places[:, 2] = centre[2]
        elif self.shape == "inside_out":
            places[:, 2] = 2.0 * centre[2] - places[:, 2]
        elif self.shape == "random":
            random = np.random.default_rng(self.seed)
            places = random.uniform(rest.min(axis=0), rest.max(axis=0), rest.shape)
        velocities = np.zeros_like(rest)
        if self.velocity is not None:
            velocities += np.array(self.velocity)
        if self.spin is not None:
            velocities += np.cross(np.array(self.spin), places - centre)
        return places, velocities
