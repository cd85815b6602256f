"""Make examples/organ.vtu: a closed shape like a liver, meshed into tetrahedra by numpy alone.

The shape is the zero level of a smooth union of three ellipsoids (right lobe, middle, left lobe)
from which a fourth one is taken away below (the hollow where other organs lie). It is meshed by
isosurface stuffing (Labelle and Shewchuk, "Isosurface stuffing: fast tetrahedral meshes with good
dihedral angles", 2007): a body-centred cubic lattice, lattice nodes close to the surface moved onto
it, the cut tetrahedra filled again; then nodes are moved, those of the surface along it, where that
betters the worst tetrahedron around them. No random number is drawn: the same numpy gives the same
bytes.

Frame: x from the right lobe to the left one (the patient's), y to the back, z up; metres.

    python examples/make_organ.py [output.vtu]
"""

from __future__ import annotations

import contextlib
import io
import itertools
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
Cells = NDArray[np.int32]
Shape = Callable[[Points], Points]

SPACING = 0.0162  # edge of the lattice's cubes [m]
SWEEPS = 3  # of the smoothing
GOOD = 0.75  # tetrahedra of this quality are left alone by the smoothing
# The share of a long or short edge that a node may move (Labelle and Shewchuk, table 1).
ALPHA_LONG, ALPHA_SHORT = 0.24999, 0.41189

# centre [m], half axes [m]
RIGHT_LOBE = ((-0.046, 0.006, -0.006), (0.060, 0.060, 0.074))
MIDDLE = ((0.010, -0.004, 0.018), (0.066, 0.050, 0.050))
LEFT_LOBE = ((0.068, -0.012, 0.034), (0.046, 0.034, 0.026))
HOLLOW = ((0.078, 0.034, -0.092), (0.118, 0.092, 0.098))


def ellipsoid(points: Points, centre: tuple[float, ...], half_axes: tuple[float, ...]) -> Points:
    """Signed distance to an ellipsoid to first order [m], negative inside; points (n,3) -> (n,)."""
    q = (points - np.array(centre)) / np.array(half_axes)
    k = np.linalg.norm(q, axis=1)
    slope = np.linalg.norm(q / np.array(half_axes), axis=1)
    return np.asarray((k - 1) * k / np.maximum(slope, 1e-9), dtype=np.float64)


def smooth_minimum(a: Points, b: Points, width: float) -> Points:
    """The smaller of a and b, rounded off where they differ by less than `width` [m]."""
    overlap = np.maximum(width - np.abs(a - b), 0.0)
    return np.asarray(np.minimum(a, b) - overlap**2 / (4 * width), dtype=np.float64)


def organ(points: Points) -> Points:
    """The shape: negative inside, zero on the surface; points (n,3) [m] -> (n,) [m]."""
    lobes = smooth_minimum(ellipsoid(points, *RIGHT_LOBE), ellipsoid(points, *MIDDLE), 0.03)
    lobes = smooth_minimum(lobes, ellipsoid(points, *LEFT_LOBE), 0.03)
    return -smooth_minimum(-lobes, ellipsoid(points, *HOLLOW), 0.025)


def lattice(low: Points, high: Points, h: float) -> tuple[Points, Cells]:
    """A body-centred cubic lattice over a box: nodes (n,3), tetrahedra (e,4), 4 about each face."""
    counts = np.ceil((high - low) / h).astype(int) + 1
    cubes = np.array(list(np.ndindex(*counts)))
    corner_counts = counts + 1
    corners = np.array(list(np.ndindex(*corner_counts)))
    nodes = np.vstack([low + h * corners, low + h * (cubes + 0.5)])

    def corner(ijk: NDArray[np.int64]) -> NDArray[np.int64]:
        return np.asarray(np.ravel_multi_index(tuple(ijk.T), tuple(corner_counts)))

    def centre(ijk: NDArray[np.int64]) -> NDArray[np.int64]:
        return np.asarray(len(corners) + np.ravel_multi_index(tuple(ijk.T), tuple(counts)))

    cells = []
    for axis in range(3):
        step, u, v = (np.eye(3, dtype=int)[(axis + k) % 3] for k in range(3))
        first = cubes[cubes[:, axis] + 1 < counts[axis]]
        ring = [first + step, first + step + u, first + step + u + v, first + step + v]
        for a, b in zip(ring, ring[1:] + ring[:1], strict=True):
            ends = centre(first), centre(first + step)
            cells.append(np.stack([*ends, corner(a), corner(b)], axis=1))
    return nodes, np.vstack(cells).astype(np.int32)


def cut(shape: Shape, inside: Points, outside: Points) -> Points:
    """Where the segments inside -> outside cross the surface, by bisection; (m,3) each."""
    low, high = inside.copy(), outside.copy()
    for _ in range(40):
        middle = (low + high) / 2
        within = (shape(middle) < 0)[:, None]
        low, high = np.where(within, middle, low), np.where(within, high, middle)
    return np.asarray((low + high) / 2)


def warp(shape: Shape, nodes: Points, cells: Cells, h: float) -> tuple[Points, Points]:
    """Moves lattice nodes onto a surface that cuts an edge close by; returns nodes, signs (n,)."""
    sign = np.sign(shape(nodes))
    pairs = np.vstack([cells[:, p] for p in itertools.combinations(range(4), 2)])
    pairs = np.unique(np.sort(pairs, axis=1), axis=0)
    pairs = pairs[sign[pairs[:, 0]] * sign[pairs[:, 1]] < 0]
    pairs = np.where(sign[pairs[:, :1]] < 0, pairs, pairs[:, ::-1])
    crossing = cut(shape, nodes[pairs[:, 0]], nodes[pairs[:, 1]])
    length = np.linalg.norm(nodes[pairs[:, 0]] - nodes[pairs[:, 1]], axis=1)
    reach = np.where(length > 0.95 * h, ALPHA_LONG, ALPHA_SHORT) * length
    ends, crossings = pairs.T.ravel(), np.vstack([crossing, crossing])
    distance = np.linalg.norm(nodes[ends] - crossings, axis=1)
    moved, close = nodes.copy(), distance < np.concatenate([reach, reach])
    for i in np.lexsort((np.arange(len(ends)), -distance)):  # the nearest crossing is written last
        if close[i]:
            moved[ends[i]], sign[ends[i]] = crossings[i], 0.0
    return moved, np.asarray(sign, dtype=np.float64)


def fill(shape: Shape, nodes: Points, sign: Points, cells: Cells) -> tuple[Points, Cells]:
    """Keeps the tetrahedra inside and fills what the surface leaves of the cut ones."""
    kept = cells[(sign[cells] < 0).any(axis=1)]
    whole = (sign[kept] <= 0).all(axis=1)
    edges = np.vstack([kept[~whole][:, p] for p in itertools.permutations(range(4), 2)])
    edges = np.unique(edges[(sign[edges[:, 0]] < 0) & (sign[edges[:, 1]] > 0)], axis=0)
    number = {(int(a), int(b)): len(nodes) + i for i, (a, b) in enumerate(edges)}
    nodes = np.vstack([nodes, cut(shape, nodes[edges[:, 0]], nodes[edges[:, 1]])])
    made = [list(map(int, cell)) for cell in kept[whole]]
    for cell in kept[~whole]:
        made += remains([int(a) for a in cell], sign, number, nodes)
    result = np.array(made, dtype=np.int32)
    flipped = volumes(nodes, result) < 0
    result[flipped] = result[flipped][:, [1, 0, 2, 3]]
    return nodes, result


def remains(
    cell: list[int], sign: Points, number: dict[tuple[int, int], int], nodes: Points
) -> list[list[int]]:
    """The tetrahedra that fill the inner part of a cut one; faces split alike from both sides."""
    inside = sorted(a for a in cell if sign[a] < 0)
    on = [a for a in cell if sign[a] == 0]
    outside = [a for a in cell if sign[a] > 0]
    if len(inside) == 1:
        return [inside + on + [number[inside[0], c] for c in outside]]
    if len(inside) == 3:  # a prism; each quadrangle is split from its inner node of smallest number
        a, b, c = inside
        d, e, f = (number[x, outside[0]] for x in inside)
        return [[a, b, c, f], [a, b, e, f], [a, d, e, f]]
    a, b = inside
    if len(on) == 1:  # a pyramid over the quadrangle a, b, their cuts
        c, d = number[a, outside[0]], number[b, outside[0]]
        return [[a, b, d, on[0]], [a, d, c, on[0]]]
    c, d = outside  # a wedge between the edge a b and the four cuts
    ac, ad, bc, bd = number[a, c], number[a, d], number[b, c], number[b, d]
    short = np.linalg.norm(nodes[ac] - nodes[bd]) < np.linalg.norm(nodes[ad] - nodes[bc])
    rest = [[a, ac, ad, bd], [a, ac, bd, bc]] if short else [[a, ac, ad, bc], [a, ad, bd, bc]]
    return [[a, b, bc, bd], *rest]


def volumes(nodes: Points, cells: Cells) -> Points:
    """Signed volume of each tetrahedron [m3]; (..., 4) -> (...)."""
    edges = nodes[cells[..., 1:]] - nodes[cells[..., :1]]
    return np.asarray(np.linalg.det(edges) / 6, dtype=np.float64)


def quality(nodes: Points, cells: Cells) -> Points:
    """6 sqrt(2) V / l_rms^3 of each tetrahedron: 1 when equilateral, negative when inverted."""
    pairs = np.array(list(itertools.combinations(range(4), 2)))
    edges = nodes[cells[..., pairs[:, 0]]] - nodes[cells[..., pairs[:, 1]]]
    mean2 = (edges**2).sum(axis=-1).mean(axis=-1)
    return np.asarray(6 * np.sqrt(2) * volumes(nodes, cells) / mean2**1.5, dtype=np.float64)


def project(shape: Shape, point: Points, h: float) -> Points:
    """The point (3,) of the surface near a point, along the gradient of the shape."""
    offsets = np.vstack([np.eye(3), -np.eye(3)]) * 1e-3 * h
    for _ in range(4):
        f = shape(np.vstack([point, point + offsets]))
        gradient = (f[1:4] - f[4:7]) / (2e-3 * h)
        point = point - f[0] * gradient / (gradient @ gradient)
    return point


def smooth(shape: Shape, nodes: Points, cells: Cells, h: float, sweeps: int) -> Points:
    """Moves nodes towards the mean of their neighbours where their worst tetrahedron gains."""
    nodes = nodes.copy()
    on_surface = np.zeros(len(nodes), dtype=bool)
    on_surface[surface(cells).ravel()] = True
    around: list[list[int]] = [[] for _ in nodes]
    for e, cell in enumerate(cells):
        for a in cell:
            around[a].append(e)
    for _ in range(sweeps):
        for a, owners in enumerate(around):
            old, worst = nodes[a].copy(), quality(nodes, cells[owners]).min()
            if worst > GOOD:
                continue
            near = np.unique(cells[owners])
            near = near[(near != a) & (on_surface[near] | ~on_surface[a])]
            for share in (1.0, 0.5, 0.25):
                target = old + share * (nodes[near].mean(axis=0) - old)
                nodes[a] = project(shape, target, h) if on_surface[a] else target
                if quality(nodes, cells[owners]).min() > worst:
                    break
                nodes[a] = old
    return nodes


def surface(cells: Cells) -> Cells:
    """The triangles (t,3) that only one tetrahedron has."""
    faces = np.vstack([cells[:, f] for f in ([1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1])])
    keys = np.sort(faces, axis=1)
    _, first, count = np.unique(keys, axis=0, return_index=True, return_counts=True)
    return np.asarray(faces[np.sort(first[count == 1])])


def make(shape: Shape = organ, *, h: float = SPACING, sweeps: int = SWEEPS) -> tuple[Points, Cells]:
    """Nodes (n,3) [m] and tetrahedra (e,4) of a shape that lies within 16 cm of the origin."""
    nodes, cells = lattice(np.full(3, -0.16), np.full(3, 0.16), h)
    nodes, sign = warp(shape, nodes, cells, h)
    nodes, cells = fill(shape, nodes, sign, cells)
    used, cells_flat = np.unique(cells, return_inverse=True)
    nodes, cells = nodes[used], cells_flat.reshape(cells.shape).astype(np.int32)
    return np.round(smooth(shape, nodes, cells, h, sweeps), 7), cells


def report(nodes: Points, cells: Cells) -> str:
    """The numbers of a mesh, in words."""
    q, size = quality(nodes, cells), np.ptp(nodes, axis=0) * 100
    return (
        f"{len(nodes)} nodes, {len(cells)} tetrahedra, {len(surface(cells))} surface triangles\n"
        f"{size[0]:.1f} x {size[1]:.1f} x {size[2]:.1f} cm, "
        f"volume {volumes(nodes, cells).sum() * 1e6:.0f} cm3\n"
        f"quality 6 sqrt(2) V / l_rms^3: min {q.min():.3f}, 1 % below {np.quantile(q, 0.01):.3f}, "
        f"median {np.median(q):.3f}; inverted {int((q <= 0).sum())}"
    )


def main() -> None:
    """Makes the mesh, writes it and prints its numbers."""
    import meshio

    path = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).with_name("organ.vtu")
    nodes, cells = make()
    # Text, against meshio's advice: its bytes do not depend on a compressor.
    with contextlib.redirect_stderr(io.StringIO()):
        meshio.write(path, meshio.Mesh(nodes, [("tetra", cells)]), binary=False)
    print(report(nodes, cells))
    print(f"{path}: {path.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main()
