"""What a viscosity asks of its body's cells, models and step."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import TYPE_CHECKING

from tissu.counted import counted
from tissu.mesh.cell import dimension
from tissu.scene.unknown import Unknown
from tissu.scene.viscosity import Prony

if TYPE_CHECKING:
    from tissu.compile.prepared import Findings
    from tissu.mesh import Mesh
    from tissu.scene.body import Body
    from tissu.scene.problem import Path
    from tissu.scene.scene import SceneData


def check_viscosity(
    mesh: Mesh, body: Body, scene: SceneData, path: Path, findings: Findings
) -> None:
    """Refuses a viscosity of cells in a condensed region; Prony in a static step, and on sheets."""
    viscosity, place = body.viscosity, (*path, "viscosity")
    if viscosity is None or viscosity.type == "rayleigh":
        return
    with contextlib.suppress(Unknown):
        if any(model.type == "condensed" for model in body.models().values()):
            text = f"found {viscosity.type} for a condensed region, whose inner nodes have no speed"
            findings.problem(place, f"{text}; rayleigh is accepted, or another model")
    if isinstance(viscosity, Prony):
        for problem in _of_prony(viscosity, mesh, body, scene):
            findings.problem(place, problem)


def _of_prony(viscosity: Prony, mesh: Mesh, body: Body, scene: SceneData) -> Iterator[str]:
    thin = sum(len(block) for block in mesh.body_blocks if dimension(str(block.type)) < 3)
    if thin:
        text = f"found prony for {counted(thin, 'cell')} of sheets or lines; rayleigh, "
        yield f"{text}kelvin_voigt and centroid are accepted there"
    for law in body.laws().values():
        made = type(law).made
        if made is not None and made.law.small_strain is None:
            text = f"found prony for the law {law.type}, which is not isotropic at rest; "
            yield f"{text}rayleigh, kelvin_voigt and centroid are accepted"
    if scene.step.type == "static":
        at_once = 1.0 + sum(branch.weight for branch in viscosity.branches)
        text = "found prony for a static step, which has no time for stress to relax in; leave it "
        text += f"out: the law alone is the answer at long times, {at_once:g} times its stiffness "
        yield f"{text}that at once"
