"""From a resolved scene to a world: the calls that build it, and the simulation that steps it."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from tissu.checkpoint import read_checkpoint
from tissu.compile.check import check_of
from tissu.compile.cuttable import refuse_uncuttable
from tissu.compile.material import fibres_of, parameters_of
from tissu.compile.model import kept_nodes
from tissu.compile.prepare import prepare
from tissu.compile.prepared import LoadedNodes, Prepared
from tissu.compile.start import begin
from tissu.compile.thin import cross_section_of
from tissu.errors import OverlapError, ParameterError, SceneError
from tissu.scene.load import Where
from tissu.scene.model import Frames
from tissu.scene.problem import Problem
from tissu.scene.section import section_in_core
from tissu.scene.step import Static

if TYPE_CHECKING:
    from tissu._core import WorldBuilder
    from tissu.checkpoint import Checkpoint
    from tissu.compile.check import Check
    from tissu.compile.separate import Apart
    from tissu.front import Scene
    from tissu.simulation import Simulation


def compile_scene(scene: Scene, checkpoint: Path | None = None) -> Simulation:
    """Turn a scene into a simulation, at rest or where a checkpoint left it.

    Raises:
        SceneError: the scene or its meshes have problems; the error lists all of them.
        CheckpointError: a checkpoint that is absent, damaged, or of another scene or version.
    """
    saved = None if checkpoint is None else read_checkpoint(checkpoint)
    prepared = prepare(scene)
    check = check_of(prepared)
    if check.problems:
        raise SceneError(check.problems)
    simulation, apart = simulation_of(scene, prepared, check, checkpoint=saved)
    if saved is not None:
        return simulation
    begin(simulation, prepared)
    if apart is not None:
        apart.begin(simulation)
    problem = unstable_step(simulation)
    if problem is not None:
        raise SceneError([problem.sentence(scene.source)])
    return simulation


def simulation_of(
    scene: Scene, prepared: Prepared, check: Check, checkpoint: Checkpoint | None = None
) -> tuple[Simulation, Apart | None]:
    """The simulation of a scene before it begins, and where bodies that overlapped in it begin.

    Raises:
        SceneError: surfaces overlap at the start, or what instruments and tears cut cannot be cut.
    """
    from tissu.simulation import Simulation

    world, apart = world_and_start(prepared, resumed=checkpoint is not None)
    if apart is not None:
        check = dataclasses.replace(check, notes=[*check.notes, apart.words])

    solver = getattr(scene.step, "solver", None)
    equilibrium = isinstance(scene.step, Static)
    simulation = Simulation(
        scene=scene,
        world=world,
        meshes={name: body.mesh for name, body in prepared.bodies.items()},
        tissue={name: tissue.mesh for name, tissue in prepared.tissue.items()},
        links={name: tissue.links for name, tissue in prepared.tissue.items()},
        integrator=scene.step.integrator(),
        solver=None if solver is None else solver.linear_solver(equilibrium=equilibrium),
        check=check,
        loads=[(loaded.load, _where(prepared, loaded)) for loaded in prepared.loaded],
        checkpoint=checkpoint,
    )
    refuse_uncuttable(simulation)
    return simulation, apart


def world_and_start(prepared: Prepared, *, resumed: bool = False) -> tuple[Any, Apart | None]:
    """The world of a scene, and where bodies that overlapped in it begin; a checkpoint knows that.

    Raises:
        SceneError: surfaces that meet overlap at the start, and were not or cannot be separated.
    """
    contact = prepared.contact
    if contact is None or contact.settings.overlap == "refuse":
        return world_of(prepared), None
    try:
        return build_world(prepared), None
    except OverlapError as overlap:
        from tissu.compile.separate import separated

        apart = None if resumed else separated(prepared, overlap)
        return build_world(prepared, overlap=True), apart
    except ParameterError as error:
        raise _refused(prepared, error) from None


def world_of(prepared: Prepared) -> Any:
    """The world of a scene that has no problems by itself.

    Raises:
        SceneError: surfaces that meet overlap at the start.
    """
    try:
        return build_world(prepared)
    except ParameterError as error:
        if prepared.contact is None:
            raise
        raise _refused(prepared, error) from None


def _refused(prepared: Prepared, error: ParameterError) -> SceneError:
    """What is wrong with contacts, if nothing else is."""
    build_world(dataclasses.replace(prepared, contact=None))  # raises what else is wrong
    problem = Problem(("contacts",), str(error))
    return SceneError([problem.sentence(prepared.scene.source)])


def unstable_step(simulation: Simulation) -> Problem | None:
    """A step that is above the stable one of an explicit method at rest, or auto where none is."""
    dt, stable = getattr(simulation.scene.step, "dt", None), simulation.stable_step
    if dt == "auto" and not math.isfinite(stable):
        text = "found auto, but nothing is stiff, so that every step is stable; a time is accepted"
        return Problem(("step", "dt"), text)
    if not isinstance(dt, float) or dt <= stable * (1.0 + 1e-9):
        return None
    name = simulation.plan().integrator
    text = f"found {dt:g} s; {name} is stable up to {stable:.4g} s at rest; take dt: auto, "
    return Problem(("step", "dt"), text + "a smaller step, or an implicit method")


def build_world(prepared: Prepared, *, overlap: bool = False) -> Any:
    """The world of a scene that has no problems; only what the scene asks for is in it.

    `overlap`: surfaces may overlap at the start, and are left where they are.
    """
    from tissu._core import WorldBuilder

    scene = prepared.scene
    builder = WorldBuilder(
        threads=usable_threads(scene.threads),
        editable=scene.editing is not None,
        grabbing=scene.grabbing,
        consistent_weight=isinstance(scene.step, Static),
    )
    if scene.instruments:
        tools = scene.instruments.values()
        builder.use_instruments(pressing=any(getattr(tool, "toughness", None) for tool in tools))
    for name in prepared.bodies:
        _add_body(builder, prepared, name)
    for name in prepared.tissue:
        _add_tissue(builder, prepared, name)
    if scene.gravity is not None:
        builder.add_gravity(acceleration=np.array(scene.gravity))
    for held in prepared.held:
        support, frames = held.support, prepared.has_rotations(held.support.body)
        support.add_to(builder, held.nodes, frames=frames)
    for loaded in prepared.loaded:
        where = _where(prepared, loaded)
        loaded.load.add_to(builder, where, number=int(loaded.path[1]))
    if prepared.contact is not None:
        prepared.contact.add_to(builder)
    return builder.build_crossing() if overlap else builder.build()


def _where(prepared: Prepared, loaded: LoadedNodes) -> Where:
    """Where a load acts."""
    body = loaded.load.body
    mesh, thickness = prepared.meshes[body].mesh, _rim_thickness(prepared, body)
    return Where(mesh, loaded.nodes, loaded.faces, thickness)


def usable_threads(asked: int) -> int:
    """Threads that run: never more than the machine has; those only get in each other's way.

    The bits of the result do not depend on it.
    """
    from tissu._core import build_info

    return min(asked, int(build_info()["threads_available"]))


def _add_body(builder: WorldBuilder, prepared: Prepared, name: str) -> None:
    from tissu._core import Plane

    body, ready = prepared.scene.bodies[name], prepared.bodies[name]
    builder.add_body(
        name=name,
        positions=np.ascontiguousarray(ready.mesh.points, dtype=np.float64),
        frames=body.has_rotations,
    )
    for group in ready.groups:
        builder.add_elastic(
            body=name,
            cell_type=group.cell_type,
            cells=np.ascontiguousarray(group.nodes, dtype=np.int32),
            cell_numbers=np.ascontiguousarray(group.cells, dtype=np.int32),
            law=group.law,
            parameters=group.parameters,
            density=np.array([ready.density]),
            quadrature=body.quadrature,
            reinforcements=[("fibre", group.fibres)] if group.fibres else [],
            loaded=None if group.made is None else group.made.build().loaded,
            cross_section=np.array([cross_section_of(body, group.cell_type)]),
            section=section_in_core(body.section),
            plane=getattr(Plane, body.plane) if body.plane and group.surface else Plane.free,
            model=group.model.in_core(kept_nodes(prepared, name, group), prepared.scene.step),
        )
    if prepared.scene.editing is not None and can_be_cut(prepared, name):
        nodes = prepared.scene.editing.nodes(ready.mesh.node_count)
        builder.leave_room(body=name, nodes=nodes)
    if body.viscosity is not None:
        body.viscosity.add_to(builder, name)


def can_be_cut(prepared: Prepared, name: str) -> bool:
    """Whether a model keeps each cell of a body by itself."""
    return all(group.model.type != "condensed" for group in prepared.bodies[name].groups)


def _add_tissue(builder: WorldBuilder, prepared: Prepared, name: str) -> None:
    tissue, ready = prepared.scene.tissue[name], prepared.tissue[name]
    law, made = tissue.law, type(tissue.law).made
    builder.add_body(name=name, positions=np.array(ready.mesh.points), frames=True)
    builder.add_points(
        body=name,
        shared=ready.shared,
        frames=np.ascontiguousarray(ready.weights.frames, dtype=np.int32),
        weights=np.ascontiguousarray(ready.weights.weights),
        gradients=np.ascontiguousarray(ready.weights.gradients),
        positions=np.ascontiguousarray(ready.points),
        volumes=ready.volumes,
        law=law.type,
        parameters=parameters_of([law], np.zeros(1, dtype=np.int32)),
        fibres=fibres_of([law], np.zeros(1, dtype=np.int32)),
        loaded=None if made is None else made.build().loaded,
        density=ready.density,
        model=Frames(tangent=tissue.tangent).in_core(np.empty(0, dtype=np.int32)),
    )


def _rim_thickness(prepared: Prepared, name: str) -> float:
    """Thickness [m] of the edges of a flat body; 0 of others, whose surface is made of faces."""
    body = prepared.scene.bodies.get(name)
    if body is None or body.plane is None or body.thickness is None:
        return 0.0
    return body.thickness
