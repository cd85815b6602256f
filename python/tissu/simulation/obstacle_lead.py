"""An obstacle of a scene that is led while a simulation runs."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu import units
from tissu.simulation.entry import one_thread_at_a_time
from tissu.simulation.known_names import known_names_only
from tissu.simulation.lead import pose_arguments, seconds_of

if TYPE_CHECKING:
    from tissu import _core as core
    from tissu.reading import Number, VectorLike
    from tissu.simulation.entry import Entry

Floats = NDArray[np.float64]


@known_names_only
@one_thread_at_a_time
class ObstacleLead:
    """An obstacle of the scene by its name, which may be given a live target from the next step on.

    On the way it moves with a constant velocity and turns at a constant rate. It pushes bodies in
    its way. It is made by `Simulation.obstacle`.
    """

    def __init__(self, *, simulation: core.Simulation, entry: Entry, name: str) -> None:
        """Take an obstacle of the scene."""
        self._core = simulation
        self._entry = entry
        self._name = name

    def __repr__(self) -> str:
        """What it is called, and whether it has a live target."""
        how = "on its own path" if self.released else "led live"
        return f"ObstacleLead('{self._name}', {how})"

    @property
    def name(self) -> str:
        """Name of the obstacle."""
        return self._name

    @property
    def released(self) -> bool:
        """Whether it follows its own path, or is on its way back to it."""
        return not self._core.is_obstacle_led_live(self._name)

    @property
    def origin(self) -> Floats:
        """Its origin at rest (3,) [m]: the point of a plane, the middle of others."""
        return np.asarray(self._core.obstacle_surface(self._name)[5])

    @property
    def force(self) -> Floats:
        """Force of the bodies on it in the latest step (3,) [N]: what a hand would feel."""
        return self._core.contact_force_on(self._name)[0]

    @property
    def moment(self) -> Floats:
        """Moment of the bodies on it about its origin in the latest step (3,) [N m]."""
        return self._core.contact_force_on(self._name)[1]

    def place_of(self, rest: VectorLike) -> Floats:
        """Present place of a point of it (3,) [m], given its place at rest (3,) [m]."""
        point = np.array(units.Triple(units.LENGTH)(rest), dtype=float)
        return np.asarray(self._core.obstacle_places(name=self._name, rest=point[None])[0])

    def move(
        self,
        displacement: VectorLike = (0.0, 0.0, 0.0),
        *,
        angle: Number | str = 0.0,
        axis: VectorLike = (0.0, 0.0, 1.0),
        center: VectorLike = (0.0, 0.0, 0.0),
        over: Number | str | None = None,
    ) -> None:
        """Move it: a rotation from rest, then a displacement from rest.

        Args:
            displacement: from rest (3,) [m].
            angle: of the rotation from rest [rad], or text such as "30 deg". Whole turns count.
            axis: direction of the rotation's axis, of any length but zero.
            center: a point of the axis at rest (3,) [m].
            over: time until it is there [s]; None: the next step.

        Raises:
            ParameterError: a value is not finite or of another quantity; an axis of length zero; a
                time that is not positive.
        """
        self._core.lead_obstacle(
            name=self._name,
            **pose_arguments(displacement, angle, axis, center),
            over=seconds_of(over),
        )

    def release(self, *, over: Number | str | None = None) -> None:
        """Return it to its own path; a second call does nothing.

        Args:
            over: time until it is there [s]; None: the next step.

        Raises:
            ParameterError: a time that is not positive.
        """
        self._core.release_obstacle(name=self._name, over=seconds_of(over))
