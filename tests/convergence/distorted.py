"""Meshes of the unit cube, regular and distorted in three ways; its faces stay where they are."""

import numpy as np

import tissu as ts
from shape_basis import ORDER, family


def regular(cell, n):
    return ts.bar_mesh(size=(1, 1, 1), cells=(n, n, n), cell=cell)


def smooth(cell, n):
    """Every node moved by one map, the same for all n: cells stay curved but grow affine with n."""
    mesh = regular(cell, n)
    s = np.sin(np.pi * mesh.points).prod(axis=1)
    t = np.sin(2 * np.pi * mesh.points[:, 0]) * np.sin(np.pi * mesh.points[:, 1:]).prod(axis=1)
    shift = np.stack([0.06 * s + 0.03 * t, -0.05 * s, 0.05 * s - 0.03 * t], axis=1)
    return moved(mesh, shift)


def jittered(cell, n):
    """Corners moved at random by up to `share` of a cell, on faces along them; edges straight."""
    linear = regular(family(cell), n)
    free = (linear.points > 1e-9) & (linear.points < 1 - 1e-9)
    random = np.random.default_rng(7).uniform(-1, 1, linear.points.shape)
    share = 0.1 if family(cell) in ("tetra", "pyramid") else 0.2  # their cells are thinner
    return raised(moved(linear, share / n * random * free), cell)


def trapezoids(cell, n):
    """Planes z = k / n with odd k tilted to and fro along x: trapezoids of one shape for all n.

    After Arnold, Boffi and Falk, Math. Comp. 71 (2002), figure 1; n is even.
    """
    linear = regular(family(cell), n)
    i, k = np.round(n * linear.points[:, [0, 2]]).astype(int).T
    zigzag = np.where(k % 2 == 1, np.where(i % 2 == 1, 0.25, -0.25) / n, 0.0)
    zigzag *= ~_tips(linear)
    return raised(moved(linear, np.outer(zigzag, (0, 0, 1))), cell)


def _tips(mesh):
    """The tips of pyramids, which lie in the middle of grid cells and stay there."""
    tips = np.zeros(mesh.node_count, dtype=bool)
    for block in mesh.volume_blocks:
        if family(block.type) == "pyramid":
            tips[block.nodes[:, 4]] = True
    return tips


def moved(mesh, shift):
    return ts.Mesh(points=mesh.points + shift, cells=mesh.cells)


def raised(linear, cell):
    """The mesh with the middle nodes that the cell type has."""
    if ORDER[cell] == 1:
        return linear
    return ts.into_quadratic(linear, centres=cell == "hexahedron27")


MESHES = {"regular": regular, "smooth": smooth, "jittered": jittered, "trapezoids": trapezoids}
