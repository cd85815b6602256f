"""An ablator at the end of a step: cells whose material has its centre in the tip's way go."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from tissu.cutting.blade import Capsule
from tissu.cutting.material import centres_of
from tissu.cutting.way import LONGEST_TURN

if TYPE_CHECKING:
    from tissu.cutting.pose import Pose
    from tissu.cutting.report import CutReport
    from tissu.scene.instrument import Ablator
    from tissu.simulation.simulation import Simulation
    from tissu.simulation.track import Track


def ablate_with(
    simulation: Simulation, name: str, tip: Ablator, body: str, track: Track
) -> tuple[CutReport | None, Track]:
    """Take away the cells of a body whose centres lie on the way of the tip since its last place.

    Of tissue, the points that lie there.

    Raises:
        ParameterError: the ablation is refused.
    """
    after = replace(track, poses=track.poses[-1:])
    swept = [place for a, b in itertools.pairwise(track.poses) for place in _between(tip, a, b)]
    swept = swept or [_tip(tip, track.poses[-1])]
    if body in simulation._meshes and not any(_near(simulation, body, p) for p in swept):
        return None, after
    tissue = body in simulation._links
    if tissue:
        centres = simulation.points(body)
        numbers = np.arange(len(centres), dtype=np.int32)
    else:
        centres, numbers = centres_of(simulation.material(body))
    inside = np.zeros(len(numbers), dtype=bool)
    for place in swept:
        inside |= place.holds(centres)
    if not inside.any():
        return None, after
    if tissue:
        return simulation._take(body, inside, by=name), after
    return simulation._ablate_cells(body, numbers[inside], len(numbers), by=name), after


def _tip(tip: Ablator, pose: Pose) -> Capsule:
    ends = pose.place(tip.points())
    return Capsule((ends[0], ends[-1]), tip.radius)


def _between(tip: Ablator, a: Pose, b: Pose) -> list[Capsule]:
    """The tip at places between two poses: a ball as the capsules that it sweeps, without gaps."""
    if tip.ends is None:
        return [Capsule((a.position, b.position), tip.radius)]
    moved = np.linalg.norm(b.place(tip.points()) - a.place(tip.points()), axis=1).max()
    needed = max(moved / (0.5 * tip.radius), a.angle_to(b) / LONGEST_TURN, 1.0)
    parts = math.ceil(needed)
    return [_tip(tip, a.between(b, part / parts)) for part in range(parts + 1)]


def _near(simulation: Simulation, body: str, place: Capsule) -> bool:
    """Whether the box of the tip meets that of the body."""
    first, count = simulation._core.body_range(body)
    nodes = simulation._core.positions[first : first + count]
    low, high = place.box()
    return not ((high < nodes.min(axis=0)) | (low > nodes.max(axis=0))).any()
