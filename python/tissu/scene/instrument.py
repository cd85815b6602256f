"""Instruments: blades that cut and tips that take cells away, led along a path or while it runs."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, PlainValidator, ValidationInfo

from tissu import units
from tissu.errors import ParameterError
from tissu.reading import Many, Maybe, MaybeVectors, Read, VectorLike, listed, written
from tissu.scene.effect import Effect
from tissu.scene.field import field
from tissu.scene.part import Part, chosen, keeps_problems
from tissu.scene.problem import Problem
from tissu.scene.support import IncreasingTimes, same_length
from tissu.scene.unknown import Unread, rule

__all__ = ["Ablator", "Knife", "ToolPath"]

_Points = tuple[tuple[float, float, float], ...]
_POSITION = units.Triple(units.LENGTH)
_LONGEST_EDGE = 1.0
"""m: above it, a number in millimetres was read as metres"""
_LONGEST_TURN = math.pi * (1.0 + 1e-12)


def _places(value: object) -> object:
    value = listed(value)
    if isinstance(value, (list, tuple)):
        return tuple(_POSITION(point) for point in value)
    text = "a list of points is accepted, such as [[0, 0, 0], [0, 0, 12 mm]]"
    raise ParameterError(f"found {written(value)}; {text}")


_Places = Annotated[Read[_Points, Sequence[VectorLike]], BeforeValidator(_places)]
_MaybePlaces = Annotated[
    Read[_Points | None, Sequence[VectorLike] | None],
    BeforeValidator(lambda value: None if value is None else _places(value)),
]
_Names = Read[tuple[str, ...], Sequence[str]]


class ToolPath(Part):
    """A path of an instrument: straight lines and even rotations between the given times."""

    times: IncreasingTimes
    """strictly increasing times [s]; before the first and after the last it stands still"""
    positions: _Places
    """place of the tool's origin at each time [m]"""
    rotations: MaybeVectors[Many[units.RotationVector]] = field(default=None)
    """rotation at each time: vectors along the axis, as long as the angle [rad]; absent: none"""

    @rule("positions", "times")
    def _placed_at_each_time(self) -> Iterator[Problem]:
        yield from same_length("position", self.positions, self.times)

    @rule("rotations", "times")
    def _turned_at_each_time(self) -> Iterator[Problem]:
        if self.rotations is None:
            return
        yield from same_length("rotation", self.rotations, self.times)
        for before, after in itertools.pairwise(self.rotations):
            angle = math.dist(before, after)
            if angle > _LONGEST_TURN:
                text = f"found a turn of {math.degrees(angle):.4g} degrees between two times; at "
                yield Problem(("rotations",), text + "most 180 are accepted: give times between")


class Instrument(Part):
    """What all instruments share."""

    path: ToolPath | None = None
    """path along which it moves; absent: a program calls `simulation.instruments[name].move`"""
    position: units.Position = field(default=(0.0, 0.0, 0.0))
    """place of its origin before it is moved [m]; without a path only"""
    rotation: units.RotationVector = field(default=(0.0, 0.0, 0.0))
    """rotation before it is moved: a vector along the axis, as long as the angle [rad]; without a
    path only
    """
    if TYPE_CHECKING:
        type: str

    @rule("path", "position", "rotation")
    def _begins_once(self) -> Iterator[Problem]:
        for name in ("position", "rotation"):
            if self.path is not None and any(getattr(self, name)):
                text = "found it with a path, which gives the place of the tool; leave it out"
                yield Problem((name,), text)

    @property
    def bodies(self) -> tuple[str, ...]:
        """Names of the bodies that it works on."""
        raise NotImplementedError

    @property
    def bodies_field(self) -> str:
        """The field that names them."""
        raise NotImplementedError

    def points(self) -> np.ndarray[Any, Any]:
        """Its edge, or the ends of its axis, in its own axes (m, 3) [m]."""
        raise NotImplementedError

    def effect(self, name: str) -> Effect:
        """What an instrument of this name switches on."""
        led = "moved by a program"
        if self.path is not None:
            led = f"led until {self.path.times[-1]:g} s"
        on = ", ".join(self.bodies)
        return Effect(f"instrument {name}", f"instruments.{name} {self.words()} {on}, {led}")

    def words(self) -> str:
        """What it does, as `check` says it before the bodies' names."""
        raise NotImplementedError


class Knife(Instrument):
    """A blade: at the end of each step it cuts along the path of its edge in the material."""

    type: Literal["knife"] = "knife"
    edge: _Places = field(kw_only=False)
    """points of the cutting edge in the tool's own axes [m], two or more"""
    cuts: _Names = field(min_length=1)
    """names of the bodies and tissues that it cuts"""
    toughness: Maybe[units.Toughness] = field(default=None, gt=0.0)
    """energy J_c that a unit of new area takes [J/m^2]: the edge presses until the force on it is
    J_c for each metre in the material, in a sheet J_c times the thickness; absent: it cuts without
    force
    """

    @rule("edge")
    def _has_a_length(self) -> Iterator[Problem]:
        length = sum(math.dist(a, b) for a, b in itertools.pairwise(self.edge))
        if not length <= _LONGEST_EDGE:
            text = (
                f"found an edge of {length:g} m; at most {_LONGEST_EDGE:g} m is accepted, so say "
            )
            yield Problem(("edge",), f"{text}its unit, such as 12 mm")
        if len(self.edge) < 2:
            points = "1 point" if len(self.edge) == 1 else "no point"
            text = f"found {points}; two or more are accepted, such as [[0, 0, 0], "
            yield Problem(("edge",), f"{text}[0, 0, 12 mm]]")
        for number, (a, b) in enumerate(itertools.pairwise(self.edge)):
            if a == b:
                text = f"found points {number} and {number + 1} in one place; points apart are "
                yield Problem(("edge",), f"{text}accepted")

    @rule("cuts")
    def _cuts_each_once(self) -> Iterator[Problem]:
        yield from _each_once("cuts", self.cuts)

    @property
    def bodies(self) -> tuple[str, ...]:
        """Names of the bodies that it cuts."""
        return self.cuts

    @property
    def bodies_field(self) -> str:
        """The field that names them."""
        return "cuts"

    def points(self) -> np.ndarray[Any, Any]:
        """Its edge in its own axes (m, 3) [m]."""
        return np.array(self.edge, dtype=float)

    def words(self) -> str:
        """What it does, as `check` says it before the bodies' names."""
        tough = "" if self.toughness is None else f" of toughness {self.toughness:g} J/m^2"
        length = sum(math.dist(a, b) for a, b in itertools.pairwise(self.edge))
        return f"is a knife of {length:g} m{tough} that cuts"


class Ablator(Instrument):
    """A tip that removes the cells whose centre of material lies in the tip or on its path."""

    type: Literal["ablator"] = "ablator"
    radius: units.Length = field(gt=0.0, kw_only=False)
    """radius [m]"""
    ends: _MaybePlaces = field(default=None)
    """ends of the axis of a capsule in the tool's own axes [m]; absent: a ball about the origin"""
    removes: _Names = field(min_length=1)
    """names of the bodies whose cells, and of the tissues whose points, it removes"""
    least_force: Maybe[units.ForceSize] = field(default=None, ge=0.0)
    """reserved for tips that remove cells by pressing [N], which are not supported yet: leave it
    out
    """

    @rule("least_force")
    def _does_not_press(self) -> Iterator[Problem]:
        if self.least_force is not None:
            text = f"found {self.least_force:g} N, but bodies do not press on an ablator yet; "
            text += "leave least_force out: cells go where their centre is in the tip"
            yield Problem(("least_force",), text)

    @rule("ends")
    def _has_two_ends(self) -> Iterator[Problem]:
        if self.ends is not None and (len(self.ends) != 2 or self.ends[0] == self.ends[1]):
            yield Problem(("ends",), "two points apart are accepted; leave ends out for a ball")

    @rule("removes")
    def _removes_each_once(self) -> Iterator[Problem]:
        yield from _each_once("removes", self.removes)

    @property
    def bodies(self) -> tuple[str, ...]:
        """Names of the bodies whose cells it takes away."""
        return self.removes

    @property
    def bodies_field(self) -> str:
        """The field that names them."""
        return "removes"

    def points(self) -> np.ndarray[Any, Any]:
        """Ends of its axis in its own axes (m, 3) [m]; one point of a ball."""
        return np.zeros((1, 3)) if self.ends is None else np.array(self.ends, dtype=float)

    def words(self) -> str:
        """What it does, as `check` says it before the bodies' names."""
        shape = "ball" if self.ends is None else "capsule"
        return f"is a {shape} of radius {self.radius:g} m that takes cells from"


def _each_once(field: str, names: tuple[str, ...]) -> Iterator[Problem]:
    for number, name in enumerate(names):
        if name in names[:number]:
            yield Problem((field, number), f"found '{name}' twice; each body once is accepted")


INSTRUMENTS: tuple[type[Instrument], ...] = (Knife, Ablator)


def _one_instrument(value: Any, info: ValidationInfo) -> Any:
    """An instrument: in Python by class, in YAML by its `type`."""
    try:
        return chosen(value, INSTRUMENTS, info)
    except ParameterError as error:
        if not keeps_problems(info):
            raise
        return Unread((Problem((), str(error)),))


OneInstrument = Annotated[Instrument, PlainValidator(_one_instrument)]
AllInstruments = Read[dict[str, OneInstrument], Mapping[str, Instrument]]
