"""A trocar of a scene: a port, the device that is in it, its tools, and what the hand may feel."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterator, Mapping
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import PlainValidator, ValidationInfo

from tissu import _core, units
from tissu.errors import ParameterError
from tissu.reading import MaybeVector, Read, written
from tissu.scene.effect import Effect, vector_in_words
from tissu.scene.field import field
from tissu.scene.part import Part, keeps_problems
from tissu.scene.problem import Path, Problem
from tissu.scene.step import Static
from tissu.scene.trocar.axes import AXIS_NAMES, Damping, Stiffness
from tissu.scene.trocar.compensation import TrocarCompensation
from tissu.scene.trocar.device import OneDevice
from tissu.scene.trocar.limits import TrocarLimits
from tissu.scene.trocar.passive import MARGIN, Bound, passive_bounds
from tissu.scene.trocar.port import Port
from tissu.scene.trocar.tool import Tools
from tissu.scene.trocar.tool_rules import tool_problems
from tissu.scene.unknown import Unknown, Unread, below, rule

__all__ = ["Trocar", "Coupling"]

ComplianceWay = Literal["factor", "cg", "condensed", "warped"]
LEAST_RATE, LARGEST_RATE = 300.0, 10_000.0
LONGEST_STEP = 0.5
"""s: the force of older tissue fades, and the tool stays where it is (`stall` of the ticks)"""
LEAST_APART = 0.1
"""m between two ports: a cradle is a sphere of 100 mm (thesis, table 5.4.5)."""


class Coupling(Part):
    """Stiffness of the spring between the device and the tool that the tissue sees."""

    stiffness: Stiffness = field(kw_only=False)
    """stiffness of pitch, roll, rotation [N m/rad] and depth [N/m]; at most the passive stiffness
    of the device
    """
    damping: Damping = field(default=(0.0, 0.0, 0.0, 0.0))
    """virtual damping of pitch, roll, rotation [N m s/rad] and depth [N s/m] while a force is
    given; at most what the stiffness leaves of the device's own damping
    """


def _coupling(value: Any, info: ValidationInfo) -> Any:
    if value == "automatic" or isinstance(value, Coupling):
        return value
    if not isinstance(value, Mapping):
        text = "automatic is accepted, or {stiffness: [48, 48, 1.6, 1600]}"
        problem = Problem((), f"found {written(value)}; {text}")
        if keeps_problems(info):
            return Unread((problem,))
        raise ParameterError(problem.text)
    return Coupling.model_validate(value, context=info.context)


class Trocar(Part):
    """A driven port: its device measures the place of the tool and drives the hand."""

    port: Port
    """the place of its pivot, and its axes"""
    device: OneDevice
    """the device that measures the hand and drives it"""
    tools: Tools = field(default_factory=dict)
    """tag of a tool -> name of an obstacle or instrument; absent: every tool is accepted, whatever
    its tag
    """
    rate: units.Rate = field(default=1000.0)
    """ticks a second, 300 Hz to 10 kHz"""
    coupling: Annotated[
        Read[Coupling | Literal["automatic"], Coupling | Literal["automatic"]],
        PlainValidator(_coupling),
    ] = field(default="automatic")
    """automatic: 0.8 of the largest passive stiffness of each axis; or a stiffness"""
    limits: TrocarLimits = field(default_factory=TrocarLimits)
    """limits of force, torque, speed and travel"""
    gravity: MaybeVector[units.Acceleration] = field(default=None)
    """acceleration of gravity on the tool, in the scene's axes [m/s^2]; absent: the device is
    balanced, and its tool has no weight
    """
    compensation: TrocarCompensation = field(default_factory=TrocarCompensation)
    """friction and weight that the motors carry"""
    compliance: ComplianceWay = field(default="factor")
    """how the compliance of the tissue is computed for the ticks. factor: with a kept factor of the
    step's matrix, corrected; cg: with conjugate gradients; condensed: from a table, for stiffness
    that does not change; warped: from the table of the rest shape, rotated with the nodes
    """

    @rule("rate")
    def _is_fast_enough(self) -> Iterator[Problem]:
        if not LEAST_RATE <= self.rate <= LARGEST_RATE:
            text = f"found {self.rate:g} Hz; {LEAST_RATE:g} Hz to {LARGEST_RATE / 1000:g} kHz are "
            text += "accepted: slower ticks are felt, and 1 kHz is usual"
            yield Problem(("rate",), text)

    @rule("coupling")
    def _is_passive(self) -> Iterator[Problem]:
        bounds = self.bounds()
        if bounds is None:
            text = "is automatic, and the damping and friction of the device are not known; measure"
            text += " them with `tissu trocar identify`, or give a stiffness"
            if self.coupling == "automatic":
                yield Problem(("coupling",), text)
            return
        if isinstance(self.coupling, Coupling):
            rows = zip(AXIS_NAMES, self.coupling.stiffness, bounds, strict=True)
            for number, (name, stiffness, bound) in enumerate(rows):
                if stiffness > bound.stiffness:
                    unit = "N/m" if name == "depth" else "N m/rad"
                    text = f"found {stiffness:g} {unit} on {name}, above the passive bound of "
                    text += f"{bound.stiffness:.4g} {unit}, {bound.why}; at most that is accepted"
                    yield Problem(("coupling", "stiffness", number), text)

    @rule("coupling")
    def _is_damped_passively(self) -> Iterator[Problem]:
        """Colgate and Schenkel 1997: b > K T / 2 + B, here with the delay."""
        known = self.device.dissipation()
        if not isinstance(self.coupling, Coupling) or known is None:
            return
        hold = 0.5 / self.rate + self.device.loop_delay()
        rows = zip(
            AXIS_NAMES, self.coupling.damping, self.coupling.stiffness, known[0], strict=True
        )
        for number, (name, damping, stiffness, own) in enumerate(rows):
            most = max(0.0, own - stiffness * hold)
            if damping > most * (1.0 + 1e-9):
                unit = "N s/m" if name == "depth" else "N m s/rad"
                text = f"found {damping:g} {unit} on {name}; at most {most:.4g} {unit} is accepted,"
                text += " what the stiffness leaves of the damping of the device"
                yield Problem(("coupling", "damping", number), text)

    @rule("compensation", "gravity", "device")
    def _compensates_what_is_there(self) -> Iterator[Problem]:
        if self.compensation.mass > 0.0 and not any(self.gravity or ()):
            text = f"found {self.compensation.mass:g} kg without gravity; `gravity` of the trocar "
            text += "beside it is accepted, such as [0, 0, -9.81]"
            yield Problem(("compensation", "mass"), text)
        if self.compensation.friction > 0.0 and self.device.dissipation() is None:
            text = f"found {self.compensation.friction:g} of a friction that is not known; the "
            text += "`damping` and `friction` of the device beside it are accepted, as `tissu "
            text += "trocar identify` finds them"
            yield Problem(("compensation", "friction"), text)

    def bounds(self) -> list[Bound] | None:
        """The largest passive stiffness of each axis; None where the device is not known enough."""
        known = self.device.dissipation()
        if known is None:
            return None
        delay = self.device.loop_delay()
        return passive_bounds(*known, self.device.counts, 1.0 / self.rate, delay)

    def stiffness(self) -> tuple[float, ...]:
        """K_c of each axis [N m/rad, N m/rad, N m/rad, N/m]."""
        if isinstance(self.coupling, Coupling):
            return self.coupling.stiffness
        return tuple(MARGIN * bound.stiffness for bound in self.bounds() or ())

    def effect(self, name: str) -> Effect:
        """The effect that it switches on."""
        felt = ", ".join(f"{value:.4g}" for value in self.stiffness())
        text = f"trocars.{name} is {self.device.words()}, {self.port.words()}, {self.rate:g} Hz, "
        kind = "automatic" if self.coupling == "automatic" else "given"
        text += f"coupling {kind}: {felt} N m/rad and N/m, compliance {self._compliance()}"
        text += "".join(f", {words}" for words in self.carried_words())
        return Effect(f"trocar {name}", text)

    def carried_words(self) -> list[str]:
        """What pulls at the tool, what is lost on the way to it, and what the motors make good."""
        found = []
        if self.gravity is not None:
            found.append(f"gravity {vector_in_words(self.gravity)} m/s^2")
        if self.compensation.mass > 0.0:
            found.append(f"the weight of {self.compensation.mass:g} kg carried")
        if any(eta < 1.0 for eta in self.device.efficiency):
            each = ", ".join(f"{eta:g}" for eta in self.device.efficiency)
            found.append(f"efficiency {each}")
        if self.compensation.friction > 0.0:
            found.append(f"{self.compensation.friction:.0%} of the friction compensated")
        return found

    def _compliance(self) -> str:
        """How it is found, and with what."""
        if self.compliance == "cg":
            return "by the conjugate gradient"
        library = _core.factor_library()
        slower = "" if library == "CHOLMOD" else ", which is slower than CHOLMOD's"
        if self.compliance == "factor":
            return f"by a factor that is kept ({library}{slower})"
        return f"{self.compliance}, from a table made once ({library}{slower})"


Trocars = Read[dict[str, Trocar], Mapping[str, Trocar]]


def trocar_problems(scene: Any) -> Iterator[Problem]:
    """What is wrong between the trocars of a scene, and with the tools that they name."""
    trocars = getattr(scene, "trocars", {})
    for name, trocar in trocars.items():
        with contextlib.suppress(Unknown):
            yield from below("trocars", below(name, tool_problems(trocar, scene)))
    if any(trocar.tools for trocar in trocars.values()):
        yield from _step_problems(getattr(scene, "step", None))
    names = list(trocars)
    for second in range(len(names)):
        for first in range(second):
            with contextlib.suppress(Unknown):
                yield from _pair_problems(trocars, names[first], names[second])


def _step_problems(step: Any) -> Iterator[Problem]:
    """A step that is longer than the ticks wait for the tissue: a tool would stay where it met."""
    seconds = getattr(step, "dt", None)
    if isinstance(step, Static):
        text = "found static, whose steps of 1 s are too long for a hand; "
    elif isinstance(seconds, float) and seconds > LONGEST_STEP:
        text = f"found a dt of {seconds:g} s, too long for a hand; "
    else:
        return
    text += (
        f"under a trocar's tool steps of at most {LONGEST_STEP:g} s are accepted, such as those of "
    )
    yield Problem(("step",), f"{text}implicit_euler or bdf2 with viscosity")


def _pair_problems(trocars: Mapping[str, Trocar], first: str, second: str) -> Iterator[Problem]:
    """Two trocars that stand in each other's way, or have one device."""
    one, other = trocars[first], trocars[second]
    identity = other.device.identity()
    path: Path = ("trocars", second)
    if identity is not None and identity == one.device.identity():
        text = f"found {identity}, which trocars.{first} has too; a device has one controller"
        yield Problem((*path, "device"), text)
    for name in other.tools.values():
        if name in one.tools.values():
            text = f"found '{name}', which trocars.{first} has too; one trocar leads a tool: give "
            yield Problem((*path, "tools"), f"{text}this one an obstacle or instrument of its own")
    apart = float(np.linalg.norm(np.subtract(one.port.at, other.port.at)))
    if apart < LEAST_APART * (1.0 - 1e-9) and not math.isnan(apart):
        text = f"found {apart:.4g} m to the port of trocars.{first}; at least {LEAST_APART:g} m "
        yield Problem((*path, "port", "at"), f"{text}is accepted: their cradles would collide")
