"""What an instrument remembers of a body from step to step, as it stands in the state."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.cutting.pose import Pose

if TYPE_CHECKING:
    from tissu import _core as core
    from tissu.simulation.simulation import Simulation

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

MEMORY = "instruments"  # of the core, with the numbers of `Track` one after the other
_HEAD, _POSE, _ANCHOR = 6, 7, 12


@dataclass(frozen=True, slots=True, eq=False)
class Anchors:
    """Places that go with the material.

    Attributes:
        inside: whether each (m,) is in the material, or near a sheet.
        rows: rows of the unknowns (m, 4) that carry each, -1: none.
        weights: their weights (m, 4), which sum to one.
        offsets: from there (m, 3) [m]; zero in a volume.
    """

    inside: Bools
    rows: NDArray[np.int64]
    weights: Floats
    offsets: Floats

    def places(self, positions: Floats) -> Floats:
        """Where they are (m, 3), given all positions (n, 3) [m]."""
        carried = np.einsum("mk,mki->mi", self.weights, positions[np.maximum(self.rows, 0)])
        return np.asarray(carried + self.offsets)

    def chosen(self, other: Anchors, where: Bools) -> Anchors:
        """These, with those of another row where that is chosen (m,)."""
        wide = where[:, None]
        return Anchors(
            np.where(where, other.inside, self.inside),
            np.where(wide, other.rows, self.rows),
            np.where(wide, other.weights, self.weights),
            np.where(wide, other.offsets, self.offsets),
        )

    def numbers(self) -> Floats:
        """The numbers of the core (12 m,)."""
        return np.column_stack([self.inside, self.rows, self.weights, self.offsets]).ravel()


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """An instrument in one body.

    Attributes:
        number: of the instrument and body among all such pairs of the scene.
        incision: number of the incision that goes on; -1: none.
        poses: where the instrument was, and where it has been since then.
        rows: the latest places of the edge in the material, the last one where `poses` begins.
    """

    number: int
    incision: int
    poses: tuple[Pose, ...]
    rows: tuple[Anchors, ...]

    def moved(self, poses: list[Pose]) -> Track:
        """The same after some more poses; one where it is already is left out."""
        known = list(self.poses)
        for pose in poses:
            if not np.array_equal(pose.numbers(), known[-1].numbers()):
                known.append(pose)
        return replace(self, poses=tuple(known))

    def numbers(self) -> Floats:
        """The numbers of the core."""
        points = len(self.rows[0].inside) if self.rows else 0
        length = _HEAD + _POSE * len(self.poses) + _ANCHOR * points * len(self.rows)
        head = (self.number, length, self.incision, points, len(self.poses), len(self.rows))
        parts = [pose.numbers() for pose in self.poses] + [row.numbers() for row in self.rows]
        return np.concatenate([np.array(head, dtype=float), *parts])


def tracks(simulation: core.Simulation) -> dict[int, Track]:
    """The tracks of the present state by their numbers; empty before the first step."""
    numbers, found = simulation.remembered(MEMORY), {}
    while len(numbers):
        number, length, incision, points, poses, rows = (int(n) for n in numbers[:_HEAD])
        end = _HEAD + _POSE * poses
        turned = numbers[_HEAD:end].reshape(poses, _POSE)
        anchored = numbers[end:length].reshape(rows, points, _ANCHOR)
        found[number] = Track(
            number=number,
            incision=incision,
            poses=tuple(Pose(pose[:3].copy(), pose[3:].copy()) for pose in turned),
            rows=tuple(_anchors(row) for row in anchored),
        )
        numbers = numbers[length:]
    return found


def keep(simulation: core.Simulation, kept: dict[int, Track]) -> None:
    """Make these the tracks of the present state."""
    numbers = [np.empty(0), *(track.numbers() for track in kept.values())]
    simulation.set_remembered(MEMORY, np.concatenate(numbers))


def anchored(simulation: core.Simulation, body: str, points: Floats) -> Anchors:
    """Anchors of points (m, 3) in a body as it is now [m]."""
    first, _ = simulation.body_range(body)
    inside, nodes, weights, offsets = simulation.anchors(body=body, points=points)
    rows = np.where(nodes >= 0, nodes.astype(np.int64) + first, -1)
    return Anchors(np.asarray(inside), rows, weights, offsets)


def places_in(simulation: Simulation, body: str) -> dict[int, tuple[Floats, ...]]:
    """Places [m] of the rows of each track in a body, by the number of the track."""
    pairs, positions = simulation._instrument_pairs(), simulation._core.positions
    return {
        number: tuple(row.places(positions) for row in track.rows)
        for number, track in tracks(simulation._core).items()
        if pairs[number][1] == body
    }


def anchor_again(simulation: Simulation, body: str, places: dict[int, tuple[Floats, ...]]) -> None:
    """Put the rows of tracks in a body back at places, from which nodes that moved took them."""
    known = tracks(simulation._core)
    for number, rows in places.items():
        again = tuple(anchored(simulation._core, body, np.ascontiguousarray(row)) for row in rows)
        known[number] = replace(known[number], rows=again)
    keep(simulation._core, known)


def anchored_in_tissue(simulation: Simulation, tissue: str, points: Floats) -> Anchors:
    """Anchors of points (m, 3) [m]: each goes with the nearest frame that has a point."""
    first, _ = simulation._core.body_range(tissue)
    frames, used = simulation.positions[tissue], simulation._left(tissue).weights.frames
    followed = np.intersect1d(used, np.arange(len(frames)))
    apart = np.linalg.norm(points[:, None] - frames[followed], axis=2)
    near = followed[apart.argmin(axis=1)]
    rows, weights = np.full((len(points), 4), -1, dtype=np.int64), np.zeros((len(points), 4))
    rows[:, 0], weights[:, 0] = first + near, 1.0
    return Anchors(np.ones(len(points), dtype=bool), rows, weights, points - frames[near])


def _anchors(row: Floats) -> Anchors:
    return Anchors(
        inside=row[:, 0] != 0.0,
        rows=row[:, 1:5].astype(np.int64),
        weights=row[:, 5:9].copy(),
        offsets=row[:, 9:].copy(),
    )
