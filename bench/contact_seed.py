"""Prints the cubes of Chendeb (2007), sections 4.2 and 4.3, in docs/measured/contact.md.

    python bench/contact_seed.py [--write]

One, two and four cubes with 288 triangles each fall onto a floor and onto each other, with
self-contact, in explicit steps of each response and in implicit ones.
"""

from __future__ import annotations

import argparse
import datetime
import sys
import time

import numpy as np
from contact import PAGE, put
from kernels import commit, digits, table

import tissu as ts
from tissu.cli.info import machine_line

CELLS = (4, 4, 7)  # 4 (4 * 4 + 4 * 7 + 7 * 4) = 288 triangles on the surface
SIDE, APART = 0.05, 1e-3  # m
SECONDS = 0.1  # of a run; the cubes fall by 1 mm within 14 ms
SHARE = 0.9  # of the stable step
STEPS = 400  # that are timed, at the end
HELD = 0.99  # of the stable step, with which two cubes are run again
SEED = {"penalty": "1 (0.1)", "geometric": "1 (0.1)", "impulse": "0.1 (0.01)"}


def scene(count: int, method: str, step: ts.Step) -> ts.Scene:
    """So many cubes: one on the floor, one above it, two beside these."""
    bodies = {}
    for k in range(count):
        origin = ((k // 2) * (SIDE + APART), 0.0, APART + (k % 2) * (SIDE + APART))
        bodies[f"cube {k + 1}"] = ts.Body(
            mesh=ts.BarMesh(size=(SIDE,) * 3, cells=CELLS, cell="tetra", origin=origin),
            law=ts.StableNeoHooke(young="50 kPa", poisson=0.3),
            density=1000.0,
            viscosity=ts.Rayleigh(mass=2.0, stiffness=0.0),
        )
    return ts.Scene(
        bodies=bodies,
        obstacles={"floor": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact("all")],
        contact=ts.ContactSettings(method=method),
        gravity=(0, 0, -9.81),
        step=step,
        duration=SECONDS,
    )


def timed(simulation: ts.Simulation, steps: int) -> tuple[float, int]:
    """Median CPU time of the last steps [ms], and crossings found after every hundredth step."""
    times, crossings = [], 0
    for i in range(steps):
        begin = time.thread_time()
        simulation.step()
        times.append(1e3 * (time.thread_time() - begin))
        if i % 100 == 0 or i + 1 == steps:
            crossings += len(simulation.crossings())
    return float(np.median(times[-STEPS:])), crossings


def is_borne(method: str, dt: float) -> bool:
    """Whether two cubes end a run with no more energy than they began with, without a crossing."""
    simulation = scene(2, method, ts.SymplecticEuler(dt)).compile()
    start = simulation.energy()["total"]
    _, crossings = timed(simulation, round(SECONDS / dt))
    fall = 2 * 1000.0 * SIDE**3 * 9.81 * APART
    return crossings == 0 and simulation.energy()["total"] < start + 0.01 * fall


def explicit_row(method: str) -> tuple[list[str], float]:
    """A response in explicit steps, and its time with two cubes."""
    found, stable = [], 0.0
    for count in (1, 2, 4):
        trial = scene(count, method, ts.SymplecticEuler()).compile()
        stable = trial.stable_step or 0.0
        simulation = scene(count, method, ts.SymplecticEuler(SHARE * stable)).compile()
        ms, crossings = timed(simulation, round(SECONDS / (SHARE * stable)))
        found.append(ms)
        if crossings:
            raise RuntimeError(f"{method}, {count} cubes: {crossings} crossings")
    held = "" if is_borne(method, HELD * stable) else ", gains energy"
    row = [
        f"{method}, symplectic_euler",
        f"{digits(1e3 * stable)}{held}",
        SEED[method],
        *(digits(ms) for ms in found),
        f"{found[2] / found[1]:.2f}",
    ]
    return row, found[1]


def text() -> str:
    """The table, and what is said of it."""
    rows, two = [], {}
    for method in SEED:
        row, two[method] = explicit_row(method)
        print(row, file=sys.stderr, flush=True)
        rows.append(row)
    implicit = []
    for count in (1, 2, 4):
        simulation = scene(count, "auto", ts.ImplicitEuler("10 ms")).compile()
        implicit.append(timed(simulation, 100)[0])
    rows.append(
        [
            "augmented, implicit_euler",
            "any; 10 here",
            "",
            *(digits(ms) for ms in implicit),
            f"{implicit[2] / implicit[1]:.2f}",
        ]
    )
    head = ["response", "largest dt, ms", "seed's dt, ms", "1 cube, ms", "2 cubes, ms"]
    found = table([*head, "4 cubes, ms", "four over two"], rows)
    least = min(two.values())
    beside = ", ".join(f"{name} {ms / two['penalty']:.2f}" for name, ms in two.items())
    said = f"Two cubes, over `penalty`: {beside}. The fastest takes {digits(least)} ms."
    where = f"{machine_line()} Commit {commit()}, {datetime.date.today()}."
    return "\n\n".join([found, said, where])


def main() -> int:
    """Runs, prints or writes."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--write", action="store_true", help="write docs/measured/contact.md")
    asked = parser.parse_args()
    found = text()
    if asked.write:
        page = PAGE.read_text(encoding="utf-8")
        PAGE.write_text(put(page, "seed", found), encoding="utf-8")
    else:
        print(found)
    return 0


if __name__ == "__main__":
    sys.exit(main())
