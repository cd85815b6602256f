"""Forty steps straight, and twenty with twenty more in another process: equal bytes."""

import subprocess
import sys

import numpy as np
import pytest

import checkpoint_runs as runs
import tissu as ts
from tissu.checkpoint.checkpoint import read_checkpoint

CASES = [
    *((step, "conjugate_gradient", 1, 2) for step in runs.STEPS),
    *(("implicit_euler", solver, 2, 1) for solver in runs.SOLVERS),
    ("static", "cholesky", 1, 1),
]


@pytest.mark.parametrize(("step", "solver", "threads", "then"), CASES)
def test_a_restart_in_another_process_gives_the_same_bytes(tmp_path, step, solver, threads, then):
    simulation = runs.scene(step, solver, threads).compile()
    runs.first_half(simulation)
    middle, straight, end = tmp_path / "middle", tmp_path / "straight", tmp_path / "end"
    simulation.save_checkpoint(middle)
    runs.second_half(simulation)
    simulation.save_checkpoint(straight)
    words = [step, solver, then, middle, end]
    subprocess.run([sys.executable, runs.__file__, *map(str, words)], check=True, timeout=300)
    assert end.read_bytes() == straight.read_bytes()
    # The two halves are no rest: something moved in each of them, and cells are gone.
    one, two = read_checkpoint(middle).snapshot, read_checkpoint(end).snapshot
    assert np.isfinite(two["positions"]).all()
    assert np.abs(two["positions"] - one["positions"]).max() > 1e-6
    assert len(two["cells_0"]) == len(one["cells_0"]) - 1 < simulation._rest["bar"].cell_count - 4
    assert len(two["loose_nodes_0"])


def test_what_is_asked_of_it_is_the_same_at_once(tmp_path):
    scene = runs.scene("implicit_euler", "conjugate_gradient")
    simulation = scene.compile()
    runs.first_half(simulation)
    simulation.save_checkpoint(tmp_path / "a")
    other = scene.compile(checkpoint=tmp_path / "a")
    assert other.time == simulation.time
    assert other.energy() == simulation.energy()
    assert other.meshes["bar"].cell_count == simulation.meshes["bar"].cell_count
    for name, values in simulation.cell_fields("bar").items():
        assert np.array_equal(other.cell_fields("bar")[name], values)
    for values in ("positions", "velocities"):
        assert np.array_equal(getattr(other, values)["bar"], getattr(simulation, values)["bar"])
    assert np.abs(simulation.reactions("bar")).max() > 0
    assert np.array_equal(other.reactions("bar"), simulation.reactions("bar"))
    assert other.step().number == simulation.step().number == runs.HALF + 1
    assert (other.resumed_from.steps, other.resumed_from.note) == (runs.HALF, "")


@pytest.mark.parametrize("split", [0.02, 0.05, 0.06])
def test_until_takes_the_steps_of_one_run(tmp_path, split):
    """Seven whole steps and a shorter one: 0.073 s."""
    scene = runs.scene("implicit_euler", "conjugate_gradient")
    scene = scene.replace(step=scene.step.replace(dt=0.01), prescribed=())
    straight, first = scene.compile(), scene.compile()
    # A checkpoint drops what the solver keeps, such as its latest answers: both take it.
    times = [report.time for report in straight.run(split)]
    straight.save_checkpoint(tmp_path / "b")
    times += [report.time for report in straight.run(until=0.073)]
    assert len(times) == 8
    for _ in first.run(split):
        pass
    first.save_checkpoint(tmp_path / "a")
    second = scene.compile(checkpoint=tmp_path / "a")
    assert [report.time for report in second.run(until=0.073)] == times[
        -(8 - round(split / 0.01)) :
    ]
    assert np.array_equal(second.positions["bar"], straight.positions["bar"])
    assert list(second.run(until=0.073)) == []
    assert list(second.run(until=0.05)) == []
    assert [report.time for report in second.run(until="80 ms")] == pytest.approx([0.08])


@pytest.mark.parametrize("law", [ts.Hooke, ts.StableNeoHooke])
@pytest.mark.parametrize("solver", [ts.Auto(), ts.ConjugateGradient(preconditioner="multigrid")])
def test_a_restart_far_from_rest_gives_the_same_bits(tmp_path, solver, law):
    """The matrix of a linear body stays, and with it what a solver makes of the places of rows."""
    mesh = ts.BarMesh(size=(0.3, 0.05, 0.05), cells=(24, 4, 4), cell="tetra")
    body = ts.Body(mesh=mesh, law=law(young="20 kPa", poisson=0.45), density=1000.0)
    scene = ts.Scene(
        bodies={"bar": body},
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        gravity=(0, 0, -9.81),
        step=ts.ImplicitEuler("10 ms", solver=solver),
    )
    straight = scene.compile()
    for _ in range(20):
        straight.step()
    assert np.abs(straight.displacements("bar")).max() > 0.02
    straight.save_checkpoint(tmp_path / "middle")
    resumed = scene.compile(checkpoint=tmp_path / "middle")
    for simulation in (straight, resumed):
        for _ in range(5):
            simulation.step()
    assert np.array_equal(straight.positions["bar"], resumed.positions["bar"])


def test_fields_at_nodes_are_the_same_after_a_restart_in_an_incision(tmp_path):
    """Copies of cells are in other places of their blocks then: sums over cells are ordered."""
    body = ts.Body(
        mesh=ts.BarMesh(size=(0.08, 0.03, 0.02), cells=(6, 3, 2), cell="hexahedron"),
        law=ts.StableNeoHooke(young=8e3, poisson=0.4),
        density=1000.0,
        viscosity=ts.Rayleigh(mass=3.0, stiffness=0.005),
    )
    knife = ts.Knife(
        edge=[(0, 0, -0.01), (0, 0, 0.05)],
        cuts=["bar"],
        path=ts.ToolPath(times=(0.02, 0.2), positions=((0.05, -0.01, 0.01), (0.056, 0.04, 0.01))),
    )
    scene = ts.Scene(
        bodies={"bar": body},
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        gravity=(0, 0, -9.81),
        instruments={"knife": knife},
        editing=ts.Editing(room="200 %"),
        step=ts.ImplicitEuler("10 ms"),
    )
    straight = scene.compile()
    for _ in straight.run(0.14):
        pass
    straight.save_checkpoint(tmp_path / "middle")
    resumed = scene.compile(checkpoint=tmp_path / "middle")
    cells = straight.meshes["bar"].cell_count
    for simulation in (straight, resumed):
        for _ in simulation.run(0.04):
            pass
    assert straight.meshes["bar"].cell_count > cells > 36  # the incision went on
    for name in ("von_mises", "green_strain"):
        expected = straight.field(name, at="nodes")
        assert np.array_equal(resumed.field(name, at="nodes"), expected, equal_nan=True)
