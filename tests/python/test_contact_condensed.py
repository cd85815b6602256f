"""Condensed bodies in contact: the answers of all nodes, with fewer unknowns."""

import numpy as np
import pytest

import tissu as ts
from contact_static import judged
from tissu.errors import ParameterError

SIDE = 0.06
GAP = 3e-4
"""[m]"""
MESH = ts.BarMesh(size=(SIDE, SIDE, SIDE), cells=(4, 4, 4))
ALL_BUT_INNER = 125 - 27


def pressed(model, *, step=None, mesh=MESH, **fields):
    """A linear block on its bottom, pressed by 1 % of its height by a small box on its top."""
    down = ts.Motion(times=(0, 1), displacements=((0, 0, 0), (0, 0, -0.01 * SIDE - 2 * GAP)))
    low, high = (0.02, 0.02, SIDE + 2 * GAP), (0.04, 0.04, 2 * SIDE)
    body = ts.Body(mesh=mesh, law=ts.Hooke(young=1e4, poisson=0.4), density=1000.0, model=model)
    given = {
        "bodies": {"block": body},
        "obstacles": {"tool": ts.BoxObstacle(low, high, motion=down)},
        "contacts": [ts.Contact(("block", "tool"), friction=0.3, gap=GAP)],
        "fixed": [ts.Fixed("block", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        "step": step or ts.Static(solver=ts.Cholesky()),
    }
    return ts.Scene(**(given | fields))


@pytest.mark.parametrize("keep", ["touched", "surface"])
def test_a_static_press_is_that_of_all_nodes(keep):
    """Both find the same equilibrium, to the tolerance of their contact forces (1e-3)."""
    whole, condensed = (pressed(m).compile() for m in ("fem", ts.Condensed(keep=keep)))
    for simulation in (whole, condensed):
        judged(simulation, simulation.step())
    force = whole.force_on("tool").force
    assert force[2] > 0.05
    assert condensed.force_on("tool").force == pytest.approx(force, abs=2e-3 * force[2])
    # Inner nodes follow those of the surface.
    moved = whole.displacements("block")
    assert condensed.displacements("block") == pytest.approx(moved, abs=2e-3 * np.abs(moved).max())
    assert condensed.plan().matrix_blocks >= (ALL_BUT_INNER - 25) ** 2


def test_it_is_said_that_the_whole_surface_is_kept():
    notes = pressed(ts.Condensed()).check().notes
    assert any("bodies.block: a contact names it" in note for note in notes)
    kept = pressed(ts.Condensed(keep="surface")).check().notes
    assert not any("a contact names it" in note for note in kept)


def test_in_steps_of_time_it_comes_to_the_same_rest():
    damped = ts.Rayleigh(mass=50.0, stiffness=0.02)
    ends = []
    for model in ("fem", ts.Condensed()):
        made = pressed(model, step=ts.ImplicitEuler("20 ms", solver=ts.Cholesky()))
        body = made.bodies["block"].replace(viscosity=damped)
        simulation = made.replace(bodies={"block": body}).compile()
        while simulation.time < 1.5:
            simulation.step()
            assert simulation.crossings() == []
        ends.append(simulation.force_on("tool").force)
    # At rest inertia counts nothing: contact forces agree to the change that ends a step, 1e-2.
    assert ends[1] == pytest.approx(ends[0], abs=2e-2 * ends[0][2])
    assert ends[0][2] > 0.05


def test_its_own_cells_stay_where_it_is_in_contact():
    """The nodes that they would uncover are not unknowns: nothing changes; a sentence says why."""
    simulation = pressed(ts.Condensed(), editing=True).compile()
    simulation.step()
    before = simulation.contacts().forces
    with pytest.raises(
        ParameterError, match="eliminated by the model condensed, and lies on a sur"
    ):
        simulation.remove_cells(body="block", cells=[0])
    assert simulation.meshes["block"].cell_count == 6 * 64
    assert np.array_equal(simulation.contacts().forces, before)
    judged(simulation, simulation.step())


def test_cells_beside_it_may_go():
    """Nodes that it shares with them are kept: the tool presses on what they uncover."""
    mesh = ts.bar_mesh(size=(SIDE, SIDE, SIDE), cells=(4, 4, 4), cell="hexahedron")
    middle = mesh.points[mesh.volume_blocks[0].nodes].mean(axis=1)[:, 2]
    regions = {"near": np.flatnonzero(middle > 0.045), "far": np.flatnonzero(middle < 0.045)}
    mesh = ts.Mesh(points=mesh.points, cells=mesh.cells, regions=regions)
    models = {"near": ts.FEM(), "far": ts.Condensed()}
    simulation = pressed(models, mesh=mesh, editing=True).compile()
    judged(simulation, simulation.step())
    simulation.remove_cells(body="block", cells=regions["near"])
    assert not len(simulation.contacts())
    simulation.obstacle("tool").move((0, 0, -0.015 - 2 * GAP - 0.006 * SIDE), over="1 s")
    judged(simulation, simulation.step())
    assert simulation.force_on("tool").force[2] > 0.02
