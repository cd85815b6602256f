"""Whether supports agree with each other, and hold what a static step needs held."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING

import numpy as np

from tissu.compile.prepared import Held, Ints, Prepared
from tissu.counted import are, counted
from tissu.mesh.mesh import first_five
from tissu.scene.problem import field_path
from tissu.scene.support import Fixed, Prescribed
from tissu.scene.unknown import Unknown

if TYPE_CHECKING:
    from tissu.mesh import Mesh

_ALL_AXES = 7


def check_supports(prepared: Prepared) -> None:
    """Report nodes that two supports claim, and parts of bodies that nothing holds."""
    _check_conflicts(prepared)
    with contextlib.suppress(Unknown):
        doubtful = _doubtful(prepared)
        tied = {*prepared.tissue, *_tied(prepared)}
        for name, known in prepared.meshes.items():
            if name not in doubtful and name not in tied:
                _check_held(prepared, name, known.mesh)


def _tied(prepared: Prepared) -> set[str]:
    """Bodies that tissue may hold by what it ties them to."""
    return {
        name
        for tissue in getattr(prepared.scene, "tissue", {}).values()
        for name in getattr(tissue, "between", None) or ()
    }


def _doubtful(prepared: Prepared) -> set[str]:
    """Bodies of which it is not known what all supports would hold.

    Raises:
        Unknown: there may be supports that nothing is known of.
    """
    scene, resolved = prepared.scene, {held.path: held for held in prepared.held}
    doubtful = set()
    for group in ("fixed", "prescribed"):
        for number, support in enumerate(getattr(scene, group)):
            if support.body not in scene.bodies:
                return set(scene.bodies)  # a name misspelt may mean any of them
            if (group, number) not in resolved or not hasattr(support, "axes"):
                doubtful.add(support.body)
    return doubtful


def _check_conflicts(prepared: Prepared) -> None:
    """A node has one motion on an axis: fixed and prescribed, or prescribed twice, contradict."""
    moved = [held for held in prepared.held if isinstance(held.support, Prescribed)]
    for number, held in enumerate(moved):
        fixed = [other for other in prepared.held if isinstance(other.support, Fixed)]
        for other in [*fixed, *moved[:number]]:
            with contextlib.suppress(Unknown):
                _check_pair(prepared, held, other)


def _check_pair(prepared: Prepared, held: Held, other: Held) -> None:
    if other.support.body != held.support.body:
        return
    body = prepared.scene.bodies.get(held.support.body)
    turn = body is None or body.has_rotations
    axes = _shared(held.support.axes_mask, other.support.axes_mask)
    about = _shared(held.support.rotations_mask, other.support.rotations_mask) if turn else ""
    both = np.intersect1d(held.nodes, other.nodes)
    if (axes or about) and both.size:
        on = f"on {axes}" if axes else f"against turning about {about}"
        nodes = f"{counted(both.size, 'node')} {are(both.size)} held {on}"
        text = (
            f"{nodes} by {field_path(other.path)} too "
            f"(first: {first_five(both)}); a node takes one motion on an axis"
        )
        prepared.findings.problem(held.path, text)


def _shared(mask: int, other: int) -> str:
    """The letters of the axes in both bit masks."""
    return "".join(letter for bit, letter in enumerate("xyz") if mask & other & (1 << bit))


def held_axes(held: list[Held], body: str, nodes: int) -> Ints:
    """For each node of a body the bit mask of its held axes."""
    mask = np.zeros(nodes, dtype=np.int32)
    for item in held:
        if item.support.body == body:
            mask[item.nodes] |= item.support.axes_mask
    return mask


def _check_held(prepared: Prepared, name: str, mesh: Mesh) -> None:
    mask = held_axes(prepared.held, name, mesh.node_count)
    static, gravity = prepared.scene.step.type == "static", getattr(prepared.scene, "gravity", None)
    part_of_node = _part_of_nodes(mesh)
    parts = int(part_of_node.max()) + 1
    axes = [int(np.bitwise_or.reduce(mask[part_of_node == part])) for part in range(parts)]
    loose = [part for part in range(parts) if axes[part] != _ALL_AXES]
    where = (
        f"body '{name}'"
        if parts == 1
        else f"{len(loose)} of {parts} separate parts of body '{name}'"
    )
    if static and name in _caught(prepared):
        return  # whether contacts hold it, the step finds
    if static and loose:
        need = "a static step needs fixed or prescribed nodes on x, y and z"
        text = f"{where} can move freely on some axis; {need}"
        prepared.findings.problem(("bodies", name), text)
    elif static and (mask > 0).sum() < 3:
        prepared.findings.note(
            f"bodies.{name}: held at fewer than three nodes, so it may turn freely in a static step"
        )
    elif not static and not mask.any() and any(gravity or ()):
        if name in _caught(prepared):
            return
        prepared.findings.note(
            f"bodies.{name}: nothing holds the body, so it falls; hold nodes with `fixed`, "
            "or leave gravity out"
        )
    elif loose and mask.any() and any(axes[part] == 0 for part in loose):
        free = sum(axes[part] == 0 for part in loose)
        prepared.findings.note(
            f"bodies.{name}: {free} of {parts} separate parts without a fixed node fly free"
        )


def _caught(prepared: Prepared) -> set[str]:
    """Bodies that contacts may stop."""
    scene = prepared.scene
    contacts = getattr(scene, "contacts", ())
    if any(getattr(contact, "between", None) == "all" for contact in contacts):
        return set(scene.bodies)
    pairs = (contact.pairs() for contact in contacts if hasattr(contact, "between"))
    return {name for some in pairs for pair in some for name in (pair[1], pair[3])}


def _part_of_nodes(mesh: Mesh) -> Ints:
    part = np.zeros(mesh.node_count, dtype=np.int32)
    of_cell, first = np.asarray(mesh.parts()), 0
    for block in mesh.body_blocks:
        nodes = np.asarray(block.nodes)
        part[nodes] = of_cell[first : first + len(nodes), None]
        first += len(nodes)
    return part
