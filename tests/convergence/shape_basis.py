"""Shape functions of every element, independent of the library's: by interpolation.

Each element spans a few terms x^i y^j z^k / (1 - z)^m (m > 0 on pyramids only). Its shape
functions are the combinations that are one at one node and zero at the others, found by inverting
the matrix of the terms' values at the nodes. Spaces: Zienkiewicz and Taylor, The Finite Element
Method, vol. 1; pyramids: Bedrosian, Int. J. Numer. Meth. Eng. 35 (1992). Nodes: VTK's order
(wedges: meshio's). Elements of fewer dimensions lie at z = 0 of the reference cell, lines along x.
"""

from functools import cache
from itertools import product

import numpy as np

SQUARE = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
CORNERS = {
    "tetra": [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
    "hexahedron": [(x, y, z) for z in (-1, 1) for x, y in SQUARE],
    "wedge": [(x, y, z) for z in (-1, 1) for x, y in ((0, 0), (1, 0), (0, 1))],
    "pyramid": [*((x, y, 0) for x, y in SQUARE), (0, 0, 1)],
    "triangle": [(0, 0, 0), (1, 0, 0), (0, 1, 0)],
    "quad": [(x, y, 0) for x, y in SQUARE],
    "line": [(-1, 0, 0), (1, 0, 0)],
}
RING = [(0, 1), (1, 2), (2, 3), (3, 0)]
EDGES = {
    "tetra": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
    "hexahedron": [
        *RING,
        *((a + 4, b + 4) for a, b in RING),
        *((a, a + 4) for a in range(4)),
    ],
    "wedge": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
    "pyramid": [*RING, *((a, 4) for a in range(4))],
    "triangle": [(0, 1), (1, 2), (2, 0)],
    "quad": RING,
    "line": [(0, 1)],
}
FACES_27 = [(-1, 0, 0), (1, 0, 0), (0, -1, 0), (0, 1, 0), (0, 0, -1), (0, 0, 1)]
CENTRES = {"hexahedron27": [*FACES_27, (0, 0, 0)], "quad9": [(0, 0, 0)]}
DIMENSION = {"line": 1, "triangle": 2, "quad": 2, "tetra": 3, "hexahedron": 3, "wedge": 3}
DIMENSION["pyramid"] = 3
ORDER = {
    "tetra": 1,
    "tetra10": 2,
    "hexahedron": 1,
    "hexahedron20": 2,
    "hexahedron27": 2,
    "wedge": 1,
    "wedge15": 2,
    "pyramid": 1,
    "pyramid13": 2,
    "triangle": 1,
    "triangle6": 2,
    "quad": 1,
    "quad8": 2,
    "quad9": 2,
    "line": 1,
    "line3": 2,
}


def family(cell):
    return cell.rstrip("0123456789")


VOLUMES, SURFACES, LINES = ([c for c in ORDER if DIMENSION[family(c)] == d] for d in (3, 2, 1))


def reference_nodes(cell):
    """Places (k, 3) of the nodes of a cell in its reference cell."""
    shape = family(cell)
    corners = np.array(CORNERS[shape], dtype=float)
    if ORDER[cell] == 1:
        return corners
    middles = np.array([corners[list(edge)].mean(axis=0) for edge in EDGES[shape]])
    return np.vstack([corners, middles, *([CENTRES[cell]] if cell in CENTRES else [])])


def _terms(cell):
    """Exponents (i, j, k, m) of x^i y^j z^k / (1 - z)^m."""
    p, d = ORDER[cell], DIMENSION[family(cell)]
    cube = [(*e, *(0,) * (4 - d)) for e in product(range(p + 1), repeat=d)]
    whole = [t for t in cube if sum(t) <= p]
    if family(cell) in ("tetra", "triangle"):
        return whole
    if cell in ("hexahedron", "hexahedron27", "quad", "quad9", "line", "line3"):
        return cube
    if cell in ("hexahedron20", "quad8"):  # superlinear degree: exponents of 1 do not count
        return [t for t in cube if sum(e for e in t if e > 1) <= 2]
    if family(cell) == "wedge":
        flat = [t for t in cube if t[0] + t[1] <= p and t[2] <= 1]
        return flat + ([(0, 0, 2, 0), (1, 0, 2, 0), (0, 1, 2, 0)] if p == 2 else [])
    rational = [(1, 1, 0, 1)] + ([(2, 1, 0, 1), (1, 2, 0, 1)] if p == 2 else [])
    return whole + rational


def _power(base, exponent):
    return base**exponent if exponent > 0 else np.ones_like(base)


def _values(terms, points):
    x, y, z = np.asarray(points, dtype=float).T
    apex = z == 1.0
    below = np.where(apex, 1.0, 1.0 - z)
    columns = []
    for i, j, k, m in terms:
        value = _power(x, i) * _power(y, j) * _power(z, k) / below**m
        columns.append(np.where(apex & (m > 0), 0.0, value))  # the limit along lines in the cell
    return np.stack(columns, axis=-1)


def _gradients(terms, points):
    x, y, z = np.asarray(points, dtype=float).T
    rows = []
    for i, j, k, m in terms:
        X, Y, Z = _power(x, i), _power(y, j), _power(z, k)
        below = (1.0 - z) ** -m if m else np.ones_like(z)
        along_z = Z * m / (1.0 - z) if m else np.zeros_like(z)
        along_z = along_z + (k * _power(z, k - 1) if k else 0.0)
        dx = (i * _power(x, i - 1) if i else 0.0 * x) * Y * Z * below
        dy = X * (j * _power(y, j - 1) if j else 0.0 * y) * Z * below
        rows.append(np.stack([dx, dy, X * Y * along_z * below], axis=-1))
    return np.stack(rows, axis=-2)


@cache
def _coefficients(cell):
    return np.linalg.inv(_values(_terms(cell), reference_nodes(cell)))


def shapes(cell, points):
    """Values (g, k) and reference gradients (g, k, 3) at reference points (g, 3)."""
    C, terms = _coefficients(cell), _terms(cell)
    values = _values(terms, points) @ C
    return values, np.einsum("gti,ta->gai", _gradients(terms, points), C)


@cache
def cubature(shape, count):
    """Points (g, 3) and weights (g,) on a reference cell: Gauss-Legendre on the collapsed cube.

    Polynomials of degree 2 count - 1 less the collapse (0 to 2) are exact in each direction.
    """
    t, w = np.polynomial.legendre.leggauss(count)
    if DIMENSION[shape] < 3:
        return _thin_cubature(shape, t, w)
    a, b, c = (v.ravel() for v in np.meshgrid(t, t, t, indexing="ij"))
    weights = np.einsum("i,j,k->ijk", w, w, w).ravel()
    if shape == "hexahedron":
        return np.stack([a, b, c], axis=-1), weights
    z = (1 + c) / 2
    if shape == "pyramid":
        return np.stack([(1 - z) * a, (1 - z) * b, z], axis=-1), weights * (1 - z) ** 2 / 2
    x, y = (1 + a) / 2, (1 + b) / 2
    if shape == "wedge":
        return np.stack([x * (1 - y), y, c], axis=-1), weights * (1 - y) / 4
    points = np.stack([x * (1 - y) * (1 - z), y * (1 - z), z], axis=-1)
    return points, weights * (1 - y) * (1 - z) ** 2 / 8


def _thin_cubature(shape, t, w):
    """The same for lines and surfaces, from one-dimensional points and weights."""
    if shape == "line":
        return np.outer(t, (1, 0, 0)), w
    a, b = (v.ravel() for v in np.meshgrid(t, t, indexing="ij"))
    weights, zero = np.outer(w, w).ravel(), np.zeros_like(a)
    if shape == "quad":
        return np.stack([a, b, zero], axis=-1), weights
    x, y = (1 + a) / 2, (1 + b) / 2
    return np.stack([x * (1 - y), y, zero], axis=-1), weights * (1 - y) / 4
