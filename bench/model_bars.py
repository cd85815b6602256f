"""Prints docs/measured/model-bars.md: bending and torsion of a bar, every model: --write."""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np

import tissu as ts
from tissu.cli.info import machine_line

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "measured" / "model-bars.md"
YOUNG = 1e8  # Pa
NEWTON = ts.Newton(iterations=60, tolerance=1e-9)
HELD = ts.Box((None, None, None), (1e-9, None, None))
END = ts.Box((8 - 1e-9, None, None), (None, None, None))
TETRA = ("fem", "mass-link", "mass-tensor", "corotational", "mass-spring", "condensed")
BENT = ((12, 2, 2), (24, 4, 4), (48, 8, 8))
TURNED = ((12, 2, 2), (24, 4, 4))
STEPS = 12  # of half a turn
HEAD = """# The bar of 8 m with every model

On this page, one bar is bent and twisted with every model. The scenes are those of Faure 2014: E =
100 MPa, static, direct solver, one thread. `fem`, `mass_link` and `mass_tensor` have
St-Venant–Kirchhoff's law and agree to Newton's tolerance. `corotational` has Hooke's law in axes
that turn with each cell, and `condensed` has it in fixed axes. `mass_spring` has its own Poisson's
ratio. Times include the compilation of the scene. Printed by `python bench/model_bars.py --write`.

"""


def bar(cells: tuple[int, int, int], cell: str) -> ts.Mesh:
    """The bar around the x axis, 8 x 1 x 1 m."""
    return ts.bar_mesh(size=(8, 1, 1), cells=cells, cell=cell, origin=(0, -0.5, -0.5))


def body(mesh: ts.Mesh, model: str, poisson: float) -> ts.Body:
    """The bar's material with a model; the law that is its own where it has one."""
    linear = model in ("corotational", "condensed")
    law = (ts.Hooke if linear else ts.StVK)(young=YOUNG, poisson=poisson)
    return ts.Body(mesh=mesh, law=law, density=1000.0, model=model)


def run(scene: ts.Scene) -> tuple[ts.Simulation | None, float, str]:
    """A scene to its end: the simulation, seconds, and why it stopped."""
    begin = time.perf_counter()
    simulation = scene.compile()
    try:
        for report in simulation.run():
            if not report.converged:
                return None, 0.0, "no equilibrium found"
    except ts.Diverged:
        return None, 0.0, "diverged"
    return simulation, time.perf_counter() - begin, ""


def bent_row(model: str, cell: str, cells: tuple[int, int, int]) -> str:
    """Sag under its weight: distance of the axis from the converged one."""
    reference = np.load(ROOT / "tests" / "reference" / "A_bar_nu00_axis.npz")
    mesh = bar(cells, cell)
    scene = ts.Scene(
        bodies={"bar": body(mesh, model, 0.0)},
        fixed=[ts.Fixed("bar", on=HELD)],
        gravity=(0.0, -9.81, 0.0),
        step=ts.Static(solver=ts.Cholesky(), newton=NEWTON),
    )
    simulation, seconds, why = run(scene)
    size = "x".join(map(str, cells))
    if simulation is None:
        return f"| {model} | {cell} {size} | {why} | | | |"
    axis = np.flatnonzero(np.abs(mesh.points[:, 1:]).max(axis=1) < 1e-9)
    nodes, stations = np.nonzero(np.abs(mesh.points[axis, 0][:, None] - reference["x"]) < 1e-9)
    moved = simulation.displacements("bar")[axis[nodes]]
    off = np.linalg.norm(moved - reference["axis_stvk"][stations], axis=1)
    tip = moved[np.argmax(stations), 1]
    return (
        f"| {model} | {cell} {size} | {tip:.4f} | {1e3 * off.mean():.2f} | {1e3 * off.max():.2f} "
        f"| {1e3 * seconds:.0f} |"
    )


def turned(
    model: str, cell: str, cells: tuple[int, int, int]
) -> tuple[ts.Mesh, object, float, str]:
    """Half a turn of the end in twelve steps: mesh, displacements, moment [MN m], why not."""
    mesh = bar(cells, cell)
    times = [float(t) for t in range(STEPS + 1)]
    turn = ts.Rotation(axis=(1, 0, 0), center=(0, 0, 0), angles=[np.pi * t / STEPS for t in times])
    scene = ts.Scene(
        bodies={"bar": body(mesh, model, 0.3)},
        fixed=[ts.Fixed("bar", on=HELD)],
        prescribed=[ts.Prescribed("bar", on=END, times=times, rotation=turn)],
        step=ts.Static(solver=ts.Cholesky(), newton=NEWTON),
        duration=STEPS,
    )
    simulation, _, why = run(scene)
    if simulation is None:
        return mesh, None, 0.0, why
    held = mesh.points[:, 0] > 8 - 1e-9
    forces = simulation.reactions("bar")[held]
    moment = np.cross(simulation.positions["bar"][held], forces)[:, 0].sum()
    return mesh, np.array(simulation.displacements("bar")), float(moment) / 1e6, ""


def turned_rows() -> list[str]:
    """Every model against hexahedra of second order, 24 x 4 x 4."""
    rich, wanted, moment, why = turned("fem", "hexahedron20", (24, 4, 4))
    assert isinstance(wanted, np.ndarray), why
    place = {tuple(key): n for n, key in enumerate(np.rint(rich.points * 1e6).astype(int))}
    rows = [f"| fem | hexahedron20 24x4x4 | {moment:.3f} | (the measure of the others) | |"]
    cases = [("fem", "hexahedron"), ("corotational", "hexahedron"), *((m, "tetra") for m in TETRA)]
    for model, cell in cases:
        for cells in TURNED:
            mesh, moved, found, why = turned(model, cell, cells)
            size = "x".join(map(str, cells))
            if not isinstance(moved, np.ndarray):
                rows.append(f"| {model} | {cell} {size} | {why} | | |")
                continue
            at = [place[tuple(key)] for key in np.rint(mesh.points * 1e6).astype(int)]
            off = np.linalg.norm(moved - wanted[at], axis=1)
            rows.append(
                f"| {model} | {cell} {size} | {found:.3f} | {1e3 * off.mean():.1f} "
                f"| {1e3 * off.max():.1f} |"
            )
    return rows


def page() -> str:
    """The whole page."""
    bent = [
        "## Bending under its own weight, nu = 0",
        "",
        "Errors are the distance of the axis from the converged solution of St-Venant–Kirchhoff",
        "(CalculiX, `tests/reference`), whose tip sinks by 0.6076 m.",
        "",
        "| model | cells | tip [m] | mean error [mm] | largest [mm] | time [ms] |",
        "|---|---|---|---|---|---|",
    ]
    for model, cell in (
        *(("fem", "hexahedron"), ("corotational", "hexahedron")),
        *((model, "tetra") for model in TETRA),
    ):
        bent += [bent_row(model, cell, cells) for cells in BENT]
    twisted = [
        "",
        "## Half a turn of the end, nu = 0.3",
        "",
        "Errors are the distance of the nodes from those of second-order hexahedra. The table also",
        "gives the moment.",
        "",
        "| model | cells | moment [MN m] | mean error [mm] | largest [mm] |",
        "|---|---|---|---|---|",
        *turned_rows(),
        "",
        f"Times on this page: {machine_line()}",
    ]
    return HEAD + "\n".join(bent + twisted) + "\n"


if __name__ == "__main__":
    if "--write" in sys.argv[1:]:
        PAGE.write_text(page(), encoding="utf-8")
    else:
        print(page())
