"""How far tetrahedra are from the regular one, by several measures.

Edges l, faces s, volume v; every measure is 1 for the regular tetrahedron and falls to 0.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

__all__ = ["Quality"]

SHORT_EDGE = 0.2
FLAT = 0.1
_EDGES = tuple(itertools.combinations(range(4), 2))
_SOLID = math.acos(23.0 / 27.0)  # 0.5513
_DIHEDRAL = math.acos(1.0 / 3.0)  # 1.2310


@dataclass(frozen=True, slots=True, eq=False)
class Quality:
    """Measures of tetrahedra, each (m,).

    Attributes:
        volume: v [m3]; below zero where it is inside out.
        shape: 6 sqrt 2 v / l_rms^3.
        edges: least edge over the longest; blind to flat tetrahedra.
        inner: 12 / sqrt 6 times the radius of the inner sphere over the longest edge.
        radii: 3 rho_in / rho_out, of the inner and outer spheres (Chendeb 2007).
        solid_angle: least angle of a corner, over that of the regular one.
        dihedral: least angle between two faces, over that of the regular one; blind to needles.
    """

    volume: Floats
    shape: Floats
    edges: Floats
    inner: Floats
    radii: Floats
    solid_angle: Floats
    dihedral: Floats

    @property
    def has_short_edge(self) -> Bools:
        """Type I of Forest (2003): an edge is below a fifth of the longest (m,)."""
        return np.asarray(self.edges < SHORT_EDGE)

    @property
    def is_flat(self) -> Bools:
        """Type II of Forest (2003): flat, without a short edge (m,)."""
        return np.asarray((self.radii < FLAT) & ~self.has_short_edge)

    def __repr__(self) -> str:
        """How many there are, and the worst of each measure."""
        names = ("shape", "edges", "inner", "radii", "solid_angle", "dihedral")
        worst = ", ".join(f"{name} {getattr(self, name).min():.3g}" for name in names)
        return f"Quality({len(self.volume)} tetrahedra, least: {worst})"


def quality_of(corners: Floats) -> Quality:
    """The measures of tetrahedra whose corners are (m, 4, 3) [m]."""
    sides = corners[:, [b for _, b in _EDGES]] - corners[:, [a for a, _ in _EDGES]]
    lengths = np.linalg.norm(sides, axis=2)
    volume = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6.0
    size = np.maximum(volume, 0.0)
    normals = _normals(corners)
    faces = 0.5 * np.linalg.norm(normals, axis=2)
    inner = 3.0 * size / np.maximum(faces.sum(axis=1), 1e-300)
    longest = lengths.max(axis=1)
    return Quality(
        volume=volume,
        shape=6.0 * math.sqrt(2.0) * volume / np.sqrt((lengths**2).mean(axis=1)) ** 3,
        edges=lengths.min(axis=1) / longest,
        inner=12.0 / math.sqrt(6.0) * inner / longest,
        radii=3.0 * inner / _outer_radius(lengths, size),
        solid_angle=_least_solid_angle(lengths, size) / _SOLID,
        dihedral=_least_dihedral(normals) / _DIHEDRAL,
    )


def _normals(corners: Floats) -> Floats:
    """Outward normals (m, 4, 3) of the faces opposite to each corner, twice their areas long."""
    found = []
    for i in range(4):
        a, b, c = (corners[:, k] for k in range(4) if k != i)
        normal = np.cross(b - a, c - a)
        inward = np.einsum("mi,mi->m", normal, corners[:, i] - a) > 0.0
        found.append(np.where(inward[:, None], -normal, normal))
    return np.stack(found, axis=1)


def _outer_radius(lengths: Floats, volume: Floats) -> Floats:
    """sqrt((a+b+c)(-a+b+c)(a-b+c)(a+b-c)) / (24 v), a b c products of opposite edges."""
    a, b, c = (lengths[:, k] * lengths[:, 5 - k] for k in range(3))
    product = (a + b + c) * (b + c - a) * (a - b + c) * (a + b - c)
    with np.errstate(divide="ignore", invalid="ignore"):
        radius = np.sqrt(np.maximum(product, 0.0)) / (24.0 * volume)
    return np.where(volume > 0.0, radius, np.inf)


def _least_solid_angle(lengths: Floats, volume: Floats) -> Floats:
    """sin(theta / 2) = 12 v / sqrt(prod_{j<k} ((l_j + l_k)^2 - l_jk^2)), Liu and Joe 1994.

    Of each corner; l_j and l_k are edges at it, l_jk joins their ends.
    """
    number = {edge: k for k, edge in enumerate(_EDGES)}
    least = np.full(len(lengths), np.inf)
    for corner in range(4):
        others = [k for k in range(4) if k != corner]
        product = np.ones(len(lengths))
        for j, k in itertools.combinations(others, 2):
            near_j = lengths[:, number[min(corner, j), max(corner, j)]]
            near_k = lengths[:, number[min(corner, k), max(corner, k)]]
            product *= (near_j + near_k) ** 2 - lengths[:, number[j, k]] ** 2
        half = 12.0 * volume / np.sqrt(np.maximum(product, 1e-300))
        least = np.minimum(least, 2.0 * np.arcsin(np.minimum(half, 1.0)))
    return least


def _least_dihedral(normals: Floats) -> Floats:
    """The least angle between two faces (m,) [rad]."""
    least = np.full(len(normals), np.inf)
    for i, j in _EDGES:
        cross = np.linalg.norm(np.cross(normals[:, i], normals[:, j]), axis=1)
        dot = np.einsum("mi,mi->m", normals[:, i], normals[:, j])
        least = np.minimum(least, math.pi - np.arctan2(cross, dot))
    return least
