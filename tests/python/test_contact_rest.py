"""A cube that falls on a table comes to rest on it, whatever solves, searches and counts."""

import functools

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, audited, block, damped, weight
from tissu import _core

GAP = 1e-3
"""[m]"""
STEPS = (ts.ImplicitEuler, ts.BDF2, ts.ImplicitMidpoint, ts.Newmark, ts.EnergyMomentum)


def dropped(step=None, **fields):
    """A cube of 10 cm in 5 cm cells, 2 cm above a table."""
    settings = {"friction": 0.5, "gap": GAP}
    given = {
        "bodies": {"cube": block((0, 0, 0.02), young=2e4, viscosity=damped())},
        "obstacles": {"table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        "contacts": [ts.Contact(("cube", "table"), **settings)],
        "gravity": (0, 0, -GRAVITY),
        "step": step or ts.ImplicitEuler("10 ms"),
    }
    return ts.Scene(**(given | fields))


@functools.cache
def rested(step=None):
    """The cube after three seconds, with the least height that any node had [m]."""
    simulation = dropped(step).compile()
    low = np.inf
    for _ in range(300):
        audited(simulation, 1)
        low = min(low, simulation.positions["cube"][:, 2].min())
    return simulation, low


@pytest.mark.parametrize("step", STEPS)
def test_a_dropped_cube_rests_with_its_weight(step):
    """Force to 1e-6 of the weight; an impact from 2 cm is no deeper than 1 % of an edge."""
    simulation, low = rested(step("10 ms"))
    force = simulation.force_on("table").force
    assert force == pytest.approx([0, 0, -weight()], abs=1e-6 * weight())
    assert low >= GAP - 0.01 * 0.05
    report = simulation.step()
    assert report.least_gap == pytest.approx(1.0, abs=1e-3)  # the step's tolerance: 1 % of xi
    assert np.abs(simulation.velocities["cube"]).max() < 1e-5


SOLVERS = {
    "cholesky": ts.Cholesky(),
    **{
        name: ts.ConjugateGradient(preconditioner=name)
        for name in ("jacobi", "block_jacobi", "incomplete_cholesky", "stale_cholesky", "multigrid")
    },
    "single": ts.ConjugateGradient(precision="single"),
    "single_factor": ts.ConjugateGradient(preconditioner="incomplete_cholesky", precision="single"),
    "free": ts.ConjugateGradient(matrix="free"),
    "auto": ts.Auto(),
}


@pytest.mark.parametrize("solver", SOLVERS)
def test_every_solver_comes_to_the_same_rest(solver):
    """Their tolerance is 1e-6 of the load in each step, 1e-5 of auto."""
    simulation = dropped(ts.ImplicitEuler("10 ms", solver=SOLVERS[solver])).compile()
    audited(simulation, 200)
    force = simulation.force_on("table").force
    assert force == pytest.approx([0, 0, -weight()], abs=1e-4 * weight())
    other, _ = rested(ts.ImplicitEuler("10 ms"))
    here = simulation.positions["cube"]
    there = other.positions["cube"]
    # Where it comes to lie on the table is decided by the way it takes; its shape is not.
    shape = (here - here.mean(axis=0)) - (there - there.mean(axis=0))
    assert np.abs(shape).max() < 1e-6


def two(**fields):
    """A cube falls on another one, off its middle and turned out of line, on a table."""
    return ts.Scene(
        bodies={
            "low": block((0, 0, 0.002), young=2e4, cells=(3, 3, 3)),
            "high": block((0.03, 0.02, 0.11), young=2e4, start=ts.Start(spin=(0.5, 0, 1))),
        },
        obstacles={
            "table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1)),
            "ball": ts.SphereObstacle((0.05, 0.16, 0.05), 0.05),
        },
        contacts=[ts.Contact("all", friction=0.3)],
        gravity=(0, 0, -GRAVITY),
        step=ts.ImplicitEuler("10 ms"),
        **fields,
    )


def state(simulation):
    """Every bit that a step may change, and the contacts."""
    arrays = [getattr(simulation, name)[b] for name in ("positions", "velocities")
              for b in simulation.bodies]  # fmt: skip
    found = simulation.contacts()
    return b"".join(np.ascontiguousarray(a).tobytes() for a in [*arrays, found.forces, found.gaps])


@functools.cache
def straight():
    """Bits after 25 and after 50 steps."""
    simulation = two().compile()
    audited(simulation, 25)
    middle = state(simulation)
    assert np.abs(simulation.force_on("high").force).max() > 0.1 * weight()  # in the collision
    audited(simulation, 25)
    return middle, state(simulation)


@pytest.mark.parametrize("threads", [2, 4])
def test_any_number_of_threads_gives_the_same_bits(threads):
    simulation = two(threads=threads).compile()
    audited(simulation, 25)
    assert state(simulation) == straight()[0]


@pytest.mark.parametrize("search", ["sweep_and_prune", "grid", "octree", "fcl"])
def test_every_broad_phase_gives_the_same_bits(search):
    """That of FCL in a build that has it, as that of `make test` does; else it is refused."""
    if search == "fcl" and "FCL" not in _core.build_info()["libraries"]:
        with pytest.raises(ts.errors.SceneError, match="which this build of tissu is without"):
            two(contact=ts.ContactSettings(broad_phase=search))
        return
    simulation = two(contact=ts.ContactSettings(broad_phase=search)).compile()
    audited(simulation, 50)
    assert state(simulation) == straight()[1]


def test_a_checkpoint_amid_a_collision_goes_on_to_the_bit(tmp_path):
    """In another simulation as in the one that was saved."""
    simulation = two().compile()
    audited(simulation, 25)
    assert state(simulation) == straight()[0]
    simulation.save_checkpoint(tmp_path / "middle")
    other = two().compile(checkpoint=tmp_path / "middle")
    assert state(other) == straight()[0]
    audited(simulation, 25)
    audited(other, 25)
    assert state(other) == state(simulation)


def test_reset_begins_anew_also_where_points_may_be_grabbed_since():
    """As on a page: a grab may give energy, which is not watched from then on."""
    simulation = two().compile()
    simulation.allow_touch()
    audited(simulation, 25)
    simulation.reset()
    assert simulation.time == 0.0
    audited(simulation, 25)
    assert state(simulation) == straight()[0]


def test_reset_begins_anew():
    simulation = two().compile()
    audited(simulation, 25)
    simulation.reset()
    assert len(simulation.contacts()) == 0
    audited(simulation, 25)
    assert state(simulation) == straight()[0]
