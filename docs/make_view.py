"""Draws docs/pictures/view.png: the page of the live view, in chromium, while the organ is pulled.

python docs/make_view.py [FILE]; needs tissu[test] and chromium.
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

from playwright.sync_api import sync_playwright

import tissu as ts

ROOT = Path(__file__).resolve().parent
SIZE = {"width": 1100, "height": 700}
SOFTWARE = [
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--no-sandbox",
]


def main(path: Path) -> None:
    """Opens the page, pulls, and takes the picture."""
    scene = ts.Scene.from_yaml(ROOT.parent / "examples" / "organ.yaml")
    with ts.view(scene.compile(), browser=False) as view, sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=shutil.which("chromium"), args=SOFTWARE)
        page = browser.new_page(viewport=SIZE)
        page.goto(view.url)
        page.get_by_role("combobox", name="colour").click()
        page.get_by_role("option", name="von Mises stress").click()
        page.wait_for_timeout(4000)
        # Without the notice about a missing graphics card.
        page.add_style_tag(content=".mantine-Notifications-root { display: none }")
        page.mouse.move(520, 350)
        page.mouse.down()
        for step in range(1, 16):
            page.mouse.move(520 + 7 * step, 350 + 3 * step)
            page.wait_for_timeout(50)
        page.wait_for_timeout(3000)
        page.screenshot(path=path)
        browser.close()
    print(f"written: {path}")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "pictures" / "view.png")
