"""The page in a real browser: what is seen there, and what a mouse does to the simulation."""

import io
import re

import matplotlib.image
import numpy as np
import pytest

import tissu as ts
from tissu.live_view.cameras import FOV, first_place

WAIT = 120_000  # ms; a busy machine draws slowly


def organ(*, young="6 kPa", **changes):
    """A block of 20 cm that hangs on its left side, in the middle of the page."""
    mesh = ts.BarMesh(size=(0.2, 0.08, 0.08), cells=(10, 4, 4), cell="tetra")
    body = ts.Body(
        mesh=mesh,
        law=ts.StVK(young=young, poisson=0.4),
        density=1000,
        viscosity=ts.Rayleigh(mass=2, stiffness=0.01),
    )
    fields = {
        "bodies": {"organ": body},
        "fixed": [ts.Fixed("organ", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        "gravity": (0, 0, -9.81),
        "step": ts.ImplicitEuler("10 ms"),
        **changes,
    }
    return ts.Scene(name="organ", **fields).compile()


def picture(page):
    """The left part of the page (h, w, 3), in which the scene is, 0 to 1."""
    shot = page.screenshot(clip={"x": 0, "y": 0, "width": 440, "height": 500})
    return matplotlib.image.imread(io.BytesIO(shot))[:, :, :3]


def clay(pixels):
    """Which pixels are of the organ's own colour, in light or shade."""
    red, green, blue = pixels.transpose(2, 0, 1)
    return (red - blue > 0.1) & (red - green > 0.06)


def settled(page):
    """Wait until two pictures are the same, and give it."""
    before = picture(page)
    for _ in range(60):
        page.wait_for_timeout(250)
        now = picture(page)
        if np.abs(now - before).max() < 0.02:
            return now
        before = now
    raise AssertionError("the page never stood still")


def middle_of(pixels):
    """Column and row of the middle of what is clay."""
    rows, columns = np.nonzero(clay(pixels))
    assert len(rows) > 1500, f"{len(rows)} pixels of the organ"
    return float(columns.mean()), float(rows.mean())


def choose(page, box, option):
    page.get_by_role("combobox", name=box).click()
    page.get_by_role("option", name=option, exact=True).click()


def of(view, look):
    return view.ask(look).result(60)


def until(page, condition):
    for _ in range(1200):
        if condition():
            return
        page.wait_for_timeout(100)
    raise AssertionError("it never happened")


def test_the_page_shows_the_organ_and_it_moves(surroundings, views, pages):
    view = views(organ(), playing=False)
    page = pages(view.url)
    at_rest = settled(page)
    middle_of(at_rest)
    page.get_by_role("button", name="Play").click()
    until(page, lambda: of(view, lambda sims: sims[0].time) > 0.6)
    page.get_by_role("button", name="Pause").click()
    fallen = settled(page)
    assert middle_of(fallen)[1] > middle_of(at_rest)[1] + 3  # pixels further down
    assert (clay(fallen) != clay(at_rest)).sum() > 800
    page.get_by_text(re.compile(r"t = \d+\.\d+ s, paused")).wait_for(timeout=WAIT)


def test_step_and_reset(views, pages):
    view = views(organ(), playing=False)
    page = pages(view.url)
    for _ in range(3):
        page.get_by_role("button", name="Step").click()
    until(page, lambda: of(view, lambda sims: sims[0].time) == pytest.approx(0.03))
    page.get_by_role("button", name="Reset").click()
    until(page, lambda: of(view, lambda sims: sims[0].time) == 0.0)
    page.get_by_text("t = 0.000 s, paused").wait_for(timeout=WAIT)


def test_a_mouse_drags_the_nodes_under_it_and_the_force_is_shown(views, pages):
    view = views(organ(gravity=None))
    page = pages(view.url)
    column, row = middle_of(settled(page))
    page.mouse.move(column, row)
    page.mouse.down()
    for step in range(1, 11):
        page.mouse.move(column, row - 8 * step)
        page.wait_for_timeout(30)
    until(page, lambda: len(of(view, lambda sims: sims[0].grabs)) == 1)
    page.get_by_text(re.compile(r"^[\d.]+ m?N$")).wait_for(timeout=WAIT)
    page.wait_for_timeout(1000)

    def pulled(sims):
        grab = sims[0].grabs[0]
        rest = sims[0].meshes["organ"].points
        place = grab.point.weights @ rest[grab.point.nodes]
        return place, sims[0].displacements("organ").copy(), grab.point.nodes, grab.force

    place, moved, nodes, force = of(view, pulled)
    assert 0.05 < place[0] < 0.15  # the mouse met the middle, and has gone up
    assert force[2] > 0.0 and moved[nodes, 2].min() > 1e-3
    rise = moved[:, 2]
    assert rise[nodes].max() > 0.7 * rise.max()  # those under the mouse rise most
    page.mouse.up()
    until(page, lambda: of(view, lambda sims: sims[0].grabs) == ())


def test_a_drag_beside_the_organ_turns_the_view_and_pulls_nothing(views, pages):
    view = views(organ(), playing=False)
    page = pages(view.url)
    before = settled(page)
    page.mouse.move(220, 470)
    page.mouse.down()
    for step in range(10):
        page.mouse.move(220 + 10 * step, 470)
    page.mouse.up()
    after = settled(page)
    assert (clay(before) != clay(after)).sum() > 800
    assert of(view, lambda sims: sims[0].grabs) == ()


def test_cells_are_removed_under_the_mouse(surroundings, views, pages):
    view = views(organ(editing=True), playing=False)
    page = pages(view.url)
    choose(page, "tool", "remove cells")
    column, row = middle_of(settled(page))
    count = of(view, lambda sims: sims[0].meshes["organ"].cell_count)
    faces = of(view, lambda sims: len(sims[0].meshes["organ"].surface().triangles))
    page.mouse.click(column, row)
    until(page, lambda: of(view, lambda sims: sims[0].meshes["organ"].cell_count) < count)
    opened = of(view, lambda sims: len(sims[0].meshes["organ"].surface().triangles))
    assert opened > faces  # the walls of the hole
    assert view.message == ""


def on_screen(page, view, places):
    """Column and row of places (n, 3) of the first simulation, seen by the first camera."""
    stage = view._session.stage
    eye, size = first_place(stage), page.locator("canvas").first.bounding_box()
    at = stage.on_page(np.asarray(places), 0) - eye
    towards = stage.centre - eye
    towards = towards / np.linalg.norm(towards)
    right = np.cross(towards, stage.up) / np.linalg.norm(np.cross(towards, stage.up))
    top = np.cross(right, towards)
    scale = 0.5 * size["height"] / np.tan(FOV / 2) / (at @ towards)
    column = size["x"] + 0.5 * size["width"] + scale * (at @ right)
    return np.stack([column, size["y"] + 0.5 * size["height"] - scale * (at @ top)], axis=1)


def test_held_nodes_are_led_by_a_gizmo(views, pages):
    view = views(organ(gravity=None))
    page = pages(view.url)
    # The notice that there is no graphics card stands where the gizmo is.
    page.add_style_tag(content=".mantine-Notifications-root { display: none }")
    choose(page, "tool", "lead")
    settled(page)
    foot = np.array([0.0, 0.04, 0.04])
    arm = 0.18 * view._session.stage.size / view._session.stage.factor
    # On the arrow that points up.
    (start,) = on_screen(page, view, [foot + np.array([0, 0, 0.6 * arm])])
    page.mouse.move(*start)
    page.wait_for_timeout(500)
    page.mouse.down()
    for step in range(1, 11):
        page.mouse.move(start[0], start[1] - 4 * step)
        page.wait_for_timeout(50)

    def led(sims):
        nodes = sims[0].lead("fixed[0]").nodes
        return sims[0].displacements("organ")[nodes]

    until(page, lambda: of(view, led)[:, 2].mean() > 0.01)
    page.wait_for_timeout(2000)
    page.mouse.up()
    page.wait_for_timeout(500)
    moved = of(view, led)
    assert np.abs(moved[:, :2]).max() < 1e-6 and np.ptp(moved[:, 2]) < 1e-9  # up, as one piece
    before, after = on_screen(page, view, [foot, foot + moved.mean(axis=0)])
    assert before[1] - after[1] == pytest.approx(40, abs=12)  # as far as the mouse went


def test_where_editing_is_off_nothing_offers_to_remove(views, pages):
    page = pages(views(organ(), playing=False).url)
    page.get_by_role("combobox", name="tool").click()
    assert page.get_by_role("option", name="remove cells").count() == 0
    assert page.get_by_role("option", name="drag").count() == 1


def test_a_field_is_shown_by_colour_with_its_legend(views, pages):
    view = views(organ())
    page = pages(view.url)
    own = clay(picture(page)).sum()
    choose(page, "colour", "von Mises stress")
    page.get_by_text(re.compile(r"von Mises stress \[k?Pa\]")).wait_for(timeout=WAIT)
    until(page, lambda: clay(picture(page)).sum() < 0.2 * own)
    view.pause()
    pixels = settled(page)
    purple = (pixels[:, :, 2] - pixels[:, :, 1] > 0.08).sum()
    green = (pixels[:, :, 1] - pixels[:, :, 0] > 0.08).sum()
    assert purple > 200 and green > 200  # low and high stress of the bent bar
    choose(page, "colour", "own colours")
    until(page, lambda: clay(picture(page)).sum() > 0.8 * own)


def test_a_parameter_that_is_set_on_the_page_changes_the_answer(views, pages):
    view = views(organ(young="60 kPa"))
    page = pages(view.url)
    page.get_by_text("Parameters", exact=True).click()
    young = page.locator("[aria-valuemax='180000']")  # three times its value
    young.wait_for(timeout=WAIT)
    until(page, lambda: of(view, lambda sims: sims[0].time) > 3.0)
    soft = of(view, lambda sims: sims[0].displacements("organ")[:, 2].min())
    young.focus()
    page.keyboard.press("End")
    until(page, lambda: of(view, lambda sims: sims[0].parameters["bodies.organ.law.young"]) > 1e5)
    later = of(view, lambda sims: sims[0].time) + 3.0
    until(page, lambda: of(view, lambda sims: sims[0].time) > later)
    stiff = of(view, lambda sims: sims[0].displacements("organ")[:, 2].min())
    assert 0.2 * soft > stiff > 0.6 * soft  # both negative: it hangs a third as low, or so


def test_an_error_shows_its_sentence_and_the_last_good_state_stands(views, pages):
    view = views(organ())
    page = pages(view.url)

    def throw(sims):
        sims[0].velocities["organ"][-1] = (1e9, 0, 0)

    view.ask(throw).result(60)
    page.get_by_text(re.compile("The simulation stands at its last good step")).wait_for(
        timeout=WAIT
    )
    page.get_by_text(re.compile("paused")).wait_for(timeout=WAIT)
    middle_of(settled(page))
    page.get_by_role("button", name="Reset").click()
    page.get_by_role("button", name="Play").click()
    until(page, lambda: of(view, lambda sims: sims[0].time) > 0.1)
    assert view.message == ""
    until(page, lambda: page.get_by_text(re.compile("stands at its last good step")).count() == 0)


def test_two_pages_see_and_the_first_touches(views, pages):
    view = views(organ(), playing=False)
    first, second = pages(view.url), pages(view.url)
    assert view.pages == 2
    middle_of(settled(second))
    second.get_by_role("button", name="Step").click()
    second.get_by_text("This page looks on").wait_for(timeout=WAIT)
    assert of(view, lambda sims: sims[0].time) == 0.0
    first.get_by_role("button", name="Step").click()
    until(first, lambda: of(view, lambda sims: sims[0].time) > 0.0)
    second.get_by_text("t = 0.010 s, paused").wait_for(timeout=WAIT)
    first.close()
    until(second, lambda: view.pages == 1)
    second.get_by_role("button", name="Step").click()
    until(second, lambda: of(view, lambda sims: sims[0].time) > 0.015)


def test_a_closed_page_stops_nothing(views, pages):
    view = views(organ())
    page = pages(view.url)
    page.close()
    before = of(view, lambda sims: sims[0].time)
    assert of(view, lambda sims: sims[0].step().time) > before
    wake = pages(view.url)
    until(wake, lambda: of(view, lambda sims: sims[0].time) > before + 0.2)


def test_a_page_finds_the_view_again_when_it_restarts(views, pages):
    first = views(organ(), playing=False)
    page = pages(first.url)
    middle_of(settled(page))
    port = int(first.url.split(":")[2].strip("/"))
    first.close()
    second = views(organ(), playing=False, port=port)
    until(page, lambda: second.pages == 1)
    second.step()
    page.get_by_text("t = 0.010 s, paused").wait_for(timeout=WAIT)
    middle_of(settled(page))


def test_two_models_stand_side_by_side(views, pages):
    one = organ()
    body = one.scene.bodies["organ"].replace(model="corotational", law_for_model="nearest")
    view = views(one, beside=one.scene.replace(bodies={"organ": body}).compile())
    page = pages(view.url)
    page.get_by_text(re.compile(r"apart by [\d.]+ mm in the mean")).wait_for(timeout=WAIT)
    until(page, lambda: of(view, lambda sims: sims[0].time) > 1.0)
    view.pause()
    columns = clay(settled(page)).any(axis=0)
    runs = np.flatnonzero(np.diff(columns.astype(int)) == 1)
    assert len(runs) + columns[0] >= 2  # two organs with a gap between them


def test_a_token_lets_a_page_in(views, pages, visits):
    view = views(organ(), playing=False, token="open-sesame")
    page = pages(view.url)
    middle_of(settled(page))
    stranger = visits()
    answer = stranger.goto(view.url.split("?")[0])
    assert answer.status == 403 and "found no token" in stranger.content()


def test_a_recording_plays_without_a_server(views, pages, visits, tmp_path):
    file = tmp_path / "organ.html"
    view = views(organ(), record=file, playing=False)
    page = pages(view.url)
    view.play()
    until(page, lambda: of(view, lambda sims: sims[0].time) > 0.6)
    view.close()
    assert file.stat().st_size > 100_000
    page.close()  # its drawing would go on beside that of the recording
    alone = visits(offline=True)
    alone.goto(file.as_uri())
    until(alone, lambda: clay(picture(alone)).sum() > 1500)
    first = picture(alone)
    until(alone, lambda: (clay(picture(alone)) != clay(first)).sum() > 400)
