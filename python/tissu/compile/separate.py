"""Surfaces that overlap at the start are pushed apart: `contact: {overlap: separate}`.

First a linear problem of elasticity deforms the bodies until the exact audit finds no crossing.
Then contact, which allows none from there on, brings them to rest in a world without loads. What
remains is an equilibrium of elasticity and contact.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tissu.counted import counted
from tissu.errors import OverlapError, ParameterError, SceneError, TissuError
from tissu.scene.problem import Problem
from tissu.scene.solver import Auto
from tissu.scene.step import ImplicitEuler, Newton

if TYPE_CHECKING:
    from tissu.compile.contact import PreparedContact
    from tissu.compile.prepared import Prepared
    from tissu.simulation import Simulation

Floats = NDArray[np.float64]

STEPS = 200
"""looks and steps after which bodies that do not rest are refused"""


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
        _require_solids(prepared)
        return _pushed_apart(prepared)
    except TissuError as error:
        why = error.problems[0] if isinstance(error, SceneError) else str(error)
        why = why.rstrip(".").removeprefix("found ")
        text = f"found surfaces that overlap at the start: {found.places}; separate could not push "
        problem = Problem(("contacts",), f"{text}them apart: {why}; move one of them")
        raise SceneError([problem.sentence(prepared.scene.source)]) from None


def _require_solids(prepared: Prepared) -> None:
    contact = _contact(prepared)
    if prepared.tissue:
        raise ParameterError("the scene has tissue, which it does not move")
    for name, surface in contact.bodies.items():
        if prepared.scene.bodies[name].start is not None:
            raise ParameterError(f"'{name}' has a start of its own")
        if prepared.has_rotations(name):
            raise ParameterError(f"'{name}' is made of frames, which it does not move")
        if surface.riders is not None:
            raise ParameterError(f"'{name}' has a surface of its own, which it does not move")
        if not surface.closed or not len(surface.triangles):
            raise ParameterError(f"'{name}' encloses no volume, so it has no side to go to")


def _contact(prepared: Prepared) -> PreparedContact:
    assert prepared.contact is not None
    return prepared.contact


def _pushed_apart(prepared: Prepared) -> Apart:
    from tissu.compile.clearance import Clearance
    from tissu.compile.relaxation import Relaxation, is_thick_inside
    from tissu.compile.settling import settle, unloaded
    from tissu.compile.world import build_world

    contact = _contact(prepared)
    core = _core_of(build_world(unloaded(prepared), overlap=True))
    gap = min(pair.gap for pair in contact.pairs)
    edge = min(surface.mean_edge for surface in contact.bodies.values())
    size = max(float(np.linalg.norm(np.ptp(s.vertices, axis=0))) for s in contact.bodies.values())
    nodes = slice(0, sum(body.mesh.node_count for body in prepared.bodies.values()))
    largest = core.largest_frequency()
    if not largest > 0.0:
        raise ParameterError("all of their nodes are held")
    crossing = 2.0 / largest * size / edge
    clearance = Clearance(contact, core)
    relaxation = Relaxation(core, clearance, gap, nodes, crossing)
    relaxation.run()
    _require_whole(core, contact)
    most = STEPS - relaxation.looks
    rest = settle(core, bodies=nodes, crossing=crossing, gap=gap, most=most)
    if core.crossings() or is_thick_inside(core, gap):
        raise ParameterError("they still cross")
    _require_whole(core, contact)
    positions, told = {}, []
    for name in contact.bodies:
        first, count = core.body_range(name)
        positions[name] = np.array(core.positions[first : first + count])
        moved = positions[name] - prepared.bodies[name].mesh.points
        told.append(f"'{name}' by at most {np.linalg.norm(moved, axis=1).max():.3g} m")
    steps = counted(relaxation.looks + rest.steps, "step")
    return Apart(
        positions,
        f"contact.overlap: pushed apart at the start: {', '.join(told)}; {steps}, contact "
        f"forces of {rest.pressing:.3g} N in sum, balanced to {rest.unbalanced:.1g} N",
    )


def _require_whole(core: Any, contact: PreparedContact) -> None:
    for name in contact.bodies:
        if count := len(core.inverted_cells(name)):
            text = counted(count, "cell")
            raise ParameterError(f"{text} of '{name}' would turn inside out")


def _core_of(world: Any) -> Any:
    """A simulation of a world, in implicit steps that are linearised once.

    To the tolerance of Newton's method, the set of contacts may change for ever in long steps.
    """
    from tissu import _core

    step = ImplicitEuler(1.0, newton=Newton(iterations=1))
    solver = Auto().linear_solver(equilibrium=False)
    return _core.Simulation(world=world, integrator=step.integrator(), solver=solver)
