"""Where material is pulled too much: the largest principal stress, averaged over a length.

Rankine's criterion with a non-local stress, so that it does not follow the mesh.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_AT_ONCE = 1000
"""points whose neighbours are listed together"""


@dataclass(frozen=True, slots=True, eq=False)
class Overstress:
    """A place that tears.

    Attributes:
        place: center of the most stressed cell of those over which the mean is taken (3,) [m].
        normal: direction of the largest principal stress (3,), of length one.
        ratio: that stress over the strength.
    """

    place: Floats
    normal: Floats
    ratio: float


def overstressed(
    centres: Floats,
    stress: Floats,
    volumes: Floats,
    *,
    strength: float,
    length: float,
    apart: float,
    most: int,
) -> list[Overstress]:
    """The most overstressed places, the worst first; of equal ones the lowest number.

    Args:
        centres: of the cells now (m, 3) [m].
        stress: Cauchy stress of the cells (m, 3, 3) [Pa].
        volumes: of their material (m,) [m3].
        strength: largest principal stress that the material bears [Pa].
        length: the stress is a mean over the cells no farther away [m].
        apart: no two places are nearer [m].
        most: number of places at most.
    """
    # The largest eigenvalue is below the norm, and that of a mean below the largest of its terms.
    known: NDArray[np.bool_] = np.asarray(np.isfinite(stress.reshape(-1, 9)).all(axis=1))
    finite = np.where(known[:, None], stress.reshape(-1, 9), 0.0)
    large = np.flatnonzero(np.linalg.norm(finite, axis=1) > strength)
    own = np.zeros(len(stress))
    own[large] = np.linalg.eigvalsh(finite[large].reshape(-1, 3, 3))[:, 2]
    high = np.flatnonzero(own > strength)
    if not len(high):
        return []
    near = Near(centres, length)
    candidates = np.unique(np.concatenate([other for _, other in near.pairs(high)]))
    weights = np.where(known, volumes, 0.0)
    mean = np.concatenate(
        [_means(first, other, weights, finite) for first, other in near.pairs(candidates)]
    )
    values, vectors = np.linalg.eigh(mean)
    ratios = values[:, 2] / strength
    chosen: list[Overstress] = []
    for i in np.lexsort((candidates, -ratios)):
        if ratios[i] <= 1.0 or len(chosen) == most:
            break
        ((_, around),) = near.pairs(candidates[i : i + 1])
        place = centres[np.sort(around)[np.argmax(own[np.sort(around)])]]
        if all(np.linalg.norm(place - other.place) >= apart for other in chosen):
            normal = vectors[i, :, 2]
            normal = normal * np.sign(normal[np.argmax(np.abs(normal))])
            chosen.append(Overstress(place, normal, float(ratios[i])))
    return chosen


def _means(first: Ints, other: Ints, weights: Floats, values: Floats) -> Floats:
    """Weighted means (k, 3, 3) of values (m, 9) over pairs, for each first of them."""
    weight, count = weights[other], int(first.max()) + 1
    total = np.maximum(np.bincount(first, weight, count), 1e-300)
    sums = [np.bincount(first, weight * values[other, i], count) for i in range(9)]
    return np.asarray((np.stack(sums, axis=1) / total[:, None]).reshape(-1, 3, 3))


class Near:
    """Points in boxes as large as a length, so that pairs no farther apart are found at once."""

    def __init__(self, points: Floats, length: float) -> None:
        """Sort points (m, 3) into boxes [m]."""
        self._points, self._length = points, length
        self._boxes = np.floor((points - points.min(axis=0)) / length).astype(np.int64) + 1
        self._shape = tuple(int(n) + 2 for n in self._boxes.max(axis=0))
        keys = np.ravel_multi_index(tuple(self._boxes.T), self._shape)
        self._order = np.argsort(keys, kind="stable")
        self._keys = keys[self._order]

    def pairs(self, chosen: Ints) -> Iterator[tuple[Ints, Ints]]:
        """Pairs of some points with all that are near them, themselves too, part by part.

        Yields:
            Place of the first in this part of `chosen`, and number of the other.
        """
        for begin in range(0, len(chosen), _AT_ONCE):
            yield self._pairs(chosen[begin : begin + _AT_ONCE])

    def _pairs(self, chosen: Ints) -> tuple[Ints, Ints]:
        firsts, others = [], []
        for offset in itertools.product((-1, 0, 1), repeat=3):
            boxes = self._boxes[chosen] + np.array(offset)
            wanted = np.ravel_multi_index(tuple(boxes.T), self._shape)
            begin = np.searchsorted(self._keys, wanted, side="left")
            counts = np.searchsorted(self._keys, wanted, side="right") - begin
            place = np.repeat(np.arange(len(chosen)), counts)
            within = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
            other = self._order[np.repeat(begin, counts) + within]
            apart = self._points[other] - self._points[chosen[place]]
            near = np.einsum("pi,pi->p", apart, apart) <= self._length**2
            firsts.append(place[near])
            others.append(other[near])
        return np.concatenate(firsts), np.concatenate(others)


def front_of(triangles: Ints, cut: NDArray[np.bool_], rest: Floats) -> Ints:
    """Where the two sides of a cut meet inside the material.

    Args:
        triangles: of the surface of the material (t, 3).
        cut: which of them a cut opened (t,).
        rest: places of its points at rest (v, 3) [m], where both sides of a cut coincide.

    Returns:
        For each edge of a front (k, 4) its two ends, in the order of the first side's triangle,
        and the third corners of the triangles of both sides.
    """
    opened = triangles[cut]
    corners = rest[opened]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    turned = [opened[:, [i, (i + 1) % 3, (i + 2) % 3]] for i in range(3)]
    sides = np.concatenate(turned)
    of = np.tile(np.arange(len(opened)), 3)
    low, high = sides[:, :2].min(axis=1), sides[:, :2].max(axis=1)
    order = np.lexsort((of, high, low))
    sides, of, low, high = sides[order], of[order], low[order], high[order]
    same = (low[1:] == low[:-1]) & (high[1:] == high[:-1])
    facing = np.einsum("ti,ti->t", normals[of[1:]], normals[of[:-1]]) < _FACING
    first = np.flatnonzero(same & facing)
    return np.column_stack([sides[first], sides[first + 1, 2]]).astype(np.int64)


def front_of_sheet(triangles: Ints, rest: Floats) -> Ints:
    """Where the two sides of a cut of a sheet meet.

    Args:
        triangles: of the material (t, 3).
        rest: places of its points at rest (v, 3) [m], where both sides of a cut coincide.

    Returns:
        Each point of a front, and the two points beside it on both sides of the cut (k, 3).
    """
    sides = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    _, first, counts = np.unique(
        np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True
    )
    border = sides[first[counts == 1]]
    _, places = np.unique(rest, axis=0, return_inverse=True)
    ends = np.concatenate([border, border[:, ::-1]])
    place = places.reshape(-1)[ends[:, 1]]
    order = np.lexsort((ends[:, 1], place, ends[:, 0]))
    ends, place = ends[order], place[order]
    twins = (ends[1:, 0] == ends[:-1, 0]) & (place[1:] == place[:-1])
    at = np.flatnonzero(twins)
    return np.column_stack([ends[at], ends[at + 1, 1]]).astype(np.int64)


_FACING = -0.9
"""Cosine between the normals of two sides of a cut at its front, at rest."""
