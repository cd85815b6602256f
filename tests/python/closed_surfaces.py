"""Closed surfaces, and how far points are apart, for the tests of sampling."""

import numpy as np

import tissu as ts
from tissu import sampling as sp


def icosphere(level, radius=1.0, centre=(0.0, 0.0, 0.0)):
    """An icosahedron whose triangles are cut into four `level` times, corners on the sphere."""
    g = (1.0 + 5.0**0.5) / 2.0
    points = np.array([(0, i, j * g) for i in (-1, 1) for j in (-1, 1)], dtype=float)
    points = np.concatenate([np.roll(points, k, axis=1) for k in range(3)])
    near = np.linalg.norm(points[:, None] - points, axis=2) < 2.1
    rows = [(i, j, k) for i in range(12) for j in range(i) for k in range(j)]
    rows = np.array([r for r in rows if near[r[0], r[1]] and near[r[1], r[2]] and near[r[0], r[2]]])
    inwards = np.linalg.det(points[rows]) < 0
    rows[inwards] = rows[inwards][:, [0, 2, 1]]
    for _ in range(level):
        edges = np.sort(rows[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        ends, number = np.unique(edges, axis=0, return_inverse=True)
        m = number.reshape(-1, 3) + len(points)
        points = np.vstack([points, points[ends].mean(axis=1)])
        of = [rows[:, 0], m[:, 0], m[:, 2], rows[:, 1], m[:, 1], rows[:, 2]]
        parts = [(0, 1, 2), (1, 3, 4), (2, 4, 5), (1, 4, 2)]
        rows = np.concatenate([np.stack([of[i] for i in part], axis=1) for part in parts])
    return points / np.linalg.norm(points, axis=1)[:, None] * radius + centre, rows


def torus(big=1.0, small=0.4, around=48, across=24):
    i, j = np.divmod(np.arange(around * across), across)
    u, v = 2 * np.pi * i / around, 2 * np.pi * j / across
    ring = big + small * np.cos(v)
    points = np.stack([ring * np.cos(u), ring * np.sin(u), small * np.sin(v)], axis=1)
    after, up = (i + 1) % around * across, (j + 1) % across
    a, b, c, d = i * across + j, after + j, after + up, i * across + up
    return points, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def box(size=(0.4, 0.2, 0.1), cells=(4, 2, 1), origin=(0.0, 0.0, 0.0)):
    return sp.Surface.of(ts.bar_mesh(size=size, cells=cells, origin=origin))


def l_shape():
    """Three cubes of side 1: the middle one at the origin, one along x, one along y."""
    cubes = ts.bar_mesh(size=(2, 2, 1), cells=(2, 2, 1), cell="hexahedron")
    block = ts.CellBlock("hexahedron", cubes.cells[0].nodes[[0, 1, 2]])
    return sp.Surface.of(ts.Mesh(points=cubes.points, cells=(block,)))


SURFACES = {
    "box": box,
    "sphere": lambda: sp.Surface(*icosphere(3)),
    "torus": lambda: sp.Surface(*torus()),
    "l_shape": l_shape,
    "organ": lambda: sp.Surface.of(ts.read_mesh("examples/organ.vtu")),
}


def scattered(surface, count, seed=1, margin=0.1):
    low, high = surface.bounds
    wider = margin * (high - low)
    return np.random.default_rng(seed).uniform(low - wider, high + wider, (count, 3))


def smallest_gap(points):
    away = np.linalg.norm(points[:, None] - points, axis=2)
    return away[~np.eye(len(points), dtype=bool)].min(initial=np.inf)


def to_nearest(places, points):
    parts = np.array_split(places, 50)
    return np.concatenate([np.linalg.norm(p[:, None] - points, axis=2).min(axis=1) for p in parts])
