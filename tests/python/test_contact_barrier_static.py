"""Static steps in which contact has a potential: closed forms, balance, friction, refusals."""

import math
from pathlib import Path

import numpy as np
import pytest

import tissu as ts
from contact_audit import weight
from contact_static import TOLERANCE, out_of_balance
from test_contact_barrier import BARRIER, LEAST, slope_of
from test_contact_hertz import DELTA, force_over_hertz
from test_contact_rest import state
from test_contact_static import (
    GAP,
    SIDE,
    between_plates,
    on_a_table,
    plate_forces,
    stacked,
    uniaxial,
)
from tissu.errors import TissuError

HARD = Path(__file__).parents[1] / "hard" / "contact"


def pressed(simulation, h=None):
    """Take a static step, and judge its end from outside: balance, distances, friction."""
    report = simulation.step() if h is None else simulation.step(h)
    assert report.converged, report
    assert simulation.crossings() == [], report
    assert report.residual <= TOLERANCE or "round-off" in report.message
    assert out_of_balance(simulation) <= 2 * max(TOLERANCE, report.residual)
    found = simulation.contacts()
    assert len(found)
    # `least_gap` is a share of the gap, which is all that holds bodies of cells apart.
    assert report.least_gap > LEAST
    normal = np.einsum("ij,ij->i", found.forces, found.normals)
    along = np.linalg.norm(found.forces - normal[:, None] * found.normals, axis=1)
    friction = max(c.friction for c in simulation.scene.contacts)
    assert normal.min() >= 0.0
    assert (along <= friction * normal * (1 + 1e-9) + 1e-12 * normal.max()).all()
    return report


@pytest.mark.parametrize("friction", [0.0, 0.5])
@pytest.mark.parametrize("height", [0.0, GAP, 0.02])
def test_a_cube_that_nothing_else_holds_rests_on_a_table(height, friction):
    """It falls there first; the table carries its weight, to the step's tolerance of 1e-6."""
    simulation = on_a_table(friction=friction, height=height, contact=BARRIER).compile()
    for _ in range(2):
        pressed(simulation)
        force = simulation.force_on("table").force
        assert force == pytest.approx([0, 0, -weight()], abs=TOLERANCE * weight())
        low = simulation.positions["cube"][:, 2].min()
        assert LEAST * GAP < low < 2 * GAP


def test_nodes_rest_where_the_law_bears_them():
    """All contacts of a cube on a plane have one stiffness B: forces over b' d are the same."""
    simulation = on_a_table(contact=BARRIER).compile()
    pressed(simulation)
    found = simulation.contacts()
    distances = GAP + found.gaps
    least, far = LEAST * GAP, 2 * GAP
    sigma = (distances**2 - least**2) / (far**2 - least**2)
    law = np.array([-slope_of(s) * d for s, d in zip(sigma, distances, strict=True)])
    ratio = found.forces[:, 2] / law
    assert np.ptp(ratio) < 1e-9 * ratio.max()


def test_below_its_angle_it_slides_as_far_as_friction_needs():
    """Each node slides by the y at which f_T = F f1(y / e), f1 = 2 s - s^2, is its friction.

    e is 1e-3 of the extent of the cube for each second, of which a step has one. Twice the step's
    tolerance: both forces of a ratio are known to it.
    """
    simulation = on_a_table(0.45, friction=0.5, contact=BARRIER).compile()
    phi = math.atan(0.45)
    expected = [weight() * math.sin(phi), 0, -weight() * math.cos(phi)]
    bottom = simulation.meshes["cube"].points[:, 2] < GAP + 1e-9
    pressed(simulation)
    for _ in range(2):
        before = simulation.positions["cube"][bottom]
        pressed(simulation)
        force = simulation.force_on("table").force
        assert force == pytest.approx(expected, abs=2e-6 * weight())
        now = simulation.positions["cube"][bottom]
        found = simulation.contacts()
        assert len(found) == len(now)
        for point, force in zip(found.points, found.forces, strict=True):
            node = np.linalg.norm(now[:, :2] - point[:2], axis=1).argmin()
            slid = np.linalg.norm((now - before)[node, :2]) / (1e-3 * math.sqrt(3) * SIDE)
            assert 0.0 < slid < 1.0
            share = np.hypot(*force[:2]) / (0.5 * force[2])
            assert share == pytest.approx(2 * slid - slid**2, rel=2e-6)


@pytest.mark.parametrize("gap", [1e-4, 1e-5])
def test_below_its_angle_it_stays_on_a_table_with_a_short_gap(gap):
    """Contacts begin a step as stiff as they ended the last one: softer ones would bear nothing.

    Forces to twice the step's tolerance, as above; each step slides by less than e.
    """
    mesh = ts.BarMesh(size=(SIDE,) * 3, cells=(4, 4, 4), cell="hexahedron", origin=(0, 0, gap))
    body = ts.Body(mesh=mesh, law=ts.StVK(young="20 kPa", poisson=0.3), density=1000.0)
    weight, phi = 9.81 * 1000.0 * SIDE**3, 0.2
    simulation = ts.Scene(
        bodies={"cube": body},
        obstacles={"table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact(("cube", "table"), friction=0.3, gap=gap)],
        contact=BARRIER,
        gravity=(9.81 * math.sin(phi), 0, -9.81 * math.cos(phi)),
        step=ts.Static(),
    ).compile()
    pressed(simulation)
    for _ in range(2):
        before = simulation.positions["cube"].copy()
        pressed(simulation)
        expected = [weight * math.sin(phi), 0, -weight * math.cos(phi)]
        assert simulation.force_on("table").force == pytest.approx(expected, abs=2e-6 * weight)
        slid = np.linalg.norm(simulation.positions["cube"] - before, axis=1)
        assert slid.max() < 1e-3 * math.sqrt(3) * SIDE


def test_above_it_nothing_holds_it_which_is_said():
    simulation = on_a_table(0.55, friction=0.5, contact=BARRIER).compile()
    before = simulation.positions["cube"].copy()
    with pytest.raises(TissuError, match="no equilibrium was found") as error:
        simulation.step()
    assert "\n" not in str(error.value)
    assert np.array_equal(simulation.positions["cube"], before)
    assert simulation.time == 0.0
    assert simulation.crossings() == []


def test_a_block_pressed_between_plates_without_friction():
    """Homogeneous: the closed form at the height that the block has.

    A corner bears a quarter of what an inner node does, and rests farther away, by up to a gap.
    This bends a face by 2e-5 of the height. The sum of forces adds what the residual leaves of the
    nodes of a face.
    """
    scene = between_plates(share=0.3, gap=2e-6, contact=BARRIER)
    simulation = scene.compile()
    for _ in range(3):
        pressed(simulation, 1 / 3)
    rest, now = simulation.meshes["cube"].points, simulation.positions["cube"]
    height = np.ptp(now[:, 2])
    assert height == pytest.approx(0.7 * SIDE, rel=0.01)
    stress, side = uniaxial(scene.bodies["cube"].law, height / SIDE)
    low, high = plate_forces(simulation)
    assert high == pytest.approx([0, 0, -stress * SIDE**2], abs=1e-4 * abs(stress) * SIDE**2)
    assert low + high == pytest.approx([0, 0, 0], abs=10 * TOLERANCE * abs(high[2]))
    assert now[:, 0] == pytest.approx(side * rest[:, 0], abs=1e-4 * SIDE)


def test_a_block_that_sticks_bulges_and_is_pressed_harder():
    """Without any support: friction alone keeps it in its place."""
    simulation = between_plates(10.0, share=0.3, symmetric=False, contact=BARRIER).compile()
    pressed(simulation)
    low, high = plate_forces(simulation)
    assert low + high == pytest.approx([0, 0, 0], abs=10 * TOLERANCE * high[2])
    rest, now = simulation.meshes["cube"].points, simulation.positions["cube"]
    stress, side = uniaxial(simulation.scene.bodies["cube"].law, np.ptp(now[:, 2]) / SIDE)
    assert high[2] > -1.01 * stress * SIDE**2
    ends = rest[:, 2] > rest[:, 2].max() - 1e-9
    assert np.ptp(now[ends, 0]) == pytest.approx(SIDE, rel=0.02)
    assert np.ptp(now[:, 0]) > side * SIDE


def test_a_stack_carries_its_weights():
    simulation = stacked(contact=BARRIER).compile()
    pressed(simulation)
    table = simulation.force_on("table").force
    assert table == pytest.approx([0, 0, -2 * weight()], abs=2e-5 * weight())
    over = simulation.force_on("over").force
    assert over == pytest.approx([0, 0, weight()], abs=1e-5 * weight())


def test_hertz():
    """The tolerances of `test_contact_hertz`; surfaces meet within 0.4 % of delta, 0.6 % of F."""
    fields = {"contact": BARRIER, "gap": 0.002 * DELTA, "judge": pressed}
    assert force_over_hertz(2, **fields) == pytest.approx(1.0, abs=0.05)
    assert force_over_hertz(3, **fields) == pytest.approx(1.0, abs=0.025)


def test_two_livers_are_pushed_together():
    """The upper one goes down by 4 mm in a step, 1 cm of it after they met; friction 0.3."""
    scene = ts.Scene.from_yaml(HARD / "livers.yaml")
    simulation = scene.replace(step=ts.Static(solver=ts.Cholesky()), contact=BARRIER).compile()
    force = np.zeros(3)
    for _ in range(10):
        simulation.step(0.03)
        assert simulation.crossings() == []
        force = simulation.force_on("low").force
        size = np.linalg.norm(force)
        other = simulation.force_on("high").force
        assert np.abs(force + other).max() <= 1e-9 * max(size, 1e-12)
        for body in simulation.bodies:
            assert not len(simulation.inverted_cells(body))
    assert force[2] < 0.0


def test_plates_that_leave_no_room_are_refused_and_leave_the_state_whole():
    simulation = between_plates(share=1.2, contact=BARRIER).compile()
    before = simulation.positions["cube"].copy()
    with pytest.raises(TissuError, match="no equilibrium was found beyond") as error:
        simulation.step()
    assert "\n" not in str(error.value)
    assert np.array_equal(simulation.positions["cube"], before)
    assert simulation.crossings() == []


def test_threads_and_a_run_that_is_resumed_change_no_bit(tmp_path):
    found = []
    for threads in (1, 2):
        scene = stacked(threads=threads, contact=BARRIER)
        simulation = scene.compile()
        pressed(simulation)
        simulation.save_checkpoint(tmp_path / "middle.ckpt")
        pressed(simulation)
        found.append(state(simulation))
    again = scene.compile(checkpoint=tmp_path / "middle.ckpt")
    pressed(again)
    assert found[0] == found[1] == state(again)
