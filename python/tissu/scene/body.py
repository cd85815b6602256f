"""A body: its mesh, what it is made of, how heavy and how viscous it is."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias

from pydantic import AfterValidator, PlainValidator, ValidationInfo

from tissu import units
from tissu.reading import Maybe, Read
from tissu.scene.bar import BarMesh
from tissu.scene.effect import Effect
from tissu.scene.field import field
from tissu.scene.generated.laws import Hooke
from tissu.scene.law import Law
from tissu.scene.laws import LawOrMap
from tissu.scene.model import FEM, Frames, Model, ModelOrMap
from tissu.scene.part import Part, chosen
from tissu.scene.problem import Problem
from tissu.scene.section import AreaOrSection, Section
from tissu.scene.selection import NamedSelections
from tissu.scene.start import Start
from tissu.scene.unknown import rule
from tissu.scene.viscosity import OneViscosity

if TYPE_CHECKING:
    from tissu.mesh import Mesh

__all__ = ["Body", "MeshFile"]

PathLike = str | os.PathLike[str]


def _from_base(file: Path, info: ValidationInfo) -> Path:
    base = info.context.get("base") if isinstance(info.context, dict) else None
    return Path(base) / file if base is not None else file


def _length_unit(unit: str) -> str:
    units.LENGTH(f"1 {unit}")
    return unit


class MeshFile(Part):
    """A mesh in a file; in YAML its path is relative to the YAML file."""

    file: Annotated[Read[Path, PathLike], AfterValidator(_from_base)] = field(kw_only=False)
    """path of the mesh file"""
    unit: Annotated[str, AfterValidator(_length_unit)] = "m"
    """unit of length of the file"""
    scale: units.Pure = field(default=1.0, gt=0.0)
    """factor on all lengths, after the unit"""
    regions: NamedSelections = field(default_factory=dict)
    """regions by name, of the cells whose centres lie in a shape: {tumour: {type: sphere, ...}}"""

    def mesh(self) -> Mesh:
        """The mesh; in the file's own unit where that is unknown.

        Raises:
            TissuError: the file cannot be read.
        """
        from tissu.mesh import read_mesh

        unit, scale = getattr(self, "unit", "m"), getattr(self, "scale", 1.0)
        return read_mesh(self.file, unit=unit, scale=scale)


if TYPE_CHECKING:
    MeshLike: TypeAlias = MeshFile | BarMesh | Mesh | PathLike
else:
    MeshLike = Any


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
    """A soft body: a mesh with a law, a density or a total mass, and perhaps a viscosity."""

    mesh: Annotated[Read[Any, MeshLike], PlainValidator(mesh_source)]
    """a mesh file, a bar, or (in Python) a Mesh"""
    law: LawOrMap
    """the material's law, or a map from the mesh's regions to laws"""
    model: ModelOrMap = field(default=FEM())
    """the model that computes the cells' forces, by name: fem, corotational, mass_spring,
    mass_link, mass_tensor, condensed, mean_dilatation, frames, shell; or a map from the mesh's
    regions to models
    """
    law_for_model: Literal["exact", "nearest"] = "exact"
    """what to do if the model does not take the law of the body: `exact` refuses the scene;
    `nearest` uses the nearest law that the model takes, with the same young and poisson, which is
    equal at small strain only
    """
    density: Maybe[units.Density] = field(default=None, gt=0.0)
    """density [kg/m^3]; this or `mass`"""
    mass: Maybe[units.Mass] = field(default=None, gt=0.0)
    """total mass [kg]; this or `density`"""
    quadrature: Literal["reduced", "full", "over"] = "full"
    """points at which cells are integrated; `reduced` leaves some cells modes without energy"""
    viscosity: OneViscosity | None = None
    """rayleigh, kelvin_voigt, centroid or prony; absent: none"""
    thickness: Maybe[units.Length] = field(default=None, gt=0.0)
    """thickness [m] of sheets: the triangles and quads of the mesh; absent: they only mark faces"""
    section: AreaOrSection = field(default=None)
    """section of fibres, cables and rods, the lines of the mesh: an area [m^2] (round), or round,
    rectangle, tube or general, of which only frames use more than the area; absent: lines only mark
    edges
    """
    plane: Literal["strain", "stress"] | None = None
    """the body is flat, with one z, and stays flat: strain (no strain across it, as in a slice of a
    long body) or stress (no stress across it, as in a plate); absent: its sheets move freely in
    space, and may become thinner
    """

    start: Start | None = None
    """state at time zero; absent: at rest"""

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
        return all(model.with_rotations for model in self.models().values())

    def laws(self) -> dict[str | None, Law]:
        """Laws by region; the key None stands for the whole body."""
        law = self.law
        if not isinstance(law, dict):
            return {None: law}
        return {region: one for region, one in law.items()}

    def models(self) -> dict[str | None, Model]:
        """Models by region; the key None stands for the whole body."""
        model = self.model
        if not isinstance(model, dict):
            return {None: model}
        return {region: one for region, one in model.items()}

    def _strains_by_turns(self, region: str | None, law: object) -> bool:
        """Frames turn, and Hooke's law takes the turn of their material for a strain."""
        models = self.models()
        return isinstance(law, Hooke) and isinstance(models.get(region, models.get(None)), Frames)

    def effects(self, name: str) -> Iterator[Effect]:
        """What a body of this name switches on."""
        for region, law in self.laws().items():
            where, path = _place(name, region, "law")
            small = ", for small turns only" if self._strains_by_turns(region, law) else ""
            yield Effect(f"elasticity of {where}", f"{path} is {law.words()}{small}")
        for region, model in self.models().items():
            if not isinstance(model, FEM):
                where, path = _place(name, region, "model")
                yield Effect(f"model of {where}", f"{path} is {model.words()}")
        if self.thickness is not None:
            plane = "" if self.plane is None else f", plane is {self.plane}"
            why = f"bodies.{name}.thickness is {self.thickness:g} m{plane}"
            yield Effect(f"sheets of {name}", why)
        if self.section is not None:
            section = self.section
            words = section.words() if isinstance(section, Section) else f"{section:g} m^2"
            why = f"bodies.{name}.section is {words}"
            yield Effect(f"lines of {name}", why)
        if self.start is not None:
            yield Effect(f"start of {name}", f"bodies.{name}.start is {self.start.words()}")
        if self.viscosity is not None:
            why = f"bodies.{name}.viscosity is {self.viscosity.words()}"
            yield Effect(f"viscosity of {name}", why)


def _place(name: str, region: str | None, key: str) -> tuple[str, str]:
    """A body or a region of it in words, and the path of what a field says of it."""
    path = f"bodies.{name}.{key}"
    return (name, path) if region is None else (f"{name}, region {region}", f"{path}.{region}")
