"""Sheets and lines of a body: what they are made of, their weight, what is wrong with them."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from tissu import _core
from tissu.counted import are, counted
from tissu.mesh.cell import dimension
from tissu.mesh.mesh import first_five
from tissu.mesh.thin import KINDS, sizes
from tissu.scene.direction import unit_vector
from tissu.scene.problem import Problem, one_of_words
from tissu.scene.section import Section, area_of

if TYPE_CHECKING:
    from tissu.compile.prepared import Findings
    from tissu.mesh import Mesh
    from tissu.scene.body import Body
    from tissu.scene.law import Law
    from tissu.scene.problem import Path
    from tissu.scene.scene import SceneData

_PARALLEL = 1e-6  # sine of the angle below which a direction says nothing across a line
_FLAT = 1e-12  # share of the m-th power of a cell's diagonal below which it has no size


@cache
def thin_laws() -> tuple[str, ...]:
    """Names of the laws that sheets and lines may be made of."""
    return tuple(name for name, *_, dimensions in _core.laws() if {1, 2} <= set(dimensions))


def cross_section_of(body: Body, cell_type: str) -> float:
    """Thickness [m] of surface cells, section [m2] of lines, 1 for volumes."""
    given = {2: body.thickness, 1: body.section}.get(dimension(cell_type), 1.0)
    assert given is not None  # cells are simulated where the body gives it
    return area_of(given)


def material_volume(mesh: Mesh, body: Body) -> float:
    """Volume of all that the body is made of [m3]."""
    thin = sum(
        float(sizes(mesh, block).sum()) * cross_section_of(body, block.type)
        for block in mesh.thin_blocks
    )
    return mesh.volume() + thin


def check_thin(mesh: Mesh, body: Body, path: Path, findings: Findings) -> bool:
    """Whether the mesh has the cells that the body's fields are about, and is flat if it has to."""
    before = len(findings.problems)
    found = {dimension(block.type) for block in mesh.thin_blocks}
    for m, field, words in ((2, "thickness", "triangles or quads"), (1, "section", "lines")):
        if m in mesh.thin and m not in found:
            out = "it and `plane`" if m == 2 and getattr(body, "plane", None) else "it"
            text = f"found a {field}, but no {words} in the mesh; leave {out} out"
            findings.problem((*path, field), text)
    if getattr(body, "plane", None) is not None:
        low, high = mesh.bounds[:, 2]
        if mesh.volume_blocks:
            text = "found volume cells in the mesh of a flat body; leave `plane` out"
            findings.problem((*path, "plane"), text)
        elif low != high:
            text = f"found z from {low:g} to {high:g} m; a flat body with one z is accepted"
            findings.problem((*path, "plane"), f"{text}: leave `plane` out for a sheet in space")
    _check_up(mesh, body, path, findings)
    return len(findings.problems) == before


def _check_up(mesh: Mesh, body: Body, path: Path, findings: Findings) -> None:
    """Report lines along the direction that says how their section stands."""
    section = getattr(body, "section", None)
    up = section.direction if isinstance(section, Section) else None
    if up is None or not body.has_rotations:
        return
    for block in mesh.thin_blocks:
        if dimension(block.type) != 1:
            continue
        ends = mesh.points[block.nodes]
        along = ends[:, 1] - ends[:, 0]
        length = np.maximum(np.linalg.norm(along, axis=1), np.finfo(float).tiny)
        sine = np.linalg.norm(np.cross(along, unit_vector(up)), axis=1) / length
        bad = np.flatnonzero((sine <= _PARALLEL) & (length > np.finfo(float).tiny))
        if len(bad):
            text = f"found {counted(len(bad), 'line')} along it (first: {first_five(bad)}); a "
            text += "direction across all lines is accepted: give other lines a body of their own"
            findings.problem((*path, "section", "up"), text)


def note_bending(mesh: Mesh, body: Body, scene: SceneData, path: Path, findings: Findings) -> None:
    """Note that a static step may fail where only sheets and lines hold nodes."""
    static = getattr(getattr(scene, "step", None), "type", None) == "static"
    if static and mesh.thin_blocks and not body.has_rotations and body.plane is None:
        findings.note(
            f"{path[0]}.{path[1]}: sheets and lines do not resist bending; where they lie flat and "
            "nothing else holds their nodes a static step fails: hold those, or let it move in time"
        )


def note_held_plane(
    _mesh: Mesh, body: Body, scene: SceneData, path: Path, findings: Findings
) -> None:
    """Note what pulls a flat body along z, where it is held."""
    if body.plane is None:
        return
    name = path[1]
    gravity = getattr(scene, "gravity", None)
    if gravity is not None and gravity[2] != 0.0:
        findings.note(f"gravity: its z does not move body '{name}', whose `plane` holds z")
    for number, load in enumerate(getattr(scene, "loads", ())):
        along = getattr(load, "force", None) or getattr(load, "traction", None)
        if getattr(load, "body", None) == name and along is not None and along[2] != 0.0:
            findings.note(
                f"loads[{number}]: its z does not move body '{name}', whose `plane` holds z"
            )


def check_law(law: Law, cell_type: str, path: Path, findings: Findings) -> None:
    """Report a law that needs a volume on cells that have none."""
    if dimension(cell_type) == 3:
        return
    found = None
    if law.type not in thin_laws():
        found = f"found {law.type} for {KINDS[dimension(cell_type)]}"
    elif law.fibres is not None:
        found = f"found fibres in the law of {KINDS[dimension(cell_type)]}"
    if found is None:
        return
    text = f"{found} ({cell_type}); they may be made of {one_of_words(thin_laws())}, without fibres"
    problem = Problem((*path, "law"), text)
    if problem not in findings.problems:
        findings.problems.append(problem)


def check_sizes(mesh: Mesh, place: Path, findings: Findings) -> None:
    """Report sheets without area and lines without length."""
    for block in mesh.thin_blocks:
        m = dimension(block.type)
        extent = np.linalg.norm(np.ptp(mesh.points[block.nodes], axis=1), axis=1)
        flat = np.flatnonzero(sizes(mesh, block) <= _FLAT * extent**m)
        if len(flat):
            share = f"{len(flat)} of {counted(len(block), f'{block.type} cell')} {are(len(flat))}"
            size = {2: "area", 1: "length"}[m]
            text = f"{share} without {size} (first: {first_five(flat)}); repair the mesh"
            findings.problem(place, text)
