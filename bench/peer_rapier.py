"""Rapier's soft bodies with its FEM solver, for bench/peers.py."""

from __future__ import annotations

import numpy as np
from peer_work import GRAVITY, POISSON, SOFT, YOUNG, Facts, Work

WAYS = {
    "defaults": Facts(
        "corotational",
        "its defaults: four substeps of 2.5 ms, 20 iterations at most, single precision",
        "double precision in this package, elements other than linear tetrahedra, laws other than "
        "corotational and neo-Hookean; it does not say whether a solve has converged",
    ),
    "dropped": Facts("corotational", "its defaults, elastic damping included; in decimetres"),
}
UNIT = (
    10.0  # decimetres in a metre: it gives no elasticity to a cube as small as this one in metres
)
RADIUS = 0.01 / UNIT  # m, its default thickness of particles


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

    def seen(self) -> list[float]:
        """Of the free end [m]."""
        return self._work.tip(self._world.soft_bodies[self._body].particle_positions)

    def unsolved(self) -> int | None:
        """It does not say."""
        return None


class Cube:
    """A world with the cube, lengths in decimetres, above a plane unless it only falls."""

    def __init__(self, work: Work, way: str) -> None:
        """`way` is "dropped" or "falling"."""
        import rapier3d as rp

        self._dt = work.dt
        self._world = rp.PhysicsWorld(gravity=(0.0, 0.0, -GRAVITY * UNIT))
        self._world.integration_parameters.dt = work.dt
        body = (
            rp.SoftBodyBuilder(work.points * UNIT)
            .cells(work.tetrahedra)
            .solver(rp.SoftBodySolver.FEM)
            .cell_model(rp.SoftBodyCellModel.COROTATIONAL)
            .material(rp.SoftBodyMaterial(young_modulus=SOFT / UNIT, poisson_ratio=POISSON))
            .masses(work.masses.tolist())
            .particle_radius(RADIUS * UNIT)
            .can_sleep(False)
        )
        self._body = self._world.add_soft_body(body)
        self._plane = None
        if way == "dropped":
            self._plane = self._world.add_collider(rp.Collider.halfspace((0.0, 0.0, 1.0)))

    def step(self) -> None:
        """One of dt."""
        self._world.step()

    def seen(self) -> list[float]:
        """Depth of the lowest node beyond the radius [m], and what the plane carries [N]."""
        if self._plane is None:
            return [0.0, 0.0]
        lowest = float(np.min(self._world.soft_bodies[self._body].particle_positions[:, 2])) / UNIT
        pairs = self._world.narrow_phase.contact_pairs_with(self._plane)
        impulse = sum(pair.total_impulse_magnitude() for pair in pairs)
        return [max(0.0, RADIUS - lowest), float(impulse) / self._dt / UNIT]

    def unsolved(self) -> int | None:
        """It does not say."""
        return None


def make(work: Work, way: str) -> Bar | Cube:
    """The bar, or the cube."""
    return Bar(work, way) if way == "defaults" else Cube(work, way)
