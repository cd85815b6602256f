"""How far points of the bodies give way to forces: what a haptic loop knows of the tissue."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from tissu import _core
from tissu.errors import ParameterError
from tissu.simulation.entry import one_thread_at_a_time
from tissu.simulation.known_names import known_names_only

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from tissu.simulation.simulation import Simulation

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]
Way = Literal["factor", "cg", "condensed", "warped"]
WAYS: tuple[Way, ...] = ("factor", "cg", "condensed", "warped")


@known_names_only
@one_thread_at_a_time
class Compliance:
    """The compliance of points within a step; made by `Simulation.compliance`.

    W = dt^2 H A^-1 H^T with A = M + dt D + dt^2 K as they are now, and H the directions of the
    points; H K^-1 H^T of a static method. `error` bounds its relative error.
    """

    def __init__(
        self, *, simulation: Simulation, by: Way, tolerance: float, bodies: Sequence[str] | None
    ) -> None:
        """See `Simulation.compliance`."""
        self._simulation, self._entry = simulation, simulation._entry
        self._by: Way = by
        self._made = 0
        self._rows = _table_rows(simulation, bodies) if by in ("condensed", "warped") else _NONE
        self._found = _core.Compliance(way=by, tolerance=tolerance, rows=self._rows)

    def __repr__(self) -> str:
        """How it is found, and how well the latest one was."""
        return f"Compliance(by='{self._by}', error={self.error:.2g})"

    def of(
        self,
        bodies: Sequence[str],
        nodes: Sequence[ArrayLike],
        weights: Sequence[ArrayLike],
        axes: ArrayLike,
    ) -> Floats:
        """W (3m, 3m) of m points in three directions each [m/N], symmetric.

        The displacement of a point is the weighted sum of those of its nodes.

        Args:
            bodies: name of the body of each point.
            nodes: numbers in the body (k,) of each point.
            weights: of the nodes (k,).
            axes: unit vectors (m, 3, 3), the directions of each point in rows.

        Returns:
            The rows and columns of point i are 3 i to 3 i + 2. A direction that is held has zeros.

        Raises:
            ParameterError: no body of that name or no node of that number; a method that this scene
                does not allow; lengths that differ.
        """
        if not len(bodies) == len(nodes) == len(weights) == len(np.reshape(axes, (-1, 9))):
            raise ParameterError(
                f"found {len(bodies)} bodies, {len(nodes)} nodes, {len(weights)} weights and "
                f"{len(np.reshape(axes, (-1, 9)))} axes; as many of each are accepted"
            )
        rows, shares, begin = [_NONE], [np.empty(0)], [0]
        for body, numbers, weight in zip(bodies, nodes, weights, strict=True):
            rows.append(_rows_of(self._simulation, body, numbers))
            shares.append(np.asarray(weight, dtype=float))
            begin.append(begin[-1] + len(rows[-1]))
        found = self._found.find(
            simulation=self._simulation._core,
            dt=self._simulation.dt,
            begin=np.array(begin, dtype=np.int32),
            rows=np.concatenate(rows),
            weights=np.concatenate(shares),
            axes=np.asarray(axes, dtype=float),
        )
        self._made += self._found.made
        return found

    @property
    def by(self) -> Way:
        """The method by which it is computed."""
        return self._by

    @property
    def error(self) -> float:
        """Bound of the relative error of the latest one, of each direction's own compliance.

        It is zero if the factor is that of the matrix itself, and for `condensed`. The bound is
        valid if damping and stiffness are positive semi-definite and every node has a mass; without
        masses the kept factor estimates it. For `warped` the error is not known: nan.
        """
        return float("nan") if self._by == "warped" else self._found.error

    @property
    def corrections(self) -> int:
        """Number of corrections of the latest computation; for `cg`, of iterations."""
        return self._found.corrections

    @property
    def factors(self) -> int:
        """How often a matrix was factored since the object was made."""
        return self._made

    @property
    def definite(self) -> bool:
        """Whether the matrix was positive definite; otherwise that of each cell was made so."""
        return self._found.definite


_NONE = np.empty(0, dtype=np.int32)


def _rows_of(simulation: Simulation, body: str, nodes: ArrayLike) -> Ints:
    """Rows of the unknowns of nodes of a body."""
    rows = simulation.rows(body)
    numbers = np.asarray(nodes)
    if len(numbers) and not (numbers.min() >= 0 and numbers.max() < rows.stop - rows.start):
        worst = int(numbers[(numbers < 0) | (numbers >= rows.stop - rows.start)][0])
        text = f"found node {worst} of '{body}', which has {rows.stop - rows.start} nodes; "
        raise ParameterError(f"{text}numbers from 0 on are accepted")
    return np.asarray(rows.start + numbers, dtype=np.int32)


def _table_rows(simulation: Simulation, bodies: Sequence[str] | None) -> Ints:
    """Rows of the nodes on the surfaces of bodies."""
    rows = [_NONE]
    for body in simulation.bodies if bodies is None else bodies:
        nodes = np.unique(simulation.meshes[body].surface().triangles)
        rows.append(_rows_of(simulation, body, nodes))
    return np.concatenate(rows)
