"""Which effects a scene switches on, and why; which are absent. An absent effect runs no code."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from tissu.scene.effect import Effect, vector_in_words

if TYPE_CHECKING:
    from tissu.scene.scene import SceneData


def effects_of(scene: SceneData, counts: Mapping[str, str] | None = None) -> list[Effect]:
    """Effects that the scene switches on, in the order of its fields.

    Args:
        scene: the scene.
        counts: what a field selects, by its path ("fixed[0]" -> "42 nodes"), where it is known.
    """
    counts = counts or {}
    effects = [effect for name, body in scene.bodies.items() for effect in body.effects(name)]
    for name, tissue in scene.tissue.items():
        effects += tissue.effects(name)
    if scene.gravity is not None:
        effects.append(Effect("gravity", f"gravity is {vector_in_words(scene.gravity)} m/s^2"))
    for group in ("fixed", "prescribed", "loads"):
        for number, part in enumerate(getattr(scene, group)):
            path = f"{group}[{number}]"
            effects.append(part.effect(path, counts.get(path)))
    effects += [obstacle.effect(name) for name, obstacle in scene.obstacles.items()]
    effects += _contact_effects(scene, counts)
    effects += [trocar.effect(name) for name, trocar in scene.trocars.items()]
    for path, name in _led_live(scene).items():
        effects.append(Effect("live leads", f"{path} has the name '{name}'"))
    effects += [scene.step.effect(), *scene.step.solver_effects()]
    if scene.editing:
        effects.append(scene.editing.effect())
    effects += [tool.effect(name) for name, tool in scene.instruments.items()]
    effects += [tear.effect(f"tear[{number}]") for number, tear in enumerate(scene.tear)]
    if scene.grabbing:
        effects.append(Effect("grabs", "grabbing is true"))
    return effects


def _contact_effects(scene: SceneData, counts: Mapping[str, str]) -> list[Effect]:
    """What meets what, and how."""
    paths = [f"contacts[{number}]" for number in range(len(scene.contacts))]
    found = [c.effect(p, counts.get(p)) for p, c in zip(paths, scene.contacts, strict=True)]
    if "contact" in counts:
        found.append(Effect("contact", counts["contact"]))
    return found


def absent_of(scene: SceneData) -> list[str]:
    """Effects that the scene does not ask for; none of them runs or is stored."""
    present = {
        "sheets": any(body.thickness is not None for body in scene.bodies.values()),
        "lines": any(body.section is not None for body in scene.bodies.values()),
        "frames": bool(scene.tissue) or any(b.has_rotations for b in scene.bodies.values()),
        "connective tissue": bool(scene.tissue),
        "viscosity": any(body.viscosity is not None for body in scene.bodies.values()),
        "gravity": scene.gravity is not None,
        "fixed nodes": bool(scene.fixed),
        "prescribed motion": bool(scene.prescribed),
        "live leads": bool(_led_live(scene)),
        "loads": bool(scene.loads),
        "inertia": scene.step.type != "static",
        "grabs": scene.grabbing,
        "contact": bool(scene.contacts),
        "cutting": scene.editing is not None,
        "instruments": bool(scene.instruments),
        "tears": bool(scene.tear),
        "haptics": bool(scene.trocars),
    }
    return [name for name, on in present.items() if not on]


def _led_live(scene: SceneData) -> dict[str, str]:
    """Path -> name of the supports and motions that a run may lead."""
    return {
        f"{group}[{number}]": support.name
        for group in ("fixed", "prescribed")
        for number, support in enumerate(getattr(scene, group))
        if support.name is not None
    }
