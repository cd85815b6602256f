"""Newton's vertex block descent (VBD) on the CPU, for bench/contact_peers.py."""

from __future__ import annotations

from typing import Any

import numpy as np
from peer_contact_work import GAP, POISSON, YOUNG, Audit, Bodies, split
from peer_work import DENSITY, Facts, Work

__all__ = ["WAYS", "make", "version"]
LAW = "neo-Hooke"
GIVEN = "VBD on the CPU, thickness of 2 % of a mean edge"
MU = YOUNG / (2.0 * (1.0 + POISSON))  # Pa, Lamé's
LAMBDA = YOUNG * POISSON / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON))
STIFF = 1e5  # N/m, of a contact at the best settings; its default is 1e3
SLOW = 1e-3  # m/s, below which friction grows with the speed; its default is 0.01
STEPS = {"defaults": 1, "best": 10}
ITERATIONS = 20  # at the best settings
WAYS = {
    "defaults": Facts(LAW, f"{GIVEN}, else its defaults: steps of 10 ms, contacts of 1 kN/m"),
    "best": Facts(
        LAW,
        f"{GIVEN}, ten steps of 1 ms, 20 iterations each, contacts of {STIFF / 1e3:g} kN/m, "
        f"`friction_epsilon={SLOW}`",
    ),
}


def version() -> str:
    """Of the package."""
    from importlib.metadata import version as of

    return of("newton")


class Model:
    """A model of the bodies and its two states."""

    def __init__(self, work: Work, way: str) -> None:
        """`way` is "SCENE; SETTINGS"."""
        import newton
        import warp as wp

        wp.set_device("cpu")
        setup, settings = split(way)
        bodies = Bodies(work, setup)
        self._radius = radius = GAP * bodies.edge
        self._audit = Audit(bodies, setup, work.dt, thickness=(radius, radius))
        self._parts = STEPS[settings]
        self._dt = work.dt / self._parts
        builder = newton.ModelBuilder(gravity=setup.gravity)
        for points in bodies.points:
            builder.add_soft_mesh(
                pos=wp.vec3(0.0, 0.0, 0.0),
                rot=wp.quat_identity(),
                scale=1.0,
                vel=wp.vec3(0.0, 0.0, 0.0),
                vertices=[wp.vec3(*map(float, point)) for point in points],
                indices=bodies.tetrahedra.ravel().tolist(),
                density=DENSITY,
                k_mu=MU,
                k_lambda=LAMBDA,
                k_damp=setup.damping[1] * MU,
                particle_radius=radius,
            )
        builder.add_ground_plane(cfg=newton.ModelBuilder.ShapeConfig(mu=setup.friction))
        builder.color()
        self._model = builder.finalize()
        self._model.soft_contact_mu = setup.friction
        given: dict[str, Any] = {}
        if settings == "best":
            self._model.soft_contact_ke = STIFF
            given |= {"iterations": ITERATIONS, "friction_epsilon": SLOW}
        if setup.bodies > 1:
            given |= {
                "particle_enable_self_contact": True,
                "particle_self_contact_radius": radius,
                "particle_self_contact_margin": 2.0 * radius,
            }
        self._solver = newton.solvers.SolverVBD(self._model, **given)
        self._pipeline = newton.CollisionPipeline(self._model)
        self._contacts = self._pipeline.contacts()
        self._states = [self._model.state(), self._model.state()]
        self._control = self._model.control()

    def step(self) -> None:
        """10 ms."""
        for _ in range(self._parts):
            now, then = self._states
            now.clear_forces()
            self._pipeline.collide(now, self._contacts)
            self._solver.step(now, then, self._control, self._contacts, self._dt)
            self._states.reverse()

    def seen(self) -> list[float]:
        """As Audit.seen says; it reports no force on a plane."""
        places = np.array(self._states[0].particle_q.numpy())
        return self._audit.seen(places, bool(places[:, 2].min() < self._radius), 0.0)

    def unsolved(self) -> int | None:
        """It does not say."""
        return None


def make(work: Work, way: str) -> Model:
    """The scene."""
    return Model(work, way)
