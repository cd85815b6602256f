"""How near two bodies are, or how deep one is in the other."""

from __future__ import annotations

import numpy as np

from tissu.mesh.cell import Floats
from tissu.sampling.nearest import TriangleTree
from tissu.sampling.surface import Surface

_ALONG = 16  # places on an edge that may cross the other body
_TOUCHING = 1e-6  # of the smaller body's diagonal: less deep is a touch
_STARTS = 64


def overlap(a: Surface, b: Surface) -> float:
    """Greatest depth [m] seen of the edges of one body in the other; 0 when they only touch.

    Edges are looked at in 16 places each, so that a corner that pierces less may be missed.
    """
    if (np.maximum(a.bounds[0], b.bounds[0]) > np.minimum(a.bounds[1], b.bounds[1])).any():
        return 0.0
    deep = max(_depth(a, b), _depth(b, a))
    sizes = (np.linalg.norm(np.ptp(s.bounds, axis=0)) for s in (a, b))
    return deep if deep > _TOUCHING * min(sizes) else 0.0


def _depth(a: Surface, b: Surface) -> float:
    """How deep the edges of `a` are in `b` [m]."""
    ends = np.sort(a.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges = a.points[np.unique(ends, axis=0)]
    low, high = edges.min(axis=1), edges.max(axis=1)
    edges = edges[((low <= b.bounds[1]) & (high >= b.bounds[0])).all(axis=1)]
    t = np.linspace(0.0, 1.0, _ALONG)[:, None]
    places = (edges[:, None, 0] * (1.0 - t) + edges[:, None, 1] * t).reshape(-1, 3)
    places = places[b.inside(places)]
    return float(b.distance(places).max(initial=0.0))


def gap(a: TriangleTree, b: TriangleTree) -> tuple[Floats, Floats]:
    """Two points (3,) [m], one of each, as near as found.

    From the nearest corners on, each point goes to the one nearest to the other until they rest.
    """
    on_a = np.concatenate([a.nodes, a.nearest(b.nodes)[0]])
    away = b.nearest(on_a)[1]
    on_a = on_a[np.argsort(away, kind="stable")[:_STARTS]]
    last = np.inf
    for _ in range(200):
        on_b, away = b.nearest(on_a)
        best = int(np.argmin(away))
        if not away[best] < last * (1.0 - 1e-9):
            break
        last = float(away[best])
        on_a = a.nearest(on_b)[0]
    return on_a[best], on_b[best]
