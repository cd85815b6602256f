"""Resolving a scene: read meshes, give cells laws, find selected nodes; gather all problems."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING

import numpy as np

from tissu.compile.balance import check_supports
from tissu.compile.contact import prepare_contact
from tissu.compile.dividing import check_divided
from tissu.compile.material import cell_groups, density_of
from tissu.compile.meshes import known_mesh
from tissu.compile.model import check_kept, check_rotations, note_condensed
from tissu.compile.prepared import Held, LoadedNodes, Prepared, PreparedBody
from tissu.compile.quadrature import check_quadrature
from tissu.compile.select import selected_faces, selected_nodes, selection_words
from tissu.compile.thin import note_bending, note_held_plane
from tissu.compile.tissue import prepare_tissue
from tissu.compile.viscosity import check_viscosity
from tissu.counted import counted
from tissu.scene.part import problems_in
from tissu.scene.selection import SurfaceNodes
from tissu.scene.support import Fixed
from tissu.scene.unknown import Unknown

if TYPE_CHECKING:
    from tissu.mesh import CellBlock, Mesh
    from tissu.scene.load import Load
    from tissu.scene.problem import Path
    from tissu.scene.scene import SceneData
    from tissu.scene.support import Support
    from tissu.scene.trocar.trocar import Trocar


def prepare(scene: SceneData) -> Prepared:
    """Resolve a scene as far as its problems allow; never raises for a problem of the scene.

    The scene's own fields may have problems: what they leave unknown is passed over.
    """
    prepared = Prepared(scene)
    prepared.findings.problems += problems_in(scene)
    for name in getattr(scene, "bodies", {}):
        _prepare_body(prepared, name)
    for name in getattr(scene, "tissue", {}):
        prepare_tissue(prepared, name)
    for group in ("fixed", "prescribed"):
        for number, support in enumerate(getattr(scene, group, ())):
            _prepare_support(prepared, (group, number), support)
    for number, load in enumerate(getattr(scene, "loads", ())):
        with contextlib.suppress(Unknown):
            _prepare_load(prepared, ("loads", number), load)
    check_kept(prepared)
    with contextlib.suppress(Unknown):
        check_rotations(prepared)
    with contextlib.suppress(Unknown):
        check_divided(prepared)
    check_supports(prepared)
    with contextlib.suppress(Unknown):
        prepare_contact(prepared)
    for name, trocar in getattr(scene, "trocars", {}).items():
        with contextlib.suppress(Unknown):
            _check_device(prepared, name, trocar)
    return prepared


def _check_device(prepared: Prepared, name: str, trocar: Trocar) -> None:
    """A device, or the path of its hand, that is not there; a table that no tissue has."""
    path: Path = ("trocars", name)
    absent = trocar.device.absent()
    if absent is not None:
        prepared.findings.problem((*path, "device"), absent)
    hand = getattr(trocar.device, "hand", None)
    if hand is not None and hand.path is not None and not hand.path.is_file():
        text = f"found {hand.path}, and no such file is there; a CSV file with a line `t, x, y, z` "
        text += "[s, m] for each time is accepted, or `times` with `points`"
        prepared.findings.problem((*path, "device", "hand", "path"), text)
    if trocar.compliance == "condensed":
        changing = _changing(prepared.scene)
        if changing:
            text = (
                f"found condensed, whose table holds while the stiffness does; {changing} changes "
            )
            text += (
                "with the shape: take factor or warped, or hooke with the model fem or condensed"
            )
            prepared.findings.problem((*path, "compliance"), text)


def _changing(scene: SceneData) -> str:
    """A body whose stiffness changes with its shape, in words; empty: none does."""
    for name, body in scene.bodies.items():
        for model in body.models().values():
            turns = model.type == "corotational" and getattr(model, "rotation", "") != "small"
            if turns or model.type in ("mass_spring", "mass_link"):
                return f"that of '{name}' (model {model.type})"
        condensed = all(model.type == "condensed" for model in body.models().values())
        for law in body.laws().values():
            if law.type != "hooke" and not condensed:
                return f"that of '{name}' (law {law.type})"
    return ""


def _prepare_body(prepared: Prepared, name: str) -> None:
    body, findings, path = prepared.scene.bodies[name], prepared.findings, ("bodies", name)
    before = len(findings.problems)
    with contextlib.suppress(Unknown):
        known = known_mesh(body, path, findings)
        if known is None:
            return
        prepared.meshes[name] = known
        _hold_plane(prepared, name, known.mesh)
        notes = (note_bending, note_held_plane, note_condensed)
        for check in (*notes, check_quadrature, check_viscosity):
            with contextlib.suppress(Unknown):  # each says what it can
                check(known.mesh, body, prepared.scene, path, findings)
        groups = cell_groups(known.mesh, body, path, findings)
        if len(findings.problems) == before:
            density = density_of(body, known.mesh, path, findings)
            prepared.bodies[name] = PreparedBody(known.mesh, groups, density)


def _hold_plane(prepared: Prepared, name: str, mesh: Mesh) -> None:
    """All nodes of a flat body keep their z."""
    if getattr(prepared.scene.bodies[name], "plane", None) is None:
        return
    every = np.arange(mesh.node_count, dtype=np.int32)
    held = Fixed(name, on=SurfaceNodes(), axes="z")
    prepared.held.append(Held(held, ("bodies", name, "plane"), every))


def _prepare_support(prepared: Prepared, path: Path, support: Support) -> None:
    with contextlib.suppress(Unknown):
        nodes = selected_nodes(prepared, path, support.body, support.on)
        if nodes is not None:
            misfit = support.misfit(nodes)
            if misfit is not None:
                prepared.findings.problem((*path, "node_displacements"), misfit)
                return
            prepared.held.append(Held(support, path, nodes))


def _prepare_load(prepared: Prepared, path: Path, load: Load) -> None:
    nodes = selected_nodes(prepared, path, load.body, load.on)
    if nodes is None:
        return
    faces: tuple[CellBlock, ...] = ()
    known = prepared.meshes[load.body]
    if load.on_surface and known.surface:
        flat = getattr(prepared.scene.bodies.get(load.body), "plane", None) is not None
        faces = selected_faces(nodes, known.mesh, flat=flat)
        if not faces:
            count, side = counted(len(nodes), "node"), "edge" if flat else "face"
            text = f"{selection_words(load.on)} selects {count} of body '{load.body}', but "
            text += f"no {side} of its surface with all its nodes"
            prepared.findings.problem((*path, "on"), text)
            return
    prepared.loaded.append(LoadedNodes(load, path, nodes, faces))
