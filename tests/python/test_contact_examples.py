"""The examples with contact: weights carried, forces opposite, no crossing at any step."""

import itertools
import math
import runpy
from pathlib import Path

import numpy as np
import pytest

from tissu import Scene

EXAMPLES = Path(__file__).parents[2] / "examples"
G = 9.81


def run(scene):
    """Its simulation at the end; every step converged and was audited."""
    simulation = scene.compile()
    for report in simulation.run():
        assert report.converged, report
        assert simulation.crossings() == []
    return simulation


def example(name):
    return run(Scene.from_yaml(EXAMPLES / f"{name}.yaml"))


def joint(simulation, one, other):
    """Force of the contacts between two on the first of them (3,) [N]."""
    found = simulation.contacts()
    a, b = found.surfaces.index(one), found.surfaces.index(other)
    there = (found.pairs == [a, b]).all(axis=1)
    back = (found.pairs == [b, a]).all(axis=1)
    return found.forces[there].sum(axis=0) - found.forces[back].sum(axis=0)


def test_a_probe_palpates():
    """What it presses with goes through the organ to its support."""
    simulation = example("palpation")
    force = simulation.force_on("probe").force
    assert 0.5 < force[2] < 20.0
    assert np.abs(simulation.force_on("organ").force + force).max() <= 1e-12 * force[2]
    # It stands still but for what creeps after 0.3 s.
    support = simulation.reactions("organ").sum(axis=0)
    assert support == pytest.approx(force, abs=0.02 * force[2])
    tip = np.array([-0.046, 0.006, 0.082 - 0.026])
    beside = simulation.positions["organ"] - tip
    beside[:, 2] = np.minimum(beside[:, 2], 0.0)  # the axis goes up from there
    assert np.linalg.norm(beside, axis=1).min() > 0.012
    assert simulation.displacements("organ")[:, 2].min() < -0.02


def test_a_probe_presses_a_surface_that_coarse_cells_carry():
    """Action is reaction through the cells, and the surface lies under the probe to its gap."""
    simulation = example("embedded")
    force = simulation.force_on("probe").force
    assert 0.5 < force[2] < 20.0
    assert np.abs(simulation.force_on("organ").force + force).max() <= 1e-12 * force[2]
    support = simulation.reactions("organ").sum(axis=0)
    assert support == pytest.approx(force, abs=0.02 * force[2])
    surface = simulation.contact_surface("organ")
    beside = surface.points - [-0.046, 0.006, 0.082 - 0.026]
    beside[:, 2] = np.minimum(beside[:, 2], 0.0)  # the axis goes up from there
    assert np.linalg.norm(beside, axis=1).min() > 0.012
    assert (surface.points - surface.rest)[:, 2].min() < -0.02


def test_a_block_is_pressed_statically():
    """Plates' forces are opposite, to the step's tolerance; the rim slides, the middle sticks."""
    simulation = example("pressed")
    low, high = simulation.force_on("table").force, simulation.force_on("plate").force
    assert low + high == pytest.approx([0, 0, 0], abs=1e-6 * high[2])
    assert np.ptp(simulation.positions["block"][:, 2]) == pytest.approx(0.06, rel=1e-4)
    forces = simulation.contacts().forces
    share = np.hypot(forces[:, 0], forces[:, 1]) / np.abs(forces[:, 2])
    assert share.max() == pytest.approx(0.1, rel=1e-3)
    assert share.min() < 0.01


def test_a_die_and_a_ball_tumble_on_a_pad():
    """They come to rest on it with their weights, the die flat on a face."""
    simulation = example("dice")
    for name, weight in (("die", 0.008 * G), ("ball", 0.012 * G)):
        thing = simulation.rigid(name)
        assert thing.force[2] == pytest.approx(weight, rel=2e-2)
        assert np.linalg.norm(thing.velocity) < 5e-3
    rotation = simulation.rigid("die").rotation
    assert np.abs(rotation[:, np.abs(rotation[2]).argmax()])[2] > 0.99


def test_sheets_bounce_to_the_square_of_their_restitution():
    """Each bounce forgets at most the way of a step, 2 g h / v = 0.2 % of the first height."""
    simulation = Scene.from_yaml(EXAMPLES / "bounce.yaml").compile()
    top = dict.fromkeys(simulation.bodies, 0.0)
    fallen = math.sqrt(2 * 0.05 / G)
    while simulation.time < fallen + 1.6 * 0.9 * fallen:
        simulation.step()
        assert simulation.crossings() == []
        for body in top:
            if simulation.time > fallen + 1e-3:
                height = simulation.positions[body][:, 2].mean() - 2e-3
                top[body] = max(top[body], height / 0.05)
    for body, e in (("dull", 0.3), ("fair", 0.6), ("lively", 0.9)):
        assert top[body] == pytest.approx(e**2, rel=2e-2)


def test_an_organ_lies_on_a_table():
    simulation = example("table")
    body = simulation.scene.bodies["organ"]
    weight = simulation.meshes["organ"].volume() * body.density * G
    # It still moves by 5 mm/s: less than a hundredth of the weight turns that round in 50 ms.
    assert simulation.force_on("table").force[2] == pytest.approx(-weight, rel=0.01)
    assert np.linalg.norm(simulation.velocities["organ"], axis=1).max() < 0.02
    assert simulation.positions["organ"][:, 2].min() > -0.081


def test_blocks_stand_on_each_other():
    """Each joint carries the weight above it, to a hundredth while the stack still sways."""
    simulation = example("stack")
    weight = 1000.0 * 0.05**3 * G
    below = ["floor", "first", "second", "third", "fourth"]
    for k, (lower, upper) in enumerate(itertools.pairwise(below)):
        lifted = joint(simulation, upper, lower)
        assert lifted[2] == pytest.approx((4 - k) * weight, rel=0.01)
    for name in below[1:]:
        moved = simulation.displacements(name)
        assert np.abs(moved[:, :2]).max() < 1e-3  # they bulge, and none slides off
        assert np.linalg.norm(simulation.velocities[name], axis=1).max() < 5e-3


def test_a_sheet_is_turned_over_onto_itself():
    simulation = example("fold")
    assert np.linalg.norm(simulation.velocities["sheet"], axis=1).max() < 5e-3
    found = simulation.contacts()
    own = (found.pairs == found.surfaces.index("sheet")).all(axis=1)
    assert own.any()
    # Layers rest no nearer than their thickness: as far as all self-contacts say.
    assert found.gaps[own].min() > -0.01 * 2e-3
    end = simulation.positions["sheet"][simulation.meshes["sheet"].points[:, 0] > 0.199]
    assert end[:, 0] == pytest.approx(0.06, abs=1e-9)  # turned by half a turn about x = 13 cm


def test_a_probe_works_its_way_into_an_organ():
    """What presses it is gone after each removal, and it presses again deeper, for four times."""
    made = runpy.run_path(str(EXAMPLES / "resection.py"))
    simulation = made["scene"]().compile()
    cells, forces = [simulation.meshes["organ"].cell_count], [[]]

    def watch(report):
        assert report.converged, report
        assert simulation.crossings() == []
        if simulation.meshes["organ"].cell_count < cells[-1]:
            cells.append(simulation.meshes["organ"].cell_count)
            forces.append([])
        forces[-1].append(simulation.force_on("probe").force[2])

    simulation.on_step(watch)
    made["work"](simulation)
    assert len(cells) == 5
    assert all(max(between) > 0.5 for between in forces[:4])
    # The probe goes on down, and meets what was uncovered: in the first step it is nearly free.
    for before, after in itertools.pairwise(forces):
        assert after[0] < 0.5 * before[-1]


def test_an_organ_is_pushed_off_what_it_overlaps():
    """In balance without loads: what presses on the organ goes through it to its support."""
    simulation = example("overlap")
    assert "pushed apart" in str(simulation.plan())
    force = simulation.force_on("organ").force
    assert force[2] < -0.05
    others = simulation.force_on("block").force + simulation.force_on("bone").force
    assert np.abs(force + others).max() <= 1e-12 * np.linalg.norm(force)
    support = simulation.reactions("organ").sum(axis=0)
    assert np.linalg.norm(support + force) < 0.03 * np.linalg.norm(force)


def test_two_organs_are_pushed_together():
    made = runpy.run_path(str(EXAMPLES / "two_organs.py"))
    simulation = run(made["scene"]())
    on_lower = simulation.force_on("lower").force
    assert on_lower[2] < -0.3
    assert np.abs(on_lower + simulation.force_on("upper").force).max() <= 1e-12 * -on_lower[2]
    # The lower one still sways a little, 0.2 s after the upper one stopped.
    held = simulation.reactions("lower").sum(axis=0)
    assert held == pytest.approx(-on_lower, abs=0.05 * -on_lower[2])


def test_a_flap_that_a_knife_cuts_hangs_down_onto_a_table():
    """examples/flap.yaml: the sheet stays in one piece, and the flap lies on the table."""
    simulation = example("flap")
    (piece,) = simulation.pieces("sheet")
    assert piece.held
    flap = 1000.0 * G * 0.061 * 0.053 * 2e-3  # [N]
    assert 0.2 * flap < -simulation.force_on("table").force[2] < 0.8 * flap
    # Half its thickness and the gap above the table.
    lowest = simulation.surface("sheet").points[:, 2].min()
    assert 1e-3 < lowest + 0.035 < 1.5e-3


def test_a_lobe_falls_and_the_table_bears_its_weight():
    """examples/lobe.py: nothing crosses in any step, and the force is the weight to 1 %."""
    names = runpy.run_path(str(EXAMPLES / "lobe.py"))
    simulation = names["scene"]().compile()
    report = names["operate"](simulation)
    assert simulation.crossings() == []
    (lobe,) = (piece for piece in report.pieces if not piece.held)
    weight = names["GRAVITY"] * lobe.mass
    assert -simulation.force_on("table").force[2] == pytest.approx(weight, rel=1e-2)
