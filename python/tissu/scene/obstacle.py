"""Obstacles: rigid things that bodies meet, at rest, led along a path, or free."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, PlainValidator, ValidationInfo

from tissu import units
from tissu.errors import ParameterError
from tissu.reading import Read, VectorLike
from tissu.scene.body import MeshFile, MeshLike, mesh_source
from tissu.scene.convex_obstacle import (
    ConeObstacle,
    ConvexObstacle,
    CylinderObstacle,
    EllipsoidObstacle,
)
from tissu.scene.effect import vector_in_words
from tissu.scene.field import field
from tissu.scene.obstacle_part import Ends, Obstacle, ends_of
from tissu.scene.part import chosen, keeps_problems, type_name
from tissu.scene.problem import Problem
from tissu.scene.selection import Selection
from tissu.scene.unknown import Unread, rule

__all__ = [
    "PlaneObstacle",
    "SphereObstacle",
    "CapsuleObstacle",
    "BoxObstacle",
    "MeshObstacle",
]


class PlaneObstacle(Obstacle):
    """Half of space: everything behind the plane through `point` across `normal` is solid."""

    type: Literal["plane"] = "plane"
    point: units.Position = field(kw_only=False)
    """a point of the plane [m]; it moves with the plane, and moments are taken about it"""
    normal: units.Direction = field(kw_only=False)
    """direction out of the solid half, of any length but zero"""

    @rule("normal")
    def _has_normal(self) -> Iterator[Problem]:
        if not any(self.normal):
            text = "found the normal (0, 0, 0); a direction is accepted, such as [0, 0, 1]"
            yield Problem(("normal",), text)

    @rule("mass")
    def _has_no_mass(self) -> Iterator[Problem]:
        if self.mass is not None:
            text = f"found {self.mass:g} kg for a plane, which has no end; leave mass out, or take "
            yield Problem(("mass",), f"{text}a box")

    def words(self) -> str:
        """Its shape and numbers, as `check` says them."""
        through = vector_in_words(self.point)
        return f"plane through {through} m across {vector_in_words(self.normal)}"


class SphereObstacle(Obstacle):
    """A ball."""

    type: Literal["sphere"] = "sphere"
    center: units.Position = field(kw_only=False)
    """center [m]"""
    radius: units.Length = field(gt=0.0, kw_only=False)
    """radius [m]"""

    def words(self) -> str:
        """Its shape and numbers, as `check` says them."""
        return f"sphere, radius {self.radius:g} m"


class CapsuleObstacle(Obstacle):
    """A rod with round ends: all points nearer than `radius` to the line between its ends."""

    type: Literal["capsule"] = "capsule"
    ends: Annotated[Read[Ends, Sequence[VectorLike]], BeforeValidator(ends_of)] = field(
        kw_only=False
    )
    """both ends of its axis [m]; it reaches `radius` beyond them"""
    radius: units.Length = field(gt=0.0, kw_only=False)
    """radius [m]"""

    @rule("ends")
    def _has_a_length(self) -> Iterator[Problem]:
        if self.ends[0] == self.ends[1]:
            text = "found the same point twice; two points apart are accepted, or a sphere"
            yield Problem(("ends",), text)

    def words(self) -> str:
        """Its shape and numbers, as `check` says them."""
        return f"capsule, radius {self.radius:g} m"


class BoxObstacle(Obstacle):
    """A solid box along the axes; its motion may rotate it."""

    type: Literal["box"] = "box"
    min: units.Position = field(kw_only=False)
    """smallest corner [m]"""
    max: units.Position = field(kw_only=False)
    """largest corner [m]"""

    @rule("min", "max")
    def _has_a_volume(self) -> Iterator[Problem]:
        for axis, low, high in zip("xyz", self.min, self.max, strict=True):
            if not low < high:
                text = f"found min {low:g} m and max {high:g} m on axis {axis}"
                yield Problem((), f"{text}; a max above min is accepted")

    def words(self) -> str:
        """Its shape and numbers, as `check` says them."""
        return f"box from {vector_in_words(self.min)} to {vector_in_words(self.max)} m"


class MeshObstacle(Obstacle):
    """A surface: the faces of a mesh of triangles and quads, or the boundary of its volume."""

    type: Literal["mesh"] = "mesh"
    mesh: Annotated[Read[Any, MeshLike], PlainValidator(mesh_source)] = field(kw_only=False)
    """a mesh file, a bar, or (in Python) a Mesh; bodies touch a closed one from outside, an open
    one from both sides
    """

    def words(self) -> str:
        """Its shape and numbers, as `check` says them."""
        return f"mesh, {self.mesh.file}" if isinstance(self.mesh, MeshFile) else "mesh"


OBSTACLES: tuple[type[Obstacle], ...] = (
    *(PlaneObstacle, SphereObstacle, CapsuleObstacle),
    *(BoxObstacle, MeshObstacle),
    *(CylinderObstacle, ConeObstacle, EllipsoidObstacle, ConvexObstacle),
)


def _one_obstacle(value: Any, info: ValidationInfo) -> Any:
    """An obstacle: in Python by class, in YAML by its `type`."""
    try:
        if isinstance(value, Selection):
            raise ParameterError(_of_selection(value))
        return chosen(value, OBSTACLES, info)
    except ParameterError as error:
        if not keeps_problems(info):
            raise
        return Unread((Problem((), str(error)),))


def _of_selection(value: Selection) -> str:
    """What is said of ts.Sphere and the like, which select nodes."""
    known = {type_name(cls): cls.__name__ for cls in OBSTACLES}
    found = f"found {type(value).__name__}, which selects nodes"
    return f"{found}; an obstacle is accepted: {known.get(value.type, ', '.join(known.values()))}"


OneObstacle = Annotated[Obstacle, PlainValidator(_one_obstacle)]
Obstacles = Read[dict[str, OneObstacle], Mapping[str, Obstacle]]
