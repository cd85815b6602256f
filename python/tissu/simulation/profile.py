"""Where the time of the steps went: one row for each effect that ran, none for what is absent."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from tissu import _core

from tissu.counted import counted


@dataclass(frozen=True, slots=True)
class ProfileRow:
    """One stage of one effect.

    Attributes:
        effect: elasticity, gravity, linear solver, …
        stage: force, product, matrix, preconditioner, factor or solve.
        calls: over all steps.
        ms_per_step: wall time [ms].
        share: of the wall time of all steps, 0 to 1.
    """

    effect: str
    stage: str
    calls: int
    ms_per_step: float
    share: float


@dataclass(frozen=True, slots=True)
class Solves:
    """The work of the linear solver in all steps.

    Attributes:
        solves: linear systems.
        iterations: of all of them; a direct solve counts one.
        preparations: preconditioners or factors made.
        failures: systems that were not solved to the tolerance.
        residual: the largest |b - A x| / |b|.
        work: their work, in bytes that a product of the matrix reads; counted, never timed.
        account: the choice of `auto`, and the counts behind it; empty for another solver.
    """

    solves: int
    iterations: int
    preparations: int
    failures: int
    residual: float
    work: float
    account: str = ""

    def __str__(self) -> str:
        """One line."""
        failed = f", {self.failures} not to the tolerance" if self.failures else ""
        return (
            f"linear solver: {counted(self.solves, 'system')}{failed}, "
            f"{self.iterations / max(self.solves, 1):.3g} iterations each, "
            f"{self.preparations} prepared, largest residual {self.residual:.2g}"
            + (f"\nauto: {self.account}" if self.account else "")
        )


@dataclass(frozen=True, slots=True)
class WorstStep:
    """The longest step after the first, which prepares; the first where there is no other.

    Attributes:
        step: its number since the profile was cleared, from 1 on; 0 where no step was taken.
        ms: its wall time [ms].
        rows: effect, stage and wall time [ms] of what ran in it, the longest first.
        solves: linear systems.
        iterations: of all of them.
        preparations: preconditioners or factors made, or parts of one.
    """

    step: int
    ms: float
    rows: tuple[tuple[str, str, float], ...]
    solves: int
    iterations: int
    preparations: int

    def __str__(self) -> str:
        """One line, with the three longest rows."""
        if not self.step:
            return "no step was taken yet"
        parts = [f"{effect}: {stage} {ms:.3f} ms" for effect, stage, ms in self.rows[:3]]
        if self.solves:
            parts.append(
                f"{counted(self.solves, 'system')}, {counted(self.iterations, 'iteration')}, "
                f"{self.preparations} prepared"
            )
        which = "only step" if self.step == 1 else f"longest after the first: step {self.step}"
        return f"{which}, {self.ms:.3f} ms" + "".join(f"; {part}" for part in parts)


@dataclass(frozen=True, slots=True)
class Profile:
    """Times of a simulation.

    Attributes:
        rows: one for each effect and stage, in the order in which a step meets them.
        steps: how many were taken.
        p50_ms: median wall time of a step, of the latest 4096 steps.
        p95_ms: 95 % of them were shorter.
        p99_ms: 99 % of them were shorter.
        max_ms: the longest of them.
        real_time_factor: simulated time over wall time; above 1 is faster than real time.
        solves: counts of the linear solver.
        worst: the longest step after the first, and where its time went.
    """

    rows: tuple[ProfileRow, ...]
    steps: int
    p50_ms: float
    p95_ms: float
    p99_ms: float
    max_ms: float
    real_time_factor: float
    solves: Solves
    worst: WorstStep

    def __str__(self) -> str:
        """A table: effect, calls, milliseconds a step, share."""
        if not self.steps:
            return "no step was taken yet"
        names = [f"{row.effect}: {row.stage}" for row in self.rows]
        width = max([len("effect"), *map(len, names)])
        lines = [f"{'effect':<{width}}  {'calls':>7}  {'ms/step':>9}  {'share':>6}"]
        for name, row in zip(names, self.rows, strict=True):
            values = f"{row.calls:>7}  {row.ms_per_step:>9.4f}  {100 * row.share:>5.1f}%"
            lines.append(f"{name:<{width}}  {values}")
        if self.solves.solves:
            lines.append(str(self.solves))
        lines.append(
            f"step: p50 {self.p50_ms:.3f} ms, p95 {self.p95_ms:.3f} ms, p99 {self.p99_ms:.3f} ms, "
            f"max {self.max_ms:.3f} ms; "
            f"{self.real_time_factor:.3g} times real time"
        )
        lines.append(str(self.worst))
        return "\n".join(lines)


def profile_of(core: _core.Simulation, simulated: float) -> Profile:
    """The times of a simulation that moved by `simulated` [s] since they were cleared."""
    seconds = core.profile_step_seconds()
    steps = core.profile_steps()
    rows = [row for row in core.profile_rows() if row[2] > 0]
    total = float(seconds.mean()) * steps if steps else 0.0
    p50, p95, p99 = np.percentile(seconds, [50, 95, 99]) if steps else (0.0, 0.0, 0.0)
    return Profile(
        rows=tuple(
            ProfileRow(effect, stage, calls, 1e3 * spent / max(steps, 1), spent / total)
            for effect, stage, calls, spent in rows
            if total
        ),
        steps=steps,
        p50_ms=1e3 * float(p50),
        p95_ms=1e3 * float(p95),
        p99_ms=1e3 * float(p99),
        max_ms=1e3 * float(seconds.max()) if steps else 0.0,
        real_time_factor=simulated / total if total else 0.0,
        solves=Solves(*core.profile_solves(), account=core.solver_account()),
        worst=_worst(core),
    )


def _worst(core: _core.Simulation) -> WorstStep:
    """The longest step and its rows."""
    step, seconds, solves, iterations, preparations, spent = core.profile_worst()
    names = ((effect, stage) for effect, stage, _, _ in core.profile_rows())
    rows = [(*name, 1e3 * s) for name, s in zip(names, spent, strict=False) if s > 0.0]
    rows.sort(key=lambda row: -row[2])
    return WorstStep(step, 1e3 * seconds, tuple(rows), solves, iterations, preparations)
