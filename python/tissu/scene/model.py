"""Models: what carries the elasticity of a body's cells. `tissu info --models` compares them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

from pydantic import PlainValidator, TypeAdapter, ValidationInfo

from tissu import units
from tissu.errors import ParameterError
from tissu.reading import Read
from tissu.scene.field import field
from tissu.scene.part import Part, chosen, keeps_problems
from tissu.scene.problem import Problem
from tissu.scene.selection import Ints
from tissu.scene.unknown import Unread

if TYPE_CHECKING:
    from tissu import _core
    from tissu.scene.step import Step

__all__ = [
    "FEM",
    "Corotational",
    "MassSpring",
    "MassLink",
    "MassTensor",
    "Condensed",
    "MeanDilatation",
    "Frames",
    "Shell",
]


class Model(Part):
    """The common part of all models.

    Attributes:
        with_rotations: whether its nodes have a rotation beside their place.
    """

    with_rotations: ClassVar[bool] = False
    if TYPE_CHECKING:
        type: str

    def words(self) -> str:
        """Its type and options, as `check` says them."""
        fields = self._own_fields()
        words = ", ".join(f"{name} {value}" for name, value in fields.items())
        return self.type + (f" with {words}" if fields else "")

    def in_core(self, kept: Ints, step: Step | None = None) -> _core.Model:
        """The core's model of the same name, with the options that are its own.

        Args:
            kept: nodes (k,) of a condensed region that stay unknown; others do not read them.
            step: how the scene is stepped; only corotational reads it.
        """
        from tissu import _core

        made: _core.Model = getattr(_core, type(self).__name__)(**self._options(kept, step))
        return made

    def _options(self, kept: Ints, step: Step | None) -> dict[str, Any]:
        return self._own_fields()

    def _own_fields(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in type(self).model_fields if name != "type"}


class FEM(Model):
    """Continuum elements: any law, any element; the default."""

    type: Literal["fem"] = "fem"


class Corotational(Model):
    """Hooke's law in axes that turn with each cell: any rotation, small strain (3-D cells)."""

    type: Literal["corotational"] = "corotational"
    rotation: Literal["polar", "frame", "small"] = "polar"
    """the turned axes: of the polar decomposition, of a cell's edges, or none (small rotations)"""
    tangent: Literal["auto", "approximate", "exact"] = "auto"
    """approximate: R K R^T, which is never indefinite; exact: the true derivative of the force;
    auto: exact for polar axes in steps of second order that are linearised once, which would give
    energy to what turns, else approximate"""

    def _options(self, kept: Ints, step: Step | None) -> dict[str, Any]:
        tangent = self.tangent
        if tangent == "auto":
            gains = step is not None and step.second_order and step.is_linearised_once
            tangent = "exact" if gains and self.rotation == "polar" else "approximate"
        return self._own_fields() | {"tangent": tangent}


class MassSpring(Model):
    """Springs on the edges of tetrahedra (Van Gelder's rule); Poisson's ratio is not used."""

    type: Literal["mass_spring"] = "mass_spring"
    masses: Literal["volume", "equal"] = "volume"
    """the mass of a node: of the volume around it, or the same for all"""

    def _options(self, kept: Ints, step: Step | None) -> dict[str, Any]:
        return {"equal_masses": self.masses == "equal"}


class MassLink(Model):
    """Extended mass-link (HEML): the continuum tetrahedron, in squared edge lengths."""

    type: Literal["mass_link"] = "mass_link"


class MassTensor(Model):
    """Mass-tensor: the expanded polynomial on nodes, edges, faces and tetrahedra."""

    type: Literal["mass_tensor"] = "mass_tensor"


LOCKING = 0.45
"""Poisson's ratio from which on it is noted: there a bar of three or four layers of tetrahedra or
wedges bends by 27 to 37 % less than the same cells with mean dilatation, one of hexahedra or
pyramids by 9 to 15 % less; at 0.4 by 17 to 24 and by 5 to 9 %, at 0.49 by 60 to 70 and 25 to 40 %
(docs/measured/mean-dilatation.md)."""


class MeanDilatation(Model):
    """Continuum cells of first order that share their change of volume: they do not lock."""

    type: Literal["mean_dilatation"] = "mean_dilatation"


class Condensed(Model):
    """Hooke's law with inner nodes eliminated once: small displacements, few unknowns."""

    type: Literal["condensed"] = "condensed"
    keep: Literal["touched", "surface"] = "touched"
    """nodes that stay unknowns: those fixed, prescribed, loaded or shared, or the surface as
    well"""

    def _options(self, kept: Ints, step: Step | None) -> dict[str, Any]:
        return {"kept": kept}


Lever = Literal["whole", "half"]


class Frames(Model):
    """Nodes that are frames of six degrees of freedom; any law on volumes, sheets and lines."""

    with_rotations: ClassVar[bool] = True
    type: Literal["frames"] = "frames"
    tangent: Literal["full", "material"] = "full"
    """the derivative of the force, or its part dE : C : dE, never indefinite (as published)"""
    section: Literal["whole", "middle"] = "whole"
    """points of sheets and lines: through the section, which resists bending and twist, or on its
    middle only, as published
    """
    lever: Lever | None = None
    """share of the vector from frame to point that rotates with the frame: whole, as published, or
    half, with which frames rotate as the material does (linked interpolation, for large bending);
    absent: half for sheets and lines whose section is whole, otherwise whole
    """

    def _options(self, kept: Ints, step: Step | None) -> dict[str, Any]:
        return {**self._own_fields(), "lever": self.lever or ""}

    def _own_fields(self) -> dict[str, Any]:
        fields = super()._own_fields()
        return (
            fields if self.lever is not None else {k: v for k, v in fields.items() if k != "lever"}
        )


class Shell(Model):
    """Triangles that bend, six degrees of freedom at each node; Hooke's law, any rotation."""

    with_rotations: ClassVar[bool] = True
    type: Literal["shell"] = "shell"
    drilling: units.Pure = field(default=1.0, gt=0.0)
    """share of the higher-order stiffness of rotations about the normal: 1 is the optimal triangle
    in its plane; 0.01 lets coarse cells of hollow organs bend, a strip one cell wide too easily
    """


MODELS: tuple[type[Model], ...] = (
    *(FEM, Corotational, MassSpring, MassLink, MassTensor),
    *(Condensed, MeanDilatation, Frames, Shell),
)


def _one_model(value: Any, info: ValidationInfo) -> Any:
    """A model: in Python by class; by its name; in YAML also by its `type`."""
    if isinstance(value, str):
        value = {"type": value}
    try:
        return chosen(value, MODELS, info)
    except ParameterError as error:
        if not keeps_problems(info):
            raise
        return Unread((Problem((), str(error)),))


OneModel = Annotated[Model, PlainValidator(_one_model)]


@lru_cache(maxsize=1)
def _region_models() -> TypeAdapter[dict[str, Model]]:
    return TypeAdapter(dict[str, OneModel])


def _model_or_map(value: Any, info: ValidationInfo) -> Any:
    """A model, or a map from the mesh's regions to models."""
    if not isinstance(value, Mapping) or "type" in value or not value:
        return _one_model(value, info)
    models = {str(name): model for name, model in value.items()}
    return _region_models().validate_python(models, context=info.context)


_Models = Read[Model | dict[str, Model], Model | str | Mapping[str, Model | str]]
ModelOrMap = Annotated[_Models, PlainValidator(_model_or_map)]
