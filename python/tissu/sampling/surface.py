"""A closed surface that knows its inside."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from tissu.errors import MeshError
from tissu.mesh import Mesh
from tissu.mesh.cell import Floats, Ints
from tissu.mesh.surface import enclosed_volume
from tissu.sampling.closed import require_closed, require_triangles
from tissu.sampling.columns import Columns
from tissu.sampling.nearest import TriangleTree
from tissu.sampling.region import Bools, positions


@dataclass(frozen=True, eq=False)
class Surface:
    """A closed surface of triangles, anticlockwise seen from outside; it may have several parts.

    Attributes:
        points: positions (n, 3) float64 [m], read-only; some may belong to no triangle.
        triangles: node numbers (t, 3) int32, read-only.

    Raises:
        MeshError: no triangles, open edges, triangles wound against each other or inwards.
    """

    points: Floats
    triangles: Ints

    def __post_init__(self) -> None:
        points = np.array(self.points, dtype=np.float64, order="C")
        triangles = np.array(self.triangles, dtype=np.int32, order="C")
        require_triangles(points, triangles)
        require_closed(points, triangles)
        for name, array in (("points", points), ("triangles", triangles)):
            array.flags.writeable = False
            object.__setattr__(self, name, array)

    @classmethod
    def of(cls, mesh: Mesh) -> Surface:
        """The outer surface of a mesh's volume cells, or its faces where it has no volume.

        Nodes keep their numbers.

        Raises:
            MeshError: as the class.
        """
        solid = dataclasses.replace(mesh, thin=(), regions={}, border_regions={})
        triangles = solid.surface().triangles
        if not len(triangles):
            raise MeshError(f"found {mesh!r} without volume cells and faces; a body is accepted")
        return cls(mesh.points, triangles)

    @cached_property
    def volume(self) -> float:
        """Volume inside [m3]: a third of the flux of x (divergence theorem)."""
        return enclosed_volume(self.points, self.triangles)

    @cached_property
    def bounds(self) -> Floats:
        """Smallest and largest coordinates (2, 3) [m] of the triangles."""
        used = self.points[self.triangles].reshape(-1, 3)
        return np.array([used.min(axis=0), used.max(axis=0)])

    @cached_property
    def _columns(self) -> Columns:
        return Columns(self.points, self.triangles)

    @cached_property
    def tree(self) -> TriangleTree:
        """The triangles, ready to be asked which of their points is nearest."""
        return TriangleTree(self.points[self.triangles])

    def inside(self, points: ArrayLike) -> Bools:
        """Whether each of the points (n, 3) [m] is inside: (n,).

        Points on the surface, to 1e-9 of the diagonal of its bounds, are inside.

        Raises:
            ParameterError: points of another shape, or not finite.
        """
        return self._columns.inside(positions(points))

    def nearest(self, points: ArrayLike) -> Floats:
        """The points of the surface (n, 3) [m] nearest to points (n, 3) [m].

        Raises:
            ParameterError: points of another shape, or not finite.
        """
        return self.tree.nearest(positions(points))[0]

    def distance(self, points: ArrayLike) -> Floats:
        """Distance (n,) [m] of points (n, 3) [m] to the surface, from inside and outside alike.

        Raises:
            ParameterError: points of another shape, or not finite.
        """
        return self.tree.nearest(positions(points))[1]

    def __repr__(self) -> str:
        """Number of triangles and volume."""
        return f"Surface({len(self.triangles)} triangles, {self.volume:.4g} m3)"
