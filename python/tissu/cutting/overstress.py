"""Where material is pulled too much: the largest principal stress, averaged over a length.

Rankine's criterion with a non-local stress, so that it does not follow the mesh.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Overstress:
    """A place that tears.

    Attributes:
        place: (3,) [m].
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
    size = np.linalg.norm(finite, axis=1)
    if not (size > strength).any():
        return []
    high = np.flatnonzero(size > strength)
    candidates = np.unique(_pairs(centres, high, length)[1])
    first, second = _pairs(centres, candidates, length)
    weight = np.where(known, volumes, 0.0)[second]
    total = np.bincount(first, weight, len(candidates))
    sums = [np.bincount(first, weight * finite[second, i], len(candidates)) for i in range(9)]
    mean = (np.stack(sums, axis=1) / np.maximum(total, 1e-300)[:, None]).reshape(-1, 3, 3)
    values, vectors = np.linalg.eigh(mean)
    ratios = values[:, 2] / strength
    chosen: list[Overstress] = []
    for i in np.lexsort((candidates, -ratios)):
        if ratios[i] <= 1.0 or len(chosen) == most:
            break
        place = centres[candidates[i]]
        if all(np.linalg.norm(place - other.place) >= apart for other in chosen):
            normal = vectors[i, :, 2]
            normal = normal * np.sign(normal[np.argmax(np.abs(normal))])
            chosen.append(Overstress(place, normal, float(ratios[i])))
    return chosen


def _pairs(centres: Floats, chosen: Ints, length: float) -> tuple[Ints, Ints]:
    """Pairs of points no farther apart: places in `chosen`, numbers of the others."""
    bins = np.floor((centres - centres.min(axis=0)) / length).astype(np.int64) + 1
    shape = bins.max(axis=0) + 2
    keys = np.ravel_multi_index(tuple(bins.T), tuple(shape))
    order = np.argsort(keys, kind="stable")
    ordered = keys[order]
    firsts, seconds = [], []
    for offset in itertools.product((-1, 0, 1), repeat=3):
        wanted = np.ravel_multi_index(tuple((bins[chosen] + np.array(offset)).T), tuple(shape))
        begin = np.searchsorted(ordered, wanted, side="left")
        counts = np.searchsorted(ordered, wanted, side="right") - begin
        firsts.append(np.repeat(np.arange(len(chosen)), counts))
        within = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
        seconds.append(order[np.repeat(begin, counts) + within])
    first, second = np.concatenate(firsts), np.concatenate(seconds)
    near = np.linalg.norm(centres[second] - centres[chosen[first]], axis=1) <= length
    return first[near], second[near]


def front_of(triangles: Ints, cut: NDArray[np.bool_], rest: Floats) -> Ints:
    """The edges (k, 2) where the two sides of a cut meet inside the material.

    Args:
        triangles: of the surface of the material (t, 3).
        cut: which of them a cut opened (t,).
        rest: places of its points at rest (v, 3) [m], where both sides of a cut coincide.
    """
    opened = triangles[cut]
    if not len(opened):
        return np.empty((0, 2), dtype=np.int64)
    corners = rest[opened]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    sides = np.sort(np.concatenate([opened[:, [0, 1]], opened[:, [1, 2]], opened[:, [2, 0]]]))
    of = np.tile(np.arange(len(opened)), 3)
    order = np.lexsort((of, sides[:, 1], sides[:, 0]))
    sides, of = sides[order], of[order]
    same = (sides[1:] == sides[:-1]).all(axis=1)
    facing = np.einsum("ti,ti->t", normals[of[1:]], normals[of[:-1]]) < _FACING
    return np.asarray(sides[1:][same & facing], dtype=np.int64)


_FACING = -0.9
"""Cosine between the normals of two sides of a cut at its front, at rest."""
