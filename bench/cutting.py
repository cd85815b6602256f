"""What a cut costs: `python bench/cutting.py [--cuts N] [--peer PYTHON] [--write]`.

Discs that cut about a hundred tetrahedra of a bar of so many, each as the first cut of a world
(`mark`, `rewind`) and then one after the other: time of the cut, of steps before and after, and
their iterations. The same for cells that are divided, for a bar that touches a table and may
touch itself, and for a hundred cells that are removed. PYTHON is one that has rapier3d, whose
cuts of the same bars are timed between ours. Run it on a machine that does nothing else; `--cuts`
takes fewer discs than 20, for a look.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
from kernels import table
from section import MEASURED, put_between

import tissu as ts
from tissu.cli.info import machine_line

SIDES = (6, 12, 20)
"""Cells along the two short sides of a bar that is four times as long."""
SCENES = ("copies", "divided", "in contact", "removed")
CUTS = 20
REMOVED = 100
PEER_CUTS = 8
STEPS = 10


def bar(side: int, scene: str = "copies") -> ts.Simulation:
    """40 x 10 x 10 cm, held at one end, under its weight."""
    gap = "0.5 mm"
    touching: dict[str, Any] = {
        "obstacles": {"table": ts.PlaneObstacle((0, 0, -0.001), (0, 0, 1))},
        "contacts": [ts.Contact(("bar", "table"), gap=gap), ts.SelfContact("bar", gap=gap)],
    }
    body = ts.Body(
        mesh=ts.bar_mesh(size=(0.4, 0.1, 0.1), cells=(4 * side, side, side), cell="tetra"),
        law=ts.StVK(young=5e5, poisson=0.3),
        density=1000,
    )
    return ts.Scene(
        bodies={"bar": body},
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        gravity=(0, 0, -9.81),
        step=ts.ImplicitEuler("10 ms"),
        editing=ts.Editing(method="subdivide", room="400 %") if scene == "divided" else True,
        **(touching if scene == "in contact" else {}),
    ).compile()


def discs(side: int, count: int = CUTS) -> list[ts.Disc]:
    """So wide that they meet some hundred cells, in places and directions of their own."""
    random = np.random.default_rng(3)
    radius = 2.2 * 0.1 / side
    return [
        ts.Disc(
            random.uniform((0.1, 0.03, 0.03), (0.3, 0.07, 0.07)),
            random.standard_normal(3) + np.array([2.0, 0.0, 0.0]),
            radius,
        )
        for _ in range(count)
    ]


def edited(simulation: ts.Simulation, disc: ts.Disc, scene: str) -> tuple[float, int]:
    """Time of the cut by a disc [ms], or of removing the cells nearest to its centre; and cells."""
    if scene != "removed":
        report = simulation.cut("bar", disc)
        return report.milliseconds, report.cells_cut
    mesh = simulation.meshes["bar"]
    away = mesh.points[mesh.cells[0].nodes].mean(axis=1) - np.asarray(disc.center)
    nearest = np.argsort((away**2).sum(axis=1))[:REMOVED]
    gone = simulation.remaining_cells("bar")[nearest]
    begun = time.perf_counter()
    simulation.remove_cells(body="bar", cells=gone)
    return 1e3 * (time.perf_counter() - begun), REMOVED


def stepped(simulation: ts.Simulation) -> tuple[float, float, float]:
    """Time of the first step and median of the next ones [ms], and mean of their iterations."""
    first = simulation.step().milliseconds
    reports = [simulation.step() for _ in range(STEPS)]
    return (
        first,
        float(np.median([report.milliseconds for report in reports])),
        float(np.mean([report.solver_iterations for report in reports])),
    )


def cuts_in_a_row(side: int, scene: str, count: int) -> list[float]:
    """Of all discs in one body, a step after each, without the first one [ms]."""
    simulation, found = bar(side, scene), []
    for disc in discs(side, count):
        try:
            found.append(edited(simulation, disc, scene)[0])
        except ts.ParameterError:  # through walls of an earlier cut that press on each other
            continue
        simulation.step()
    return found[1:]


def blades(side: int) -> list[np.ndarray]:
    """A regular triangle (3, 3) in the place of each disc, with its area [m]."""
    found = []
    for disc in discs(side):
        normal = np.asarray(disc.normal) / np.linalg.norm(disc.normal)
        one = np.cross(normal, (0.0, 0.0, 1.0))
        one /= np.linalg.norm(one)
        other = np.cross(normal, one)
        radius = disc.radius * np.sqrt(np.pi / (0.75 * np.sqrt(3.0)))
        turns = 2.0 * np.pi * np.arange(3)[:, None] / 3.0
        found.append(disc.center + radius * (np.cos(turns) * one + np.sin(turns) * other))
    return found


def ours(side: int, number: int) -> dict[str, float]:
    """One blade in a new body."""
    simulation = bar(side)
    before = [simulation.step().milliseconds for _ in range(5)]
    report = simulation.cut("bar", ts.Triangles(blades(side)[number], [(0, 1, 2)]))
    after = [simulation.step().milliseconds for _ in range(STEPS)]
    return {
        "cut": report.milliseconds,
        "cells": report.cells_cut,
        "step": float(np.median(before)),
        "after": float(np.median(after)),
    }


def rapier(python: str, side: int, number: int) -> dict[str, float]:
    """The same blade in Rapier's soft body."""
    mesh = ts.bar_mesh(size=(0.4, 0.1, 0.1), cells=(4 * side, side, side), cell="tetra")
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder) / "work.npz"
        held = np.flatnonzero(mesh.points[:, 0] < 1e-9)
        np.savez(
            work,
            points=mesh.points,
            tetrahedra=mesh.cells[0].nodes,
            held=held,
            blades=blades(side)[number : number + 1],
        )
        script = str(Path(__file__).parent / "cutting_rapier.py")
        done = subprocess.run(
            [python, script, str(work)], capture_output=True, text=True, check=True
        )
    found: dict[str, float] = json.loads(done.stdout)
    return found


def peer_rows(python: str, side: int) -> list[list[str]]:
    """Both programs in turns, in one run."""
    pairs = [(ours(side, number), rapier(python, side, number)) for number in range(PEER_CUTS)]
    rows = []
    for name, which, cells in (("tissu", 0, "cells"), ("Rapier", 1, "torn")):
        found = [pair[which] for pair in pairs]

        def median(key: str, found: list[dict[str, float]] = found) -> float:
            return float(np.median([one[key] for one in found]))

        rows.append(
            [
                f"{24 * side**3:,}",
                name if which == 0 else f"{name} {pairs[0][1]['version']}",
                f"{median(cells):.0f}",
                f"{median('cut'):.1f}",
                f"{max(one['cut'] for one in found):.1f}",
                f"{median('step'):.1f}",
                f"{median('after'):.1f}",
            ]
        )
    return rows


def peer_section(python: str) -> str:
    """The table beside Rapier."""
    head = ["tetrahedra", "program", "cells", "cut ms, p50", "cut ms, max", "step ms", "after"]
    rows = [row for side in SIDES for row in peer_rows(python, side)]
    return (
        "\n### Beside Rapier\n\n"
        f"{PEER_CUTS} triangles cut the same bars, each a body of its own that has gone five\n"
        "steps. Both programs take turns, on one thread. In tissu the cut lies where the blade\n"
        "went: each side has a copy of a crossed cell with its share of the material. In Rapier\n"
        "the cut follows the faces of cells, whose nodes are doubled, and numbers are in single\n"
        "precision. *cells* are those that the blade crossed.\n\n" + table(head, rows) + "\n"
    )


def row(side: int, scene: str, count: int) -> list[str]:
    """One bar, and so many discs."""
    simulation = bar(side, scene)
    for _ in range(5):
        simulation.step()
    mark = simulation.mark()
    _, before, plain = stepped(simulation)
    cuts, cells, read, first, after, iterations = [], [], [], [], [], []
    later = cuts_in_a_row(side, scene, count)
    for disc in discs(side, count):
        simulation.rewind(mark)
        taken, many = edited(simulation, disc, scene)
        begun = time.perf_counter()
        simulation.surface("bar")
        read.append(1e3 * (time.perf_counter() - begun))
        cuts.append(taken)
        cells.append(many)
        beginning, milliseconds, solved = stepped(simulation)
        first.append(beginning)
        after.append(milliseconds)
        iterations.append(solved)
    return [
        f"{24 * side**3:,}",
        scene,
        f"{np.mean(cells):.0f}",
        f"{np.median(cuts):.1f}",
        f"{np.percentile(cuts, 95):.1f}",
        f"{np.median(later):.1f}",
        f"{np.percentile(later, 95):.1f}",
        f"{np.median(read):.1f}",
        f"{before:.2f}",
        f"{np.median(first):.2f}",
        f"{np.median(after):.2f}",
        f"{plain:.1f}",
        f"{np.mean(iterations):.1f}",
    ]


def section(python: str | None, count: int) -> str:
    """The table and what it says."""
    head = ["tetrahedra", "scene", "cut", "first, p50", "first, p95", "next, p50", "next, p95"]
    head += ["surface ms", "step ms", "first after", "later", "iterations", "after"]
    rows = [row(side, scene, count) for scene in SCENES for side in SIDES]
    return (
        "## The time of a cut\n\n"
        "The table gives the time of a cut, and of the steps after it, for meshes of several\n"
        f"sizes [ms]. A bar of StVK under its weight is cut by {count} discs, with implicit Euler\n"
        "of 10 ms on one thread: each disc as the *first* cut of a new simulation, and then one\n"
        "after the other as the *next* ones. In the scene *copies* the cells are copied, and in\n"
        "*divided* they are divided (`subdivide`). *In contact* is the first scene with a table\n"
        "below the bar, which also may touch itself. Where cells are *removed*, they are the\n"
        f"{REMOVED} nearest to the centre of each disc. The time of a cut includes the report\n"
        "with its pieces, but not reading the surface. The goal is 5 ms for a hundred cells of\n"
        "50,000, and 3 ms where they are removed. The first step after a cut makes a new\n"
        "preconditioner.\n\n"
        + table(head, rows)
        + ("" if python is None else "\n" + peer_section(python).rstrip())
        + f"\n\nPrinted by `python bench/cutting.py --write`; {machine_line()}\n"
    )


def main() -> None:
    """Prints the section, or writes it."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--write", action="store_true", help="to docs/measured/cutting.md")
    parser.add_argument("--cuts", type=int, default=CUTS, help="discs; at least 2")
    parser.add_argument("--peer", metavar="PYTHON", help="a Python that has rapier3d")
    asked = parser.parse_args()
    text = section(asked.peer, asked.cuts)
    if asked.write:
        put_between(MEASURED / "cutting.md", "bench/cutting.py", text)
    else:
        print(text)


if __name__ == "__main__":
    main()
