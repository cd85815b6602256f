"""What a scene may ask of its instruments and tears: bodies that there are, and editing."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any

from tissu.scene.problem import Path, Problem, nearest, one_of_words
from tissu.scene.tissue import tissues_of
from tissu.scene.unknown import Unknown

_EXPLICIT = ("symplectic_euler", "explicit_euler", "rk2", "rk4")


def instrument_problems(scene: Any) -> Iterator[Problem]:
    """What is wrong with the instruments and tears of a scene, whose other fields may be too."""
    for name, instrument in getattr(scene, "instruments", {}).items():
        with contextlib.suppress(Unknown):
            path: Path = ("instruments", name)
            for number, body in enumerate(instrument.bodies):
                place = (*path, instrument.bodies_field, number)
                if body not in tissues_of(scene):
                    yield from _of_body(scene, body, place)
            for group in ("bodies", "tissue", "obstacles"):
                if name in getattr(scene, group, {}):
                    text = f"found '{name}' in {group} too; names are unique"
                    yield Problem(path, text)
            yield from _edited(scene, path, "an instrument")
            yield from _pressing(scene, instrument, path)
    with contextlib.suppress(Unknown):
        if getattr(scene, "editing", None) is not None:
            yield from scene.editing.unknown_bodies(scene.bodies)
    for number, tear in enumerate(getattr(scene, "tear", ())):
        with contextlib.suppress(Unknown):
            if tear.body in tissues_of(scene):
                text = f"found a tear of tissue '{tear.body}'; tears of bodies are accepted, and "
                yield Problem(("tear", number, "body"), text + "tissue is cut by a blade")
                continue
            yield from _of_body(scene, tear.body, ("tear", number, "body"))
            if tear.body in [other.body for other in scene.tear[:number]]:
                text = f"found a second tear of '{tear.body}'; one for each body is accepted"
                yield Problem(("tear", number, "body"), text)
            yield from _edited(scene, ("tear", number), "a tear")
            yield from _stressed(scene, tear.body, ("tear", number, "body"))


def _of_body(scene: Any, body: str, path: Path) -> Iterator[Problem]:
    if body not in scene.bodies:
        text = f"no body is named '{body}'{nearest(body, scene.bodies)} "
        yield Problem(path, f"{text}Bodies: {one_of_words(scene.bodies)}")


def _stressed(scene: Any, name: str, path: Path) -> Iterator[Problem]:
    """A tear reads a stress, which springs do not have."""
    body = scene.bodies.get(name)
    for model in [] if body is None else body.models().values():
        if model.type == "mass_spring":
            text = (
                f"found the model {model.type} of body '{name}', which has no stress to tear at; "
            )
            yield Problem(path, f"{text}fem, corotational and mean_dilatation are accepted")
            return


def _edited(scene: Any, path: Path, what: str) -> Iterator[Problem]:
    if scene.editing is None:
        yield Problem(path, f"found {what} in a scene without editing; write editing: true")


def _pressing(scene: Any, instrument: Any, path: Path) -> Iterator[Problem]:
    """Springs of an edge would make explicit steps unstable without a word."""
    if getattr(instrument, "toughness", None) is None or scene.step.type not in _EXPLICIT:
        return
    text = f"found a toughness with the explicit step {scene.step.type}; an implicit method is "
    yield Problem((*path, "toughness"), f"{text}accepted, or a knife without toughness")
