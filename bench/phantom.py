"""The measured phantom: a silicone cantilever that bends under its own weight.

    python bench/phantom.py --meshes FOLDER [--picture docs/pictures/phantom.png] [--only ELEMENT]
        [--model fem|mean-dilatation] [--laws LAW ...]

FOLDER holds `cylinder_Hexa.msh` (the rest mesh) and `truthCylinder-Deformed.obj` (the same phantom
as measured after bending), both from SOFA's repository, examples/Benchmark/Accuracy/mesh. Material
values of SOFA's scene: E = 60 kPa, nu = 0.49, 0.216 kg, gravity 9.8 m/s^2 along -y, nodes with
|z| < 1 mm held. Prints, for each element and law, how far the computed end point and surface are
from the measured ones, and draws both surfaces.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import tissu as ts

Floats = NDArray[np.float64]
MEASURED_END = np.array([0.0, -0.119383, 0.126842])  # m
REST_END = np.array([0.0, 0.0, 0.178])


YOUNG = 60e3  # Pa
LAWS = ("hooke", "stvk", "neo_hooke", "stable_neo_hooke", "mooney_rivlin", "yeoh", "arruda_boyce")


def material(law: str, poisson: float) -> ts.Law:
    """A law with the phantom's moduli at rest, whatever its own parameters are."""
    mu, kappa = YOUNG / (2 * (1 + poisson)), YOUNG / (3 * (1 - 2 * poisson))
    if law == "mooney_rivlin":
        return ts.MooneyRivlin(c1=0.4 * mu, c2=0.1 * mu, kappa=kappa)
    if law == "yeoh":
        return ts.Yeoh(c1=mu / 2, kappa=kappa)
    if law == "arruda_boyce":
        series = (1, 3 / 5, 99 / 175, 513 / 875, 42039 / 67375)  # shear modulus at rest over mu
        lambda_m = 2.0
        scale = sum(c / lambda_m ** (2 * i) for i, c in enumerate(series))
        return ts.ArrudaBoyce(mu=mu / scale, lambda_m=lambda_m, kappa=kappa)
    named = {
        "hooke": ts.Hooke,
        "stvk": ts.StVK,
        "neo_hooke": ts.NeoHooke,
        "stable_neo_hooke": ts.StableNeoHooke,
    }
    return named[law](young=YOUNG, poisson=poisson)


def scene_of(
    mesh: ts.Mesh,
    law: str,
    quadrature: str = "full",
    poisson: float = 0.49,
    load_steps: int = 1,
    model: str = "fem",
) -> ts.Scene:
    """The phantom held at its root and left to its weight, as a static scene."""
    body = ts.Body(
        mesh=mesh, law=material(law, poisson), mass=0.216, quadrature=quadrature, model=model
    )
    held = ts.Fixed("phantom", on=ts.Box((None, None, -1e-3), (None, None, 1e-3)))
    newton = ts.Newton(iterations=40, tolerance=1e-8)
    return ts.Scene(
        bodies={"phantom": body},
        fixed=[held],
        gravity=(0.0, -9.8, 0.0),
        step=ts.Static(newton=newton, solver=ts.Cholesky(), load_steps=load_steps),
    )


def end_point(mesh: ts.Mesh, displacements: Floats) -> Floats:
    """Where the centre of the free end goes (3,) [m]: the mean of the nodes around it."""
    distance = np.linalg.norm(mesh.points - REST_END, axis=1)
    near = np.argsort(distance)[:1]
    return np.asarray(REST_END + displacements[near].mean(axis=0))


def distance_to_surface(points: Floats, corners: Floats) -> Floats:
    """Distance (n,) of each point (n, 3) to the nearest of the triangles (t, 3, 3) [m]."""
    return np.array([_distance_to_triangles(point, corners).min() for point in points])


def _distance_to_triangles(p: Floats, corners: Floats) -> Floats:
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    height = np.einsum("ij,ij->i", p - a, normal)
    foot = p - height[:, None] * normal
    inside = np.ones(len(a), dtype=bool)
    edge_distance = np.full(len(a), np.inf)
    for start, end in ((a, b), (b, c), (c, a)):
        edge = end - start
        inside &= np.einsum("ij,ij->i", np.cross(edge, foot - start), normal) >= 0
        share = np.einsum("ij,ij->i", p - start, edge) / np.einsum("ij,ij->i", edge, edge)
        nearest = start + np.clip(share, 0.0, 1.0)[:, None] * edge
        edge_distance = np.minimum(edge_distance, np.linalg.norm(p - nearest, axis=1))
    return np.where(inside, np.abs(height), edge_distance)


def run(
    mesh: ts.Mesh, measured: Floats, law: str, quadrature: str, load_steps: int, model: str
) -> tuple[ts.Simulation, dict[str, float] | None]:
    """One computation and its distances to the measurement [mm]; None without an equilibrium."""
    begin = time.perf_counter()
    simulation = scene_of(mesh, law, quadrature, load_steps=load_steps, model=model).compile()
    report = simulation.step()
    seconds = time.perf_counter() - begin
    if not report.converged:
        print(f"{law}: {report}", file=sys.stderr)
        return simulation, None
    end = end_point(mesh, simulation.displacements("phantom"))
    surface = simulation.positions["phantom"][mesh.surface().triangles]
    gaps = distance_to_surface(measured, surface)
    return simulation, {
        "end_y": 1e3 * end[1],
        "end_z": 1e3 * end[2],
        "end": 1e3 * float(np.linalg.norm(end - MEASURED_END)),
        "mean": 1e3 * float(gaps.mean()),
        "max": 1e3 * float(gaps.max()),
        "newton": report.newton_iterations,
        "seconds": seconds,
    }


def _mesh(points: Floats, cell: str, nodes: NDArray[np.int64]) -> ts.Mesh:
    return ts.Mesh(points=points, cells=(ts.CellBlock(cell, nodes.astype(np.int32)),))


def into_pyramids(mesh: ts.Mesh) -> ts.Mesh:
    """Each hexahedron as six pyramids around its centre."""
    hexahedra = mesh.volume_blocks[0].nodes
    faces = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    centres = mesh.points[hexahedra].mean(axis=1)
    apex = len(mesh.points) + np.arange(len(hexahedra))
    cells = np.concatenate([np.column_stack([hexahedra[:, f[::-1]], apex]) for f in faces])
    return _mesh(np.vstack([mesh.points, centres]), "pyramid", cells)


def into_wedges(mesh: ts.Mesh) -> ts.Mesh:
    """Each hexahedron as two wedges along the cylinder's axis; layers choose the same diagonal."""
    halves = []
    for cell in mesh.volume_blocks[0].nodes:
        order = _along_axis(mesh.points[cell])
        bottom, top = cell[order[:4]], cell[order[4:]]
        first = int(np.lexsort(np.round(mesh.points[bottom][:, 1::-1].T, 9))[0])
        b, t = np.roll(bottom, -first), np.roll(top, -first)
        halves += [[b[0], b[1], b[2], t[0], t[1], t[2]], [b[0], b[2], b[3], t[0], t[2], t[3]]]
    return _mesh(mesh.points, "wedge", np.array(halves))


def _along_axis(corners: Floats) -> list[int]:
    """The corners of a hexahedron renumbered so that its first face is the lower one in z."""
    turns = ([0, 1, 2, 3, 4, 5, 6, 7], [0, 3, 7, 4, 1, 2, 6, 5], [0, 4, 5, 1, 3, 7, 6, 2])
    flips = [[*turn[4:], *turn[:4]] for turn in turns]
    mirrored = [[f[i] for i in (0, 3, 2, 1, 4, 7, 6, 5)] for f in flips]
    heights = [corners[o[4:], 2].mean() - corners[o[:4], 2].mean() for o in (*turns, *mirrored)]
    return [*turns, *mirrored][int(np.argmax(heights))]


def meshes_of(hexahedra: ts.Mesh) -> dict[str, ts.Mesh]:
    """The phantom in every volume element there is."""
    first = {
        "hexahedron": hexahedra,
        "tetra": ts.into_tetrahedra(hexahedra),
        "wedge": into_wedges(hexahedra),
        "pyramid": into_pyramids(hexahedra),
    }
    second = {
        "hexahedron20": ts.into_quadratic(hexahedra),
        "hexahedron27": ts.into_quadratic(hexahedra, centres=True),
        "tetra10": ts.into_quadratic(first["tetra"]),
        "wedge15": ts.into_quadratic(first["wedge"]),
        "pyramid13": ts.into_quadratic(first["pyramid"]),
    }
    return first | second


def rows_of(element: str, laws: list[str] | None) -> list[tuple[str, str, str]]:
    """Law, quadrature and model of each row of an element."""
    few = ("stvk", "neo_hooke")
    first_order = element in ("hexahedron", "tetra", "wedge", "pyramid")
    rows = [
        (law, quadrature, "fem")
        for law in laws or (LAWS if element in ("hexahedron", "tetra") else few)
        for quadrature in (("full", "over") if element == "hexahedron" else ("full",))
    ]
    return rows + [(law, "full", "mean-dilatation") for law in laws or few if first_order]


def main() -> None:
    """Prints the table and draws the picture."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--meshes", type=Path, required=True)
    parser.add_argument("--picture", type=Path)
    parser.add_argument("--only", help="one element")
    parser.add_argument("--model", help="one model: fem or mean-dilatation")
    parser.add_argument("--laws", nargs="*", help="laws, in place of those that the table has")
    parser.add_argument("--load-steps", type=int, default=1, help="parts the weight is put on in")
    asked = parser.parse_args()
    hexahedra = ts.read_mesh(asked.meshes / "cylinder_Hexa.msh", unit="m")
    truth = ts.read_mesh(asked.meshes / "truthCylinder-Deformed.obj", unit="m")
    print(
        "| element | cells | nodes | model | quadrature | law | end y [mm] | end z [mm] "
        "| off the measured end [mm] | surface, mean [mm] | surface, max [mm] | Newton | s |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|---|---|---|")
    for element, mesh in meshes_of(hexahedra).items():
        if asked.only not in (None, element):
            continue
        for law, quadrature, model in rows_of(element, asked.laws):
            if asked.model not in (None, model):
                continue
            simulation, row = run(mesh, truth.points, law, quadrature, asked.load_steps, model)
            name = f"{element} | {mesh.cell_count} | {mesh.node_count} | {model} | {quadrature}"
            print(f"| {name} | {law} {numbers(row)}", flush=True)
            if row and asked.picture and (element, law, model) == ("hexahedron", "stvk", "fem"):
                draw(asked.picture, mesh, simulation, truth)
    print(f"\nmeasured end: y {1e3 * MEASURED_END[1]:.1f} mm, z {1e3 * MEASURED_END[2]:.1f} mm")


def numbers(row: dict[str, float] | None) -> str:
    """The rest of a table's row."""
    if row is None:
        return "| none found |"
    return (
        f"| {row['end_y']:.1f} | {row['end_z']:.1f} | {row['end']:.1f} "
        f"| {row['mean']:.1f} | {row['max']:.1f} | {row['newton']} | {row['seconds']:.0f} |"
    )


def draw(path: Path, mesh: ts.Mesh, simulation: ts.Simulation, truth: ts.Mesh) -> None:
    """Rest, computed and measured surface in one picture."""
    computed = simulation.positions["phantom"]
    ts.draw_overlay(
        path,
        [
            (mesh.points, mesh.surface().triangles, "lightgrey", "at rest"),
            (computed, mesh.surface().triangles, "steelblue", "computed, StVK"),
            (truth.points, truth.surface().triangles, "darkorange", "measured"),
        ],
        up=(0.0, 1.0, 0.0),
        title="Silicone cantilever under its own weight",
    )


if __name__ == "__main__":
    main()
