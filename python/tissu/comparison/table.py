"""What a comparison found, as rows, as text, as CSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable
from dataclasses import asdict, dataclass, fields

_NONE = "-"


@dataclass(frozen=True, slots=True)
class Row:
    """One model.

    Attributes:
        model: its name.
        outcome: "finished", "stopped" or "refused".
        mean_error: distance from the reference, mean over nodes and samples [m].
        largest_error: the largest of them [m].
        mean_percent: the mean, in percent of the reference's largest displacement.
        ms_per_step: median wall time of a step.
        iterations_per_step: of the linear solver.
        unconverged: steps that did not converge.
        bytes_per_cell: what the model keeps of a cell.
        megabytes: models and matrix together.
        stable_step: largest step of an explicit method without damping, 2 / omega [s].
        inverted: cells that are inside out at the end.
        why: of an outcome that is not "finished".
    """

    model: str
    outcome: str
    mean_error: float | None = None
    largest_error: float | None = None
    mean_percent: float | None = None
    ms_per_step: float | None = None
    iterations_per_step: float | None = None
    unconverged: int | None = None
    bytes_per_cell: float | None = None
    megabytes: float | None = None
    stable_step: float | None = None
    inverted: int | None = None
    why: str = ""


@dataclass(frozen=True, slots=True)
class Comparison:
    """One scene with several models.

    Attributes:
        scene: its name.
        cells: of all bodies.
        reference: the run with which the others are compared.
        rows: one for each model, in the order asked for.
    """

    scene: str
    cells: int
    reference: str
    rows: tuple[Row, ...]

    def to_csv(self) -> str:
        """A line of names, then a line for each model; SI units except for ms and megabytes."""
        text = io.StringIO()
        writer = csv.DictWriter(text, [field.name for field in fields(Row)], lineterminator="\n")
        writer.writeheader()
        writer.writerows(asdict(row) for row in self.rows)
        return text.getvalue()

    def to_markdown(self) -> str:
        """The table with the reference of its errors."""
        head = ["model", *_COLUMNS]
        lines = [
            f"{self.scene}: {self.cells} cells; errors against {self.reference}.",
            "",
            f"| {' | '.join(head)} |",
            "|" + "---|" * len(head),
            *(f"| {' | '.join(cells)} |" for cells in self._cells()),
        ]
        return "\n".join([*lines, *self._reasons("- ")]) + "\n"

    def __str__(self) -> str:
        """A table for a terminal."""
        rows = [["model", *_COLUMNS], *self._cells()]
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        lines = [
            "  ".join(
                cell.ljust(width) if n == 0 else cell.rjust(width)
                for n, (cell, width) in enumerate(zip(row, widths, strict=True))
            )
            for row in rows
        ]
        head = f"{self.scene}: {self.cells} cells; errors against {self.reference}"
        return "\n".join([head, *lines, *self._reasons("")])

    def _cells(self) -> list[list[str]]:
        return [[row.model, *(show(row) for show in _COLUMNS.values())] for row in self.rows]

    def _reasons(self, mark: str) -> list[str]:
        told = [f"{mark}{row.model} {row.outcome}: {row.why}" for row in self.rows if row.why]
        return ["", *told] if told else []


def _length(value: float | None) -> str:
    """A length in mm, three figures."""
    return _NONE if value is None else f"{1e3 * value:.3g}"


def _plain(value: float | None) -> str:
    return _NONE if value is None else f"{value:.3g}"


_COLUMNS: dict[str, Callable[[Row], str]] = {
    "mean error [mm]": lambda row: _length(row.mean_error),
    "largest [mm]": lambda row: _length(row.largest_error),
    "mean [%]": lambda row: _plain(row.mean_percent),
    "ms/step": lambda row: _plain(row.ms_per_step),
    "iterations/step": lambda row: _plain(row.iterations_per_step),
    "bytes/cell": lambda row: _plain(row.bytes_per_cell),
    "memory [MB]": lambda row: _plain(row.megabytes),
    "stable step [ms]": lambda row: _length(row.stable_step),
    "inverted": lambda row: _NONE if row.inverted is None else str(row.inverted),
    "unconverged": lambda row: _NONE if row.unconverged is None else str(row.unconverged),
}
