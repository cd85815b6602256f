"""Sections of rods: the lines of a body whose nodes are frames."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import PlainValidator, ValidationInfo

from tissu import units
from tissu.errors import ParameterError
from tissu.reading import Number, Read
from tissu.scene.effect import vector_in_words
from tissu.scene.field import field
from tissu.scene.part import Part, chosen, keeps_problems
from tissu.scene.problem import Problem
from tissu.scene.unknown import Unread, rule

if TYPE_CHECKING:
    from tissu._core import SectionOfLines

__all__ = ["Round", "Rectangle", "Tube", "GeneralSection"]

_ANY = (0.0, 0.0, 0.0)


class Section(Part):
    """The common part of all sections."""

    if TYPE_CHECKING:
        type: str

    def whole_area(self) -> float:
        """Area [m^2]."""
        raise NotImplementedError

    @property
    def direction(self) -> tuple[float, float, float] | None:
        """Along which its height stands in space; None: the section is the same all around."""
        return None

    def in_core(self) -> SectionOfLines:
        """Shape, sizes and direction, as the core takes them."""
        return self.type, [*self._sizes(), *(5 * [0.0])][:5], list(self.direction or _ANY)

    def _sizes(self) -> tuple[float, ...]:
        return ()

    def words(self) -> str:
        """Its shape and numbers, as `check` says them."""
        sizes = " x ".join(f"{size:g}" for size in self._sizes())
        along = self.direction
        up = "" if along is None else f", up along {vector_in_words(along)}"
        return f"{self.type} {sizes}{up}, {self.whole_area():g} m^2"


class Round(Section):
    """A full circle."""

    type: Literal["round"] = "round"
    radius: units.Length = field(gt=0.0)
    """radius [m]"""

    def whole_area(self) -> float:
        """Area [m^2]."""
        return math.pi * self.radius**2

    def words(self) -> str:
        """Its shape and numbers, as `check` says them."""
        return f"round, radius {self.radius:g} m"


class Tube(Section):
    """A circle with a concentric hole."""

    type: Literal["tube"] = "tube"
    outer: units.Length = field(gt=0.0)
    """outer radius [m]"""
    inner: units.Length = field(gt=0.0)
    """inner radius [m], less than the outer one"""

    @rule("outer", "inner")
    def _has_a_wall(self) -> Iterator[Problem]:
        if self.inner >= self.outer:
            text = f"found an inner radius of {self.inner:g} m and an outer one of {self.outer:g} m"
            yield Problem((), f"{text}; an inner radius below the outer one is accepted")

    def whole_area(self) -> float:
        """Area [m^2]."""
        return math.pi * (self.outer**2 - self.inner**2)

    def _sizes(self) -> tuple[float, ...]:
        return self.outer, self.inner


class Oriented(Section):
    """What sections share whose two axes differ."""

    if TYPE_CHECKING:
        up: units.Direction

    @rule("up")
    def _has_a_direction(self) -> Iterator[Problem]:
        if not any(self.up):
            text = "found the direction (0, 0, 0); one across the lines is accepted, such as"
            yield Problem(("up",), f"{text} [0, 0, 1]")

    @property
    def direction(self) -> tuple[float, float, float] | None:
        """Along which its height stands in space."""
        return self.up


class Rectangle(Oriented):
    """A rectangle; its torsion constant is that of Saint-Venant's series."""

    type: Literal["rectangle"] = "rectangle"
    height: units.Length = field(gt=0.0)
    """side along `up` [m]"""
    width: units.Length = field(gt=0.0)
    """side across `up` and the line [m]"""
    up: units.Direction = field()
    """direction in space of the height, not zero; its part along a line is left out"""

    def whole_area(self) -> float:
        """Area [m^2]."""
        return self.height * self.width

    def _sizes(self) -> tuple[float, ...]:
        return self.height, self.width


class GeneralSection(Oriented):
    """Any section by its numbers; `up` and the direction across are its principal axes."""

    type: Literal["general"] = "general"
    area: units.Area = field(gt=0.0)
    """area A [m^2]"""
    inertia_up: units.AreaMoment = field(gt=0.0)
    """second moment of area of the distance along `up` [m^4]: E times it resists bending along
    `up`
    """
    inertia_across: units.AreaMoment = field(gt=0.0)
    """second moment of area of the distance across `up` [m^4]"""
    torsion: units.AreaMoment = field(gt=0.0)
    """torsion constant J [m^4], at most the sum of both second moments"""
    shear_up: units.Pure = field(gt=0.0, le=1.0)
    """shear factor k of forces along `up`: k G A resists them"""
    shear_across: units.Pure = field(gt=0.0, le=1.0)
    """shear factor of forces across `up`"""
    up: units.Direction = field()
    """direction in space of the first principal axis, of any length but zero; its part along a line
    is left out
    """

    @rule("inertia_up", "inertia_across", "torsion")
    def _twists_at_most_as_a_circle(self) -> Iterator[Problem]:
        polar = self.inertia_up + self.inertia_across
        if self.torsion > polar * (1.0 + 1e-12):
            text = f"found a torsion constant of {self.torsion:g} m^4, above the polar moment "
            text += f"{polar:g} m^4; no section has that: at most this moment is accepted"
            yield Problem(("torsion",), text)

    @rule("inertia_up", "inertia_across", "torsion", "shear_up", "shear_across")
    def _shears_as_it_twists(self) -> Iterator[Problem]:
        least = 0.5 * self.torsion / (self.inertia_up + self.inertia_across)
        for name in ("shear_up", "shear_across"):
            if getattr(self, name) <= least:
                text = f"found a shear factor of {getattr(self, name):g}; above half of torsion / "
                text += f"(inertia_up + inertia_across), which is {least:g} here, is accepted"
                yield Problem((name,), text)

    def whole_area(self) -> float:
        """Area [m^2]."""
        return self.area

    def _sizes(self) -> tuple[float, ...]:
        both = (self.inertia_up, self.inertia_across, self.torsion)
        return (*both, self.shear_up, self.shear_across)


SECTIONS: tuple[type[Section], ...] = (Round, Rectangle, Tube, GeneralSection)


def _area_or_section(value: Any, info: ValidationInfo) -> Any:
    """An area [m^2] of a round section, or a section."""
    if value is None:
        return None
    if not isinstance(value, (Section, Mapping)):
        return _area(value)
    try:
        return chosen(value, SECTIONS, info)
    except ParameterError as error:
        if not keeps_problems(info):
            raise
        return Unread((Problem((), str(error)),))


def _area(value: Any) -> float:
    area: float = units.AREA(value)
    if not area > 0.0:
        raise ParameterError(f"found {area:g}; an area above 0 is accepted")
    return area


_Sections = Read[float | Section | None, Number | Section | None]
AreaOrSection = Annotated[_Sections, PlainValidator(_area_or_section)]


def area_of(section: float | Section) -> float:
    """Area of a section [m^2]."""
    return section.whole_area() if isinstance(section, Section) else section


def section_in_core(section: float | Section | None) -> SectionOfLines:
    """The section as the core takes it; an area is that of a circle."""
    if isinstance(section, Section):
        return section.in_core()
    return "round", [0.0] * 5, list(_ANY)
