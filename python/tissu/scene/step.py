"""How a scene is stepped through time: a class for each method, and Newton's method."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, Field

from tissu import units
from tissu.counted import counted
from tissu.errors import ParameterError
from tissu.reading import Number, Read
from tissu.scene.effect import Effect
from tissu.scene.field import field
from tissu.scene.part import Part, one_of
from tissu.scene.problem import Problem
from tissu.scene.solver import Auto, OneSolver, Solver
from tissu.scene.unknown import rule

if TYPE_CHECKING:
    from tissu import _core

__all__ = [
    "ExplicitEuler",
    "SymplecticEuler",
    "RK2",
    "RK4",
    "ImplicitEuler",
    "ImplicitMidpoint",
    "BDF2",
    "Newmark",
    "EnergyMomentum",
    "BDF2FixedPoint",
    "Static",
    "Newton",
]  # fmt: skip

_Tolerance = Annotated[units.Pure, Field(gt=0.0, lt=1.0)]
_Count = Annotated[int, Field(ge=1)]

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


_StableStep = Annotated[Read[float | Literal["auto"], Number], BeforeValidator(_stable_or_given)]


class Newton(Part):
    """Newton's method: how often the step is linearised again, and when it counts as solved."""

    iterations: _Count = 10
    """largest number of iterations in a step; of Static, for each part of the load tried"""
    tolerance: _Tolerance = field(default=1e-6)
    """residual relative to the load that acts at which the step is solved"""


class Step(Part):
    """The common part of all methods.

    Attributes:
        second_order: whether it is of second order and implicit.
    """

    second_order: ClassVar[bool] = False
    if TYPE_CHECKING:
        type: str

    def integrator(self) -> _core.Integrator:
        """The core's integrator of the same name, with the fields that are its own."""
        from tissu import _core

        made: _core.Integrator = getattr(_core, type(self).__name__)(**self.settings())
        return made

    def settings(self) -> dict[str, Any]:
        """The fields that the integrator takes; without Newton's method it iterates once."""
        names = (name for name in type(self).model_fields if name not in ("type", "dt", "solver"))
        found = {name: getattr(self, name) for name in names}
        if "newton" in found:
            newton = found.pop("newton") or Newton(iterations=1)
            found["newton_iterations"] = newton.iterations
            found["newton_tolerance"] = newton.tolerance
        return found

    @property
    def is_linearised_once(self) -> bool:
        """Whether its equation is linearised once, and solved further only where much is left."""
        return self.settings().get("newton_iterations") == 1

    def effect(self) -> Effect:
        """The effect that the step switches on."""
        dt = getattr(self, "dt", None)
        shown = dt if isinstance(dt, str) else f"{dt:g} s"
        return Effect("inertia", f"step is {self.type} with dt {shown}")

    def solver_effects(self) -> list[Effect]:
        """What solves its linear systems, in words, where it has any."""
        solver: Solver | None = getattr(self, "solver", None)
        few = "few solves" if isinstance(self, Static) else "many solves"
        return [] if solver is None else [Effect("linear solver", solver.words(few))]


class Explicit(Step):
    """A method that solves no system; its steps may not exceed the stable one."""

    dt: _StableStep = field(default="auto", kw_only=False)
    """time step [s], such as '0.1 ms', or auto: 0.8 of the stable one, 0.5 after cuts by copies"""


class ExplicitEuler(Explicit):
    """Forward Euler: first order; every vibration that is not damped enough grows."""

    type: Literal["explicit_euler"] = "explicit_euler"


class SymplecticEuler(Explicit):
    """Symplectic Euler: first order, one force a step, no drift of the energy."""

    type: Literal["symplectic_euler"] = "symplectic_euler"


class RK2(Explicit):
    """Runge-Kutta of second order, the explicit midpoint rule: two forces a step.

    Impacts are met to first order.
    """

    type: Literal["rk2"] = "rk2"


class RK4(Explicit):
    """The classical Runge-Kutta method: fourth order, four forces a step.

    Impacts are met to first order.
    """

    type: Literal["rk4"] = "rk4"


class Implicit(Step):
    """A method that solves a system in each step."""

    dt: units.Time = field(gt=0.0, kw_only=False)
    """time step [s], such as '10 ms'"""
    newton: Newton | None = None
    """Newton's method; absent: linearised once, iterated only where that increases the residual or
    leaves much of it on a body (docs/guide/integrators.md)
    """
    indefinite: Indefinite = "project"
    """what to do where the matrix of a step is not positive definite: project each cell's share
    onto a positive semi-definite one, regularise with a growing share of the mass, or refuse"""
    solver: OneSolver = field(default_factory=Auto)
    """linear solver"""

    @rule("newton")
    def _tests_its_tolerance(self) -> Iterator[Problem]:
        """A step that is linearised once is not iterated to a tolerance."""
        newton = self.newton
        if newton is None or newton.iterations > 1 or "tolerance" not in newton.model_fields_set:
            return
        text = f"found {newton.tolerance:g} with one iteration, after which no tolerance is tested;"
        text += " two or more iterations are accepted, or none of both: leave the tolerance out"
        yield Problem(("newton", "tolerance"), text)


class ImplicitEuler(Implicit):
    """Implicit Euler: first order, damps vibrations; linearised once unless `newton` is given."""

    type: Literal["implicit_euler"] = "implicit_euler"


class ImplicitMidpoint(Implicit):
    """Implicit midpoint rule: second order, no damping; keeps momenta, angular with `newton`."""

    second_order: ClassVar[bool] = True
    type: Literal["implicit_midpoint"] = "implicit_midpoint"


class BDF2(Implicit):
    """Backward differentiation of second order: damps fast vibrations, and slow ones hardly."""

    second_order: ClassVar[bool] = True
    type: Literal["bdf2"] = "bdf2"


class Newmark(Implicit):
    """Newmark's method; second order and without damping for gamma = 1/2."""

    second_order: ClassVar[bool] = True
    type: Literal["newmark"] = "newmark"
    beta: units.Pure = field(default=0.25, gt=0.0, le=0.5)
    """weight of the acceleration at the end in the position; at least gamma / 2"""
    gamma: units.Pure = field(default=0.5, ge=0.5, le=1.0)
    """weight of the acceleration at the end in the velocity; above 1/2 it damps"""

    @rule("beta", "gamma")
    def _is_stable(self) -> Iterator[Problem]:
        if 2.0 * self.beta < self.gamma:
            text = (
                f"found beta {self.beta:g} with gamma {self.gamma:g}; beta of at least gamma / 2 "
            )
            yield Problem(("beta",), f"{text}is accepted: others are unstable for large steps")


class EnergyMomentum(Step):
    """Energy-momentum method: second order; without viscosity keeps energy and momenta."""

    type: Literal["energy_momentum"] = "energy_momentum"
    dt: units.Time = field(gt=0.0, kw_only=False)
    """time step [s], such as '1 ms'; halved where its equation is not solved"""
    iterations: _Count = 20
    """largest number of Newton iterations in a step"""
    tolerance: _Tolerance = field(default=1e-9)
    """residual relative to the load that acts at which the step is solved"""
    solver: OneSolver = field(default_factory=Auto)
    """linear solver"""


class BDF2FixedPoint(Step):
    """BDF2 by fixed-point iteration, without any matrix: for h omega below 3/2."""

    type: Literal["bdf2_fixed_point"] = "bdf2_fixed_point"
    dt: units.Time = field(gt=0.0, kw_only=False)
    """time step [s], such as '0.1 ms'"""
    iterations: _Count = 50
    """largest number of iterations in a step"""
    tolerance: _Tolerance = field(default=1e-6)
    """residual relative to the impulse of the forces at the guess at which the step is solved"""
    anderson: Annotated[int, Field(ge=0, le=8)] = 0
    """earlier differences that Anderson's acceleration uses; 0: plain iteration"""


class Static(Step):
    """Equilibrium without inertia, by continuation: parts of the load that shrink and grow."""

    type: Literal["static"] = "static"
    load_steps: _Count = 1
    """least number of parts into which each step is divided; no part turns prescribed nodes by more
    than 30 degrees
    """
    newton: Newton = field(default_factory=lambda: Newton(iterations=25))
    """Newton's method, for each part that is tried"""
    total_iterations: _Count | None = None
    """largest number of Newton iterations in a step, at most half of them as steps of energy
    descent; absent: iterations (load_steps + 19), with contact four times that"""
    arc_length: bool = False
    """follow the path by its arc length from the start, for instance through limit points of the
    load; false: only where no part of the load is small enough"""
    solver: OneSolver = field(default_factory=Auto)
    """linear solver"""

    def settings(self) -> dict[str, Any]:
        """The fields that the integrator takes; 0 where it is to count the iterations itself."""
        return super().settings() | {"total_iterations": self.total_iterations or 0}

    def effect(self) -> Effect:
        """The effect that the step switches on."""
        return Effect("equilibrium", f"step is static, in {counted(self.load_steps, 'load step')}")


STEPS: tuple[type[Step], ...] = (
    *(ExplicitEuler, SymplecticEuler, RK2, RK4),
    *(ImplicitEuler, ImplicitMidpoint, BDF2, Newmark),
    *(EnergyMomentum, BDF2FixedPoint, Static),
)


def _auto(value: Any) -> Any:
    """The word auto, alone or as the type: symplectic Euler with its stable step."""
    if isinstance(value, str) and value.strip().lower() == "auto":
        return SymplecticEuler()
    if isinstance(value, Mapping) and value.get("type") == "auto":
        return {**value, "type": "symplectic_euler"}
    return value


OneStep = Annotated[Step, one_of(*STEPS), BeforeValidator(_auto)]
