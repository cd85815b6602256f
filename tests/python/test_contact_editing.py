"""Cells removed beside contacts: what presses goes on from where it was, on what is there."""

import numpy as np
import pytest

import tissu as ts
from contact_audit import audited, between
from contact_edited import DEPTH, GAP, SIDE, block, cells_at, is_there, pressed, tool, top_middle
from contact_static import judged

THIRD = SIDE / 3
STEPS = {
    "implicit_euler": ts.ImplicitEuler("5 ms"),
    "bdf2": ts.BDF2("5 ms"),
    "static": ts.Static(),
    "symplectic_euler": ts.SymplecticEuler(),
    "rk4": ts.RK4(),
}
EVERY = pytest.mark.parametrize("step", STEPS)
PENALTY = ts.ContactSettings(method="penalty")


def press(simulation, until=0.08):
    """Until the tool stands; no step leaves a crossing."""
    if isinstance(simulation.scene.step, ts.Static):
        settle(simulation)
        return
    while simulation.time < until:
        audited(simulation, 1)


def settle(simulation):
    """A static step; where something presses, its end is judged from outside."""
    report = simulation.step()
    assert report.converged, report
    assert simulation.crossings() == []
    if len(simulation.contacts()):
        judged(simulation, report)


def lead(simulation, depth, over=0.1):
    """Brings the tool to a depth below where it began to press [m], and lets it stand a while."""
    static = isinstance(simulation.scene.step, ts.Static)
    goes = "1 s" if static else over
    simulation.obstacle("tool").move((0, 0, -depth - 2 * GAP), over=goes)
    if static:
        settle(simulation)
        return
    end = simulation.time + 1.3 * over
    while simulation.time < end:
        audited(simulation, 1)


def kept_and_left(simulation, cells):
    """Contacts before a removal, of those that have all their parts after it, and those after."""
    before = simulation.contacts()
    simulation.remove_cells(body="block", cells=cells)
    after = simulation.contacts()
    assert is_there(simulation).all()
    keys = {tuple(row) for row in after.nodes.tolist()}
    kept = np.array([tuple(row) in keys for row in before.nodes.tolist()])
    return before, kept, after


@EVERY
def test_contacts_of_what_stays_are_the_same_to_the_bit(step):
    simulation = pressed(STEPS[step]).compile()
    press(simulation)
    positions = simulation.positions["block"].copy()
    before, kept, after = kept_and_left(simulation, [0, 18])  # corners, far from the tool
    assert kept.all()
    for name in ("nodes", "weights", "forces", "normals", "gaps", "points"):
        assert np.array_equal(getattr(before, name), getattr(after, name)), name
    assert np.linalg.norm(after.forces, axis=1).sum() > 0.1
    assert np.array_equal(simulation.positions["block"], positions)
    assert simulation.crossings() == []


@EVERY
def test_contacts_of_removed_faces_alone_go(step):
    simulation = pressed(STEPS[step], obstacles={"tool": tool((THIRD, SIDE / 2))}).compile()
    press(simulation)
    before, kept, after = kept_and_left(simulation, top_middle(simulation))
    assert 0 < len(after) == kept.sum() < len(before)
    assert np.array_equal(before.forces[kept], after.forces)
    on_block = np.where(before.pairs[:, [0]] == before.surfaces.index("block"), 1.0, -1.0)
    expected = -(on_block * before.forces)[kept].sum(axis=0)
    left = simulation.force_on("tool").force
    assert left == pytest.approx(expected, abs=1e-12 * np.abs(before.forces).sum())
    press(simulation, simulation.time + 0.05)
    assert simulation.force_on("tool").force[2] > 0.0


@pytest.mark.parametrize("step", ["implicit_euler", "bdf2", "symplectic_euler"])
def test_forces_go_on_but_for_the_removed(step):
    """The corners of the bottom go: in the next step the force is that of the whole block.

    To 1 %: in 0.5 ms waves of 6.5 m/s go 3 mm, and the tool is one and a half cells of 3 cm away.
    """
    whole, cut = (pressed(STEPS[step]).compile() for _ in range(2))
    for simulation in (whole, cut):
        press(simulation)
    cut.remove_cells(body="block", cells=[0, 2, 6, 8])
    for simulation in (whole, cut):
        simulation.step("0.5 ms")
        assert simulation.crossings() == []
    expected = whole.force_on("tool").force
    assert cut.force_on("tool").force == pytest.approx(expected, abs=1e-2 * expected[2])


@EVERY
def test_a_tool_goes_into_the_hole_and_meets_what_was_uncovered(step):
    """It is as good as free at once, and presses again one cell deeper, not before."""
    simulation = pressed(STEPS[step]).compile()
    press(simulation)
    pressing = simulation.force_on("tool").force[2]
    assert pressing > 0.1
    simulation.remove_cells(body="block", cells=top_middle(simulation))
    assert not len(simulation.contacts())
    press(simulation, simulation.time + 0.05)
    assert not simulation.force_on("tool").force.any()
    lead(simulation, THIRD - 0.002)
    assert not simulation.force_on("tool").force.any()
    lead(simulation, THIRD + DEPTH)
    assert simulation.force_on("tool").force[2] > 0.5 * pressing
    low = simulation.obstacle("tool").place_of((SIDE / 2, SIDE / 2, SIDE + 2 * GAP))[2]
    floor = simulation.positions["block"][simulation.contacts().nodes.max(initial=0)]
    assert low < 2 * THIRD - 0.5 * DEPTH
    assert floor[2] <= low + GAP


def test_a_cell_removed_at_rest_was_never_there():
    """Bit for bit the run of a body that is compiled without it, contacts and all."""
    made = pressed()
    simulation = made.compile()
    cells = top_middle(simulation)
    whole = simulation.meshes["block"]
    simulation.remove_cells(body="block", cells=cells)
    hexahedra = np.delete(whole.volume_blocks[0].nodes, cells, axis=0)
    holed = ts.Mesh(points=whole.points, cells=[("hexahedron", hexahedra)])
    other = made.replace(bodies={"block": block(mesh=holed)}).compile()
    for one in (simulation, other):
        one.obstacle("tool").move((0, 0, -THIRD - DEPTH), over="0.1 s")
    for _ in range(30):
        for one in (simulation, other):
            audited(one, 1)
        assert np.array_equal(simulation.positions["block"], other.positions["block"])
        assert np.array_equal(simulation.contacts().forces, other.contacts().forces)
    assert simulation.force_on("tool").force[2] > 0.1


@EVERY
def test_all_cells_of_one_side_go(step):
    """The tool goes through the nodes that are left behind, and meets the next layer."""
    simulation = pressed(STEPS[step]).compile()
    press(simulation)
    layer = cells_at(simulation, (0, 0, 2 * THIRD), (SIDE, SIDE, SIDE))
    assert len(layer) == 9
    simulation.remove_cells(body="block", cells=layer)
    assert not len(simulation.contacts())
    lead(simulation, THIRD - 0.002)
    assert not simulation.force_on("tool").force.any()
    lead(simulation, THIRD + DEPTH)
    assert simulation.force_on("tool").force[2] > 0.1
    found = simulation.contacts()
    loose = np.setdiff1d(np.arange(64), simulation.meshes["block"].volume_blocks[0].nodes)
    assert len(loose) == 16
    mine = found.nodes[found.pairs[:, 0] == found.surfaces.index("block")][:, 0]
    assert not np.isin(mine, loose).any()


def test_cells_go_one_after_the_other_under_a_tool_with_springs():
    """Penalty forces too: the tool digs through the block."""
    simulation = pressed(ts.SymplecticEuler(), contact=PENALTY).compile()
    press(simulation)
    for level in (2, 1):
        low = (THIRD, THIRD, level * THIRD)
        cells = cells_at(simulation, low, (2 * THIRD, 2 * THIRD, (level + 1) * THIRD))
        assert simulation.force_on("tool").force[2] > 0.05
        simulation.remove_cells(body="block", cells=cells)
        assert not len(simulation.contacts())
        lead(simulation, (3 - level) * THIRD + DEPTH)


def two_blocks(step, **fields):
    """A block that is led onto another one, which stands on its bottom."""
    gap = 2 * GAP
    high = ts.BarMesh(size=(SIDE,) * 3, cells=(3, 3, 3), cell="tetra", origin=(0, 0, SIDE + gap))
    down = ((0, 0, 0), (0, 0, -DEPTH - gap))
    top = ts.Plane(point=(0, 0, 2 * SIDE + gap), normal=(0, 0, 1))
    return pressed(
        step,
        bodies={"block": block(cell="tetra"), "high": block(mesh=high)},
        obstacles={},
        contacts=[ts.Contact(("block", "high"), friction=0.3, gap=GAP)],
        prescribed=[ts.Prescribed("high", on=top, times=(0, 0.05), displacements=down)],
        **fields,
    )


def cut_both(simulation):
    """Where two bodies press, cells of both go: the middle of one, a corner of the other."""
    third = THIRD
    low = cells_at(simulation, (third, third, 2 * third), (2 * third, 2 * third, SIDE))
    simulation.remove_cells(body="block", cells=low)
    corner = cells_at(simulation, (0, 0, SIDE), (third, third, SIDE + third), body="high")
    simulation.remove_cells(body="high", cells=corner)
    assert 0 < len(low) < 27
    assert 0 < len(corner) < 27


@pytest.mark.parametrize("step", ["implicit_euler", "symplectic_euler"])
def test_cells_go_in_the_contact_of_two_bodies(step):
    simulation = two_blocks(STEPS[step]).compile()
    press(simulation)
    before = between(simulation, "block", "high")
    assert before[2] < -1.0
    cut_both(simulation)
    left = between(simulation, "block", "high")
    assert before[2] < left[2] < 0.0
    for _ in range(20):
        audited(simulation, 1)
        force, other = (simulation.force_on(body).force for body in ("block", "high"))
        assert np.abs(force + other).max() <= 1e-12 * np.abs(force).max()
    assert between(simulation, "block", "high")[2] < 0.5 * left[2]


def test_faces_around_a_hole_do_not_press_each_other():
    """At rest, in self-contact: not even where they share a node alone. Nothing moves."""
    made = pressed(obstacles={}, contacts=[ts.SelfContact("block", gap=GAP)])
    simulation = made.compile()
    for cells in ([13], [25], [0, 2], [5, 7]):  # the middle, a side, corners, two by an edge
        simulation.remove_cells(body="block", cells=cells)
        report = audited(simulation, 2)
        assert report.contacts == report.held_back == 0
        # Of round-off alone: forces of cells that are not deformed.
        assert np.abs(simulation.displacements("block")).max() < 1e-15


def test_a_hole_that_is_squeezed_shut_does_not_pass_through_itself():
    """Cells of one layer go, but for a corner: a plate closes the slot."""
    plate = ts.PlaneObstacle(
        (0, 0, SIDE + 2 * GAP),
        (0, 0, -1),
        motion=ts.Motion(times=(0, 0.3), displacements=((0, 0, 0), (0, 0, -0.035))),
    )
    contacts = [ts.Contact(("block", "plate"), gap=GAP), ts.SelfContact("block", gap=GAP)]
    simulation = pressed(obstacles={"plate": plate}, contacts=contacts).compile()
    slot = cells_at(simulation, (THIRD, 0, THIRD), (SIDE, SIDE, 2 * THIRD))
    assert len(slot) == 6
    simulation.remove_cells(body="block", cells=slot)
    while simulation.time < 0.4:
        simulation.step()
        assert simulation.crossings() == []
    found = simulation.contacts()
    own = (found.pairs == found.surfaces.index("block")).all(axis=1)
    assert own.any()
    assert found.gaps[own].min() > -0.5 * GAP


_MIDDLE = ts.Box(min=(THIRD / 2, THIRD / 2, 0), max=(SIDE - THIRD / 2, SIDE - THIRD / 2, None))


@pytest.mark.parametrize("on", [_MIDDLE, ts.SurfaceNodes()])
def test_on_counts_nodes_that_come_to_the_surface(on):
    """A selection by place has inner nodes too; the surface is that of the cells there."""
    contact = ts.Contact(("block", "tool"), gap=GAP, on=on)
    simulation = pressed(contacts=[contact]).compile()
    simulation.remove_cells(body="block", cells=top_middle(simulation))
    lead(simulation, THIRD + DEPTH)
    assert simulation.force_on("tool").force[2] > 0.1
