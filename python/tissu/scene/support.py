"""Supports: nodes held in place, or moved along a given path."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from pydantic import AfterValidator, BeforeValidator

from tissu import units
from tissu.counted import counted
from tissu.errors import ParameterError
from tissu.scene.part import Part
from tissu.scene.problem import Problem
from tissu.scene.selection import On, Selection
from tissu.scene.unknown import rule

if TYPE_CHECKING:
    from collections.abc import Sequence


def _axes(value: object) -> object:
    if (
        not isinstance(value, str)
        or not value
        or set(value) - set("xyz")
        or len(set(value)) < len(value)
    ):
        raise ParameterError(
            f"found {value!r}; one or more of the letters x, y, z are accepted, each once"
        )
    return "".join(sorted(value))


def increasing(times: tuple[float, ...]) -> tuple[float, ...]:
    """The times, when there is at least one and they increase.

    Raises:
        ParameterError: no time, or one that does not follow the one before.
    """
    if not times:
        raise ParameterError("found no time; at least one is accepted")
    for before, after in itertools.pairwise(times):
        if after <= before:
            raise ParameterError(
                f"found {after:g} s after {before:g} s; strictly increasing times are accepted"
            )
    return times


def same_length(name: str, values: Sequence[object], times: Sequence[float]) -> Iterator[Problem]:
    """A problem when a list has not one value for each time."""
    if len(values) != len(times):
        found = f"found {counted(len(values), name)} for {counted(len(times), 'time')}"
        yield Problem((), f"{found}; one for each time is accepted")


Axes = Annotated[str, BeforeValidator(_axes)]
IncreasingTimes = Annotated[units.Times, AfterValidator(increasing)]


def axes_mask(axes: str) -> int:
    """Bit mask of axis letters: x = 1, y = 2, z = 4."""
    return sum(1 << "xyz".index(letter) for letter in axes)


def holds_rotations(support: Fixed | Prescribed) -> bool:
    """Whether it gives the rotation of nodes that are frames."""
    given = getattr(support, "rotations", None)
    return given == "held" or (given is None and len(getattr(support, "axes", "")) == 3)


class Fixed(Part):
    """Nodes that stay where they are at rest, on some or all axes."""

    positional: ClassVar[tuple[str, ...]] = ("body",)
    body: str
    """name of a body of the scene"""
    on: On
    """which nodes: a box, sphere, plane, nodes, surface or region"""
    axes: Axes = "xyz"
    """axes held: letters out of xyz"""
    rotations: Literal["held", "free"] | None = None
    """of nodes that are frames: whether their rotation is held too; absent: where all axes are"""

    if TYPE_CHECKING:

        def __init__(
            self,
            body: str,
            *,
            on: Selection,
            axes: str = ...,
            rotations: Literal["held", "free"] | None = ...,
        ) -> None: ...


class Rotation(Part):
    """A rotation about a fixed axis, by an angle that changes with time."""

    axis: units.Direction
    """direction of the axis, of any length but zero"""
    center: units.Position = (0.0, 0.0, 0.0)
    """a point of the axis [m]"""
    angles: units.Angles
    """angle at each time [rad]"""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            axis: units.VectorLike,
            center: units.VectorLike = ...,
            angles: Sequence[units.Number] | units.VectorLike,
        ) -> None: ...

    @rule("axis")
    def _has_axis(self) -> Iterator[Problem]:
        if not any(self.axis):
            text = "found the axis (0, 0, 0); a direction is accepted, such as [0, 0, 1]"
            yield Problem((), text)


class Prescribed(Part):
    """Nodes moved along a path: a rotation, then a displacement, both linear between the times."""

    positional: ClassVar[tuple[str, ...]] = ("body",)
    body: str
    """name of a body of the scene"""
    on: On
    """which nodes: a box, sphere, plane, nodes, surface or region"""
    axes: Axes = "xyz"
    """axes moved: letters out of xyz"""
    rotations: Literal["held", "free"] | None = None
    """of nodes that are frames: whether their rotation is given too; absent: where all axes are"""
    times: IncreasingTimes
    """strictly increasing times [s]"""
    displacements: units.Displacements | None = None
    """displacement from rest at each time [m]; absent: none"""
    rotation: Rotation | None = None
    """rotation from rest; absent: none"""

    if TYPE_CHECKING:

        def __init__(
            self,
            body: str,
            *,
            on: Selection,
            axes: str = ...,
            rotations: Literal["held", "free"] | None = ...,
            times: Sequence[units.Number] | units.VectorLike,
            displacements: Sequence[units.VectorLike] | None = ...,
            rotation: Rotation | None = ...,
        ) -> None: ...

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
