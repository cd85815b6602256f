"""What is wrong while contact runs is said in a sentence, and leaves the simulation as it was."""

import re

import numpy as np
import pytest

import tissu as ts
from contact_audit import audited
from contact_scenes import cube, scene
from tissu.errors import ParameterError, SceneError, TissuError


def resting():
    contacts = [ts.Contact(("liver", "table"))]
    return scene(bodies={"liver": cube()}, contacts=contacts, gravity=(0, 0, -9.81))


def test_a_step_without_systems_and_stages_is_refused():
    step = ts.BDF2FixedPoint("1 ms")
    with pytest.raises(
        SceneError, match=f"found {step.type} with 1 contact; accepted with contact"
    ):
        resting().replace(step=step).compile()


CALLS = {
    "unknown obstacle": lambda s: s.obstacle("plate"),
    "unknown surface": lambda s: s.force_on("plate"),
    "a body in the place of an obstacle": lambda s: s.obstacle("liver"),
    "a displacement that is not finite": lambda s: s.obstacle("table").move((0, 0, np.nan)),
    "a displacement of two numbers": lambda s: s.obstacle("table").move((0, 0)),
    "a displacement in newtons": lambda s: s.obstacle("table").move((0, 0, "1 N")),
    "an axis of zero": lambda s: s.obstacle("table").move(angle=1.0, axis=(0, 0, 0)),
    "a time of zero": lambda s: s.obstacle("table").move((0, 0, 0.1), over=0),
    "a negative time": lambda s: s.obstacle("table").release(over=-1),
}


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS.keys())
def test_a_wrong_call_changes_nothing(call):
    simulation = resting().compile()
    other = resting().compile()
    audited(simulation, 12)
    audited(other, 12)
    with pytest.raises(ParameterError) as error:
        call(simulation)
    text = str(error.value)
    assert "found" in text
    assert "\n" not in text
    audited(simulation, 3)
    audited(other, 3)
    assert np.array_equal(simulation.positions["liver"], other.positions["liver"])


def test_plates_that_close_on_a_body_name_it_and_leave_the_state_whole():
    """Two plates that leave no room at all: the step says so, as often as it is tried."""
    plates = {
        "low": ts.PlaneObstacle((0, 0, -0.01), (0, 0, 1)),
        "high": ts.PlaneObstacle((0, 0, 0.11), (0, 0, -1)),
    }
    contacts = [ts.Contact(("liver", ("low", "high")))]
    made = scene(bodies={"liver": cube()}, obstacles=plates, contacts=contacts)
    simulation = made.compile()
    audited(simulation, 3)
    before = simulation.positions["liver"].copy()
    simulation.obstacle("high").move((0, 0, -0.13))
    for _ in range(2):
        with pytest.raises(TissuError, match="liver"):
            simulation.step()
        assert np.array_equal(simulation.positions["liver"], before)
        assert simulation.time == pytest.approx(0.03)
        assert simulation.crossings() == []
    simulation.obstacle("high").move((0, 0, 0))
    audited(simulation, 3)


@pytest.mark.parametrize("gap", [0.1, 1e10, 1e300])
def test_a_gap_that_is_as_long_as_the_body_is_refused(gap):
    """The body is a cube of 10 cm."""
    wide = [ts.Contact(("liver", "table"), gap=gap)]
    words = re.escape(f"contacts[0].gap: found {gap:g} m for 'liver', ")
    with pytest.raises(SceneError, match=words) as error:
        resting().replace(contacts=wide).compile()
    assert "which is 0.1 m long; a gap smaller than the body is accepted" in str(error.value)
    resting().replace(contacts=[ts.Contact(("liver", "table"), gap=0.099)]).compile()


def with_triangles(*triangles):
    points = np.array(
        [(0, 0, -0.1), (0.1, 0, -0.1), (0.3, 0, -0.1), (0, 0.1, -0.1), (0.1, 1e-9, -0.1)]
    )
    mesh = ts.Mesh(points=points, cells=(("triangle", np.array(triangles)),))
    contacts = [ts.Contact(("liver", "table"))]
    return resting().replace(obstacles={"table": ts.MeshObstacle(mesh=mesh)}, contacts=contacts)


def test_obstacles_without_area_are_refused():
    """Corners on a line, or two in one place. One triangle that has an area is enough."""
    for count, flat in (("1 triangle", [(0, 1, 2)]), ("2 triangles", [(0, 1, 2), (1, 1, 3)])):
        with pytest.raises(SceneError) as error:
            with_triangles(*flat).compile()
        text = str(error.value)
        assert f"obstacles.table.mesh: found {count}, none of which has an area" in text
        assert "with the corners (0, 0, -0.1), (0.1, 0, -0.1), (0.3, 0, -0.1) m" in text
    with_triangles((0, 1, 2), (0, 4, 2)).compile()
