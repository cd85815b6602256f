"""Selections: which nodes of a body something acts on, by their rest positions or by name."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal, cast

from pydantic import BeforeValidator, Field

from tissu import units
from tissu.scene.part import Part, one_of
from tissu.scene.problem import Problem
from tissu.scene.unknown import rule

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray

    from tissu.mesh import Mesh

_Nodes = Annotated[tuple[Annotated[int, Field(ge=0)], ...], BeforeValidator(units.listed)]


def _named(value: object) -> object:
    """A region that the mesh numbers, such as 7, by its name "7"."""
    return str(value) if isinstance(value, int) and not isinstance(value, bool) else value


def named_texts(value: object) -> object:
    """Selections by text: YAML reads the name 7 as a number."""
    if not isinstance(value, Mapping):
        return value
    return {str(name) if isinstance(name, int) else name: on for name, on in value.items()}


class _Selection(Part):
    """What selections share."""

    def cells(self, mesh: Mesh) -> NDArray[np.int32]:
        """Numbers (k,) of the mesh's cells that it means: by their centres, or by all their nodes.

        Of a box, a sphere or a plane the cells whose centres, the means of their nodes, lie in it;
        of a region its cells; of nodes and of the surface those of which every node is selected.
        Cells are numbered across `mesh.body_blocks`.

        Raises:
            ParameterError: a region that the mesh lacks, or node numbers beyond the mesh.
        """
        from tissu.compile.select import selected_cells

        return selected_cells(cast("Selection", self), mesh)


class Box(_Selection):
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


class Sphere(_Selection):
    """Nodes no farther than `radius` from `center`."""

    positional: ClassVar[tuple[str, ...]] = ("center", "radius")
    type: Literal["sphere"] = "sphere"
    center: units.Position
    """center [m]"""
    radius: Annotated[units.Length, Field(gt=0.0)]
    """radius [m]"""

    if TYPE_CHECKING:

        def __init__(self, center: units.VectorLike, radius: units.Number) -> None: ...


class Plane(_Selection):
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


class Nodes(_Selection):
    """Nodes by their numbers in the mesh, from 0."""

    positional: ClassVar[tuple[str, ...]] = ("ids",)
    type: Literal["nodes"] = "nodes"
    ids: _Nodes
    """numbers of the nodes, from 0"""

    if TYPE_CHECKING:

        def __init__(self, ids: Sequence[int] | units.VectorLike) -> None: ...


class SurfaceNodes(_Selection):
    """All nodes of the body's boundary surface."""

    type: Literal["surface"] = "surface"


class Region(_Selection):
    """Nodes of the cells of a region that the mesh names."""

    positional: ClassVar[tuple[str, ...]] = ("name",)
    type: Literal["region"] = "region"
    name: Annotated[str, BeforeValidator(_named)]
    """name of a region of the mesh"""

    if TYPE_CHECKING:

        def __init__(self, name: str) -> None: ...


Selection = Box | Sphere | Plane | Nodes | SurfaceNodes | Region
On = Annotated[Selection, one_of(Box, Sphere, Plane, Nodes, SurfaceNodes, Region)]

NamedSelections = Annotated[dict[str, On], BeforeValidator(named_texts)]
"""selections by the names of the regions that they make"""
