"""What a cut did."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tissu.counted import counted

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

__all__ = ["CutReport", "Piece", "Repairs"]


@dataclass(frozen=True, slots=True, eq=False)
class Piece:
    """A connected part of a body's material.

    Attributes:
        cells: numbers (k,) of the cells that hold it, ascending; a cell may hold several pieces.
            For tissue, numbers of its points.
        volume: at rest [m3].
        mass: [kg].
        held: whether supports hold or lead its nodes on all axes; of tissue, whether a support
            holds one of its frames or one of the bodies that it hangs on.
    """

    cells: Ints
    volume: float
    mass: float
    held: bool

    @property
    def first_cell(self) -> int:
        """The lowest number of its cells."""
        return int(self.cells[0])

    def __repr__(self) -> str:
        """Where it begins, how large it is, and whether it is held."""
        held = "held" if self.held else "free"
        return (
            f"Piece(from cell {self.first_cell}, {counted(len(self.cells), 'cell')}, "
            f"{1e6 * self.volume:.4g} cm3, {self.mass:.4g} kg, {held})"
        )


@dataclass(frozen=True, slots=True)
class Repairs:
    """What was done about bad cells after a cut.

    Attributes:
        collapses: short edges that were collapsed.
        flips: of faces and edges.
        moves: of nodes inside.
        bad_before: bad cells among those that cuts made or opened, before the repair.
        bad_after: the same after it.
        least_quality_before: 6 sqrt 2 V / l_rms^3 at rest, the least of all tetrahedra of the body.
        least_quality_after: the same after it.
        elastic_energy_change: of the operations together [J].
    """

    collapses: int
    flips: int
    moves: int
    bad_before: int
    bad_after: int
    least_quality_before: float
    least_quality_after: float
    elastic_energy_change: float

    @property
    def operations(self) -> int:
        """How many there were."""
        return self.collapses + self.flips + self.moves


@dataclass(frozen=True, slots=True, eq=False)
class CutReport:
    """One cut, ablation or tear of one body; all values are zero if the blade met nothing.

    Attributes:
        body: its name.
        by: name of the instrument that made it, "tear" of a tear; empty: a call of the program.
        ablated: whether it took what lies in a region, rather than cut along a blade.
        cells_cut: cells that the blade divided or along whose faces it ran.
        cells_new: cells that replaced them: copies, or parts where cuts divide cells.
        cells_gone: cells that were replaced or removed.
        nodes_new: copies of nodes, and nodes on edges where cuts divide cells.
        nodes_moved: nodes that were moved onto the cut at rest, where cuts do so.
        faces_opened: triangles of the material, each with two sides now.
        area: of one side of these faces now [m2].
        rest_area: the same at rest [m2].
        parts_nothing: whether the blade divided or opened cells, and no node has parted: the whole
            border of the cut lies in the cells around it, and its walls move as one.
        pieces: all connected parts of the body, the largest first.
        volume_change: of the material at rest [m3].
        mass_change: [kg].
        momentum_change: (3,) [kg m/s].
        angular_momentum_change: about the origin (3,) [kg m2/s].
        kinetic_energy_change: [J].
        elastic_energy_change: [J].
        work: of a blade with a toughness, toughness times area [J]; else 0.
        unresolved: cells that the blade met and did not cut, or not as far as it went, with the
            reason.
        bridges: how many of these cells the blade passed more than once, so that material
            between its walls may stay joined.
        released: numbers of the grabs that were released because their points were separated, or
            lost their cell.
        links_severed: links of tissue, each of a point with a frame or with a node of a body.
        points_gone: numbers of the points of tissue that have lost their last link, or were taken.
        relaid: whether everything was rebuilt, and not only the parts that the edit touched.
        stable_step: the largest stable step of an explicit method after it [s], measured where cuts
            divide cells; else infinite.
        least_quality: 6 sqrt 2 V / l_rms^3 at rest, the least of the tetrahedra that it divided or
            whose nodes it moved, before a repair; infinite if there are none.
        repairs: what was done about bad cells afterwards; None where the scene does not ask for it.
        milliseconds: wall time.
    """

    body: str
    by: str
    ablated: bool
    cells_cut: int
    cells_new: int
    cells_gone: int
    nodes_new: int
    nodes_moved: int
    faces_opened: int
    area: float
    rest_area: float
    parts_nothing: bool
    pieces: tuple[Piece, ...]
    volume_change: float
    mass_change: float
    momentum_change: Floats
    angular_momentum_change: Floats
    kinetic_energy_change: float
    elastic_energy_change: float
    work: float
    unresolved: tuple[tuple[int, str], ...]
    bridges: int
    released: tuple[int, ...]
    links_severed: int
    points_gone: tuple[int, ...]
    relaid: bool
    stable_step: float
    least_quality: float
    repairs: Repairs | None
    milliseconds: float

    @property
    def met_nothing(self) -> bool:
        """Whether nothing was cut and nothing is gone."""
        return not (self.cells_cut or self.cells_gone or self.links_severed or self.nodes_moved)

    def __str__(self) -> str:
        """One line."""
        text = f"{'ablation' if self.ablated else 'cut'} of '{self.body}'"
        text += f" by {self.by}: " if self.by else ": "
        if self.met_nothing:
            return text + f"the {'region' if self.ablated else 'blade'} met nothing"
        if self.links_severed:
            return text + self._of_tissue()
        if self.ablated:
            text += f"{counted(self.cells_gone, 'cell')} gone, "
        else:
            text += f"{counted(self.cells_cut, 'cell')} cut, "
        if self.nodes_moved:
            text += f"{counted(self.nodes_moved, 'node')} moved, "
        text += f"{counted(self.nodes_new, 'new node')}, {1e4 * self.area:.4g} cm2 opened, "
        text += f"{counted(len(self.pieces), 'piece')}, {self.milliseconds:.1f} ms"
        if self.parts_nothing:
            text += "; the blade ends inside these cells and parts nothing"
        elif len(self.unresolved) > self.bridges:
            text += f"; {counted(len(self.unresolved) - self.bridges, 'cell')} met and not cut"
        if self.bridges:
            text += f"; walls of the blade may have left bridges in {counted(self.bridges, 'cell')}"
        if self.repairs is not None and self.repairs.operations:
            text += f"; {counted(self.repairs.operations, 'repair')}"
        if math.isfinite(self.stable_step):
            text += f"; steps are stable up to {self.stable_step:.4g} s"
        return text

    def _of_tissue(self) -> str:
        text = f"{counted(self.links_severed, 'link')} severed, "
        if self.points_gone:
            text += f"{counted(len(self.points_gone), 'point')} gone, "
        jump = self.elastic_energy_change + self.kinetic_energy_change
        return text + (
            f"energy {jump:+.3g} J, {counted(len(self.pieces), 'piece')}, "
            f"{self.milliseconds:.1f} ms"
        )


def cut_report(
    body: str,
    made: dict[str, Any],
    *,
    by: str,
    ablated: bool,
    pieces: tuple[Piece, ...],
    released: tuple[int, ...],
    stable_step: float,
    milliseconds: float,
) -> CutReport:
    """The report of what the core made, between totals of what it touched."""
    before, after = made["before"], made["after"]
    return CutReport(
        body=body,
        by=by,
        ablated=ablated,
        cells_cut=made["cells_cut"],
        cells_new=made["cells_new"],
        cells_gone=made["cells_gone"],
        nodes_new=made["nodes_new"],
        nodes_moved=made["nodes_moved"],
        faces_opened=made["faces_opened"],
        area=made["area"],
        rest_area=made["rest_area"],
        parts_nothing=made["parts_nothing"],
        pieces=pieces,
        volume_change=after["volume"] - before["volume"],
        mass_change=after["mass"] - before["mass"],
        momentum_change=after["momentum"] - before["momentum"],
        angular_momentum_change=after["angular_momentum"] - before["angular_momentum"],
        kinetic_energy_change=after["kinetic"] - before["kinetic"],
        elastic_energy_change=after["elastic"] - before["elastic"],
        work=0.0,
        unresolved=tuple((int(cell), str(why)) for cell, why in made["unresolved"]),
        bridges=made["bridges"],
        released=released,
        links_severed=0,
        points_gone=(),
        relaid=made["relaid"],
        stable_step=stable_step,
        least_quality=made["least_quality"],
        repairs=Repairs(**made["repairs"]) if made.get("repairs") else None,
        milliseconds=milliseconds,
    )
