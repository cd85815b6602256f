"""A support or motion of a scene that is led while a simulation runs."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tissu import units
from tissu.errors import ParameterError
from tissu.simulation.entry import one_thread_at_a_time
from tissu.simulation.known_names import known_names_only

if TYPE_CHECKING:
    from tissu import _core as core
    from tissu.reading import Number, VectorLike
    from tissu.scene.support import Support
    from tissu.simulation.entry import Entry

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

_POSITION = units.Triple(units.LENGTH)
_DIRECTION = units.Triple(units.NUMBER)


@known_names_only
@one_thread_at_a_time
class Lead:
    """A support of the scene by its name, which may be given a live target from the next step on.

    On the way to the target the nodes move with a constant velocity, and a rotation follows its arc
    at a constant rate. The nodes stay there until they are moved again or released. It is made by
    `Simulation.lead`.
    """

    def __init__(self, *, simulation: core.Simulation, entry: Entry, support: Support) -> None:
        """Take a support of the scene that has a name."""
        self._core = simulation
        self._entry = entry
        self._support = support
        self._name = str(support.name)

    def __repr__(self) -> str:
        """What it is called, and whether it has a live target."""
        how = "on its own path" if self.released else "led live"
        return f"Lead('{self._name}' of '{self.body}', {how})"

    @property
    def name(self) -> str:
        """Name of the support."""
        return self._name

    @property
    def body(self) -> str:
        """Name of the body."""
        return self._support.body

    @property
    def nodes(self) -> Ints:
        """Numbers (k,) of its nodes in their body; positions and targets are in this order."""
        first, _ = self._core.body_range(self.body)
        return np.asarray(self._core.led_nodes(self._name) - np.int32(first))

    @property
    def released(self) -> bool:
        """Whether it follows its own path, or is on its way back to it."""
        return not self._core.is_led_live(self._name)

    @property
    def positions(self) -> Floats:
        """Present positions of its nodes (k, 3) [m]; a copy."""
        return np.asarray(self._core.positions[self._core.led_nodes(self._name)])

    @property
    def target(self) -> Floats:
        """Places to which its nodes move (k, 3) [m]: the live target, or else its own path now.

        Only the axes of the support are prescribed.
        """
        return self._core.led_target(self._name)

    @target.setter
    def target(self, value: ArrayLike) -> None:
        self.place(value)

    @property
    def reactions(self) -> Floats:
        """Its forces on each of its nodes in the latest step (k, 3) [N]."""
        self._core.settle()
        return np.asarray(self._core.reactions()[self._core.led_nodes(self._name)])

    @property
    def force(self) -> Floats:
        """Its force on the body (3,) [N]: the sum of its reactions."""
        return np.asarray(self.reactions.sum(axis=0))

    def move(
        self,
        displacement: VectorLike = (0.0, 0.0, 0.0),
        *,
        angle: Number | str = 0.0,
        axis: VectorLike = (0.0, 0.0, 1.0),
        center: VectorLike = (0.0, 0.0, 0.0),
        over: Number | str | None = None,
    ) -> None:
        """Move it as one rigid piece: a rotation from rest, then a displacement from rest.

        Rotations of nodes that are frames are prescribed too, if the support gives them.

        Args:
            displacement: from rest (3,) [m].
            angle: of the rotation from rest [rad], or text such as "30 deg". Whole turns count: it
                turns from the previous angle to this one.
            axis: direction of the rotation's axis, of any length but zero.
            center: a point of the axis at rest (3,) [m].
            over: time until it is there [s]; None: the next step.

        Raises:
            ParameterError: a value is not finite or of another quantity; an axis of length zero; a
                time that is not positive.
        """
        self._core.lead_rigidly(
            name=self._name,
            **pose_arguments(displacement, angle, axis, center),
            over=seconds_of(over),
        )

    def place(self, positions: ArrayLike, *, over: Number | str | None = None) -> None:
        """Move each node to a place of its own, along a line.

        Rotations of nodes that are frames stay as they are.

        Args:
            positions: of its nodes in the order of `nodes` (k, 3) [m].
            over: time in which they reach the target [s]; None: the next step.

        Raises:
            ParameterError: another shape, a value that is not finite, or a time that is not
                positive.
        """
        self._core.lead_nodes(
            name=self._name, positions=self._rows(positions), over=seconds_of(over)
        )

    def release(self, *, over: Number | str | None = None) -> None:
        """Return it to its own path; a second call does nothing.

        Args:
            over: time until it is there [s]; None: the next step.

        Raises:
            ParameterError: a time that is not positive.
        """
        self._core.release_lead(name=self._name, over=seconds_of(over))

    def _rows(self, positions: Any) -> Floats:
        count = len(self._core.led_nodes(self._name))
        try:
            rows = np.array(positions, dtype=float)
        except (TypeError, ValueError):
            raise ParameterError(
                f"found positions of '{self._name}' that are not numbers; an array ({count}, 3) in "
                "metres is accepted"
            ) from None
        if rows.shape != (count, 3):
            raise ParameterError(
                f"found positions of shape {rows.shape} for '{self._name}'; ({count}, 3) is "
                "accepted, a row for each of its nodes"
            )
        if not np.isfinite(rows).all():
            raise ParameterError(f"found a position of '{self._name}' that is not finite")
        return rows


class _Pose(TypedDict):
    displacement: Floats
    angle: float
    axis: Floats
    center: Floats


def pose_arguments(
    displacement: VectorLike, angle: Number | str, axis: VectorLike, center: VectorLike
) -> _Pose:
    """A rotation from rest, then a displacement from rest, as the core takes them.

    Raises:
        ParameterError: a value is not finite or of another quantity; an axis of length zero.
    """
    direction = np.array(_DIRECTION(axis), dtype=float)
    if not direction.any():
        raise ParameterError("found the axis (0, 0, 0); a direction is accepted: (0, 0, 1)")
    exponent = int(np.frexp(np.abs(direction).max())[1])
    return {
        "displacement": np.array(_POSITION(displacement), dtype=float),
        "angle": units.ANGLE(angle),
        "axis": np.ldexp(direction, 1 - exponent),  # its square is finite
        "center": np.array(_POSITION(center), dtype=float),
    }


def seconds_of(over: Number | str | None) -> float:
    """The duration of a way [s]; 0 for that of the next step."""
    if over is None:
        return 0.0
    seconds = units.TIME(over)
    if not (seconds > 0.0 and math.isfinite(seconds)):
        raise ParameterError(f"found a way of {seconds:g} s; a positive time is accepted")
    return seconds
