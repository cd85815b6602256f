"""A lobe is cut off an organ: it falls on a table, lies there, and the table bears its weight.

The organ hangs by its ligaments. A second, shallow cut leaves an incision whose walls rest on each
other.

    python examples/lobe.py [FOLDER]

writes `lobe.png`.
"""

from __future__ import annotations

import sys
from pathlib import Path

import tissu as ts

GRAVITY = 9.81
"""[m/s2]"""
ORGAN = Path(__file__).with_name("organ.vtu")
LOBE = ts.Plane((-0.05, 0, 0), (1, 0, 0.2))
"""what cuts the lobe off"""
WOUND = ts.Disc((0.01, 0.0, 0.05), (1, 0.2, 0), 0.025)
"""a shallow cut from above"""


def scene() -> ts.Scene:
    """The organ above a table."""
    organ = ts.Body(
        mesh=ts.read_mesh(ORGAN, unit="m"),
        law=ts.StableNeoHooke(young="10 kPa", poisson=0.45),
        density="1.05 g/cm^3",
        viscosity=ts.Rayleigh(mass=4, stiffness="10 ms"),
    )
    ligaments = ts.Box(min=(-0.03, 0, 0.02), max=(0.035, None, None))
    return ts.Scene(
        name="lobe",
        bodies={"organ": organ},
        gravity=(0, 0, -GRAVITY),
        fixed=[ts.Fixed("organ", on=ligaments)],
        obstacles={"table": ts.PlaneObstacle((0, 0, -0.092), (0, 0, 1))},
        contacts=[ts.Contact(("organ", "table"), friction=0.3), ts.SelfContact("organ")],
        step=ts.ImplicitEuler("10 ms"),
        editing=True,
    )


def operate(simulation: ts.Simulation) -> ts.CutReport:
    """Let it hang, cut, and wait until the lobe lies. What the cut of the lobe said."""
    for _ in simulation.run(0.3):
        pass
    simulation.cut("organ", WOUND)
    report = simulation.cut("organ", LOBE)
    for _ in simulation.run(0.9):
        pass
    return report


def main(folder: Path) -> None:
    """Operate, say what the table bears, and draw it."""
    simulation = scene().compile()
    report = operate(simulation)
    (lobe,) = (piece for piece in report.pieces if not piece.held)
    share = -simulation.force_on("table").force[2] / (GRAVITY * lobe.mass)
    print(f"the lobe has {1e3 * lobe.mass:.1f} g; the table bears {share:.3f} of its weight")
    print(len(simulation.crossings()), "places cross")
    ts.draw(simulation, folder / "lobe.png")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "results"))
