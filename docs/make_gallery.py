"""Draws the pictures of the gallery: python docs/make_gallery.py [NAME …].

Each scene of examples runs to the time that shows most, and is drawn at rest and then. Curves are
drawn where they show more than a shape.
"""

from __future__ import annotations

import runpy
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import matplotlib

matplotlib.use("agg")

import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

import tissu as ts

ROOT = Path(__file__).resolve().parent
EXAMPLES = ROOT.parent / "examples"
FOLDER = ROOT / "pictures" / "gallery"
WIDTH = 1000  # pixels
UNTIL = {
    "bounce": 0.17,
    "beam": 0.35,
    "organ": 2.0,
    "slide": 0.2,
    "tumble": 0.3,
    "tear": 0.88,
    "embedded": 0.7,
    "severed": 0.38,
}
"""Time at which a scene shows most [s], where it is not the end."""
STRESS = ("slice", "pressed", "tissue", "severed", "twist")
"""Scenes that are coloured by von Mises stress."""


def kept(picture: Path, path: Path) -> None:
    """Makes a picture small, and puts it in its place."""
    image = Image.open(picture).convert("RGB")
    image = image.resize(
        (WIDTH, round(image.height * WIDTH / image.width)), Image.Resampling.LANCZOS
    )
    image.save(path, quality=82, method=6)
    print(f"written: {path.relative_to(ROOT.parent)}, {path.stat().st_size / 1000:.0f} kB")


def scene(name: str, path: Path) -> None:
    """The scene of an example at rest and later."""
    simulation = ts.Scene.from_yaml(EXAMPLES / f"{name}.yaml").compile()
    for _ in simulation.run(UNTIL.get(name)):
        pass
    ts.draw(simulation, path, field="von_mises" if name in STRESS else "displacement")


def curve(x: list[float], y: list[float], labels: tuple[str, str], title: str, path: Path) -> None:
    """One curve."""
    figure, axes = plt.subplots(figsize=(10, 4.2))
    axes.plot(x, y, color="#1b7a78", linewidth=2)
    axes.set(xlabel=labels[0], ylabel=labels[1], title=title)
    axes.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(path, dpi=160)
    plt.close(figure)


def relax(path: Path) -> None:
    """Force against time."""
    simulation = ts.Scene.from_yaml(EXAMPLES / "relax.yaml").compile()
    top = np.isclose(simulation.meshes["block"].points[:, 2], 0.02)
    times, forces = [], []
    for _ in simulation.run():
        times.append(simulation.time)
        forces.append(float(simulation.reactions("block")[top, 2].sum()))
    curve(times, forces, ("time [s]", "force [N]"), "relax: a block is drawn out and held", path)


def snap(path: Path) -> None:
    """Force against the displacement of the top."""
    simulation = ts.Scene.from_yaml(EXAMPLES / "snap.yaml").compile()
    ways, forces = [0.0], [0.0]
    for _ in simulation.run():
        ways.append(-1e3 * float(simulation.displacements("truss")[1, 2]))
        forces.append(-1e3 * float(simulation.reactions("truss")[1, 2]))
    labels = ("displacement of the top [mm]", "force that holds it there [mN]")
    curve(ways, forces, labels, "snap: the truss of von Mises", path)


def wave(path: Path) -> None:
    """Velocities along the bar at the end."""
    simulation = ts.Scene.from_yaml(EXAMPLES / "wave.yaml").compile()
    for _ in simulation.run("50 ms"):
        pass
    along = simulation.meshes["bar"].points[:, 0]
    speeds = 1e3 * simulation.velocities["bar"][:, 0]
    labels = ("position along the bar [m]", "velocity [mm/s]")
    curve(list(along), list(speeds), labels, "wave: 50 ms after the end was pulled", path)


def incision(path: Path) -> None:
    """What the program of the example draws."""
    with tempfile.TemporaryDirectory() as folder:
        runpy.run_path(str(EXAMPLES / "incision.py"))["main"](Path(folder))
        Path(folder, "incision.png").rename(path)


def resection(path: Path) -> None:
    """The organ after the work of the example."""
    names = runpy.run_path(str(EXAMPLES / "resection.py"))
    simulation = names["scene"]().compile()
    names["work"](simulation)
    ts.draw(simulation, path)


def lobe(path: Path) -> None:
    """The organ after its operation."""
    names = runpy.run_path(str(EXAMPLES / "lobe.py"))
    simulation = names["scene"]().compile()
    names["operate"](simulation)
    ts.draw(simulation, path)


def two_organs(path: Path) -> None:
    """The organs as the example leaves them."""
    simulation = runpy.run_path(str(EXAMPLES / "two_organs.py"))["scene"]().compile()
    for _ in simulation.run():
        pass
    ts.draw(simulation, path)


def trocar(path: Path) -> None:
    """The force that the simulated hand feels from a wall that gives way."""
    from tissu.trocar.controller import Controller
    from tissu.trocar.model import LocalModel

    times, forces = [], []
    with Controller(ts.Scene.from_yaml(EXAMPLES / "trocar.yaml").trocars["right"]) as controller:
        for _ in range(180):
            report = controller.step(10)
            wall = LocalModel.plane(
                report.q, through=(0, 0, 0.11), normal=(0, 0, -1), stiffness=500.0
            )
            controller.publish(wall)
            times.append(report.time)
            forces.append(float(np.linalg.norm(report.force)))
    labels = ("time [s]", "force on the tool [N]")
    curve(times, forces, labels, "trocar: a hand presses a tool on a wall that gives way", path)


def three_tools(path: Path) -> None:
    """The organ with each tool, and the force on the hand."""
    names = runpy.run_path(str(EXAMPLES / "three_tools.py"))
    names["draw"](names["scene"]().compile(), path)


PROGRAMS: dict[str, Callable[[Path], None]] = {
    "relax": relax,
    "snap": snap,
    "wave": wave,
    "incision": incision,
    "resection": resection,
    "lobe": lobe,
    "two_organs": two_organs,
    "trocar": trocar,
    "three_tools": three_tools,
}


def main(names: list[str]) -> None:
    """Draws those that are named, or all."""
    FOLDER.mkdir(exist_ok=True)
    for name in names or sorted({*ts.examples.names(), *PROGRAMS}):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "picture.png")
            PROGRAMS[name](path) if name in PROGRAMS else scene(name, path)
            kept(path, FOLDER / f"{name}.webp")


if __name__ == "__main__":
    main(sys.argv[1:])
