"""Contact in the live view: obstacles, arrows, pressure by colour, and a probe led by hand."""

import math
import re

import numpy as np
import pytest
from test_view_browser import WAIT, choose, of, on_screen, picture, settled, until

import tissu as ts
from tissu.live_view.fields import FIELDS, offered
from tissu.live_view.gizmo import Gizmo
from tissu.live_view.layers import LAYERS
from tissu.live_view.surface import seen
from tissu.live_view.tools import TOOLS
from tissu.live_view.tools.obstacle import MoveObstacle, quaternion

TIP = np.array([0.1, 0.04, 0.1])
"""of the probe, 2 cm above the organ [m]"""
UP = np.array([0.0, 0.0, 1.0])
MIDDLE = TIP + 0.03 * UP
"""of the probe [m]"""


def probed(**changes):
    """A block of 20 cm that is held below, and a probe upright above its middle."""
    mesh = ts.BarMesh(size=(0.2, 0.08, 0.08), cells=(10, 4, 4), cell="tetra")
    body = ts.Body(
        mesh=mesh,
        law=ts.StVK(young="6 kPa", poisson=0.4),
        density=1000,
        viscosity=ts.Rayleigh(mass=2, stiffness=0.01),
    )
    probe = ts.CapsuleObstacle((MIDDLE - 0.02 * UP, MIDDLE + 0.02 * UP), radius="1 cm")
    fields = {
        "bodies": {"organ": body},
        "fixed": [ts.Fixed("organ", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        "obstacles": {"probe": probe},
        "contacts": [ts.Contact(("organ", "probe"), friction=0.2)],
        "step": ts.ImplicitEuler("10 ms"),
        **changes,
    }
    return ts.Scene(name="palpated", **fields).compile()


def layers(simulation):
    return {layer.name: layer for layer in LAYERS if layer.offered(simulation)}


def test_a_scene_without_contacts_has_none_of_it():
    bare = probed(contacts=[])
    assert not {"obstacles", "contacts"} & set(layers(bare))
    assert "contact_pressure" not in offered(bare, {"organ": seen(bare.meshes["organ"])})
    assert not MoveObstacle.offered(bare)
    touched = probed()
    assert {"obstacles", "contacts"} <= set(layers(touched))
    assert "contact_pressure" in offered(touched, {"organ": seen(touched.meshes["organ"])})
    assert MoveObstacle in TOOLS and MoveObstacle.offered(touched)


def test_the_tool_leads_the_probe_into_the_organ():
    """Displacement and turn of the gizmo are those of the probe, about its middle."""
    simulation = probed()
    tool = MoveObstacle([simulation])
    (gizmo,) = tool.gizmos([simulation])
    assert gizmo.place == pytest.approx(MIDDLE) and gizmo.wxyz == pytest.approx([1, 0, 0, 0])
    assert tool.say([simulation]) == ""
    half = math.radians(5.0)
    turned = np.array([math.cos(half), math.sin(half), 0.0, 0.0])
    tool.turn([simulation], Gizmo("probe", 0, MIDDLE - 0.03 * UP, turned))
    drawn = layers(simulation)["obstacles"].begin(simulation)
    (before,) = drawn()
    for _ in range(20):
        simulation.step()
    (now,) = tool.gizmos([simulation])
    assert now.place == pytest.approx(MIDDLE - 0.03 * UP, abs=1e-12)
    assert now.wxyz == pytest.approx(turned, abs=1e-9)
    force = simulation.force_on("probe").force
    assert force[2] > 0.1
    assert re.fullmatch(r"probe [\d.]+ N", tool.say([simulation]))
    (after,) = drawn()
    low = TIP[2] - 0.03 + 0.02 * (1.0 - math.cos(2.0 * half))
    assert after.surface[:, :, 2].min() == pytest.approx(low, abs=1e-4)
    # Of the ball, 1 cm, polygons leave 1 cm (1 - cos(7.5 deg)) at most.
    assert before.surface[:, :, 2].min() == pytest.approx(TIP[2], abs=1e-12)
    assert drawn()[0] is after  # what stands still is the same marks again
    (arrows,) = layers(simulation)["contacts"].begin(simulation)()
    found = simulation.contacts()
    pressing = np.linalg.norm(found.forces, axis=1) > 0
    assert len(arrows.arrows) == np.count_nonzero(pressing) > 0
    assert (arrows.arrows[:, 1, 2] < arrows.arrows[:, 0, 2]).all()  # down, onto the organ
    of_body = seen(simulation.meshes["organ"])
    values = FIELDS["contact_pressure"].values(simulation, "organ", of_body)
    under = np.linalg.norm(simulation.meshes["organ"].points[of_body.nodes] - TIP, axis=1) < 0.05
    assert values[under].max() > 10.0 and not values[~under].any()


def test_after_a_reset_the_layer_draws_the_obstacle_where_it_began():
    simulation = probed()
    drawn = layers(simulation)["obstacles"].begin(simulation)
    simulation.obstacle("probe").move((0, 0, 0.02))
    simulation.step()
    assert drawn()[0].surface[:, :, 2].min() == pytest.approx(TIP[2] + 0.02)
    simulation.reset()
    assert drawn()[0].surface[:, :, 2].min() == pytest.approx(TIP[2])


@pytest.mark.parametrize("angle", [0.0, 1e-9, 0.3, 2.0, math.pi - 1e-9, math.pi])
def test_quaternions_are_those_of_the_rotation(angle):
    """Rodrigues' formula gives the matrix; axes in many directions."""
    for axis in np.random.default_rng(3).normal(size=(20, 3)):
        axis = axis / np.linalg.norm(axis)
        cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
        turn = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
        found = quaternion(turn)
        expected = np.array([math.cos(angle / 2), *(math.sin(angle / 2) * axis)])
        assert min(np.abs(found - expected).max(), np.abs(found + expected).max()) < 1e-12


def grey(pixels):
    """How many pixels are grey, neither white nor black: obstacles, and borders of edges."""
    spread = np.ptp(pixels, axis=2)
    return int(((spread < 0.09) & (pixels.mean(axis=2) > 0.3) & (pixels.mean(axis=2) < 0.9)).sum())


def bared(page):
    """The page without the notice that there is no graphics card."""
    page.add_style_tag(content=".mantine-Notifications-root { display: none }")
    return page


def test_a_probe_is_pushed_into_the_organ_by_hand(surroundings, views, pages):
    view = views(probed())
    page = bared(pages(view.url))
    choose(page, "tool", "move obstacle")
    assert grey(settled(page)) > 3000
    arm = 0.18 * view._session.stage.size / view._session.stage.factor
    (start,) = on_screen(page, view, [MIDDLE + 0.6 * arm * UP])
    page.mouse.move(*start)
    page.wait_for_timeout(500)
    page.mouse.down()
    for step in range(1, 15):
        page.mouse.move(start[0], start[1] + 5 * step)
        page.wait_for_timeout(50)
    until(page, lambda: of(view, lambda sims: sims[0].force_on("probe").force[2]) > 0.05)
    page.get_by_text(re.compile(r"^probe [\d.]+ m?N$")).wait_for(timeout=WAIT)
    page.wait_for_timeout(1000)
    page.mouse.up()

    def felt(sims):
        place = sims[0].obstacle("probe").place_of(MIDDLE) - MIDDLE
        return place, sims[0].displacements("organ")[:, 2].min(), sims[0].crossings()

    place, lowest, crossed = of(view, felt)
    assert place[2] < -0.02 and np.abs(place[:2]).max() < 1e-6  # along the arrow alone
    assert lowest < -1e-3 and crossed == [] and view.message == ""
    choose(page, "colour", "contact pressure")
    page.get_by_text(re.compile(r"contact pressure \[k?Pa\]")).wait_for(timeout=WAIT)
    view.pause()
    pixels = settled(page)
    assert ((pixels[:, :, 2] - pixels[:, :, 1]) > 0.08).sum() > 800  # no pressure nearly everywhere


def test_without_contact_nothing_offers_obstacles(views, pages):
    view = views(probed(contacts=[]), playing=False)
    page = bared(pages(view.url))
    assert grey(settled(page)) < 1500
    page.get_by_role("combobox", name="tool").click()
    assert page.get_by_role("option", name="move obstacle").count() == 0
    assert page.get_by_role("option", name="drag").count() == 1
    assert page.get_by_text("contacts", exact=True).count() == 0


def test_the_picture_of_a_page_has_the_obstacle_only_where_its_layer_is_on(
    surroundings, views, pages
):
    page = bared(pages(views(probed(), playing=False).url))
    assert grey(settled(page)) > 3000
    page.get_by_role("checkbox", name="obstacles").click(force=True)
    until(page, lambda: grey(picture(page)) < 1500)
