"""Prints the tables of docs/measured/contact.md: steps with contact, responses, broad phases.

    python bench/contact.py [--write] [CASE …]

Needs `cmake --build build/main --target tissu-bench` for the broad phases; TISSU_BENCH names
another program. With cases named, the table of steps has those alone and the rest stays as it is.
"""

from __future__ import annotations

import argparse
import datetime
import json
import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from kernels import commit, digits, table

from tissu.cli.bench_contact import HEAD, cells_of, measured
from tissu.cli.info import machine_line
from tissu.contact_cost import Row, measured_responses

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "measured" / "contact.md"
PROGRAM = Path(os.environ.get("TISSU_BENCH", ROOT / "build/main/bench/tissu-bench"))
BEGIN, END = "<!-- bench/contact.py: {} -->", "<!-- end of bench/contact.py: {} -->"


def steps_text(names: list[str]) -> str:
    """The table of steps, and why rows ended early."""
    rows = []
    for row in measured(names):
        print(row.name, row.ended, file=sys.stderr, flush=True)
        rows.append(row)
    early = [f"- {row.name}: ended early. {row.ended}" for row in rows if row.ended]
    found = table(HEAD, [cells_of(row) for row in rows])
    where = f"{machine_line()} Commit {commit()}, {datetime.date.today()}."
    return "\n\n".join([found, *(["\n".join(early)] if early else []), where])


RESPONSE_HEAD = [
    "response",
    "dt, ms",
    "ms a step",
    "ms a second",
    "depth at impact",
    "depth at the end",
    "force error",
    "unconverged",
    "creep, mm/s",
    "sliding",
]


def response_cells(label: str, dt: float, row: Row) -> list[str]:
    """A row in words, under RESPONSE_HEAD."""
    return [
        label,
        digits(1e3 * dt),
        *("-" if math.isnan(ms) else digits(ms) for ms in (row.steps[0], row.steps[0] / dt)),
        *(f"{100.0 * depth:.2g} %" for depth in row.deepest),
        "" if row.force_error is None else f"{100.0 * row.force_error:.2g} %",
        str(row.unconverged),
        "" if row.moved is None else f"{1e3 * row.moved:.2g}",
        "" if row.slides is None else f"{row.slides:.4f}",
    ]


def responses_text() -> str:
    """A table for each scene: a line for each response, error beside milliseconds."""
    tables: dict[str, list[list[str]]] = {}
    early = []
    for label, dt, row in measured_responses():
        print(row.name, label, row.ended, file=sys.stderr, flush=True)
        tables.setdefault(row.name, []).append(response_cells(label, dt, row))
        early += [f"- {label}, {row.name}: ended early. {row.ended}"] if row.ended else []
    parts = [f"{name}:\n\n{table(RESPONSE_HEAD, rows)}" for name, rows in tables.items()]
    where = f"{machine_line()} Commit {commit()}, {datetime.date.today()}."
    return "\n\n".join([*parts, *(["\n".join(early)] if early else []), where])


def searches() -> list[dict[str, Any]]:
    """The rows of tissu-bench on broad phases."""
    command = [str(PROGRAM), "--benchmark_filter=broad phase", "--benchmark_format=json"]
    command.append("--benchmark_min_time=0.05")
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return list(json.loads(done.stdout)["benchmarks"])


def broad_text() -> str:
    """The table of broad phases: a line for each, a column for each number of triangles."""
    times: dict[str, dict[int, dict[str, Any]]] = {}
    for entry in searches():
        _, name, triangles = entry["name"].split("/")[:3]
        times.setdefault(name, {})[int(triangles)] = entry
    sizes = sorted({size for of in times.values() for size in of})
    lines = []
    for name, of in times.items():
        largest = of[max(of)]
        cells = [digits(float(of[size]["cpu_time"])) if size in of else "" for size in sizes]
        growth = f"n^{largest['growth']:.2f}" if "growth" in largest else ""
        lines.append([f"`{name}`", *cells, growth, digits(float(largest["bytes/triangle"]))])
    head = ["ms", *(f"{size:,} triangles" for size in sizes), "growth", "bytes a triangle"]
    return table(head, lines)


def put(page: str, part: str, text: str) -> str:
    """The page with the text between the markers of a part."""
    begin, end = BEGIN.format(part), END.format(part)
    before, found, rest = page.partition(begin)
    _, closed, after = rest.partition(end)
    if not (found and closed):
        raise RuntimeError(f"{PAGE.name} has no place between {begin} and {end}")
    return f"{before}{begin}\n\n{text}\n\n{end}{after}"


def main() -> int:
    """Runs, prints or writes."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="CASE")
    parser.add_argument("--write", action="store_true", help="write docs/measured/contact.md")
    parser.add_argument("--responses", action="store_true", help="that table alone")
    asked = parser.parse_args()
    alone = asked.names or asked.responses
    if not PROGRAM.exists() and not alone:
        print(f"contact: {PROGRAM} is not built", file=sys.stderr)
        return 1
    parts = {} if asked.responses else {"steps": steps_text(asked.names)}
    if not asked.names:
        parts["responses"] = responses_text()
    if not alone:
        parts["broad phases"] = broad_text()
    page = PAGE.read_text(encoding="utf-8")
    for part, text in parts.items():
        page = put(page, part, text)
    if asked.write:
        PAGE.write_text(page, encoding="utf-8")
    else:
        print("\n\n".join(parts.values()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
