"""The common part of all obstacles, and how the points of one are written."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from tissu import units
from tissu.errors import ParameterError
from tissu.reading import Maybe, MaybeVector, listed, written
from tissu.scene.effect import Effect
from tissu.scene.field import field
from tissu.scene.motion import Motion
from tissu.scene.part import Part
from tissu.scene.problem import Problem
from tissu.scene.unknown import rule

POSITION = units.Triple(units.LENGTH)
"""Reads a position."""

Ends = tuple[tuple[float, float, float], tuple[float, float, float]]
"""Two positions."""


def ends_of(value: object) -> object:
    """Two positions, of what is written.

    Raises:
        ParameterError: not two of them.
    """
    value = listed(value)
    if not isinstance(value, (list, tuple)) or len(value) != 2:
        text = "two points are accepted, such as [[0, 0, 0], [0, 0, 5 cm]]"
        raise ParameterError(f"found {written(value)}; {text}")
    return tuple(POSITION(end) for end in value)


class Obstacle(Part):
    """The common part of all obstacles."""

    motion: Motion | None = None
    """its prescribed path; absent: it stands still"""
    mass: Maybe[units.Mass] = field(default=None, gt=0.0)
    """mass [kg], of uniform density, of an obstacle that moves freely; absent: it follows its path,
    or stands still
    """
    velocity: MaybeVector[units.Velocity] = field(default=None)
    """velocity at the start [m/s] of an obstacle with a mass; absent: zero"""
    spin: MaybeVector[units.Spin] = field(default=None)
    """angular velocity at the start about the centre of mass [rad/s] of an obstacle with a mass;
    absent: zero
    """
    if TYPE_CHECKING:
        type: str

    @rule("mass", "motion")
    def _is_led_or_free(self) -> Iterator[Problem]:
        if self.mass is not None and self.motion is not None:
            text = f"found {self.mass:g} kg with `motion`; an obstacle with a mass moves freely, "
            yield Problem(("mass",), f"{text}one that is led has none: leave one of them out")

    @rule("mass", "velocity", "spin")
    def _moves(self) -> Iterator[Problem]:
        for name in ("velocity", "spin"):
            if getattr(self, name) is not None and self.mass is None:
                text = f"found a {name} without a mass; give the obstacle a mass, so that it moves "
                yield Problem((name,), f"{text}freely, or lead it by `motion`")

    def effect(self, name: str) -> Effect:
        """What an obstacle of this name switches on."""
        led = "" if self.motion is None else f", {self.motion.words()}"
        led += "" if self.mass is None else f", free, mass {self.mass:g} kg"
        words = self.words()
        article = "an" if words[0] in "aeiou" else "a"
        return Effect(f"obstacle {name}", f"obstacles.{name} is {article} {words}{led}")

    def words(self) -> str:
        """Its shape and numbers, as `check` says them."""
        raise NotImplementedError
