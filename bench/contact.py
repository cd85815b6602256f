"""Prints the tables of docs/measured/contact.md: steps with contact, responses, searches, pairs.

    python bench/contact.py [--write] [--meshes FOLDER] [CASE …]

Needs `cmake --build build/main --target tissu-bench` for searches and pairs; TISSU_BENCH names
another program. FOLDER holds `liver.msh`, for two real livers. With cases named, the table of steps
has those alone and the rest stays as it is.
"""

from __future__ import annotations

import argparse
import datetime
import math
import sys
from itertools import chain
from pathlib import Path

from contact_livers import cases
from contact_searches import PROGRAM, broad_text, pairs_text
from kernels import commit, digits, table

from tissu.cli.bench_contact import HEAD, cells_of, measured
from tissu.cli.info import machine_line
from tissu.contact_cost import Row, measure, measured_responses

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "measured" / "contact.md"
BEGIN, END = "<!-- bench/contact.py: {} -->", "<!-- end of bench/contact.py: {} -->"


def steps_text(names: list[str], meshes: Path | None) -> str:
    """The table of steps, and why rows ended early."""
    rows = []
    livers = (measure(case) for case in cases(meshes)) if meshes else ()
    for row in chain(measured(names), livers):
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
    parser.add_argument("--meshes", type=Path, help="folder of liver.msh")
    parser.add_argument("--searches", action="store_true", help="broad phases and pairs alone")
    parser.add_argument("--responses", action="store_true", help="that table alone")
    asked = parser.parse_args()
    chosen = asked.names or asked.responses or asked.searches
    if not PROGRAM.exists() and (asked.searches or not chosen):
        print(f"contact: {PROGRAM} is not built", file=sys.stderr)
        return 1
    parts = {}
    if asked.names or not chosen:
        parts["steps"] = steps_text(asked.names, asked.meshes)
    if asked.responses or not chosen:
        parts["responses"] = responses_text()
    if asked.searches or not chosen:
        parts["broad phases"] = broad_text()
        parts["pairs"] = pairs_text()
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
