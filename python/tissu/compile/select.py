"""Which nodes of a body a selection means, and which faces of its mesh these mean."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.compile.prepared import Ints
from tissu.errors import ParameterError
from tissu.mesh.cell import CellBlock
from tissu.mesh.flat_edges import flat_edges
from tissu.mesh.whole_faces import whole_faces

if TYPE_CHECKING:
    from tissu.compile.prepared import Prepared
    from tissu.mesh import Mesh
    from tissu.scene.problem import Path
    from tissu.scene.selection import Selection


def selected_faces(nodes: Ints, mesh: Mesh, *, flat: bool = False) -> tuple[CellBlock, ...]:
    """Whole faces of the surface, outward, whose nodes are all among `nodes`.

    The surface of a flat body is its rim.
    """
    chosen = np.zeros(mesh.node_count, dtype=bool)
    chosen[nodes] = True
    faces = flat_edges(mesh) if flat else whole_faces(mesh)
    kept = ((b.type, b.nodes[chosen[b.nodes].all(axis=1)]) for b in faces)
    return tuple(CellBlock(kind, faces) for kind, faces in kept if len(faces))


def selected_nodes(prepared: Prepared, path: Path, body: str, on: Selection) -> Ints | None:
    """Selected nodes; None, and maybe a problem, when there are none."""
    known = prepared.meshes.get(body)
    if known is None:
        return None  # no such body, or none that can be read: told already
    if not (known.positions or not on.by_place):
        return None
    if on.type == "surface" and not known.surface:
        return None
    try:
        nodes = on.nodes(known.mesh)
    except ParameterError as error:
        prepared.findings.problem((*path, "on"), str(error))
        return None
    if nodes.size:
        return nodes
    text = f"{selection_words(on)} selects no node of body '{body}', which {_extent(known.mesh)}"
    prepared.findings.problem((*path, "on"), text)
    return None


def selection_words(on: Selection) -> str:
    """A selection with the fields that it has, in a sentence."""
    fields = {name: getattr(on, name) for name in type(on).model_fields if name != "type"}
    given = {name: value for name, value in fields.items() if value is not None}
    text = ", ".join(f"{name} {_shown(value)}" for name, value in given.items())
    return f"the {on.type} ({text})" if text else f"the {on.type}"


def _shown(value: object) -> str:
    """A field of a selection in a sentence; a side without a number is open."""
    if value is None:
        return "open"
    if isinstance(value, tuple):
        few = [_shown(item) for item in value[:6]] + ["..."] * (len(value) > 6)
        return f"({', '.join(few)})"
    return f"{value:g}" if isinstance(value, float) else f"{value}"


def _extent(mesh: Mesh) -> str:
    low, high = mesh.bounds
    return "reaches " + ", ".join(
        f"{axis} from {a:g} to {b:g} m" for axis, a, b in zip("xyz", low, high, strict=True)
    )
