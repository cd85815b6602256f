"""Trocars without hardware for tests: devices, walls and loops in a few words. SI units."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tissu import _haptic as haptic

Floats = NDArray[np.float64]
TAG = 7
AT = (0.0, 0.0, 0.0, 0.2)
COUNT = np.array([np.radians(0.01), np.radians(0.01), np.radians(0.05), 1e-4])
STIFFNESS = np.array([48.0, 48.0, 1.6, 1600.0])
LIMIT = np.array([6.0, 6.0, 0.2, 5.0])
STATES = haptic.STATES
REASONS = haptic.REASONS


def settings(**changes: Any) -> haptic.Settings:
    """Settings that run with the tool TAG."""
    return with_fields(haptic.Settings(), {"run": True, "tag": TAG} | changes)


def free_settings(**changes: Any) -> haptic.Settings:
    """Settings without ramp, slew, gate and limits: every tick shows its model alone."""
    fields = {
        "ramp": 0.0,
        "slew": 1.0,
        "tank_gate": False,
        "torque_limit": [1e3] * 4,
        "force_limit": 1e4,
        "speed_limit": 1e9,
    }
    return settings(**(fields | changes))


def model(
    stamp: int,
    *,
    q_ref: ArrayLike = AT,
    anchor: ArrayLike = (),
    normal: ArrayLike = (),
    friction: float = 0.0,
    W: ArrayLike | float = 0.0,
    force: ArrayLike | None = None,
    l: ArrayLike | None = None,
    tag: int = TAG,
) -> haptic.LocalModel:
    """A local model of contacts at the tip, or at the tool's points l; W a matrix, or of each row."""
    anchors = np.reshape(np.asarray(anchor, float), (-1, 3))
    n = len(anchors)
    normals = np.reshape(np.asarray(normal, float), (-1, 3))
    tangents = np.array([across(v) for v in normals]).reshape(-1, 3)
    matrix = np.asarray(W, float)
    return haptic.LocalModel(
        stamp=stamp,
        tag=tag,
        q_ref=q_ref,
        l=np.zeros((n, 3)) if l is None else l,
        anchor=anchors,
        normal=normals,
        tangent=tangents,
        friction=np.full(n, friction),
        force=np.zeros((n, 3)) if force is None else force,
        W=matrix if matrix.ndim == 2 else matrix * np.eye(3 * n),
    )


def across(normal: Floats) -> Floats:
    """A unit vector at right angles to another."""
    least = np.eye(3)[np.argmin(np.abs(normal))]
    tangent = np.cross(normal, least)
    return tangent / np.linalg.norm(tangent)


def floor(stamp: int, depth: float, **changes: Any) -> haptic.LocalModel:
    """A wall across e_Z at this depth: the tool meets it from above."""
    return model(stamp, anchor=[0.0, 0.0, depth], normal=[0.0, 0.0, -1.0], **changes)


def counts_of(q: ArrayLike) -> list[int]:
    """The counts whose position is nearest to q, and those of the grip."""
    return [*(int(n) for n in np.rint(np.asarray(q) / COUNT)), 0]


READY = 1 | 2 | 4  # homed, enabled, tool in


class Driver:
    """Ticks at positions of one's choice; the tool is in, homed and known."""

    def __init__(self, given: haptic.Settings) -> None:
        """Starts, and takes ticks at AT so that the next one gives force."""
        self.ticks = haptic.Ticks(given)
        self.period = given.period
        self.number = 0
        for _ in range(3):
            self.at(AT)

    def at(self, q: ArrayLike, made: haptic.LocalModel | None = None, **changes: Any) -> dict[str, Any]:
        """One tick with the device at joints q."""
        return self.counts(counts_of(q), made, **changes)

    def counts(
        self, counts: Sequence[int], made: haptic.LocalModel | None = None, **changes: Any
    ) -> dict[str, Any]:
        """One tick at these counts."""
        self.number += 1
        now = round(self.number * self.period * 1e9)
        given = {"flags": READY, "tag": TAG, "now_ns": now, "time_ns": now} | changes
        return self.ticks.tick(counts=counts, model=made, **given)


def hand(points: Sequence[Sequence[float]], **changes: Any) -> haptic.Hand:
    """A hand along rows of time and place."""
    rows = np.asarray(points, float)
    made = haptic.Hand(list(rows[:, 0]), rows[:, 1:], [0.0] * len(rows))
    return with_fields(made, changes)


def with_fields(made: Any, fields: dict[str, Any]) -> Any:
    """The object with attributes set by name."""
    for name, value in fields.items():
        setattr(made, name, value)
    return made


def device(
    held: haptic.Hand | None = None,
    *,
    q: ArrayLike = AT,
    mechanism: dict[str, Any] | None = None,
    line: dict[str, Any] | None = None,
) -> haptic.SimulatedDevice:
    """A simulated device with the tool TAG in it."""
    made = haptic.SimulatedDevice(
        q,
        with_fields(haptic.Mechanism(), mechanism or {}),
        with_fields(haptic.Line(), line or {}),
        held,
    )
    made.set_tool(TAG, True)
    return made


FREE = {"viscous": np.zeros(4), "coulomb": np.zeros(4)}
EXACT = {"count_size": [1e-9] * 5, "torque_bits": 0, "motor_lag": 0.0}
