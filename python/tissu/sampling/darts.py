"""Darts thrown into a grid: samples that keep their distance, and what they cover.

The cells of the base grid have the diagonal d, so that each holds one sample at most, and what is
nearer than d to a point lies within two cells of its own. Method: Ebeida, Mitchell, Patney,
Davidson and Owens, A simple algorithm for maximal Poisson-disk sampling in high dimensions,
Computer Graphics Forum 31(2), 2012; here whole rounds of darts compete at once.
"""

from __future__ import annotations

import itertools

import numpy as np

from tissu.mesh.cell import Floats
from tissu.sampling.region import Bools, Indices

_CHUNK = 16384
_MARGIN = 2
# A cell two away along all three axes is d away: nothing in it conflicts.
_NEIGHBOURS = [
    offset for offset in itertools.product(range(-2, 3), repeat=3) if min(map(abs, offset)) < 2
]


class Darts:
    """Samples at least `distance` apart."""

    def __init__(self, bounds: Floats, distance: float) -> None:
        """Bounds (2, 3) and distance [m]."""
        self.distance = distance
        self.side = distance / np.sqrt(3.0)
        self.low = bounds[0]
        self.shape = np.maximum(np.ceil(np.ptp(bounds, axis=0) / self.side), 1).astype(np.int64)
        padded = self.shape + 2 * _MARGIN
        self._strides = np.array([padded[1] * padded[2], padded[2], 1])
        self._near = np.array(_NEIGHBOURS) @ self._strides
        self._owner = np.full(padded.prod(), -1, dtype=np.int32)
        self._bid = np.full(padded.prod(), -1, dtype=np.int32)
        self.samples = np.empty((0, 3))

    def free(self, points: Floats) -> Bools:
        """Which points (n, 3) are at least `distance` away from every sample."""
        return ~self._reached(points, np.zeros(3))

    def covered(self, centres: Floats, half: float) -> Bools:
        """Which cubes, of centres (n, 3) and half a side [m], lie within reach of one sample."""
        return self._reached(centres, np.full(3, half))

    def _reached(self, points: Floats, half: Floats) -> Bools:
        """Whether the far corner of the cube around each point is within reach of a sample."""
        found = np.zeros(len(points), dtype=bool)
        for start in range(0, len(points), _CHUNK):
            part = slice(start, start + _CHUNK)
            who, sample = self._pairs(points[part], self._owner)
            away = np.abs(points[part][who] - self.samples[sample]) + half
            hit = np.einsum("ij,ij->i", away, away) < self.distance**2
            found[start + who[hit]] = True
        return found

    def accept(self, points: Floats, rng: np.random.Generator) -> int:
        """Takes some of the points that are free, none too near to another; how many.

        The order is drawn: a point is taken when no point before it is too near.
        """
        if not len(points):
            return 0
        points = points[rng.permutation(len(points))]
        cell = self._cell(points)
        points = points[np.sort(np.unique(cell, return_index=True)[1])]  # the first in each cell
        cell = self._cell(points)
        self._bid[cell] = np.arange(len(points))
        wins = np.ones(len(points), dtype=bool)
        for start in range(0, len(points), _CHUNK):
            part = slice(start, start + _CHUNK)
            who, other = self._pairs(points[part], self._bid)
            before = other < start + who
            who, other = who[before], other[before]
            away = points[part][who] - points[other]
            near = np.einsum("ij,ij->i", away, away) < self.distance**2
            wins[start + who[near]] = False
        self._bid[cell] = -1
        first = len(self.samples)
        self._owner[cell[wins]] = np.arange(first, first + int(wins.sum()))
        self.samples = np.concatenate([self.samples, points[wins]])
        return int(wins.sum())

    def _cell(self, points: Floats) -> Indices:
        """Number of the base cell of each point."""
        place = np.floor((points - self.low) / self.side).astype(np.int64)
        return np.asarray((np.clip(place, 0, self.shape - 1) + _MARGIN) @ self._strides)

    def _pairs(
        self, points: Floats, held: np.ndarray[tuple[int], np.dtype[np.int32]]
    ) -> tuple[Indices, Indices]:
        """Each point with each thing held by its cell and the cells around."""
        found = held[self._cell(points)[:, None] + self._near]
        held_there = found.ravel()
        pairs = np.flatnonzero(held_there >= 0)  # much faster than nonzero of two dimensions
        return pairs // len(self._near), held_there[pairs].astype(np.int64)
