"""A knife with a toughness: its edge presses on the material until that gives way.

Each point of the edge in the material pulls at the material point where it is, by a spring to where
the tool is: f = k (tool - point). Once f reaches J_c w, with w the length of edge that the point
stands for, the point goes on through the material towards the tool, until f is J_c w again. The
springs are so stiff that a point lags behind the tool by a tenth of a cell when it cuts.

In a sheet the edge cuts over the thickness t, wherever it passes through: the points near the sheet
that follow each other there share J_c t by the lengths for which they stand.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.cutting.kinds import tough_knife_of
from tissu.cutting.way import pose_at
from tissu.simulation import grab
from tissu.simulation.slicing import LONGEST_WAY, cell_size, cut_rows, edge_of
from tissu.simulation.track import Anchors, Track, anchored

if TYPE_CHECKING:
    from tissu.cutting.pose import Pose
    from tissu.cutting.report import CutReport
    from tissu.scene.instrument import Knife
    from tissu.simulation.simulation import Simulation

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

MEMORY = "presses"  # of the core, as grabs have theirs
_LAG = 0.1
"""of a point behind the tool when the material gives way, as a share of a cell's mean edge"""
_LEAST_ADVANCE = 0.2
"""of a point before the edge cuts on, as a share of a cell's mean edge; see `slicing.LEAST_WAY`"""
_LANE = 1 << 20
"""numbers of springs of one track"""
_MOST_PARTS, _MOST_PLACES = 4096, 256


def press(simulation: Simulation, known: dict[int, Track], end: float) -> None:
    """Before a step that ends at a time [s]: edges press towards where their tools will be."""
    for number, (name, body) in enumerate(simulation._instrument_pairs()):
        knife = tough_knife_of(simulation.scene.instruments[name])
        if knife is not None:
            track = known[number]
            pose = track.poses[-1] if knife.path is None else pose_at(knife.path, end)
            _press(simulation, knife, body, track, pose)


def cut_pressing(
    simulation: Simulation, name: str, knife: Knife, body: str, track: Track
) -> tuple[CutReport | None, Track]:
    """Let the edge go on where the force on it has reached the toughness.

    Raises:
        ParameterError: the cut is refused.
    """
    assert knife.toughness is not None
    size, positions = cell_size(simulation, body), simulation._core.positions
    pose, edge = track.poses[-1], edge_of(simulation, knife)
    cut, behind, row = _rows(track)
    tool, places, front = pose.place(edge), row.places(positions), cut[-1].places(positions)
    way = tool - places
    length = np.linalg.norm(way, axis=1)
    inside, pushes = row.inside, _pushes(track, tool, positions)
    # All that have given way go on together, as soon as one of them is far enough behind: an edge
    # whose points go on one by one would cut in strips that are too narrow to say what they part.
    gives_way = inside & pushes & (length > _LAG * size)
    gives_way &= bool((length[gives_way] > (_LAG + _LEAST_ADVANCE) * size).any())
    free = ~inside | (inside & ~pushes & (length > size))
    # Between a point beside the material and the next one the edge may be in a corner of the body,
    # which is cut as they go along.
    drawn = bool((np.linalg.norm(places - front, axis=1) > LONGEST_WAY * size).any())
    now = replace(track, poses=(pose,))
    report = None
    if drawn or gives_way.any():
        share = np.where(gives_way, 1.0 - _LAG * size / np.maximum(length, 1e-300), 0.0)
        ahead = _parted(front, places + share[:, None] * way, LONGEST_WAY * size)
        report, now = cut_rows(simulation, name, body, replace(now, rows=cut), ahead)
        if report is not None:
            report = replace(report, work=knife.toughness * report.area)
        cut, behind, row = now.rows, behind.chosen(row, gives_way), now.rows[-1]
    behind, row = _followed(simulation, body, (behind, row), free, places, tool, size)
    now = replace(now, rows=(*cut, behind, row))
    _press(simulation, knife, body, now, pose)
    return report, now


def force_on(simulation: Simulation, name: str) -> Floats:
    """What the tissue gives to a knife (3,) [N]."""
    total = np.zeros(3)
    lanes = {n for n, (tool, _) in enumerate(simulation._instrument_pairs()) if tool == name}
    for number, record in grab.records(simulation._core, MEMORY).items():
        if number // _LANE not in lanes:
            continue
        point = record.weights @ simulation._core.positions[record.nodes]
        total += record.stiffness * (point - record.target)
    return total


def let_go(simulation: Simulation, name: str) -> None:
    """Take the springs of a knife away, if it has any."""
    if tough_knife_of(simulation.scene.instruments[name]) is None:
        return
    lanes = {n for n, (tool, _) in enumerate(simulation._instrument_pairs()) if tool == name}
    kept = grab.records(simulation._core, MEMORY)
    grab.keep(simulation._core, {n: r for n, r in kept.items() if n // _LANE not in lanes}, MEMORY)


def widths_of(edge: Floats) -> Floats:
    """The length of edge (m,) that each of its points stands for [m]."""
    lengths = np.linalg.norm(np.diff(edge, axis=0), axis=1)
    widths = np.zeros(len(edge))
    widths[:-1] += 0.5 * lengths
    widths[1:] += 0.5 * lengths
    return widths


def _through(widths: Floats, inside: Bools, thickness: float) -> Floats:
    """Widths (m,) of which each row of points near a sheet has its thickness together [m]."""
    begins = inside & ~np.concatenate([[False], inside[:-1]])
    place = np.where(inside, np.cumsum(begins), 0)
    total = np.bincount(place, widths)
    return np.asarray(np.where(inside, thickness * widths / total[place], 0.0))


def _press(simulation: Simulation, knife: Knife, body: str, track: Track, pose: Pose) -> None:
    """Make the springs of a track those of its points in the material that the tool pushes on."""
    assert knife.toughness is not None
    edge = edge_of(simulation, knife)
    tool = pose.place(edge)
    row = track.rows[-1]
    pushed = row.inside & _pushes(track, tool, simulation._core.positions)
    widths = widths_of(edge)
    if not simulation.meshes[body].volume_blocks:
        widths = _through(widths, row.inside, simulation.scene.bodies[body].thickness or 0.0)
    stiffness = knife.toughness * widths / (_LAG * cell_size(simulation, body))
    # Material that gives way pulls back with no more than its toughness until the edge cuts on.
    places = row.places(simulation._core.positions)
    way, lag = tool - places, _LAG * cell_size(simulation, body)
    length = np.linalg.norm(way, axis=1, keepdims=True)
    targets = places + way * np.minimum(1.0, lag / np.maximum(length, 1e-300)) - row.offsets
    kept = grab.records(simulation._core, MEMORY)
    springs = {n: r for n, r in kept.items() if n // _LANE != track.number}
    for point in np.flatnonzero(pushed):
        held = row.rows[point] >= 0
        number = track.number * _LANE + int(point)
        springs[number] = grab.Record(
            number=number,
            stiffness=float(stiffness[point]),
            target=targets[point],
            nodes=row.rows[point][held],
            weights=row.weights[point][held],
            frame=-1,
            rotation=-1,
            place=np.zeros(3),
        )
    grab.keep(simulation._core, dict(sorted(springs.items())), MEMORY)


def _rows(track: Track) -> tuple[tuple[Anchors, ...], Anchors, Anchors]:
    """The rows of the cut so far, where each point was before its latest move, and where it is."""
    *cut, behind, row = track.rows if len(track.rows) > 1 else 3 * track.rows
    return tuple(cut), behind, row


def _pushes(track: Track, tool: Floats, positions: Floats) -> Bools:
    """Whether the tool is ahead of each point (m,), on the side to which that went on last."""
    _, behind, row = _rows(track)
    last, before = row.places(positions), behind.places(positions)
    return np.asarray(((tool - last) * (last - before)).sum(axis=1) >= 0.0)


def _parted(start: Floats, end: Floats, longest: float) -> Floats:
    """Rows (k, m, 3) from start to end, no point of which moves by more than `longest` [m]."""
    far = float(np.linalg.norm(end - start, axis=1).max())
    parts = min(_MOST_PARTS, 2 ** max(0, math.ceil(math.log2(max(far / longest, 1.0)) - 1e-9)))
    shares = np.linspace(0.0, 1.0, parts + 1)[:, None, None]
    return np.asarray(start + shares * (end - start))


def _followed(
    simulation: Simulation,
    body: str,
    rows: tuple[Anchors, Anchors],
    free: Bools,
    places: Floats,
    tool: Floats,
    size: float,
) -> tuple[Anchors, Anchors]:
    """Points beside the material go to the tool, or to where they enter the material.

    Returns:
        Where each point was before its latest move, and where it is, as `rows` had it.
    """
    behind, row = rows
    if not free.any():
        return rows
    ends = np.where(free[:, None], tool, places)
    far = float(np.linalg.norm(ends - places, axis=1).max())
    count = min(_MOST_PLACES, max(1, math.ceil(far / (_LAG * size))))
    # Those in the material that the tool has drawn back from are let go, and follow it as it is.
    chosen = np.flatnonzero(free & ~row.inside)
    shares = np.arange(1, count + 1) / count
    way = places[chosen, None] + shares[:, None] * (tool - places)[chosen, None]
    found = anchored(simulation._core, body, np.ascontiguousarray(way.reshape(-1, 3)))
    inside = found.inside.reshape(len(chosen), count)
    for k, point in enumerate(chosen):
        entries = np.flatnonzero(inside[k])
        if len(entries):
            ends[point] = way[k, entries[0]]
    start = anchored(simulation._core, body, places)
    return behind.chosen(start, free), row.chosen(anchored(simulation._core, body, ends), free)
