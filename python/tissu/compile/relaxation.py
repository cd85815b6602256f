"""Bodies that overlap are deformed until they cross nowhere: linear elasticity with inequalities.

Every point of a surface that lies in another one, or near to it, has to end outside by a margin.
Among all displacements that do so, the one of least elastic energy is taken: the linearised problem
of Signorini, K u = J^T p, p >= 0. Nearest points are then looked for again.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from tissu.counted import counted
from tissu.errors import ParameterError
from tissu.simulation.matrices import sparse

if TYPE_CHECKING:
    from tissu.compile.clearance import Clearance
    from tissu.compile.prepared import Floats

_LOOKS = 60
"""looks for nearest points, at most"""
_MORE = 0.25
"""of the gap: what is asked on top in each look after which something still crosses"""
_SWEEPS = 400
_ENOUGH = 0.02
"""of the gap: change of a clearance in a sweep over all of them that counts as none"""
_LOOSE = 0.1
"""of the frequency with which a wave passes through: of springs that hold what nothing else does"""


class Relaxation:
    """Deforms bodies from rest until the exact audit finds no crossing."""

    def __init__(
        self, core: Any, clearance: Clearance, gap: float, bodies: slice, crossing: float
    ) -> None:
        """`core`: a simulation at rest; `gap`: the least [m]; `crossing`: time of a wave [s]."""
        self._core = core
        self._clearance = clearance
        self._gap = gap
        self._rest = np.array(core.positions)
        self._bodies = bodies
        self._crossing = crossing
        self.looks = 0
        self.depth = 0.0

    def run(self) -> None:
        """Deform them.

        Raises:
            ParameterError: they still cross.
        """
        solve = _Solve(self._core, self._bodies, _LOOSE / self._crossing)
        crossing = self._clearance.crossing()
        for look in range(_LOOKS):
            asked = self._clearance.asked(1.0 + _MORE * look)
            if look == 0:
                self.depth = -float(asked.distance.min(initial=0.0))
            clear = float(asked.distance.min(initial=np.inf)) > 0.25 * self._gap
            if not crossing and clear and not is_thick_inside(self._core, self._gap):
                return
            moved = solve.displacements(asked.rows, asked.bound, self._rest, _ENOUGH * self._gap)
            self._core.positions[:] = self._rest + moved
            self.looks += 1
            crossing = self._clearance.crossing()
        left = counted(crossing, "crossing") + " of edges" if crossing else "surfaces that touch"
        raise ParameterError(
            f"found {left} still after {_LOOKS} searches, from places as deep as {self.depth:.3g} m"
        )


def is_thick_inside(core: Any, gap: float) -> bool:
    """Whether thick things are inside each other by more than a tenth of the gap.

    So near to a surface, contact lets nothing come on its way.
    """
    return any(depth > 0.1 * gap for _, _, depth in core.overlaps())


class _Solve:
    """Least elastic energy under inequalities, of bodies at rest."""

    def __init__(self, core: Any, bodies: slice, loose: float) -> None:
        from scipy.sparse.linalg import splu

        rows = len(core.positions)
        stiffness = sparse(core.stiffness(), 3 * rows) + loose**2 * sparse(
            core.mass_matrix(), 3 * rows
        )
        free = core.free_axes().ravel().copy()
        free[: 3 * bodies.start] = False
        free[3 * bodies.stop :] = False
        self._free = np.flatnonzero(free)
        self._factor = splu(stiffness[self._free][:, self._free].tocsc())

    def displacements(self, rows: Any, bound: Floats, rest: Floats, enough: float) -> Floats:
        """From rest (r, 3), with `rows @ (rest + u) >= bound`."""
        able = rows[:, self._free]
        wanted = bound - rows @ rest.ravel()
        answers = self._factor.solve(np.asarray(able.T.todense(), order="F"))
        between = np.asarray(able @ answers)
        pushes = _complementary(between, wanted, enough)
        moved = np.zeros(rest.size)
        moved[self._free] = np.einsum("nm,m->n", answers, pushes)
        return moved.reshape(rest.shape)


def _complementary(matrix: Floats, wanted: Floats, enough: float) -> Floats:
    """Pushes p >= 0 with `matrix @ p >= wanted`, and 0 where it is more; by Gauss and Seidel.

    Raises:
        ParameterError: a point that nothing can move has to.
    """
    diagonal = matrix.diagonal()
    dead = diagonal <= 1e-12 * diagonal.max(initial=0.0)
    if (wanted[dead] > 0.0).any():
        raise ParameterError("held nodes overlap")
    active = np.flatnonzero(~dead)
    pushes = np.zeros(len(wanted))
    now = np.zeros(len(wanted))
    for _ in range(_SWEEPS):
        most = 0.0
        for i in active:
            push = max(0.0, pushes[i] + (wanted[i] - now[i]) / diagonal[i])
            change = push - pushes[i]
            if change != 0.0:
                pushes[i] = push
                now += change * matrix[:, i]
                most = max(most, abs(change) * diagonal[i])
        if most < enough:
            break
    return pushes
