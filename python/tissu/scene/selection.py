"""Selections: which nodes of a body something acts on, by their rest positions or by name."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, Field

from tissu import units
from tissu.errors import ParameterError
from tissu.reading import Maybe, Read, VectorLike, listed
from tissu.scene.direction import unit_vector
from tissu.scene.field import field
from tissu.scene.part import Part, one_of
from tissu.scene.problem import Problem, nearest, one_of_words
from tissu.scene.unknown import rule

if TYPE_CHECKING:
    from tissu.mesh import Mesh

__all__ = ["Box", "Sphere", "Plane", "Nodes", "SurfaceNodes", "Region"]

Ints = NDArray[np.int32]
Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

_SLACK = 1e-9
"""share of the body's diagonal that counts as on the border, for round-off in coordinates"""


class Selection(Part):
    """The common part of all selections.

    Attributes:
        by_place: whether nodes are selected by their positions, so that the unit of lengths counts.
    """

    by_place: ClassVar[bool] = False
    if TYPE_CHECKING:
        type: str

    def nodes(self, mesh: Mesh) -> Ints:
        """Numbers (k,) of the selected nodes, increasing.

        Raises:
            ParameterError: a region that the mesh lacks, or node numbers beyond the mesh.
        """
        raise NotImplementedError

    def cells(self, mesh: Mesh) -> Ints:
        """Numbers (k,) of the cells of which every node is selected, across `mesh.body_blocks`.

        Of a box, a sphere or a plane the cells whose centres, the means of their nodes, lie in it;
        of a region its cells.

        Raises:
            ParameterError: a region that the mesh lacks, or node numbers beyond the mesh.
        """
        chosen = np.zeros(mesh.node_count, dtype=bool)
        chosen[self.nodes(mesh)] = True
        return _where(mesh, lambda nodes: np.asarray(chosen[nodes].all(axis=1)))

    def words(self, count: str | None) -> str:
        """What it selects, as `check` says it; `count` where it is known ("42 nodes")."""
        return f"{count} ({self.type})" if count else f"the nodes of a selection ({self.type})"


class _Place(Selection):
    """Nodes by their rest positions; a blade or a region of present space too."""

    by_place: ClassVar[bool] = True
    of_scene: ClassVar[bool] = False

    def nodes(self, mesh: Mesh) -> Ints:
        """Numbers (k,) of the nodes in the place, increasing."""
        inside = self._inside(mesh.points, diagonal(mesh))
        return np.flatnonzero(inside).astype(np.int32)

    def cells(self, mesh: Mesh) -> Ints:
        """Numbers (k,) of the cells whose centres lie in the place."""
        size = diagonal(mesh)
        return _where(mesh, lambda nodes: self._inside(mesh.points[nodes].mean(axis=1), size))

    def _inside(self, points: Floats, size: float) -> Bools:
        """Whether points (n, 3) of a body with this diagonal [m] are in the place."""
        raise NotImplementedError


class Box(_Place):
    """Nodes in a box along the axes, faces included; null (None) on an axis means unbounded."""

    type: Literal["box"] = "box"
    min: units.OpenPosition = field(default=(None, None, None), kw_only=False)
    """smallest corner [m]"""
    max: units.OpenPosition = field(default=(None, None, None), kw_only=False)
    """largest corner [m]"""

    @rule("min", "max")
    def _ordered(self) -> Iterator[Problem]:
        for axis, low, high in zip("xyz", self.min, self.max, strict=True):
            if low is not None and high is not None and low > high:
                found = f"found min {low:g} m above max {high:g} m on axis {axis}"
                yield Problem((), f"{found}; exchange them")

    def _inside(self, points: Floats, size: float) -> Bools:
        slack = _SLACK * size
        low = np.array([-np.inf if x is None else x for x in self.min])
        high = np.array([np.inf if x is None else x for x in self.max])
        return np.asarray(((points >= low - slack) & (points <= high + slack)).all(axis=1))


class Sphere(_Place):
    """Nodes no farther than `radius` from `center`."""

    type: Literal["sphere"] = "sphere"
    center: units.Position = field(kw_only=False)
    """center [m]"""
    radius: units.Length = field(gt=0.0, kw_only=False)
    """radius [m]"""

    def _inside(self, points: Floats, size: float) -> Bools:
        x, y, z = (points - self.center).T
        return np.asarray(np.hypot(np.hypot(x, y), z) <= self.radius + _SLACK * size)


class Plane(_Place):
    """Nodes within `tolerance` of the plane through `point` across `normal`."""

    type: Literal["plane"] = "plane"
    point: units.Position = field(kw_only=False)
    """a point of the plane [m]"""
    normal: units.Direction = field(kw_only=False)
    """normal of the plane, of any length but zero"""
    tolerance: Maybe[units.Length] = field(default=None, ge=0.0, kw_only=False)
    """largest distance [m]; when absent, a millionth of the body's diagonal"""

    @rule("normal")
    def _has_normal(self) -> Iterator[Problem]:
        if not any(self.normal):
            text = "found the normal (0, 0, 0); a direction is accepted, such as [0, 0, 1]"
            yield Problem((), text)

    def _inside(self, points: Floats, size: float) -> Bools:
        normal = unit_vector(self.normal)
        tolerance = 1e-6 * size if self.tolerance is None else self.tolerance + _SLACK * size
        return np.asarray(np.abs((points - self.point) @ normal) <= tolerance)


_Numbers = Read[tuple[Annotated[int, Field(ge=0)], ...], Sequence[int] | VectorLike]


class Nodes(Selection):
    """Nodes by their numbers in the mesh, from 0."""

    type: Literal["nodes"] = "nodes"
    ids: Annotated[_Numbers, BeforeValidator(listed)] = field(kw_only=False)
    """numbers of the nodes, from 0"""

    def nodes(self, mesh: Mesh) -> Ints:
        """The numbers (k,), each once, increasing.

        Raises:
            ParameterError: a number beyond the mesh.
        """
        ids = np.unique(np.asarray(self.ids, dtype=np.int64))
        beyond = ids[ids >= mesh.node_count]
        if beyond.size:
            raise ParameterError(
                f"found node {beyond[0]}; the mesh has the nodes 0 to {mesh.node_count - 1}"
            )
        return ids.astype(np.int32)


class SurfaceNodes(Selection):
    """All nodes of the body's boundary surface."""

    type: Literal["surface"] = "surface"

    def nodes(self, mesh: Mesh) -> Ints:
        """Numbers (k,) of the surface's nodes, increasing."""
        return np.unique(mesh.surface().triangles).astype(np.int32)


def _named(value: object) -> object:
    """A region that the mesh numbers, such as 7, by its name "7"."""
    return str(value) if isinstance(value, int) and not isinstance(value, bool) else value


class Region(Selection):
    """Nodes of the cells of a region that the mesh names."""

    type: Literal["region"] = "region"
    name: Annotated[str, BeforeValidator(_named)] = field(kw_only=False)
    """name of a region of the mesh"""

    def nodes(self, mesh: Mesh) -> Ints:
        """Numbers (k,) of the nodes of the region's cells, increasing.

        Raises:
            ParameterError: the mesh has no region of this name.
        """
        cells = region_cells(self.name, mesh)
        nodes, first = [], 0
        for block in mesh.body_blocks:
            inside = cells[(cells >= first) & (cells < first + len(block.nodes))] - first
            nodes.append(np.asarray(block.nodes)[inside].ravel())
            first += len(block.nodes)
        return np.unique(np.concatenate(nodes)).astype(np.int32)

    def cells(self, mesh: Mesh) -> Ints:
        """Numbers (k,) of the region's cells, increasing.

        Raises:
            ParameterError: the mesh has no region of this name.
        """
        return region_cells(self.name, mesh)


def _where(mesh: Mesh, chosen: Callable[[Ints], Bools]) -> Ints:
    """Numbers of the cells whose nodes (e, k) are chosen, across the simulated blocks."""
    found = [np.zeros(0, dtype=bool), *(chosen(block.nodes) for block in mesh.body_blocks)]
    return np.flatnonzero(np.concatenate(found)).astype(np.int32)


def region_cells(name: str, mesh: Mesh) -> Ints:
    """Numbers of the cells of a region, across the volume blocks.

    Raises:
        ParameterError: the mesh has no region of this name.
    """
    if name in mesh.regions:
        return np.asarray(mesh.regions[name])
    if not mesh.regions:
        raise ParameterError(f"found region '{name}', but the mesh names no regions")
    raise ParameterError(
        f"the mesh has no region '{name}'{nearest(name, mesh.regions)} "
        f"Regions: {one_of_words(mesh.regions)}"
    )


def diagonal(mesh: Mesh) -> float:
    """Length of the diagonal of the mesh's bounds [m]."""
    return float(np.linalg.norm(mesh.bounds[1] - mesh.bounds[0]))


SELECTIONS: tuple[type[Selection], ...] = (Box, Sphere, Plane, Nodes, SurfaceNodes, Region)
On = Annotated[Selection, one_of(*SELECTIONS)]


def _by_text(value: object) -> object:
    """Selections by text: YAML reads the name 7 as a number."""
    if not isinstance(value, Mapping):
        return value
    return {str(name) if isinstance(name, int) else name: on for name, on in value.items()}


_Named = Read[dict[str, On], Mapping[str, Selection]]
NamedSelections = Annotated[_Named, BeforeValidator(_by_text)]
"""selections by the names of the regions that they make"""
