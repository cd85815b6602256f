"""Momenta of points of tissue, which are lumped on the frames that they follow."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.simulation.twist import give_back, joined, labels_of, point_momenta, rows_of

if TYPE_CHECKING:
    from tissu.simulation.severing import Severing
    from tissu.ties import Left, Weights

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def momenta_of(simulation: Severing, tissue: str, left: Left, points: Ints) -> Floats:
    """Momentum and angular momentum about the origin (t, 6) of points of a tissue.

    Args:
        simulation: as it moves now.
        tissue: its name.
        left: its points and what they follow in the world that there is.
        points: their numbers (t,).
    """
    links, weights = simulation._links[tissue], _of(left, points)
    rows = simulation._rows(tissue, left)
    places = [simulation._rest[body].points[node] for body, node in left.shared]
    rest = np.concatenate([links.origins[: links.own], np.reshape(places, (-1, 3))])
    turned = _turned(simulation, tissue, left)
    return point_momenta(
        weights._replace(frames=rows[weights.frames]),
        links.masses[points],
        links.points[points][:, None] - rest[weights.frames],
        links.volumes[points] ** (2.0 / 3.0) / 6.0,
        turned[weights.frames],
        rows_of(simulation._core),
    )


def give_back_to(simulation: Severing, tissue: str, left: Left, points: Ints, lost: Floats) -> None:
    """Give frames what points (t,) have lost (t, 6), one twist for those that hang together."""
    if not lost.any():
        return
    weights, rows = _of(left, points), rows_of(simulation._core)
    weights = weights._replace(frames=simulation._rows(tissue, left)[weights.frames])
    labels = joined(weights, np.arange(len(rows.mass)))
    give_back(lost, labels_of(weights, labels), weights, rows)


def _of(left: Left, points: Ints) -> Weights:
    return left.weights.of(np.searchsorted(left.kept, points))


def _turned(simulation: Severing, tissue: str, left: Left) -> Floats:
    """Rotations (n, 3, 3) of a tissue's own frames, and of the nodes that it shares."""
    own = simulation._core.rotations(tissue)
    turned = np.tile(np.eye(3), (len(own) + len(left.shared), 1, 1))
    turned[: len(own)] = own
    others = {body: simulation._core.rotations(body) for body, _ in left.shared}
    for i, (body, node) in enumerate(left.shared):
        if len(others[body]):
            turned[len(own) + i] = others[body][node]
    return turned
