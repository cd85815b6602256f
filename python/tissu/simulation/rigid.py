"""A free obstacle while a simulation runs: where it is, and how it moves."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu import units
from tissu.simulation.entry import one_thread_at_a_time
from tissu.simulation.known_names import known_names_only

if TYPE_CHECKING:
    from tissu import _core as core
    from tissu.reading import VectorLike
    from tissu.simulation.entry import Entry

Floats = NDArray[np.float64]


@known_names_only
@one_thread_at_a_time
class Rigid:
    """An obstacle with a mass: a rigid body that contacts move. Made by `Simulation.rigid`."""

    def __init__(self, *, simulation: core.Simulation, entry: Entry, name: str) -> None:
        """Take a free obstacle of the scene."""
        self._core = simulation
        self._entry = entry
        self._name = name

    def __repr__(self) -> str:
        """What it is called, and where it is."""
        x, y, z = self.position
        return f"Rigid('{self._name}', at ({x:.4g}, {y:.4g}, {z:.4g}) m)"

    @property
    def name(self) -> str:
        """Name of the obstacle."""
        return self._name

    @property
    def position(self) -> Floats:
        """Where its centre of mass is now (3,) [m]."""
        return self._core.obstacle_motion(self._name)[0]

    @property
    def rotation(self) -> Floats:
        """Its rotation from rest as a matrix (3, 3): x = position + rotation (X - origin)."""
        return self._core.obstacle_motion(self._name)[1]

    @property
    def velocity(self) -> Floats:
        """Velocity of its centre of mass (3,) [m/s]; it may be set between steps."""
        return self._core.obstacle_motion(self._name)[2]

    @velocity.setter
    def velocity(self, value: VectorLike) -> None:
        read = np.array(units.Triple(units.VELOCITY)(value), dtype=float)
        self._core.set_obstacle_velocity(self._name, read, self.spin)

    @property
    def spin(self) -> Floats:
        """Angular velocity in axes of space (3,) [rad/s]; it may be set between steps."""
        return self._core.obstacle_motion(self._name)[3]

    @spin.setter
    def spin(self, value: VectorLike) -> None:
        read = np.array(units.Triple(units.SPIN)(value), dtype=float)
        self._core.set_obstacle_velocity(self._name, self.velocity, read)

    @property
    def force(self) -> Floats:
        """Contact force of others on it in the latest step (3,) [N]."""
        return self._core.contact_force_on(self._name)[0]

    @property
    def moment(self) -> Floats:
        """Contact moment of others on it about its centre of mass (3,) [N m]."""
        return self._core.contact_force_on(self._name)[1]
