"""Draws docs/pictures/trocar-view.png: a hand palpates an organ through a trocar, on the page.

The scene is that of examples/palpate.py; its hand gives the tool over to the browser, whose gizmo
stands at the tip. python docs/make_trocar_view.py [FILE]; needs tissu[test] and chromium.
"""

from __future__ import annotations

import runpy
import shutil
import sys
from pathlib import Path

from make_view import SOFTWARE
from playwright.sync_api import sync_playwright

import tissu as ts

ROOT = Path(__file__).resolve().parent
SIZE = {"width": 1150, "height": 1080}
DEEP = 1.15
"""s at which the hand has been deep for a while."""
SIDE, LATER = 0.12, 0.4
"""rad to which the browser leads the roll, and s in which it does."""

WITHOUT_TIMES = """for (const table of document.querySelectorAll('table'))
  if (table.innerText.includes('a step [ms]')) table.remove()"""
"""What a step takes here says nothing to the reader."""


def main(path: Path) -> None:
    """Opens the page, lets the hand go in, takes it over, and takes the picture."""
    scene = runpy.run_path(str(ROOT.parent / "examples" / "palpate.py"))["scene"]()
    simulation = scene.compile()
    with ts.view(simulation, browser=False, playing=False) as view, sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=shutil.which("chromium"), args=SOFTWARE)
        page = browser.new_page(viewport=SIZE)
        page.goto(view.url)
        page.get_by_text("Trocar right", exact=True).wait_for()
        # Without the notice about a missing graphics card.
        page.add_style_tag(content=".mantine-Notifications-root { display: none }")
        step(view, DEEP)
        page.get_by_role("combobox", name="hand").click()
        page.get_by_role("option", name="of the browser").click()
        page.wait_for_timeout(1000)
        view.ask(lambda _: view._session.trocars.each[0].want(1, SIDE)).result()
        step(view, DEEP + LATER)
        page.wait_for_timeout(5000)
        page.evaluate(WITHOUT_TIMES)
        page.screenshot(path=path)
        browser.close()
    print(f"written: {path}")


def step(view: ts.View, until: float) -> None:
    """Step to a time [s]."""
    while view.ask(lambda simulations: simulations[0].time).result() < until - 1e-9:
        view.step()


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "pictures" / "trocar-view.png")
