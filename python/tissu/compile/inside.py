"""Surfaces that lie inside a closed one at rest without crossing it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from tissu.compile.contact import PreparedContact
    from tissu.compile.contact_surface import ContactSurface
    from tissu.compile.prepared import Floats, Ints

_INSIDE = 0.75
"""Winding numbers are whole but for round-off; on the surface itself they are a half."""


def nested(contact: PreparedContact) -> Iterator[tuple[str, str]]:
    """Names of surfaces that lie inside another one that they meet, each before that other one."""
    surfaces = dict(contact.bodies)
    surfaces |= {name: one.surface for name, one in contact.obstacles.items() if one.surface}
    pushed_apart = contact.settings.overlap == "separate"  # what crosses at rest no longer does
    for a, b in dict.fromkeys((pair.a, pair.b) for pair in contact.pairs):
        if a == b or a not in surfaces or b not in surfaces:
            continue
        for inner, outer in ((a, b), (b, a)):
            if (
                len(surfaces[outer].triangles)
                and surfaces[outer].closed
                and not (pushed_apart and _stands_out(surfaces[inner], surfaces[outer]))
                and _any_inside(surfaces[inner], surfaces[outer])
            ):
                yield inner, outer


def _any_inside(inner: ContactSurface, outer: ContactSurface) -> bool:
    """Whether a part of one lies inside the other; crossing surfaces are refused elsewhere."""
    corners = outer.vertices[outer.triangles]
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    points = inner.vertices[_one_of_each_part(inner)]
    boxed = points[((points > low) & (points < high)).all(axis=1)]
    return any(winding_number(point, corners) > _INSIDE for point in boxed)


def _stands_out(inner: ContactSurface, outer: ContactSurface) -> bool:
    """Whether a part of one reaches out of the box around the other."""
    low, high = outer.vertices.min(axis=0), outer.vertices.max(axis=0)
    return bool(
        (inner.vertices.min(axis=0) < low).any() or (inner.vertices.max(axis=0) > high).any()
    )


def winding_number(point: Floats, corners: Floats) -> float:
    """How often triangles (t, 3, 3) go round a point (3,): 1 inside a closed surface, 0 outside.

    The sum of their solid angles over that of the sphere (van Oosterom and Strackee 1983, IEEE
    Transactions on Biomedical Engineering 30, 125-126).
    """
    a, b, c = (corners - point).swapaxes(0, 1)
    la, lb, lc = (np.linalg.norm(side, axis=1) for side in (a, b, c))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c))
    ab, bc, ca = (np.einsum("ij,ij->i", p, q) for p, q in ((a, b), (b, c), (c, a)))
    angles = 2.0 * np.arctan2(volume, la * lb * lc + ab * lc + bc * la + ca * lb)
    return float(angles.sum() / (4.0 * np.pi))


def _one_of_each_part(surface: ContactSurface) -> Ints:
    """A vertex of each connected part of a surface."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    pairs = np.concatenate(
        [surface.triangles[:, [0, 1]], surface.triangles[:, [1, 2]], surface.edges]
    )
    count = len(surface.vertices)
    joined = coo_matrix((np.ones(len(pairs), dtype=bool), (pairs[:, 0], pairs[:, 1])), (count,) * 2)
    label = connected_components(joined, directed=False)[1]
    nodes = surface.nodes
    return np.asarray(nodes[np.unique(label[nodes], return_index=True)[1]])
