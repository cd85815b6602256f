"""Convex obstacles beside balls, rods and boxes: cylinders, cones, ellipsoids, hulls of points."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, PlainValidator, ValidationInfo

from tissu import units
from tissu.counted import counted
from tissu.errors import ParameterError
from tissu.reading import Read, VectorLike, listed, written
from tissu.scene.body import MeshFile, MeshLike, mesh_source
from tissu.scene.effect import vector_in_words
from tissu.scene.field import field
from tissu.scene.obstacle_part import POSITION, Ends, Obstacle, ends_of
from tissu.scene.problem import Problem
from tissu.scene.unknown import rule

__all__ = ["CylinderObstacle", "ConeObstacle", "EllipsoidObstacle", "ConvexObstacle"]

_Point = tuple[float, float, float]


class _Faceted(Obstacle):
    """A round shape whose surface in contact is made of triangles."""

    @rule("mass")
    def _does_not_roll(self) -> Iterator[Problem]:
        if self.mass is not None:
            text = f"found {self.mass:g} kg for the {self.type}, whose surface has triangles, on "
            text += (
                "whose edges it would roll with a loss; a capsule, a sphere or convex is accepted"
            )
            yield Problem(("mass",), text)


class CylinderObstacle(_Faceted):
    """A rod with flat ends."""

    type: Literal["cylinder"] = "cylinder"
    ends: Annotated[Read[Ends, Sequence[VectorLike]], BeforeValidator(ends_of)] = field(
        kw_only=False
    )
    """middles of both end faces [m]"""
    radius: units.Length = field(gt=0.0, kw_only=False)
    """radius [m]"""

    @rule("ends")
    def _has_a_length(self) -> Iterator[Problem]:
        if self.ends[0] == self.ends[1]:
            yield Problem(("ends",), "found the same point twice; two points apart are accepted")

    def words(self) -> str:
        """Its shape and numbers, as `check` says them."""
        return f"cylinder, radius {self.radius:g} m"


class ConeObstacle(_Faceted):
    """A circular cone with a flat base."""

    type: Literal["cone"] = "cone"
    base: units.Position = field(kw_only=False)
    """middle of the base [m]"""
    tip: units.Position = field(kw_only=False)
    """tip [m]"""
    radius: units.Length = field(gt=0.0, kw_only=False)
    """radius of the base [m]"""

    @rule("base", "tip")
    def _has_a_height(self) -> Iterator[Problem]:
        if self.base == self.tip:
            text = "found a tip in the middle of the base; two points apart are accepted"
            yield Problem(("tip",), text)

    def words(self) -> str:
        """Its shape and numbers, as `check` says them."""
        return f"cone, radius {self.radius:g} m"


def _radii(value: object) -> object:
    value = listed(value)
    if not isinstance(value, (list, tuple)) or len(value) != 3:
        text = "three lengths along x, y and z are accepted, such as [1 cm, 1 cm, 3 cm]"
        raise ParameterError(f"found {written(value)}; {text}")
    found: Any = POSITION(value)
    if not min(found) > 0.0:
        raise ParameterError(f"found {written(value)}; lengths above zero are accepted")
    return found


class EllipsoidObstacle(_Faceted):
    """An ellipsoid whose axes lie along x, y and z at rest; its motion may rotate it."""

    type: Literal["ellipsoid"] = "ellipsoid"
    center: units.Position = field(kw_only=False)
    """center [m]"""
    radii: Annotated[Read[_Point, VectorLike], BeforeValidator(_radii)] = field(kw_only=False)
    """half of its lengths along x, y and z [m]"""

    def words(self) -> str:
        """Its shape and numbers, as `check` says them."""
        return f"ellipsoid, radii {vector_in_words(self.radii)} m"


def _points(value: object) -> object:
    value = listed(value)
    if value is None:
        return None
    if not isinstance(value, (list, tuple)) or len(value) < 4:
        text = "four points or more are accepted, such as [[0, 0, 0], [1 cm, 0, 0], ...]"
        raise ParameterError(f"found {written(value)}; {text}")
    return tuple(POSITION(point) for point in value)


def _mesh(value: Any, info: ValidationInfo) -> Any:
    return None if value is None else mesh_source(value, info)


class ConvexObstacle(Obstacle):
    """The convex hull of points, or of the points of a mesh."""

    type: Literal["convex"] = "convex"
    points: Annotated[
        Read[tuple[_Point, ...] | None, Sequence[VectorLike] | None], BeforeValidator(_points)
    ] = field(default=None)
    """points [m], four or more that do not lie in one plane; this or `mesh`"""
    mesh: Annotated[Read[Any, MeshLike | None], PlainValidator(_mesh)] = field(default=None)
    """a mesh file, a bar, or (in Python) a Mesh, whose points are taken; this or `points`"""

    @rule("points", "mesh")
    def _has_one_of_points_and_mesh(self) -> Iterator[Problem]:
        if (self.points is None) == (self.mesh is None):
            found = "neither" if self.points is None else "both"
            yield Problem((), f"found {found} of points and mesh; exactly one of them is accepted")

    def words(self) -> str:
        """Its shape and numbers, as `check` says them."""
        if self.points is not None:
            return f"hull of {counted(len(self.points), 'point')}"
        return f"hull of {self.mesh.file}" if isinstance(self.mesh, MeshFile) else "hull of a mesh"
