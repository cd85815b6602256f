"""Prints a section of docs/measured/solvers.md: `solver: auto` against every fixed choice.

    python bench/defaults.py [--rows 'TEXT; TEXT'] [--minutes 8] [--meshes FOLDER] [--write]
    python bench/defaults.py --counts [--rows 'TEXT; TEXT'] [--write]

Every row gives `auto` and each fixed choice its turn, a few steps at a time, so that a drift of the
machine meets all of them alike. With --counts the counted work of the solves stands for their time:
the same numbers on any machine, however busy. A step that other choices solve and one does not
counts as failed.
"""

from __future__ import annotations

import argparse
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import tissu as ts

sys.path.insert(0, str(Path(__file__).resolve().parent))
from default_rows import ROWS, Row, Taken, choices, step_of, timed
from default_scenes import SCENES, fixed
from kernels import measured_at
from section import put

TAKEN, MOST_SECONDS = 120, 30.0
"""steps of a run, the second half of which is what is compared, and when it is cut short"""
LARGEST_FACTOR = 60_000
"""unknowns beyond which the direct choices are left out"""
HEAD = """## The default against every fixed choice

Is the default solver, `auto`, as fast as the best fixed choice? `auto` decides by the counted work
of a solve, and never by its time. This work consists of the bytes of the matrix in every
iteration, the bytes that a preconditioner reads, and the operations to make a preconditioner or a
factor. Each kind of traffic has its weight (`cpp/src/solve/work.h`). `auto` begins with the
cheapest choice for the first matrix, as predicted from the inertia in its rows and the shape of
the body. Then it adds up the work of this choice beyond that of another choice. When the sum
reaches the price of making the other one, that one is tried. One solve decides whether it stays,
or three if it was cheap to make. A choice that fails, or that spends more in a solve than another
would have taken, is abandoned within that solve.

{what} The last column is `auto` over the best fixed choice.

"""
COUNTED = """Counted work of a step in MB. Each cell is that of the second half of {taken} steps,
then that of the first; a static row has one step."""
TIMED = """Milliseconds of a step's solves: the mean over the second half of the steps, then their
median. A static row has those of several runs. The choices took turns of a few steps, for as many
rounds as the time allowed. A choice that took four times as long as `auto`, or exceeded a limit,
was left out from then on. Each choice is compared with `auto` by the mean over the steps that both
took. In time steps the supports move up and down by 0.2 % of the body in 16 steps, so that no body
comes to rest. The median does not include the steps in which `stale_cholesky` makes a new factor.
Each of them takes as long as several others, so `auto` takes that choice only if it halves a
solve. Steps that a choice did not solve are counted in brackets. `inf` in the last column: another
choice solved more steps than `auto`."""
SHARE = 1.6
"""what a row takes, of the seconds that it is given, with the turns that run past them"""


@dataclass(frozen=True)
class Run:
    """What the linear solves of a run took: seconds, or counted bytes.

    Attributes:
        first: of the first step.
        later: of a step in the second half: the median of times, which others disturb, and the mean
            of counts, to which what is made anew belongs.
        whole: of all steps.
        failures: steps that were not solved.
        account: what `auto` chose.
    """

    first: float
    later: float
    whole: float
    failures: int
    account: str


def run(scene: ts.Scene, *, counts: bool, steps: int, cut: bool = False) -> Run:
    """The scene's steps."""
    simulation = scene.compile()
    taken, failures, begin = [], 0, time.perf_counter()
    for number in range(steps):
        if cut and number % 5 == 4:
            last = simulation.meshes["body"].cell_count - 1
            simulation.remove_cells(body="body", cells=[last])
        simulation.clear_profile()
        try:
            failures += not simulation.step().converged
        except ts.errors.TissuError:
            failures += steps - number
            break
        profile = simulation.profile()
        if counts:
            taken.append(profile.solves.work)
        else:
            rows = (row for row in profile.rows if row.effect == "linear solver")
            taken.append(1e-3 * sum(row.ms_per_step for row in rows))
            if time.perf_counter() - begin > MOST_SECONDS:
                break
    later = taken[len(taken) // 2 :] or [float("nan")]
    middle = float(np.mean(later) if counts else np.median(later))
    first = taken[0] if taken else float("nan")
    account = simulation.profile().solves.account
    return Run(first, middle, float(np.sum(taken)), failures, account)


def compared(
    name: str, size: float, step: str, *, counts: bool, threads: int = 1, steps: int = TAKEN
) -> dict[str, Run]:
    """Runs of `auto` and of every fixed choice."""
    found = {}
    for choice, solver in {"auto": ts.Auto(), **fixed(ts.Auto().tolerance)}.items():
        if "cholesky" in choice and choice[0] != "i" and size > LARGEST_FACTOR:
            continue
        scene = SCENES[name](size, step_of(step, solver)).replace(threads=threads)
        count = 1 if step == "static" else steps
        found[choice] = run(scene, counts=counts, steps=count, cut=name == "cut")
    return found


def best(found: dict[str, Run], what: str) -> float:
    """The least that a fixed choice took, of those that failed least."""
    others = {choice: run for choice, run in found.items() if choice != "auto"}
    fewest = min(run.failures for run in others.values())
    return min(getattr(run, what) for run in others.values() if run.failures == fewest)


def ratio(found: dict[str, Run], what: str = "later") -> float:
    """`auto` over the best; infinite where it fails and another one does not."""
    fewest = min(run.failures for run in found.values())
    if found["auto"].failures > fewest:
        return float("inf")
    return float(getattr(found["auto"], what)) / best(found, what)


def cell(run: Run, *, counts: bool) -> str:
    """Later and first, in MB or milliseconds."""
    scale = 1e-6 if counts else 1e3
    text = f"{scale * run.later:.3g}, {scale * run.first:.3g}"
    return f"{text} ({run.failures} failed)" if run.failures else text


def over_best(found: dict[str, Taken]) -> float:
    """Mean of `auto` over that of the best, each over the steps that both took.

    Infinite where `auto` fails and another one does not; one that fails more is not compared.
    """
    auto = found["auto"]
    others = [t for name, t in found.items() if name != "auto" and t.steps and not t.past]
    ratios = []
    for taken in others:
        common = min(len(auto.steps), len(taken.steps))
        more = auto.failures(common) - taken.failures(common)
        if auto.past or more > 0:
            return float("inf")
        if more == 0:
            ratios.append(auto.mean(common) / taken.mean(common))
    return max(ratios, default=float("nan"))


def time_cell(taken: Taken | None) -> str:
    """Mean and median [ms]."""
    if taken is None:
        return "not run"
    if taken.past:
        return f"> {taken.past:.0f} s"
    text = f"{1e3 * taken.mean():.3g}, {1e3 * taken.p50():.3g}"
    return f"{text} ({len(taken.failed)} failed)" if taken.failed else text


def count_table(rows: list[Row]) -> str:
    """Markdown of counted work."""
    lines = head_of_table()
    for row in (row for row in rows if row.threads == 1 and row.scene in SCENES):
        found = compared(row.scene, row.size, row.step, counts=True)
        cells = [cell(found[c], counts=True) if c in found else "not run" for c in choices(0)]
        lines.append(f"| {row} | {' | '.join(cells)} | {ratio(found):.2f} |")
        print(lines[-1], found["auto"].account, file=sys.stderr, flush=True)
    return "\n".join(lines)


def time_table(rows: list[Row], minutes: float, meshes: Path | None) -> str:
    """Markdown of times; what is left of the minutes is shared by the rows that are left."""
    lines, end = head_of_table(), time.perf_counter() + 60.0 * minutes
    for number, row in enumerate(rows):
        if row.scene in ("liver", "phantom") and meshes is None:
            continue
        left = max(end - time.perf_counter(), 1.0)
        found = timed(row, left / (len(rows) - number) / SHARE, meshes)
        cells = [time_cell(found.get(name)) for name in choices(0)]
        lines.append(f"| {row} | {' | '.join(cells)} | {over_best(found):.2f} |")
        print(lines[-1], file=sys.stderr, flush=True)
    return "\n".join(lines)


def head_of_table() -> list[str]:
    """Its first two lines."""
    names = list(choices(0))
    return [f"| | {' | '.join(names)} | auto / best |", "|---" * (len(names) + 2) + "|"]


def section(asked: argparse.Namespace) -> str:
    """The whole section."""
    names = [text.strip() for text in asked.rows.split(";")] if asked.rows else [""]
    rows = [row for row in ROWS if any(str(row).startswith(name) for name in names)]
    if not rows:
        every = "; ".join(map(str, ROWS))
        raise SystemExit(f"no row begins with {asked.rows!r}; the rows are: {every}.")
    text = HEAD.format(what=COUNTED.format(taken=TAKEN) if asked.counts else TIMED)
    text += count_table(rows) if asked.counts else time_table(rows, asked.minutes, asked.meshes)
    return f"{text}\n\nPrinted by `python bench/defaults.py --write`; {measured_at()}\n"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--counts", action="store_true", help="counted work in place of time")
    parser.add_argument("--rows", help="beginnings of rows, such as 'bar, 1e+04; cube'")
    parser.add_argument("--minutes", type=float, default=8.0, help="for all rows")
    parser.add_argument("--meshes", type=Path, help="folder of the liver's and the phantom's mesh")
    parser.add_argument("--write", action="store_true", help="to docs/measured/solvers.md")
    arguments = parser.parse_args()
    text = section(arguments)
    if arguments.write:
        put("defaults", text)
    else:
        print(text)
