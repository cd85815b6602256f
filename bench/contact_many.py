"""Prints the part of docs/measured/contact.md on ten thousand contacts.

    python bench/contact_many.py [--write]

A slab of 20,000 hexahedra rests on a table with all the vertices of its lower side. Steps are
measured once it rests, with one thread and with two, in turns.
"""

from __future__ import annotations

import datetime
import sys
import time
from dataclasses import dataclass

import numpy as np
from contact import PAGE, put
from kernels import commit, digits, table

import tissu as ts
from tissu.cli.info import machine_line

CELLS = 100
SETTLE, STEPS, ROUNDS = 60, 20, 3


def slab(threads: int) -> ts.Scene:
    """1 m wide, 2 cm thick, a tenth of a millimetre above its rest distance."""
    body = ts.Body(
        mesh=ts.BarMesh(size=(1, 1, 0.02), cells=(CELLS, CELLS, 2), cell="hexahedron"),
        law=ts.StableNeoHooke(young="50 kPa", poisson=0.4),
        density="1 g/cm^3",
        viscosity=ts.Rayleigh(mass=5, stiffness=0.01),
    )
    return ts.Scene(
        bodies={"slab": body},
        gravity=(0, 0, -9.81),
        obstacles={"table": ts.PlaneObstacle((0, 0, -0.0011), (0, 0, 1))},
        contacts=[ts.Contact(("slab", "table"), friction=0.3)],
        step=ts.ImplicitEuler("10 ms"),
        threads=threads,
    )


@dataclass
class Steps:
    """Of one round: wall times [s], time in the rows of contact [s], contacts, systems."""

    walls: list[float]
    contact: float
    contacts: int
    systems: int


def spent(simulation: ts.Simulation) -> float:
    """Time in the rows of contact since the start [s]."""
    profile = simulation.profile()
    rows = [row.ms_per_step for row in profile.rows if row.effect == "contact"]
    return 1e-3 * profile.steps * sum(rows)


def round_of(simulation: ts.Simulation) -> Steps:
    """The next STEPS of a slab at rest."""
    before, walls, systems = spent(simulation), [], 0
    for _ in range(STEPS):
        begin = time.perf_counter()
        report = simulation.step()
        walls.append(time.perf_counter() - begin)
        systems += report.newton_iterations
        if not report.converged:
            raise RuntimeError(f"a step of the slab did not converge: {report}")
    return Steps(walls, spent(simulation) - before, report.contacts, systems)


def text() -> str:
    """A line for each number of threads."""
    simulations = {threads: slab(threads).compile() for threads in (1, 2)}
    for simulation in simulations.values():
        for _ in range(SETTLE):
            simulation.step()
    rounds: dict[int, list[Steps]] = {threads: [] for threads in simulations}
    for _ in range(ROUNDS):
        for threads, simulation in simulations.items():
            rounds[threads].append(round_of(simulation))
    lines, median = [], {}
    for threads, found in rounds.items():
        walls = np.concatenate([one.walls for one in found])
        median[threads] = float(np.median(walls))
        contact = sum(one.contact for one in found)
        systems = sum(one.systems for one in found)
        lines.append(
            [
                str(threads),
                f"{found[-1].contacts:,}",
                digits(1e3 * median[threads]),
                f"{systems / len(walls):.1f}",
                f"{100 * contact / walls.sum():.0f} %",
                digits(1e9 * contact / systems / found[-1].contacts),
                f"{median[1] / median[threads]:.2f}",
            ]
        )
    head = ["threads", "contacts", "p50, ms", "systems a step", "share of contact"]
    head += ["ns a contact and system", "times as fast"]
    where = f"{machine_line()} Commit {commit()}, {datetime.date.today()}."
    return f"{table(head, lines)}\n\n{where}"


def main() -> int:
    """Runs, prints or writes."""
    found = text()
    print(found)
    if "--write" in sys.argv:
        page = put(PAGE.read_text(encoding="utf-8"), "many contacts", found)
        PAGE.write_text(page, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
