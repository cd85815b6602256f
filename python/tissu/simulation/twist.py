"""Momentum across the loss of links: what points carried, and the rigid twists that give it back.

The mass of a point is lumped on the frames that it follows, m_si = w_si m_s, and moves with them.
So other weights give it another momentum. What the touched points that hang together by the links
left to them have lost is given back to their frames, and to no others, by one rigid twist: the
change of velocities u + omega x (x - c) of least kinetic energy. So no momentum goes over to frames
on the other side of the blade.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from tissu import _core as core
    from tissu.ties import Weights

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_LEAST_INERTIA = 1e-9
"""of the largest principal one: about an axis with less, nothing turns"""


@dataclass(frozen=True, slots=True, eq=False)
class Rows:
    """Masses of all rows of the unknowns, and how they move.

    Attributes:
        mass: (n,) [kg].
        turning: row of the rotation of each (n,); -1: none.
        inertia: of each in space (n, 3, 3) [kg m2].
        free: whether nothing holds a row or its rotation (n,).
        x: places (n, 3) [m].
        v: velocities (n, 3), a view of the core's [m/s].
    """

    mass: Floats
    turning: Ints
    inertia: Floats
    free: NDArray[np.bool_]
    x: Floats
    v: Floats

    def momenta(self) -> Floats:
        """Momentum and angular momentum about the origin, of all rows (6,)."""
        p = self.mass[:, None] * self.v
        turn = np.einsum("nij,nj->i", self.inertia, self.spin())
        return np.concatenate([p.sum(axis=0), np.cross(self.x, p).sum(axis=0) + turn])

    def spin(self) -> Floats:
        """Angular velocities (n, 3) [rad/s]; zero where there is no rotation."""
        return np.where((self.turning >= 0)[:, None], self.v[self.turning], 0.0)


def rows_of(simulation: core.Simulation) -> Rows:
    """The rows of a simulation as they are; `v` follows it."""
    mass, frames, inertias = simulation.lumped_masses()
    turning, inertia = np.full(len(mass), -1, dtype=np.int64), np.zeros((len(mass), 3, 3))
    turning[frames[:, 0]], inertia[frames[:, 0]] = frames[:, 1], inertias
    still = np.asarray(~simulation.free_axes().all(axis=1))
    held = still | ((turning >= 0) & still[turning])
    return Rows(mass, turning, inertia, ~held, simulation.positions, simulation.velocities)


def point_momenta(
    weights: Weights, masses: Floats, levers: Floats, own: Floats, turned: Floats, rows: Rows
) -> Floats:
    """Momentum and angular momentum (p, 6) that points have on the frames that they follow.

    Args:
        weights: by numbers of rows.
        masses: of the points (p,) [kg].
        levers: from frames to points at rest (p, k, 3) [m].
        own: inertia per mass that a point has by itself (p,) [m2].
        turned: rotations of the frames (p, k, 3, 3).
        rows: their motion.
    """
    m = weights.shares() * masses[:, None]
    p = m[:, :, None] * rows.v[weights.frames]
    arms = np.einsum("pkij,pkj->pki", turned, levers)
    spin = rows.spin()[weights.frames]
    square = (arms**2).sum(axis=2) + own[:, None]
    along = (arms * spin).sum(axis=2)
    turn = m[:, :, None] * (square[:, :, None] * spin - along[:, :, None] * arms)
    angular = np.cross(rows.x[weights.frames], p) + turn
    return np.concatenate([p.sum(axis=1), angular.sum(axis=1)], axis=1)


def give_back(lost: Floats, groups: Ints, weights: Weights, rows: Rows) -> None:
    """Give back what points have lost (p, 6) to the frames of their groups (p,)."""
    counts = weights.listed()
    for group in np.unique(groups):
        of = groups == group
        touched = np.unique(weights.frames[of][counts[of]])
        _twist(lost[of].sum(axis=0), touched[rows.free[touched]], rows)


def _twist(lost: Floats, touched: Ints, rows: Rows) -> None:
    """Move rows as one rigid body that has a momentum and an angular momentum about the origin."""
    mass = rows.mass[touched]
    if not mass.sum() > 0.0:
        return
    centre = mass @ rows.x[touched] / mass.sum()
    arms = rows.x[touched] - centre
    turned = touched[rows.turning[touched] >= 0]
    square = (mass * (arms**2).sum(axis=1)).sum() * np.eye(3)
    inertia = square - np.einsum("n,ni,nj->ij", mass, arms, arms)
    inertia += rows.inertia[turned].sum(axis=0)
    spin = _solved(inertia, lost[3:] - np.cross(centre, lost[:3]))
    rows.v[touched] += lost[:3] / mass.sum() + np.cross(spin, arms)
    rows.v[rows.turning[turned]] += spin


def _solved(inertia: Floats, momentum: Floats) -> Floats:
    """The spin that has an angular momentum, about the axes that have an inertia."""
    values, axes = np.linalg.eigh(inertia)
    able = (values > _LEAST_INERTIA * values[-1]) & (values > 0.0)
    shares = np.where(able, axes.T @ momentum, 0.0) / np.where(able, values, 1.0)
    return np.asarray(axes @ shares)


def joined(weights: Weights, labels: Ints) -> Ints:
    """The labels (n,) of rows, where those that a point follows get one and the same.

    Args:
        weights: of the points, by numbers of rows.
        labels: the same for rows that hang together already; each is the number of one of them.
    """
    parent = np.arange(len(labels))

    def root(label: int) -> int:
        while parent[label] != label:
            parent[label] = parent[parent[label]]
            label = int(parent[label])
        return label

    for rows, counts in zip(weights.frames, weights.listed(), strict=True):
        roots = {root(int(label)) for label in labels[rows[counts]]}
        parent[list(roots)] = min(roots)
    for label in np.unique(labels[weights.frames]):
        parent[label] = root(int(label))
    return np.asarray(parent[labels])


def labels_of(weights: Weights, labels: Ints) -> Ints:
    """The label (p,) of each point: that of the rows that it follows."""
    first = weights.listed().argmax(axis=1)
    return np.asarray(labels[weights.frames[np.arange(len(first)), first]])
