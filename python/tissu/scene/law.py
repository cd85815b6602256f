"""Laws of the material and viscosity, as a scene names them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import Field, PlainValidator, TypeAdapter, ValidationInfo, model_validator
from typing_extensions import Self

from tissu import units
from tissu.errors import ParameterError
from tissu.scene.part import Part, chosen, one_of


class _Isotropic(Part):
    """What Hooke and St. Venant-Kirchhoff share: Young's modulus and Poisson's ratio."""

    young: Annotated[units.Pressure, Field(gt=0.0)]
    """Young's modulus [Pa], such as '4 kPa'"""
    poisson: Annotated[
        units.Pure,
        units.within(-1.0, 0.5, hint="take 0.45 to 0.49 for tissue that hardly changes volume"),
    ]
    """Poisson's ratio, between -1 and 0.5, both excluded"""


class Hooke(_Isotropic):
    """Linear elasticity: small strains and small rotations only."""

    type: Literal["hooke"] = "hooke"

    if TYPE_CHECKING:

        def __init__(self, *, young: units.Number, poisson: units.Number) -> None: ...


class StVK(_Isotropic):
    """St. Venant-Kirchhoff: any rotation, moderate strain; breaks down under strong compression."""

    type: Literal["stvk"] = "stvk"

    if TYPE_CHECKING:

        def __init__(self, *, young: units.Number, poisson: units.Number) -> None: ...


class Rayleigh(Part):
    """Viscosity proportional to mass and stiffness: C = mass M + stiffness K."""

    type: Literal["rayleigh"] = "rayleigh"
    mass: Annotated[units.Rate, Field(ge=0.0)] = 0.0
    """share of the mass matrix [1/s]"""
    stiffness: Annotated[units.Time, Field(ge=0.0)] = 0.0
    """share of the stiffness matrix [s]"""

    if TYPE_CHECKING:

        def __init__(self, *, mass: units.Number = ..., stiffness: units.Number = ...) -> None: ...

    @model_validator(mode="after")
    def _some(self) -> Self:
        if not (self.mass or self.stiffness):
            raise ParameterError("found no mass and no stiffness; leave viscosity out to have none")
        return self


LAWS: tuple[type[Part], ...] = (Hooke, StVK)
Law = Hooke | StVK
OneLaw = Annotated[Law, one_of(*LAWS)]


@lru_cache(maxsize=1)
def _region_laws() -> TypeAdapter[dict[str, Law]]:
    return TypeAdapter(dict[str, OneLaw])


def _law_or_map(value: Any, info: ValidationInfo) -> Any:
    """A law, or a map from the mesh's regions to laws."""
    if not isinstance(value, Mapping) or "type" in value:
        return chosen(value, LAWS, info)
    if not value or not all(isinstance(part, (Mapping, *LAWS)) for part in value.values()):
        return chosen(value, LAWS, info)  # says that `type` is missing
    laws = {str(name): law for name, law in value.items()}  # YAML reads a region 7 as a number
    return _region_laws().validate_python(laws, context=info.context)


LawOrMap = Annotated[Law | dict[str, Law], PlainValidator(_law_or_map)]
