"""What tissu-bench reports, read from files or by running it."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

UNITS = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}

Times = dict[str, list[float]]


class NotComparableError(Exception):
    """One sentence on what is wrong with the input."""


def report_of(path: Path) -> dict[str, Any]:
    """What Google Benchmark wrote into a file."""
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise NotComparableError(f"{path} cannot be read: {error}.") from None
    return parsed(text, str(path))


def parsed(text: str, where: str) -> dict[str, Any]:
    """A report from its text; `where` says in messages where that is from."""
    try:
        report = json.loads(text)
    except json.JSONDecodeError as error:
        raise NotComparableError(f"{where} is not JSON: {error}.") from None
    rows = report.get("benchmarks") if isinstance(report, dict) else None
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        raise NotComparableError(
            f'{where} has no list "benchmarks", so it is not a report of tissu-bench.'
        )
    return dict(report)


def times_of(report: dict[str, Any], where: str) -> Times:
    """The repetitions of every row [ns]; aggregates and rows that failed are left out."""
    times: Times = {}
    for entry in report["benchmarks"]:
        if entry.get("run_type", "iteration") != "iteration" or entry.get("error_occurred"):
            continue
        try:
            name = str(entry.get("run_name", entry["name"]))
            kind = "real_time" if {"real_time", "manual_time"} & {*name.split("/")} else "cpu_time"
            time = float(entry[kind]) * UNITS[entry.get("time_unit", "ns")]
        except (KeyError, TypeError, ValueError) as error:
            raise NotComparableError(f"{where} has a row that cannot be read: {error!r}.") from None
        if time > 0.0:
            times.setdefault(name, []).append(time)
    return times


def measured(binary: Path, rows: str, repetitions: int) -> dict[str, Any]:
    """What a binary reports."""
    command = [
        str(binary),
        f"--benchmark_filter={rows}",
        "--benchmark_format=json",
        f"--benchmark_repetitions={repetitions}",
    ]
    environment = {"OMP_WAIT_POLICY": "active", **os.environ}
    try:
        done = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
    except OSError as error:
        raise NotComparableError(f"{binary} cannot be run: {error}.") from None
    said = " ".join(done.stderr.strip().splitlines()[-1:])
    if done.returncode != 0:
        raise NotComparableError(f"{binary} ended with status {done.returncode}: {said}")
    if not done.stdout.strip():
        raise NotComparableError(f"{binary} has no row that matches '{rows}': {said}")
    return parsed(done.stdout, f"what {binary} printed")


def run_in_turn(
    binaries: tuple[Path, Path], rows: str, pairs: int, repetitions: int
) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """Reports of the old and of the new binary, one of each for every pair."""
    reports: tuple[list[dict[str, Any]], list[dict[str, Any]]] = ([], [])
    for pair in range(pairs):
        for which in (0, 1) if pair % 2 == 0 else (1, 0):
            reports[which].append(measured(binaries[which], rows, repetitions))
    return reports


def together(reports: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Several reports as one."""
    rows = [row for report in reports for row in report["benchmarks"]]
    return {"context": reports[0].get("context", {}), "benchmarks": rows}


def medians(reports: Sequence[dict[str, Any]], where: str) -> Times:
    """Of each row that is in all reports, its median in each."""
    each = [times_of(report, where) for report in reports]
    names = [name for name in each[0] if all(name in times for times in each)]
    return {name: [float(np.median(times[name])) for times in each] for name in names}
