"""The energy-momentum method as a part of a scene."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from pydantic import Field

from tissu import units
from tissu.scene.part import Part
from tissu.scene.solver import ConjugateGradient, OneSolver, Solver


class EnergyMomentum(Part):
    """Energy-momentum method: second order, keeps energy and momenta exactly for any law."""

    positional: ClassVar[tuple[str, ...]] = ("dt",)
    type: Literal["energy_momentum"] = "energy_momentum"
    dt: Annotated[units.Time, Field(gt=0.0)]
    """time step [s], such as '1 ms'; halved where its equation is not solved"""
    iterations: Annotated[int, Field(ge=1)] = 20
    """largest number of Newton iterations in a step"""
    tolerance: Annotated[units.Pure, Field(gt=0.0, lt=1.0)] = 1e-9
    """residual relative to the load that acts at which the step is solved"""
    solver: OneSolver = Field(default_factory=ConjugateGradient)
    """linear solver"""

    if TYPE_CHECKING:

        def __init__(
            self,
            dt: units.Number,
            *,
            iterations: int = ...,
            tolerance: units.Number = ...,
            solver: Solver = ...,
        ) -> None: ...
