"""The runs of a study as CSV or Parquet, and as cells of a table."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable, Iterable, Iterator
from dataclasses import asdict, fields
from typing import Any

from tissu.accuracy.front import front, reached
from tissu.accuracy.study import Run, Study

_NAMES = ["case", *(field.name for field in fields(Run)), "on_front"]


def to_csv(studies: Iterable[Study]) -> str:
    """A line of names, then a line for each run; SI units but for ms and megabytes."""
    text = io.StringIO()
    writer = csv.DictWriter(text, _NAMES, lineterminator="\n")
    writer.writeheader()
    for row in _rows(studies):
        writer.writerow(row | {"on_front": int(row["on_front"])})
    return text.getvalue()


def to_parquet(studies: Iterable[Study]) -> bytes:
    """The same rows and columns with their types, none where a run has no such number.

    Raises:
        ImportError: pyarrow is not installed (`pip install tissu[parquet]`).
    """
    import pyarrow
    import pyarrow.parquet

    kinds = {"float | None": pyarrow.float64(), "int": pyarrow.int64()}
    columns = [(field.name, kinds.get(str(field.type), pyarrow.string())) for field in fields(Run)]
    schema = pyarrow.schema([("case", pyarrow.string()), *columns, ("on_front", pyarrow.bool_())])
    sink = pyarrow.BufferOutputStream()
    table = pyarrow.Table.from_pylist(list(_rows(studies)), schema=schema)
    pyarrow.parquet.write_table(table, sink)
    written: bytes = sink.getvalue().to_pybytes()
    return written


def _rows(studies: Iterable[Study]) -> Iterator[dict[str, Any]]:
    for study in studies:
        best = {id(run) for run in front(study.runs)}
        for run in study.runs:
            row = asdict(run) | {"changes": json.dumps(run.changes)}
            yield {"case": study.case.name, **row, "on_front": id(run) in best}


def _number(value: float | None, factor: float = 1.0) -> str:
    return "-" if value is None else f"{factor * value:.3g}"


COLUMNS: dict[str, Callable[[Run], str]] = {
    "error, mean [mm]": lambda run: _number(run.mean, 1e3),
    "largest [mm]": lambda run: _number(run.largest, 1e3),
    "mean [%]": lambda run: _number(run.share, 100.0),
    "ms/step": lambda run: _number(run.ms_per_step),
    "to the result [ms]": lambda run: _number(run.seconds, 1e3),
    "steps": lambda run: str(run.steps) if run.steps else "-",
    "Newton": lambda run: str(run.newton) if run.newton else "-",
    "iterations": lambda run: str(run.iterations) if run.iterations else "-",
    "unknowns": lambda run: str(run.unknowns) if run.unknowns else "-",
    "memory [MB]": lambda run: _number(run.megabytes),
}
"""Heads of the table, and what stands under them."""


def cells(study: Study) -> list[list[str]]:
    """Rows of text: label, columns, and why a run has none; the front is marked with a star."""
    best = {id(run) for run in front(study.runs)}
    rows = []
    for run in study.runs:
        mark = " *" if id(run) in best else ""
        why = f" ({run.outcome}: {run.why})" if run.why else ""
        rows.append([run.label + mark + why, *(show(run) for show in COLUMNS.values())])
    return rows


def curves(study: Study) -> tuple[list[str], list[list[str]]]:
    """Head and rows: how long each curve takes to each goal, and how many times that of the best.

    Curves that reach none are left out, and so is all where there is but one.
    """
    found: dict[str, list[Run]] = {}
    for run in study.runs:
        found.setdefault(run.curve, []).append(run)
    head, rows = ["to reach"], {name: [name] for name in found}
    for goal in study.case.goals:
        head += [f"{100.0 * goal:g} % [ms]", "times the best"]
        times = {name: reached(runs, goal) for name, runs in found.items()}
        best = min((time for time in times.values() if time is not None), default=None)
        for name, time in times.items():
            rows[name] += [_number(time, 1e3), _number(time, 1.0 / best) if best else "-"]
    some = [row for row in rows.values() if set(row[1:]) != {"-"}]
    return head, some if len(some) > 1 else []


def printed(study: Study) -> tuple[list[str], list[list[str]]]:
    """Head and rows: numbers of papers, and ours beside them."""
    ours = {run.label: run for run in study.runs}
    same = study.case.paper is not None
    head = ["printed", "error [mm]", "ms/step", "our run", "to the reference [mm]", "ms/step"]
    if same:
        head.insert(4, "as in the paper [mm]")
    rows = []
    for entry in study.case.printed:
        run = ours.get(entry.run or "")
        row = [f"{entry.where}: {entry.what}", _number(entry.error, 1e3)]
        row += ["-" if entry.ms is None else f"{entry.ms:g}", run.label if run else "-"]
        row += [_number(run.as_paper if run else None, 1e3)] if same else []
        row += [_number(run.mean if run else None, 1e3), _number(run.ms_per_step if run else None)]
        rows.append(row)
    return head, rows
