"""Reduced integration: what it leaves without energy, and where that is refused."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING

from tissu import _core
from tissu.counted import counted
from tissu.scene.unknown import Unknown

if TYPE_CHECKING:
    from tissu.compile.prepared import Findings
    from tissu.mesh import Mesh
    from tissu.scene.body import Body
    from tissu.scene.problem import Path
    from tissu.scene.scene import SceneData


def check_quadrature(
    mesh: Mesh, body: Body, scene: SceneData, path: Path, findings: Findings
) -> None:
    """Refuses a rule with modes without energy in a dynamic run, and notes it in a static one."""
    if body.quadrature != "reduced":
        return
    static = False
    with contextlib.suppress(Unknown):
        static = scene.step.type == "static"
    for kind in dict.fromkeys(str(block.type) for block in mesh.body_blocks):
        modes = _core.zero_energy_modes(cell_type=kind, quadrature="reduced")
        if modes == 0:
            continue
        left = f"{counted(modes, 'displacement')} of a {kind} without energy"
        found = f"reduced integration leaves {left}"
        if static:
            findings.note(
                f"{path[0]}.{path[1]}: {found}; they must be held by other cells and supports"
            )
        else:
            text = f"{found}, which grow in a dynamic run; full and over are accepted"
            findings.problem((*path, "quadrature"), text)
