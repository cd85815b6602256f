"""What a running simulation says of its contacts: forces, moments, the audit, led obstacles."""

import math
import re
from pathlib import Path

import numpy as np
import pytest

import tissu as ts
from contact_scenes import cube, scene
from tissu.errors import ParameterError, SceneError

WEIGHT = 1000.0 * 1e-3 * 9.81
"""of the cube [N]"""
CENTER = (0.05, 0.05, 0.15)
"""of a ball that is led [m]"""


@pytest.fixture(scope="module")
def resting():
    """A cube that has come to rest on a table, whose point is beside it."""
    made = scene(
        bodies={"liver": cube(viscosity=ts.Rayleigh(mass=5.0, stiffness=0.01))},
        obstacles={"table": ts.PlaneObstacle((0, 0, -0.0012), (0, 0, 1))},
        contacts=[ts.Contact(("liver", "table"), friction=0.5)],
        gravity=(0, 0, -9.81),
    )
    simulation = made.compile()
    reports = [simulation.step() for _ in range(300)]
    assert all(report.converged for report in reports)
    return simulation, reports[-1]


def test_a_table_carries_the_weight(resting):
    """To a thousandth, the goal of the design for bodies at rest."""
    simulation, _ = resting
    force, moment = simulation.force_on("table")
    assert force == pytest.approx([0, 0, -WEIGHT], abs=1e-3 * WEIGHT)
    # About the table's point: the weight acts 5 cm beside it on x and y.
    assert moment == pytest.approx([-0.05 * WEIGHT, 0.05 * WEIGHT, 0], abs=1e-3 * 0.05 * WEIGHT)
    on_liver = simulation.force_on("liver").force
    assert np.abs(on_liver + force).max() <= 1e-12 * WEIGHT


def test_the_contacts_say_who_presses_where(resting):
    simulation, report = resting
    found = simulation.contacts()
    assert report.contacts == int((np.linalg.norm(found.forces, axis=1) > 0).sum())
    assert "contacts" in str(report)
    assert found.surfaces == ("liver", "table")
    assert np.array_equal(found.pairs, np.tile([0, 1], (len(found), 1)))
    assert np.array_equal(found.weights, np.tile([1.0, 0, 0, 0], (len(found), 1)))
    assert np.array_equal(found.normals, np.tile([0.0, 0, 1], (len(found), 1)))
    below = simulation.meshes["liver"].points[:, 2] == 0
    assert np.array_equal(np.sort(found.nodes[:, 0]), np.flatnonzero(below))
    assert (found.nodes[:, 1:] == -1).all()
    assert np.array_equal(found.points, simulation.positions["liver"][found.nodes[:, 0]])
    assert np.sum(found.forces, axis=0) == pytest.approx([0, 0, WEIGHT], abs=1e-3 * WEIGHT)
    # The distance from the plane less the default gap, 2 % of the mean edge.
    gap = 0.02 * 0.05 * (48 + 24 * math.sqrt(2)) / 72
    height = found.points[:, 2] + 0.0012
    assert found.gaps == pytest.approx(height - gap, abs=1e-15)
    pressing = np.linalg.norm(found.forces, axis=1) > 0
    assert np.abs(found.gaps[pressing]).max() <= 0.01 * gap


def test_the_audit_names_what_crosses(resting):
    simulation, _ = resting
    assert simulation.crossings() == []
    before = simulation.positions["liver"].copy()
    simulation.positions["liver"][:, 2] -= 1.0
    crossed = simulation.crossings()
    simulation.positions["liver"][:] = before
    assert {(c.surface, c.other) for c in crossed} == {("liver", "table")}
    assert sorted(c.edge[0] for c in crossed) == [n for n in range(27) if n != 13]
    assert {len(c.edge) for c in crossed} == {1}
    assert {c.triangle for c in crossed} == {()}


def pushed(**fields):
    """A held cube below a ball."""
    return scene(
        bodies={"liver": cube()},
        fixed=[ts.Fixed("liver", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        obstacles={"ball": ts.SphereObstacle(CENTER, 0.02)},
        contacts=[ts.Contact(("liver", "ball"))],
        **fields,
    ).compile()


def test_an_obstacle_is_led_live():
    simulation = pushed()
    ball = simulation.obstacle("ball")
    assert ball.released
    assert np.array_equal(ball.place_of(CENTER), CENTER)
    ball.move((0, 0, "-4 cm"), over="100 ms")
    assert not ball.released
    for _ in range(5):
        simulation.step()
    assert ball.place_of(CENTER) == pytest.approx([0.05, 0.05, 0.13], abs=1e-12)
    for _ in range(15):
        simulation.step()
    assert ball.place_of(CENTER) == pytest.approx([0.05, 0.05, 0.11], abs=1e-12)
    # 1 cm deep in the block: it is pushed up, and the block down, by the same force.
    force = simulation.force_on("ball").force
    assert force[2] > 0.01
    assert np.abs(simulation.force_on("liver").force + force).max() <= 1e-12 * np.abs(force).max()
    assert simulation.crossings() == []
    ball.release(over="50 ms")
    for _ in range(10):
        simulation.step()
    assert ball.released
    assert ball.place_of(CENTER) == pytest.approx([0.05, 0.05, 0.15], abs=1e-12)
    assert not simulation.force_on("ball").force.any()


def test_a_rotation_leads_the_origin_round_its_centre():
    simulation = pushed()
    simulation.obstacle("ball").move(angle="90 deg", axis=(0, 0, 2), center=(0, 0.05, 0))
    simulation.step()
    place = simulation.obstacle("ball").place_of(CENTER)
    assert place == pytest.approx([0, 0.1, 0.15], abs=1e-12)


def test_what_is_refused(resting):
    simulation, _ = resting
    with pytest.raises(ParameterError, match="found 'gut', which meets nothing"):
        simulation.force_on("gut")
    with pytest.raises(ParameterError, match="found obstacle 'tabl'"):
        simulation.obstacle("tabl")
    table = simulation.obstacle("table")
    with pytest.raises(ParameterError, match="found the axis"):
        table.move(axis=(0, 0, 0))
    with pytest.raises(ParameterError, match="a positive time is accepted"):
        table.move(over=0.0)
    bare = scene().compile()
    for call in (bare.contacts, bare.crossings, lambda: bare.force_on("gut")):
        with pytest.raises(ParameterError, match="this scene has no contacts"):
            call()
    with pytest.raises(ParameterError, match="found obstacle 'table'"):
        bare.obstacle("table")


def test_the_calls_of_the_page_run():
    """The last example of docs/guide/contact.md, with the scene of the first; the others alone."""
    page = (Path(__file__).parents[2] / "docs" / "guide" / "contact.md").read_text(encoding="utf-8")
    first, free, own, second = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    alone = {"print": lambda *found: None}
    exec(compile(free, "contact.md", "exec"), alone)
    ball = alone["ball"]
    assert ball.velocity[0] == pytest.approx(0.01 * ball.spin[1], rel=1e-2)  # it rolls by now
    printed = []
    exec(compile(own, "contact.md", "exec"), {"print": printed.append})
    assert f"```text\n{printed[0]}\n```" in page
    names = {"print": lambda check: None}
    exec(compile(first, "contact.md", "exec"), names)
    exec(compile(second, "contact.md", "exec"), names)
    assert names["report"].converged
    assert names["simulation"].crossings() == []


def laid(z):
    """A cube on a table at this height [m]."""
    table = ts.PlaneObstacle((0, 0, z), (0, 0, 1))
    contacts = [ts.Contact(("liver", "table"), gap="1 mm")]
    return scene(bodies={"liver": cube()}, obstacles={"table": table}, contacts=contacts)


def test_overlap_at_the_start_is_refused_at_check():
    (problem,) = laid(0.01).check().problems
    assert problem.startswith("contacts: found surfaces that overlap at the start: ")
    assert '"liver" and "table" in 9 places, 0.01 m deep at most; they must' in problem
    with pytest.raises(SceneError, match="overlap at the start"):
        laid(0.01).compile()


def test_a_plane_that_faces_away_is_named():
    """All of the body is behind it, as with a normal of the wrong sign."""
    table = ts.PlaneObstacle((0, 0, -0.01), (0, 0, -1))
    contacts = [ts.Contact(("liver", "table"), gap="1 mm")]
    made = scene(bodies={"liver": cube()}, obstacles={"table": table}, contacts=contacts)
    (problem,) = made.check().problems
    assert '(all of "liver" is behind "table", whose normal must point to the side' in problem


def test_what_touches_is_moved_apart():
    """By the gap at most, and within a hundredth of it, the core's tolerance."""
    made = laid(0.0)
    assert made.check().ok
    simulation = made.compile()
    assert simulation.crossings() == []
    low = simulation.positions["liver"][:, 2].min()
    assert 0.99e-3 <= low <= 1e-3
