"""Rapier's soft bodies with its FEM solver, for bench/peers.py."""

from __future__ import annotations

from peer_work import GRAVITY, POISSON, YOUNG, Facts, Work

WAYS = {
    "defaults": Facts(
        "corotational",
        "its defaults: four substeps of 2.5 ms, 20 iterations at most, single precision",
        "double precision in this package, elements other than linear tetrahedra, laws other than "
        "corotational and neo-Hookean; it does not say whether a solve has converged",
    ),
}


def version() -> str:
    """Of the package."""
    from importlib.metadata import version as of

    return of("rapier3d")


class Bar:
    """A world with the bar."""

    def __init__(self, work: Work, way: str) -> None:
        """`way` is one of WAYS."""
        import rapier3d as rp

        del way
        self._work = work
        self._world = rp.PhysicsWorld(gravity=(0.0, 0.0, -GRAVITY))
        self._world.integration_parameters.dt = work.dt
        material = rp.SoftBodyMaterial(
            young_modulus=YOUNG, poisson_ratio=POISSON, elastic_damping_ratio=0.0
        )
        body = (
            rp.SoftBodyBuilder(work.points)
            .cells(work.tetrahedra)
            .solver(rp.SoftBodySolver.FEM)
            .cell_model(rp.SoftBodyCellModel.COROTATIONAL)
            .material(material)
            .masses(work.masses.tolist())
            .pinned_particles(work.held.tolist())
            .skin_collision(False)
            .can_sleep(False)
        )
        self._body = self._world.add_soft_body(body)

    def step(self) -> None:
        """One of dt."""
        self._world.step()

    def tip(self) -> list[float]:
        """Of the free end [m]."""
        return self._work.tip(self._world.soft_bodies[self._body].particle_positions)

    def unsolved(self) -> int | None:
        """It does not say."""
        return None


make = Bar
