"""How far points of the bodies give way to forces: what a haptic loop knows of the tissue."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from tissu import _core
from tissu.arrays import real_array
from tissu.counted import counted
from tissu.errors import ParameterError
from tissu.reading import names_of, written
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
                does not allow; lengths that differ; axes of another shape, or not of length 1.
        """
        names = names_of(bodies, "bodies")
        directions = real_array(axes, "axes")
        if directions.ndim != 3 or directions.shape[1:] != (3, 3):
            text = f"found axes of shape {directions.shape}; (m, 3, 3) is accepted"
            raise ParameterError(text)
        lengths = np.linalg.norm(directions, axis=2)
        if not (np.abs(lengths - 1.0) <= _UNIT).all():
            worst = float(lengths.flat[np.argmax(np.abs(lengths - 1.0))])
            raise ParameterError(
                f"found an axis of length {worst:g}; directions of length 1 are accepted"
            )
        count = len(directions)
        if not len(names) == _length(nodes) == _length(weights) == count:
            raise ParameterError(
                f"found {len(names)} bodies, {_length(nodes)} nodes, {_length(weights)} weights "
                f"and {count} axes; as many of each are accepted"
            )
        rows, shares, begin = [_NONE], [np.empty(0)], [0]
        for body, numbers, weight in zip(names, nodes, weights, strict=True):
            rows.append(_rows_of(self._simulation, body, numbers))
            shares.append(_one_for_each(weight, len(rows[-1])))
            begin.append(begin[-1] + len(rows[-1]))
        found = self._found.find(
            simulation=self._simulation._core,
            dt=self._simulation.dt,
            begin=np.array(begin, dtype=np.int32),
            rows=np.concatenate(rows),
            weights=np.concatenate(shares),
            axes=directions.astype(float).reshape(-1, 3, 3),
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
    def drift(self) -> Floats:
        """How far the latest points move on in the next step (3m,) [m], along their directions.

        Without forces on them the next step takes them from x to x - W lambda + drift, with lambda
        the forces on them in the latest step: d = dt H A^-1 (M (2 v - v_before) + dt D v). It is
        zero at rest, for `condensed` and `warped`, and of a static method. The velocities before
        are those of a call one step earlier; without it the points are taken to move evenly.
        """
        return np.asarray(self._found.drift)

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
_UNIT = 1e-6
"""Most that the length of a direction differs from 1: more is another vector, not round-off."""


def _length(values: object) -> int:
    """The number of values; 0 if they are not a list or an array."""
    if isinstance(values, np.ndarray):
        return len(values) if values.ndim else 0
    return len(values) if isinstance(values, Sequence) else 0


def _one_for_each(weights: ArrayLike, nodes: int) -> Floats:
    """Weights as numbers, one for each node of a point."""
    found = real_array(weights, "weights").astype(float)
    if found.shape != (nodes,) or not np.isfinite(found).all():
        text = f"found the weights {written(weights)} for {counted(nodes, 'node')}; a finite one "
        raise ParameterError(f"{text}for each node is accepted")
    return found


def _rows_of(simulation: Simulation, body: str, nodes: ArrayLike) -> Ints:
    """Rows of the unknowns of nodes of a body."""
    rows = simulation.rows(body)
    numbers = real_array(nodes, "nodes")
    if numbers.ndim != 1 or numbers.dtype.kind not in "iu":
        text = f"found nodes {written(nodes)} of '{body}'; a list of whole numbers is accepted"
        raise ParameterError(text)
    if len(numbers) and not (numbers.min() >= 0 and numbers.max() < rows.stop - rows.start):
        worst = int(numbers[(numbers < 0) | (numbers >= rows.stop - rows.start)][0])
        text = f"found node {worst} of '{body}', which has {rows.stop - rows.start} nodes; "
        raise ParameterError(f"{text}numbers from 0 on are accepted")
    return np.asarray(rows.start + numbers, dtype=np.int32)


def _table_rows(simulation: Simulation, bodies: Sequence[str] | None) -> Ints:
    """Rows of the nodes on the surfaces of bodies."""
    if bodies is not None and not len(bodies):
        raise ParameterError(
            "found an empty list of bodies; at least one is accepted, or None for all"
        )
    rows = [_NONE]
    for body in simulation.bodies if bodies is None else bodies:
        nodes = np.unique(simulation.meshes[body].surface().triangles)
        rows.append(_rows_of(simulation, body, nodes))
    return np.concatenate(rows)
