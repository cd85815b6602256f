"""The mesh of a body: read or made, then checked for what a simulation cannot take."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.compile.prepared import Findings
from tissu.errors import TissuError
from tissu.mesh import bar_mesh, read_mesh
from tissu.mesh.cell import handled_types
from tissu.mesh.mesh import first_five
from tissu.scene.body import BarMesh, MeshFile
from tissu.scene.problem import field_path, one_of_words

if TYPE_CHECKING:
    from tissu.mesh import Mesh
    from tissu.scene.body import Body
    from tissu.scene.problem import Path

_LONG = 20.0  # length [m] that is remarkable for a body
_TOO_LONG = 50.0  # length [m] that is refused unless the unit is given
_SLIVER = 0.05  # shape quality below which a cell spoils accuracy and convergence


def mesh_of(body: Body, path: Path, findings: Findings) -> Mesh | None:
    """The body's mesh; None and a problem when it cannot be read or made."""
    source = body.mesh
    try:
        if isinstance(source, MeshFile):
            return read_mesh(source.file, unit=source.unit, scale=source.scale)
        if isinstance(source, BarMesh):
            return bar_mesh(
                size=source.size,
                cells=source.cells,
                cell=source.cell,
                split=source.split,
                origin=source.origin,
            )
    except TissuError as error:
        findings.problem((*path, "mesh"), str(error))
        return None
    mesh: Mesh = source
    return mesh


def check_mesh(mesh: Mesh, body: Body, path: Path, findings: Findings) -> bool:
    """Whether the mesh can be simulated; problems and notes say what was found."""
    before = len(findings.problems)
    place = (*path, "mesh")
    for text in _unusable(mesh):
        findings.problem(place, text)
    if len(findings.problems) > before:
        return False
    _check_length(mesh, body, place, findings)
    _check_shapes(mesh, place, findings)
    for text in _repeated(mesh):
        findings.problem(place, text)
    findings.notes.extend(f"bodies.{path[1]}.mesh: {note}" for note in mesh.notes)
    return len(findings.problems) == before


def _unusable(mesh: Mesh) -> list[str]:
    """What makes the mesh no mesh of handled volume cells, all of whose nodes are used."""
    accepted = f"accepted: {one_of_words(handled_types())}"
    found = []
    if mesh.unhandled:
        found.append(f"found cells of type {one_of_words(mesh.unhandled)}, not handled; {accepted}")
    elif not mesh.volume_blocks:
        types = one_of_words(sorted({block.type for block in mesh.cells})) or "no cells"
        found.append(f"found {types} only; a body needs volume cells, {accepted}")
    elif len(mesh.unused_nodes):
        idle = mesh.unused_nodes
        text = f"{len(idle)} nodes are used by no volume cell (first: {first_five(idle)})"
        found.append(f"{text}; mesh.without_unused_nodes() leaves them out")
    return found


def _repeated(mesh: Mesh) -> list[str]:
    """Cells that name a node twice, and cells that are there twice."""
    found = []
    for block in mesh.volume_blocks:
        rows = np.sort(np.asarray(block.nodes), axis=1)
        folded = np.flatnonzero((rows[:, 1:] == rows[:, :-1]).any(axis=1))
        if len(folded):
            text = f"{len(folded)} {block.type} cells name a node twice (first: "
            found.append(f"{text}{first_five(folded)}); mend the mesh")
        _, first, count = np.unique(rows, axis=0, return_index=True, return_counts=True)
        if (count > 1).any():
            twice = np.sort(first[count > 1])
            text = f"{len(twice)} {block.type} cells are in the mesh more than once (first: "
            found.append(f"{text}{first_five(twice)}); leave the copies out")
    return found


def _check_length(mesh: Mesh, body: Body, place: Path, findings: Findings) -> None:
    """A body many metres long is most likely a mesh in millimetres."""
    length = float((mesh.bounds[1] - mesh.bounds[0]).max())
    if length <= _LONG:
        return
    text = f"the body is {length:.4g} m long (a mesh in millimetres?)"
    if length > _TOO_LONG and not _unit_is_explicit(mesh, body):
        findings.problem(
            place, f"{text}; say its unit, such as unit: mm, or unit: m when it is so long"
        )
    else:
        findings.note(f"{field_path(place)}: {text}")


def _unit_is_explicit(mesh: Mesh, body: Body) -> bool:
    if isinstance(body.mesh, MeshFile):
        return bool(body.mesh.model_fields_set & {"unit", "scale"})
    return mesh.source is None or mesh.unit != "m" or mesh.scale != 1.0


def _check_shapes(mesh: Mesh, place: Path, findings: Findings) -> None:
    """Cells inside out or flat are refused; slivers are noted."""
    report = mesh.quality()
    for wrong, words in ((report.inverted, "inside out"), (report.zero_volume, "without volume")):
        if len(wrong):
            share = f"{len(wrong)} of {mesh.cell_count} cells are {words}"
            findings.problem(
                place,
                f"{share} (first: {first_five(wrong)}); cells of positive volume are accepted: "
                "mend the mesh",
            )
    slivers = np.setdiff1d(np.flatnonzero(report.shapes < _SLIVER), report.zero_volume)
    if slivers.size and not len(report.inverted):
        limit = f"with a shape quality below {_SLIVER}"
        text = f"{slivers.size} cells are slivers, {limit} (first: {first_five(slivers)})"
        findings.note(f"{field_path(place)}: {text}; they cost accuracy and solver iterations")
