"""MuJoCo's flex on a plane and on itself, for bench/contact_peers.py."""

from __future__ import annotations

import numpy as np
from peer_contact_work import GAP, POISSON, YOUNG, Audit, Bodies, Setup, split
from peer_mujoco import Flex, numbers, version
from peer_work import Facts, Work

__all__ = ["WAYS", "make", "version"]
LAW = "St-Venant–Kirchhoff in squared edge lengths"
STIFF = 'solref="0.002 1" solimp="0.999 0.9999 1e-4"'
GIVEN = "`discrete` integrator, radius of 2 % of a mean edge"
WAYS = {
    "defaults": Facts(LAW, f"{GIVEN}, else its defaults: steps of 10 ms, pyramids for friction"),
    "best": Facts(
        LAW,
        f'{GIVEN}, five steps of 2 ms, `cone="elliptic" impratio="10"`, `{STIFF}`, '
        '`condim="1"` without friction',
    ),
}
STEPS = {"defaults": 1, "best": 5}
OPTIONS = {"defaults": "", "best": 'cone="elliptic" impratio="10"'}
CONTACTS = {"defaults": "", "best": STIFF}


def model(work: Work, bodies: Bodies, setup: Setup, settings: str) -> str:
    """The scene in MJCF: a flex for each body, a plane."""
    contact = f'friction="{setup.friction!r} 0.005 0.0001" {CONTACTS[settings]}'
    if settings == "best" and setup.friction == 0.0:
        contact += ' condim="1"'
    parts = "".join(
        f"""<flexcomp name="body{k}" type="direct" dim="3" radius="{GAP * bodies.edge!r}"
 mass="{float(bodies.masses[k].sum())!r}" point={numbers(points)}
 element={numbers(bodies.tetrahedra)}>
<elasticity young="{YOUNG!r}" poisson="{POISSON!r}" damping="{setup.damping[1]!r}"/>
<contact selfcollide="none" {contact}/></flexcomp>"""
        for k, points in enumerate(bodies.points)
    )
    gravity = " ".join(map(repr, setup.gravity))
    return f"""<mujoco><option timestep="{work.dt / STEPS[settings]!r}" integrator="discrete"
 gravity="{gravity}" {OPTIONS[settings]}><flag autoreset="disable"/></option>
<worldbody><geom type="plane" size="1 1 1" {contact}/>{parts}</worldbody></mujoco>"""


class Flexes(Flex):
    """A model of the bodies and its state."""

    def __init__(self, work: Work, way: str) -> None:
        """`way` is "SCENE; SETTINGS"."""
        setup, settings = split(way)
        bodies = Bodies(work, setup)
        radius = GAP * bodies.edge
        text = model(work, bodies, setup, settings)
        super().__init__(work, text, bodies.masses.ravel(), setup.damping[0])
        self._parts = STEPS[settings]
        self._audit = Audit(bodies, setup, work.dt, thickness=(radius, 2.0 * radius))

    def step(self) -> None:
        """10 ms."""
        for _ in range(self._parts):
            super().step()

    def seen(self) -> list[float]:
        """As Audit.seen says."""
        force, up = np.zeros(6), 0.0
        for number, contact in enumerate(self._data.contact[: self._data.ncon]):
            if contact.geom[0] >= 0 or contact.geom[1] >= 0:
                self._mujoco.mj_contactForce(self._model, self._data, number, force)
                up += float(force[0])  # along the contact's normal
        return self._audit.seen(self._places(), self._data.ncon > 0, up)


def make(work: Work, way: str) -> Flexes:
    """The scene."""
    return Flexes(work, way)
