"""Contacts of bodies that lost cells: bits on any threads and from files, and worlds made anew."""

import numpy as np
import pytest

import tissu as ts
from contact_edited import pressed, top_middle
from test_contact_editing import STEPS, THIRD, cut_both, two_blocks
from tissu.compile.contact_surface import body_surface

METHODS = ["implicit_euler", "bdf2", "static", "symplectic_euler"]


def go(simulation, steps):
    for _ in range(steps):
        simulation.step()
    return simulation


def ends(simulation):
    """What a run left behind."""
    bodies = [np.array(simulation.positions[name]) for name in simulation.bodies]
    found = simulation.contacts()
    return [*bodies, found.nodes, found.forces, found.gaps]


def require_equal(one, other):
    for a, b in zip(ends(one), ends(other), strict=True):
        assert np.array_equal(a, b)


def scene_of(step, **fields):
    """Two blocks; in static steps a block under a tool, which finds its equilibrium sooner."""
    return (pressed if step == "static" else two_blocks)(STEPS[step], **fields)


def cut(simulation):
    """What is touched goes in part."""
    if "high" in simulation.bodies:
        cut_both(simulation)
    else:
        simulation.remove_cells(body="block", cells=[0, 18, 20])


def steps_of(step):
    """Until it presses, and after the cut."""
    return {"static": (1, 2), "symplectic_euler": (40, 40)}.get(step, (14, 10))


@pytest.mark.parametrize("threads", [2, 4])
@pytest.mark.parametrize("step", METHODS)
def test_any_number_of_threads_gives_the_same_bits(step, threads):
    before, after = steps_of(step)
    runs = []
    for count in (1, threads):
        simulation = go(scene_of(step, threads=count).compile(), before)
        cut(simulation)
        runs.append(go(simulation, after))
    assert len(runs[0].contacts())
    require_equal(*runs)


@pytest.mark.parametrize("step", METHODS)
def test_a_checkpoint_after_a_cut_goes_on_bit_for_bit(tmp_path, step):
    before, after = steps_of(step)
    made = scene_of(step)
    simulation = go(made.compile(), before)
    cut(simulation)
    simulation.save_checkpoint(tmp_path / "cut")  # before any step has seen what is uncovered
    other = made.compile(checkpoint=tmp_path / "cut")
    require_equal(simulation, other)
    assert len(simulation.contacts())
    go(simulation, after)
    go(other, after)
    require_equal(simulation, other)
    simulation.save_checkpoint(tmp_path / "later")
    other = made.compile(checkpoint=tmp_path / "later")
    require_equal(go(simulation, 2), go(other, 2))


def in_its_hole():
    """A tool that presses on the floor of the hole that a cell left."""
    simulation = pressed().compile()
    simulation.remove_cells(body="block", cells=top_middle(simulation))
    simulation.obstacle("tool").move((0, 0, -THIRD - 0.006), over="0.1 s")
    go(simulation, 24)
    assert simulation.force_on("tool").force[2] > 0.1
    return simulation


def test_a_world_made_anew_keeps_contacts_of_what_was_uncovered():
    """By grabbing, or another number: the surface is that of the cells there, at once."""
    plain, grabbing, softer = in_its_hole(), in_its_hole(), in_its_hole()
    grabbing.allow_grabbing()
    softer.parameters["bodies.block.law.young"] = 1e4
    softer.parameters["bodies.block.law.young"] = 2e4
    for changed in (grabbing, softer):
        require_equal(plain, changed)
        assert changed.crossings() == []
        go(changed, 5)
    go(plain, 5)
    for changed in (grabbing, softer):
        # An iterative solver begins anew: within a hundredth of its tolerance's effect on forces.
        force, other = (one.force_on("tool").force[2] for one in (plain, changed))
        assert other == pytest.approx(force, rel=1e-3)


def test_reset_brings_all_cells_and_surfaces_back():
    simulation, fresh = in_its_hole(), pressed().compile()
    simulation.reset()
    assert not len(simulation.contacts())
    for one in (simulation, fresh):
        go(one, 14)
    require_equal(simulation, fresh)
    assert simulation.force_on("tool").force[2] > 0.1


def test_pressure_at_nodes_follows_the_surface():
    """The force on the floor of the hole is the sum of pressure times area of the surface now."""
    simulation = in_its_hole()
    pressure = simulation.contact_at_nodes("block").pressure
    assert len(pressure) == simulation.meshes["block"].node_count
    surface = body_surface(simulation.meshes["block"], simulation.scene.bodies["block"])
    corners = simulation.meshes["block"].points[surface.triangles]
    area = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    shares = np.zeros(len(pressure))
    np.add.at(shares, surface.triangles.ravel(), np.repeat(area / 6.0, 3))
    found = simulation.contacts()
    normal = np.einsum("ij,ij->i", found.forces, found.normals)
    sides = np.where(found.weights > 0, found.weights, 0.0).sum(axis=1)
    assert np.allclose(sides, 1.0)
    assert (pressure * shares).sum() == pytest.approx(normal.sum(), rel=1e-9)


def test_what_is_not_there_any_more_is_refused_as_ever():
    simulation = pressed(editing=False).compile()
    with pytest.raises(ts.errors.ParameterError, match="cannot be edited"):
        simulation.remove_cells(body="block", cells=[0])
