"""Viscosity of a body, as a scene names it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from tissu import units
from tissu.reading import Read
from tissu.scene.effect import numbers_in_words
from tissu.scene.field import field
from tissu.scene.part import Part, one_of
from tissu.scene.problem import Problem
from tissu.scene.unknown import rule

if TYPE_CHECKING:
    from tissu._core import WorldBuilder

__all__ = ["Rayleigh", "KelvinVoigt", "Centroid", "Prony", "PronyBranch"]


class Viscosity(Part):
    """What all viscosities share."""

    if TYPE_CHECKING:
        type: str

    def words(self) -> str:
        """Its type and numbers, as `check` says them."""
        names = (name for name in type(self).model_fields if name != "type")
        return f"{self.type}, {numbers_in_words(self, *names)}"

    def live_fields(self) -> list[str]:
        """All its numbers."""
        return [name for name in type(self).model_fields if name not in ("type", "branches")]

    def add_to(self, builder: WorldBuilder, body: str) -> None:
        """Give it to a body of the world."""
        raise NotImplementedError


class Rayleigh(Viscosity):
    """Viscosity proportional to mass and stiffness: C = mass M + stiffness K."""

    type: Literal["rayleigh"] = "rayleigh"
    mass: units.Rate = field(default=0.0, ge=0.0)
    """share of the mass matrix [1/s]"""
    stiffness: units.Time = field(default=0.0, ge=0.0)
    """share of the stiffness matrix [s]"""

    @rule("mass", "stiffness")
    def _some(self) -> Iterator[Problem]:
        if not (self.mass or self.stiffness):
            text = "found no mass and no stiffness; leave viscosity out to have none"
            yield Problem((), text)

    def add_to(self, builder: WorldBuilder, body: str) -> None:
        """Give it to a body of the world."""
        builder.add_rayleigh(body=body, mass=self.mass, stiffness=self.stiffness)


class KelvinVoigt(Viscosity):
    """A damper parallel to the law at every point: S = 2 eta dE/dt + zeta tr(dE/dt) I.

    A rigid rotation is not damped. With the model mass_spring it is a damper beside each spring.
    """

    type: Literal["kelvin_voigt"] = "kelvin_voigt"
    eta: units.Viscosity = field(default=0.0, ge=0.0)
    """shear viscosity [Pa s], such as '40 Pa s'"""
    zeta: units.Viscosity = field(default=0.0, ge=0.0)
    """second viscosity, against change of volume [Pa s]"""

    @rule("eta", "zeta")
    def _some(self) -> Iterator[Problem]:
        if not (self.eta or self.zeta):
            yield Problem((), "found no eta and no zeta; leave viscosity out to have none")

    def add_to(self, builder: WorldBuilder, body: str) -> None:
        """Give it to a body of the world."""
        builder.add_kelvin_voigt(body=body, shear=self.eta, bulk=self.zeta)


class Centroid(Viscosity):
    """Damping relative to the centroid of each cell (Chendeb 2007); it damps rotations too."""

    type: Literal["centroid"] = "centroid"
    coefficient: units.DampingPerVolume = field(gt=0.0)
    """c in f = -c V (v - mean v) of a cell of volume V at rest [N s/m^4]"""

    def add_to(self, builder: WorldBuilder, body: str) -> None:
        """Give it to a body of the world."""
        builder.add_centroid(body=body, coefficient=self.coefficient)


class PronyBranch(Part):
    """A spring and a damper in series, parallel to the law."""

    weight: units.Pure = field(gt=0.0)
    """stiffness of the spring, relative to that of the law at small strain"""
    time: units.Time = field(gt=0.0)
    """time after which its stress has fallen to 1/e [s]"""

    def live_fields(self) -> list[str]:
        """Both of its numbers."""
        return ["weight", "time"]


_Branches = Read[tuple[PronyBranch, ...], Sequence[PronyBranch]]


class Prony(Viscosity):
    """Stress that starts at 1 + the sum of the weights times that of the law, and relaxes to it."""

    type: Literal["prony"] = "prony"
    branches: Annotated[_Branches, Field(min_length=1, max_length=16)]
    """at least one {weight, time}; 3-D cells only"""

    def words(self) -> str:
        """Its type and branches, as `check` says them."""
        branches = (f"weight {b.weight:g} time {b.time:g} s" for b in self.branches)
        return f"prony, {', '.join(branches)}"

    def add_to(self, builder: WorldBuilder, body: str) -> None:
        """Give it to a body of the world."""
        branches = [(branch.weight, branch.time) for branch in self.branches]
        builder.add_prony(body=body, branches=branches)


VISCOSITIES: tuple[type[Viscosity], ...] = (Rayleigh, KelvinVoigt, Centroid, Prony)
OneViscosity = Annotated[Viscosity, one_of(*VISCOSITIES)]
