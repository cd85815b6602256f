"""Surfaces that overlap at the start are pushed apart: `contact: {overlap: separate}`.

Bodies are first moved apart as rigid ones until the exact audit finds no crossing. What holds them
then goes back to its place, step by step, in a world without loads whose contacts keep every way
free of crossings. What remains is an equilibrium of elasticity and contact.
"""

from __future__ import annotations

import dataclasses
import itertools
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tissu.errors import OverlapError, ParameterError, SceneError, TissuError
from tissu.scene.contact import Contact
from tissu.scene.motion import Motion
from tissu.scene.problem import Problem
from tissu.scene.solver import Auto
from tissu.scene.step import ImplicitEuler, Newton
from tissu.scene.support import Fixed, Prescribed

if TYPE_CHECKING:
    from tissu.compile.contact import PreparedContact
    from tissu.compile.obstacle import PreparedObstacle
    from tissu.compile.prepared import Held, Prepared
    from tissu.simulation import Simulation

Floats = NDArray[np.float64]

STEPS = 200
"""steps after which bodies that still move are refused"""
_DT = 1.0
"""s: so long that inertia only holds what nothing else holds"""
_BACK = 40
"""steps in which supports go back, at least"""
_AT_REST = 1e-3
"""of the smallest gap: what nodes may still move in a step"""
_SWEEPS = 8
_LOOKS = 32


class Apart(NamedTuple):
    """Bodies that were pushed apart: positions (n, 3) [m] of each, and what was moved, in words."""

    positions: dict[str, Floats]
    words: str

    def begin(self, simulation: Simulation) -> None:
        """Put the bodies there, at rest."""
        for name, places in self.positions.items():
            simulation.positions[name][:] = places
            simulation.velocities[name][:] = 0.0


def separated(prepared: Prepared, found: OverlapError) -> Apart:
    """Where the bodies of a scene stand without crossings; `found`: what overlaps.

    Raises:
        SceneError: they cannot be pushed apart.
    """
    try:
        _require_nodes_alone(prepared)
        shifts = _Rigid(prepared).shifts()
        return _led_back(prepared, shifts)
    except TissuError as error:
        why = error.problems[0] if isinstance(error, SceneError) else str(error)
        why = why.rstrip(".").removeprefix("found ")
        text = f"found surfaces that overlap at the start: {found.places}; separate could not push "
        problem = Problem(("contacts",), f"{text}them apart: {why}; move one of them")
        raise SceneError([problem.sentence(prepared.scene.source)]) from None


def _require_nodes_alone(prepared: Prepared) -> None:
    contact = _contact(prepared)
    for name in contact.bodies:
        if prepared.scene.bodies[name].start is not None:
            raise ParameterError(f"'{name}' has a start of its own")
        if prepared.has_rotations(name):
            raise ParameterError(f"'{name}' is made of frames, which it does not move")
        if contact.bodies[name].riders is not None:
            raise ParameterError(f"'{name}' has a surface of its own, which it does not move")
    if prepared.tissue:
        raise ParameterError("the scene has tissue between bodies, which it does not move")


def _contact(prepared: Prepared) -> PreparedContact:
    assert prepared.contact is not None
    return prepared.contact


class _Rigid:
    """Moves whole bodies until none cross."""

    def __init__(self, prepared: Prepared) -> None:
        from tissu.compile.world import build_world

        contact = _contact(prepared)
        self._names = [*contact.bodies, *contact.obstacles]
        self._rest = {name: prepared.bodies[name].mesh.points for name in contact.bodies}
        self._anchored = {held.support.body for held in prepared.held}
        self._gap = max(pair.gap for pair in contact.pairs)
        self._normals = {
            name: obstacle.normal
            for name, obstacle in contact.obstacles.items()
            if obstacle.normal is not None
        }
        places = [self._rest[name] for name in contact.bodies]
        solid = [one.surface.vertices for one in contact.obstacles.values() if one.surface]
        self._size = float(np.linalg.norm(np.ptp(np.vstack([*places, *solid]), axis=0)))
        self._core = _core_of(build_world(prepared, overlap=True))
        self._shifts = {name: np.zeros(3) for name in self._rest}

    def shifts(self) -> dict[str, Floats]:
        """Of each body, the displacement [m] with which nothing crosses.

        Raises:
            ParameterError: it was not found.
        """
        for _ in range(_SWEEPS):
            crossing = self._crossing(self._shifts)
            if not crossing:
                return self._shifts
            for a, b in sorted(crossing):
                if a == b:
                    raise ParameterError(f"'{a}' crosses itself")
                self._part(a, b)
        names = " and ".join(f"'{name}'" for name in sorted({*itertools.chain(*crossing)}))
        raise ParameterError(f"{names} cross wherever they are moved as a whole")

    def _crossing(self, shifts: dict[str, Floats]) -> set[tuple[str, str]]:
        for name, rest in self._rest.items():
            first, count = self._core.body_range(name)
            self._core.positions[first : first + count] = rest + shifts[name]
        pairs = ((self._names[a], self._names[b]) for a, _, b, _ in self._core.crossings())
        return {(min(pair), max(pair)) for pair in pairs}

    def _part(self, a: str, b: str) -> None:
        """Move two surfaces apart on the shortest of some ways."""
        soft = [name for name in (a, b) if name in self._rest]
        free = [name for name in soft if name not in self._anchored]
        movers = free if free else soft
        best: tuple[float, Floats] | None = None
        for way in self._ways(a, b):
            length = self._length(a, b, movers, way, np.inf if best is None else best[0])
            if length is not None:
                best = (length, way)
        if best is None:
            raise ParameterError(f"'{a}' and '{b}' cross wherever they are moved as a whole")
        self._shifts = self._moved(a, movers, best[1] * (best[0] + 2.0 * self._gap))

    def _ways(self, a: str, b: str) -> list[Floats]:
        """Directions of the first from the second: the normal of a plane, or 26 of a cube."""
        for name, sign in ((a, -1.0), (b, 1.0)):
            if name in self._normals:
                return [sign * np.asarray(self._normals[name])]
        ways = [np.array(w, float) for w in itertools.product((0, 1, -1), repeat=3) if any(w)]
        ways.sort(key=lambda way: float(np.abs(way).sum()))
        if a in self._rest and b in self._rest:
            between = (self._rest[a] + self._shifts[a]).mean(axis=0)
            ways.append(between - (self._rest[b] + self._shifts[b]).mean(axis=0))
        return [way / np.linalg.norm(way) for way in ways if np.linalg.norm(way) > 0.0]

    def _moved(self, a: str, movers: list[str], by: Floats) -> dict[str, Floats]:
        shifts = dict(self._shifts)
        for name in movers:
            shifts[name] = shifts[name] + (by if name == a else -by) / len(movers)
        return shifts

    def _length(self, a: str, b: str, movers: list[str], way: Floats, most: float) -> float | None:
        """How far [m] they must go, seen from far away; None: not below `most`."""

        def meet(length: float) -> bool:
            return (a, b) in self._crossing(self._moved(a, movers, way * length))

        if np.isfinite(most) and meet(most):
            return None
        high = min(most, self._size)
        low = high
        for k in range(_LOOKS - 1, -1, -1):
            low = high_start = min(most, self._size) * k / _LOOKS
            if meet(low):
                break
            high = high_start
        for _ in range(12):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if meet(middle) else (low, middle)
        return high if high < most else None


class _Still(NamedTuple):
    """Where a motion begins."""

    motion: Motion

    def in_core(self) -> Any:
        times, moves, angles, center, axis = self.motion.in_core()
        at = [np.interp(0.0, times, moves[:, axis_]) for axis_ in range(3)]
        return np.zeros(1), np.array([at]), np.interp([0.0], times, angles), center, axis


def _led_back(prepared: Prepared, shifts: dict[str, Floats]) -> Apart:
    """Supports go back by steps, then all comes to rest."""
    from tissu.compile.world import world_of

    contact = _contact(prepared)
    edge = min(surface.mean_edge for surface in contact.bodies.values())
    way = max((float(np.linalg.norm(shift)) for shift in shifts.values()), default=0.0)
    back = max(_BACK, int(np.ceil(way / (0.25 * edge))))
    if back > STEPS // 2:
        raise ParameterError(
            f"the way back, {way:.3g} m, is longer than {STEPS // 2} quarters of an edge"
        )
    core = _core_of(world_of(_apart(prepared, shifts, back * _DT)))
    gap = min(pair.gap for pair in contact.pairs)
    bodies = slice(0, sum(body.mesh.node_count for body in prepared.bodies.values()))
    for number in range(STEPS):
        before = core.positions[bodies].copy()
        core.velocities[:] = 0.0
        core.step(_DT)
        moved = float(np.abs(core.positions[bodies] - before).max())
        if number >= back and moved < _AT_REST * gap:
            break
    else:
        raise ParameterError(f"they do not come to rest within {STEPS} steps")
    if core.crossings() or core.overlaps():
        raise ParameterError("they still cross")
    positions, told = {}, []
    for name in contact.bodies:
        if len(core.inverted_cells(name)):
            raise ParameterError(f"cells of '{name}' would be inside out")
        first, count = core.body_range(name)
        rest = prepared.bodies[name].mesh.points
        positions[name] = np.array(core.positions[first : first + count])
        far = float(np.linalg.norm(positions[name][: len(rest)] - rest, axis=1).max())
        told.append(f"'{name}' by at most {far:.3g} m")
    return Apart(positions, "contact.overlap: pushed apart at the start: " + ", ".join(told))


def _apart(prepared: Prepared, shifts: dict[str, Floats], over: float) -> Prepared:
    """The scene with bodies moved, no loads, and supports that go back until a time [s]."""
    contact = _contact(prepared)
    bodies = dict(prepared.bodies)
    for name, by in shifts.items():
        mesh = dataclasses.replace(bodies[name].mesh, points=bodies[name].mesh.points + by)
        bodies[name] = dataclasses.replace(bodies[name], mesh=mesh)
    held = [_back(one, shifts.get(one.support.body, np.zeros(3)), over) for one in prepared.held]
    plain = Contact("all")
    settings = contact.settings.model_copy(update={"penalty": "linear", "travel": True})
    made = dataclasses.replace(
        contact,
        method="augmented",
        settings=settings,
        obstacles={name: _held(one) for name, one in contact.obstacles.items()},
        pairs=[pair._replace(contact=plain) for pair in contact.pairs if _soft(contact, pair)],
    )
    update: dict[str, Any] = {"gravity": None, "instruments": {}, "editing": None, "tear": ()}
    scene = prepared.scene.model_copy(update=update)
    return dataclasses.replace(
        prepared, scene=scene, bodies=bodies, held=held, loaded=[], contact=made
    )


def _soft(contact: PreparedContact, pair: Any) -> bool:
    return pair.a in contact.bodies or pair.b in contact.bodies


def _held(one: PreparedObstacle) -> PreparedObstacle:
    """An obstacle that stays where it begins."""
    motion: Any = None if one.motion is None else _Still(one.motion)
    return one._replace(motion=motion, rigid=None)


def _back(held: Held, by: Floats, over: float) -> Held:
    """A support that brings its nodes back."""
    support = held.support
    assert isinstance(support, (Fixed, Prescribed))
    path = Prescribed(
        support.body,
        on=support.on,
        axes=support.axes,
        times=(0.0, over),
        displacements=((0.0, 0.0, 0.0), tuple(-by)),
    )
    return dataclasses.replace(held, support=path)


def _core_of(world: Any) -> Any:
    """A simulation of a world, in long steps to the tolerance of Newton's method."""
    from tissu import _core

    step = ImplicitEuler(_DT, newton=Newton(iterations=20))
    solver = Auto().linear_solver(equilibrium=False)
    return _core.Simulation(world=world, integrator=step.integrator(), solver=solver)
