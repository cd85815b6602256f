"""Bodies that are cut while they touch: their cut faces meet what their surfaces meet."""

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, audited, block, damped, weight

SIDE = 0.09
"""of a block [m], of three cells of 3 cm along each axis"""
GAP = 4e-4
"""[m]"""


def cut_block(cell="tetra", *, cells=(3, 3, 3), **fields):
    """A block of 9 cm that stands on its bottom and meets itself."""
    body = block(size=(SIDE,) * 3, cells=cells, cell=cell, young=2e4, viscosity=damped(), **fields)
    given = {
        "bodies": {"block": body},
        "gravity": (0, 0, -GRAVITY),
        "contacts": [ts.SelfContact("block", friction=0.3, gap=GAP)],
        "fixed": [ts.Fixed("block", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        "step": ts.ImplicitEuler("5 ms"),
        "editing": True,
    }
    return given


def scene(cell="tetra", **fields):
    """The block, with other fields of the scene."""
    return ts.Scene(**(cut_block(cell) | fields))


def level(height, lean=0.0):
    """A plane across the block."""
    return ts.Plane((0, 0, height), (0, lean, 1))


def loose(report):
    """The piece that nothing holds."""
    (piece,) = (piece for piece in report.pieces if not piece.held)
    return piece


def joint(simulation, body="block"):
    """The force that the lower one of a body's two pieces bears in contact with the upper [N]."""
    found = simulation.contacts()
    own = (found.pairs == found.surfaces.index(body)).all(axis=1)
    upward = np.sign(found.normals[own][:, 2:])
    return -(found.forces[own] * upward).sum(axis=0)


@pytest.mark.parametrize("cell", ["tetra", "hexahedron"])
@pytest.mark.parametrize("height", [0.03, 0.041])
def test_a_piece_rests_on_the_body_that_it_was_cut_from(cell, height):
    """On faces and through cells: the lower wall bears the weight of the upper piece, to 0.1 %."""
    simulation = scene(cell).compile()
    audited(simulation, 60)
    top = simulation.positions["block"][:, 2].max()
    report = simulation.cut("block", level(height))
    assert simulation.crossings() == []
    audited(simulation, 160)
    bears = -joint(simulation)
    assert bears[2] == pytest.approx(GRAVITY * loose(report).mass, rel=1e-3)
    assert np.abs(bears[:2]).max() < 1e-3 * bears[2]
    # It went down by a hundredth of the gap, and by what pressing in single points bends of a cell.
    assert simulation.positions["block"][:, 2].max() == pytest.approx(top, abs=GAP)


def test_walls_of_a_closed_cut_press_like_two_bodies_built_apart():
    """A block cut on its faces and two blocks, a led plate on top: the same force, to 2 %.

    The force on a wall acts half a gap inside its cells of 3 cm, which is 0.7 % of them.
    """
    down = ((0, 0, 0), (0, 0, -4e-3))
    third = SIDE / 3
    rest = {"gravity": (0, 0, 0), "step": ts.ImplicitEuler("10 ms")}

    def led(body, top):
        on = ts.Plane((0, 0, top), (0, 0, 1))
        return [ts.Prescribed(body, on=on, times=(0, 0.1), displacements=down)]

    one = scene("hexahedron", prescribed=led("block", SIDE), **rest).compile()
    one.cut("block", level(third))
    # The walls of the cut begin a gap over 0.99 apart.
    above = third + GAP / 0.99
    parts = {
        "low": block(size=(SIDE, SIDE, third), cells=(3, 3, 1), young=2e4, viscosity=damped()),
        "high": block(
            (0, 0, above),
            size=(SIDE, SIDE, 2 * third),
            cells=(3, 3, 2),
            young=2e4,
            viscosity=damped(),
        ),
    }
    two = ts.Scene(
        bodies=parts,
        contacts=[ts.Contact(("high", "low"), friction=0.3, gap=GAP)],
        fixed=[ts.Fixed("low", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        prescribed=led("high", above + 2 * third),
        step=ts.ImplicitEuler("10 ms"),
    ).compile()
    for simulation in (one, two):
        audited(simulation, 30)
    expected = two.force_on("low").force[2]
    assert expected < -1.0
    assert joint(one)[2] == pytest.approx(expected, rel=2e-2)


def test_walls_of_an_incision_do_not_pass_each_other():
    """A slit to the middle, closed by plates from both sides: the walls press, and never cross."""
    high = (0.04, 0.2)
    left, right = (
        ts.BoxObstacle(
            (low, -0.1, high[0]),
            (low + 0.02, 0.2, high[1]),
            motion=ts.Motion(times=(0.05, 0.3), displacements=((0, 0, 0), (way, 0, 0))),
        )
        for low, way in ((-GAP - 0.02, 8e-3), (SIDE + GAP, -8e-3))
    )
    contacts = [
        ts.Contact(("block", ("left", "right")), gap=GAP),
        ts.SelfContact("block", friction=0.3, gap=GAP),
    ]
    simulation = scene(obstacles={"left": left, "right": right}, contacts=contacts).compile()
    slit = ts.Disc((0.047, SIDE / 2, SIDE), (1, 0.1, 0), 0.05)
    report = simulation.cut("block", slit)
    assert len(report.pieces) == 1
    walls = 0
    while simulation.time < 0.4:
        simulation.step()
        assert simulation.crossings() == []
        found = simulation.contacts()
        own = (found.pairs == found.surfaces.index("block")).all(axis=1)
        walls = max(walls, int(own.sum()))
    assert walls > 10
    through = (found.forces[own] * np.sign(found.normals[own][:, :1]))[:, 0].sum()
    left_one, right_one = (simulation.force_on(name).force[0] for name in ("left", "right"))
    assert left_one < 0.0 < right_one
    # The slit is as deep as the plates reach: most of what they press with goes through its walls.
    assert through > 0.5 * right_one
    assert simulation.pieces("block")[0].held


@pytest.mark.parametrize("step", [ts.ImplicitEuler("5 ms"), ts.SymplecticEuler()])
def test_a_piece_falls_on_a_table_and_weighs_what_it_weighs(step):
    """A block held at its top: its lower part comes off, falls and lies."""
    table = ts.PlaneObstacle((0, 0, -0.01), (0, 0, 1))
    contacts = [
        ts.Contact(("block", "table"), friction=0.3, gap=GAP),
        ts.SelfContact("block", gap=GAP),
    ]
    fixed = [ts.Fixed("block", on=ts.Plane((0, 0, SIDE), (0, 0, 1)))]
    simulation = scene(
        obstacles={"table": table}, contacts=contacts, fixed=fixed, step=step
    ).compile()
    report = simulation.cut("block", level(0.04, 0.2))
    lost = GRAVITY * loose(report).mass
    many = 0
    while simulation.time < 0.8:
        simulation.step()
        many += 1
        if many % (1 if isinstance(step, ts.ImplicitEuler) else 20) == 0:
            assert simulation.crossings() == []
    force = simulation.force_on("table").force
    assert -force[2] == pytest.approx(
        lost, rel=1e-3 if isinstance(step, ts.ImplicitEuler) else 0.02
    )
    assert simulation.positions["block"][:, 2].min() > -0.011


def test_a_probe_presses_on_the_floor_of_a_wound():
    """Cells are taken out under a ball: it goes through the hole and presses on cut faces."""
    ball = ts.SphereObstacle(
        (SIDE / 2, SIDE / 2, SIDE + 0.012),
        0.01,
        motion=ts.Motion(times=(0, 0.4), displacements=((0, 0, 0), (0, 0, -0.05))),
    )
    contacts = [
        ts.Contact(("block", "ball"), friction=0.3, gap=GAP),
        ts.SelfContact("block", gap=GAP),
    ]
    simulation = scene(obstacles={"ball": ball}, contacts=contacts).compile()
    simulation.cut("block", level(0.05))
    simulation.ablate("block", ts.Box((0.02, 0.02, 0.05), (0.07, 0.07, 0.1)))
    first = 0.0
    while simulation.time < 0.5:
        simulation.step()
        assert simulation.crossings() == []
        if not first and simulation.force_on("ball").force[2] > 0.01:
            first = simulation.time
    force, other = (simulation.force_on(name).force for name in ("ball", "block"))
    assert force[2] > 0.1
    assert np.abs(force + other).max() <= 1e-9 * np.abs(force).max()
    # The tip reaches the floor at 5 cm, not the top at 9 cm, where it would press at 16 ms.
    assert first > 0.25


def test_contacts_of_what_stays_keep_their_forces_to_the_bit():
    """The block lies on a table while its top is cut off."""
    table = ts.PlaneObstacle((0, 0, -GAP), (0, 0, 1))
    contacts = [
        ts.Contact(("block", "table"), friction=0.5, gap=GAP),
        ts.SelfContact("block", gap=GAP),
    ]
    simulation = scene(obstacles={"table": table}, contacts=contacts, fixed=[]).compile()
    audited(simulation, 100)
    before = simulation.contacts()
    positions = simulation.positions["block"].copy()
    simulation.cut("block", level(0.075))
    after = simulation.contacts()
    assert len(before) >= 16
    for name in ("nodes", "weights", "forces", "normals", "gaps", "points"):
        assert np.array_equal(getattr(before, name), getattr(after, name)), name
    assert np.array_equal(simulation.positions["block"][: len(positions)], positions)
    force = simulation.force_on("table").force[2]
    assert force == pytest.approx(-weight((SIDE,) * 3), rel=1e-3)
    audited(simulation, 1)
    assert simulation.force_on("table").force[2] == pytest.approx(force, rel=1e-2)


def test_nothing_is_gained_in_a_collision_of_two_pieces():
    """Two pieces that fly apart and against a third body: linear momentum to the solver."""
    wall = block((0.1, 0, 0), size=(SIDE,) * 3, cells=(2, 2, 2), cell="tetra", young=2e4)
    flying = cut_block()
    made = ts.Scene(
        bodies={"block": flying["bodies"]["block"].replace(viscosity=None), "wall": wall},
        contacts=[
            ts.Contact(("block", "wall"), friction=0.3, gap=GAP),
            ts.SelfContact("block", gap=GAP),
        ],
        step=ts.ImplicitEuler("2 ms", solver=ts.ConjugateGradient(tolerance=1e-12)),
        editing=True,
    )
    simulation = made.compile()
    simulation.velocities["block"][:] = (1.0, 0.0, 0.2)
    simulation.cut("block", level(0.04, 0.1))
    first = momentum(simulation)
    for _ in range(60):
        audited(simulation, 1)
        found = momentum(simulation)
        assert found == pytest.approx(first, abs=1e-9 * np.linalg.norm(first))
    assert simulation.force_on("wall") is not None
    assert np.linalg.norm(simulation.velocities["wall"].mean(axis=0)) > 0.1


def momentum(simulation):
    """Of all bodies [N s]."""
    totals = [simulation._core.totals(body)["momentum"] for body in simulation.positions]
    return np.sum(totals, axis=0)


def run_with_cut(threads, *, way):
    """Positions at the end: straight on, through a checkpoint, or after a rewind."""
    simulation = scene("hexahedron", threads=threads).compile()
    audited(simulation, 5)
    simulation.cut("block", level(0.041, 0.1))
    audited(simulation, 10)
    if way == "rewind":
        mark = simulation.mark()
        simulation.cut("block", ts.Plane((0.04, 0, 0), (1, 0, 0)))
        audited(simulation, 5)
        simulation.rewind(mark)
    else:
        mark = simulation.mark()
    audited(simulation, 10)
    return simulation


def test_bits_are_the_same_on_two_threads_and_after_a_rewind():
    one = run_with_cut(1, way="straight")
    for other in (run_with_cut(2, way="straight"), run_with_cut(1, way="rewind")):
        assert np.array_equal(one.positions["block"], other.positions["block"])
        assert np.array_equal(one.contacts().forces, other.contacts().forces)


def test_a_checkpoint_goes_on_with_the_same_bits(tmp_path):
    simulation = run_with_cut(1, way="straight")
    assert len(simulation.contacts()) > 4
    simulation.save_checkpoint(tmp_path / "cut.ckpt")
    other = scene("hexahedron", threads=1).compile(checkpoint=tmp_path / "cut.ckpt")
    for one in (simulation, other):
        audited(one, 10)
    assert np.array_equal(simulation.positions["block"], other.positions["block"])
    assert np.array_equal(simulation.contacts().forces, other.contacts().forces)


def test_pressure_at_nodes_sums_to_the_force():
    """Each contact gives its force to nodes by weights: sum of pressure times area."""
    simulation = scene("hexahedron").compile()
    report = simulation.cut("block", level(0.041))
    audited(simulation, 150)
    areas = simulation._core.contact_areas("block")
    pressure = simulation.contact_at_nodes("block").pressure[: len(areas)]
    # Both walls are of the block.
    expected = 2.0 * GRAVITY * loose(report).mass
    assert pressure @ areas == pytest.approx(expected, rel=2e-2)


@pytest.mark.parametrize("method", ["virtual", "subdivide"])
def test_the_force_of_a_step_is_there_after_a_cut(method):
    """A cut under a probe drops contacts of faces that it touches, not the force of the step."""
    down = ts.Motion(times=(0, 0.1), displacements=((0, 0, 0), (0, 0, -0.008)))
    probe = ts.SphereObstacle((0.045, 0.045, SIDE + 0.0204), 0.02, motion=down)
    simulation = scene(
        obstacles={"probe": probe},
        contacts=[ts.Contact(("block", "probe"), friction=0.3)],
        editing=ts.Editing(method=method, room="900 %"),
    ).compile()
    for _ in range(60):
        simulation.step()
    before, count = simulation.force_on("probe"), len(simulation.contacts())
    assert before.force[2] > 0.1
    simulation.cut("block", ts.Plane((0.046, 0, 0), (1, 0, 0.1)))
    assert len(simulation.contacts()) < count
    size = np.abs(before.force).max()
    for name, force in (("probe", before.force), ("block", -before.force)):
        found = simulation.force_on(name).force  # sums of the same forces in other orders
        np.testing.assert_allclose(found, force, rtol=0, atol=1e-14 * size, err_msg=name)
    assert np.array_equal(simulation.obstacle("probe").force, before.force)
    assert simulation.step().converged
    assert not np.array_equal(simulation.force_on("probe").force, before.force)


def test_cells_of_second_order_are_refused():
    simulation = scene("hexahedron27").compile()
    with pytest.raises(ts.ParameterError, match="in contact with cells of type hexahedron27"):
        simulation.cut("block", level(0.04))
