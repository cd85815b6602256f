"""The measured phantom: a silicone cantilever that bends under its own weight.

    python bench/phantom.py --meshes FOLDER [--picture docs/pictures/phantom.png]

FOLDER holds `cylinder_Hexa.msh` (the rest mesh) and `truthCylinder-Deformed.obj` (the same phantom
as measured after bending), both from SOFA's repository, examples/Benchmark/Accuracy/mesh. Material
values of SOFA's scene: E = 60 kPa, nu = 0.49, 0.216 kg, gravity 9.8 m/s^2 along -y, nodes with
|z| < 1 mm held. Prints, for each element and law, how far the computed end point and surface are
from the measured ones, and draws both surfaces.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import tissu as ts

Floats = NDArray[np.float64]
MEASURED_END = np.array([0.0, -0.119383, 0.126842])  # m
REST_END = np.array([0.0, 0.0, 0.178])


def scene_of(mesh: ts.Mesh, law: str, quadrature: str = "full", poisson: float = 0.49) -> ts.Scene:
    """The phantom held at its root and left to its weight, as a static scene."""
    material = {"hooke": ts.Hooke, "stvk": ts.StVK}[law](young=60e3, poisson=poisson)
    body = ts.Body(mesh=mesh, law=material, mass=0.216, quadrature=quadrature)
    held = ts.Fixed("phantom", on=ts.Box((None, None, -1e-3), (None, None, 1e-3)))
    newton = ts.Newton(iterations=40, tolerance=1e-8)
    return ts.Scene(
        bodies={"phantom": body},
        fixed=[held],
        gravity=(0.0, -9.8, 0.0),
        step=ts.Static(newton=newton, solver=ts.Cholesky()),
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
    mesh: ts.Mesh, measured: Floats, law: str, quadrature: str
) -> tuple[ts.Simulation, dict[str, float]]:
    """One computation and its distances to the measurement [mm]."""
    begin = time.perf_counter()
    simulation = scene_of(mesh, law, quadrature).compile()
    report = simulation.step()
    seconds = time.perf_counter() - begin
    if not report.converged:
        raise SystemExit(f"{law}: {report}")
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


def main() -> None:
    """Prints the table and draws the picture."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--meshes", type=Path, required=True)
    parser.add_argument("--picture", type=Path)
    asked = parser.parse_args()
    hexahedra = ts.read_mesh(asked.meshes / "cylinder_Hexa.msh", unit="m")
    truth = ts.read_mesh(asked.meshes / "truthCylinder-Deformed.obj", unit="m")
    meshes = {"hexahedron 8": hexahedra, "tetrahedron 4": ts.into_tetrahedra(hexahedra)}
    print(
        "| element | cells | quadrature | law | end y [mm] | end z [mm] "
        "| off the measured end [mm] | surface, mean [mm] | surface, max [mm] | Newton |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|")
    for element, mesh in meshes.items():
        for quadrature in ("full", "over") if element.startswith("hexa") else ("full",):
            for law in ("hooke", "stvk"):
                simulation, row = run(mesh, truth.points, law, quadrature)
                print(
                    f"| {element} | {mesh.cell_count} | {quadrature} | {law} | {row['end_y']:.1f} "
                    f"| {row['end_z']:.1f} | {row['end']:.1f} | {row['mean']:.1f} "
                    f"| {row['max']:.1f} | {row['newton']} |",
                    flush=True,
                )
                if asked.picture and element.startswith("hexa") and law == "stvk":
                    draw(asked.picture, mesh, simulation, truth)
    print(f"\nmeasured end: y {1e3 * MEASURED_END[1]:.1f} mm, z {1e3 * MEASURED_END[2]:.1f} mm")


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
