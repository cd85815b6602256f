"""What cuts keep, by copies of cells and by divided cells: `python bench/carriers.py [--write]`.

Planes in random directions cut a bar of tetrahedra whose nodes move at random, once from each
state. No time is measured.
"""

from __future__ import annotations

import argparse
from itertools import combinations
from typing import Any

import numpy as np
from kernels import table
from section import MEASURED, put_between

import tissu as ts
from tissu.cli.info import machine_line

CUTS = 60
SIZE = np.array((0.4, 0.1, 0.1))
CELLS = np.array((12, 4, 4))
PAIRS = tuple(combinations(range(4), 2))

Array = np.ndarray[Any, Any]


def mesh() -> ts.Mesh:
    """A bar whose inner nodes are moved by up to an eighth of a cell."""
    made = ts.bar_mesh(size=tuple(SIZE), cells=tuple(int(n) for n in CELLS), cell="tetra")
    points = np.array(made.points)
    inner = ((points > 1e-9) & (points < SIZE - 1e-9)).all(axis=1)
    random = np.random.default_rng(1)
    points[inner] += SIZE / CELLS / 8 * random.uniform(-1, 1, (int(inner.sum()), 3))
    return ts.Mesh(points=points, cells=made.cells)


def simulation(method: str) -> ts.Simulation:
    """The bar, deformed and moving, each node in its own way."""
    body = ts.Body(mesh=mesh(), law=ts.StableNeoHooke(young=5e4, poisson=0.3), density=1000)
    made = ts.Scene(
        bodies={"bar": body},
        step=ts.SymplecticEuler(dt="auto"),
        editing=ts.Editing(method=method, room="300 %"),
    ).compile()
    random = np.random.default_rng(2)
    places = made.positions["bar"]
    places += 1e-3 * random.standard_normal(places.shape)
    made.velocities["bar"][:] = random.standard_normal(places.shape)
    return made


def quality(made: ts.Simulation) -> float:
    """The smallest 6 sqrt(2) V / l_rms^3 of the cells at rest."""
    points = made.meshes["bar"].points
    cells = np.concatenate([block.nodes for block in made.meshes["bar"].body_blocks])
    edges = points[cells[:, 1:]] - points[cells[:, :1]]
    squares = sum(((points[cells[:, a]] - points[cells[:, b]]) ** 2).sum(axis=1) for a, b in PAIRS)
    return float((np.sqrt(2) * np.linalg.det(edges) / (squares / 6) ** 1.5).min())


def row(method: str) -> list[str]:
    """One carrier."""
    made = simulation(method)
    mark, random = made.mark(), np.random.default_rng(3)
    before, elastic, step = made._core.totals("bar"), made.energy()["elastic"], made.stable_step
    scale = before["mass"] * np.abs(made.velocities["bar"]).max()
    volume = momentum = turned = lost = jump = 0.0
    least, steps, gone, born, left = 1.0, [], 0, 0, 0
    for _ in range(CUTS):
        point = random.uniform(0.2, 0.8, 3) * SIZE
        report = made.cut("bar", ts.Plane(point, random.standard_normal(3)))
        after = made._core.totals("bar")
        volume = max(volume, abs(after["volume"] / before["volume"] - 1.0))
        momentum = max(momentum, float(np.linalg.norm(report.momentum_change)) / scale)
        angular = float(np.linalg.norm(report.angular_momentum_change))
        turned = max(turned, angular / (scale * 0.4))
        lost = max(lost, 1.0 - after["kinetic"] / before["kinetic"])
        jump = max(jump, abs(made.energy()["elastic"] / elastic - 1.0))
        least = min(least, quality(made))
        steps.append(made.stable_step / step)
        gone += report.cells_gone
        born += report.cells_new
        left += len(report.unresolved)
        made.rewind(mark)
    return [
        method,
        f"{volume:.0e}",
        f"{momentum:.0e}",
        f"{turned:.0e}",
        f"{100 * lost:.2g} %" if lost > 1e-12 else f"{lost:.0e}",
        f"{jump:.0e}",
        f"{least:.2f}",
        f"{np.median(steps):.2f}, {min(steps):.2f}",
        f"{born / gone:.1f}",
        str(left),
    ]


def section() -> str:
    """The table and what it says."""
    head = ["method", "volume", "momentum", "angular", "kinetic", "elastic", "least q"]
    head += ["stable step", "cells per cut cell", "left"]
    cells = 6 * int(np.prod(CELLS))
    return (
        "## What a cut keeps\n\n"
        f"The table compares the two methods of `editing`. {CUTS} random planes cut a jittered\n"
        f"bar of {cells:,} tetrahedra, each from the same state, in which every node moves on its\n"
        "own. Entries are the largest change over all cuts. The change of momentum is relative to\n"
        "the mass times the largest speed, the change of angular momentum to 40 cm times that,\n"
        "and the others to the value before the cut. Kinetic energy is only lost, never gained.\n"
        "The least quality q is that of the cells that compute forces; a regular tetrahedron has\n"
        "1. The stable step of symplectic Euler is relative to the one before the cut: median and\n"
        "least. Cells `left` were met by the blade but not cut.\n\n"
        + table(head, [row(method) for method in ("virtual", "subdivide")])
        + f"\n\nPrinted by `python bench/carriers.py --write`; {machine_line()}\n"
    )


def main() -> None:
    """Prints the section, or writes it."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--write", action="store_true", help="to docs/measured/cutting.md")
    text = section()
    if parser.parse_args().write:
        put_between(MEASURED / "cutting.md", "bench/carriers.py", text)
    else:
        print(text)


if __name__ == "__main__":
    main()
