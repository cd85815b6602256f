"""Normals of a surface that are smooth but for creases."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

CREASE = np.cos(np.radians(55.0))  # sharper edges stay edges
CROWDED = 48  # a point with more triangles is smooth: comparing them in pairs would cost too much


def corner_normals(points: Array, triangles: Integers) -> Array:
    """Unit normals (t,3,3) at the corners of each triangle.

    The normal of a corner is the mean over the triangles around its point not sharper than the
    crease angle, weighted by area.
    """
    a, b, c = (points[triangles[:, k]] for k in range(3))
    weighted = np.cross(b - a, c - a)
    face = _unit(weighted)
    corner = triangles.ravel()
    owner = np.repeat(np.arange(len(triangles)), 3)
    mean = _sums(corner, weighted[owner], len(points))
    normal = mean[corner]
    crowd = np.bincount(corner, minlength=len(points))
    sharp = ((_unit(normal) * face[owner]).sum(axis=1) < CREASE**0.5) & (crowd[corner] <= CROWDED)
    creased = np.zeros(len(points), dtype=bool)
    creased[corner[sharp]] = True
    chosen = np.flatnonzero(creased[corner])
    normal[chosen] = _crease_normals(corner, owner, weighted, face, chosen, crowd)
    return _unit(normal).reshape(-1, 3, 3)


def _crease_normals(
    corner: Integers,
    owner: Integers,
    weighted: Array,
    face: Array,
    chosen: Integers,
    crowd: Integers,
) -> Array:
    """Normals (m,3) of the chosen corners from those triangles around them without a crease."""
    by_point = np.argsort(corner, kind="stable")
    start = np.cumsum(crowd) - crowd
    count = crowd[corner[chosen]]
    run = np.repeat(np.arange(len(chosen)), count)
    within = np.arange(len(run)) - (np.cumsum(count) - count)[run]
    other = owner[by_point[start[corner[chosen]][run] + within]]
    alike = (face[owner[chosen]][run] * face[other]).sum(axis=1) > CREASE
    share = weighted[other] * alike[:, None]
    return np.stack(
        [np.bincount(run, share[:, k], minlength=len(chosen)) for k in range(3)], axis=1
    )


def _unit(vectors: Array) -> Array:
    """Vectors (..., 3) at length one; those without length point to the viewer."""
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.asarray(
        np.where(length > 0, vectors / np.where(length > 0, length, 1.0), (0, 0, 1.0))
    )


def _sums(group: Integers, vectors: Array, count: int) -> Array:
    """Sums (count,3) of the vectors (m,3) of each group."""
    sums = [np.bincount(group, vectors[:, k], minlength=count) for k in range(3)]
    return np.stack(sums, axis=1).astype(np.float64, copy=False)
