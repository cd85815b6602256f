"""What was found out about a scene: a table, a sentence, and the scene to take."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

from tissu.advice.answer import cheapest, nearest, sentence
from tissu.advice.goal import Goal
from tissu.advice.rows import Row, front
from tissu.counted import counted

if TYPE_CHECKING:
    from tissu.front import Scene

_NONE = "-"
_NOT_WRITTEN = ("scene", "error_excess", "rate_excess")


@dataclass(frozen=True, slots=True)
class Advice:
    """The settings of a scene that were tried, and the recommended one.

    Attributes:
        name: of the scene.
        goal: the requested error and rate.
        reference: the run with which the others are compared, and the estimate of its own error.
        largest: the largest displacement of the reference over points and times [m].
        reference_error: the reference's own error, mean over points and times [m]; None: not known.
        space_order: order in the size of cells that three runs show; None: they show none.
        time_order: order in the time step; None: none, or the scene is static.
        rows: one for each setting, in the order in which they ran; the scene's own comes first.
        seconds: wall time that all of it took.
        notes: bodies that keep their mesh, each with the reason.
        doubt: why the errors may be unreliable; empty: no sign of that.
    """

    name: str
    goal: Goal
    reference: str
    largest: float
    reference_error: float | None
    space_order: float | None
    time_order: float | None
    rows: tuple[Row, ...]
    seconds: float
    notes: tuple[str, ...] = ()
    doubt: str = ""

    @property
    def chosen(self) -> Row | None:
        """The row that meets error and rate in the least time for an update; None: no row does."""
        return cheapest(self.rows)

    @property
    def best(self) -> Row:
        """The chosen row; if there is none, the row that misses the goal by the least."""
        found = self.chosen or nearest(self.rows)
        return self.rows[0] if found is None else found

    @property
    def scene(self) -> Scene:
        """The scene with the setting of `best`."""
        assert self.best.scene is not None
        return self.best.scene

    @property
    def answer(self) -> str:
        """One sentence: the recommended setting, or the goal that is missed, and by how much."""
        return sentence(self.rows, self.goal)

    def to_csv(self) -> str:
        """A line of names, then a line for each setting; SI units except for ms and megabytes."""
        text = io.StringIO()
        names = [field.name for field in fields(Row) if field.name not in _NOT_WRITTEN]
        writer = csv.DictWriter(text, names, lineterminator="\n")
        writer.writeheader()
        for row in self.rows:
            writer.writerow({name: getattr(row, name) for name in names})
        return text.getvalue()

    def to_markdown(self) -> str:
        """The table with the reference of its errors, and the answer."""
        head = [*_WORDS, *_NUMBERS]
        lines = [
            f"{self.name}: errors against {self.reference}.",
            "",
            f"| {' | '.join(head)} |",
            "|" + "---|" * len(head),
            *(f"| {' | '.join(cells)} |" for cells in self._cells(self.rows)),
            "",
            *self._last_lines(),
        ]
        return "\n".join(lines) + "\n"

    def __str__(self) -> str:
        """The rows worth a look, for a terminal, and the answer; `to_markdown` has all of them.

        They are the scene itself, the reference, the one to take, and those than which none is both
        faster and more accurate.
        """
        kept = [
            self.rows[0],
            self.best,
            *front(self.rows),
            *(r for r in self.rows if r.is_reference),
        ]
        worth = [row for row in self.rows if any(row is one for one in kept)]
        rows = [[*_WORDS, *_NUMBERS], *self._cells(worth)]
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        lines = [
            "  ".join(
                cell.ljust(width) if n < len(_WORDS) else cell.rjust(width)
                for n, (cell, width) in enumerate(zip(row, widths, strict=True))
            ).rstrip()
            for row in rows
        ]
        head = f"{self.name}: errors against {self.reference}"
        ran = f"{counted(len(self.rows), 'setting')} in {self.seconds:.0f} s, of which the "
        ran += "scene's own, the reference and those that none beats in time and error:"
        return "\n".join([head, ran, *lines, "", *self._last_lines()])

    def _cells(self, rows: Sequence[Row]) -> list[list[str]]:
        return [
            [*(show(row) for show in _WORDS.values()), *(show(row) for show in _NUMBERS.values())]
            for row in rows
        ]

    def _last_lines(self) -> list[str]:
        notes = [f"note: {note}" for note in self.notes]
        return [self.answer, *notes, *([f"beware: {self.doubt}"] if self.doubt else [])]


def _number(value: float | None, factor: float = 1.0) -> str:
    return _NONE if value is None else f"{factor * value:.3g}"


def _verdict(met: bool, known: float | None) -> str:
    return _NONE if known is None else "yes" if met else "no"


def _mark(row: Row) -> str:
    """What is special about a row."""
    if row.is_reference:
        return "reference"
    return "" if row.outcome == "finished" else row.outcome


_WORDS: dict[str, Callable[[Row], str]] = {
    "mesh": lambda row: row.mesh,
    "model": lambda row: row.model,
    "step": lambda row: row.step,
    "solver": lambda row: row.solver,
    "": _mark,
}
_NUMBERS: dict[str, Callable[[Row], str]] = {
    "distance [mm]": lambda row: _number(row.distance, 1e3),
    "error [mm]": lambda row: _number(row.error, 1e3),
    "[%]": lambda row: _number(row.error_percent),
    "ms/update": lambda row: _number(row.ms_per_update),
    "updates/s": lambda row: _number(row.rate),
    "unconverged": lambda row: _NONE if row.unconverged is None else str(row.unconverged),
    "memory [MB]": lambda row: _number(row.megabytes),
    "error met": lambda row: _verdict(row.meets_error, row.error),
    "rate met": lambda row: _verdict(row.meets_rate, row.rate),
}
