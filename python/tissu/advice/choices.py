"""What may be chosen of each of a setting's parts, the other parts as they are."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from tissu.advice.resolution import SCALES
from tissu.advice.setting import Setting, is_explicit
from tissu.scene.solver import Auto, Cholesky, ConjugateGradient
from tissu.scene.step import (
    BDF2,
    BDF2FixedPoint,
    Implicit,
    ImplicitEuler,
    Newton,
    Static,
    SymplecticEuler,
)

if TYPE_CHECKING:
    from tissu.advice.goal import Goal
    from tissu.advice.laboratory import Laboratory

PARTS = ("step", "scale", "order", "family", "newton", "solver", "tolerance", "model")
"""Parts of a setting, in the order in which they are tried."""

_TOLERANCES = (1e-3, 1e-4, 1e-6)
_KEEPS_LAW = {  # models that may stand in for one another, and the laws that they compute
    "fem": None,
    "mean_dilatation": None,
    "mass_tensor": ("stvk",),
    "mass_link": ("stvk", "neo_hooke"),
    "corotational": ("hooke",),
}
_OF_BOTH_ORDERS = ("", "fem", "condensed")  # models that take cells of second order


@dataclass(frozen=True, slots=True)
class Choices:
    """What else may be set.

    Attributes:
        lab: where settings run.
        goal: what is asked for.
        finest: setting of the reference, beyond which nothing can be judged.
        models: models to try beside those that keep the scene's laws.
        explicit: whether methods without a system are tried, or only those.
        until: what is to be left of the budget then [s].
    """

    lab: Laboratory
    goal: Goal
    finest: Setting
    models: Sequence[str] = ()
    explicit: bool = False
    until: float = 0.0

    def of(self, part: str, setting: Setting) -> list[Setting]:
        """Other settings, which differ in one part."""
        ways = {
            "step": self._steps,
            "scale": self._scales,
            "order": self._orders,
            "family": self._families,
            "newton": _newtons,
            "solver": _solvers,
            "tolerance": _tolerances,
            "model": self._models,
        }
        others = ways[part](setting)
        return [o for o in others if o.key() != setting.key() and self.allows(o)]

    def allows(self, setting: Setting) -> bool:
        """Whether a setting's method is of the kind that is tried."""
        return is_explicit(setting) == self.explicit

    def _steps(self, setting: Setting) -> Iterator[Setting]:
        step: Any = setting.step
        if isinstance(step, Static):
            return
        update = 1.0 / self.goal.rate
        shortest = getattr(self.finest.step, "dt", 0.0)
        shortest = shortest if isinstance(shortest, float) else 0.0
        if is_explicit(setting):
            yield replace(setting, step=SymplecticEuler())
            yield replace(setting, step=BDF2(dt=update / 2, solver=Auto(tolerance=1e-4)))
            yield replace(setting, step=ImplicitEuler(dt=update / 2, solver=Auto(tolerance=1e-4)))
            return
        lengths = [factor * step.dt for factor in (0.5, 2.0)] + [update] * (step.dt > update)
        for dt in lengths:
            if min(shortest, update) * (1.0 - 1e-9) <= dt <= update * (1.0 + 1e-9):
                yield replace(setting, step=step.replace(dt=dt))
        if isinstance(step, BDF2FixedPoint):
            yield replace(setting, step=BDF2(dt=step.dt, solver=Auto(tolerance=1e-4)))
        if isinstance(step, ImplicitEuler):
            same = {name: getattr(step, name) for name in ("newton", "indefinite", "solver")}
            yield replace(setting, step=BDF2(dt=step.dt, **same))
        yield replace(setting, step=SymplecticEuler())

    def _scales(self, setting: Setting) -> Iterator[Setting]:
        for scale in self._neighbours(setting):
            yield replace(setting, scale=scale)

    def _neighbours(self, setting: Setting) -> Iterator[Fraction]:
        """The next number of cells that is clearly smaller, and the next that is larger."""
        available = [
            scale
            for scale in SCALES
            if scale <= self._most(setting.order)
            and self.lab.resolutions.bodies(scale, setting.order, setting.family) is not None
        ]
        lower = [scale for scale in available if scale <= Fraction(3, 4) * setting.scale]
        upper = [scale for scale in available if scale >= Fraction(4, 3) * setting.scale]
        yield from lower[-1:]
        yield from upper[:1]

    def _most(self, order: int) -> Fraction:
        """The largest number of cells that the reference can judge."""
        return self.finest.scale * (2 if order < self.finest.order else 1)

    def _orders(self, setting: Setting) -> Iterator[Setting]:
        """The other order, with the same cells, and second order with fewer of them."""
        other = replace(setting, order=3 - setting.order)
        if other.order == 2 and other.model not in _OF_BOTH_ORDERS:
            other = replace(other, model="")
        yield other
        if other.order == 2:
            yield from self._fewer(other)

    def _fewer(self, setting: Setting) -> Iterator[Setting]:
        """The same with fewer cells."""
        for scale in self._neighbours(setting):
            if scale < setting.scale:
                yield replace(setting, scale=scale)

    def _families(self, setting: Setting) -> Iterator[Setting]:
        """Richer cells of generated bars or the scene's own, of both orders."""
        for family in ("", *self.lab.resolutions.families):
            if family == setting.family:
                continue
            other = replace(setting, family=family)
            yield other
            if other.model in _OF_BOTH_ORDERS:
                rich = replace(other, order=2)
                yield rich
                yield from self._fewer(rich)

    def _models(self, setting: Setting) -> Iterator[Setting]:
        bodies = self.lab.scene.bodies.values()
        laws = {law.type for body in bodies for law in body.laws().values()}
        own = {model.type for body in bodies for model in body.models().values()}
        if len(own) > 1:
            return
        yield replace(setting, model="")
        keep = [n for n, taken in _KEEPS_LAW.items() if taken is None or laws <= set(taken)]
        for name in [*(keep if own & set(keep) else []), *self.models]:
            if name not in own:
                order = setting.order if name in _OF_BOTH_ORDERS else 1
                yield replace(setting, model=name, order=order)


def _newtons(setting: Setting) -> Iterator[Setting]:
    step: Any = setting.step
    loose = Newton(tolerance=1e-3)
    if isinstance(step, Static):
        yield replace(setting, step=step.replace(newton=step.newton.replace(tolerance=1e-3)))
        yield replace(setting, step=step.replace(newton=step.newton.replace(tolerance=1e-6)))
    elif isinstance(step, Implicit):
        for newton in (None, loose, Newton()):
            yield replace(setting, step=step.replace(newton=newton))


def _solvers(setting: Setting) -> Iterator[Setting]:
    step: Any = setting.step
    if not hasattr(step, "solver"):
        return
    tolerance = getattr(step.solver, "tolerance", 1e-6)
    for solver in (
        ConjugateGradient(tolerance=tolerance),
        ConjugateGradient(tolerance=tolerance, preconditioner="incomplete_cholesky"),
        ConjugateGradient(tolerance=tolerance, preconditioner="multigrid"),
        Cholesky(),
        Auto(tolerance=tolerance),
    ):
        yield replace(setting, step=step.replace(solver=solver))


def _tolerances(setting: Setting) -> Iterator[Setting]:
    step: Any = setting.step
    if hasattr(getattr(step, "solver", None), "tolerance"):
        for tolerance in _TOLERANCES:
            yield replace(
                setting, step=step.replace(solver=step.solver.replace(tolerance=tolerance))
            )
