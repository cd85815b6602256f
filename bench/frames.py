"""Prints docs/measured/frames.md, the figures and tables of bosman2014 beside ours.

    python bench/frames.py [--write] [--speed]

With --speed what has no times, figures 8 and 13 and table 1, stays as the page has it.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

import tissu as ts
from tissu.cli.info import machine_line

sys.path.insert(0, str(Path(__file__).resolve().parent))
from frames_text import (
    HEAD,
    NEAR,
    SOFT_TEXT,
    SPEED,
    STATIC_TEXT,
    STEEL_TEXT,
    TENSION,
)

PAGE = Path(__file__).resolve().parents[1] / "docs" / "measured" / "frames.md"
STEEL_TIP, BEAM = 0.150174, 0.147185  # m: converged (CalculiX); rho g L^4 / (8 E I)
NEWTON = ts.Newton(iterations=60, tolerance=1e-8)
SECTIONS = ((25, 2), (25, 3), (25, 4), (25, 6))  # cells along, cells across: figure 6
LENGTHS = ((6, 4), (12, 4), (24, 4), (48, 4))  # figure 7
SOFT = ((10, 1), (20, 2), (32, 3))  # figure 8
POINTS_CPU_GPU = ((360, 34.84, 14.85), (2600, 251.77, 17.11), (12700, 1228.8, 32.29),
                  (34610, 3468.54, 66.1))  # fmt: skip
# Table 2: frames, points, neighbours, its CPU [ms] where the row can be read for sure.
NEIGHBOURS = ((72, 400, 4, 32.65), (72, 400, 6, None), (72, 400, 8, None), (72, 400, 10, 69.56),
              (144, 500, 4, 39.18), (144, 864, 4, 43.42), (144, 1470, 4, 114.3),
              (144, 2340, 4, 160.53),
              (288, 750, 4, 54.49), (500, 750, 4, 56.64), (792, 750, 4, 58.5))  # fmt: skip


def table(head: str, rows: list[str]) -> str:
    """A table of Markdown."""
    return "\n".join([head, "|---" * (head.count("|") - 1) + "|", *rows, ""])


def beam(size: tuple[float, ...], cells: tuple[int, ...], cell: str, **body: Any) -> ts.Scene:
    """A cantilever under its weight."""
    mesh = ts.BarMesh(size=size, cells=cells, cell=cell)
    return ts.Scene(
        bodies={"beam": ts.Body(mesh=mesh, **body)},
        fixed=[ts.Fixed("beam", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        gravity=(0, -9.81, 0),
        step=ts.Static(
            newton=NEWTON, solver=ts.Cholesky(), load_steps=4 if body["density"] < 1 else 1
        ),
    )


def sag(scene: ts.Scene) -> tuple[float, int, float]:
    """Deflection of the end's middle [m], unknowns, seconds."""
    simulation = scene.compile()
    start = time.perf_counter()
    report = simulation.step()
    seconds = time.perf_counter() - start
    if not report.converged:
        return float("nan"), simulation.plan().unknowns, seconds
    points = simulation.meshes["beam"].points
    end = np.isclose(points[:, 0], points[:, 0].max())
    return (
        -float(simulation.displacements("beam")[end, 1].mean()),
        simulation.plan().unknowns,
        seconds,
    )


def steel() -> str:
    """Figures 6 and 7: the steel cantilever of 16 x 0.5 x 0.5 m."""
    body = {"law": ts.StVK(young=200e9, poisson=0.3), "density": 7800.0, "model": "frames"}
    rows = []
    for figure, cases in (("6", SECTIONS), ("7", LENGTHS)):
        for along, across in cases:
            tip, unknowns, seconds = sag(
                beam((16, 0.5, 0.5), (along, across, across), "hexahedron", **body)
            )
            rows.append(
                f"| {figure} | {along + 1} x {across + 1} x {across + 1} | {unknowns} "
                f"| {1e3 * tip:.2f} | {100 * (tip / STEEL_TIP - 1):+.2f} % "
                f"| {100 * (tip / BEAM - 1):+.2f} % | {1e3 * seconds:.0f} |"
            )
    head = "| figure | frames | unknowns | tip [mm] | to the converged | to the formula | ms |"
    return table(head, rows)


def settled(scene: ts.Scene) -> tuple[float, int, float]:
    """As `sag`, where a damped swing comes to rest: far beyond what one static step reaches."""
    body = scene.bodies["beam"].replace(viscosity=ts.Rayleigh(mass=2.0))
    step = ts.ImplicitEuler(dt=0.2, newton=ts.Newton(iterations=15), solver=ts.Cholesky())
    simulation = scene.replace(bodies={"beam": body}, step=step).compile()
    start = time.perf_counter()
    for _ in range(150):
        simulation.step()
    points = simulation.meshes["beam"].points
    end = np.isclose(points[:, 0], points[:, 0].max())
    moving = float(np.abs(simulation.velocities["beam"]).max())
    tip = -float(simulation.displacements("beam")[end, 1].mean()) if moving < 1e-3 else np.nan
    return tip, simulation.plan().unknowns, time.perf_counter() - start


def soft() -> str:
    """Figures 8 and 13: the soft cantilever of 16 x 1 x 1 m, 5 kg, 40 kPa."""
    law, hooke = ts.StVK(young=40e3, poisson=0.3), ts.Hooke(young=40e3, poisson=0.3)
    kinds: dict[str, tuple[str, str, ts.Law]] = {
        "frames, 8 neighbours": ("hexahedron", "frames", law),
        "frames, 4 neighbours": ("tetra", "frames", law),
        "corotational hexahedra": ("hexahedron", "corotational", hooke),
        "corotational tetrahedra": ("tetra", "corotational", hooke),
        "StVK hexahedra": ("hexahedron", "fem", law),
    }
    density = 5.0 / 16.0
    fine, _, _ = sag(beam((16, 1, 1), (48, 3, 3), "hexahedron20", law=law, density=density))
    rows = [f"| quadratic StVK hexahedra, 48 x 3 x 3 cells | | {fine:.3f} | |"]
    for name, (cell, model, of) in kinds.items():
        sizes = [*SOFT, (64, 4)] if cell == "hexahedron" and model != "frames" else SOFT
        for along, across in sizes:
            cells = (along, across, across)
            scene = beam((16, 1, 1), cells, cell, law=of, density=density, model=model)
            tip, unknowns, _ = settled(scene)
            rows.append(
                f"| {name}, {along + 1} x {across + 1} x {across + 1} nodes | {unknowns} "
                f"| {tip:.3f} | {100 * (tip / fine - 1):+.1f} % |"
            )
    return table("| model | unknowns | sag of the end [m] | to the converged |", rows)


def static() -> str:
    """The soft cantilever by static steps: whole and half levers, little and large bending."""
    law, density = ts.StVK(young=40e3, poisson=0.3), 5.0 / 16.0
    rows = []
    for share in (0.01, 0.043, 1.0):
        scenes = {"quadratic StVK hexahedra, 24 x 2 x 2 cells": ((24, 2), "hexahedron20", "fem")}
        for lever in ("whole", "half"):
            model = ts.Frames(lever=lever)  # type: ignore[arg-type]
            for along, across in SOFT:
                name = f"frames, {lever} levers, {along + 1} x {across + 1} x {across + 1} nodes"
                scenes[name] = ((along, across), "hexahedron", model)
        fine = None
        for name, ((along, across), cell, model) in scenes.items():
            scene = beam((16, 1, 1), (along, across, across), cell, law=law, density=density,
                         model=model)  # fmt: skip
            step = ts.Static(newton=NEWTON, solver=ts.Cholesky())
            simulation = scene.replace(step=step, gravity=(0, -9.81 * share, 0)).compile()
            report = simulation.step()
            points = simulation.meshes["beam"].points
            end = np.isclose(points[:, 0], points[:, 0].max())
            tip = -float(simulation.displacements("beam")[end, 1].mean())
            fine = tip if fine is None else fine
            found = f"{tip:.4f} | {100 * (tip / fine - 1):+.1f} %" if report.converged else "none |"
            rows.append(f"| {100 * share:g} % | {name} | {found} | {report.newton_iterations} |")
    head = "| of the weight | model | sag of the end [m] | to the quadratic | Newton iterations |"
    return table(head, rows)


def tension() -> str:
    """Table 1: a cylinder of 6 m and radius 1 m drawn by 3 mm; u_r at the middle."""
    rows = []
    for across, along in ((4, 6), (8, 12), (12, 18), (16, 24)):
        simulation = cylinder(across, along)
        points, moved = simulation.meshes["beam"].points, simulation.displacements("beam")
        middle = np.isclose(points[:, 0], 3.0) & np.isclose(
            np.hypot(points[:, 1], points[:, 2]), 1.0
        )
        outward = points[middle, 1:]
        radial = float((moved[middle, 1:] * outward).sum(axis=1).mean())
        unknowns = simulation.plan().unknowns
        rows.append(
            f"| {across} x {across} x {along} cells | {unknowns} | {1e3 * radial:.5f} "
            f"| {100 * (radial / -1.5e-4 - 1):+.2f} % |"
        )
    return table("| cells | unknowns | u_r [mm] | to -nu eps R = -0.15 mm |", rows)


def cylinder(across: int, along: int) -> ts.Simulation:
    """A round bar of frames: a box of cells with its section drawn to a disc."""
    mesh = ts.bar_mesh(
        size=(6, 2, 2), cells=(along, across, across), cell="hexahedron", origin=(0, -1, -1)
    )
    points = np.array(mesh.points)
    y, z = points[:, 1].copy(), points[:, 2].copy()
    points[:, 1], points[:, 2] = y * np.sqrt(1 - z**2 / 2), z * np.sqrt(1 - y**2 / 2)
    disc = ts.Mesh(points=points, cells=mesh.cells)
    body = ts.Body(mesh=disc, law=ts.StVK(young=1e9, poisson=0.3), density=1000.0, model="frames")
    one = int(np.argmin(np.linalg.norm(points, axis=1)))
    side = int(np.argmin(np.linalg.norm(points - [0, 1, 0], axis=1)))
    simulation = ts.Scene(
        bodies={"beam": body},
        fixed=[
            ts.Fixed("beam", on=ts.Plane((0, 0, 0), (1, 0, 0)), axes="x", rotations="held"),
            ts.Fixed("beam", on=ts.Nodes([one]), axes="yz"),
            ts.Fixed("beam", on=ts.Nodes([side]), axes="z"),
        ],
        prescribed=[
            ts.Prescribed("beam", on=ts.Plane((6, 0, 0), (1, 0, 0)), axes="x", times=(0, 1),
                          displacements=[(0, 0, 0), (0.003, 0, 0)])
        ],
        step=ts.Static(newton=NEWTON, solver=ts.Cholesky()),
    ).compile()  # fmt: skip
    if not simulation.step().converged:
        raise RuntimeError("the cylinder did not converge")
    return simulation


def step_ms(simulation: ts.Simulation) -> float:
    """Median of fifteen steps, after three [ms]."""
    for _ in range(3):
        simulation.step()
    seconds = []
    for _ in range(15):
        start = time.perf_counter()
        simulation.step()
        seconds.append(time.perf_counter() - start)
    return 1e3 * float(np.median(seconds))


def neighbours() -> str:
    """Table 2: a step with 60 iterations against frames, points and neighbours, one thread."""
    rows = []
    for frames, points, near, cpu in NEIGHBOURS:
        simulation = cloud(points, 1, frames, shape="shepard", neighbours=near, sampling="poisson")
        ms = step_ms(simulation)
        found = simulation.tissue["beam"].node_count
        theirs, times = ("", "") if cpu is None else (f"{cpu:g}", f"{cpu / ms:.0f}")
        rows.append(
            f"| {frames} | {points} | {near} | {theirs} | {found} "
            f"| {len(simulation.points('beam'))} | {ms:.2f} | {times} |"
        )
    head = "| frames, paper | points | neighbours | its CPU [ms] | frames | points | ours [ms] "
    return table(f"{head}| times its CPU |", rows)


def speed(threads: int) -> str:
    """Table 3: a step of implicit Euler with 60 iterations."""
    rows = []
    for wanted, cpu, gpu in POINTS_CPU_GPU:
        simulation = cloud(wanted, threads, max(24, wanted // 16))
        points, frames = len(simulation.points("beam")), simulation.tissue["beam"].node_count
        ms = step_ms(simulation)
        same = ms * min(1.0, wanted / points)
        published = f"{wanted} | {cpu:.0f} | {gpu:.1f}"
        times = f"{ms:.2f} | {same:.2f} | {cpu / same:.0f} | {gpu / same:.1f}"
        rows.append(f"| {published} | {points} | {frames} | {times} |")
    head = "| points, paper | its CPU [ms] | its GPU [ms] | points | frames | ours [ms] "
    return table(f"{head}| at the paper's points | times its CPU | times its GPU |", rows)


def cloud(points: int, threads: int, frames: int, **tissue: Any) -> ts.Simulation:
    """A beam of frames without a mesh; four neighbours each where nothing else is said."""
    bar = ts.BarMesh(size=(4, 1, 1), cells=(4, 1, 1), cell="hexahedron")
    given = {"sampling": "grid", "shape": "linear", **tissue}
    on_grid = given["sampling"] == "grid"
    end = ts.Plane((0, 0, 0), (1, 0, 0)) if on_grid else ts.Box((None,) * 3, (0.3, None, None))
    beam = ts.Tissue(
        inside=bar, frames=frames, points=points, tangent="material", density=1000.0,
        law=ts.StVK(young=4e4, poisson=0.3), **given,
    )  # fmt: skip
    solver = ts.ConjugateGradient(tolerance=1e-14, iterations=60)
    return ts.Scene(
        tissue={"beam": beam},
        fixed=[ts.Fixed("beam", on=end)],
        gravity=(0, -9.81, 0),
        step=ts.ImplicitEuler(dt=0.01, solver=solver),
        threads=threads,
    ).compile()


def untimed() -> str:
    """Figures 8 and 13, and table 1: no times in them."""
    if "--speed" not in sys.argv:
        return "\n".join([SOFT_TEXT, soft(), STATIC_TEXT, static(), TENSION, tension()])
    page = PAGE.read_text(encoding="utf-8")
    return page[page.index("\n## Figures 8") : page.index("\n## Table 3")]


def main() -> None:
    """Prints the page, or writes it."""
    timed = [SPEED, speed(2), NEAR, neighbours(), f"Times on this page: {machine_line()}\n"]
    page = "\n".join([HEAD, STEEL_TEXT, steel(), untimed(), *timed])
    if "--write" in sys.argv:
        PAGE.write_text(page, encoding="utf-8")
    else:
        print(page)


if __name__ == "__main__":
    main()
