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


def main(names: list[str]) -> None:
    """Runs each and writes NAME.npz."""
    for name in names or RICHEST:
        simulation = changed(HERE / f"{name}.yaml", RICHEST[name]).compile()
        for report in simulation.run():
            assert report.converged, report
        (body,) = simulation.bodies
        points = np.asarray(simulation.meshes[body].points)
        np.savez_compressed(
            HERE / f"{name}.npz", points=points, displacements=simulation.displacements(body)
        )
        print(name, len(points), "points", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
