"""Cut: a line is drawn over a body, and the body is cut along it, away from the eye."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.cutting.blade import Sweep
from tissu.errors import ParameterError
from tissu.live_view.marks import Marks, extent
from tissu.live_view.tools.tool import Number, Tool

if TYPE_CHECKING:
    from tissu.cutting.report import CutReport
    from tissu.live_view.pointer import Pointer
    from tissu.simulation import Simulation

Floats = NDArray[np.float64]

_COLOUR = (180, 30, 30)
_SHORTEST = 0.004
"""Way of the pointer between two places of the line, as a share of the extent of the scene."""

_LIFTED = 0.02
"""What the line is drawn above the body, as a share of that extent."""


class Cut(Tool):
    """Cuts the body under the pointer along a line, in every simulation that is shown."""

    name = "cut"
    hint = "Draw a line over a body: when the pointer is released, the body is cut along it."

    edits = True

    def __init__(self, simulations: Sequence[Simulation]) -> None:
        """No line is drawn yet."""
        super().__init__(simulations)
        self._size = extent([mesh.points for mesh in simulations[0].meshes.values()])
        self.numbers = [
            Number("depth, 0: all through", "mm", 0.0, 0.0),
            Number("beyond both ends of the line", "mm", 0.0, 0.0),
        ]
        self._lines: dict[int, list[Pointer]] = {}
        self._said = ""

    @classmethod
    def offered(cls, simulation: Simulation) -> bool:
        """Where bodies may be cut."""
        return simulation.scene.editing is not None

    def press(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        """Begin a line."""
        self._lines[pointer.client] = [pointer]

    def move(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        """Draw on."""
        line = self._lines.get(pointer.client)
        if line is None:
            return
        if np.linalg.norm(pointer.there - line[-1].there) >= _SHORTEST * self._size:
            line.append(pointer)

    def release(self, simulations: Sequence[Simulation], pointer: Pointer) -> None:
        """Cut along the line; a line of one place cuts nothing."""
        line = self._lines.pop(pointer.client, [])
        if len(line) < 2:
            return
        blade = Sweep(self._edges(line))
        reports = [simulation.cut(line[0].body, blade) for simulation in simulations]
        self._said = " and ".join(words(report) for report in reports)

    def say(self, simulations: Sequence[Simulation]) -> str:
        """What the latest cut did."""
        return self._said

    def draw(self, simulations: Sequence[Simulation]) -> Sequence[Sequence[Marks]]:
        """The lines that are being drawn, on every simulation."""
        lines = [
            np.stack([self._before_the_body(one), self._before_the_body(other)])
            for line in self._lines.values()
            for one, other in itertools.pairwise(line)
        ]
        marks = (Marks(_COLOUR, lines=np.array(lines)),) if lines else ()
        return [marks for _ in simulations]

    def forget(self) -> None:
        """The cut was undone."""
        self._said = ""

    def _before_the_body(self, pointer: Pointer) -> Floats:
        """A little towards the eye, so that the body does not hide it."""
        towards = pointer.eye - pointer.there
        way = min(_LIFTED * self._size, 0.5 * float(np.linalg.norm(towards)))
        return np.asarray(pointer.there + way * _unit(towards))

    def _edges(self, line: Sequence[Pointer]) -> Floats:
        """The blade at each place of the line (k, 2, 3): from before the body away from the eye."""
        there = np.array([pointer.there for pointer in line])
        eyes = np.array([pointer.eye for pointer in line])
        beyond = 1e-3 * self.numbers[1].value
        if beyond > 0.0:
            there[0] += beyond * _unit(there[0] - there[1])
            there[-1] += beyond * _unit(there[-1] - there[-2])
        along = there - eyes
        along /= np.linalg.norm(along, axis=1, keepdims=True)
        depth = 1e-3 * self.numbers[0].value
        if depth == 0.0:
            return np.stack([eyes, there + 2.0 * self._size * along], axis=1)
        return np.stack([there - depth * along, there + depth * along], axis=1)


def words(report: CutReport) -> str:
    """A report on the page."""
    if not report.cells_cut:
        return "the blade met nothing that it could cut"
    pieces = "1 piece" if len(report.pieces) == 1 else f"{len(report.pieces)} pieces"
    return f"{report.cells_cut} cells cut, {1e4 * report.area:.3g} cm² opened, {pieces}"


def _unit(vector: Floats) -> Floats:
    length = float(np.linalg.norm(vector))
    if length == 0.0:
        raise ParameterError("found a line without length; draw a longer one")
    return np.asarray(vector / length)
