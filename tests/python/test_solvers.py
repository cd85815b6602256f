"""Linear solvers of a scene: what is accepted, what `auto` stands for, what is reported."""

import itertools

import numpy as np
import pytest

import tissu as ts
from tissu.errors import SceneError

KINDS = [
    *(
        {"preconditioner": kind, "precision": precision}
        for kind, precision in itertools.product(
            ("jacobi", "block_jacobi", "incomplete_cholesky", "stale_cholesky", "multigrid"),
            ("double", "single"),
        )
    ),
    {"preconditioner": "jacobi", "matrix": "free"},
    {"matrix": "free"},
]


def scene(solver, **changes):
    mesh = ts.bar_mesh(size=(2, 1, 1), cells=(6, 3, 3), cell="tetra")
    fields = {
        "bodies": {"bar": ts.Body(mesh=mesh, law=ts.StVK(young=3e3, poisson=0.4), density=1e3)},
        "gravity": (0, 0, -9.81),
        "fixed": [ts.Fixed("bar", on=ts.Box((-1, -1, -1), (1e-9, 2, 2)))],
        "step": ts.ImplicitEuler(0.01, solver=solver),
        **changes,
    }
    return ts.Scene(**fields)


def after(solver, steps=5):
    simulation = scene(solver).compile()
    for _ in range(steps):
        assert simulation.step().converged
    return simulation


@pytest.fixture(scope="module")
def direct():
    return np.array(after(ts.Cholesky()).positions["bar"])


@pytest.mark.parametrize("fields", KINDS, ids=lambda f: "-".join(f.values()))
def test_every_solver_takes_the_same_steps(fields, direct):
    simulation = after(ts.ConjugateGradient(tolerance=1e-12, **fields))
    # each step is solved to 1e-12 of its right-hand side, and five add up
    np.testing.assert_allclose(simulation.positions["bar"], direct, atol=1e-9)
    profile = simulation.profile()
    assert profile.solves.solves == 5
    assert profile.solves.failures == 0
    assert profile.solves.residual <= 1e-12
    assert 1 <= profile.solves.preparations <= 5
    stages = {row.stage for row in profile.rows if row.effect == "linear solver"}
    assert stages == {"preconditioner", "solve"}
    assert "linear solver: 5 systems" in str(profile)
    simulation.clear_profile()
    assert simulation.profile().solves.solves == 0


def test_failures_are_counted():
    simulation = scene(ts.ConjugateGradient(tolerance=1e-12, iterations=2)).compile()
    report = simulation.step()
    assert not report.converged
    assert report.residual > 1e-12
    assert simulation.profile().solves.failures == 1
    assert "1 system, 1 not to the tolerance" in str(simulation.profile())


def test_a_matrix_is_needed_by_what_is_made_of_it():
    for fields, field in [
        ({"preconditioner": "incomplete_cholesky"}, "preconditioner"),
        ({"preconditioner": "stale_cholesky"}, "preconditioner"),
        ({"preconditioner": "multigrid"}, "preconditioner"),
        ({"precision": "single"}, "precision"),
    ]:
        with pytest.raises(SceneError, match=f"{field}: .*matrix free"):
            ts.ConjugateGradient(matrix="free", **fields)


def test_a_solver_may_be_named_alone():
    text = """
bodies:
  bar:
    mesh: {type: bar, size: [2, 1, 1], cells: [2, 1, 1]}
    law: {type: hooke, young: 1 kPa, poisson: 0.3}
    density: 1000
step: {type: implicit_euler, dt: 10 ms, solver: %s}
"""
    assert ts.Scene.from_yaml_text(text % "auto").step.solver == ts.Auto()
    assert ts.Scene.from_yaml_text(text % "{type: auto}").step.solver == ts.Auto()
    assert ts.Scene.from_yaml_text(text % "cholesky").step.solver == ts.Cholesky()
    with pytest.raises(SceneError, match=r"nearest|[Aa]ccepted"):
        ts.Scene.from_yaml_text(text % "automatic")
    written = scene(ts.Auto()).step.replace(solver=ts.Auto(tolerance=1e-3))
    assert written.solver.tolerance == 1e-3


def test_auto_is_the_default_of_every_step_that_solves():
    steps = [
        *(step(0.01) for step in (ts.ImplicitEuler, ts.ImplicitMidpoint, ts.BDF2, ts.Newmark)),
        *(ts.EnergyMomentum(0.01), ts.Static()),
    ]
    assert all(step.solver == ts.Auto() for step in steps)


def test_auto_takes_the_same_steps(direct):
    simulation = after(ts.Auto(tolerance=1e-12))
    # as of the other solvers: each step is solved to 1e-12 of its right-hand side
    np.testing.assert_allclose(simulation.positions["bar"], direct, atol=1e-9)
    solves = simulation.profile().solves
    assert (solves.solves, solves.failures) == (5, 0)
    assert solves.residual <= 1e-12
    assert (
        solves.work > 5 * simulation.plan().matrix_bytes / 2
    )  # each reads the matrix once at least


def test_auto_says_what_it_chose_and_why():
    simulation = scene(ts.Auto()).compile()
    (said,) = [e for e in simulation.plan().effects if e.name == "linear solver"]
    assert "auto: it begins with what the first matrix makes cheapest" in str(said)
    assert not [note for note in simulation.plan().notes if "solver" in note]
    assert simulation.plan().solver.startswith("automatic: ")
    assert simulation.step().converged
    assert simulation.plan().solver.startswith("automatic: ")
    (chosen,) = [note for note in simulation.plan().notes if "solver" in note]
    for text in (chosen, str(simulation.profile())):
        assert "in 1 system; it never changed" in text
        assert "work of a system [MB]: block_jacobi" in text
        assert "(predicted)" in text
    static = scene(ts.Auto(), step=ts.Static())
    assert "for few solves" in str(static.check())


def test_the_choice_does_not_depend_on_threads():
    runs = []
    for threads in (1, 2):
        simulation = scene(ts.Auto(), threads=threads).compile()
        for _ in range(40):
            simulation.step()
        runs.append((simulation.profile().solves, np.array(simulation.positions["bar"])))
    assert runs[0][0] == runs[1][0]
    np.testing.assert_array_equal(runs[0][1], runs[1][1])
