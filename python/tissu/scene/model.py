"""Models: what carries the elasticity of a body's cells. `tissu info --models` compares them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import Field, PlainValidator, TypeAdapter, ValidationInfo

from tissu import units
from tissu.errors import ParameterError
from tissu.scene.part import Part, chosen, keeps_problems
from tissu.scene.problem import Problem
from tissu.scene.unknown import Unread


class FEM(Part):
    """Continuum elements: any law, any element; what is computed where no model is named."""

    type: Literal["fem"] = "fem"


class Corotational(Part):
    """Hooke's law in axes that turn with each cell: any rotation, small strain (3-D cells)."""

    type: Literal["corotational"] = "corotational"
    rotation: Literal["polar", "frame", "small"] = "polar"
    """the turned axes: of the polar decomposition, of a cell's edges, or none (small rotations)"""
    tangent: Literal["approximate", "exact"] = "approximate"
    """R K R^T, never indefinite, or the true derivative of the force"""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            rotation: Literal["polar", "frame", "small"] = ...,
            tangent: Literal["approximate", "exact"] = ...,
        ) -> None: ...


class MassSpring(Part):
    """Springs on the edges of tetrahedra (Van Gelder's rule); Poisson's ratio is not used."""

    type: Literal["mass-spring"] = "mass-spring"
    masses: Literal["volume", "equal"] = "volume"
    """the mass of a node: of the volume around it, or the same for all"""

    if TYPE_CHECKING:

        def __init__(self, *, masses: Literal["volume", "equal"] = ...) -> None: ...


class MassLink(Part):
    """Extended mass-link (HEML): the continuum tetrahedron, in squared edge lengths."""

    type: Literal["mass-link"] = "mass-link"


class MassTensor(Part):
    """Mass-tensor: the expanded polynomial on nodes, edges, faces and tetrahedra."""

    type: Literal["mass-tensor"] = "mass-tensor"


class MeanDilatation(Part):
    """Continuum cells of first order that share their change of volume: they do not lock."""

    type: Literal["mean-dilatation"] = "mean-dilatation"


class Condensed(Part):
    """Hooke's law with inner nodes eliminated once: small displacements, few unknowns."""

    type: Literal["condensed"] = "condensed"
    keep: Literal["touched", "surface"] = "touched"
    """what stays unknown: nodes held, led, loaded or shared with others, or the surface too"""

    if TYPE_CHECKING:

        def __init__(self, *, keep: Literal["touched", "surface"] = ...) -> None: ...


class Frames(Part):
    """Nodes that are frames of six degrees of freedom; any law on volumes, sheets and lines."""

    type: Literal["frames"] = "frames"
    tangent: Literal["full", "material"] = "full"
    """the derivative of the force, or its part dE : C : dE, never indefinite (as published)"""
    section: Literal["whole", "middle"] = "whole"
    """points of sheets and lines: through the section, which resists bending and twist, or on its
    middle only, as published
    """

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            tangent: Literal["full", "material"] = ...,
            section: Literal["whole", "middle"] = ...,
        ) -> None: ...


class Shell(Part):
    """Triangles that bend, six degrees of freedom at each node; Hooke's law, any rotation."""

    type: Literal["shell"] = "shell"
    drilling: Annotated[units.Pure, Field(gt=0.0)] = 1.0
    """share of the higher-order stiffness of rotations about the normal: 1 is the optimal triangle
    in its plane; 0.01 lets coarse cells of hollow organs bend, a strip one cell wide too easily
    """

    if TYPE_CHECKING:

        def __init__(self, *, drilling: units.Number = ...) -> None: ...


MODELS: tuple[type[Part], ...] = (
    *(FEM, Corotational, MassSpring, MassLink, MassTensor),
    *(Condensed, MeanDilatation, Frames, Shell),
)
Model = (
    FEM
    | Corotational
    | MassSpring
    | MassLink
    | MassTensor
    | Condensed
    | MeanDilatation
    | Frames
    | Shell
)

WITH_ROTATIONS: tuple[type[Part], ...] = (Frames, Shell)
"""models whose nodes have a rotation beside their place"""


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


ModelOrMap = Annotated[Model | dict[str, Model], PlainValidator(_model_or_map)]
