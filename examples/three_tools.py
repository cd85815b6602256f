"""Three tools through one port: an organ is palpated, cut, ablated, and felt in its wound.

The trocar recognises each tool by its tag. The probe is felt through contact, the knife by the
toughness of what it cuts; the ablator is not felt. Prints the largest force of each tool and what
was done to the organ, or draws the organ with each tool and the force on the hand where a file is
named.

    python examples/three_tools.py [PICTURE.png]
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import tissu as ts
from tissu.trocar.controller import Controller
from tissu.trocar.touch import Felt, Touch

ORGAN = Path(__file__).with_name("organ.vtu")
PROBE, KNIFE, ABLATOR = 0x51A0, 0x51A1, 0x51A2
TOUGHNESS = 20.0
"""J/m2, of the organ under the knife."""
CHANGES = ts.ToolChanges(
    times=(0, "1.3 s", "1.4 s", "2.8 s", "2.9 s", "3.7 s", "3.8 s"),
    tags=(PROBE, None, KNIFE, None, ABLATOR, None, PROBE),
)
Place = tuple[float | str, float | str, float | str]
HIGH: Place = (0, 0, "6 cm")
PATH: dict[str, Place] = {
    # the probe presses the organ, slides, and comes back up
    "0 s": (0, 0, "10 cm"),
    "0.25 s": (0, 0, "12.5 cm"),
    "0.6 s": (0, 0, "14.5 cm"),
    "0.9 s": ("1 cm", 0, "14.5 cm"),
    "1.2 s": HIGH,
    "1.5 s": HIGH,
    # the knife goes down beside the organ, and across it
    "1.8 s": ("5 cm", "-6 cm", "15 cm"),
    "2.5 s": ("5 cm", "6 cm", "15 cm"),
    "2.7 s": HIGH,
    "3 s": HIGH,
    # the ablator goes into the organ where it was palpated
    "3.3 s": (0, 0, "14.2 cm"),
    "3.6 s": HIGH,
    "3.9 s": HIGH,
    # the probe again, down to the floor of the wound
    "4.1 s": (0, 0, "14 cm"),
    "4.7 s": (0, 0, "17.5 cm"),
    "4.9 s": (0, 0, "17.5 cm"),
    "5.1 s": HIGH,
}
"""Where the hand leads the tip, in the port: the third number is the depth."""
DURATION = 5.1
"""s"""
SHOTS = (0.7, 2.3, 3.3, 4.8)
"""s at which the tools are drawn."""
COLOURS = {"probe": "#1b7a78", "knife": "#20406e", "ablator": "#6a5acd"}
LIGHT = np.array([-0.4, -0.5, 0.77])


def scene() -> ts.Scene:
    """The organ of the examples, and a trocar above it with its three tools."""
    organ = ts.Body(
        mesh=ts.read_mesh(ORGAN),
        law=ts.StableNeoHooke(young="5 kPa", poisson=0.45),
        density="1.05 g/cm^3",
        viscosity=ts.Rayleigh(mass="1 1/s", stiffness="20 ms"),
    )
    probe = ts.CapsuleObstacle([(-0.046, 0.006, 0.21), (-0.046, 0.006, 0.31)], radius="5 mm")
    knife = ts.Knife(
        edge=((0, 0, 0), (0, 0, "-3.5 cm")), cuts=("organ",), toughness=TOUGHNESS,
        position=(-0.046, 0.006, 0.2),
    )  # fmt: skip
    ablator = ts.Ablator(radius="12 mm", removes=("organ",), position=(-0.046, 0.006, 0.2))
    hand = ts.Hand(times=tuple(PATH), points=tuple(PATH.values()), tremor="0.1 mm")
    trocar = ts.Trocar(
        port=ts.Port(at=("-4.6 cm", "0.6 cm", "20 cm"), axis=(0, 0, -1)),
        device=ts.SimulatedDevice(hand=hand, changes=CHANGES),
        tools={PROBE: "probe", KNIFE: "knife", ABLATOR: "ablator"},
    )
    return ts.Scene(
        name="three_tools",
        bodies={"organ": organ},
        fixed=[ts.Fixed("organ", on=ts.Box(max=(None, None, -0.04)))],
        obstacles={"probe": probe},
        contacts=[ts.Contact(("organ", "probe"), friction=0.2), ts.SelfContact("organ")],
        instruments={"knife": knife, "ablator": ablator},
        trocars={"right": trocar},
        editing=True,
        step=ts.ImplicitEuler("10 ms"),
        duration=DURATION,
    )


def felt(simulation: ts.Simulation, look: Callable[[Felt], None] | None = None) -> list[Felt]:
    """What each step felt, to the end of the scene; `look` is called after each."""
    found = []
    with Controller(simulation.scene.trocars["right"]) as controller:
        touch = Touch(simulation, controller)
        for _ in range(round(DURATION / simulation.dt)):
            found.append(touch.step())
            if look is not None:
                look(found[-1])
    return found


def show(axes: Any, simulation: ts.Simulation, one: Felt) -> None:
    """The organ from above, what was cut in red, and the tool from its tip towards the port."""
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # type: ignore[import-untyped]

    surface = simulation.surface("organ")
    corners = surface.points[surface.triangles]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    across /= np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-12)
    light = 0.3 + 0.7 * np.clip(across @ LIGHT, 0.0, 1.0)
    colours = np.where(surface.cut[:, None], (0.85, 0.25, 0.2), (0.72, 0.52, 0.45))
    colours = colours * light[:, None]
    axes.add_collection3d(
        Poly3DCollection(corners, facecolors=colours, edgecolors=colours, linewidths=0.3)
    )
    if one.tool is not None:
        port = np.array(simulation.scene.trocars["right"].port.at)
        shaft = np.array([one.tip, one.tip + 0.5 * (port - one.tip)])
        axes.plot(*shaft.T, color=COLOURS[one.tool], linewidth=4, zorder=10)
    axes.set(xlim=(-0.11, 0.12), ylim=(-0.06, 0.07), zlim=(-0.08, 0.14))
    axes.set_box_aspect((23, 13, 22), zoom=1.5)
    axes.view_init(elev=52, azim=-70)
    axes.set_axis_off()
    axes.text2D(0.62, 0.9, f"{one.tool}, {one.time:.1f} s", transform=axes.transAxes)


def draw(simulation: ts.Simulation, path: Path) -> None:
    """Runs it: the organ with each tool at work, and the force on the hand over time."""
    import matplotlib.pyplot as plt

    figure = plt.figure(figsize=(9, 8.4))
    places = [
        figure.add_axes((0.5 * (k % 2), 0.66 - 0.32 * (k // 2), 0.5, 0.33), projection="3d",
                        computed_zorder=False) for k in range(len(SHOTS))
    ]  # fmt: skip
    waiting = dict(zip(SHOTS, places, strict=True))

    def look(one: Felt) -> None:
        for time in [time for time in waiting if time <= one.time]:
            show(waiting.pop(time), simulation, one)

    found = felt(simulation, look)
    times = np.array([one.time for one in found])
    forces = np.array([np.linalg.norm(one.fast) for one in found])
    below = figure.add_axes((0.08, 0.07, 0.89, 0.25))
    for tool, color in COLOURS.items():
        on = np.array([one.tool == tool for one in found])
        below.fill_between(times, 0.0, forces.max(), where=on, color=color, alpha=0.12, lw=0)
        below.plot(times, np.where(on, forces, np.nan), color=color, label=tool)
    below.set(xlabel="time [s]", ylabel="force on the hand [N]", xlim=(0.0, times[-1]))
    below.legend(loc="upper center")
    figure.savefig(path, dpi=130)
    plt.close(figure)


def main() -> None:
    """Runs it."""
    simulation = scene().compile()
    if len(sys.argv) > 1:
        return draw(simulation, Path(sys.argv[1]))
    volume = simulation.pieces("organ")[0].volume
    opened: list[float] = []
    simulation.on_step(lambda report: opened.extend(cut.area for cut in report.cuts))
    found = felt(simulation)
    for tool in dict.fromkeys(one.tool for one in found if one.tool is not None):
        forces = [np.linalg.norm(one.fast) for one in found if one.tool == tool]
        print(f"{tool}: {len(forces)} steps, at most {max(forces):.2f} N on the hand")
    gone = volume - sum(piece.volume for piece in simulation.pieces("organ"))
    print(f"opened: {1e4 * sum(opened):.2f} cm2; gone: {1e6 * gone:.1f} cm3 of {1e6 * volume:.0f}")
    return None


if __name__ == "__main__":
    main()
