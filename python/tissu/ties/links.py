"""The links of tissue: which frames each point follows, and what is left where blades severed some.

A point s loses a neighbour i when a blade runs between x_i and p_s (the visibility criterion:
Belytschko, Lu and Gu, Element-free Galerkin methods, Int. J. Numer. Methods Eng. 37, 1994). Its
weights and their gradients are made anew at rest from the neighbours that are left, so that they
sum to one. What is left depends on the severed pairs alone, and not on their order.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tissu import _core
from tissu.errors import TissuError
from tissu.ties.riding import Carriers, Node, Row, row_of
from tissu.ties.weights import Floats, Ints, Weights

Pairs = NDArray[np.int32]
"""Links (m, 2): the number of a point, and that of an origin: a frame, or a node of a body."""

_LEAST_SPAN = 1e-2
"""of the shortest to the longest extent of frames that span space (moving_least_squares.cpp)"""
_STEEPEST = 2.0
"""times as steep as before any cut: weights of frames nearly in one plane multiply small strains"""


@dataclass(frozen=True, slots=True, eq=False)
class Left:
    """The points of a tissue that are left.

    Attributes:
        kept: numbers of the points (p,), ascending.
        shared: nodes of bodies that they follow.
        weights: by numbers of the tissue's own frames and, after those, of these nodes.
    """

    kept: NDArray[np.int64]
    shared: list[Node]
    weights: Weights


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Links:
    """The links of a tissue on the first day.

    Attributes:
        name: of the tissue.
        shape: name of the shape function.
        own: number of its own frames.
        origins: what points may follow: own frames, then nodes of bodies (n, 3), at rest [m].
        near: these nodes.
        points: at rest (p, 3) [m].
        masses: of the points (p,) [kg].
        volumes: of the points (p,) at rest [m3].
        listened: the weights by numbers of origins.
        first: the weights with nodes replaced by those of their cells, and all nodes.
        carriers: the bodies on whose cells it rides.
    """

    name: str
    shape: str
    own: int
    origins: Floats
    near: list[Node]
    points: Floats
    masses: Floats
    volumes: Floats
    listened: Weights
    first: tuple[Weights, list[Node]]
    carriers: Carriers

    @property
    def spacing(self) -> float:
        """Mean distance of neighbouring points at rest [m]."""
        return float(np.cbrt(self.volumes.mean()))

    def all(self) -> Pairs:
        """The links of the first day, by ascending points."""
        rows, columns = np.nonzero(self.listened.listed())
        return np.column_stack([rows, self.listened.frames[rows, columns]]).astype(np.int32)

    def without(self, severed: Pairs) -> Pairs:
        """The links that are there, once some were severed."""
        pairs = self.all()
        return pairs[~np.isin(self._keys(pairs), self._keys(severed))]

    def lost(self, severed: Pairs) -> NDArray[np.int64]:
        """Numbers of the points without a link."""
        return np.setdiff1d(np.arange(len(self.points)), self.without(severed)[:, 0])

    def left(self, severed: Pairs) -> Left:
        """What is left of the points."""
        first, shared = self.first
        frames, weights = first.frames.copy(), first.weights.copy()
        gradients = first.gradients.copy()
        pairs = self.without(severed)
        numbers = {node: self.own + i for i, node in enumerate(shared)}
        for p in np.setdiff1d(severed[:, 0], self.lost(severed)):
            neighbours = np.ascontiguousarray(pairs[pairs[:, 0] == p, 1])
            row = self._row(int(p), neighbours, numbers)
            order = sorted(row)
            frames[p], weights[p], gradients[p] = order[0], 0.0, 0.0
            frames[p, : len(order)] = order
            weights[p, : len(order)] = [row[n][0] for n in order]
            gradients[p, : len(order)] = [row[n][1] for n in order]
        kept = np.unique(pairs[:, 0]).astype(np.int64)
        return self._pruned(kept, shared, Weights(frames, weights, gradients).of(kept))

    def _row(self, p: int, neighbours: Ints, numbers: dict[Node, int]) -> Row:
        """How a point listens to the neighbours that are left."""
        found = self._shaped(p, self.origins[neighbours])
        listened = Weights(neighbours[found.frames], found.weights, found.gradients)
        return row_of(self.carriers, self.own, self.near, numbers, listened, 0, self.points[p])

    def _shaped(self, p: int, origins: Floats) -> Weights:
        """The weights of a point by the shape function, or Shepard's where the frames do not do."""
        if self._serves(origins):
            try:
                found = self._shape(self.shape, p, origins)
            except TissuError:  # nearly in one plane, or far outside of its frames
                pass
            else:
                if not self._complete or self._is_tame(p, found):
                    return found
        return self._shape("shepard", p, origins)

    def _is_tame(self, p: int, found: Weights) -> bool:
        """Whether the weights of a point are hardly steeper than those that it had at first."""
        first = self.listened.of(np.array([p]))
        return bool(found.steepness()[0] <= _STEEPEST * first.steepness()[0])

    @property
    def _complete(self) -> bool:
        """Whether the shape function promises to hold what is linear."""
        kinds = {name: complete for name, _, complete, _ in _core.shape_functions()}
        return kinds[self.shape] == "linear"

    def _serves(self, origins: Floats) -> bool:
        """Whether some frames are enough for the shape function to hold what it promises."""
        if not self._complete:
            return True
        if self.shape != "moving_least_squares":
            return False  # its simplex, or its cell of the grid, lacks a corner
        extents = np.linalg.svd(origins - origins.mean(axis=0), compute_uv=False)
        return len(origins) > 3 and bool(extents[-1] > _LEAST_SPAN * extents[0])

    def _shape(self, shape: str, p: int, origins: Floats) -> Weights:
        return Weights(
            *_core.shape_weights(
                name=shape,
                neighbours=len(origins),
                frames=np.ascontiguousarray(origins),
                points=self.points[p : p + 1],
                body=self.name,
            )
        )

    def _pruned(self, kept: NDArray[np.int64], shared: list[Node], weights: Weights) -> Left:
        """Only the nodes that points follow; entries that fill a row name a frame of the row."""
        counts = weights.listed()
        filling = weights.frames[np.arange(len(kept)), counts.argmax(axis=1)]
        frames = np.where(counts, weights.frames, filling[:, None])
        used = np.unique(frames[frames >= self.own])
        renumbered = np.arange(self.own + len(shared), dtype=np.int32)
        renumbered[used] = self.own + np.arange(len(used), dtype=np.int32)
        left = Weights(renumbered[frames], weights.weights, weights.gradients)
        return Left(kept, [shared[n - self.own] for n in used], left)

    def _keys(self, pairs: Pairs) -> NDArray[np.int64]:
        return np.asarray(pairs[:, 0].astype(np.int64) * len(self.origins) + pairs[:, 1])
