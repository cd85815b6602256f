"""A cut in place leaves what a world laid anew has: the steps after it have the same bits."""

from __future__ import annotations

import numpy as np
import pytest

import tissu as ts

STEPS = {
    "implicit_euler": ts.ImplicitEuler(dt=0.005),
    "implicit_midpoint": ts.ImplicitMidpoint(dt=0.005),
    "newmark": ts.Newmark(dt=0.005),
    "bdf2": ts.BDF2(dt=0.005),
    "products": ts.ImplicitEuler(dt=0.005, solver=ts.ConjugateGradient(matrix="free")),
    "multigrid": ts.ImplicitEuler(
        dt=0.005, solver=ts.ConjugateGradient(preconditioner="multigrid")
    ),
    "cholesky": ts.ImplicitEuler(dt=0.005, solver=ts.Cholesky()),
}


def bar(step: ts.Step, method: str = "auto", **body: object) -> ts.Simulation:
    return ts.Scene(
        bodies={
            "bar": ts.Body(
                mesh=ts.bar_mesh(size=(0.4, 0.1, 0.1), cells=(12, 4, 4), cell="tetra"),
                law=ts.StVK(young=5e4, poisson=0.3),
                density=1000.0,
                **body,
            )
        },
        fixed=[ts.Fixed("bar", on=ts.Plane(point=(0, 0, 0), normal=(1, 0, 0)))],
        gravity=(0.0, 0.0, -9.81),
        step=step,
        editing=ts.Editing(room="200 %", method=method),
    ).compile()


def discs(simulation: ts.Simulation) -> list[ts.CutReport]:
    reports = []
    for k in range(3):
        blade = ts.Disc((0.15 + 0.08 * k, 0.05, 0.06), (1.0, 0.2 * k, 0.1), "4 cm")
        reports.append(simulation.cut("bar", blade))
        simulation.remove_cells(body="bar", cells=[700 + 11 * k])
        simulation.step()
    return reports


def laid_anew(simulation: ts.Simulation) -> None:
    """The same simulation in a world that is made of the cut body from scratch."""
    core = simulation._core
    core.replace_world(world=core.edited_like_now(fresh=simulation._world))


@pytest.mark.parametrize("method", ["virtual", "subdivide"])
@pytest.mark.parametrize("name", STEPS)
def test_steps_after_it_have_the_bits_of_a_world_laid_anew(name: str, method: str) -> None:
    ends = []
    for anew in (False, True):
        simulation = bar(STEPS[name], method, viscosity=ts.Rayleigh(mass=0.5, stiffness=1e-4))
        for _ in range(2):
            simulation.step()
        assert not any(report.relaid for report in discs(simulation))
        simulation._core.mark()  # the solver forgets, as it does where a world is replaced
        if anew:
            laid_anew(simulation)
        for _ in range(3):
            simulation.step()
        ends.append((simulation.positions["bar"].tobytes(), simulation.velocities["bar"].tobytes()))
        assert np.isfinite(simulation.positions["bar"]).all()
    assert ends[0] == ends[1]


def test_a_mark_after_a_cut_is_returned_to_any_number_of_times() -> None:
    """Also after other cuts, and after steps only; each time the same steps follow."""
    simulation = bar(ts.ImplicitEuler(dt=0.005))
    discs(simulation)
    mark = simulation.mark()
    cells = simulation.remaining_cells("bar")
    ends = []
    for k in range(4):
        for _ in range(2):
            simulation.step()
        ends.append(simulation.positions["bar"].tobytes())
        if k != 1:
            blade = ts.Disc((0.35, 0.05, 0.05), (1.0, 0.1 * k, 0.1), "4 cm")
            assert simulation.cut("bar", blade).cells_cut
        simulation.rewind(mark)
        np.testing.assert_array_equal(simulation.remaining_cells("bar"), cells)
    assert len(set(ends)) == 1


def test_held_nodes_part_in_place() -> None:
    ends = []
    for anew in (False, True):
        simulation = bar(ts.ImplicitEuler(dt=0.005))
        held = simulation.cut("bar", ts.Disc((0.0, 0.05, 0.05), (0.0, 0.0, 1.0), "5 cm"))
        assert held.nodes_new and not held.relaid
        simulation._core.mark()
        if anew:
            laid_anew(simulation)
        for _ in range(3):
            simulation.step()
        ends.append(simulation.positions["bar"].tobytes())
        held_now = simulation.positions["bar"][:, 0] == 0.0
        assert held_now.sum() >= 25 + held.nodes_new // 2
        np.testing.assert_array_equal(simulation.velocities["bar"][held_now], 0.0)
    assert ends[0] == ends[1]


def test_meshes_are_those_of_the_cells_that_are_left() -> None:
    simulation = bar(ts.ImplicitEuler(dt=0.005))
    discs(simulation)
    mesh = simulation.meshes["bar"]
    assert mesh.cell_count == len(simulation.remaining_cells("bar"))
    assert mesh.node_count == len(simulation.positions["bar"])
    origin = simulation.origin("bar")
    first = bar(ts.ImplicitEuler(dt=0.005)).meshes["bar"]
    np.testing.assert_array_equal(
        mesh.points[mesh.volume_blocks[0].nodes], first.points[first.volume_blocks[0].nodes[origin]]
    )


def test_the_automatic_solver_chooses_again_after_a_rewind_as_it_did() -> None:
    """A tough knife edits in every step, which leaves gaps in the matrix that a new one lacks.

    The work that the choice counts must not depend on them.
    """
    path = ts.ToolPath(times=(0.02, 0.25), positions=((0.0437, -0.01, 0), (0.05, 0.05, 0)))
    knife = ts.Knife(edge=((0, 0, -0.05), (0, 0, 0.05)), cuts=("bar",), toughness=30, path=path)
    simulation = ts.Scene(
        bodies={
            "bar": ts.Body(
                mesh=ts.bar_mesh(size=(0.08, 0.03, 0.03), cells=(8, 3, 3), cell="tetra"),
                law=ts.StableNeoHooke(young=2e4, poisson=0.4),
                density=1000.0,
            )
        },
        gravity=(0, 0, -9.81),
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        step=ts.ImplicitEuler(0.01),
        editing=ts.Editing(room=5.0),
        instruments={"knife": knife},
    ).compile()
    for _ in range(13):
        simulation.step()
    mark = simulation.mark()
    runs = []
    for _ in range(2):
        steps = [simulation.step() for _ in range(12)]
        iterations = [report.solver_iterations for report in steps]
        runs.append((iterations, simulation.positions["bar"].tobytes()))
        simulation.rewind(mark)
    assert runs[0] == runs[1]
