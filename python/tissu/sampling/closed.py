"""Whether triangles close: every edge run along as often one way as the other."""

from __future__ import annotations

import numpy as np

from tissu.counted import counted
from tissu.errors import MeshError
from tissu.mesh.cell import Floats, Ints
from tissu.mesh.surface import enclosed_volume
from tissu.sampling.region import Indices


def require_triangles(points: Floats, triangles: Ints) -> None:
    """Refuses arrays that are not triangles.

    Raises:
        MeshError: wrong shapes, no triangle, numbers of no point, or positions not finite.
    """
    if points.ndim != 2 or points.shape[1] != 3:
        raise MeshError(f"found points of shape {points.shape}; an array (n, 3) is accepted")
    if triangles.ndim != 2 or triangles.shape[1] != 3 or not len(triangles):
        raise MeshError(
            f"found triangles of shape {triangles.shape}; an array (t, 3) of at least one "
            "triangle is accepted"
        )
    low, high = int(triangles.min()), int(triangles.max())
    if low < 0 or high >= len(points):
        raise MeshError(
            f"found triangles with the nodes {low} to {high}; numbers from 0 to "
            f"{len(points) - 1} are accepted"
        )
    wrong = np.unique(triangles[~np.isfinite(points[triangles]).all(axis=2)])
    if len(wrong):
        raise MeshError(
            f"found {counted(len(wrong), 'node')} whose position is not finite (first: "
            f"{wrong[0]}); finite numbers are accepted: repair the surface"
        )


def require_closed(points: Floats, triangles: Ints) -> None:
    """Refuses triangles that do not enclose a volume seen from outside.

    Raises:
        MeshError: open edges, edges whose triangles are wound against each other, or a surface
            wound inwards.
    """
    edges, count, sense = _edges(triangles)
    open_edges = np.flatnonzero(count % 2 == 1)
    if len(open_edges):
        a, b = edges[open_edges[0]]
        raise MeshError(
            f"found {counted(len(open_edges), 'open edge')} of {len(edges)} (first: between the "
            f"nodes {a} and {b}); a closed surface is accepted: fill the holes, or merge nodes "
            "that coincide"
        )
    against = np.flatnonzero(sense != 0)
    if len(against):
        a, b = edges[against[0]]
        raise MeshError(
            f"found {counted(len(against), 'edge')} of {len(edges)} whose triangles are wound "
            f"against each other (first: between the nodes {a} and {b}); triangles that are all "
            "anticlockwise seen from outside are accepted: turn those that are not"
        )
    volume, size = enclosed_volume(points, triangles), np.ptp(points[triangles], axis=(0, 1))
    if volume <= 1e-12 * float(np.linalg.norm(size)) ** 3:
        what, remedy = "that is flat", "take one that encloses something"
        if volume < 0.0:
            what = "wound inwards"
            remedy = (
                "reverse the nodes of each, ts.Mesh(points=mesh.points, "
                "cells=[(block.type, block.nodes[:, ::-1]) for block in mesh.cells])"
            )
        raise MeshError(
            f"found a surface {what} (its volume is {volume:.3g} m3); triangles that are "
            f"anticlockwise seen from outside around a volume are accepted: {remedy}"
        )


def _edges(triangles: Ints) -> tuple[Indices, Indices, Indices]:
    """Edges (e, 2), smaller number first; triangles at each; excess of one sense of running."""
    ends = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).astype(np.int64)
    base = int(ends.max()) + 1
    key = ends.min(axis=1) * base + ends.max(axis=1)
    found, number, count = np.unique(key, return_inverse=True, return_counts=True)
    ascending = np.where(ends[:, 0] < ends[:, 1], 1, -1)
    sense = np.bincount(number, weights=ascending, minlength=len(found)).astype(np.int64)
    return np.stack([found // base, found % base], axis=1), count.astype(np.int64), sense
