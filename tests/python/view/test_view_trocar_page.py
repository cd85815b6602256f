"""The trocar on a page in a real browser: seen, held by mouse and gamepad, cured, recorded."""

import re

import numpy as np
import pytest
from test_view_browser import WAIT, choose, of, on_screen, picture, settled, until
from test_view_contact import bared
from trocar_scenes import PORT, tissue

GREEN, BLUE, STEEL = (40, 150, 80), (20, 110, 200), (196, 202, 208)


def coloured(pixels, colour, within=0.1):
    """How many pixels have about a colour, up to their brightness."""
    wanted = np.array(colour) / np.linalg.norm(colour)
    size = np.linalg.norm(pixels, axis=2)
    apart = np.linalg.norm(pixels / np.maximum(size, 1e-9)[..., None] - wanted, axis=2)
    return int(((apart < within) & (size > 0.3)).sum())


def arrow(pixels):
    """How many pixels are redder than any tissue: those of the force."""
    return int((pixels[:, :, 0] - pixels[:, :, 1] > 0.4).sum())


def now(view):
    """The trocar as the page is given it."""
    return of(view, lambda _: view._session.trocars.frames()[0])


def at_time(page, view, time):
    """Play until a time, and pause."""
    view.play()
    until(page, lambda: of(view, lambda sims: sims[0].time) >= time)
    view.pause()


def test_the_page_shows_the_trocar_its_force_and_its_faults(surroundings, views, pages):
    view = views(tissue().compile(), playing=False, speed=0.5)
    page = bared(pages(view.url))
    (pivot,) = on_screen(page, view, [PORT]).round().astype(int)
    at_time(page, view, 0.05)
    page.get_by_text("free, probe", exact=True).wait_for(timeout=WAIT)
    free = settled(page)
    assert arrow(free) == 0
    around = free[pivot[1] - 25 : pivot[1] + 25, pivot[0] - 25 : pivot[0] + 25]
    assert coloured(around, GREEN) > 20  # the ring of the port
    at_time(page, view, 0.5)
    page.get_by_text("contact, probe", exact=True).wait_for(timeout=WAIT)
    touching = settled(page)
    assert arrow(touching) > 10  # of a force of about 1 N
    around = touching[pivot[1] - 25 : pivot[1] + 25, pivot[0] - 25 : pivot[0] + 25]
    assert coloured(around, BLUE) > 20 > coloured(around, GREEN)
    assert page.locator(".u-over").first.is_visible()  # the curve

    of(view, lambda _: view._session.trocars.each[0].held.device.unplug())
    page.get_by_role("button", name="Step").click()
    page.get_by_text(re.compile("no sample five times .* then press 'Switch on again'")).wait_for()
    cure = page.get_by_role("button", name="Switch on again")
    cure.click()
    page.get_by_role("button", name="Play").click()
    until(page, lambda: now(view).state in ("free", "contact"))
    page.get_by_role("button", name="Pause").click()
    until(page, lambda: page.get_by_text(re.compile("gave no sample")).count() == 0)
    assert cure.count() == 0
    page.get_by_role("button", name="Undo").click()
    until(page, lambda: of(view, lambda sims: sims[0].time) < 0.45)
    choose(page, "tool in it", "none")
    page.get_by_role("button", name="Play").click()
    page.get_by_text("empty, no tool").wait_for(timeout=WAIT)
    page.get_by_role("button", name="Reset").click()
    until(page, lambda: now(view).state in ("free", "contact") and now(view).tool == "probe")
    until(page, lambda: page.get_by_role("combobox", name="tool in it").input_value() == "probe")
    assert view.message == ""


def test_the_hand_is_the_mouse_the_keyboard_or_a_gamepad(views, pages):
    view = views(tissue().compile())
    page = bared(pages(view.url))
    page.evaluate("window.pads = []; navigator.getGamepads = () => window.pads")
    until(page, lambda: of(view, lambda sims: sims[0].time) > 0.1)
    choose(page, "hand", "of the browser")
    until(page, lambda: now(view).hand == "browser")
    until(
        page, lambda: page.get_by_role("combobox", name="tool").first.input_value() == "hold trocar"
    )
    began = now(view).joints

    # The gizmo at the tip: its arrow along the port's axis points down.
    settled(page)
    stage = view._session.stage
    arm = 0.18 * stage.size / stage.factor
    tip = np.array(PORT) - np.array([0, 0, now(view).wanted[3]])
    start, end = on_screen(page, view, [tip - [0, 0, 0.6 * arm], tip - [0, 0, 0.6 * arm + 0.015]])
    page.mouse.move(*start)
    page.wait_for_timeout(500)
    page.mouse.down()
    for step in range(1, 11):
        page.mouse.move(*(start + (end - start) * step / 10))
        page.wait_for_timeout(30)
    until(page, lambda: now(view).wanted[3] > began[3] + 0.01)
    page.mouse.up()
    wanted = now(view).wanted
    assert wanted[3] - began[3] == pytest.approx(0.015, abs=0.006)  # as far as the mouse went
    np.testing.assert_allclose(wanted[:2], began[:2], atol=2e-3)
    until(page, lambda: now(view).fast > 0.1)

    # A slider by the keyboard: out of the tissue.
    depth = page.locator("[aria-valuemax='300']").first
    depth.focus()
    page.keyboard.press("Home")
    until(page, lambda: now(view).wanted[3] == pytest.approx(0.02))
    until(page, lambda: now(view).fast == 0.0)

    # The right stick forwards, and nothing more when the gamepad is gone.
    page.evaluate("window.pads = [{connected: true, axes: [0, 0, 0, -1]}]")
    until(page, lambda: now(view).wanted[3] > 0.035)
    page.evaluate("window.pads = []")
    page.wait_for_timeout(500)
    there = now(view).wanted
    assert there[3] > 0.035 and np.abs(there[:2]).max() < 0.01
    page.wait_for_timeout(300)
    assert np.array_equal(now(view).wanted, there) and view.message == ""


def test_a_page_that_looks_on_does_not_lead(views, pages):
    view = views(tissue().compile(), playing=False, hand="browser")
    first, second = pages(view.url), pages(view.url)
    before = now(view).wanted
    second.locator("[aria-valuemax='300']").first.focus()
    second.keyboard.press("End")
    second.evaluate("navigator.getGamepads = () => [{connected: true, axes: [1, 1, 1, 1]}]")
    field = second.locator("input[value^='gamepad 1: 1.00']")
    field.wait_for(timeout=WAIT)  # it was read there
    view.step()
    assert np.array_equal(now(view).wanted, before) and view.message == ""
    assert first.locator("[aria-valuemax='300']").count() == 1


def test_a_recording_shows_the_trocar_without_a_server(views, visits, tmp_path):
    file = tmp_path / "palpated.html"
    view = views(tissue().compile(), record=file)
    while of(view, lambda sims: sims[0].time) < 0.5:
        view.wait(0.05)
    view.close()
    alone = visits(offline=True)
    alone.goto(file.as_uri())
    until(alone, lambda: arrow(picture(alone)) > 10)  # when it touches
    assert coloured(picture(alone), STEEL, 0.06) > 100
