"""Obstacles: rigid things that bodies meet, at rest, led along a path, or free."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BeforeValidator, PlainValidator, ValidationInfo

from tissu import units
from tissu.errors import ParameterError
from tissu.reading import Maybe, MaybeVector, Read, VectorLike, listed, written
from tissu.scene.body import MeshFile, MeshLike, mesh_source
from tissu.scene.effect import Effect, vector_in_words
from tissu.scene.field import field
from tissu.scene.motion import Motion
from tissu.scene.part import Part, chosen, keeps_problems, type_name
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

_POSITION = units.Triple(units.LENGTH)


class Obstacle(Part):
    """The common part of all obstacles."""

    motion: Motion | None = None
    """its prescribed path; absent: it stands still"""
    mass: Maybe[units.Mass] = field(default=None, gt=0.0)
    """mass [kg], of uniform density, of an obstacle that moves freely; absent: it follows its path,
    or stands still
    """
    velocity: MaybeVector[units.Velocity] = field(default=None)
    """velocity at the start [m/s] of an obstacle with a mass; absent: zero"""
    spin: MaybeVector[units.Spin] = field(default=None)
    """angular velocity at the start about the centre of mass [rad/s] of an obstacle with a mass;
    absent: zero
    """
    if TYPE_CHECKING:
        type: str

    @rule("mass", "motion")
    def _is_led_or_free(self) -> Iterator[Problem]:
        if self.mass is not None and self.motion is not None:
            text = f"found {self.mass:g} kg with `motion`; an obstacle with a mass moves freely, "
            yield Problem(("mass",), f"{text}one that is led has none: leave one of them out")

    @rule("mass", "velocity", "spin")
    def _moves(self) -> Iterator[Problem]:
        for name in ("velocity", "spin"):
            if getattr(self, name) is not None and self.mass is None:
                text = f"found a {name} without a mass; give the obstacle a mass, so that it moves "
                yield Problem((name,), f"{text}freely, or lead it by `motion`")

    def effect(self, name: str) -> Effect:
        """What an obstacle of this name switches on."""
        led = "" if self.motion is None else f", {self.motion.words()}"
        led += "" if self.mass is None else f", free, mass {self.mass:g} kg"
        return Effect(f"obstacle {name}", f"obstacles.{name} is a {self.words()}{led}")

    def words(self) -> str:
        """Its shape and numbers, as `check` says them."""
        raise NotImplementedError


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


_End = tuple[float, float, float]


def _ends(value: object) -> object:
    value = listed(value)
    if not isinstance(value, (list, tuple)) or len(value) != 2:
        text = "two points are accepted, such as [[0, 0, 0], [0, 0, 5 cm]]"
        raise ParameterError(f"found {written(value)}; {text}")
    return tuple(_POSITION(end) for end in value)


class CapsuleObstacle(Obstacle):
    """A rod with round ends: all points nearer than `radius` to the line between its ends."""

    type: Literal["capsule"] = "capsule"
    ends: Annotated[Read[tuple[_End, _End], Sequence[VectorLike]], BeforeValidator(_ends)] = field(
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
