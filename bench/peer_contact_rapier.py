"""Rapier's soft bodies on a plane and on each other, for bench/contact_peers.py."""

from __future__ import annotations

import numpy as np
from peer_contact_work import GAP, POISSON, YOUNG, Audit, Bodies, split
from peer_rapier import UNIT, version
from peer_work import Facts, Work

__all__ = ["WAYS", "make", "version"]
LAW = "corotational"
WAYS = {
    "defaults": Facts(
        LAW,
        "FEM solver, else its defaults: four substeps, 20 iterations at most, thickness of 1 mm",
    ),
    "best": Facts(
        LAW,
        "thickness of 2 % of a mean edge, 200 iterations at most, a dense factor up to 1,200 "
        "degrees of freedom, 20 additional PGS iterations",
    ),
}
RADIUS = 1e-3  # m, its default thickness of particles in decimetres
ITERATIONS, DENSE, PASSES = 200, 1200, 20  # at the best settings


class World:
    """A world with the bodies, lengths in decimetres."""

    def __init__(self, work: Work, way: str) -> None:
        """`way` is "SCENE; SETTINGS"."""
        import rapier3d as rp

        setup, settings = split(way)
        bodies, best = Bodies(work, setup), settings == "best"
        radius = GAP * bodies.edge if best else RADIUS
        self._audit = Audit(bodies, setup, work.dt, thickness=(radius, 2.0 * radius))
        self._dt = work.dt
        self._world = world = rp.PhysicsWorld(gravity=tuple(UNIT * g for g in setup.gravity))
        world.integration_parameters.dt = work.dt
        if best:
            fem = world.integration_parameters.soft_bodies.fem
            fem.max_linear_iterations, fem.max_dense_dofs = ITERATIONS, DENSE
        self._handles = []
        for points, masses in zip(bodies.points, bodies.masses, strict=True):
            body = (
                rp.SoftBodyBuilder(points * UNIT)
                .cells(bodies.tetrahedra)
                .solver(rp.SoftBodySolver.FEM)
                .cell_model(rp.SoftBodyCellModel.COROTATIONAL)
                .material(rp.SoftBodyMaterial(young_modulus=YOUNG / UNIT, poisson_ratio=POISSON))
                .masses(masses.tolist())
                .linear_damping(setup.damping[0])
                .particle_radius(radius * UNIT)
                .surface_collider(rp.Collider.ball(1.0).friction(setup.friction))
                .can_sleep(False)
            )
            if best:
                body = body.additional_pgs_iterations(PASSES)
            self._handles.append(world.add_soft_body(body))
        plane = rp.Collider.halfspace((0.0, 0.0, 1.0)).friction(setup.friction)
        self._plane = world.add_collider(plane)

    def step(self) -> None:
        """10 ms."""
        self._world.step()

    def seen(self) -> list[float]:
        """As Audit.seen says."""
        pairs = list(self._world.narrow_phase.contact_pairs_with(self._plane))
        up = float(sum(pair.total_impulse_magnitude() for pair in pairs)) / self._dt / UNIT
        touches = any(pair.has_any_active_contact for pair in pairs)
        places = [self._world.soft_bodies[h].particle_positions for h in self._handles]
        return self._audit.seen(np.stack(places) / UNIT, touches, up)

    def unsolved(self) -> int | None:
        """It does not say."""
        return None


def make(work: Work, way: str) -> World:
    """The scene."""
    return World(work, way)
