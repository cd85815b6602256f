"""Bodies that press on each other come to rest, by implicit steps from standstill."""

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
_FIRST, _GROWTH, _LONGEST = 0.125, 1.5, 4.0
"""lengths of steps, of the time that a wave needs to pass through: bodies that start far from
equilibrium need inertia, and those near to it do not"""


class Rest(NamedTuple):
    """How bodies came to rest: steps, contact forces in sum, what of them has no balance [N]."""

    steps: int
    pressing: float
    unbalanced: float


def settle(core: Any, *, bodies: slice, crossing: float, gap: float, most: int) -> Rest:
    """Steps that begin without speed, until elastic and contact forces balance each other.

    `crossing`: the time that a wave needs to pass through [s]; `gap`: the smallest one [m].

    Raises:
        ParameterError: they do not, within `most` steps.
    """
    free = core.free_axes()
    dt = _FIRST * crossing
    left = pressing = np.inf
    for number in range(1, most + 1):
        before = core.positions.copy()
        core.velocities[:] = 0.0
        core.time = 0.0
        core.step(dt)
        core.velocities[:] = 0.0
        far = _lengths(core.positions - before, free, bodies).max()
        left = float(_lengths(core.forces(), free, bodies).sum())
        pressing = float(np.linalg.norm(core.contacts()[6], axis=1).sum())
        if dt >= crossing and (left <= _BALANCE * pressing or far <= _AT_REST * gap):
            return Rest(number, pressing, left)
        dt = min(_GROWTH * dt, _LONGEST * crossing)
    raise ParameterError(
        f"forces of {left:.3g} N are still without balance, beside {pressing:.3g} N of contact, "
        f"after {most} steps"
    )


def _lengths(vectors: Floats, free: Any, bodies: slice) -> Floats:
    """Of the unknowns of nodes."""
    return np.asarray(np.linalg.norm(np.where(free, vectors[: len(free)], 0.0)[bodies], axis=1))


def unloaded(prepared: Prepared) -> Prepared:
    """The scene without loads, friction and viscosity, whose supports and obstacles stay."""
    contact = prepared.contact
    assert contact is not None
    settings = contact.settings.model_copy(
        update={"penalty": "linear", "travel": True, "iterations": 3}
    )
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
