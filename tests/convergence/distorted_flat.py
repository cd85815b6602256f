"""Meshes of the unit square in z = 0 and of the unit line along x, regular and distorted.

As those of the cube in `distorted`: the boundary stays where it is, trapezoids are for surfaces.
"""

import numpy as np

import tissu as ts
from distorted import moved
from shape_basis import CORNERS, DIMENSION, family, reference_nodes, shapes


def regular(cell, n):
    d = DIMENSION[family(cell)]
    ones = np.arange(3) < d
    return ts.bar_mesh(size=1.0 * ones, cells=n * ones, cell=cell)


def smooth(cell, n):
    """Every node moved by one map: curved edges, and middle nodes that are not in the middle."""
    mesh, d = regular(cell, n), DIMENSION[family(cell)]
    across = np.sin(np.pi * mesh.points[:, 1:d]).prod(axis=1)
    s, t = (np.sin(k * np.pi * mesh.points[:, 0]) * across for k in (1, 2))
    shift = np.stack([0.06 * s + 0.03 * t, 0.03 * t - 0.05 * s, 0 * s], axis=1)
    return moved(mesh, shift * (np.arange(3) < d))


def jittered(cell, n):
    """Corners moved at random by up to a fifth of a cell, on edges along them; edges straight."""
    mesh = regular(cell, n)
    free = (mesh.points > 1e-9) & (mesh.points < 1 - 1e-9)
    random = np.random.default_rng(7).uniform(-1, 1, mesh.points.shape)
    return straightened(moved(mesh, 0.2 / n * random * free), cell)


def trapezoids(cell, n):
    """Lines y = k / n with odd k tilted to and fro along x: trapezoids of one shape for all n.

    Arnold, Boffi and Falk, Math. Comp. 71 (2002), figure 1; n is even. Triangles are their halves.
    """
    mesh = regular(cell, n)
    i, k = np.round(n * mesh.points[:, :2]).astype(int).T
    zigzag = np.where(k % 2 == 1, np.where(i % 2 == 1, 0.25, -0.25) / n, 0.0)
    return straightened(moved(mesh, np.outer(zigzag, (0, 1, 0))), cell)


def straightened(mesh, cell):
    """The mesh with each middle node where the map of the corners alone has it."""
    (block,) = mesh.cells
    linear = family(cell)
    values, _ = shapes(linear, reference_nodes(cell))
    corners = mesh.points[block.nodes[:, : len(CORNERS[linear])]]
    points = mesh.points.copy()
    points[block.nodes] = np.einsum("ac,eci->eai", values, corners)
    return ts.Mesh(points=points, cells=mesh.cells)


FLAT_MESHES = {
    "regular": regular,
    "smooth": smooth,
    "jittered": jittered,
    "trapezoids": trapezoids,
}
