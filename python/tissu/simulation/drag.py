"""The point of a body that is nearest to a place, and how stiff a spring drags it by."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.simulation.grab_point import GrabPoint

if TYPE_CHECKING:
    from tissu.cutting.material import MaterialSurface
    from tissu.front import Scene
    from tissu.mesh import Mesh

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_UNKNOWN = 20.0
"""Stiffness [N/m] where nothing is known of the law."""


def near_surface(mesh: Mesh, places: Floats, point: Floats) -> GrabPoint:
    """The point of the surface that is nearest, by the corners of its triangle.

    Args:
        mesh: of the body.
        places: of its nodes (n, 3) [m].
        point: (3,) [m].
    """
    triangles = np.asarray(mesh.surface().triangles, dtype=np.int64)
    if not len(triangles):
        nodes = used_nodes(mesh)
        return GrabPoint(nodes[[_nearest(places[nodes], point)]], np.ones(1))
    return GrabPoint(*_on_triangle(triangles, places, point))


def near_material(surface: MaterialSurface, point: Floats) -> GrabPoint:
    """The same of the surface of material that cuts have parted, by the nodes that carry it.

    Without triangles it is the point of a piece of a line that is nearest.
    """
    vertices, of_vertices = _on_triangle(_pieces(surface), surface.points, point)
    carrying = surface.weights[vertices] * of_vertices[:, None]
    nodes = np.unique(surface.nodes[vertices][carrying != 0.0]).astype(np.int64)
    weights = [carrying[surface.nodes[vertices] == node].sum() for node in nodes]
    return GrabPoint(nodes, np.array(weights))


def frames_at(surface: MaterialSurface, point: Floats) -> Ints:
    """The frames of the cell whose material is nearest to a point that have material themselves.

    Of a piece between nodes, which all are outside of it, those that carry its nearest point.
    """
    pieces = _pieces(surface)
    nearest, _ = _nearest_triangle(pieces, surface.points, point)
    cells = surface.cell if len(surface.triangles) else surface.line_cell
    at_node = (surface.weights[:, 0] == 1.0) & (surface.weights[:, 1:] == 0.0).all(axis=1)
    for some in (pieces[nearest], pieces[cells == cells[nearest]]):
        vertices = np.unique(some)
        own = surface.nodes[vertices[at_node[vertices]], 0]
        if len(own):
            return np.unique(own).astype(np.int64)
    return near_material(surface, point).nodes


def _pieces(surface: MaterialSurface) -> Ints:
    """The triangles of a surface; without any its lines, as triangles without area."""
    if len(surface.triangles):
        return np.asarray(surface.triangles, dtype=np.int64)
    return np.asarray(surface.lines[:, [0, 1, 1]], dtype=np.int64)


def near_frame(places: Floats, rotations: Floats, point: Floats, among: Ints) -> GrabPoint:
    """The nearest frame, with the offset of the point in its axes.

    Args:
        places: of the frames (n, 3) [m].
        rotations: of the frames (n, 3, 3) from rest.
        point: (3,) [m].
        among: numbers of the frames that may be taken.
    """
    node = int(among[_nearest(places[among], point)])
    return GrabPoint(
        np.array([node]), np.ones(1), np.asarray(rotations[node].T @ (point - places[node]))
    )


def used_nodes(mesh: Mesh) -> Ints:
    """Numbers of the nodes that have cells; of a mesh without cells all."""
    if not mesh.body_blocks:
        return np.arange(mesh.node_count)
    return np.unique(np.concatenate([block.nodes.ravel() for block in mesh.body_blocks]))


def _on_triangle(triangles: Ints, places: Floats, point: Floats) -> tuple[Ints, Floats]:
    """The corners of the triangle that is nearest to a point, and their weights there."""
    nearest, weights = _nearest_triangle(triangles, places, point)
    used = np.flatnonzero(weights)
    return triangles[nearest][used], weights[used]


def _nearest_triangle(triangles: Ints, places: Floats, point: Floats) -> tuple[int, Floats]:
    """Which triangle is nearest to a point, and the weights of its corners there (3,)."""
    weights = shares(places[triangles], point)
    apart = np.linalg.norm(np.einsum("tk,tki->ti", weights, places[triangles]) - point, axis=1)
    nearest = int(apart.argmin())
    return nearest, weights[nearest]


def _nearest(places: Floats, point: Floats) -> int:
    return int(np.linalg.norm(places - point, axis=1).argmin())


def shares(corners: Floats, point: Floats) -> Floats:
    """Weights (t, 3) of the corners (t, 3, 3) of triangles at their points nearest to a point.

    Inside, those of its projection; where that is outside, those of the nearest point of a side.
    """
    a, b, c = corners.swapaxes(0, 1)
    found = _projected(b - a, c - a, point - a)
    best = np.full(len(corners), np.inf)
    outside = ~(found >= 0.0).all(axis=1)
    for first, second in ((0, 1), (1, 2), (2, 0)):
        start, along = corners[:, first], corners[:, second] - corners[:, first]
        length = np.maximum(np.einsum("ti,ti->t", along, along), 1e-300)
        share = np.clip(np.einsum("ti,ti->t", point - start, along) / length, 0.0, 1.0)
        apart = np.linalg.norm(start + share[:, None] * along - point, axis=1)
        nearer = outside & (apart < best)
        best = np.where(nearer, apart, best)
        of_side = np.zeros((len(corners), 3))
        of_side[:, first], of_side[:, second] = 1.0 - share, share
        found = np.where(nearer[:, None], of_side, found)
    return found


def _projected(u: Floats, v: Floats, w: Floats) -> Floats:
    """Weights (t, 3) of the projection of w on the plane of u and v; negative outside."""
    uu, uv, vv = (np.einsum("ti,ti->t", x, y) for x, y in ((u, u), (u, v), (v, v)))
    wu, wv = np.einsum("ti,ti->t", w, u), np.einsum("ti,ti->t", w, v)
    area = uu * vv - uv * uv
    flat = area <= 1e-14 * uu * vv  # a triangle without area: a side is nearest
    area = np.where(flat, 1.0, area)
    second, third = (vv * wu - uv * wv) / area, (uu * wv - uv * wu) / area
    weights = np.stack([1.0 - second - third, second, third], axis=1)
    return np.where(flat[:, None], -1.0, weights)


def drag_stiffness(scene: Scene, body: str, mesh: Mesh) -> float:
    """E times the mean length of the surface's edges [N/m], E of the stiffest law of the body."""
    tissue = scene.tissue.get(body)
    laws = [tissue.law] if tissue is not None else list(scene.bodies[body].laws().values())
    moduli = [lame_young(*law.small_strain()) for law in laws if type(law).made is None]
    if not moduli:
        return _UNKNOWN
    triangles = mesh.surface().triangles
    if len(triangles):
        a, b, c = (mesh.points[triangles[:, k]] for k in range(3))
        length = float(
            np.mean([np.linalg.norm(x - y, axis=1) for x, y in ((a, b), (b, c), (c, a))])
        )
    else:
        size = np.prod(np.maximum(np.ptp(mesh.points, axis=0), 1e-9)) / mesh.node_count
        length = float(size) ** (1.0 / 3.0)
    return max(moduli) * length


def lame_young(lame: float, mu: float) -> float:
    """Young's modulus [Pa] of Lame's numbers."""
    return mu * (3.0 * lame + 2.0 * mu) / (lame + mu)
