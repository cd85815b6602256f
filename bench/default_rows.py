"""The rows of bench/defaults.py, and their times: every choice in turn, so that drift cancels."""

from __future__ import annotations

import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from default_scenes import SCENES, fixed, read_scenes

import tissu as ts

TURN, LEAST = 5, 4
"""steps that a choice takes in its turn, and rounds that a row has at least"""
LATE = 4.0
"""times what `auto` took in a turn after the first: a choice that takes more is left out then"""
LARGEST_FACTOR, LARGEST_PLAIN = 60_000, 400_000
"""unknowns beyond which the factors, and block-Jacobi, are left out"""


@dataclass(frozen=True)
class Row:
    """A scene, its unknowns, its step and its threads."""

    scene: str
    size: float
    step: str = "10 ms"
    threads: int = 1

    def __str__(self) -> str:
        """As the table and --rows name it."""
        threads = "" if self.threads == 1 else f", {self.threads} threads"
        return f"{self.scene}, {self.size:.0e}, {self.step}{threads}"


BARS = ("bar", "bar of hexahedra", "cube")
OTHERS = ("thin plate", "slivers", "contrast 1e6", "nu 0.499", "shell", "frames")
MORE = ("half condensed", "mixed cells", "cut")
READ = ("organ", "liver", "phantom")
ROWS = [
    *(Row(name, size) for name in BARS for size in (1e3, 1e4)),
    *(Row(name, 1e4, step) for name in BARS for step in ("1 ms", "100 ms", "static")),
    *(Row(name, 3e3) for name in (*OTHERS, *MORE)),
    *(Row(name, 3e3, "static") for name in (*OTHERS[:4], MORE[0])),
    Row("shell", 1e3, "static"),
    *(Row(name, 1e4, step) for name in READ for step in ("10 ms", "static")),
    *(Row(name, size, threads=2) for name in ("bar", "cube") for size in (1e4, 1e5)),
    *(Row(name, 1e5) for name in BARS),
    Row("bar", 1e6, threads=2),
]


@dataclass
class Taken:
    """Seconds of the solves of a choice's steps.

    Attributes:
        steps: of every step but the first; of every solve of a static scene.
        first: of the first.
        failed: numbers of the steps that were not solved; the first is 0.
        past: the limit [s] that it ran past; 0: none.
    """

    steps: list[float] = field(default_factory=list)
    first: float = float("nan")
    failed: list[int] = field(default_factory=list)
    past: float = 0.0

    def later(self, steps: int | None = None) -> list[float]:
        """The second half of so many steps, or of all, when `auto` has learned."""
        some = self.steps[:steps]
        return some[len(some) // 2 :] or [float("nan")]

    def mean(self, steps: int | None = None) -> float:
        """Of the second half; factors and levels that are made anew count."""
        return float(np.mean(self.later(steps)))

    def p50(self) -> float:
        """Of the second half."""
        return float(np.median(self.later()))

    def failures(self, steps: int) -> int:
        """How many of the first and so many further steps were not solved."""
        return sum(number <= steps for number in self.failed)


class LateError(Exception):
    """A step ran past its limit."""


@contextmanager
def within(seconds: float) -> Iterator[None]:
    """Stops what runs past a limit."""

    def stop(_number: int, _frame: Any) -> None:
        raise LateError

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


def step_of(name: str, solver: Any) -> Any:
    """The step of a row."""
    return ts.Static(solver=solver) if name == "static" else ts.ImplicitEuler(name, solver=solver)


def choices(size: float) -> dict[str, Any]:
    """`auto`, and every fixed choice that a row of so many unknowns has."""
    found = {"auto": ts.Auto(), **fixed(ts.Auto().tolerance)}
    if size > LARGEST_FACTOR:
        del found["stale_cholesky"], found["cholesky"]
    if size > LARGEST_PLAIN:
        del found["block_jacobi"]
    return found


def solved(simulation: ts.Simulation) -> tuple[float, bool]:
    """Seconds of the solves of one step, and whether it was solved."""
    simulation.clear_profile()
    try:
        converged = simulation.step().converged
    except ts.errors.TissuError:
        converged = False
    rows = (row for row in simulation.profile().rows if row.effect == "linear solver")
    return 1e-3 * sum(row.ms_per_step for row in rows), converged


def turn(simulation: ts.Simulation, taken: Taken, steps: int, *, cut: bool, limit: float) -> float:
    """Steps of one choice; the seconds that they took."""
    begin = time.perf_counter()
    try:
        with within(limit):
            for number in range(steps):
                if cut and number == steps - 1:
                    last = simulation.meshes["body"].cell_count - 1
                    simulation.remove_cells(body="body", cells=[last])
                seconds, converged = solved(simulation)
                if not converged:
                    taken.failed.append(0 if np.isnan(taken.first) else 1 + len(taken.steps))
                if np.isnan(taken.first):
                    taken.first = seconds
                else:
                    taken.steps.append(seconds)
    except LateError:
        taken.past = limit
    return time.perf_counter() - begin


def timed(row: Row, seconds: float, meshes: Path | None = None) -> dict[str, Taken]:
    """Every choice in turn, in about so many seconds and at least LEAST rounds."""
    begin = time.perf_counter()
    make = {**SCENES, **read_scenes(meshes)}[row.scene]
    scenes = {
        name: make(row.size, step_of(row.step, solver)).replace(threads=row.threads)
        for name, solver in choices(row.size).items()
    }
    still = row.step == "static"
    running = {} if still else {name: scene.compile() for name, scene in scenes.items()}
    taken = {name: Taken() for name in scenes}
    spent = dict.fromkeys(scenes, 0.0)
    rounds = 0
    while rounds < LEAST or time.perf_counter() - begin < seconds:
        names = list(scenes)
        for name in names[rounds % len(names) :] + names[: rounds % len(names)]:
            of = taken[name]
            dear = rounds > 1 and name != "auto" and spent[name] > LATE * spent["auto"]
            over = time.perf_counter() - begin > 2.0 * seconds and rounds >= 2
            if of.past or dear or over:
                continue
            simulation = scenes[name].compile() if still else running[name]
            steps = 1 if still or row.size > LARGEST_PLAIN else TURN
            limit = max(5.0, 4.0 * seconds) if name == "auto" else max(2.0, seconds)
            limit = max(limit, 60.0) if row.size > LARGEST_PLAIN else limit
            spent[name] = turn(simulation, of, steps, cut=row.scene == "cut", limit=limit)
        rounds += 1
        if time.perf_counter() - begin > 3.0 * seconds:
            break
    if still:
        for of in taken.values():
            of.steps.append(of.first)
    return taken
