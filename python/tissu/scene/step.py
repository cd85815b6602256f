"""How a scene is stepped through time: integrator and Newton's method."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, Field

from tissu import units
from tissu.errors import ParameterError
from tissu.scene.energy_momentum import EnergyMomentum
from tissu.scene.part import Part, one_of
from tissu.scene.problem import Problem
from tissu.scene.solver import ConjugateGradient, OneSolver, Solver
from tissu.scene.unknown import rule

_Tolerance = Annotated[units.Pure, Field(gt=0.0, lt=1.0)]
_Count = Annotated[int, Field(ge=1)]
_Step = Annotated[units.Time, Field(gt=0.0)]

Indefinite = Literal["project", "regularise", "refuse"]


def _stable_or_given(value: Any) -> Any:
    """A step [s], or the word auto."""
    if isinstance(value, str) and value.strip().lower() == "auto":
        return "auto"
    try:
        seconds = units.TIME(value)
    except ParameterError as error:
        raise ParameterError(f"{error}; or auto: the stable step") from None
    if not seconds > 0.0:
        raise ParameterError(f"found {seconds:g} s; more than 0 s, or auto, is accepted")
    return seconds


_StableStep = Annotated[float | Literal["auto"], BeforeValidator(_stable_or_given)]


class Newton(Part):
    """Newton's method: how often the step is linearised again, and when it is solved."""

    iterations: _Count = 10
    """largest number of iterations in a step; of Static, for each part of the load tried"""
    tolerance: _Tolerance = 1e-6
    """residual relative to the load that acts at which the step is solved"""

    if TYPE_CHECKING:

        def __init__(self, *, iterations: int = ..., tolerance: units.Number = ...) -> None: ...


class _Explicit(Part):
    """A method that solves no system; its steps may not exceed the stable one."""

    positional: ClassVar[tuple[str, ...]] = ("dt",)
    dt: _StableStep = "auto"
    """time step [s], such as '0.1 ms', or auto: nine tenths of the largest stable one"""

    if TYPE_CHECKING:

        def __init__(self, dt: units.Number = ...) -> None: ...


class ExplicitEuler(_Explicit):
    """Forward Euler: first order; makes every vibration grow that is not damped enough."""

    type: Literal["explicit_euler"] = "explicit_euler"


class SymplecticEuler(_Explicit):
    """Symplectic Euler: first order, one force a step, no drift of the energy."""

    type: Literal["symplectic_euler"] = "symplectic_euler"


class RK2(_Explicit):
    """Runge-Kutta of second order, the explicit midpoint rule: two forces a step."""

    type: Literal["rk2"] = "rk2"


class RK4(_Explicit):
    """The classical Runge-Kutta method: fourth order, four forces a step."""

    type: Literal["rk4"] = "rk4"


class _Implicit(Part):
    """A method that solves a system in each step."""

    positional: ClassVar[tuple[str, ...]] = ("dt",)
    dt: _Step
    """time step [s], such as '10 ms'"""
    newton: Newton | None = None
    """Newton's method; absent: linearised once, iterated only where that made things worse"""
    indefinite: Indefinite = "project"
    """what to do where the matrix of a step is not positive definite: project each cell's share on
    the positive semi-definite ones, regularise with a growing share of the mass, or refuse"""
    solver: OneSolver = Field(default_factory=ConjugateGradient)
    """linear solver"""

    if TYPE_CHECKING:

        def __init__(
            self,
            dt: units.Number,
            *,
            newton: Newton | None = ...,
            indefinite: Indefinite = ...,
            solver: Solver = ...,
        ) -> None: ...


class ImplicitEuler(_Implicit):
    """Implicit Euler: first order, damps vibrations; linearised once unless `newton` is given."""

    type: Literal["implicit_euler"] = "implicit_euler"


class ImplicitMidpoint(_Implicit):
    """Implicit midpoint rule: second order, keeps momenta, no damping."""

    type: Literal["implicit_midpoint"] = "implicit_midpoint"


class BDF2(_Implicit):
    """Backward differentiation of second order: damps fast vibrations, slow ones hardly."""

    type: Literal["bdf2"] = "bdf2"


class Newmark(_Implicit):
    """Newmark's method; second order and without damping for gamma = 1/2."""

    type: Literal["newmark"] = "newmark"
    beta: Annotated[units.Pure, Field(gt=0.0, le=0.5)] = 0.25
    """weight of the acceleration at the end in the position; at least gamma / 2"""
    gamma: Annotated[units.Pure, Field(ge=0.5, le=1.0)] = 0.5
    """weight of the acceleration at the end in the velocity; above 1/2 it damps"""

    if TYPE_CHECKING:

        def __init__(
            self,
            dt: units.Number,
            *,
            beta: units.Number = ...,
            gamma: units.Number = ...,
            newton: Newton | None = ...,
            indefinite: Indefinite = ...,
            solver: Solver = ...,
        ) -> None: ...

    @rule("beta", "gamma")
    def _is_stable(self) -> Iterator[Problem]:
        if 2.0 * self.beta < self.gamma:
            text = (
                f"found beta {self.beta:g} with gamma {self.gamma:g}; beta of at least gamma / 2 "
            )
            yield Problem(("beta",), f"{text}is accepted: others are unstable for large steps")


class BDF2FixedPoint(Part):
    """BDF2 by fixed-point iteration, without any matrix: for h omega below 3/2."""

    positional: ClassVar[tuple[str, ...]] = ("dt",)
    type: Literal["bdf2_fixed_point"] = "bdf2_fixed_point"
    dt: _Step
    """time step [s], such as '0.1 ms'"""
    iterations: _Count = 50
    """largest number of iterations in a step"""
    tolerance: _Tolerance = 1e-6
    """residual relative to the impulse of the forces at the guess at which the step is solved"""
    anderson: Annotated[int, Field(ge=0, le=8)] = 0
    """earlier differences that Anderson's acceleration uses; 0: plain iteration"""

    if TYPE_CHECKING:

        def __init__(
            self,
            dt: units.Number,
            *,
            iterations: int = ...,
            tolerance: units.Number = ...,
            anderson: int = ...,
        ) -> None: ...


class Static(Part):
    """Equilibrium without inertia, by continuation: parts of the load that shrink and grow."""

    type: Literal["static"] = "static"
    load_steps: _Count = 1
    """parts, at least, in which each step is taken; led nodes turn by at most 30 degrees in one"""
    newton: Newton = Field(default_factory=lambda: Newton(iterations=25))
    """Newton's method, for each part that is tried"""
    total_iterations: _Count | None = None
    """largest number of Newton iterations in a step; absent: iterations (load_steps + 19)"""
    arc_length: bool = False
    """follow the path by its arc length from the start, as through limit points of the load; false:
    only where no part of the load is small enough"""
    solver: OneSolver = Field(default_factory=ConjugateGradient)
    """linear solver"""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            load_steps: int = ...,
            newton: Newton = ...,
            total_iterations: int | None = ...,
            arc_length: bool = ...,
            solver: Solver = ...,
        ) -> None: ...


Explicit = ExplicitEuler | SymplecticEuler | RK2 | RK4
Implicit = ImplicitEuler | ImplicitMidpoint | BDF2 | Newmark
Step = Explicit | Implicit | EnergyMomentum | BDF2FixedPoint | Static
STEPS: tuple[type[Part], ...] = (
    *(ExplicitEuler, SymplecticEuler, RK2, RK4),
    *(ImplicitEuler, ImplicitMidpoint, BDF2, Newmark),
    *(EnergyMomentum, BDF2FixedPoint, Static),
)


def _auto(value: Any) -> Any:
    """The word auto: symplectic Euler with its stable step."""
    if isinstance(value, str) and value.strip().lower() == "auto":
        return SymplecticEuler()
    return value


OneStep = Annotated[Step, one_of(*STEPS), BeforeValidator(_auto)]
