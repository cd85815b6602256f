"""The work that bench/peers.py gives to programs, as arrays: a bar that swings, a cube that falls.

NumPy alone: a program may run in a Python of its own, in which tissu is not installed.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import numpy as np

SIZE = (8.0, 1.0, 1.0)  # m
YOUNG, POISSON, DENSITY = 50e6, 0.3, 1000.0  # Pa, 1, kg/m3
GRAVITY = 9.81  # m/s2, along -z
SIDE, HEIGHT, SOFT = 0.05, 0.02, 100e3  # m, m, Pa: the cube, its fall, its Young's modulus
CUBE = 6  # its cells along an edge, each cut in six
STIFFNESS_DAMPING = 0.005  # s, Rayleigh's, of the cube
NEAR = 1e-9  # m


@dataclass(frozen=True)
class Work:
    """Tetrahedra at rest: a bar held at x = 0 that bends under its weight, or a cube above a plane.

    Attributes:
        points: nodes (n, 3) [m].
        tetrahedra: node numbers (e, 4), of positive volume.
        dt: a step [s].
    """

    points: Any
    tetrahedra: Any
    dt: float

    @property
    def held(self) -> Any:
        """Numbers of the nodes that are held."""
        return np.flatnonzero(self.points[:, 0] < NEAR)

    @property
    def end(self) -> Any:
        """Numbers of the nodes of the free end."""
        return np.flatnonzero(self.points[:, 0] > SIZE[0] - NEAR)

    @property
    def volumes(self) -> Any:
        """Of each tetrahedron (e,) [m3]."""
        corners = self.points[self.tetrahedra]
        return np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6.0

    @property
    def masses(self) -> Any:
        """Of each node (n,) [kg]: a quarter of each tetrahedron around it."""
        masses = np.zeros(len(self.points))
        np.add.at(masses, self.tetrahedra.ravel(), np.repeat(DENSITY * self.volumes / 4.0, 4))
        return masses

    def tip(self, positions: Any) -> list[float]:
        """Mean displacement (3,) [m] of the free end."""
        moved = np.asarray(positions, dtype=np.float64)[self.end] - self.points[self.end]
        return [float(u) for u in moved.mean(axis=0)]

    def write(self, path: Path) -> None:
        """Keeps it in a file."""
        np.savez(path, points=self.points, tetrahedra=self.tetrahedra, dt=self.dt)

    @classmethod
    def read(cls, path: str | Path) -> Work:
        """What `write` kept."""
        with np.load(path) as kept:
            return cls(kept["points"], kept["tetrahedra"], float(kept["dt"]))


@dataclass(frozen=True)
class Facts:
    """What the page says of a program's way.

    Attributes:
        law: of the material.
        step: how it goes on in time, and how it solves.
        lacks: what it does not do of what tissu does.
    """

    law: str
    step: str
    lacks: str = ""


class Running(Protocol):
    """A program with its work made."""

    def step(self) -> None:
        """Goes on by the work's dt; this is what is timed."""

    def seen(self) -> list[float]:
        """What is compared; not timed.

        Of a bar the mean displacement (3,) [m] of its free end; of a cube how deep it is in the
        plane, beyond the thickness that the program gives it [m], and what the plane carries [N].
        """

    def unsolved(self) -> int | None:
        """Steps that are not solved, as the program itself says; None: it does not say."""
