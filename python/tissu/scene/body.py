"""A body: its mesh, what it is made of, how heavy and how viscous it is."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

from pydantic import AfterValidator, Field, PlainValidator, ValidationInfo

from tissu import units
from tissu.scene.bar import BarMesh
from tissu.scene.law import Law, LawOrMap
from tissu.scene.model import FEM, WITH_ROTATIONS, Model, ModelOrMap
from tissu.scene.part import Part, chosen
from tissu.scene.problem import Problem
from tissu.scene.selection import NamedSelections
from tissu.scene.start import Start
from tissu.scene.unknown import rule
from tissu.scene.viscosity import OneViscosity, Viscosity

if TYPE_CHECKING:
    from tissu.mesh import Mesh
    from tissu.scene.selection import Selection


def _from_base(file: Path, info: ValidationInfo) -> Path:
    base = info.context.get("base") if isinstance(info.context, dict) else None
    return Path(base) / file if base is not None else file


def _length_unit(unit: str) -> str:
    units.LENGTH(f"1 {unit}")
    return unit


class MeshFile(Part):
    """A mesh in a file; in YAML its path is relative to the YAML file."""

    positional: ClassVar[tuple[str, ...]] = ("file",)
    file: Annotated[Path, AfterValidator(_from_base)]
    """path of the mesh file"""
    unit: Annotated[str, AfterValidator(_length_unit)] = "m"
    """unit of length the file is written in"""
    scale: Annotated[units.Pure, Field(gt=0.0)] = 1.0
    """factor on all lengths, after the unit"""
    regions: NamedSelections = Field(default_factory=dict)
    """regions by name, of the cells whose centres lie in a shape: {tumour: {type: sphere, ...}}"""

    if TYPE_CHECKING:

        def __init__(
            self,
            file: str | os.PathLike[str],
            *,
            unit: str = ...,
            scale: units.Number = ...,
            regions: Mapping[str, Selection] = ...,
        ) -> None: ...


def _is_mesh(value: object) -> bool:
    """Whether the value is a Mesh in memory (without importing tissu.mesh)."""
    return type(value).__name__ == "Mesh" and hasattr(value, "points") and hasattr(value, "cells")


def mesh_source(value: Any, info: ValidationInfo) -> Any:
    """A mesh file, a bar or a mesh in memory, by what is given."""
    if _is_mesh(value):
        return value
    if isinstance(value, (str, os.PathLike)):
        value = {"file": value}
    if isinstance(value, MeshFile) or (isinstance(value, Mapping) and "type" not in value):
        return MeshFile.model_validate(value, context=info.context)
    return chosen(value, (BarMesh,), info)


class Body(Part):
    """Something soft: a mesh with a law, a density or a total mass, and maybe viscosity."""

    mesh: Annotated[Any, PlainValidator(mesh_source)]
    """a mesh file, a bar, or (in Python) a Mesh"""
    law: LawOrMap
    """the material's law, or a map from the mesh's regions to laws"""
    model: ModelOrMap = FEM()
    """what computes the cells' forces, by name: fem, corotational, mass-spring, mass-link,
    mass-tensor, condensed, mean-dilatation, frames, shell; or a map from the mesh's regions to
    models
    """
    density: Annotated[units.Density, Field(gt=0.0)] | None = None
    """density [kg/m^3]; this or `mass`"""
    mass: Annotated[units.Mass, Field(gt=0.0)] | None = None
    """total mass [kg]; this or `density`"""
    quadrature: Literal["reduced", "full", "over"] = "full"
    """points at which cells are integrated; `reduced` leaves some cells modes without energy"""
    viscosity: OneViscosity | None = None
    """rayleigh, kelvin_voigt, centroid or prony; absent: none"""
    thickness: Annotated[units.Length, Field(gt=0.0)] | None = None
    """thickness [m] of sheets: the triangles and quads of the mesh; absent: they only mark faces"""
    section: Annotated[units.Area, Field(gt=0.0)] | None = None
    """section [m^2] of fibres and cables: the lines of the mesh; absent: they only mark edges"""
    plane: Literal["strain", "stress"] | None = None
    """the body is flat, of one z, and stays so: without strain across, as in a slice of something
    long, or without stress across, as in a plate; absent: its sheets are free in space and to thin
    """

    start: Start | None = None
    """state at time zero; absent: at rest"""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            mesh: MeshFile | BarMesh | Mesh | str | os.PathLike[str],
            law: Law | Mapping[str, Law],
            model: Model | str | Mapping[str, Model | str] = ...,
            density: units.Number | None = ...,
            mass: units.Number | None = ...,
            quadrature: Literal["reduced", "full", "over"] = ...,
            viscosity: Viscosity | None = ...,
            thickness: units.Number | None = ...,
            section: units.Number | None = ...,
            plane: Literal["strain", "stress"] | None = ...,
            start: Start | None = ...,
        ) -> None: ...

    @rule("density", "mass")
    def _one_of_density_and_mass(self) -> Iterator[Problem]:
        if (self.density is None) == (self.mass is None):
            found = "neither" if self.density is None else "both"
            text = f"found {found} of density and mass; exactly one of them is accepted"
            yield Problem((), text)

    @rule("plane")
    def _plane_has_a_thickness(self) -> Iterator[Problem]:
        if self.plane is not None and self.thickness is None:
            text = f"found plane {self.plane} without thickness; both are accepted together: "
            text += "thickness: 1 m makes every force one per metre"
            yield Problem((), text)

    @property
    def has_rotations(self) -> bool:
        """Whether its nodes are frames: they can turn, be held against it, and carry moments."""
        return all(isinstance(model, WITH_ROTATIONS) for model in self.models().values())

    def laws(self) -> dict[str | None, Law]:
        """Laws by region; the key None stands for the whole body."""
        if not isinstance(self.law, dict):
            return {None: self.law}
        return {region: law for region, law in self.law.items()}

    def models(self) -> dict[str | None, Model]:
        """Models by region; the key None stands for the whole body."""
        if not isinstance(self.model, dict):
            return {None: self.model}
        return {region: model for region, model in self.model.items()}
