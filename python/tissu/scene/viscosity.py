"""Viscosity of a body, as a scene names it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from tissu import units
from tissu.scene.part import Part, one_of
from tissu.scene.problem import Problem
from tissu.scene.unknown import rule

_NotNegative = Field(ge=0.0)
_Positive = Field(gt=0.0)


class Rayleigh(Part):
    """Viscosity proportional to mass and stiffness: C = mass M + stiffness K."""

    type: Literal["rayleigh"] = "rayleigh"
    mass: Annotated[units.Rate, _NotNegative] = 0.0
    """share of the mass matrix [1/s]"""
    stiffness: Annotated[units.Time, _NotNegative] = 0.0
    """share of the stiffness matrix [s]"""

    if TYPE_CHECKING:

        def __init__(self, *, mass: units.Number = ..., stiffness: units.Number = ...) -> None: ...

    @rule("mass", "stiffness")
    def _some(self) -> Iterator[Problem]:
        if not (self.mass or self.stiffness):
            text = "found no mass and no stiffness; leave viscosity out to have none"
            yield Problem((), text)


class KelvinVoigt(Part):
    """A damper beside the law at every point: S = 2 eta dE/dt + zeta tr(dE/dt) I; turning is free.

    With the model mass-spring it is a damper beside each spring.
    """

    type: Literal["kelvin_voigt"] = "kelvin_voigt"
    eta: Annotated[units.Viscosity, _NotNegative] = 0.0
    """shear viscosity [Pa s], such as '40 Pa s'"""
    zeta: Annotated[units.Viscosity, _NotNegative] = 0.0
    """second viscosity, against change of volume [Pa s]"""

    if TYPE_CHECKING:

        def __init__(self, *, eta: units.Number = ..., zeta: units.Number = ...) -> None: ...

    @rule("eta", "zeta")
    def _some(self) -> Iterator[Problem]:
        if not (self.eta or self.zeta):
            yield Problem((), "found no eta and no zeta; leave viscosity out to have none")


class Centroid(Part):
    """Each node of a cell damped against the cell's centroid (Chendeb 2007); turning is braked."""

    type: Literal["centroid"] = "centroid"
    coefficient: Annotated[units.DampingPerVolume, _Positive]
    """c in f = -c V (v - mean v) of a cell of volume V at rest [N s/m^4]"""

    if TYPE_CHECKING:

        def __init__(self, *, coefficient: units.Number) -> None: ...


class PronyBranch(Part):
    """A spring and a damper in a row, beside the law."""

    weight: Annotated[units.Pure, _Positive]
    """stiffness of the spring, beside the law's own at small strain"""
    time: Annotated[units.Time, _Positive]
    """time after which its stress has fallen to 1/e [s]"""

    if TYPE_CHECKING:

        def __init__(self, *, weight: units.Number, time: units.Number) -> None: ...


class Prony(Part):
    """Stress that relaxes: the law at long times, 1 + sum of the weights as stiff at once."""

    type: Literal["prony"] = "prony"
    branches: Annotated[tuple[PronyBranch, ...], Field(min_length=1, max_length=16)]
    """at least one {weight, time}; 3-D cells only"""

    if TYPE_CHECKING:

        def __init__(self, *, branches: Sequence[PronyBranch]) -> None: ...


Viscosity = Rayleigh | KelvinVoigt | Centroid | Prony
OneViscosity = Annotated[Viscosity, one_of(Rayleigh, KelvinVoigt, Centroid, Prony)]
