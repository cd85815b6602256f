"""The way of an instrument between two steps, and the rows of places that its edge takes on it."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.cutting.pose import Pose, pose_of

if TYPE_CHECKING:
    from tissu.scene.instrument import ToolPath

Floats = NDArray[np.float64]

LONGEST_TURN = math.radians(5.0)
"""of an edge between two rows"""
_MOST_PARTS = 4096


def pose_at(path: ToolPath, time: float) -> Pose:
    """Where a path is at a time [s]; it stands still before its first and after its last time."""
    times = path.times
    turns = path.rotations or ((0.0, 0.0, 0.0),) * len(times)
    after = int(np.searchsorted(times, time, side="right"))
    if after in (0, len(times)):
        end = min(after, len(times) - 1)
        return pose_of(path.positions[end], turns[end])
    share = (time - times[after - 1]) / (times[after] - times[after - 1])
    first = pose_of(path.positions[after - 1], turns[after - 1])
    return first.between(pose_of(path.positions[after], turns[after]), share)


def poses_on(path: ToolPath, begin: float, end: float) -> list[Pose]:
    """The poses of a path at its times after `begin` and before `end`, and at `end` [s]."""
    inner = [pose_at(path, time) for time in path.times if begin < time < end]
    return [*inner, pose_at(path, end)]


def resampled(edge: Floats, spacing: float) -> Floats:
    """The points of an edge (m, 3), and such between them that no two are farther apart [m]."""
    parts = []
    for a, b in itertools.pairwise(edge):
        count = max(1, math.ceil(float(np.linalg.norm(b - a)) / spacing - 1e-9))
        parts.append(a + np.linspace(0.0, 1.0, count + 1)[:-1, None] * (b - a))
    return np.concatenate([*parts, edge[-1:]])


def rows_of(edge: Floats, poses: Sequence[Pose], start: Floats, longest: float) -> Floats:
    """The places (k, m, 3) of the points of an edge on a way through poses [m].

    The first row is `start`, where the tissue has carried the edge's last place. What lies between
    that and the rigid edge fades out along the way. Each part of the way is halved until no point
    moves more than `longest` and the edge turns by no more than 5 degrees.

    Args:
        edge: its points in the tool's axes (m, 3) [m].
        poses: of the tool; the first belongs to the first row.
        start: places of the points at the beginning (m, 3) [m].
        longest: way of a point between two rows [m].
    """
    poses = [*poses, poses[-1]] if len(poses) == 1 else poses  # the tissue alone has moved
    gap = start - poses[0].place(edge)
    ways = len(poses) - 1
    rows = [start]
    for number, (a, b) in enumerate(itertools.pairwise(poses)):
        moved = b.place(edge) - a.place(edge) - gap / ways
        chord = float(np.linalg.norm(moved, axis=1).max(initial=0.0))
        turn = a.angle_to(b)
        reach = turn * float(np.linalg.norm(edge, axis=1).max(initial=0.0))
        needed = max((chord + reach) / longest, turn / LONGEST_TURN, 1.0)
        parts = min(_MOST_PARTS, 2 ** math.ceil(math.log2(min(needed, _MOST_PARTS)) - 1e-9))
        for part in range(1, parts + 1):
            share = part / parts
            left = 1.0 - (number + share) / ways
            rows.append(a.between(b, share).place(edge) + left * gap)
    return np.array(rows)


def bends_of(rows: Floats, tolerance: float) -> list[int]:
    """Numbers of the rows (k, m, 3) that keep a way within a distance of itself, ascending.

    The first and the last are among them. Each other row has its points no farther than that from
    the chords between the rows that stay before and after it (Douglas and Peucker 1973).

    Args:
        rows: places of the points of an edge [m].
        tolerance: the distance [m].
    """
    kept, open_parts = {0, len(rows) - 1}, [(0, len(rows) - 1)]
    while open_parts:
        first, last = open_parts.pop()
        if last - first < 2:
            continue
        away = _from_chords(rows[first + 1 : last], rows[first], rows[last])
        farthest = int(away.argmax())
        if away[farthest] > tolerance:
            middle = first + 1 + farthest
            kept.add(middle)
            open_parts += [(first, middle), (middle, last)]
    return sorted(kept)


def _from_chords(rows: Floats, begin: Floats, end: Floats) -> Floats:
    """The largest distance of a point in each row (k, m, 3) from its chord (m, 3) to (m, 3) [m]."""
    chord = end - begin
    square = np.maximum((chord**2).sum(axis=1), np.finfo(np.float64).tiny)
    share = np.clip(((rows - begin) * chord).sum(axis=2) / square, 0.0, 1.0)
    return np.asarray(np.linalg.norm(begin + share[:, :, None] * chord - rows, axis=2).max(axis=1))


def area_of(rows: Floats) -> float:
    """Area of the surface that an edge sweeps through rows (k, m, 3) [m2]."""
    a, b = rows[:-1, :-1], rows[:-1, 1:]
    c, d = rows[1:, 1:], rows[1:, :-1]
    first = np.linalg.norm(np.cross(b - a, c - a), axis=2).sum()
    return float(0.5 * (first + np.linalg.norm(np.cross(c - a, d - a), axis=2).sum()))
