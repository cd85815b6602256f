"""What the live view costs and how fast it answers: `python bench/view.py [--out PAGE]`.

On plates of hexahedra with so many triangles on their surface:

- frames a second that reach a page (a process that reads everything and draws nothing, and the
  machine's own chromium, which draws on the processor if the machine has no graphics card);
- steps a second as fast as they go, alone and with such a reader: the cost of viewing;
- the time from a move of the mouse in chromium to the force on the body;
- memory of the process before and after so many frames were sent to the reader.

Run it on a machine that does nothing else.
"""

from __future__ import annotations

import argparse
import asyncio
import shutil
import statistics
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

import tissu as ts
from tissu.cli.info import machine_line
from tissu.live_view import View

PAGE = Path(__file__).resolve().parent.parent / "docs" / "measured" / "live-view.md"
BEGIN, END = "<!-- bench/view.py -->\n", "<!-- end of bench/view.py -->\n"
SIDES = {10_000: 49, 100_000: 157}
"""Triangles of the surface -> hexahedra along the two long sides of a plate, 4 s^2 + 8 s."""
SOLVER = ts.ConjugateGradient(iterations=10, tolerance=1e-12)
"""Steps of equal length, which is what is compared; they are not solved to the end."""
SOFTWARE = [
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--no-sandbox",
]
SETTLING = 6.0
"""Seconds after which a page has all of the scene: opening it is not part of the cost."""
COUNT_DRAWN = """
window.drawn = 0; let changed = false;
const send = WebGL2RenderingContext.prototype.bufferSubData;
WebGL2RenderingContext.prototype.bufferSubData = function (...given) {
  changed = true; return send.apply(this, given);
};
const every = () => {
  if (changed) { window.drawn += 1; changed = false; }
  requestAnimationFrame(every);
};
requestAnimationFrame(every);
"""


def plate(side: int, **fields: Any) -> ts.Simulation:
    """A plate of `side` x `side` hexahedra, held at one edge."""
    mesh = ts.BarMesh(size=(0.2, 0.2, 0.2 / side), cells=(side, side, 1), cell="hexahedron")
    law = ts.StVK(young="200 kPa", poisson=0.3)
    return ts.Scene(
        name="plate",
        bodies={"plate": ts.Body(mesh=mesh, law=law, density=1000)},
        fixed=[ts.Fixed("plate", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        gravity=(0, 0, -0.1),
        step=ts.ImplicitEuler("10 ms", solver=SOLVER),
        grabbing=True,
        **fields,
    ).compile()


async def look(url: str, said: Any) -> None:
    """Open the page's websocket and read until it is closed; says each second how much came."""
    import msgspec.msgpack
    import viser
    import websockets
    from viser._messages import ViewerCameraMessage
    from websockets.typing import Subprotocol

    axis = (0.0, 0.0, 1.0)
    eye = ViewerCameraMessage((1.0, 0.0, 0.0, 0.0), axis, 1.0, 0.1, 9.0, 400, 600, axis, axis)
    protocol = Subprotocol(f"viser-v{viser.__version__}")
    async with websockets.connect(
        url.replace("http", "ws"), subprotocols=[protocol], max_size=None, compression=None
    ) as way:
        await way.send(msgspec.msgpack.encode(eye.as_serializable_dict([])))
        async for data in way:
            said(len(data))


def main_of_reader(url: str) -> None:
    """The reader's process."""
    try:
        asyncio.run(look(url, lambda _: None))
    except Exception:  # the view was closed
        return


@contextmanager
def reader(view: View) -> Iterator[None]:
    """A reader beside the view."""
    words = [sys.executable, __file__, "--look", view.url]
    with subprocess.Popen(words) as process:
        while view.pages == 0:
            time.sleep(0.05)
        try:
            yield
        finally:
            process.kill()


def steps_a_second(view: View, seconds: float) -> float:
    """Of the first simulation, over some wall time."""

    def count(simulations: list[ts.Simulation]) -> int:
        return simulations[0].profile().steps

    before, begin = view.ask(count).result(), time.monotonic()
    time.sleep(seconds)
    after, end = view.ask(count).result(), time.monotonic()
    return (after - before) / (end - begin)


def cost(side: int, seconds: float, rounds: int) -> tuple[float, float, float]:
    """Steps a second alone and watched (medians of rounds in turn), frames a second sent."""
    alone, watched, frames = [], [], []
    for _ in range(rounds):
        with ts.view(plate(side), browser=False, speed=float("inf")) as view:
            time.sleep(1.0)
            alone.append(steps_a_second(view, seconds))
            with reader(view):
                time.sleep(SETTLING)
                before, begin = view.frames_sent, time.monotonic()
                watched.append(steps_a_second(view, seconds))
                frames.append((view.frames_sent - before) / (time.monotonic() - begin))
    return statistics.median(alone), statistics.median(watched), statistics.median(frames)


@contextmanager
def chromium(view: View) -> Iterator[Any]:
    """A page of the view in the machine's chromium."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=shutil.which("chromium"), args=SOFTWARE)
        page = browser.new_page(viewport={"width": 800, "height": 500})
        page.set_default_timeout(120_000)
        page.add_init_script(COUNT_DRAWN)
        page.goto(view.url)
        page.get_by_text("real time").first.wait_for()
        page.wait_for_timeout(3000)
        yield page
        browser.close()


def drawn(side: int, seconds: float) -> float:
    """Frames with new positions that chromium draws in a second, at life's speed."""
    with ts.view(plate(side), browser=False) as view, chromium(view) as page:
        before, begin = page.evaluate("window.drawn"), time.monotonic()
        page.wait_for_timeout(1000 * seconds)
        return float((page.evaluate("window.drawn") - before) / (time.monotonic() - begin))


def latency(side: int, moves: int) -> list[float]:
    """From each move of the mouse to the changed force on the body [ms]."""
    found: list[float] = []
    with ts.view(plate(side), browser=False) as view, chromium(view) as page:
        changed, target = threading.Event(), [np.zeros(3)]

        def watch(simulations: list[ts.Simulation]) -> None:
            simulation = simulations[0]

            def look(_: ts.StepReport) -> None:
                grabs = simulation.grabs
                if grabs and not np.array_equal(grabs[0].target, target[0]):
                    target[0] = grabs[0].target
                    changed.set()

            simulation.on_step(look)

        view.ask(watch).result()
        page.mouse.move(280, 250)
        page.mouse.down()
        page.mouse.move(300, 250)
        if not changed.wait(10.0):
            raise RuntimeError("the mouse met nothing; look at the page")
        for number in range(moves):
            page.wait_for_timeout(200)
            changed.clear()
            begin = time.monotonic()
            page.mouse.move(300, 250 - 3 * (1 + number % 2))
            if changed.wait(10.0):
                found.append(1e3 * (time.monotonic() - begin))
        page.mouse.up()
    return found


def resident() -> float:
    """Memory of this process [MB]."""
    text = Path("/proc/self/status").read_text(encoding="utf-8")
    return float(text.split("VmRSS:")[1].split()[0]) / 1e3


def memory(frames: int) -> tuple[float, float]:
    """Memory [MB] after a tenth of so many frames of a small plate, and after all of them."""
    with ts.view(plate(10), browser=False, playing=False) as view, reader(view):
        frame = view.ask(lambda _: view._taker.take(view._runner)).result()
        rest = {key: body.positions.copy() for key, body in frame.bodies.items()}
        early = 0.0
        for number in range(frames):
            for key, body in frame.bodies.items():
                body.positions[:] = rest[key] * (1.0 + 1e-3 * (number % 7))
            view._page.show(frame)
            if number == frames // 10:
                early = resident()
        return early, resident()


def rows(given: argparse.Namespace) -> Iterator[str]:
    """The lines of the table."""
    yield f"Printed by `python bench/view.py`; {machine_line()}\n\n"
    yield "| triangles of the surface | frames a second, sent | drawn by software | steps a second "
    yield "alone | watched | cost of viewing |\n|---:|---:|---:|---:|---:|---:|\n"
    for triangles, side in SIDES.items():
        alone, watched, sent = cost(side, given.seconds, given.rounds)
        shown = drawn(side, given.seconds)
        yield (
            f"| {triangles:,} | {sent:.1f} | {shown:.1f} | {alone:.2f} | {watched:.2f} | "
            f"{100 * (1 - watched / alone):.1f} % |\n"
        )
    waits = latency(SIDES[10_000], given.moves)
    yield (
        f"\nFrom a move of the mouse to the force on the body: p50 {np.median(waits):.0f} ms, "
        f"p95 {np.percentile(waits, 95):.0f} ms of {len(waits)} moves (the browser sends 20 a "
        "second, and the force acts from the next step of 10 ms on).\n"
    )
    early, late = memory(given.frames)
    yield (
        f"\nMemory of the process after {given.frames // 10:,} frames: {early:.0f} MB; after "
        f"{given.frames:,}: {late:.0f} MB.\n"
    )


def main() -> None:
    """Print the table, and write it into the page where that is asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--look", help=argparse.SUPPRESS)
    parser.add_argument("--out", type=Path, help="a page with the two marks between which it goes")
    parser.add_argument("--seconds", type=float, default=5.0, help="of each measurement")
    parser.add_argument("--rounds", type=int, default=5, help="alone and watched, in turn")
    parser.add_argument("--moves", type=int, default=40, help="of the mouse")
    parser.add_argument("--frames", type=int, default=100_000, help="sent for the memory")
    given = parser.parse_args()
    if given.look:
        main_of_reader(given.look)
        return
    text = ""
    for line in rows(given):
        print(line, end="", flush=True)
        text += line
    if given.out is not None:
        page = given.out.read_text(encoding="utf-8")
        head, rest = page.split(BEGIN, 1)
        given.out.write_text(
            head + BEGIN + "\n" + text + "\n" + END + rest.split(END, 1)[1], encoding="utf-8"
        )


if __name__ == "__main__":
    main()
