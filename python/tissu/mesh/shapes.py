"""Shape functions of cells in numpy, from the monomials that each type of cell spans."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_ITERATIONS = 12  # of Newton's method for local coordinates; one is exact for affine cells


@dataclass(frozen=True, slots=True)
class Shape:
    """One type of cell.

    Attributes:
        corners: (c, m) local coordinates of its corners.
        powers: (k, m) exponents of the monomials of all its nodes.
        linear: (c, m) those of the cell with corners only, which says where its points are.
        simplex: how many of the local coordinates are those of a simplex, from 0 to 1 together;
            the others go from -1 to 1.
    """

    corners: Floats
    powers: NDArray[np.int64]
    linear: NDArray[np.int64]
    simplex: int

    def values(self, local: Floats, nodes: Floats) -> Floats:
        """Shape functions (p, k) at local coordinates (p, m), of nodes at `nodes` (k, m)."""
        return np.asarray(
            _monomials(local, self.powers) @ np.linalg.inv(_monomials(nodes, self.powers))
        )

    def beyond(self, local: Floats) -> Floats:
        """How far (p,) points at local coordinates (p, m) are outside; not above 0 inside."""
        parts = []
        if self.simplex:
            inside = local[:, : self.simplex]
            parts += [-inside.min(axis=1), inside.sum(axis=1) - 1.0]
        if self.simplex < local.shape[1]:
            parts += [np.abs(local[:, self.simplex :]).max(axis=1) - 1.0]
        return np.asarray(np.max(parts, axis=0))

    def local(self, points: Floats, corners: Floats) -> tuple[Floats, Floats]:
        """Local coordinates (p, m) of points (p, 3) in cells (p, c, 3), and what is left [m]."""
        inverse = np.asarray(np.linalg.inv(_monomials(self.corners, self.linear)), dtype=np.float64)
        found: Floats = np.repeat(self.corners.mean(axis=0)[None], len(points), axis=0)
        for _ in range(_ITERATIONS):
            slopes = np.einsum("pmq,qa->pam", _slopes(found, self.linear), inverse)
            edges = np.einsum("pam,pac->pcm", slopes, corners)
            left = points - self._at(found, inverse, corners)
            step = np.einsum("pmc,pc->pm", np.linalg.pinv(edges), left)
            found = np.asarray(np.clip(found + step, -4.0, 4.0), dtype=np.float64)
            if not np.abs(step).max(initial=0.0) > 1e-13:
                break
        left = points - self._at(found, inverse, corners)
        return found, np.asarray(np.linalg.norm(left, axis=1))

    def _at(self, local: Floats, inverse: Floats, corners: Floats) -> Floats:
        weights = _monomials(local, self.linear) @ inverse
        return np.asarray(np.einsum("pa,pac->pc", weights, corners))


def _monomials(local: Floats, powers: NDArray[np.int64]) -> Floats:
    """Values (p, q) of the monomials (q, m) at local coordinates (p, m)."""
    return np.asarray(np.prod(local[:, None, :] ** powers[None], axis=2))


def _slopes(local: Floats, powers: NDArray[np.int64]) -> Floats:
    """Their derivatives (p, m, q)."""
    found = []
    for axis in range(local.shape[1]):
        lower = powers.copy()
        lower[:, axis] = np.maximum(lower[:, axis] - 1, 0)
        found.append(powers[:, axis] * _monomials(local, lower))
    return np.stack(found, axis=1)


@cache
def shape_of(cell_type: str) -> Shape:
    """The shape of a type of cell as meshio names it; there is none for pyramids.

    Raises:
        KeyError: a type without one.
    """
    family = cell_type.rstrip("0123456789")
    corners, simplex = _CORNERS[family]
    dimension = len(corners[0])
    rows = {
        kind: np.array(
            [p for p in itertools.product(range(3), repeat=dimension) if _spans(kind, family, p)]
        )
        for kind in (cell_type, family)
    }
    return Shape(np.array(corners, dtype=float), rows[cell_type], rows[family], simplex)


def _spans(cell_type: str, family: str, powers: tuple[int, ...]) -> bool:
    """Whether the cells of a type hold a monomial exactly."""
    order = 1 if cell_type == family else 2
    if family in ("triangle", "tetra"):
        return sum(powers) <= order
    if family == "wedge":
        flat, along = sum(powers[:2]), powers[2]
        return flat <= order and along <= order and flat + along <= order + 1
    if order == 1:
        return max(powers) <= 1
    if cell_type in ("quad8", "hexahedron20"):
        return sum(power for power in powers if power > 1) <= 2
    return True


def _square() -> Iterator[tuple[float, float]]:
    yield from ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))


_TRIANGLE = ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))
_CORNERS: dict[str, tuple[list[tuple[float, ...]], int]] = {
    "line": ([(-1.0,), (1.0,)], 0),
    "triangle": (list(_TRIANGLE), 2),
    "quad": (list(_square()), 0),
    "tetra": ([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)], 3),
    "hexahedron": ([(*corner, z) for z in (-1.0, 1.0) for corner in _square()], 0),
    "wedge": ([(*corner, z) for z in (-1.0, 1.0) for corner in _TRIANGLE], 2),
}
