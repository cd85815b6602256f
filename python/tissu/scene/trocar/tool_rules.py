"""What the tools of a trocar have to be: led by their hand alone, and met by something."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from tissu.scene.problem import Path, Problem, nearest, one_of_words
from tissu.scene.unknown import Unknown

if TYPE_CHECKING:
    from tissu.scene.trocar.trocar import Trocar


def tool_problems(trocar: Trocar, scene: Any) -> Iterator[Problem]:
    """Tools that the scene does not have, and those that a hand cannot lead."""
    obstacles: Mapping[str, Any] = getattr(scene, "obstacles", {})
    instruments: Mapping[str, Any] = getattr(scene, "instruments", {})
    known = {**obstacles, **instruments}
    for tag, tool in trocar.tools.items():
        path: Path = ("tools", tag)
        if tool not in known:
            text = f"no obstacle or instrument is named '{tool}'{nearest(tool, known)}"
            there = one_of_words(known) or "none: the scene has no obstacle and no instrument"
            yield Problem(path, f"{text} Accepted: {there}")
            continue
        with contextlib.suppress(Unknown):
            if tool in instruments:
                yield from _of_instrument(tool, instruments[tool], path)
            else:
                yield from _of_obstacle(tool, obstacles[tool], scene, path)
    yield from _changes(trocar)


def _of_instrument(tool: str, instrument: Any, path: Path) -> Iterator[Problem]:
    if instrument.path is not None:
        text = f"found '{tool}', an instrument that its path leads; one without a path is "
        yield Problem(path, f"{text}accepted: a tool of a trocar is led by its hand alone")


def _of_obstacle(tool: str, obstacle: Any, scene: Any, path: Path) -> Iterator[Problem]:
    if obstacle.type == "plane" or obstacle.mass is not None or obstacle.motion is not None:
        text = f"found '{tool}', an obstacle with a mass or a motion, or a plane; one without is "
        yield Problem(path, f"{text}accepted: a tool of a trocar is led by its hand alone")
    elif not any(_names(contact, tool) for contact in getattr(scene, "contacts", ())):
        text = f"found '{tool}', which no contact of the scene names; add one, such as "
        yield Problem(path, f"{text}{{between: [liver, {tool}]}}")


def _names(contact: Any, tool: str) -> bool:
    """Whether a contact is between the tool and something."""
    if getattr(contact, "between", None) == "all":
        return True
    return hasattr(contact, "pairs") and any(
        tool in (one, other) for _, one, _, other in contact.pairs()
    )


def _changes(trocar: Trocar) -> Iterator[Problem]:
    """Tags that the script of a simulated device puts in, and no tool has."""
    changes = getattr(trocar.device, "changes", None)
    if changes is None:
        return
    if not trocar.tools:
        text = "is given beside no tools; changes are accepted where `tools` names what a tag "
        yield Problem(("device", "changes"), f"{text}stands for, such as {{0x51A0: probe}}")
        return
    first = next(iter(trocar.tools))
    if changes.times and changes.times[0] > 0.0 and changes.tags[0] not in (None, first):
        text = (
            f"found {changes.tags[0]} right after {first}, which is in from the start; none before "
        )
        yield Problem(("device", "changes", "tags", 0), f"{text}it is accepted")
    for number, tag in enumerate(changes.tags):
        if tag is not None and tag not in trocar.tools:
            text = f"found the tag {tag}, which no tool of the trocar has; accepted: "
            yield Problem(
                ("device", "changes", "tags", number),
                f"{text}{one_of_words(trocar.tools)}, or none",
            )
