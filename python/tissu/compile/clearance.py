"""What surfaces that overlap ask of their nodes: to lie outside of each other by a margin."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from tissu.compile.closed_surface import Nearest, nearest_on, nearest_on_lines
from tissu.compile.prepared import Floats, Ints

if TYPE_CHECKING:
    from tissu.compile.contact import PreparedContact, PreparedPair

_REACH = 0.5
"""of the mean edge: so near, points may come to press"""
_ALONG = 8
"""samples along a free edge of an obstacle, as the axis of a capsule"""


class Asked(NamedTuple):
    """Inequalities `rows @ x >= bound` of all coordinates x [m]; their signed distances [m]."""

    rows: Any
    bound: Floats
    distance: Floats


class _Points(NamedTuple):
    """Points of a surface: means of its vertices (n, k) by weights (n, k), and half thicknesses."""

    vertices: Ints
    weights: Floats
    radius: Floats


class Clearance:
    """Finds points that lie in another surface, or near to it."""

    def __init__(self, contact: PreparedContact, core: Any) -> None:
        self._contact = contact
        self._core = core
        self._names = [*contact.bodies, *contact.obstacles]
        self._first = {name: core.body_range(name)[0] for name in contact.bodies}
        self._still = {
            name: core.obstacle_places(name=name, rest=one.surface.vertices)
            for name, one in contact.obstacles.items()
            if one.surface is not None
        }
        self._middles: dict[tuple[str, str], dict[tuple[int, int], float]] = {}

    def crossing(self) -> int:
        """How many places cross now; of an edge that pierces twice the middle will be asked."""
        found: dict[tuple[str, str, tuple[int, int]], list[float]] = {}
        crossings = self._core.crossings()
        for a, (tail, head), b, triangle in crossings:
            edge = (tail, head)
            of, other = self._names[a], self._names[b]
            if triangle[0] >= 0 and edge[1] >= 0:
                share = _pierced(self._places(of)[list(edge)], self._places(other)[list(triangle)])
                found.setdefault((of, other, edge), []).append(share)
        for (of, other, edge), shares in found.items():
            if len(shares) > 1:
                middles = self._middles.setdefault((of, other), {})
                middles.setdefault(edge, 0.5 * (min(shares) + max(shares)))
        return len(crossings)

    def asked(self, extra: float) -> Asked:
        """What is asked of all that overlaps or is near; `extra`: of the gap, on top of it."""
        from scipy.sparse import coo_array

        entries: list[tuple[Any, ...]] = []
        bounds: list[Floats] = []
        distances: list[Floats] = []
        count = 0
        coordinates = self._core.positions.size
        for pair in self._contact.pairs:
            if pair.a == pair.b or self._first.keys().isdisjoint((pair.a, pair.b)):
                continue  # obstacles are not moved
            for of, other in ((pair.a, pair.b), (pair.b, pair.a)):
                points = self._points(of, other, pair)
                if points is None:
                    continue
                made = self._rows(of, other, points, pair.gap)
                if made is None:
                    continue
                rows, columns, values, now, far, thick = made
                entries.append((rows + count, columns, values))
                bounds.append((1.0 + extra) * pair.gap + thick - far + now)
                distances.append(far - thick)
                count += len(far)
        if not count:
            empty = np.zeros(0)
            return Asked(coo_array((0, coordinates)).tocsr(), empty, empty)
        rows, columns, values = (np.concatenate(part) for part in zip(*entries, strict=True))
        matrix = coo_array((values, (rows, columns)), shape=(count, coordinates)).tocsr()
        return Asked(matrix, np.concatenate(bounds), np.concatenate(distances))

    def _places(self, name: str) -> Floats:
        if name not in self._first:
            return np.asarray(self._still[name])
        first, count = self._core.body_range(name)
        return np.asarray(self._core.positions[first : first + count])

    def _surface(self, name: str) -> Any:
        if name in self._first:
            return self._contact.bodies[name]
        return self._contact.obstacles[name].surface

    def _points(self, of: str, other: str, pair: PreparedPair) -> _Points | None:
        """What of a surface may lie in another: its vertices, edges that went through before."""
        surface = self._surface(of)
        if surface is None:
            return None
        nodes = surface.nodes
        if of == pair.a and len(pair.nodes):
            nodes = np.intersect1d(nodes, pair.nodes)
        first, second, shares = [nodes], [nodes], [np.zeros(len(nodes))]
        middles = self._middles.get((of, other), {})
        if middles:
            edges = np.array(list(middles))
            first.append(edges[:, 0])
            second.append(edges[:, 1])
            shares.append(np.array(list(middles.values())))
        for share in np.linspace(0.0, 1.0, _ALONG) if of not in self._first else ():
            first.append(surface.edges[:, 0])
            second.append(surface.edges[:, 1])
            shares.append(np.full(len(surface.edges), share))
        ends = np.column_stack([np.concatenate(first), np.concatenate(second)]).astype(np.int32)
        share = np.concatenate(shares)
        weights = np.column_stack([1.0 - share, share])
        thick = surface.radius
        radius = (weights * thick[ends]).sum(axis=1) if len(thick) else np.zeros(len(ends))
        return _Points(ends, weights, radius)

    def _rows(self, of: str, other: str, points: _Points, gap: float) -> Any:
        """Of points that are inside or near: rows, columns, values; their product now; distance."""
        places = np.einsum("nk,nkx->nx", points.weights, self._places(of)[points.vertices])
        surface = self._surface(other)
        edges = [s.mean_edge for s in (self._surface(of), surface) if s is not None]
        reach = max(_REACH * min((edge for edge in edges if edge > 0.0), default=0.0), 4.0 * gap)
        if surface is None:
            one = self._contact.obstacles[other]
            assert one.normal is not None  # a plane
            far = (places - one.origin) @ one.normal
            normal = np.broadcast_to(one.normal, places.shape)
            nothing = np.zeros((len(places), 0))
            nearest = Nearest(far, normal, nothing.astype(np.int32), nothing)
            thick = points.radius
            among = np.arange(len(places))
        else:
            there = self._places(other)
            on = there[surface.nodes]
            around = reach + (points.radius.max(initial=0.0) + surface.radius.max(initial=0.0))
            low, high = on.min(axis=0) - around, on.max(axis=0) + around
            among = np.flatnonzero(((places > low) & (places < high)).all(axis=1))
            if not len(among):
                return None
            thick = points.radius[among]
            if len(surface.triangles):
                closed = surface.closed
                nearest = nearest_on(there, surface.triangles, places[among], closed=closed)
                if len(surface.radius):
                    thick = thick + surface.radius[nearest.vertices].mean(axis=1)
            else:
                lines = np.concatenate([surface.edges, np.repeat(surface.points[:, None], 2, 1)])
                nearest = nearest_on_lines(there, lines, surface.radius, places[among])
        kept = np.flatnonzero(nearest.distance - thick < reach)
        if not len(kept):
            return None
        normal = nearest.normal[kept]
        parts = []
        if of in self._first:
            at = among[kept]
            parts.append((self._first[of], points.vertices[at], points.weights[at]))
        if other in self._first:
            parts.append((self._first[other], nearest.vertices[kept], -nearest.weights[kept]))
        rows, columns, values = [], [], []
        for first, vertices, weights in parts:
            value = weights[:, :, None] * normal[:, None, :]
            column = 3 * (first + vertices)[:, :, None] + np.arange(3)
            row = np.broadcast_to(np.arange(len(kept))[:, None, None], value.shape)
            rows.append(row.ravel())
            columns.append(np.broadcast_to(column, value.shape).ravel())
            values.append(value.ravel())
        row, column, value = (np.concatenate(x) for x in (rows, columns, values))
        now = np.bincount(row, value * self._core.positions.ravel()[column], len(kept))
        return row, column, value, now, nearest.distance[kept], thick[kept]


def _pierced(edge: Floats, triangle: Floats) -> float:
    """Share of an edge (2, 3) at which it goes through the plane of a triangle (3, 3)."""
    normal = np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])
    a, b = (edge - triangle[0]) @ normal
    return float(np.clip(a / (a - b), 0.0, 1.0)) if a != b else 0.5
