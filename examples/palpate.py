"""A hand palpates an organ through a trocar: what it feels, of the tissue and of the ticks.

The port is above the right lobe; the simulated hand goes down by 4 cm, to the side, and up again.
Prints both forces, and draws them over time if a file is named.

    python examples/palpate.py [PICTURE.png]
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

import tissu as ts
from tissu.trocar.controller import Controller
from tissu.trocar.touch import Felt, Touch

ORGAN = Path(__file__).with_name("organ.vtu")
TIMES = (0, "0.1 s", "0.6 s", "1.2 s", "1.4 s", "1.7 s")
POINTS = (
    *((0, 0, "10 cm"), (0, 0, "10 cm"), (0, 0, "14.5 cm")),
    *(("1 cm", 0, "14.5 cm"), ("1 cm", 0, "14.5 cm"), (0, 0, "10 cm")),
)
"""Where the hand leads the tip, in the port: the third number is the depth."""


def scene() -> ts.Scene:
    """The organ of the examples under a capsule of 5 mm, which is a tool of a trocar."""
    organ = ts.Body(
        mesh=ts.read_mesh(ORGAN),
        law=ts.StableNeoHooke(young="5 kPa", poisson=0.45),
        density="1.05 g/cm^3",
        viscosity=ts.Rayleigh(mass="1 1/s", stiffness="20 ms"),
    )
    probe = ts.CapsuleObstacle(
        [("-4.6 cm", "0.6 cm", "8.5 cm"), ("-4.6 cm", "0.6 cm", "18 cm")], radius="5 mm"
    )
    trocar = ts.Trocar(
        port=ts.Port(at=("-4.6 cm", "0.6 cm", "20 cm"), axis=(0, 0, -1)),
        device=ts.SimulatedDevice(hand=ts.Hand(times=TIMES, points=POINTS, tremor="0.1 mm")),
        tools={0x51A0: "probe"},
    )
    return ts.Scene(
        name="palpate",
        bodies={"organ": organ},
        fixed=[ts.Fixed("organ", on=ts.Box(max=(None, None, -0.04)))],
        obstacles={"probe": probe},
        contacts=[ts.Contact(("organ", "probe"), friction=0.2)],
        trocars={"right": trocar},
        step=ts.ImplicitEuler("10 ms"),
        duration=1.7,
    )


def felt(simulation: ts.Simulation, steps: int) -> list[Felt]:
    """What each step felt; no step leaves a crossing."""
    with Controller(simulation.scene.trocars["right"]) as controller:
        touch = Touch(simulation, controller)
        found = []
        for _ in range(steps):
            found.append(touch.step())
            assert len(simulation.crossings()) == 0
    return found


def draw(found: list[Felt], path: Path) -> None:
    """Forces over time."""
    import matplotlib.pyplot as plt

    times = [one.time for one in found]
    figure, axes = plt.subplots(figsize=(7.0, 3.2), layout="constrained")
    for name, forces in (("tissue's step", [one.force for one in found]),
                         ("tick", [one.fast for one in found])):  # fmt: skip
        axes.plot(times, np.linalg.norm(forces, axis=1), label=f"force of the {name}")
    axes.set(xlabel="time [s]", ylabel="force on the hand [N]", title="A hand palpates an organ")
    axes.legend()
    figure.savefig(path, dpi=110)


def main() -> None:
    """Runs it."""
    simulation = scene().compile()
    found = felt(simulation, 170)
    for one in found[9::10]:
        slow, fast = np.linalg.norm(one.force), np.linalg.norm(one.fast)
        print(
            f"t = {one.time:.2f} s, depth {1e3 * one.joints[3]:.1f} mm: {slow:.3f} N, {fast:.3f} N"
        )
    if len(sys.argv) > 1:
        draw(found, Path(sys.argv[1]))


if __name__ == "__main__":
    main()
