"""Which law a model runs with, and the cells and laws that it cannot carry."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from tissu import _core
from tissu.counted import counted
from tissu.mesh.cell import cell_table, dimension
from tissu.scene.contact_rules import meets_others
from tissu.scene.generated.laws import LAWS
from tissu.scene.model import Condensed, Frames
from tissu.scene.part import type_name
from tissu.scene.problem import Problem, one_of_words

if TYPE_CHECKING:
    from tissu.compile.prepared import Findings, Group, Ints, Prepared
    from tissu.mesh import Mesh
    from tissu.scene.body import Body
    from tissu.scene.law import Law
    from tissu.scene.model import Model
    from tissu.scene.problem import Path
    from tissu.scene.scene import SceneData


class ModelInfo(NamedTuple):
    """What a model says of itself; empty laws or elements: any."""

    form: str
    laws: list[str]
    elements: list[str]
    abilities: dict[str, tuple[str, str]]


@cache
def models() -> dict[str, ModelInfo]:
    """What each model of the core says of itself, by its name."""
    return {row[0]: ModelInfo(*row[1:]) for row in _core.models()}


def law_of_model(model: Model, law: Law, body: Body) -> str | None:
    """Name of the law that the model computes for a law of the body; None where it has none."""
    taken = models()[model.type].laws
    if not taken or law.type in taken:
        return law.type
    return _nearest(law, taken) if body.law_for_model == "nearest" else None


def _nearest(law: Law, taken: list[str]) -> str | None:
    """The nearest in the list of laws, which goes from small to large strain, of those taken.

    It has the same parameters, Young's modulus and Poisson's ratio, so that both agree at small
    strain; None where there is none.
    """
    if type(law) not in LAWS or law.parameter_names() != ["young", "poisson"]:
        return None
    own = LAWS.index(type(law))
    near = sorted(range(len(LAWS)), key=lambda place: (abs(place - own), place))
    names = [type_name(LAWS[place]) for place in near]
    return next((name for name in names if name in taken), None)


def kept_nodes(prepared: Prepared, name: str, group: Group) -> Ints:
    """Nodes of a condensed region that stay unknowns; none for other models.

    In contact the surface may be touched anywhere; a surface of its own keeps what carries it.
    """
    if not isinstance(group.model, Condensed):
        return np.empty(0, dtype=np.int32)
    body = prepared.bodies[name]
    shared = [other.nodes.ravel() for other in body.groups if other is not group]
    held = [held.nodes for held in prepared.held if held.support.body == name]
    loaded = [loaded.nodes for loaded in prepared.loaded if loaded.load.body == name]
    faces = [
        block.nodes.ravel()
        for loaded in prepared.loaded
        if loaded.load.body == name
        for block in loaded.faces
    ]
    whole = group.model.keep == "surface" or meets_others(prepared.scene, name)
    surface = [body.mesh.surface().nodes] if whole else []
    skin = None if prepared.contact is None else prepared.contact.bodies.get(name)
    surface += [] if skin is None or skin.riders is None else [skin.riders.nodes]
    every = np.concatenate([*shared, *held, *loaded, *faces, *surface, np.empty(0, dtype=np.int32)])
    return np.intersect1d(every, group.nodes).astype(np.int32)


def check_model(
    model: Model, law: Law, cell_type: str, count: int, body: Body, path: Path, findings: Findings
) -> None:
    """Report cells and laws that a model cannot carry; note a law that stands in for another."""
    info = models()[model.type]
    place = (*path, "model")
    if info.elements and cell_type not in info.elements:
        text = f"found {model.type} for {counted(count, f'{cell_type} cell')}; it takes "
        text += f"{one_of_words(info.elements)}; take such cells, or the model fem"
        _tell_once(place, text, findings)
    if not info.laws:
        return
    if law.fibres is not None:
        _tell_once(place, f"found {model.type} for a law with fibres; only fem has them", findings)
    used = law_of_model(model, law, body)
    if used is None:
        text = f"found {model.type} for the law {law.type}; it takes {one_of_words(info.laws)}; "
        near = _nearest(law, info.laws)
        if near is not None and body.law_for_model != "nearest":
            text += "take one of them, the model fem, or law_for_model: nearest, which computes "
            text += f"{near} with the same young and poisson: equal at small strain only"
        else:
            text += "take one of them, or the model fem"
        _tell_once(place, text, findings)
    elif used != law.type:
        text = f"{path[0]}.{path[1]}: the model {model.type} computes {used} in place of {law.type}"
        note = f"{text}, with the same young and poisson: equal at small strain only"
        if note not in findings.notes:
            findings.note(note)


def check_kept(prepared: Prepared) -> None:
    """Report condensed regions of which nothing would stay unknown."""
    for name, body in prepared.bodies.items():
        for group in body.groups:
            if isinstance(group.model, Condensed) and not len(kept_nodes(prepared, name, group)):
                text = "found a condensed region of which no node is held, led, loaded or shared "
                text += "with other cells; hold one, or keep the surface: "
                text += "{type: condensed, keep: surface}"
                _tell_once(("bodies", name, "model"), text, prepared.findings)


def check_rotations(prepared: Prepared) -> None:
    """Report bodies of which only some cells give their nodes a rotation, and what asks for one."""
    _check_levers(prepared)
    for name, body in getattr(prepared.scene, "bodies", {}).items():
        kinds = {model.with_rotations for model in body.models().values()}
        if len(kinds) == 2:
            names = one_of_words(sorted({model.type for model in body.models().values()}))
            text = f"found {names} in one body; frames and other models share no node: give each "
            _tell_once(("bodies", name, "model"), f"{text}a body of its own", prepared.findings)
        if True in kinds and body.viscosity is not None and body.viscosity.type != "rayleigh":
            text = f"found {body.viscosity.type} for frames; rayleigh is accepted"
            _tell_once(("bodies", name, "viscosity"), text, prepared.findings)
    for number, load in enumerate(getattr(prepared.scene, "loads", ())):
        asked = getattr(prepared.scene, "bodies", {}).get(getattr(load, "body", None))
        if load.type == "moment" and asked is not None and not asked.has_rotations:
            text = f"found a moment on '{load.body}', whose nodes have no rotation; "
            text += "frames have one, other bodies take forces"
            _tell_once(("loads", number), text, prepared.findings)
        elif load.type == "moment" and asked is not None:
            _check_moment(prepared, number, load.body, asked)
    _check_held_rotations(prepared)


def _check_levers(prepared: Prepared) -> None:
    """Report half levers on cells that bend by themselves; note whole ones on others.

    These turn by themselves (docs/guide/tissue.md).
    """
    straight = [r.name for r in cell_table().values() if r.dimension == 3 and r.order == 1]
    for name, body in prepared.bodies.items():
        cells = {group.cell_type for group in body.groups if _lever(group.model) == "half"}
        bent = sorted(cell for cell in cells.difference(straight) if dimension(cell) == 3)
        if bent:
            text = f"found half levers on cells of type {one_of_words(bent)}, which bend by "
            text += f"themselves; {one_of_words(straight)} are accepted: take lever: whole there"
            _tell_once(("bodies", name, "model"), text, prepared.findings)
        cells = {group.cell_type for group in body.groups if _lever(group.model) == "whole"}
        if not cells.isdisjoint(straight):
            prepared.findings.note(
                f"bodies.{name}: volumes of frames with whole levers have many equilibria or none "
                "where they bend or are pressed: a static step may find none, and frames may turn "
                "by themselves; `model: {type: frames, lever: half}` cures both"
            )


def _lever(model: Model) -> str:
    """What is asked of the levers of volume cells; empty: their nodes are not frames."""
    return model.lever or "whole" if isinstance(model, Frames) else ""


def _check_moment(prepared: Prepared, number: int, name: str, body: Body) -> None:
    """Report a moment on a volume of frames with whole levers, which turns what moves no point."""
    found = prepared.bodies.get(name)
    levers = {getattr(model, "lever", "half") for model in body.models().values()}
    whole = bool(levers & {None, "whole"})
    if found is None or not whole or not found.mesh.volume_blocks:
        return
    text = f"found a moment on '{name}', a volume of frames with whole levers, whose rotations "
    text += "move nearly no point there; take the model {type: frames, lever: half}, or load it by "
    text += "forces"
    _tell_once(("loads", number), text, prepared.findings)


def _check_held_rotations(prepared: Prepared) -> None:
    """Report supports that hold rotations of nodes that have none."""
    bodies = getattr(prepared.scene, "bodies", {})
    for group in ("fixed", "prescribed"):
        for number, support in enumerate(getattr(prepared.scene, group, ())):
            body = bodies.get(getattr(support, "body", None))
            asked = getattr(support, "needs_rotations", None)
            if asked is not None and body is not None and not body.has_rotations:
                text = f"found {asked} on '{support.body}', whose nodes have no rotation; "
                text += "leave it out, or take the model frames or shell"
                _tell_once((group, number), text, prepared.findings)


def note_condensed(
    _mesh: Mesh, body: Body, scene: SceneData, path: Path, findings: Findings
) -> None:
    """Note what has no inertia inside, where time is stepped, and what contact makes it keep."""
    models = [model for model in body.models().values() if isinstance(model, Condensed)]
    condensed = len(models) > 0
    if any(model.keep == "touched" for model in models) and meets_others(scene, str(path[1])):
        findings.note(
            f"{path[0]}.{path[1]}: a contact names it, so that its condensed region keeps all "
            "nodes of its surface, as with keep: surface"
        )
    if condensed and getattr(getattr(scene, "step", None), "type", "static") != "static":
        findings.note(
            f"{path[0]}.{path[1]}: inner nodes of a condensed region follow the others at once, "
            "as in slow motion; their mass stands on the nodes that are kept"
        )


def _tell_once(place: Path, text: str, findings: Findings) -> None:
    problem = Problem(place, text)
    if problem not in findings.problems:
        findings.problems.append(problem)
