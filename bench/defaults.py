"""Prints the section of docs/solvers.md that holds `solver: auto` against every fixed choice.

    python bench/defaults.py [--counts] [--full] [--threads 1,2] [--scenes bar,cube] [--write]

With --counts the counted work of the solves stands for their time: the same numbers on any machine,
however busy. A step that other choices solve and one does not counts as failed.
"""

from __future__ import annotations

import argparse
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import tissu as ts
from tissu.cli.info import machine_line

sys.path.insert(0, str(Path(__file__).resolve().parent))
from default_scenes import SCENES, fixed
from section import put

STEPS = ("1 ms", "10 ms", "100 ms", "static")
SIZES, MORE_SIZES = (1e3, 1e4, 1e5), (1e6,)
TAKEN, MOST_SECONDS = 120, 30.0
"""steps of a run, the second half of which is what is compared, and when it is cut short"""
LARGEST_FACTOR = 60_000
"""unknowns beyond which the direct choices are left out"""
HEAD = """## The default against every fixed choice

`auto` knows the counted work of a solve, never its time: matrix bytes of every iteration, what a
preconditioner reads, what making one or a factor takes, each with the weight of its kind of traffic
(`cpp/src/solve/work.h`). It begins with what the first matrix makes cheapest, as predicted from the
inertia in its rows and the shape of the body. What a choice took beyond another one is then added
up, and the other is tried when the sum reaches the price of making it; one solve says whether it
stays. A choice that spends more in a solve than another would have taken is left within it, and one
that fails as well.

{what} Each cell is that of the second half of {taken} steps, then that of the first; a static row
has one step. The last column is `auto` over the best fixed choice, without and with the first step.

"""


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


def step_of(name: str, solver: Any) -> Any:
    """The step of a row."""
    return ts.Static(solver=solver) if name == "static" else ts.ImplicitEuler(name, solver=solver)


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


def table(sizes: tuple[float, ...], scenes: list[str], *, counts: bool, threads: int) -> str:
    """Markdown."""
    choices = ["auto", *fixed(1e-6)]
    lines = [f"| | {' | '.join(choices)} | auto / best |", "|---" * (len(choices) + 2) + "|"]
    for name in scenes:
        for size in sizes[:1] if name == "organ" else sizes:
            for step in STEPS:
                found = compared(name, size, step, counts=counts, threads=threads)
                cells = [
                    cell(found[c], counts=counts) if c in found else "not run" for c in choices
                ]
                ratios = f"{ratio(found):.2f}, {ratio(found, 'whole'):.2f}"
                lines.append(f"| {name}, {size:.0e}, {step} | {' | '.join(cells)} | {ratios} |")
                print(lines[-1], found["auto"].account, file=sys.stderr, flush=True)
    return "\n".join(lines)


def section(asked: argparse.Namespace) -> str:
    """The whole section."""
    sizes = SIZES + MORE_SIZES if asked.full else SIZES
    if asked.sizes:
        sizes = tuple(float(size) for size in asked.sizes.split(","))
    scenes = asked.scenes.split(",") if asked.scenes else list(SCENES)
    what = "Counted work of a step in MB." if asked.counts else "Milliseconds of a step's solves."
    parts = [HEAD.format(what=what, taken=TAKEN)]
    for threads in (1,) if asked.counts else tuple(map(int, asked.threads.split(","))):
        words = "One thread." if threads == 1 else f"{threads} threads."
        parts.append(f"{words}\n\n{table(sizes, scenes, counts=asked.counts, threads=threads)}\n")
    return "\n".join(parts) + f"\nPrinted by `python bench/defaults.py --write`; {machine_line()}\n"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--counts", action="store_true", help="counted work in place of time")
    parser.add_argument("--full", action="store_true", help="up to 1e6 unknowns")
    parser.add_argument("--sizes", help="unknowns, such as 1e3,3e3")
    parser.add_argument("--threads", default="1,2")
    parser.add_argument("--scenes", help="by name, such as bar,cube")
    parser.add_argument("--write", action="store_true", help="to docs/solvers.md")
    arguments = parser.parse_args()
    text = section(arguments)
    if arguments.write:
        put("defaults", text)
    else:
        print(text)
