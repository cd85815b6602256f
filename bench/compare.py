"""Says which rows of tissu-bench became slower, or faster, beyond the noise.

    python bench/compare.py OLD.json NEW.json
    python bench/compare.py [OLD.json NEW.json] --run OLD_BINARY NEW_BINARY [--filter step]

Two files hold what `tissu-bench --benchmark_format=json --benchmark_repetitions=N` wrote, N of 6 or
more. With --run the two binaries are run in turn, old-new, new-old, …, each for --pairs times, and
what they gave is kept in the two files if they are named. That is the way to judge a change: what
else the machine does meets both alike, while files of two days also differ by their days.

A row became slower or faster when all of these say so:

1. Its median changed by more than --least (5 %).
2. A test of ranks: of files that of Mann and Whitney, between pairs of runs that of Wilcoxon. Both
   ask how often ranks given out by chance would differ as much; neither cares how the noise is
   distributed, nor for one repetition that something disturbed.
3. Of the rows that are called changed, no more than --false-alarms (5 %) are expected to be so by
   chance (Benjamini and Hochberg 1995): with five hundred rows, one test in twenty would give
   twenty-five alarms on noise alone. Where nothing changed at all, that is the chance of any alarm.
4. Of files only: the median changed by more than the spread of single repetitions, 1.48 times the
   median distance from the median. Repetitions in one process are not independent samples, they
   share its memory and its moment, and with many of them a test finds differences of those.

Times are those by the clock where a row was measured so, of the processor elsewhere. Rows "limit/"
measure the machine and not the code: they are never counted, but a change of them is told.

Exit status: 0 when no row became slower, 1 when one did, 2 when the comparison was not possible.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from ranks import rank_sum_chance, signed_rank_chance
from reports import (
    UNITS,
    NotComparableError,
    Times,
    medians,
    report_of,
    run_in_turn,
    times_of,
    together,
)

FEWEST = 4  # repetitions that can be judged at all
MACHINE = "limit/"


@dataclass(frozen=True)
class Row:
    """What was found for a row."""

    name: str
    old: float  # median [ns]
    new: float
    spread: float  # of a single repetition, as a share
    chance: float  # of ranks that differ as much; 1 where there are too few to say
    finest: float  # the least chance that so many repetitions can give
    judged: bool

    @property
    def change(self) -> float:
        """0.1: ten percent slower."""
        return self.new / self.old - 1.0

    @property
    def shift(self) -> float:
        """The same for slower and faster: 0.1 is a tenth more of one in terms of the other."""
        return max(self.new / self.old, self.old / self.new) - 1.0


# ---- rows


def spread_of(logs: NDArray[np.float64]) -> float:
    """1.48 times the median distance from the median: the standard deviation of normal noise."""
    return 1.4826 * float(np.median(np.abs(logs - np.median(logs))))


def unpaired(name: str, old: Sequence[float], new: Sequence[float]) -> Row:
    """Repetitions of two files."""
    judged = min(len(old), len(new)) >= FEWEST
    spread = max(spread_of(np.log(old)), spread_of(np.log(new)))
    chance = rank_sum_chance(old, new) if judged else 1.0
    finest = 2.0 / math.comb(len(old) + len(new), len(old))
    return Row(name, float(np.median(old)), float(np.median(new)), spread, chance, finest, judged)


def paired(name: str, old: Sequence[float], new: Sequence[float]) -> Row:
    """Runs in turn: the change is the median of the changes of pairs."""
    logs = np.log(new) - np.log(old)
    judged = len(logs) >= FEWEST
    chance = signed_rank_chance([float(x) for x in logs]) if judged else 1.0
    before = float(np.median(old))
    after = before * float(np.exp(np.median(logs)))
    return Row(name, before, after, spread_of(logs), chance, 2.0 / 2 ** len(logs), judged)


def compared(old: Times, new: Times, judge: Callable[..., Row]) -> list[Row]:
    """Every row that both have, in the order of the old ones."""
    rows = [judge(name, times, new[name]) for name, times in old.items() if name in new]
    if not rows:
        raise NotComparableError(
            f"the two have no row in common: {len(old)} in the old, {len(new)} in the new."
        )
    if not any(row.judged for row in rows):
        raise NotComparableError(
            f"no row was measured {FEWEST} times in both; take --benchmark_repetitions=10 or more."
        )
    return rows


def significant(rows: Sequence[Row], alarms: float) -> set[str]:
    """Benjamini and Hochberg: the k least chances, k the last with chance <= alarms k / all."""
    judged = sorted((row for row in rows if row.judged), key=lambda row: row.chance)
    last = 0
    for k, row in enumerate(judged, start=1):
        if row.chance <= alarms * k / len(judged):
            last = k
    return {row.name for row in judged[:last]}


@dataclass(frozen=True)
class Verdict:
    """The rows by what is said of them."""

    rows: list[Row]
    slower: list[Row]
    faster: list[Row]
    machine: list[Row]  # that changed, of the machine's limits
    blunt: bool  # so many rows that a single one could not be told from chance


def verdict(rows: list[Row], *, least: float, alarms: float, spread_counts: bool) -> Verdict:
    """Which rows changed."""
    told = significant(rows, alarms)
    changed = [
        row
        for row in rows
        if row.name in told and row.shift > max(least, row.spread if spread_counts else 0.0)
    ]
    own = [row for row in changed if not row.name.startswith(MACHINE)]
    judged = [row for row in rows if row.judged]
    return Verdict(
        rows=rows,
        slower=sorted((r for r in own if r.change > 0), key=lambda r: -r.change),
        faster=sorted((r for r in own if r.change < 0), key=lambda r: r.change),
        machine=[row for row in changed if row.name.startswith(MACHINE)],
        blunt=any(row.finest * len(judged) > alarms for row in judged),
    )


# ---- words


def duration(ns: float) -> str:
    """With the unit that fits."""
    unit = max((u for u in UNITS if UNITS[u] <= ns), key=lambda u: UNITS[u], default="ns")
    return f"{ns / UNITS[unit]:.3g} {unit}"


def line(row: Row) -> str:
    """A row's numbers."""
    return (
        f"  {row.name}: {duration(row.old)} -> {duration(row.new)}, {100 * row.change:+.1f} % "
        f"(spread {100 * row.spread:.1f} %, by chance {row.chance:.1g})"
    )


def text_of(found: Verdict, *, everything: bool) -> str:
    """What is printed."""
    parts = []
    for title, rows in (("slower", found.slower), ("faster", found.faster)):
        if rows:
            parts += [f"{title}:", *map(line, rows)]
    if everything:
        changed = {row.name for row in [*found.slower, *found.faster]}
        parts += ["not told apart:", *(line(row) for row in found.rows if row.name not in changed)]
    if found.machine:
        parts += [
            "the machine itself changed between the two, so nothing here is sure:",
            *map(line, found.machine),
        ]
    if found.blunt:
        parts.append(
            "a row that changed alone may be missed: so many rows ask for more repetitions or "
            "pairs, or for fewer rows."
        )
    few = sum(not row.judged for row in found.rows)
    same = len(found.rows) - len(found.slower) - len(found.faster) - few - len(found.machine)
    parts.append(
        f"{len(found.rows)} rows: {len(found.slower)} slower, {len(found.faster)} faster, "
        f"{same} not told apart" + (f", {few} measured too seldom" if few else "")
    )
    return "\n".join(parts)


def arguments_of(words: Sequence[str] | None) -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("old", type=Path, nargs="?")
    parser.add_argument("new", type=Path, nargs="?")
    parser.add_argument("--run", type=Path, nargs=2, metavar=("OLD_BINARY", "NEW_BINARY"))
    parser.add_argument("--filter", default=".", help="rows that --run measures, as a pattern")
    parser.add_argument("--pairs", type=int, default=12, help="runs of each binary")
    parser.add_argument("--repetitions", type=int, default=1, help="of a row in each run")
    parser.add_argument("--least", type=float, default=0.05, help="smallest change that counts")
    parser.add_argument("--false-alarms", type=float, default=0.05, help="among changed rows")
    parser.add_argument("--all", action="store_true", help="print rows that did not change too")
    given = parser.parse_args(words)
    if given.new is None and (given.old is not None or given.run is None):
        raise NotComparableError("give OLD.json and NEW.json, or --run with two binaries.")
    if given.pairs < FEWEST or given.repetitions < 1:
        raise NotComparableError(f"take at least {FEWEST} --pairs and one of --repetitions.")
    return given


def rows_from(given: argparse.Namespace) -> list[Row]:
    """Reads or runs."""
    if given.run is None:
        old, new = (times_of(report_of(path), str(path)) for path in (given.old, given.new))
        return compared(old, new, unpaired)
    reports = run_in_turn(tuple(given.run), given.filter, given.pairs, given.repetitions)
    if given.old is not None:
        for path, made in zip((given.old, given.new), reports, strict=True):
            path.write_text(json.dumps(together(made)), encoding="utf-8")
    old, new = (medians(r, str(b)) for r, b in zip(reports, given.run, strict=True))
    return compared(old, new, paired)


def main(words: Sequence[str] | None = None) -> int:
    """Prints what changed; the exit status."""
    try:
        given = arguments_of(words)
        found = verdict(
            rows_from(given),
            least=given.least,
            alarms=given.false_alarms,
            spread_counts=given.run is None,
        )
    except NotComparableError as error:
        print(f"compare: {error}", file=sys.stderr)
        return 2
    print(text_of(found, everything=given.all))
    return 1 if found.slower else 0


if __name__ == "__main__":
    sys.exit(main())
