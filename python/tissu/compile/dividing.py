"""Which bodies a cut may divide: tetrahedra, or triangles, of first order."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tissu.scene.problem import Problem

if TYPE_CHECKING:
    from tissu.compile.prepared import Prepared, PreparedBody
    from tissu.scene.problem import Path

_CELLS = ("tetra", "triangle")
_MODELS = ("fem", "corotational", "mass_link", "mass_tensor")
"""Models whose energy in such a cell is its volume times a function of F."""


def check_divided(prepared: Prepared) -> None:
    """Report bodies whose cells a cut cannot divide."""
    editing = getattr(prepared.scene, "editing", None)
    if editing is None:
        return
    for name, body in prepared.bodies.items():
        if editing.repairs(name) and (found := _unmoved(prepared, name, body)):
            text = (
                f"found repair for body '{name}', which has {found} are repaired, or leave it out"
            )
            prepared.findings.problems.append(Problem(("editing", "repair"), text))
        found = _in_the_way(prepared, name, body) if editing.divides(name) else ""
        if editing.snaps(name):
            found = _unmoved(prepared, name, body) or found
        if not found:
            continue
        by_body = isinstance(editing.method, dict)
        path: Path = ("editing", "method", name) if by_body else ("editing", "method")
        method = editing.method_of(name)
        text = f"found {method} for body '{name}', which has {found} are accepted, or virtual"
        if not by_body:
            text += f"; methods may be given by body, such as {{liver: {method}}}"
        prepared.findings.problems.append(Problem(path, text))


def _in_the_way(prepared: Prepared, name: str, body: PreparedBody) -> str:
    """What of a body cannot be divided, and what is accepted, in words; empty: nothing."""
    for group in body.groups:
        if group.cell_type not in _CELLS or group.cell_type != body.groups[0].cell_type:
            return f"cells of type {group.cell_type}; tetrahedra, or triangles, of first order"
        if group.model.type not in _MODELS:
            return f"the model {group.model.type}; fem, corotational, mass_link and mass_tensor"
    for motion in getattr(prepared.scene, "prescribed", ()):
        if motion.body == name and motion.node_displacements is not None:
            return "node_displacements, which nodes on edges lack; displacements and rotations"
    return ""


def _unmoved(prepared: Prepared, name: str, body: PreparedBody) -> str:
    """Why no node of a body may move and no cell is repaired, and what is accepted, in words."""
    viscosity = prepared.scene.bodies[name].viscosity
    if viscosity is not None and viscosity.type == "prony":
        return "a viscosity with a memory; bodies without one"
    for group in body.groups:
        if group.cell_type != "tetra":
            return f"cells of type {group.cell_type}; tetrahedra of first order"
    return ""
