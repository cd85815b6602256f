"""Three tools through one port: an organ is palpated, a ligament cut, a nodule ablated.

The trocar recognises each tool by its tag. The probe is felt through contact, the knife by the
toughness of what it cuts; the ablator is not felt. Prints the largest force of each tool, or draws
the force on the hand and the scene with each tool where a file is named.

    python examples/three_tools.py [PICTURE.png]
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np

import tissu as ts
from tissu.trocar.controller import Controller
from tissu.trocar.touch import Felt, Touch

ORGAN = Path(__file__).with_name("organ.vtu")
PROBE, KNIFE, ABLATOR = 0x51A0, 0x51A1, 0x51A2
CHANGES = ts.ToolChanges(
    times=(0, "1.4 s", "1.5 s", "3.3 s", "3.4 s"), tags=(PROBE, None, KNIFE, None, ABLATOR)
)
Place = tuple[float | str, float | str, float | str]
HIGH: Place = (0, 0, "4 cm")
PATH: dict[str, Place] = {
    # the probe presses the organ, and slides
    "0 s": (0, 0, "10 cm"),
    "0.5 s": (0, 0, "14.5 cm"),
    "0.9 s": ("1 cm", 0, "14.5 cm"),
    "1.3 s": HIGH,
    "1.6 s": HIGH,
    # the knife goes down beside the ligament, across, and up
    "2 s": ("6.6 cm", "-1.4 cm", "12 cm"),
    "2.8 s": ("6.6 cm", "3 cm", "12 cm"),
    "3 s": ("6.6 cm", "3 cm", "8 cm"),
    "3.2 s": HIGH,
    "3.5 s": HIGH,
    # the ablator goes through the nodule beside the organ
    "3.9 s": ("-9 cm", 0, "14.8 cm"),
    "4.3 s": ("-7.2 cm", 0, "14.8 cm"),
    "4.6 s": HIGH,
}
"""Where the hand leads the tip, in the port: the third number is the depth."""


def organ() -> ts.Body:
    """The organ of the examples."""
    return ts.Body(
        mesh=ts.read_mesh(ORGAN),
        law=ts.StableNeoHooke(young="5 kPa", poisson=0.45),
        density="1.05 g/cm^3",
        viscosity=ts.Rayleigh(mass="1 1/s", stiffness="20 ms"),
    )


def ligament() -> ts.Body:
    """A band above the organ, between two ends that are held."""
    return ts.Body(
        mesh=ts.BarMesh(size=(0.06, 0.008, 0.01), cells=(12, 3, 3), origin=(-0.01, 0.002, 0.085)),
        law=ts.StableNeoHooke(young="40 kPa", poisson=0.4),
        density="1.1 g/cm^3",
        viscosity=ts.Rayleigh(mass="5 1/s", stiffness="5 ms"),
    )


def nodule() -> ts.Body:
    """A lump of tissue beside the organ."""
    return ts.Body(
        mesh=ts.BarMesh(size=(0.03, 0.03, 0.025), cells=(6, 6, 5), origin=(-0.143, -0.009, 0.03)),
        law=ts.StableNeoHooke(young="8 kPa", poisson=0.45),
        density="1.05 g/cm^3",
        viscosity=ts.Rayleigh(mass="5 1/s", stiffness="5 ms"),
    )


def scene() -> ts.Scene:
    """Organ, ligament, nodule, and a trocar above them with its three tools."""
    probe = ts.CapsuleObstacle([(-0.046, 0.006, 0.21), (-0.046, 0.006, 0.31)], radius="5 mm")
    knife = ts.Knife(
        edge=((0, 0, 0), (0, 0, "-3.5 cm")), cuts=("ligament",), toughness="20 J/m^2",
        position=(-0.046, 0.006, 0.2),
    )  # fmt: skip
    ablator = ts.Ablator(radius="7 mm", removes=("nodule",), position=(-0.046, 0.006, 0.2))
    hand = ts.Hand(times=tuple(PATH), points=tuple(PATH.values()), tremor="0.1 mm")
    trocar = ts.Trocar(
        port=ts.Port(at=("-4.6 cm", "0.6 cm", "20 cm"), axis=(0, 0, -1)),
        device=ts.SimulatedDevice(hand=hand, changes=CHANGES),
        tools={PROBE: "probe", KNIFE: "knife", ABLATOR: "ablator"},
    )
    ends = ts.Fixed("ligament", on=ts.Plane((-0.01, 0, 0), (1, 0, 0)))
    return ts.Scene(
        name="three_tools",
        bodies={"organ": organ(), "ligament": ligament(), "nodule": nodule()},
        fixed=[
            ts.Fixed("organ", on=ts.Box(max=(None, None, -0.04))),
            ends,
            ts.Fixed("nodule", on=ts.Plane((0, 0, 0.03), (0, 0, 1))),
            ts.Fixed("ligament", on=ts.Plane((0.05, 0, 0), (1, 0, 0))),
        ],
        obstacles={"probe": probe},
        contacts=[ts.Contact(("organ", "probe"), friction=0.2)],
        instruments={"knife": knife, "ablator": ablator},
        trocars={"right": trocar},
        editing=True,
        step=ts.ImplicitEuler("10 ms"),
        duration=4.7,
    )


def felt(simulation: ts.Simulation, shots: dict[float, Path] | None = None) -> list[Felt]:
    """What each step felt, to the end of the scene; pictures of the scene at some times [s]."""
    waiting = dict(shots or {})
    found = []
    with Controller(simulation.scene.trocars["right"]) as controller:
        touch = Touch(simulation, controller)
        for _ in range(round(4.7 / simulation.dt)):
            found.append(touch.step())
            for time in [time for time in waiting if time <= simulation.time]:
                ts.draw(simulation, waiting.pop(time))
    return found


def cropped(picture: Path) -> np.ndarray:
    """The right half of a picture, which shows the scene as it is, without its margins."""
    import matplotlib.pyplot as plt

    image = plt.imread(picture)[:, :, :3]
    height, width = image.shape[:2]
    image = image[int(0.22 * height) :, int(0.5 * width) : int(0.87 * width)]
    rows, columns = np.nonzero((image < 0.98).any(axis=2))
    return np.asarray(image[rows.min() : rows.max() + 1, columns.min() : columns.max() + 1])


def draw(simulation: ts.Simulation, path: Path) -> None:
    """Runs it: the scene with each tool at work, and the force on the hand over time."""
    import matplotlib.pyplot as plt

    figure, axes = plt.subplot_mosaic(
        [["probe", "knife", "ablator"], ["force"] * 3], figsize=(9, 6), layout="constrained"
    )
    with tempfile.TemporaryDirectory() as folder:
        shots = {at: Path(folder, f"{at}.png") for at in (0.7, 2.6, 4.2)}
        found = felt(simulation, shots)
        for tool, shot in zip(("probe", "knife", "ablator"), shots.values(), strict=True):
            axes[tool].imshow(cropped(shot))
            axes[tool].axis("off")
    times = np.array([one.time for one in found])
    forces = np.array([np.linalg.norm(one.fast) for one in found])
    below = axes["force"]
    for tool, color in (("probe", "#1b7a78"), ("knife", "#b3412e"), ("ablator", "#6a5acd")):
        on = np.array([one.tool == tool for one in found])
        below.fill_between(times, 0.0, forces.max(), where=on, color=color, alpha=0.12, lw=0)
        below.plot(times, np.where(on, forces, np.nan), color=color, label=tool)
    below.set(xlabel="time [s]", ylabel="force on the hand [N]", xlim=(0.0, times[-1]))
    below.legend(loc="upper right")
    figure.savefig(path, dpi=130)
    plt.close(figure)


def main() -> None:
    """Runs it."""
    simulation = scene().compile()
    if len(sys.argv) > 1:
        return draw(simulation, Path(sys.argv[1]))
    cells = simulation.meshes["nodule"].cell_count
    opened: list[float] = []
    simulation.on_step(lambda report: opened.extend(cut.area for cut in report.cuts))
    found = felt(simulation)
    for tool in simulation.scene.trocars["right"].tools.values():
        forces = [np.linalg.norm(one.fast) for one in found if one.tool == tool]
        print(f"{tool}: {len(forces)} steps, at most {max(forces):.2f} N on the hand")
    left = simulation.meshes["nodule"].cell_count
    print(f"opened: {1e4 * sum(opened):.2f} cm2 of the ligament; gone: {cells - left} cells")
    return None


if __name__ == "__main__":
    main()
