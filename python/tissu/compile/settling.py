"""Bodies that press on each other come to rest: implicit steps from standstill, each as long as goes."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from tissu.errors import ParameterError
from tissu.scene.contact import Contact
from tissu.scene.motion import Motion
from tissu.scene.support import Fixed, Prescribed

if TYPE_CHECKING:
    from tissu.compile.obstacle import PreparedObstacle
    from tissu.compile.prepared import Floats, Held, Prepared

_BALANCE = 1e-2
"""of the contact forces: the sum of all forces on nodes that nothing balances"""
_AT_REST = 1e-3
"""of the smallest gap: what nodes may still move in a step where nothing presses"""
_SHORTEST, _LONGEST = 1.0 / 64, 4.0
"""of the time that a wave needs to pass through: steps"""


class Rest(NamedTuple):
    """How bodies came to rest: steps, contact forces in sum and what of them is not balanced [N]."""

    steps: int
    pressing: float
    unbalanced: float


def settle(core: Any, *, bodies: slice, crossing: float, gap: float, most: int) -> Rest:
    """Steps without speed until forces balance each other; each leaves M (x1 - x0)/dt^2 of them.

    Raises:
        ParameterError: they do not, within so many steps.
    """
    masses = np.zeros(len(core.positions))
    rows, _, blocks = core.mass_matrix()
    np.add.at(masses, rows, blocks[:, 0, 0])
    free = core.free_axes()
    dt = 0.125 * crossing
    left = pressing = np.inf
    for number in range(1, most + 1):
        before = core.positions.copy()
        core.velocities[:] = 0.0
        core.time = 0.0
        report = core.step(dt)
        moved = np.where(free, core.positions - before, 0.0)[bodies]
        far = float(np.linalg.norm(moved, axis=1).max())
        left = float((masses[bodies] * np.linalg.norm(moved, axis=1)).sum()) / dt**2
        pressing = float(np.linalg.norm(core.contacts()[6], axis=1).sum())
        import os
        if os.environ.get("SHOW"): print(number, f"dt {dt/crossing:.3f} far/gap {far/gap:.3g} left {left:.3g} pressing {pressing:.3g}", report.converged, report.message, report.contacts, report.milliseconds)
        if dt >= 0.1 * crossing:
            if left <= _BALANCE * pressing or far <= _AT_REST * gap:
                return Rest(number, pressing, left)
        dt = min(dt * 1.5, float(os.environ.get("CAP", "1")) * crossing)
    raise ParameterError(
        f"forces of {left:.3g} N are still without balance, beside {pressing:.3g} N of contact, "
        f"after {most} steps"
    )


def unloaded(prepared: Prepared) -> Prepared:
    """The scene without loads, friction and viscosity, whose supports and obstacles stay."""
    contact = prepared.contact
    assert contact is not None
    settings = contact.settings.model_copy(update={"penalty": "linear", "travel": True})
    made = dataclasses.replace(
        contact,
        method="augmented",
        settings=settings,
        obstacles={name: _held(one) for name, one in contact.obstacles.items()},
        pairs=[
            pair._replace(contact=Contact("all"))
            for pair in contact.pairs
            if pair.a in contact.bodies or pair.b in contact.bodies
        ],
    )
    bodies = {
        name: body.model_copy(update={"viscosity": None})
        for name, body in prepared.scene.bodies.items()
    }
    update: dict[str, Any] = {"gravity": None, "instruments": {}, "editing": None, "tear": ()}
    scene = prepared.scene.model_copy(update=update | {"bodies": bodies})
    held = [_still(one) for one in prepared.held]
    return dataclasses.replace(prepared, scene=scene, held=held, loaded=[], contact=made)


class _Still(NamedTuple):
    """Where a motion begins."""

    motion: Motion

    def in_core(self) -> Any:
        times, moves, angles, center, axis = self.motion.in_core()
        at = [np.interp(0.0, times, moves[:, axis_]) for axis_ in range(3)]
        return np.zeros(1), np.array([at]), np.interp([0.0], times, angles), center, axis


def _held(one: PreparedObstacle) -> PreparedObstacle:
    """An obstacle that stays where it begins."""
    motion: Any = None if one.motion is None else _Still(one.motion)
    return one._replace(motion=motion, rigid=None)


def _still(held: Held) -> Held:
    """A support that holds its nodes at rest."""
    support = held.support
    assert isinstance(support, (Fixed, Prescribed))
    return dataclasses.replace(held, support=Fixed(support.body, on=support.on, axes=support.axes))
