"""Hard cases of a trocar, stepped: what each ends in, and the energy that it gives to the hand.

A hand presses into soft tissue for 0.6 s, then the case happens. From then on, the work that the
motors do on the tool is at most what was stored, what the tank held, and what the device has
dissipated since.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, ClassVar

import numpy as np

from tissu import _haptic
from tissu.trocar import kinematics
from tissu.trocar.model import LocalModel, across
from tissu.trocar.ticking import in_core

Rows = dict[str, Any]
TAG = 1
DEPTH = 0.2
COUNT = np.array([np.radians(0.01), np.radians(0.01), np.radians(0.05), 1e-4])
BEFORE, AFTER = 600, 1500
"""Ticks of 1 ms until the case, and after it."""
STILL = 100
"""Ticks at the end, over which the tool's swing is measured."""
ETA = (0.95, 0.95, 0.98, 0.7)
LOSSES: dict[str, Any] = {"efficiency": ETA}
COMPENSATED: dict[str, Any] = {
    "efficiency": ETA,
    "compensated": [6e-3, 6e-3, 1e-3, 0.3],
    "compensation": 0.8,
}
"""Of a transmission with losses, and of motors that make up for them and for friction."""


class Trial:
    """A device with a hand, its loop, and models that come every 20 ms."""

    losses: ClassVar[dict[str, Any]] = {}
    """Of the mechanism of every trial, …"""
    compensated: ClassVar[dict[str, Any]] = {}
    """… and what its motors make up for."""

    def __init__(
        self,
        path: Any = ((0.0, 0.0, 0.0, DEPTH), (0.3, 0.0, 0.0, DEPTH + 0.006)),
        *,
        model: Callable[[Any], LocalModel] | None = None,
        hand: dict[str, Any] | None = None,
        line: dict[str, Any] | None = None,
        mechanism: dict[str, Any] | None = None,
        holds: bool = True,
        **settings: Any,
    ) -> None:
        rows = np.array(path, dtype=float)
        held = _haptic.Hand(list(rows[:, 0]), rows[:, 1:], [0.0] * len(rows)) if holds else None
        made_line, made_mechanism = _haptic.Line(), _haptic.Mechanism()
        self.settings = _haptic.Settings()
        everything = {"run": True, "tag": TAG, **self.compensated, **settings}
        mechanism = {**self.losses, **(mechanism or {})}
        for part, fields in (
            *((held, hand), (made_line, line), (made_mechanism, mechanism)),
            (self.settings, everything),
        ):
            for name, value in (fields or {}).items():
                setattr(part, name, value)
        q = _haptic.Fulcrum().joints(rows[0, 1:])
        self.device = _haptic.SimulatedDevice(q, made_mechanism, made_line, held)
        self.device.set_tool(TAG, True)
        self.loop = _haptic.SteppedLoop(self.device, self.settings)
        self.model = model or floor(DEPTH, 1 / 3e-3)
        self.stamp = 0
        self.tick = self.settings.period

    def publish(self, made: _haptic.LocalModel) -> None:
        """A model of the next stamp."""
        self.stamp += 1
        made.stamp = self.stamp
        self.loop.publish(made)

    def run(self, seconds: float, *, models: bool = True) -> Rows:
        """Ticks for a time, with a new model every 20 ms."""
        left, rows = round(seconds / self.tick), []
        while left > 0:
            if models:
                self.publish(in_core(self.model(self.device.joints), TAG))
            now = min(left, round(0.02 / self.tick)) if models else left
            rows.append(self.loop.run(now))
            left -= now
        return joined(rows)


def joined(rows: list[Rows]) -> Rows:
    """The columns of several runs."""
    return {name: np.concatenate([row[name] for row in rows]) for name in rows[0]}


def plane(depth: float, stiffness: float, normal: Any = (0.0, 0.0, -1.0)) -> Any:
    """A wall on springs across the port's axis."""

    def made(q: Any) -> LocalModel:
        return LocalModel.plane(q, through=(0, 0, depth), normal=normal, stiffness=stiffness)

    return made


floor = plane


def contacts(points: Any, anchors: Any, normals: Any, stiffness: float, friction: float) -> Any:
    """Several contacts with friction."""
    count = len(points)

    def made(q: Any) -> LocalModel:
        return LocalModel(
            joints=q,
            points=np.asarray(points, dtype=float),
            anchors=np.asarray(anchors, dtype=float),
            normals=np.asarray(normals, dtype=float),
            tangents=np.array([across(n) for n in np.asarray(normals, dtype=float)]),
            friction=np.full(count, friction),
            forces=np.zeros((count, 3)),
            compliance=np.eye(3 * count) / stiffness,
        )

    return made


def ring(depth: float) -> Any:
    """Eight contacts on a ring of 2 mm in one plane: their forces are not unique."""
    angle = 2 * np.pi * np.arange(8) / 8
    points = 2e-3 * np.column_stack([np.cos(angle), np.sin(angle), np.zeros(8)])
    normals = np.tile([0.0, 0.0, -1.0], (8, 1))
    return contacts(points, np.add(points, (0.0, 0.0, depth)), normals, 1e6, 0.2)


def at_joints(q: Any) -> Any:
    """The tip at joints, as a place of a path."""
    return kinematics.position(np.asarray(q, dtype=float))


def nothing(_: Trial) -> None:
    """The case is there from the start."""


def not_finite(trial: Trial) -> None:
    """Three models whose compliance is not a number."""
    for _ in range(3):
        made = _haptic.LocalModel(
            stamp=0, tag=TAG, q_ref=trial.device.joints, l=np.zeros((1, 3)),
            anchor=[[0, 0, DEPTH]], normal=[[0, 0, -1.0]], tangent=[[1.0, 0, 0]], friction=[0.0],
            force=np.zeros((1, 3)), W=np.full((3, 3), np.nan),
        )  # fmt: skip
        trial.publish(made)
        trial.loop.run(5)


def passive(delay: float, period: float = 1e-3) -> Any:
    """The automatic coupling."""
    return _haptic.passive_stiffness(
        viscous=[0.03, 0.03, 1e-3, 1.0],
        coulomb=[6e-3, 6e-3, 1e-3, 0.3],
        count_size=COUNT,
        period=period,
        delay=delay,
    )


def at_rate(rate: float) -> Trial:
    """A trocar with another rate."""
    return Trial(line={"period": 1 / rate}, period=1 / rate, stiffness=passive(0.0, 1 / rate))


def pulled_out() -> Trial:
    """A hand that presses 4 cm deep, and pulls the tool out with some 1.5 m/s."""
    path = [(0, 0, 0, 0.04), (0.3, 0, 0, 0.046), (0.6, 0, 0, 0.046), (0.66, 0, 0, 0.0)]
    return Trial(path, model=floor(0.04, 1 / 3e-3), hand={"stiffness": 4000.0, "damping": 60.0})


def near_the_pivot() -> Trial:
    """Contact 22 mm deep, pressed sidewards."""
    path = [(0, 0, 0, 0.022), (0.3, 0.003, 0, 0.0225)]
    return Trial(path, model=plane(0.022, 300.0, normal=(-0.8, 0.0, -0.6)))


def in_the_corner() -> Trial:
    """Pitch and roll of 45 degrees, pressed along the tool."""
    tip = at_joints((0.78, 0.78, 0.0, 0.2))
    n = -tip / np.linalg.norm(tip)
    wall = contacts([(0, 0, 0)], [tip], [n], 333.0, 0.2)
    return Trial([(0, *tip), (0.3, *(tip - 6e-3 * n))], model=wall)


def at_the_end_stop() -> Trial:
    """A hand that presses the pitch 4 degrees beyond its end."""
    begin, end = at_joints((0.74, 0, 0, 0.2)), at_joints((0.855, 0, 0, 0.2))
    return Trial([(0, *begin), (0.3, *end)], model=floor(1.0, 300.0))


def two_walls() -> Trial:
    """Walls from both sides that overlap by 2 mm; the hand goes to and fro between them."""
    turns = np.linspace(0.0, 2.0, 21)
    path = [(t, 0, 0, DEPTH + 2e-3 * np.sin(4 * np.pi * t)) for t in turns]
    ends = [(0, 0, DEPTH - 1e-3), (0, 0, DEPTH + 1e-3)]
    walls = contacts([(0, 0, 0)] * 2, ends, [(0, 0, -1), (0, 0, 1)], 1000.0, 0.0)
    return Trial(path, model=walls)


def changing() -> Trial:
    """A tissue whose stiffness changes by 30 % to and fro with each model."""
    trial = Trial()
    walls = (floor(DEPTH, 650.0), floor(DEPTH, 350.0))
    trial.model = lambda q: walls[trial.stamp % 2](q)
    return trial


CASES: tuple[tuple[str, Callable[[], Trial], Callable[[Trial], Any], bool], ...] = (
    ("unplugged in contact", Trial, lambda t: t.device.unplug(), True),
    ("no model any more", Trial, nothing, False),
    ("three models that are not finite", Trial, not_finite, False),
    ("tool pulled out fast", pulled_out, nothing, True),
    ("bone, W = 0", lambda: Trial(model=floor(DEPTH, 1e9)), nothing, True),
    (
        "5 ms of delay, bone",
        lambda: Trial(model=floor(DEPTH, 1e9), line={"delay": 5e-3}, stiffness=passive(5e-3)),
        nothing,
        True,
    ),
    ("tag changes without removal", Trial, lambda t: t.device.set_tool(8, True), True),
    ("encoder jumps by 1,000 counts", Trial, lambda t: t.device.jump(3, 1000), True),
    ("hand lets go in contact", lambda: Trial(hand={"lets_go": 0.6}), nothing, True),
    ("pushed between two walls", two_walls, nothing, True),
    ("eight contacts in one plane", lambda: Trial(model=ring(DEPTH)), nothing, True),
    ("tip 22 mm from the pivot", near_the_pivot, nothing, True),
    ("pitch and roll of 45 degrees", in_the_corner, nothing, True),
    ("end stop", at_the_end_stop, nothing, True),
    ("clock steps back by 1 s", Trial, lambda t: t.device.step_clock(-(10**9)), True),
    ("six late ticks", Trial, lambda t: t.loop.be_late(6), True),
    ("every fifth frame lost", lambda: Trial(line={"lost": 0.2, "seed": 9}), nothing, True),
    ("stiffness changes by 30 % every 20 ms", changing, nothing, True),
    ("300 Hz", lambda: at_rate(300.0), nothing, True),
    ("10 kHz", lambda: at_rate(10_000.0), nothing, True),
)
"""Name, the trial, what happens after 0.6 s, and whether models go on to come."""


def outcome(
    make: Callable[[], Trial], happens: Callable[[Trial], Any], models: bool
) -> tuple[str, float, float, float]:
    """State at the end, energy given out, its bound [J], and the swing at the end [counts]."""
    trial = make()
    first = trial.run(1e-3 * BEFORE)
    happens(trial)
    rows = trial.run(1e-3 * AFTER, models=models)
    # The work of the motors on the tool, from the case on; the bound at the time of the most.
    given = rows["energy"][:, 2] - first["energy"][-1, 2]
    most = int(np.argmax(given))
    friction = rows["energy"][most, 4] - first["energy"][-1, 4]
    bound = first["stored"][-1] + max(0.0, first["tank"][-1]) + friction
    state, reason = _haptic.STATES[rows["state"][-1]], _haptic.REASONS[rows["reason"][-1]]
    if reason != "none":
        state += f": {reason.replace('_', ' ')}"
    still = rows["joints"][-round(1e-3 * STILL / trial.tick) :]
    swing = float((np.ptp(still, axis=0) / COUNT).max())
    return state, max(0.0, float(given[most])), float(bound), swing


@contextmanager
def with_losses() -> Iterator[None]:
    """Trials of transmissions with losses, which the motors make up for."""
    Trial.losses, Trial.compensated = LOSSES, COMPENSATED
    try:
        yield
    finally:
        Trial.losses, Trial.compensated = {}, {}


def rows_of_cases() -> list[list[str]]:
    """A row for each case: without losses, then with losses that are compensated."""
    rows = []
    for name, make, happens, models in CASES:
        state, *ideal = outcome(make, happens, models)
        with with_losses():
            _, *real = outcome(make, happens, models)
        numbers = []
        for given, bound, swing in (ideal, real):
            within = "yes" if given <= bound + 1e-6 else "no"
            numbers += [f"{1e3 * given:.2f} of {1e3 * bound:.2f}", within, f"{swing:.1f}"]
        rows.append([name, state, *numbers])
    return rows
