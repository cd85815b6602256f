"""Bodies whose cells a cut divides, and what must hold of them, for the tests of such cuts."""

from __future__ import annotations

from collections import Counter
from itertools import combinations
from typing import Any

import numpy as np

import tissu as ts

Array = np.ndarray[Any, Any]

DENSITY = 1000.0
SIZE = (0.4, 0.1, 0.1)
HELD = ts.Plane(point=(0, 0, 0), normal=(1, 0, 0))
SLANTED = ts.Plane(point=(0.213, 0.05, 0.05), normal=(1.0, 0.31, -0.27))
EXACT = ts.ImplicitEuler(dt=0.005, solver=ts.ConjugateGradient(tolerance=1e-13))
PAIRS = tuple(combinations(range(4), 2))


def jittered(cells: tuple[int, int, int], seed: int, size: tuple[float, ...] = SIZE) -> ts.Mesh:
    """A bar of tetrahedra, whose inner nodes are moved by up to an eighth of a cell."""
    mesh = ts.bar_mesh(size=size, cells=cells, cell="tetra")
    step = np.array(size) / cells
    points = np.array(mesh.points)
    inner = ((points > 1e-9) & (points < np.array(size) - 1e-9)).all(axis=1)
    random = np.random.default_rng(seed)
    points[inner] += step / 8 * random.uniform(-1, 1, (int(inner.sum()), 3))
    return ts.Mesh(points=points, cells=mesh.cells)


def bar(cells: tuple[int, int, int] = (4, 2, 2), mesh: Any = None, **body: Any) -> ts.Body:
    return ts.Body(
        mesh=ts.bar_mesh(size=SIZE, cells=cells, cell="tetra") if mesh is None else mesh,
        **{"law": ts.StableNeoHooke(young=5e4, poisson=0.3), "density": DENSITY} | body,
    )


def scene(body: ts.Body | None = None, **changes: Any) -> ts.Scene:
    return ts.Scene(
        **{
            "bodies": {"bar": bar() if body is None else body},
            "fixed": [ts.Fixed("bar", on=HELD)],
            "gravity": (0.0, 0.0, -9.81),
            "step": ts.ImplicitEuler(dt=0.005),
            "editing": ts.Editing(method="subdivide", room="900 %"),
        }
        | changes
    )


def tetrahedra(simulation: ts.Simulation) -> Array:
    """The nodes of the cells, in the order of their numbers."""
    return np.concatenate([block.nodes for block in simulation.meshes["bar"].body_blocks])


def volumes(points: Array, cells: Array) -> Array:
    edges = points[cells[:, 1:]] - points[cells[:, :1]]
    return np.asarray(np.linalg.det(edges) / 6.0)


def qualities(points: Array, cells: Array) -> Array:
    """6 sqrt(2) V / l_rms^3."""
    squares = sum(((points[cells[:, a]] - points[cells[:, b]]) ** 2).sum(axis=1) for a, b in PAIRS)
    return np.asarray(6 * np.sqrt(2) * volumes(points, cells) / (squares / 6) ** 1.5)


def gradients(simulation: ts.Simulation) -> Array:
    """F of each cell."""
    cells, X = tetrahedra(simulation), simulation.meshes["bar"].points
    x = simulation.positions["bar"]
    at_rest = X[cells[:, 1:]] - X[cells[:, :1]]
    now = x[cells[:, 1:]] - x[cells[:, :1]]
    return np.asarray(np.swapaxes(np.linalg.solve(at_rest, now), 1, 2))


def spread(values: Array, cells: Array, weights: Array) -> float:
    """Sum over cells of a weight times sum_{a<b} |value_b - value_a|^2."""
    of_pairs = [((values[cells[:, a]] - values[cells[:, b]]) ** 2).sum(axis=1) for a, b in PAIRS]
    return float((weights * sum(of_pairs)).sum())


def fault_of_mesh(simulation: ts.Simulation) -> str:
    """Why the cells are not a conforming mesh of their volume; empty: they are."""
    cells, points = tetrahedra(simulation), simulation.meshes["bar"].points
    if not (volumes(points, cells) > 0.0).all():
        return "a cell has no volume above zero"
    faces = np.sort(np.concatenate([np.delete(cells, i, axis=1) for i in range(4)]), axis=1)
    if max(Counter(map(tuple, faces)).values()) > 2:
        return "more than two cells share a face"
    surface = simulation.surface("bar")
    flat = surface.triangles
    edges = Counter(map(tuple, np.concatenate([flat[:, [0, 1]], flat[:, [1, 2]], flat[:, [2, 0]]])))
    if any(edges[(b, a)] != count for (a, b), count in edges.items()):
        return "the surface is not closed"
    corners = surface.points[flat]
    enclosed = np.linalg.det(corners).sum() / 6.0
    now = volumes(simulation.positions["bar"], cells).sum()
    if abs(enclosed - now) > 1e-11 * abs(now) + 1e-15:
        return f"the surface encloses {enclosed}, and the cells have {now}"
    return ""


def pieces_by_faces(simulation: ts.Simulation) -> int:
    """How many parts faces join the cells to."""
    cells = tetrahedra(simulation)
    parent = list(range(len(cells)))

    def first(i: int) -> int:
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    owner: dict[tuple[int, ...], int] = {}
    for i in range(4):
        for cell, face in enumerate(map(tuple, np.sort(np.delete(cells, i, axis=1), axis=1))):
            other = owner.setdefault(face, cell)
            parent[first(cell)] = first(other)
    return len({first(i) for i in range(len(cells))})
