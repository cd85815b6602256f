"""Connective tissue: frames and points without a mesh, inside a surface or between two bodies."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, Literal

from pydantic import Field, PlainValidator, ValidationInfo

from tissu import units
from tissu.reading import Maybe, Read
from tissu.scene.body import MeshLike, mesh_source
from tissu.scene.effect import Effect
from tissu.scene.field import field
from tissu.scene.generated.laws import Hooke
from tissu.scene.laws import OneLaw
from tissu.scene.part import Part
from tissu.scene.problem import Problem
from tissu.scene.selection import On
from tissu.scene.unknown import rule

__all__ = ["Tissue"]

ShapeName = Literal[
    "shepard", "wendland", "cubic_spline", "linear", "trilinear", "moving_least_squares"
]
Count = Annotated[int, Field(ge=1)]


def _inside(value: Any, info: ValidationInfo) -> Any:
    return None if value is None else mesh_source(value, info)


class Tissue(Part):
    """Soft tissue made of frames and integration points; it connects the bodies on both sides.

    Frames have six degrees of freedom. Points listen to the frames near them, and, between two
    bodies, to the nodes of these: nodes with a rotation are frames of the tissue too, others carry
    it by the cells they belong to.
    """

    between: tuple[str, str] | None = None
    """names of two bodies that it ties together; this, `inside` or both"""
    inside: Annotated[Read[Any, MeshLike | None], PlainValidator(_inside)] = field(default=None)
    """a mesh whose closed surface it fills: a file, a bar or (in Python) a Mesh; together with
    `between`, it is attached to the nodes of the two bodies that lie inside
    """
    reach: Maybe[units.Length] = field(default=None, gt=0.0)
    """longest distance between the two bodies that it fills [m]; not together with `inside`"""
    on: tuple[On, On] | None = None
    """which nodes of the two bodies it may hold; absent: all within reach"""
    frames: Count
    """approximate number of its own frames"""
    points: Count
    """approximate number of its integration points"""
    sampling: Literal["poisson", "grid"] = "poisson"
    """how frames and points are placed: as far from each other as possible, or on a regular grid"""
    seed: Annotated[int, Field(ge=0)] = 0
    """seed of the Poisson sampling"""
    shape: ShapeName = "shepard"
    """shape function, which gives the points their weights of frames"""
    neighbours: Count | None = None
    """frames that a point follows; absent: the number of the shape function"""
    law: OneLaw
    """the material's law"""
    density: Maybe[units.Density] = field(default=None, gt=0.0)
    """density [kg/m^3]; this or `mass`"""
    mass: Maybe[units.Mass] = field(default=None, gt=0.0)
    """total mass [kg]; this or `density`"""
    tangent: Literal["full", "material"] = "full"
    """the derivative of the force, or its part that is never indefinite, as published"""

    @rule("between", "inside", "reach", "on")
    def _has_a_place(self) -> Iterator[Problem]:
        if self.between is None and self.inside is None:
            yield Problem((), "found neither between nor inside; one of them or both are accepted")
        if self.between is None and not (self.reach is None and self.on is None):
            yield Problem((), "found reach or on without between; they are accepted with it")
        if self.between is not None and (self.reach is None) == (self.inside is None):
            found = "neither" if self.reach is None else "both"
            text = f"found between with {found} of reach (the longest way from one body to the "
            yield Problem((), f"{text}other, such as 2 cm) and inside; one of them is accepted")
        if self.between is not None and self.between[0] == self.between[1]:
            yield Problem(("between",), f"found '{self.between[0]}' twice; two bodies are accepted")

    @rule("density", "mass")
    def _one_of_density_and_mass(self) -> Iterator[Problem]:
        if (self.density is None) == (self.mass is None):
            found = "neither" if self.density is None else "both"
            text = f"found {found} of density and mass; exactly one of them is accepted"
            yield Problem((), text)

    def effects(self, name: str) -> Iterator[Effect]:
        """What tissue of this name switches on."""
        ends = self.between
        place = "inside a surface" if ends is None else "between " + " and ".join(ends)
        size = f"of about {self.frames} frames and {self.points} points"
        yield Effect(f"connective tissue {name}", f"tissue.{name} is {place}, {size}")
        small = ", for small turns only" if isinstance(self.law, Hooke) else ""
        yield Effect(f"elasticity of {name}", f"tissue.{name}.law is {self.law.words()}{small}")


def is_tied(scene: Any, first: str, second: str) -> bool:
    """Whether one of two is a tissue that is attached to the other."""
    tissues = tissues_of(scene)
    return any(
        one in tissues and other in (tissues[one].between or ())
        for one, other in ((first, second), (second, first))
    )


def tissues_of(scene: Any) -> Mapping[str, Tissue]:
    """The tissues of a scene by name, whose fields may have problems."""
    found: Mapping[str, Tissue] = getattr(scene, "tissue", {})
    return found
