"""Draws docs/pictures/pull.webp: the organ is pulled at its tip and let go, in life's time.

python docs/make_pull.py [FILE]
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

import tissu as ts
from tissu.live_view.surface import seen
from tissu.picture.camera import look_at
from tissu.picture.layout import colours
from tissu.picture.surface import render_surface

ROOT = Path(__file__).resolve().parent
SIZE = (640, 400)
RATE = 20  # pictures a second
SETTLE, PULL, HOLD, SWING = 1.0, 0.8, 0.4, 2.0  # [s]
WAY = np.array([0.05, -0.02, 0.06])  # of the pull [m]
HIGHEST = 0.06  # displacement since the pull at the end of the colours [m]


def pulled(time: float) -> float:
    """Share of the way at a time since the pull began: smooth at both ends."""
    share = min(max(time / PULL, 0.0), 1.0)
    return share * share * (3.0 - 2.0 * share)


def moments() -> list[tuple[NDArray[np.float64], NDArray[np.float64] | None]]:
    """Places of the nodes that are seen, and both ends of the pull, at each picture."""
    scene = ts.Scene.from_yaml(ROOT.parent / "examples" / "organ.yaml").replace(grabbing=True)
    simulation = scene.compile()
    nodes = seen(simulation.meshes["organ"]).nodes
    for _ in simulation.run(SETTLE):
        pass
    rest = simulation.positions["organ"]
    tip = rest[rest[:, 0].argmax()].copy()
    grab = simulation.drag("organ", tip, stiffness="120 N/m")
    found, begin, every = [], simulation.time, round(1.0 / RATE / simulation.dt)
    for number, _ in enumerate(simulation.run(PULL + HOLD + SWING)):
        now = simulation.time - begin
        if now > PULL + HOLD:
            grab.release()
        else:
            grab.target = tip + pulled(now) * WAY
        if number % every == 0:
            ends = None if grab.released else np.stack([grab.position, grab.target])
            found.append((simulation.positions["organ"][nodes].copy(), ends))
    return found


def main(path: Path) -> None:
    """Draws every moment, and writes the file."""
    simulation = ts.Scene.from_yaml(ROOT.parent / "examples" / "organ.yaml").compile()
    triangles = seen(simulation.meshes["organ"]).triangles
    found = moments()
    first = found[0][0]
    camera = look_at([places for places, _ in found], size=SIZE)
    pictures = []
    for places, ends in found:
        shift = np.linalg.norm(places - first, axis=1)
        rgba = render_surface(
            places, triangles, shift, camera=camera, colormap=colours(), limits=(0.0, HIGHEST)
        )
        paper = 1.0 - rgba[:, :, 3:] * (1.0 - rgba[:, :, :3])
        image = Image.fromarray(np.round(255 * paper.clip(0, 1)).astype(np.uint8))
        if ends is not None:
            from PIL import ImageDraw

            (x0, y0, _), (x1, y1, _) = camera.project(ends)
            pen = ImageDraw.Draw(image)
            pen.line([(x0, y0), (x1, y1)], fill=(20, 110, 200), width=3)
            pen.ellipse([x1 - 5, y1 - 5, x1 + 5, y1 + 5], fill=(20, 110, 200))
        pictures.append(image)
    pictures[0].save(
        path,
        save_all=True,
        append_images=pictures[1:],
        duration=round(1000 / RATE),
        loop=0,
        quality=70,
        method=6,
    )
    print(f"written: {path}, {len(pictures)} pictures, {path.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "pictures" / "pull.webp")
