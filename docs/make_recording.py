"""Records docs/recordings/pull.html: a page of the live view that plays without a server.

The organ is pulled at its tip and let go, as in docs/make_pull.py, with its displacement by colour.
Each frame stands for its simulated time, however long the machine took. Its picture is
docs/pictures/recording.png, as chromium shows it while the organ is held.

python docs/make_recording.py; needs tissu[test] and chromium.
"""

from __future__ import annotations

import shutil
import time
from dataclasses import replace
from pathlib import Path

from make_pull import HOLD, PULL, SETTLE, SWING, WAY, pulled
from make_view import SIZE, SOFTWARE
from playwright.sync_api import sync_playwright

import tissu as ts
from tissu.files import whole_file
from tissu.live_view.frame import Frame

ROOT = Path(__file__).resolve().parent
EVERY = 8  # steps of 10 ms from one frame to the next
PAUSE = 0.02  # [s]: colours follow every picture where the machine has time to spare


def record(path: Path) -> None:
    """Runs it, keeps what is sent to the page, and writes the file."""
    scene = ts.Scene.from_yaml(ROOT.parent / "examples" / "organ.yaml").replace(grabbing=True)
    simulation = scene.compile()
    with ts.view(simulation, browser=False, playing=False) as view:
        for _ in simulation.run(SETTLE):
            pass
        view._taker.wanted = replace(view._taker.wanted, field="displacement")
        place = simulation.positions["organ"]
        tip = place[place[:, 0].argmax()].copy()
        grab = simulation.drag("organ", tip, stiffness="120 N/m")
        kept, begin = None, simulation.time
        for number in range(round((PULL + HOLD + SWING) / simulation.dt)):
            now = simulation.time - begin
            if now > PULL + HOLD:
                grab.release()
            else:
                grab.target = tip + pulled(now) * WAY
            simulation.step()
            if number % EVERY:
                continue
            time.sleep(PAUSE)
            frame: Frame = view.ask(lambda _: view._taker.take(view._runner)).result()
            view._page.show(frame)
            if kept is None:
                kept = view._page.server.get_scene_serializer()
            kept.insert_sleep(EVERY * simulation.dt)
        assert kept is not None  # the first step is kept
        text = kept.as_html()
    with whole_file(path) as partial:
        partial.write_text(text, encoding="utf-8")
    print(f"written: {path}, {path.stat().st_size / 1e6:.2f} MB")


def picture(recording: Path, path: Path) -> None:
    """Plays a recording, stops it while the organ is held, and takes the picture."""
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=shutil.which("chromium"), args=SOFTWARE)
        page = browser.new_context(viewport=SIZE, offline=True).new_page()
        page.goto(recording.as_uri())
        page.wait_for_timeout(5000)
        # Without the notice about a missing graphics card.
        page.add_style_tag(content=".mantine-Notifications-root { display: none }")
        shown = page.locator("input[type=text], input:not([type])").first
        while not PULL + 0.2 < float(shown.input_value()) < PULL + HOLD - 0.05:
            page.wait_for_timeout(20)
        page.keyboard.press("Space")
        page.wait_for_timeout(3000)
        page.screenshot(path=path)
        browser.close()
    print(f"written: {path}")


if __name__ == "__main__":
    record(ROOT / "recordings" / "pull.html")
    picture(ROOT / "recordings" / "pull.html", ROOT / "pictures" / "recording.png")
