"""Bodies that overlap at the start are pushed apart: `contact: {overlap: separate}`."""

import numpy as np
import pytest

import tissu as ts
from tissu.errors import SceneError

EDGE = 0.1
OVERLAP = 4e-3
GAP = 1e-4
LEFT = ts.Box(max=(1e-6, None, None))
RIGHT = ts.Box(min=(2 * EDGE - OVERLAP - 1e-6, None, None))


def block(x, young, cells=3):
    mesh = ts.BarMesh(size=(EDGE, EDGE, EDGE), cells=(cells, cells, cells), origin=(x, 0, 0))
    law = ts.StVK(young=young, poisson=0.0)
    return ts.Body(mesh=mesh, law=law, density=1000.0)


def two(second=1e4, **fields):
    fields = {"fixed": [ts.Fixed("a", on=LEFT), ts.Fixed("b", on=RIGHT)]} | fields
    contact = ts.ContactSettings(overlap=fields.pop("overlap", "separate"))
    return ts.Scene(
        bodies={"a": block(0.0, 1e4), "b": block(EDGE - OVERLAP, second)},
        contacts=[ts.Contact(("a", "b"), gap=GAP)],
        contact=contact,
        step=ts.ImplicitEuler("10 ms"),
        **fields,
    )


@pytest.mark.parametrize("ratio", [1.0, 10.0])
def test_blocks_share_the_overlap_by_their_stiffness(ratio):
    """Two springs in a row, of E A / L each; the strain's square (0.1 %) and the gap set 1 %."""
    simulation = two(ratio * 1e4).compile()
    assert simulation.crossings() == []
    way = OVERLAP + GAP
    moved = [np.abs(simulation.displacements(name)[:, 0]).max() for name in "ab"]
    np.testing.assert_allclose(moved[0], way * ratio / (1 + ratio), rtol=0.01, atol=GAP / 4)
    np.testing.assert_allclose(moved[1], way / (1 + ratio), rtol=0.01, atol=GAP / 4)
    for name in "ab":
        points = simulation.meshes[name].points[:, 0]
        held = points == (points.min() if name == "a" else points.max())
        np.testing.assert_array_equal(simulation.displacements(name)[held], 0.0)
        assert not simulation.velocities[name].any()
    assert "pushed apart" in str(simulation.plan())
    for _ in range(20):
        report = simulation.step()
        assert report.converged
        assert simulation.crossings() == []
    strain = moved[0] / EDGE
    stress = 1e4 * strain  # and its square, of St-Venant-Kirchhoff: 1.5 strain^2
    force = np.linalg.norm(simulation.force_on("a").force)
    np.testing.assert_allclose(force, stress * EDGE**2, rtol=2.0 * strain + GAP / OVERLAP)


def test_it_is_refused_unless_asked_for():
    with pytest.raises(SceneError, match="overlap at the start"):
        two(overlap="refuse").compile()


def test_same_bits_on_two_threads_and_from_a_checkpoint(tmp_path):
    ends = []
    for threads in (1, 2):
        simulation = two(threads=threads).compile()
        simulation.step()
        ends.append(np.array(simulation.positions["a"]))
    np.testing.assert_array_equal(ends[0], ends[1])
    simulation.save_checkpoint(tmp_path / "c")
    resumed = two(threads=2).compile(checkpoint=tmp_path / "c")
    simulation.step()
    resumed.step()
    np.testing.assert_array_equal(simulation.positions["b"], resumed.positions["b"])


def test_a_body_that_nothing_holds_goes_as_a_whole():
    """It ends without stress: a rotation and a translation, found by Kabsch's method, remain."""
    simulation = two(fixed=[ts.Fixed("a", on=LEFT)]).compile()
    assert simulation.crossings() == []
    assert np.abs(simulation.displacements("a")).max() < GAP
    rest, now = simulation.meshes["b"].points, np.array(simulation.positions["b"])
    rest, now = rest - rest.mean(axis=0), now - now.mean(axis=0)
    u, _, v = np.linalg.svd(rest.T @ now)
    np.testing.assert_allclose(now, rest @ u @ v, atol=GAP / 10)
    moved = simulation.displacements("b")[:, 0].mean()
    assert 0.9 * OVERLAP < moved < 2.0 * OVERLAP


def cube(corner, cells=4, edge=EDGE):
    mesh = ts.BarMesh(size=(edge,) * 3, cells=(cells,) * 3, origin=tuple(corner))
    return ts.Body(mesh=mesh, law=ts.StableNeoHooke(young=1e4, poisson=0.45), density=1000.0)


def settled(scene, steps=5):
    """The simulation some steps later: whole, without crossings, and hardly moved."""
    simulation = scene.compile()
    assert simulation.crossings() == []
    start = {name: np.array(simulation.positions[name]) for name in simulation.meshes}
    for _ in range(steps):
        assert simulation.step().converged
        assert simulation.crossings() == []
    for name, places in start.items():
        assert np.abs(simulation.positions[name] - places).max() < 0.02 * EDGE / 4  # a gap
    return simulation


@pytest.mark.parametrize("deep", [0.05, 0.2, 0.4])
def test_a_corner_in_a_corner(deep):
    far = (1 - deep) * EDGE
    settled(
        ts.Scene(
            bodies={"a": cube((0, 0, 0)), "b": cube((far, far, far), cells=3)},
            contacts=[ts.Contact(("a", "b"))],
            contact=ts.ContactSettings(overlap="separate"),
            fixed=[
                ts.Fixed("a", on=LEFT),
                ts.Fixed("b", on=ts.Box(min=(far + EDGE - 1e-6, None, None))),
            ],
            step=ts.ImplicitEuler("10 ms"),
        )
    )


def test_a_row_that_is_held_at_its_ends():
    step = EDGE - OVERLAP
    row = {name: cube((k * step, 3e-3 * k, 2e-3 * k)) for k, name in enumerate("abcd")}
    ends = [
        ts.Fixed("a", on=LEFT),
        ts.Fixed("d", on=ts.Box(min=(3 * step + EDGE - 1e-6, None, None))),
    ]
    simulation = settled(
        ts.Scene(
            bodies=row,
            contacts=[ts.Contact(pair) for pair in (("a", "b"), ("b", "c"), ("c", "d"))],
            contact=ts.ContactSettings(overlap="separate"),
            fixed=ends,
            step=ts.ImplicitEuler("10 ms"),
        )
    )
    assert "pushed apart" in str(simulation.plan())


@pytest.mark.parametrize(
    "obstacle",
    [
        ts.SphereObstacle((EDGE / 2, EDGE / 2, EDGE + 0.02), 0.026),
        ts.PlaneObstacle(point=(0, 0, EDGE - OVERLAP), normal=(0, 0, -1)),
        ts.CapsuleObstacle(ends=((0.05, 0.05, EDGE + 4e-3), (0.05, 0.05, 0.2)), radius=8e-3),
    ],
    ids=lambda one: one.type,
)
def test_obstacles_stay_and_the_body_gives_way(obstacle):
    simulation = settled(
        ts.Scene(
            bodies={"a": cube((0, 0, 0))},
            obstacles={"x": obstacle},
            contacts=[ts.Contact(("a", "x"))],
            contact=ts.ContactSettings(overlap="separate"),
            fixed=[ts.Fixed("a", on=ts.Box(max=(None, None, 1e-6)))],
            step=ts.ImplicitEuler("10 ms"),
        )
    )
    assert simulation.force_on("a").force[2] < 0.0


def test_a_body_inside_another_without_crossing_is_left_there():
    scene = ts.Scene(
        bodies={"a": cube((0, 0, 0)), "b": cube((0.04, 0.04, 0.04), 2, 0.02)},
        contacts=[ts.Contact(("a", "b"))],
        contact=ts.ContactSettings(overlap="separate"),
        fixed=[ts.Fixed("a", on=LEFT)],
        step=ts.ImplicitEuler("10 ms"),
    )
    simulation = scene.compile()
    assert not simulation.displacements("b").any()
    assert "pushed apart" not in str(simulation.plan())


@pytest.mark.parametrize("mass", [None, 0.01])
def test_obstacles_that_overlap_each_other_are_refused_in_a_sentence(mass):
    free = ts.SphereObstacle((0.02, 0.02, 0.2), radius=0.01, mass=0.01)
    wall = ts.SphereObstacle((0.03, 0.02, 0.2), radius=0.01, mass=mass)
    scene = ts.Scene(
        bodies={"a": block(0.0, 1e4)},
        obstacles={"ball": free, "wall": wall},
        contacts=[ts.Contact("all")],
        contact=ts.ContactSettings(overlap="separate"),
        step=ts.ImplicitEuler("10 ms"),
    )
    with pytest.raises(SceneError, match=r'"ball" and "wall" by 0.01 m.*Move one of them[.]$'):
        scene.compile()


def test_what_is_pushed_out_is_not_said_to_lie_inside():
    scene = ts.Scene(
        bodies={"a": block(0.0, 1e4)},
        obstacles={"box": ts.BoxObstacle((EDGE - OVERLAP, 0.01, 0.01), (0.2, 0.02, 0.02))},
        contacts=[ts.Contact(("a", "box"), gap=GAP)],
        contact=ts.ContactSettings(overlap="separate"),
        fixed=[ts.Fixed("a", on=LEFT)],
        step=ts.ImplicitEuler("10 ms"),
    )
    notes = scene.check().notes
    assert not [note for note in notes if "lies inside" in note]


def test_a_block_in_a_box_obstacle():
    scene = ts.Scene(
        bodies={"a": block(0.0, 1e4)},
        obstacles={"box": ts.BoxObstacle((EDGE - OVERLAP, -0.1, -0.1), (0.2, 0.2, 0.2))},
        contacts=[ts.Contact(("a", "box"), gap=GAP)],
        contact=ts.ContactSettings(overlap="separate"),
        fixed=[ts.Fixed("a", on=LEFT)],
        step=ts.ImplicitEuler("10 ms"),
    )
    simulation = scene.compile()
    assert simulation.crossings() == []
    moved = np.abs(simulation.displacements("a")[:, 0]).max()
    np.testing.assert_allclose(moved, OVERLAP + GAP, rtol=0.01, atol=GAP / 4)


def test_held_nodes_that_overlap_are_refused_by_name():
    scene = two(
        fixed=[
            ts.Fixed("a", on=ts.Box(min=(None, None, None))),
            ts.Fixed("b", on=ts.Box(min=(None, None, None))),
        ]
    )
    with pytest.raises(SceneError, match=r'"a" and "b" in .* places; separate could not') as caught:
        scene.compile()
    assert len(caught.value.problems) == 1
    assert scene.check().problems == caught.value.problems
