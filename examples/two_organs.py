"""Two organs are pushed together: the upper one comes down by 4 cm onto the lower one.

Prints the forces on both and how many places cross, which are none.

    python examples/two_organs.py
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

import tissu as ts

APART = 0.17  # height of the upper organ above the lower one [m]
DOWN = (0, 0, "-4 cm")
ORGAN = Path(__file__).with_name("organ.vtu")


def scene() -> ts.Scene:
    """The lower organ is held at its bottom; the top of the upper one is led down."""
    mesh = ts.read_mesh(ORGAN)
    lower = ts.Body(
        mesh=mesh,
        law=ts.StableNeoHooke(young="5 kPa", poisson=0.45),
        density="1.05 g/cm^3",
        viscosity=ts.Rayleigh(mass="1 1/s", stiffness="20 ms"),
    )
    above = ts.Mesh(points=mesh.points + np.array([0.0, 0.0, APART]), cells=mesh.cells)
    top = ts.Box(min=(None, None, APART + 0.03))
    path = [ts.Prescribed("upper", on=top, times=(0, "0.4 s"), displacements=((0, 0, 0), DOWN))]
    return ts.Scene(
        name="two_organs",
        bodies={"lower": lower, "upper": lower.replace(mesh=above)},
        contacts=[ts.Contact(("lower", "upper"), friction=0.3)],
        fixed=[ts.Fixed("lower", on=ts.Box(max=(None, None, -0.04)))],
        prescribed=path,
        step=ts.ImplicitEuler("10 ms"),
        duration=0.6,
    )


def main() -> None:
    """Runs it."""
    simulation = scene().compile()
    for report in simulation.run():
        print(report)
    for name in ("lower", "upper"):
        print(name, simulation.force_on(name).force)
    print(len(simulation.crossings()), "places cross")


if __name__ == "__main__":
    main()
