"""tissu, for bench/peers.py."""

from __future__ import annotations

from typing import Any

from peer_work import DENSITY, GRAVITY, POISSON, SOFT, STIFFNESS_DAMPING, YOUNG, Facts, Work

LAW = "St-Venant–Kirchhoff"
WAYS = {
    "all defaults": Facts(LAW, "backward Euler of 10 ms, linearised once, solved to 1e-5"),
    "tolerance 1e-6": Facts(LAW, "the same, solved to 1e-6"),
    "four steps of 2.5 ms": Facts(LAW, "all defaults, four steps for one of the others"),
    "BDF2": Facts(LAW, "BDF2 of 10 ms, else all defaults"),
    "explicit": Facts(LAW, "symplectic Euler, double precision"),
    "dropped": Facts(LAW, "all defaults"),
}


def version() -> str:
    """Of the package."""
    import tissu

    return tissu.__version__


class Bar:
    """A simulation of the bar."""

    def __init__(self, work: Work, way: str) -> None:
        """`way` is one of WAYS, or "reference", which iterates every step to 1e-8."""
        import tissu as ts

        self._work = work
        self._parts = 4 if way == "four steps of 2.5 ms" else 1
        self._unsolved = 0
        steps: dict[str, Any] = {
            "tolerance 1e-6": ts.ImplicitEuler(work.dt, solver=ts.Auto(tolerance=1e-6)),
            "BDF2": ts.BDF2(work.dt),
            "explicit": ts.SymplecticEuler(work.dt),
            "reference": ts.BDF2(
                work.dt,
                newton=ts.Newton(iterations=20, tolerance=1e-8),
                solver=ts.Auto(tolerance=1e-8),
            ),
        }
        mesh = ts.Mesh(points=work.points, cells=(ts.CellBlock("tetra", work.tetrahedra),))
        law = ts.StVK(young=YOUNG, poisson=POISSON)
        self._simulation = ts.Scene(
            bodies={"bar": ts.Body(mesh=mesh, law=law, density=DENSITY)},
            gravity=(0, 0, -GRAVITY),
            fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
            step=steps.get(way, ts.ImplicitEuler(work.dt / self._parts)),
        ).compile()

    def step(self) -> None:
        """One of dt."""
        for _ in range(self._parts):
            self._unsolved += not self._simulation.step().converged

    def seen(self) -> list[float]:
        """Of the free end [m]."""
        return self._work.tip(self._simulation.positions["bar"])

    def unsolved(self) -> int | None:
        """Steps that did not converge."""
        return self._unsolved


class Cube:
    """The cube, above a plane or with nothing below it."""

    def __init__(self, work: Work, way: str) -> None:
        """`way` is "dropped", or "falling" for ever."""
        import tissu as ts

        self._falls = way == "falling"
        met: dict[str, Any] = {
            "obstacles": {"plane": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
            "contacts": [ts.Contact("all")],
        }
        body = ts.Body(
            mesh=ts.Mesh(points=work.points, cells=(ts.CellBlock("tetra", work.tetrahedra),)),
            law=ts.StVK(young=SOFT, poisson=POISSON),
            density=DENSITY,
            viscosity=ts.Rayleigh(mass=0.0, stiffness=STIFFNESS_DAMPING),
        )
        self._simulation = ts.Scene(
            bodies={"cube": body},
            gravity=(0, 0, -GRAVITY),
            step=ts.ImplicitEuler(work.dt),
            **({} if self._falls else met),
        ).compile()
        self._unsolved = 0

    def step(self) -> None:
        """One of dt."""
        self._unsolved += not self._simulation.step().converged

    def seen(self) -> list[float]:
        """Depth in the gap [m], and what the plane carries [N]."""
        if self._falls:
            return [0.0, 0.0]
        gaps = self._simulation.contacts().gaps
        return [
            max(0.0, -float(gaps.min(initial=0.0))),
            -float(self._simulation.force_on("plane").force[2]),
        ]

    def unsolved(self) -> int | None:
        """Steps that did not converge."""
        return self._unsolved


def make(work: Work, way: str) -> Bar | Cube:
    """The bar, or the cube."""
    return Cube(work, way) if way in ("dropped", "falling") else Bar(work, way)
