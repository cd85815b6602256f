"""How a scene is stepped through time: integrator and Newton's method."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from pydantic import Field

from tissu import units
from tissu.scene.part import Part, one_of
from tissu.scene.solver import ConjugateGradient, OneSolver, Solver

_Tolerance = Annotated[units.Pure, Field(gt=0.0, lt=1.0)]
_Count = Annotated[int, Field(ge=1)]


class Newton(Part):
    """Newton's method: how often the step is linearised again, and when it is solved."""

    iterations: _Count = 10
    """largest number of iterations in a step; of Static, for each part of the load tried"""
    tolerance: _Tolerance = 1e-6
    """residual relative to the first at which the step is solved"""

    if TYPE_CHECKING:

        def __init__(self, *, iterations: int = ..., tolerance: units.Number = ...) -> None: ...


class ImplicitEuler(Part):
    """Implicit Euler, linearised once in a step unless `newton` is given."""

    positional: ClassVar[tuple[str, ...]] = ("dt",)
    type: Literal["implicit_euler"] = "implicit_euler"
    dt: Annotated[units.Time, Field(gt=0.0)]
    """time step [s], such as '10 ms'"""
    newton: Newton | None = None
    """Newton's method; absent: linearised once"""
    solver: OneSolver = Field(default_factory=ConjugateGradient)
    """linear solver"""

    if TYPE_CHECKING:

        def __init__(
            self, dt: units.Number, *, newton: Newton | None = ..., solver: Solver = ...
        ) -> None: ...


class Static(Part):
    """Equilibrium without inertia, the load applied in equal steps."""

    type: Literal["static"] = "static"
    load_steps: _Count = 1
    """number of equal steps in which the load is applied"""
    newton: Newton = Field(default_factory=Newton)
    """Newton's method"""
    solver: OneSolver = Field(default_factory=ConjugateGradient)
    """linear solver"""

    if TYPE_CHECKING:

        def __init__(
            self, *, load_steps: int = ..., newton: Newton = ..., solver: Solver = ...
        ) -> None: ...


Step = ImplicitEuler | Static
OneStep = Annotated[Step, one_of(ImplicitEuler, Static)]
