"""A real liver, held at its ligament side and left to gravity until it rests.

    python bench/liver.py --meshes FOLDER [--picture FILE.png]

FOLDER holds `liver.msh` (Gmsh 1, centimetres, 596 tetrahedra) from SOFA's repository, share/mesh.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

import tissu as ts


def scene_of(mesh: ts.Mesh) -> ts.Scene:
    """Parenchyma of 1 kPa, the top 5 mm held, gravity downwards."""
    top = float(mesh.bounds[1, 1])
    liver = ts.Body(
        mesh=mesh,
        law=ts.StVK(young="1 kPa", poisson=0.45),
        density="1.06 g/cm^3",
        viscosity=ts.Rayleigh(mass="1 1/s", stiffness="20 ms"),
    )
    return ts.Scene(
        name="liver",
        bodies={"liver": liver},
        fixed=[ts.Fixed("liver", on=ts.Box((None, top - 5e-3, None), (None, None, None)))],
        gravity=(0.0, -9.81, 0.0),
        step=ts.ImplicitEuler("10 ms"),
        duration="3 s",
    )


def main() -> None:
    """Runs it, says when it rests and how far it sank, and draws it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--meshes", type=Path, required=True)
    parser.add_argument("--picture", type=Path)
    asked = parser.parse_args()
    simulation = scene_of(ts.read_mesh(asked.meshes / "liver.msh", unit="cm")).compile()
    print(simulation.plan())
    for report in simulation.run():
        if not report.converged:
            print(report)
    speed = np.linalg.norm(simulation.velocities["liver"], axis=1).max()
    sag = np.linalg.norm(simulation.displacements("liver"), axis=1).max()
    ratio = simulation.cell_fields("liver")["volume_ratio"]
    print(
        f"after {simulation.time:.1f} s: sunk by up to {1e3 * sag:.1f} mm, fastest node "
        f"{1e3 * speed:.1e} mm/s, volume ratio {ratio.min():.2f} to {ratio.max():.2f}"
    )
    print(simulation.profile())
    if asked.picture:
        ts.draw(simulation, asked.picture)


if __name__ == "__main__":
    main()
