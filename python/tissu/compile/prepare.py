"""Resolving a scene: read meshes, give cells laws, find selected nodes; gather all problems."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.compile.balance import check_supports
from tissu.compile.material import cell_groups, density_of
from tissu.compile.meshes import check_mesh, mesh_of
from tissu.compile.prepared import Held, Ints, LoadedNodes, Prepared, PreparedBody
from tissu.compile.select import selected_nodes, selected_triangles
from tissu.errors import ParameterError

if TYPE_CHECKING:
    from tissu.mesh import Mesh
    from tissu.scene.load import Load
    from tissu.scene.problem import Path
    from tissu.scene.scene import Scene
    from tissu.scene.selection import Selection
    from tissu.scene.support import Fixed, Prescribed


def prepare(scene: Scene) -> Prepared:
    """Resolve a scene as far as its problems allow; never raises for a problem of the scene."""
    prepared = Prepared(scene)
    for name in scene.bodies:
        _prepare_body(prepared, name)
    groups: dict[str, tuple[Fixed | Prescribed, ...]] = {
        "fixed": scene.fixed,
        "prescribed": scene.prescribed,
    }
    for group, supports in groups.items():
        for number, support in enumerate(supports):
            nodes = _nodes(prepared, (group, number), support.body, support.on)
            if nodes is not None:
                prepared.held.append(Held(support, (group, number), nodes))
    for number, load in enumerate(scene.loads):
        _prepare_load(prepared, ("loads", number), load)
    check_supports(prepared)
    return prepared


def _prepare_body(prepared: Prepared, name: str) -> None:
    body, findings, path = prepared.scene.bodies[name], prepared.findings, ("bodies", name)
    mesh = mesh_of(body, path, findings)
    if mesh is None or not check_mesh(mesh, body, path, findings):
        return
    groups = cell_groups(mesh, body, path, findings)
    prepared.bodies[name] = PreparedBody(mesh, groups, density_of(body, mesh, path, findings))


def _nodes(prepared: Prepared, path: Path, body: str, on: Selection) -> Ints | None:
    """Selected nodes; None, and maybe a problem, when there are none."""
    if body not in prepared.bodies:
        return None  # its mesh has a problem already
    mesh = prepared.bodies[body].mesh
    try:
        nodes = selected_nodes(on, mesh)
    except ParameterError as error:
        prepared.findings.problem((*path, "on"), str(error))
        return None
    if nodes.size:
        return nodes
    prepared.findings.problem(
        (*path, "on"), f"{_words(on)} selects no node of body '{body}', which {_extent(mesh)}"
    )
    return None


def _prepare_load(prepared: Prepared, path: Path, load: Load) -> None:
    nodes = _nodes(prepared, path, load.body, load.on)
    if nodes is None:
        return
    triangles: Ints = np.empty((0, 3), dtype=np.int32)
    if load.type != "nodal":
        triangles = selected_triangles(nodes, prepared.bodies[load.body].mesh)
        if not len(triangles):
            text = f"{_words(load.on)} selects {len(nodes)} nodes of body '{load.body}'"
            text += ", but no face of its surface with all its nodes"
            prepared.findings.problem((*path, "on"), text)
            return
    prepared.loaded.append(LoadedNodes(load, path, nodes, triangles))


def _words(on: Selection) -> str:
    fields = {name: getattr(on, name) for name in type(on).model_fields if name != "type"}
    text = ", ".join(f"{name} {value}" for name, value in fields.items())
    return f"the {on.type} ({text})" if text else f"the {on.type}"


def _extent(mesh: Mesh) -> str:
    low, high = mesh.bounds
    return "reaches " + ", ".join(
        f"{axis} from {a:g} to {b:g} m" for axis, a, b in zip("xyz", low, high, strict=True)
    )
