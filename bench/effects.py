"""Prints docs/measured/absent-effects.md: what an effect costs where it is absent or present.

    python bench/effects.py [--write] [--rounds 30]

Counts instructions with valgrind's callgrind, and times the scenes in turn. Needs valgrind and
`cmake --build build/main --target tissu-effects`; TISSU_EFFECTS names another program.
"""

from __future__ import annotations

import argparse
import datetime
import statistics
import sys
from dataclasses import dataclass
from typing import Any

import effect_rows
import instruction_counts
from effect_rows import Measured
from instruction_counts import ROOT, Counts
from kernels import commit, table

from tissu.cli.info import processor

PAGE = ROOT / "docs/measured/absent-effects.md"
COUNTED, STEPS = 1, 2  # size of the bar and steps that are counted
TIMED, TIMED_STEPS = 2, 5
SIZES = (1, 2, 3)
TITLE = "# The cost of absent effects"


@dataclass(frozen=True)
class Timing:
    """Medians of the seconds of a step."""

    without: float
    present: float
    again: float


def timing_of(scenes: list[dict[str, Any]]) -> Timing:
    """Medians of the three scenes of a row."""
    return Timing(*(statistics.median(one["seconds"]) / TIMED_STEPS for one in scenes))


def counted_table(measured: list[Measured]) -> str:
    """A line for each effect: instructions of a step, and those of its own functions."""
    lines = []
    for one in measured:
        own = one.row.own
        runs = (one.without, one.present, one.again)
        lines.append(
            [
                one.row.effect,
                one.row.without,
                *(f"{counts.per_step:,}" for counts in runs),
                *(
                    "" if own is None else f"{effect_rows.instructions_of(counts, own) // STEPS:,}"
                    for counts in runs
                ),
            ]
        )
    head = ["effect", "scene without it", "without", "with", "without again"]
    return table([*head, "its own, without", "its own, with", "its own, without again"], lines)


def timed_table(timings: list[tuple[str, Timing]]) -> str:
    """A line for each effect: medians and their ratios."""
    lines = [
        [
            effect,
            *(f"{1e3 * ms:.3f}" for ms in (timing.without, timing.present, timing.again)),
            f"{timing.present / timing.without:.2f}",
            f"{timing.again / timing.without:.3f}",
        ]
        for effect, timing in timings
    ]
    head = ["effect", "without, ms", "with, ms", "without again, ms"]
    return table([*head, "with / without", "again / without"], lines)


def asked_table(bare: list[Counts]) -> str:
    """Questions of a bare step, on finer and finer meshes."""
    lines = [
        [what, *(f"{effect_rows.instructions_of(one, pattern) / STEPS:g}" for one in bare)]
        for what, pattern in effect_rows.ASKED.items()
    ]
    return table(["instructions a step", *(f"{one.scene['cells']:,} cells" for one in bare)], lines)


def shares_table(bare: Counts) -> str:
    """Where the instructions of a bare step go."""
    parts = effect_rows.shares(bare)
    lines = [
        [part, f"{n / STEPS:,.0f}", f"{100 * n / bare.total:.3f} %"]
        for part, n in sorted(parts.items(), key=lambda item: -item[1])
    ]
    return table(["part of a bare step", "instructions", "share"], lines)


def same(measured: list[Measured]) -> str:
    """How many scenes came out the same after their effect had run."""
    counts = sum(one.again.own == one.without.own for one in measured)
    bits = sum(one.again.scene["checksum"] == one.without.scene["checksum"] for one in measured)
    return (
        f"Of {len(measured)} scenes without an effect, {counts} take the same instructions, "
        f"function by function, before and after the scene with it has run in the same process; "
        f"{bits} move with the same bits."
    )


def page(
    measured: list[Measured],
    bare: list[Counts],
    timings: list[tuple[str, Timing]],
    rounds: int,
    timed: dict[str, Any],
) -> str:
    """The whole of docs/measured/absent-effects.md."""
    counted = measured[0].without.scene
    return f"""{TITLE}

An effect that a scene does not ask for costs nothing. The simulation contains no object for it, and
no flag that is read for each node or cell. So a step executes none of its instructions. This page
gives the counted instructions, and `tests/python/test_absent_effects.py` tests the result. The page
is printed by `python bench/effects.py --write`.

The bare scene is a bar of StVK tetrahedra with an initial velocity, without gravity, loads or
supports. Its step is implicit Euler, linearised once, with exactly ten iterations of conjugate
gradients, on one thread. Each scene with an effect is the bare scene (or the named one) with that
effect added. It runs between two runs of the scene without the effect.

## Instructions

The instructions of a step, and of the work between two steps, are counted by valgrind's callgrind
with kernels for {counted["isa"]}, {counted["cells"]:,} tetrahedra. The columns "its own" count only
functions that serve the effect alone. They are identified by their names
(`bench/effect_rows.py`).

{counted_table(measured)}

{same(measured)}

## Empty lists

A step still loops over the empty lists of absent effects. Their cost is the same on every mesh:

{asked_table(bare)}

## Where the instructions of a bare step go

{bare[-1].scene["cells"]:,} tetrahedra. Every function belongs to one of these parts.

{shares_table(bare[-1])}

## Time

Medians of {rounds} rounds, in each of which the three scenes of a row take {TIMED_STEPS} steps one
after the other; kernels for {timed["isa"]}, {timed["nodes"]:,} nodes, one thread unless said.
{timed["compiler"]}, {processor()}, commit {commit()}, {datetime.date.today().isoformat()}. The
machine is shared. Its noise is the difference of "again / without" from 1.

{timed_table(timings)}
"""


def main() -> int:
    """Counts, times, prints or writes."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--write", action="store_true", help=f"write {PAGE.relative_to(ROOT)}")
    parser.add_argument("--rounds", type=int, default=30)
    arguments = parser.parse_args()
    why = instruction_counts.missing()
    if why is not None:
        print(f"effects: {why}", file=sys.stderr)
        return 1
    measured = effect_rows.measure(size=COUNTED, steps=STEPS)
    bare = [instruction_counts.count(["bare"], size=n, steps=STEPS)[0] for n in SIZES]
    timings, timed = [], {}
    for row in effect_rows.ROWS:
        scenes = instruction_counts.seconds(
            [row.without, row.scene, row.without],
            size=TIMED,
            steps=TIMED_STEPS,
            rounds=arguments.rounds,
        )
        timed = scenes[0]
        timings.append((row.effect, timing_of(scenes)))
        print(row.effect, timings[-1][1], file=sys.stderr, flush=True)
    text = page(measured, bare, timings, arguments.rounds, timed)
    if arguments.write:
        PAGE.write_text(text, encoding="utf-8")
    else:
        print(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
