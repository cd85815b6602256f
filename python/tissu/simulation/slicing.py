"""A knife at the end of a step: it cuts along the way of its edge through the material."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu import _core
from tissu.cutting.way import area_of, bends_of, resampled, rows_of
from tissu.mesh.cell import dimension
from tissu.simulation.track import Anchors, Track, anchored, anchored_in_tissue

if TYPE_CHECKING:
    from tissu.cutting.report import CutReport
    from tissu.mesh import Mesh
    from tissu.scene.instrument import Knife
    from tissu.simulation.simulation import Simulation

Floats = NDArray[np.float64]

LEAST_WAY = 0.25
"""of an edge through the material before it cuts on, as a share of a cell's mean edge

Shorter parts are too narrow to say on which side of them a cell lies: of 24 random slow cuts
through a moving bar two stayed joined at 0.02, one at 0.1, none at 0.2, 0.3 and 0.5.
"""
LONGEST_WAY = 0.5
"""of a point of an edge between two rows, as a share of a cell's mean edge"""
_BEHIND = 1.5
"""of an edge, behind which the front of its cut may lie, as a share of a cell's mean edge"""
_TREMOR = 0.2
"""of a row from the chord between two others, below which it is left out, as a share of a cell's
mean edge

A knife resolves half a cell. Sweeps that turn to and fro within a cell part it in crumbs: of 60
straight cuts in which a hand trembles by 0.06 cells, 17 left crumbs or stayed joined without this,
and none did with it.
"""
_EVEN = 1e-3
"""of a row from the chord between two others, as that surface is then the one that was cut"""
_NO_AREA = 1e-12


def cell_size(simulation: Simulation, body: str) -> float:
    """Mean distance of the first corners of a cell of a body, up to three, on the first day [m].

    Of tissue, the mean distance of its points.
    """
    found = simulation._cell_sizes.get(body)
    if found is None:
        of_tissue = body in simulation._links
        found = simulation._links[body].spacing if of_tissue else _mean_edge(simulation._rest[body])
        simulation._cell_sizes[body] = found
    return found


def _mean_edge(mesh: Mesh) -> float:
    lengths = []
    for block in mesh.body_blocks:
        around = [0, 1] if dimension(block.type) == 1 else [0, 1, 2, 0]
        sides = np.diff(mesh.points[block.nodes[:, around]], axis=1)
        lengths.append(np.linalg.norm(sides, axis=2).ravel())
    return float(np.concatenate(lengths).mean())


def edge_of(simulation: Simulation, knife: Knife) -> Floats:
    """The points (m, 3) of its edge in its own axes, no farther apart than half a cell [m]."""
    size = min(cell_size(simulation, body) for body in knife.cuts)
    return resampled(knife.points(), LONGEST_WAY * size)


def cut_with(
    simulation: Simulation, name: str, knife: Knife, body: str, track: Track
) -> tuple[CutReport | None, Track]:
    """Cut a body along the way that the edge took in its material since its last place.

    Returns:
        What was cut, None where the blade met nothing; and the track from here on.

    Raises:
        ParameterError: the cut is refused.
    """
    edge, size = edge_of(simulation, knife), cell_size(simulation, body)
    start = track.rows[-1].places(simulation._core.positions)
    rows = rows_of(edge, track.poses, start, LONGEST_WAY * size)
    rows = rows[bends_of(rows, _TREMOR * size)]
    if np.linalg.norm(rows - start, axis=2).max() < LEAST_WAY * size:
        # Where it was in between is past: the tissue that was there may be elsewhere by then.
        return None, replace(track, poses=track.poses[-1:])
    if body in simulation._links:
        return _sever_rows(simulation, name, body, track, rows)
    return cut_rows(simulation, name, body, track, rows)


def _sever_rows(
    simulation: Simulation, name: str, tissue: str, track: Track, rows: Floats
) -> tuple[CutReport | None, Track]:
    """Sever the links of a tissue that cross the way of an edge (k, m, 3)."""
    kept = anchored_in_tissue(simulation, tissue, rows[-1])
    after = replace(track, poses=track.poses[-1:], rows=(kept,))
    if not area_of(rows) > _NO_AREA * np.square(np.ptp(rows.reshape(-1, 3), axis=0).max()):
        return None, after
    moments, points, _ = rows.shape
    sweep = _core.edge_sweep(
        places=np.ascontiguousarray(rows.reshape(-1, 3)),
        moments=moments,
        points=points,
        incision=-1,
        past=0,
    )
    return simulation._sever_along(tissue, sweep, by=name), after


def cut_rows(
    simulation: Simulation, name: str, body: str, track: Track, rows: Floats
) -> tuple[CutReport | None, Track]:
    """Cut a body along rows (k, m, 3) of places of an edge, the first where the last cut ended.

    Args:
        simulation: whose body is cut.
        name: of the knife.
        body: its name.
        track: whose rows are those of the cut so far, the last one where it ended.
        rows: where the edge goes on [m].

    Raises:
        ParameterError: the cut is refused.
    """
    # Where the material is now, before it parts: what is kept goes on from both its sides.
    positions, size = simulation._core.positions, cell_size(simulation, body)
    past = [(row, row.places(positions)) for row in track.rows[:-1]]
    kept = _kept(simulation, body, past, rows, size)
    ended = replace(track, incision=-1, poses=track.poses[-1:], rows=kept[-1:])
    if not _near(simulation, body, rows):
        return None, ended
    way = np.array([*(places for _, places in past), *rows])
    if not area_of(way) > _NO_AREA * np.square(np.ptp(way.reshape(-1, 3), axis=0).max()):
        return None, ended
    number = track.incision if track.incision >= 0 else _next_incision(simulation, body, track)
    count, points, _ = way.shape
    sweep = _core.edge_sweep(
        places=np.ascontiguousarray(way.reshape(-1, 3)),
        moments=count,
        points=points,
        incision=number,
        past=len(past) + 1,
    )
    ways = [row.places(positions) for row in kept]
    report = simulation._cut_along(body, sweep, by=name, goes_on=True)
    if report.nodes_moved:  # the nodes on which the rows rode are elsewhere in the material
        kept = tuple(anchored(simulation._core, body, places) for places in ways)
        ended = replace(ended, rows=kept[-1:])
    met = bool(report.cells_cut or report.nodes_moved or report.unresolved)
    # Between two points outside, the edge may still be in a corner of the body.
    goes_on = met or bool(kept[-1].inside.any())
    after = replace(ended, rows=kept, incision=number) if goes_on else ended
    return (report if met else None), after


def _kept(
    simulation: Simulation,
    body: str,
    past: list[tuple[Anchors, Floats]],
    rows: Floats,
    size: float,
) -> tuple[Anchors, ...]:
    """The latest rows of a cut, as far back as its front may be behind the edge.

    A cell is cut along the edges that the blade has crossed. If another blade divides a cell at the
    front, its new edges cross this one where it has already been, so that the next sweep begins
    there.
    """
    ways = np.array([*(places for _, places in past), *rows])
    last, begin = len(ways) - 1, len(ways) - 1
    while begin > 0 and _far(ways[begin], ways[last]) <= _BEHIND * size:
        begin -= 1
    numbers = [begin + bend for bend in bends_of(ways[begin:], _EVEN * size)]
    return tuple(
        past[k][0] if k < len(past) else anchored(simulation._core, body, ways[k]) for k in numbers
    )


def _far(row: Floats, other: Floats) -> float:
    """Mean way of the points (m, 3) between two rows [m]."""
    return float(np.linalg.norm(row - other, axis=1).mean())


def _next_incision(simulation: Simulation, body: str, track: Track) -> int:
    """A number that no incision of the body has, and that no other track takes."""
    lanes, used = len(simulation._tracks()), simulation._core.incisions(body)
    return int(max(used, default=-1)) // lanes * lanes + lanes + track.number


def _near(simulation: Simulation, body: str, rows: Floats) -> bool:
    """Whether the box of the rows meets that of the body."""
    first, count = simulation._core.body_range(body)
    nodes = simulation._core.positions[first : first + count]
    places = rows.reshape(-1, 3)
    apart = (places.max(axis=0) < nodes.min(axis=0)) | (places.min(axis=0) > nodes.max(axis=0))
    return not apart.any()
