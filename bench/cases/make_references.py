"""Makes the references that are our own: python bench/cases/make_references.py [NAME …].

Each is the richest run of its scene that takes minutes; the others come from tests/reference.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np

from tissu.accuracy.change import changed

HERE = Path(__file__).parent
NEWTON = {"iterations": 60, "tolerance": 1e-9}
QUADRATIC = {"bodies.bar.mesh.cell": "hexahedron20", "bodies.bar.quadrature": "reduced"}
RICHEST: dict[str, dict[str, Any]] = {
    "soft_bar": {
        **QUADRATIC,
        "bodies.bar.mesh.cells": [64, 4, 4],
        "bodies.bar.viscosity": None,
        "step": {
            "type": "static",
            "load_steps": 8,
            "solver": {"type": "cholesky"},
            "newton": NEWTON,
        },
    },
    "strip": {"bodies.strip.mesh.cells": [80, 1, 1], "step.newton": NEWTON},
    "soft_cube": {"bodies.cube.mesh.cell": "hexahedron20", "bodies.cube.mesh.cells": [4, 4, 4]},
    "cook": {
        "bodies.membrane.mesh.file": "cook_32.vtu",
        "bodies.membrane.model": "mean-dilatation",
    },
    "floppy": {
        "step": {
            "type": "implicit_midpoint",
            "dt": 0.25e-3,
            "newton": NEWTON,
            "solver": {"type": "conjugate_gradient", "tolerance": 1e-10, "iterations": 2000},
        }
    },
    "sofa_beam": {
        "step": {
            "type": "implicit_midpoint",
            "dt": 1e-3,
            "newton": NEWTON,
            "solver": {
                "type": "conjugate_gradient",
                "tolerance": 1e-10,
                "iterations": 2000,
                "preconditioner": "incomplete_cholesky",
            },
        }
    },
    "cantilever": {**QUADRATIC, "bodies.bar.mesh.cells": [40, 8, 8], "step.newton": NEWTON},
    "torsion": {"bodies.bar.mesh.cell": "hexahedron20"},
    "cube_steps": {"step": {"type": "rk4", "dt": 0.25e-3}},
    "swing": {
        "step": {
            "type": "implicit_midpoint",
            "dt": 0.5e-3,
            "newton": NEWTON,
            "solver": {"type": "conjugate_gradient", "tolerance": 1e-10, "iterations": 2000},
        }
    },
}
"""what is changed in the scene"""
EDGE = ("soft_bar", "strip")
"""cases that are compared along the edge of a box, where meshes of every section have nodes"""


def sag_of_a_beam() -> None:
    """What Faure 2014 measures against, eq. 5.3 as it should stand, into bar.npz."""
    with np.load(HERE / "bar.npz") as file:
        arrays = dict(file)
    x, length, height, young, weight = arrays["x"], 8.0, 1.0, 1e8, 1000.0 * 9.81
    down = 6 * length**2 * x**2 - 4 * length * x**3 + x**4
    arrays["euler_bernoulli"] = np.zeros((len(x), 3))
    arrays["euler_bernoulli"][:, 1] = -weight / (2 * young * height**2) * down
    np.savez_compressed(HERE / "bar.npz", **arrays)


def circle() -> None:
    """The strip rolled into a full circle, into rolled.npz: curvature 2 pi / L, its length kept."""
    points = np.asarray(changed(HERE / "rolled.yaml", {}).compile().meshes["strip"].points)
    radius = 10.0 / (2.0 * np.pi)
    moved = np.zeros_like(points)
    moved[:, 0] = radius * np.sin(points[:, 0] / radius) - points[:, 0]
    moved[:, 2] = radius * (1.0 - np.cos(points[:, 0] / radius))
    np.savez_compressed(HERE / "rolled.npz", points=points, displacements=moved)


def main(names: list[str]) -> None:
    """Runs each and writes NAME.npz."""
    for name in [name for name in names or RICHEST if name in RICHEST]:
        simulation = changed(HERE / f"{name}.yaml", RICHEST[name]).compile()
        for report in simulation.run():
            assert report.converged, report
        (body,) = simulation.bodies
        points = np.asarray(simulation.meshes[body].points)
        moved = simulation.displacements(body)
        arrays: dict[str, Any] = {"points": points, "displacements": moved}
        if name in EDGE:
            edge = np.flatnonzero((points[:, 1:] == points[0, 1:]).all(axis=1))
            edge = edge[np.argsort(points[edge, 0])]
            arrays = {"x": points[edge, 0], "displacements": moved[edge]}
        np.savez_compressed(HERE / f"{name}.npz", **arrays)
        print(name, len(points), "points", flush=True)
    if not names or "bar" in names:
        sag_of_a_beam()
    if not names or "rolled" in names:
        circle()


if __name__ == "__main__":
    main(sys.argv[1:])
