"""`tissu bench contact`: what steps of bodies that touch cost, and how well the contacts hold."""

from __future__ import annotations

import difflib
from collections.abc import Iterator

import typer

from tissu.cli.info import machine_line
from tissu.contact_cost import CASES, Row, measure
from tissu.errors import ParameterError

HEAD = [
    "scene",
    "without, ms",
    "p50, ms",
    "p95, ms",
    "p99, ms",
    "worst at impact, ms",
    "depth at impact",
    "depth at the end",
    "force error",
    "crossings",
    "steps held back",
    "unconverged",
    "creep, mm/s",
    "sliding",
]


def list_contact_cases() -> None:
    """Prints names and titles."""
    for name, case in CASES.items():
        typer.echo(f"{name:<10} {case().name}")


def measured(names: list[str]) -> Iterator[Row]:
    """A row for each case; none named: all.

    Raises:
        ParameterError: found a name that no case has.
    """
    for name in names:
        if name not in CASES:
            near = difflib.get_close_matches(name, CASES, 1)
            hint = f"; did you mean '{near[0]}'?" if near else ""
            raise ParameterError(f"found case '{name}'; {', '.join(CASES)} are accepted{hint}")
    for name in names or CASES:
        yield measure(CASES[name]())


def cells_of(row: Row) -> list[str]:
    """A row in words, under HEAD."""
    times = [row.bare, *row.steps, row.impact]
    return [
        row.name,
        *("" if ms != ms else f"{ms:.3g}" for ms in times),
        *(f"{100.0 * depth:.2g} %" for depth in row.deepest),
        "" if row.force_error is None else f"{100.0 * row.force_error:.2g} %",
        str(row.crossings),
        str(row.held_back),
        str(row.unconverged),
        "" if row.moved is None else f"{1e3 * row.moved:.2g}",
        "" if row.slides is None else f"{row.slides:.4f}",
    ]


def bench_contact(names: list[str]) -> None:
    """Runs the cases and prints a line or two for each.

    Raises:
        ParameterError: found a name that no case has.
    """
    for row in measured(names):
        typer.echo(row.name)
        said = zip(HEAD[1:], cells_of(row)[1:], strict=True)
        typer.echo("  " + ", ".join(f"{head} {text}" for head, text in said if text))
        if row.ended:
            typer.echo(f"  ended early: {row.ended}")
    typer.echo(machine_line())
