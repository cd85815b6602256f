"""A note where cells of first order lock: they hardly bend, for that would change their volume."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tissu.scene.model import LOCKING, MassSpring, MeanDilatation

if TYPE_CHECKING:
    from tissu.compile.prepared import Findings
    from tissu.scene.law import Law
    from tissu.scene.model import Model
    from tissu.scene.problem import Path

_MUCH, _LESS = ("tetra", "wedge"), ("hexahedron", "pyramid")


def note_locking(
    used: list[tuple[str, Law, Model]], quadrature: str, path: Path, findings: Findings
) -> None:
    """Note cells that lock, and what cures them; `used` are cell types with law and model."""
    locking = [
        (cell, law.poisson_at_rest())
        for cell, law, model in used
        if cell in (*_MUCH, *_LESS)
        and not isinstance(model, MassSpring | MeanDilatation)
        and not (quadrature == "reduced" and cell == "hexahedron")
        and law.poisson_at_rest() >= LOCKING
    ]
    if not locking:
        return
    cells = " and ".join(sorted({cell for cell, _ in locking}))
    worst = max(poisson for _, poisson in locking)
    findings.note(
        f"{path[0]}.{path[1]}: with Poisson's ratio {worst:.4g} first-order elements lock "
        f"({cells}): displacements are too small, most in bending; `model: mean_dilatation` cures "
        "it, and quadratic cells do not lock"
    )
