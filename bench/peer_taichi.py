"""A textbook's explicit step in Taichi, for bench/peers.py."""

from __future__ import annotations

from typing import Any

import numpy as np
from peer_work import GRAVITY, POISSON, YOUNG, Facts, Work

WAYS = {
    "explicit": Facts(
        "St-Venant–Kirchhoff",
        "symplectic Euler in kernels of ours, double precision",
        "it is a language for kernels. Its users write elements, laws and solvers, and it has no "
        "implicit step of its own",
    ),
}
LAMBDA = YOUNG * POISSON / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON))
MU = YOUNG / (2.0 * (1.0 + POISSON))


def version() -> str:
    """Of the package."""
    from importlib.metadata import version as of

    return of("taichi")


class Bar:
    """Fields of the bar and the two kernels of a step."""

    def __init__(self, work: Work, way: str) -> None:
        """`way` is one of WAYS."""
        import taichi as ti

        del way
        ti.init(arch=ti.cpu, cpu_max_num_threads=1, offline_cache=False, default_fp=ti.f64)
        self._ti, self._work = ti, work
        nodes, cells = len(work.points), len(work.tetrahedra)
        self._x, self._v, self._f = (ti.Vector.field(3, ti.f64, nodes) for _ in range(3))
        mass, free = ti.field(ti.f64, nodes), ti.field(ti.i32, nodes)
        of, volume = ti.Vector.field(4, ti.i32, cells), ti.field(ti.f64, cells)
        inverse = ti.Matrix.field(3, 3, ti.f64, cells)
        corners = work.points[work.tetrahedra]
        edges = np.swapaxes(corners[:, 1:] - corners[:, :1], 1, 2)
        is_free = np.ones(nodes, dtype=np.int32)
        is_free[work.held] = 0
        for field, values in (
            (self._x, work.points), (mass, work.masses), (free, is_free), (volume, work.volumes),
            (of, work.tetrahedra.astype(np.int32)), (inverse, np.linalg.inv(edges)),
        ):  # fmt: skip
            field.from_numpy(np.ascontiguousarray(values))
        self._force = _force(ti, self._x, self._f, mass, of, volume, inverse)
        self._move = _move(ti, self._x, self._v, self._f, mass, free, work.dt)

    def step(self) -> None:
        """One of dt."""
        self._force()
        self._move()
        self._ti.sync()

    def seen(self) -> list[float]:
        """Of the free end [m]."""
        return self._work.tip(self._x.to_numpy())

    def unsolved(self) -> int | None:
        """Nothing is solved."""
        return 0


def _force(ti: Any, x: Any, f: Any, mass: Any, of: Any, volume: Any, inverse: Any) -> Any:
    """The force, weight - sum_e V P B^T: P = F (lambda tr(E) I + 2 mu E), B the inverse edges."""

    @ti.kernel
    def force():
        for i in f:
            f[i] = ti.Vector([0.0, 0.0, -GRAVITY]) * mass[i]
        for e in of:
            a = of[e]
            p = x[a[0]]
            F = ti.Matrix.cols([x[a[1]] - p, x[a[2]] - p, x[a[3]] - p]) @ inverse[e]
            I = ti.Matrix.identity(ti.f64, 3)  # noqa: E741
            E = 0.5 * (F.transpose() @ F - I)
            P = F @ (LAMBDA * E.trace() * I + 2.0 * MU * E)
            H = -volume[e] * P @ inverse[e].transpose()
            rest = ti.Vector([0.0, 0.0, 0.0])
            for k in ti.static(range(3)):
                g = ti.Vector([H[0, k], H[1, k], H[2, k]])
                f[a[k + 1]] += g
                rest -= g
            f[a[0]] += rest

    return force


def _move(ti: Any, x: Any, v: Any, f: Any, mass: Any, free: Any, dt: float) -> Any:
    """Velocities first, v += dt f / m, then places, x += dt v."""

    @ti.kernel
    def move():
        for i in x:
            if free[i] == 1:
                v[i] += dt * f[i] / mass[i]
                x[i] += dt * v[i]

    return move


make = Bar
