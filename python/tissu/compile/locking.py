"""A note where cells of first order lock: they hardly bend, for that would change their volume."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tissu.scene.model import MassSpring, MeanDilatation

if TYPE_CHECKING:
    from tissu.compile.prepared import Findings
    from tissu.scene.law import Law
    from tissu.scene.model import Model
    from tissu.scene.problem import Path

_LOCKING = 0.45
"""Poisson's ratio from which on it is noted: there a bar of three or four layers of tetrahedra or
wedges bends by 27 to 37 % less than the same cells with mean dilatation, one of hexahedra or
pyramids by 9 to 15 % less; at 0.4 by 17 to 24 and by 5 to 9 %, at 0.49 by 60 to 70 and 25 to 40 %
(docs/mean-dilatation.md)."""
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
        and law.poisson_at_rest() >= _LOCKING
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
