"""A body: its mesh, what it is made of, how heavy and how viscous it is."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

from pydantic import (
    BeforeValidator,
    Field,
    PlainValidator,
    ValidationInfo,
    field_validator,
    model_validator,
)
from typing_extensions import Self

from tissu import units
from tissu.errors import ParameterError
from tissu.scene.law import Law, LawOrMap, Rayleigh
from tissu.scene.part import Part, chosen

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tissu.mesh import Mesh

_Count = Annotated[int, Field(ge=1)]
BarCell = Literal[
    "tetra",
    "tetra10",
    "hexahedron",
    "hexahedron20",
    "hexahedron27",
    "wedge",
    "wedge15",
    "pyramid",
    "pyramid13",
]


class MeshFile(Part):
    """A mesh in a file; in YAML its path is relative to the YAML file."""

    positional: ClassVar[tuple[str, ...]] = ("file",)
    file: Path
    """path of the mesh file"""
    unit: str = "m"
    """unit of length the file is written in"""
    scale: Annotated[units.Pure, Field(gt=0.0)] = 1.0
    """factor on all lengths, after the unit"""

    if TYPE_CHECKING:

        def __init__(
            self, file: str | os.PathLike[str], *, unit: str = ..., scale: units.Number = ...
        ) -> None: ...

    @field_validator("file")
    @classmethod
    def _from_base(cls, file: Path, info: ValidationInfo) -> Path:
        base = info.context.get("base") if isinstance(info.context, dict) else None
        return Path(base) / file if base is not None else file

    @field_validator("unit")
    @classmethod
    def _length_unit(cls, unit: str) -> str:
        units.LENGTH(f"1 {unit}")
        return unit


class BarMesh(Part):
    """A box cut into like cells."""

    type: Literal["bar"] = "bar"
    size: units.Position
    """lengths along x, y, z [m]"""
    cells: Annotated[tuple[_Count, _Count, _Count], BeforeValidator(units.listed)]
    """numbers of boxes along x, y, z"""
    cell: BarCell = "tetra"
    """cell type"""
    split: Literal["six", "five", "six_mirrored"] = "six"
    """how a box is cut into tetrahedra"""
    origin: units.Position = (0.0, 0.0, 0.0)
    """smallest corner [m]"""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            size: units.VectorLike,
            cells: Sequence[int],
            cell: BarCell = ...,
            split: Literal["six", "five", "six_mirrored"] = ...,
            origin: units.VectorLike = ...,
        ) -> None: ...

    @field_validator("size")
    @classmethod
    def _positive(cls, size: tuple[float, ...]) -> tuple[float, ...]:
        if min(size) <= 0:
            raise ParameterError(f"found {size}; three positive lengths are accepted")
        return size


def _is_mesh(value: object) -> bool:
    """Whether the value is a Mesh in memory (without importing tissu.mesh)."""
    return type(value).__name__ == "Mesh" and hasattr(value, "points") and hasattr(value, "cells")


def _mesh_source(value: Any, info: ValidationInfo) -> Any:
    if _is_mesh(value):
        return value
    if isinstance(value, (str, os.PathLike)):
        value = {"file": value}
    if isinstance(value, MeshFile) or (isinstance(value, Mapping) and "type" not in value):
        return MeshFile.model_validate(value, context=info.context)
    return chosen(value, (BarMesh,), info)


class Body(Part):
    """Something soft: a mesh with a law, a density or a total mass, and maybe viscosity."""

    mesh: Annotated[Any, PlainValidator(_mesh_source)]
    """a mesh file, a bar, or (in Python) a Mesh"""
    law: LawOrMap
    """the material's law, or a map from the mesh's regions to laws"""
    density: Annotated[units.Density, Field(gt=0.0)] | None = None
    """density [kg/m^3]; this or `mass`"""
    mass: Annotated[units.Mass, Field(gt=0.0)] | None = None
    """total mass [kg]; this or `density`"""
    quadrature: Literal["full", "over"] = "full"
    """points at which hexahedra are integrated"""
    viscosity: Rayleigh | None = None
    """viscosity; absent: none"""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            mesh: MeshFile | BarMesh | Mesh | str | os.PathLike[str],
            law: Law | Mapping[str, Law],
            density: units.Number | None = ...,
            mass: units.Number | None = ...,
            quadrature: Literal["full", "over"] = ...,
            viscosity: Rayleigh | None = ...,
        ) -> None: ...

    @model_validator(mode="after")
    def _one_of_density_and_mass(self) -> Self:
        if (self.density is None) == (self.mass is None):
            found = "neither" if self.density is None else "both"
            raise ParameterError(
                f"found {found} of density and mass; exactly one of them is accepted"
            )
        return self

    def laws(self) -> dict[str | None, Law]:
        """Laws by region; the key None stands for the whole body."""
        if not isinstance(self.law, dict):
            return {None: self.law}
        return {region: law for region, law in self.law.items()}
