"""The space between two organs, which connective tissue fills."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from tissu.errors import MeshError, ParameterError
from tissu.mesh.cell import Floats
from tissu.sampling.meeting import gap, overlap
from tissu.sampling.nearest import TriangleTree
from tissu.sampling.region import Bools, Indices, positions, positive
from tissu.sampling.surface import Surface

_FINE = (16, 32)  # cells along the longest side: to find the bounds, then to measure the volume
_DRAWS = 2  # random places in each
_ROUNDING = 1e-9  # of the reach


def between(
    a: Surface,
    b: Surface,
    reach: float,
    *,
    nodes_a: ArrayLike | None = None,
    nodes_b: ArrayLike | None = None,
) -> Between:
    """The points from which two surfaces lie to opposite sides, near enough to be tied together.

    With A and B the nearest points of the two surfaces to p, p is in the region when it is outside
    both bodies, |p - A| + |p - B| <= reach, and (p - A) . (p - B) <= 0: p sees them a right angle
    or more apart, that is, lies in the ball whose diameter is from A to B. So every fibre through
    p from one body to the other has at least the length of the gap and at most `reach`, the region
    touches both bodies, and the far sides of thin ones are not in it. Of two equal plates face to
    face it is what lies between them and a rounded rim of half the gap.

    With `nodes_a` and `nodes_b`, A and B are the nearest points of the chosen patches: the
    triangles all of whose nodes are chosen. Then it is the tissue that spans from patch to patch.

    Args:
        a: one body.
        b: the other; the two do not intersect.
        reach: longest way from one to the other [m]; the gap at least, better twice that.
        nodes_a: numbers of chosen nodes of `a`; all when left out.
        nodes_b: numbers of chosen nodes of `b`.

    Raises:
        MeshError: the bodies intersect; says how deep.
        ParameterError: nothing lies between them within reach (says the gap and the least reach),
            the reach is not positive, or the chosen nodes have no triangle.
    """
    value = positive(reach, "reach")
    tree_a, tree_b = _tree(a, nodes_a, "nodes_a"), _tree(b, nodes_b, "nodes_b")
    if (depth := overlap(a, b)) > 0.0:
        raise MeshError(
            f"found two bodies that intersect, at least {depth:.3g} m deep; bodies that are apart "
            "or touch are accepted: move one away by that much or more"
        )
    return Between(a, b, value, tree_a, tree_b, _reached_gap(tree_a, tree_b, value))


def _reached_gap(a: TriangleTree, b: TriangleTree, reach: float) -> float:
    """The gap [m], refused when it is not within reach."""
    ends = gap(a, b)
    length = float(np.linalg.norm(ends[1] - ends[0]))
    if reach < length * (1.0 + 1e-6):
        raise ParameterError(
            f"found reach {reach:g} m, and nothing lies between the bodies: the gap is "
            f"{length:.6g} m; a reach of more than that is accepted: give {2.0 * length:.3g} m, "
            "or bring the bodies nearer"
        )
    return length


@dataclass(frozen=True, eq=False)
class Between:
    """A region between two bodies; made by `between`.

    Attributes:
        a: one body.
        b: the other.
        reach: longest way from one to the other [m].
        tree_a: the triangles of `a` that are tied.
        tree_b: those of `b`.
        gap: shortest way from one to the other [m].
    """

    a: Surface
    b: Surface
    reach: float
    tree_a: TriangleTree
    tree_b: TriangleTree
    gap: float

    def inside(self, points: ArrayLike) -> Bools:
        """Which of the points (n, 3) [m] are between the bodies: (n,); on a body's surface, none.

        Raises:
            ParameterError: points of another shape, or not finite.
        """
        places = positions(points)
        low, high = self._box
        answer = ((places >= low) & (places <= high)).all(axis=1)
        numbers = np.flatnonzero(answer)
        on_a, d_a = self.tree_a.nearest(places[numbers], self.reach)
        near = np.isfinite(d_a)
        answer[numbers[~near]] = False
        numbers, on_a, d_a = numbers[near], on_a[near], d_a[near]
        seen = places[numbers]
        # What is left of the reach, and a little that rounding takes: whatever is held is found.
        on_b, d_b = self.tree_b.nearest(seen, self.reach - d_a + _ROUNDING * self.reach)
        held = d_a + d_b <= self.reach
        seen = seen[held]
        held[held] = np.einsum("ij,ij->i", on_a[held] - seen, on_b[held] - seen) <= 0.0
        answer[numbers] = held
        numbers = numbers[held]  # few are left to be asked for the bodies, which takes longer
        answer[numbers] = ~(self.a.inside(places[numbers]) | self.b.inside(places[numbers]))
        return np.asarray(answer)

    @property
    def bounds(self) -> Floats:
        """Smallest and largest coordinates (2, 3) [m], of the fine cells something was found in."""
        return self._measured[0]

    @property
    def volume(self) -> float:
        """Volume [m3], measured with random places in fine cells; see `volume_error`."""
        return self._measured[1]

    @property
    def volume_error(self) -> float:
        """Standard error [m3] of the volume; of three regions, one is further off than this."""
        return self._measured[2]

    @cached_property
    def _box(self) -> Floats:
        """What holds the region for sure: within reach of both."""
        both = np.array([self.tree_a.bounds, self.tree_b.bounds])
        return np.array([both[:, 0].max(axis=0) - self.reach, both[:, 1].min(axis=0) + self.reach])

    @cached_property
    def _measured(self) -> tuple[Floats, float, float]:
        """Bounds, volume and its standard error: a coarse look for the bounds, then a fine one."""
        rng = np.random.default_rng(0)
        box, volume, error = self._box, 0.0, 0.0
        for fine in _FINE:
            cells, size = _cells(box, fine)
            hits = np.zeros(len(cells))
            for _ in range(_DRAWS):
                hits += self.inside(box[0] + (cells + rng.random(cells.shape)) * size)
            some = cells[hits > 0]
            if not len(some):
                break
            share, cell = hits / _DRAWS, float(size.prod())
            volume = float(share.sum()) * cell
            # The variance within a cell is estimated from its own places.
            error = float(np.sqrt((share * (1 - share)).sum() / (_DRAWS - 1))) * cell
            box = _around(box, some, size)
        if volume == 0.0:
            raise ParameterError(
                f"found next to nothing between the bodies with reach {self.reach:g} m, where the "
                f"gap is {self.gap:.6g} m; a reach well above the gap is accepted: give "
                f"{2.0 * self.gap:.3g} m"
            )
        return box, volume, error


def _cells(box: Floats, fine: int) -> tuple[Indices, Floats]:
    """Places (m, 3) and sides (3,) of the fine cells of a box."""
    sides = np.ptp(box, axis=0)
    counts = np.maximum(np.ceil(fine * sides / sides.max()), 4).astype(np.int64)
    cells = np.stack(np.meshgrid(*map(np.arange, counts), indexing="ij"), axis=-1)
    return cells.reshape(-1, 3), sides / counts


def _around(box: Floats, cells: Indices, size: Floats) -> Floats:
    """The box of the cells with one cell more on each side, within the box."""
    low = np.maximum(box[0], box[0] + (cells.min(axis=0) - 1) * size)
    high = np.minimum(box[1], box[0] + (cells.max(axis=0) + 2) * size)
    return np.array([low, high])


def _tree(surface: Surface, nodes: ArrayLike | None, name: str) -> TriangleTree:
    """The triangles whose nodes are all chosen."""
    if nodes is None:
        return surface.tree
    numbers = np.asarray(nodes)
    count = len(surface.points)
    whole = numbers.dtype.kind in "iu" and numbers.ndim == 1 and numbers.size > 0
    if not whole or numbers.min() < 0 or numbers.max() >= count:
        raise ParameterError(
            f"found {name} {numbers!r}; numbers of nodes from 0 to {count - 1} are accepted"
        )
    chosen = np.zeros(count, dtype=bool)
    chosen[numbers] = True
    whole_triangles = surface.triangles[chosen[surface.triangles].all(axis=1)]
    if not len(whole_triangles):
        raise ParameterError(
            f"found {len(numbers)} {name} that no triangle has all three nodes among; the nodes "
            "of at least one triangle are accepted: choose more"
        )
    return TriangleTree(surface.points[whole_triangles])
