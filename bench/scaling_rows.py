"""Rows of tissu-bench by name, of several runs, and how busy the machine was meanwhile."""

from __future__ import annotations

import re
import resource
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from reports import UNITS, measured

# The limits come first and last, they belong to the whole run. A million elements take their time
# and are measured in one pass; the rest in several, of which a disturbed one does no harm.
# {threads} is the end of a row's name.
ONE_LIMITS, LIMITS = "^limit/[^,]*$", "^limit/"
PARTS = "^scale/(force|tangent product|assembly|matrix product)"
SHORT = (
    "^(kernel|baseline/textbook)/tetra/stvk/force|^rotation/",
    "^solve/.*/(1000|20000)/{threads}(/|$)",
    PARTS + "/(1000|10000|100000)/{threads}(/|$)",
    "^scale/step.*/(1000|10000|100000)/{threads}(/|$)",
    "^(target/.*|corotational step, 20 CG)/{threads}(/|$)",
)
LONG = (
    "^solve/.*/1000000/{threads}(/|$)",
    PARTS + "/1000000/{threads}(/|$)",
    "^scale/step.*/1000000/{threads}(/|$)",
)


def filters(passes: int, threads: int) -> list[str]:
    """Patterns of the rows of one thread, or of those of one and two."""
    ends = "1" if threads == 1 else "[12]"
    limits = ONE_LIMITS if threads == 1 else LIMITS
    rows = [pattern.replace("{threads}", ends) for pattern in (*SHORT * passes, *LONG)]
    return [limits, *rows, limits]


@dataclass(frozen=True)
class Row:
    """The fastest repetition of a row."""

    ns: float  # of an iteration: processor time on one thread, time by the clock on two
    counters: dict[str, float]

    def __getitem__(self, counter: str) -> float:
        return self.counters[counter]

    @property
    def per_element(self) -> float:
        """Time of one element [ns]."""
        return self.ns / self["elements"] / self.counters.get("steps", 1.0)

    @property
    def step_ms(self) -> float:
        """Time of one step."""
        return self.ns / self["steps"] / 1e6

    @property
    def rate(self) -> float:
        """Steps a second."""
        return 1e3 / self.step_ms


Rows = dict[str, Row]


def name_of(entry: dict[str, Any]) -> str:
    """A row's name without what the library appends to it."""
    return re.sub(r"/(min_time:[\d.]+|repeats:\d+|real_time)(?=/|$)", "", str(entry["name"]))


def threads_of(name: str) -> int:
    """Rows that end in their number of threads, or say it; one else."""
    return 2 if re.search(r"/2$|, 2 threads", name) else 1


def rows_of(reports: list[dict[str, Any]]) -> Rows:
    """The fastest repetition of every row in any report."""
    rows: Rows = {}
    for entry in (entry for report in reports for entry in report["benchmarks"]):
        if entry.get("run_type") == "aggregate" or entry.get("error_occurred"):
            continue
        name = name_of(entry)
        clock = "cpu_time" if threads_of(name) == 1 else "real_time"
        ns = float(entry[clock]) * UNITS[entry.get("time_unit", "ns")]
        if name not in rows or ns < rows[name].ns:
            numbers = {k: float(v) for k, v in entry.items() if isinstance(v, int | float)}
            rows[name] = Row(ns, numbers)
    return rows


def busy_seconds() -> float:
    """Of all processors since the machine started; 0 where the system does not say."""
    path = Path("/proc/stat")
    if not path.exists():
        return 0.0
    user, nice, system, _, _, *rest = map(float, path.read_text().splitlines()[0].split()[1:9])
    return (user + nice + system + sum(rest)) / 100.0


def own_seconds() -> float:
    """Of the processes that were run from here and have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


@contextmanager
def watched(notes: dict[str, Any]) -> Iterator[None]:
    """Notes how many processors others used meanwhile."""
    start, busy, own = time.monotonic(), busy_seconds(), own_seconds()
    yield
    spent = time.monotonic() - start
    others = busy_seconds() - busy - (own_seconds() - own)
    notes["others"] = max(0.0, others / spent)
    notes["seconds"] = spent


def run(binary: Path, passes: int, repetitions: int, threads: int) -> list[dict[str, Any]]:
    """Reports of everything that the page needs."""
    reports = []
    for rows in filters(passes, threads):
        notes: dict[str, Any] = {}
        with watched(notes):
            report = measured(binary, rows, repetitions)
        reports.append({**report, **notes})
    return reports


def others(reports: list[dict[str, Any]]) -> float:
    """Processors that others used, on average over all runs."""
    seconds = sum(report.get("seconds", 0.0) for report in reports)
    used = sum(report.get("others", 0.0) * report.get("seconds", 0.0) for report in reports)
    return float(used / seconds) if seconds else 0.0
