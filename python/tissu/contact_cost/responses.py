"""The same scenes by every response: what each costs, and what it gets wrong."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial

from tissu import scene as parts
from tissu.contact_cost.measure import Row, measure
from tissu.contact_cost.scenes import CASES, Case
from tissu.front import Scene
from tissu.scene.step import Step

SCENES = ("cube", "stick", "slide")
"""Cases that every response runs: a fall, and slopes below and above the angle of friction."""
SHARE = 0.8  # of the stable step, as dt: auto has it


@dataclass(frozen=True)
class Response:
    """A method of contact and a step that has it; dt 0 is four fifths of the stable step.

    Attributes:
        method: as a scene writes it.
        step: takes a dt [s].
        dt: of a step [s].
        law: of the method penalty.
    """

    method: str
    step: Callable[[float], Step]
    dt: float = 0.0
    law: str = "linear"

    def contact(self) -> parts.ContactSettings:
        """The settings of a scene."""
        return parts.ContactSettings(method=self.method, penalty=self.law)  # type: ignore[arg-type]


RESPONSES: dict[str, Response] = {
    "augmented, implicit_euler": Response("augmented", parts.ImplicitEuler, 0.01),
    "augmented, bdf2": Response("augmented", parts.BDF2, 0.01),
    "augmented, implicit_midpoint": Response("augmented", parts.ImplicitMidpoint, 0.01),
    "augmented, newmark": Response("augmented", parts.Newmark, 0.01),
    "augmented, energy_momentum": Response("augmented", parts.EnergyMomentum, 0.01),
    "penalty, implicit_euler": Response("penalty", parts.ImplicitEuler, 0.01),
    "penalty (reciprocal), implicit_euler": Response(
        "penalty", parts.ImplicitEuler, 0.01, "reciprocal"
    ),
    "penalty, bdf2": Response("penalty", parts.BDF2, 0.01),
    "barrier, implicit_euler": Response("barrier", parts.ImplicitEuler, 0.01),
    "impulse, symplectic_euler": Response("impulse", parts.SymplecticEuler),
    "penalty, symplectic_euler": Response("penalty", parts.SymplecticEuler),
    "geometric, symplectic_euler": Response("geometric", parts.SymplecticEuler),
}


def by_response(case: Case, response: Response) -> Case:
    """The case with that method of contact, in its steps."""

    def made(scene: Callable[[], Scene], dt: float, contact: parts.ContactSettings | None) -> Scene:
        return scene().replace(step=response.step(dt), contact=contact)

    dt = response.dt
    if dt == 0.0:
        trial = case.scene().replace(step=parts.SymplecticEuler(), contact=response.contact())
        dt = SHARE * trial.compile().stable_step
    return replace(
        case,
        scene=partial(made, case.scene, dt, response.contact()),
        without=partial(made, case.without, dt, None),
        dt=dt,
    )


def measured_responses(names: tuple[str, ...] = SCENES) -> Iterator[tuple[str, float, Row]]:
    """Name of a response, dt [s] and what came of a case, case by case."""
    for name in names:
        for label, response in RESPONSES.items():
            case = by_response(CASES[name](), response)
            yield label, case.dt, measure(case, beside=False)
