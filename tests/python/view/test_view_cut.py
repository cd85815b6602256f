"""Cutting on the page: the tool, what is seen of the cut, and the cut in a real browser."""

import numpy as np
import pytest
from test_view_browser import choose, middle_of, of, organ, settled, until

import tissu as ts
from tissu.live_view.pointer import Pointer
from tissu.live_view.surface import seen_of
from tissu.live_view.tools.cut import Cut

EYE = (0.1, -1.0, 0.04)


def at(x, z, *, lane=0):
    """The pointer before the middle of the bar, which it looks at along y."""
    there = np.array([x, 0.0, z])
    return Pointer(lane, "organ", 1, np.array(EYE), there, there)


def drawn(simulations, places):
    tool = Cut(simulations)
    tool.press(simulations, at(*places[0]))
    for place in places[1:]:
        tool.move(simulations, at(*place))
    assert len(tool.draw(simulations)[0][0].lines) == len(places) - 1
    tool.release(simulations, at(*places[-1]))
    return tool


def test_a_line_over_the_body_cuts_it_in_two_in_every_simulation():
    simulations = [organ(editing=True, gravity=None), organ(editing=True, gravity=None)]
    tool = drawn(simulations, [(0.09, 0.12), (0.1, 0.04), (0.11, -0.04)])
    for simulation in simulations:
        small, large = sorted(piece.volume for piece in simulation.pieces("organ"))
        assert small + large == pytest.approx(0.2 * 0.08 * 0.08, rel=1e-12)
        assert small > 0.4 * large
    assert "2 pieces" in tool.say(simulations)


def test_a_depth_leaves_the_body_whole():
    simulations = [organ(editing=True, gravity=None)]
    tool = Cut(simulations)
    tool.numbers[0].value = 30.0  # mm
    for place, act in zip(((0.1, 0.12), (0.1, -0.04)), (tool.press, tool.move), strict=True):
        act(simulations, at(*place))
    tool.release(simulations, at(0.1, -0.04))
    surface = simulations[0].surface("organ")
    assert len(simulations[0].pieces("organ")) == 1
    lips = surface.points[np.unique(surface.triangles[surface.cut])]
    assert 0.0 <= lips[:, 1].max() <= 0.03 + 1e-9


def test_what_is_seen_is_the_material_with_its_edges():
    simulation = organ(editing=True, gravity=None)
    before = seen_of(simulation, "organ")
    assert before.cut is None
    simulation.cut("organ", ts.Plane((0.107, 0, 0), (1, 0, 0)))
    seen, surface = seen_of(simulation, "organ"), simulation.surface("organ")
    assert seen_of(simulation, "organ") is seen
    np.testing.assert_allclose(seen.at(simulation.positions["organ"]), surface.points, atol=0)
    np.testing.assert_array_equal(seen.triangles, surface.triangles)
    assert seen.cut.sum() > 0
    at_cut = surface.points[np.unique(seen.triangles[seen.cut])]
    np.testing.assert_allclose(at_cut[:, 0], 0.107, rtol=0, atol=1e-12)
    simulation.cut("organ", ts.Plane((0.051, 0, 0), (1, 0, 0)))
    assert seen_of(simulation, "organ") is not seen


def test_an_organ_is_cut_under_the_mouse(views, pages):
    view = views(organ(editing=True), playing=False)
    page = pages(view.url)
    choose(page, "tool", "cut")
    column, row = middle_of(settled(page))
    page.get_by_label("beyond both ends of the line").fill("200")
    page.keyboard.press("Enter")
    page.mouse.move(column, row - 20)
    page.mouse.down()
    for step in range(1, 21):
        page.mouse.move(column, row - 20 + 2 * step)
        page.wait_for_timeout(20)
    page.mouse.up()
    until(page, lambda: of(view, lambda sims: sims[0].is_cut("organ")))
    assert len(of(view, lambda sims: sims[0].pieces("organ"))) == 2
    assert view.message == ""
    page.get_by_role("button", name="Play").click()
    until(page, lambda: of(view, lambda sims: sims[0].time) > 0.3)
    low = of(view, lambda sims: sims[0].positions["organ"][:, 2].min())
    assert low < -0.2  # the piece falls
