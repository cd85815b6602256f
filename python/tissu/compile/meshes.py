"""The mesh of a body: read or made, then checked for what a simulation cannot take."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import numpy as np

from tissu.compile.prepared import Findings, KnownMesh
from tissu.compile.thin import check_sizes, check_thin
from tissu.counted import are, counted
from tissu.errors import TissuError
from tissu.mesh.cell import handled_types, thin_types
from tissu.mesh.mesh import first_five
from tissu.mesh.thin import with_thin
from tissu.scene.bar import BarMesh
from tissu.scene.body import MeshFile
from tissu.scene.problem import field_path, one_of_words

if TYPE_CHECKING:
    from tissu.mesh import Mesh
    from tissu.scene.body import Body
    from tissu.scene.problem import Path

_TOO_LONG = 50.0  # length [m] that is refused unless the unit is given
_SLIVER = 0.05  # shape quality below which a cell spoils accuracy and convergence


def known_mesh(body: Body, path: Path, findings: Findings) -> KnownMesh | None:
    """The body's mesh, checked; None when there is none in which anything could be selected.

    Raises:
        Unknown: the scene does not say which mesh.
    """
    place = (*path, "mesh")
    try:
        mesh = with_thin(
            mesh_of(body.mesh), sheets=_asks(body, "thickness"), lines=_asks(body, "section")
        )
    except TissuError as error:
        findings.problem(place, str(error))
        return None
    useless = _useless(mesh)
    if useless is not None:
        findings.problem(place, useless)
        return None
    if not check_thin(mesh, body, path, findings):
        return None
    if len(mesh.unused_nodes):
        findings.problem(place, _unused(mesh))
    positions = _check_length(mesh, body, place, findings)
    _check_shapes(mesh, place, findings)
    repeated = _repeated(mesh)
    for text in repeated:
        findings.problem(place, text)
    findings.notes.extend(f"bodies.{path[1]}.mesh: {note}" for note in mesh.notes)
    return KnownMesh(mesh, positions=positions, surface=not repeated)


def _asks(body: Body, field: str) -> bool:
    """Whether a field is given, rightly or wrongly."""
    return getattr(body, field, "unreadable") is not None


def mesh_of(source: object) -> Mesh:
    """The mesh of a source, read or made, with the regions that the source names."""
    if not isinstance(source, (MeshFile, BarMesh)):
        return cast("Mesh", source)
    mesh = source.mesh()
    for name, where in getattr(source, "regions", {}).items():
        mesh = mesh.with_region(name, where)
    return mesh


def _useless(mesh: Mesh) -> str | None:
    """Why nothing of the mesh can be simulated."""
    accepted = f"accepted: {one_of_words(handled_types())}"
    if mesh.unhandled:
        return f"found cells of type {one_of_words(mesh.unhandled)}, not handled; {accepted}"
    if mesh.body_blocks:
        return None
    types = {block.type for block in mesh.cells}
    text = f"found {one_of_words(sorted(types)) or 'no cells'} only; a body needs volume cells, "
    text += accepted
    if types & set(thin_types()):
        text += "; or give `thickness` for sheets of triangles and quads, `section` for lines"
    return text


def _unused(mesh: Mesh) -> str:
    idle = mesh.unused_nodes
    count = len(idle)
    text = f"{counted(count, 'node')} {are(count)} used by no volume cell "
    text += f"(first: {first_five(idle)}); left out by `tissu mesh convert FILE -o OTHER`"
    return f"{text}, in Python by mesh.without_unused_nodes()"


def _repeated(mesh: Mesh) -> list[str]:
    """Cells that name a node twice, and cells that are there twice."""
    found = []
    for block in mesh.body_blocks:
        rows = np.sort(np.asarray(block.nodes), axis=1)
        folded = np.flatnonzero((rows[:, 1:] == rows[:, :-1]).any(axis=1))
        if len(folded):
            verb = "names" if len(folded) == 1 else "name"
            text = f"{counted(len(folded), f'{block.type} cell')} {verb} a node twice"
            found.append(f"{text} (first: {first_five(folded)}); repair the mesh")
        _, first, count = np.unique(rows, axis=0, return_index=True, return_counts=True)
        if (count > 1).any():
            twice = np.sort(first[count > 1])
            cells = f"{counted(len(twice), f'{block.type} cell')} {are(len(twice))}"
            text = f"{cells} in the mesh more than once (first: {first_five(twice)})"
            found.append(f"{text}; leave the copies out")
    return found


def _check_length(mesh: Mesh, body: Body, place: Path, findings: Findings) -> bool:
    """Whether the length is beyond doubt; a body many metres long is most likely in millimetres."""
    if not _unit_is_known(body):
        return False
    length = float((mesh.bounds[1] - mesh.bounds[0]).max())
    if length <= _TOO_LONG or _unit_is_explicit(mesh, body):
        return True  # `doubts` notes a length above that of any organ
    text = f"the body is {length:.4g} m long (a mesh in millimetres?)"
    findings.problem(
        place, f"{text}; say its unit, such as unit: mm, or unit: m when it is so long"
    )
    return False


def _unit_is_known(body: Body) -> bool:
    source = body.mesh
    return not isinstance(source, MeshFile) or (
        hasattr(source, "unit") and hasattr(source, "scale")
    )


def _unit_is_explicit(mesh: Mesh, body: Body) -> bool:
    if isinstance(body.mesh, MeshFile):
        return bool(body.mesh.model_fields_set & {"unit", "scale"})
    return mesh.source is None or mesh.unit != "m" or mesh.scale != 1.0


def _check_shapes(mesh: Mesh, place: Path, findings: Findings) -> None:
    """Cells inside out or flat are refused; slivers are noted."""
    if mesh.thin_blocks:
        check_sizes(mesh, place, findings)
    if not mesh.volume_blocks:
        return
    report = mesh.quality()
    for wrong, words in ((report.inverted, "inside out"), (report.zero_volume, "without volume")):
        if len(wrong):
            share = f"{len(wrong)} of {counted(mesh.cell_count, 'cell')} {are(len(wrong))} {words}"
            findings.problem(
                place,
                f"{share} (first: {first_five(wrong)}); cells of positive volume are accepted: "
                "repair the mesh",
            )
    slivers = np.setdiff1d(np.flatnonzero(report.shapes < _SLIVER), report.zero_volume)
    if slivers.size and not len(report.inverted):
        limit = f"with a shape quality below {_SLIVER}"
        count = f"{counted(slivers.size, 'sliver')} among the cells"
        text = f"{count}, {limit} (first: {first_five(slivers)})"
        findings.note(f"{field_path(place)}: {text}; they cost accuracy and solver iterations")
