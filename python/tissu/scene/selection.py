"""Selections: which nodes of a body something acts on, by their rest positions or by name."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from pydantic import BeforeValidator, Field

from tissu import units
from tissu.scene.part import Part, one_of
from tissu.scene.problem import Problem
from tissu.scene.unknown import rule

if TYPE_CHECKING:
    from collections.abc import Sequence

_Nodes = Annotated[tuple[Annotated[int, Field(ge=0)], ...], BeforeValidator(units.listed)]


def _named(value: object) -> object:
    """A region that the mesh numbers, such as 7, by its name "7"."""
    return str(value) if isinstance(value, int) and not isinstance(value, bool) else value


class Box(Part):
    """Nodes in a box along the axes, faces included; null (None) on an axis means unbounded."""

    positional: ClassVar[tuple[str, ...]] = ("min", "max")
    type: Literal["box"] = "box"
    min: units.OpenPosition = (None, None, None)
    """smallest corner [m]"""
    max: units.OpenPosition = (None, None, None)
    """largest corner [m]"""

    if TYPE_CHECKING:

        def __init__(
            self,
            min: Sequence[float | str | None] | None = ...,
            max: Sequence[float | str | None] | None = ...,
        ) -> None: ...

    @rule("min", "max")
    def _ordered(self) -> Iterator[Problem]:
        for axis, low, high in zip("xyz", self.min, self.max, strict=True):
            if low is not None and high is not None and low > high:
                found = f"found min {low:g} m above max {high:g} m on axis {axis}"
                yield Problem((), f"{found}; exchange them")


class Sphere(Part):
    """Nodes no farther than `radius` from `center`."""

    positional: ClassVar[tuple[str, ...]] = ("center", "radius")
    type: Literal["sphere"] = "sphere"
    center: units.Position
    """center [m]"""
    radius: Annotated[units.Length, Field(gt=0.0)]
    """radius [m]"""

    if TYPE_CHECKING:

        def __init__(self, center: units.VectorLike, radius: units.Number) -> None: ...


class Plane(Part):
    """Nodes within `tolerance` of the plane through `point` across `normal`."""

    positional: ClassVar[tuple[str, ...]] = ("point", "normal", "tolerance")
    type: Literal["plane"] = "plane"
    point: units.Position
    """a point of the plane [m]"""
    normal: units.Direction
    """normal of the plane, of any length but zero"""
    tolerance: Annotated[units.Length, Field(ge=0.0)] | None = None
    """largest distance [m]; when absent, a millionth of the body's diagonal"""

    if TYPE_CHECKING:

        def __init__(
            self,
            point: units.VectorLike,
            normal: units.VectorLike,
            tolerance: units.Number | None = ...,
        ) -> None: ...

    @rule("normal")
    def _has_normal(self) -> Iterator[Problem]:
        if not any(self.normal):
            text = "found the normal (0, 0, 0); a direction is accepted, such as [0, 0, 1]"
            yield Problem((), text)


class Nodes(Part):
    """Nodes by their numbers in the mesh, from 0."""

    positional: ClassVar[tuple[str, ...]] = ("ids",)
    type: Literal["nodes"] = "nodes"
    ids: _Nodes
    """numbers of the nodes, from 0"""

    if TYPE_CHECKING:

        def __init__(self, ids: Sequence[int] | units.VectorLike) -> None: ...


class SurfaceNodes(Part):
    """All nodes of the body's boundary surface."""

    type: Literal["surface"] = "surface"


class Region(Part):
    """Nodes of the cells of a region that the mesh names."""

    positional: ClassVar[tuple[str, ...]] = ("name",)
    type: Literal["region"] = "region"
    name: Annotated[str, BeforeValidator(_named)]
    """name of a region of the mesh"""

    if TYPE_CHECKING:

        def __init__(self, name: str) -> None: ...


Selection = Box | Sphere | Plane | Nodes | SurfaceNodes | Region
On = Annotated[Selection, one_of(Box, Sphere, Plane, Nodes, SurfaceNodes, Region)]
