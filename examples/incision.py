"""A block of tissue that is held at both ends under tension is cut, and the incision opens.

    python examples/incision.py [FOLDER]

writes `incision.png`, and `incision.pvd` for ParaView: the block with its cut faces.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

import tissu as ts


def block() -> ts.Scene:
    """12 x 6 x 2.4 cm of soft tissue, drawn out by a fifth of its length in 0.5 s."""
    mesh = ts.bar_mesh(size=(0.12, 0.06, 0.024), cells=(30, 15, 6), cell="tetra")
    tissue = ts.Body(
        mesh=mesh,
        law=ts.StableNeoHooke(young="8 kPa", poisson=0.45),
        density=1060,
        viscosity=ts.Rayleigh(mass=5, stiffness="5 ms"),
    )
    end = ts.Plane((0.12, 0, 0), (1, 0, 0))
    out = ((0, 0, 0), (0.024, 0, 0))
    return ts.Scene(
        name="incision",
        bodies={"tissue": tissue},
        fixed=[ts.Fixed("tissue", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        prescribed=[ts.Prescribed("tissue", on=end, times=(0, 0.5), displacements=out)],
        step=ts.ImplicitEuler("10 ms"),
        editing=True,
    )


def knife() -> ts.Sweep:
    """The way of an edge of 3 cm whose tip runs 13 mm below the upper side, in a bow."""
    along = np.linspace(0.0, 1.0, 15)
    across = np.stack([0.072 + 0.006 * np.sin(np.pi * along), 0.012 + 0.036 * along], axis=1)
    return ts.Sweep([[(x, y, 0.009), (x, y, 0.039)] for x, y in across])


def main(folder: Path) -> ts.Simulation:
    """Draw the block out, cut it, let the incision open."""
    simulation = block().compile()
    for report in simulation.run(0.7):
        assert report.converged
    print(simulation.cut("tissue", knife()))
    folder.mkdir(parents=True, exist_ok=True)
    series = ts.Series(simulation, folder)
    for number, report in enumerate(simulation.run(0.6)):
        assert report.converged
        if number % 10 == 0:
            series.write()
    ts.draw(simulation, folder / "incision.png")
    return simulation


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "results"))
