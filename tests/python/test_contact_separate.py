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
    simulation = two(fixed=[ts.Fixed("a", on=LEFT)]).compile()
    assert simulation.crossings() == []
    assert np.abs(simulation.displacements("a")).max() < GAP
    moved = simulation.displacements("b")
    np.testing.assert_allclose(moved, np.broadcast_to(moved[0], moved.shape), atol=GAP / 10)
    np.testing.assert_allclose(moved[0], [OVERLAP, 0, 0], atol=3 * GAP)


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
