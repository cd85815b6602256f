"""What a scene may ask of its contacts: names, and which method runs with which step."""

from __future__ import annotations

import contextlib
import itertools
import math
from collections.abc import Iterator
from typing import Any

from tissu.counted import counted
from tissu.scene.contact import Contact, ContactSettings, Meeting
from tissu.scene.problem import Path, Problem, nearest, one_of_words
from tissu.scene.tissue import tissues_of
from tissu.scene.unknown import Unknown

_EXPLICIT = ("symplectic_euler", "explicit_euler", "rk2", "rk4")
_IMPLICIT = ("implicit_euler", "bdf2", "implicit_midpoint", "newmark", "energy_momentum")
STEPS_OF_METHOD: dict[str, tuple[str, ...]] = {
    "augmented": (*_IMPLICIT, "static"),
    "impulse": _EXPLICIT,
    "penalty": (*_EXPLICIT, "implicit_euler", "bdf2", "static"),
    "barrier": ("implicit_euler", "bdf2", "static"),
    "geometric": _EXPLICIT,
}
"""Contact method -> the steps that have it; `auto` takes the first method that the step has.

Contact in steps without damping ends with impulses that take all that springs would give back.
"""
STEPS_OF_FREE: tuple[str, ...] = ("implicit_euler", "bdf2", *_EXPLICIT)
"""the steps that move obstacles with a mass"""
FIELDS_OF_METHOD: dict[str, tuple[str, ...]] = {
    "impulse": ("restitution",),
    "penalty": ("restitution", "stiffness"),
}
"""Contact method -> the fields of a contact that it alone has."""
LEAST_RESTITUTION = math.exp(-2.0)
"""what a damper that does not pull gives back at least (Schwager, Poeschel 2007)"""


def has_free(scene: Any) -> bool:
    """Whether an obstacle has a mass, as far as that is known."""
    with contextlib.suppress(Unknown):
        for obstacle in scene.obstacles.values():
            with contextlib.suppress(Unknown):
                if obstacle.mass is not None:
                    return True
    return False


def method_of(scene: Any) -> str | None:
    """The contact method that the scene's step runs; None where it has none."""
    settings = scene.contact or ContactSettings()
    runs = [name for name, steps in STEPS_OF_METHOD.items() if scene.step.type in steps]
    if settings.method == "auto":
        return runs[0] if runs else None
    return settings.method if settings.method in runs else None


def contact_problems(scene: Any) -> Iterator[Problem]:
    """What is wrong with the contacts of a scene, whose other fields may have problems."""
    contacts = getattr(scene, "contacts", ())
    met: dict[frozenset[str], int] = {}
    for number, contact in enumerate(contacts):
        with contextlib.suppress(Unknown):
            for problem in _named(scene, contact, number, met):
                yield Problem(("contacts", number, *problem.path), problem.text)
    if not contacts and hasattr(scene, "contacts") and has_free(scene):
        text = "found an obstacle with a mass and no contacts, without which nothing moves it; add "
        yield Problem(("contacts",), f"{text}a contact of it, such as {{between: all}}")
    alls = [n for n, contact in enumerate(contacts) if getattr(contact, "between", "") == "all"]
    for number in alls[1:]:
        text = f"found all a second time, in addition to contacts[{alls[0]}]; once is accepted"
        yield Problem(("contacts", number, "between"), text)
    if contacts:
        with contextlib.suppress(Unknown):
            yield from _method_problems(scene)
    for check in (_surface_of_problems, _turning_problems, _flat_problems):
        with contextlib.suppress(Unknown):
            yield from check(scene)


def _surface_of_problems(scene: Any) -> Iterator[Problem]:
    """Meshes for the surfaces of bodies that are not there."""
    for name in scene.contact.surface_of if scene.contact is not None else ():
        place: Path = ("contact", "surface_of", name)
        if name in tissues_of(scene):
            text = f"found '{name}', a tissue, which meets others with the surface that it fills; "
            yield Problem(place, f"{text}a body is accepted")
        elif name not in scene.bodies:
            text = f"no body is named '{name}'{nearest(name, scene.bodies)} Accepted: "
            yield Problem(place, f"{text}{one_of_words(scene.bodies)}")
        else:
            if not any(_names(contact, name) for contact in scene.contacts):
                text = f"found a surface of '{name}', which no contact names; write it in contacts"
                yield Problem(place, f"{text}, or leave the surface out")


def _turning_problems(scene: Any) -> Iterator[Problem]:
    """Surfaces that rotations carry, in scenes with trocars."""
    if not getattr(scene, "trocars", {}):
        return
    own = scene.contact.surface_of if scene.contact is not None else ()
    turning: dict[str, Path] = {
        name: ("contact", "surface_of", name)
        for name in own
        if name in scene.bodies and scene.bodies[name].has_rotations
    }
    turning |= {name: ("contacts",) for name in tissues_of(scene) if meets_others(scene, name)}
    for name, place in turning.items():
        text = f"found '{name}' with trocars, whose hands feel what the places of nodes carry; the "
        text += f"surface of '{name}' follows rotations, too: leave it out of contact"
        yield Problem(place, text)


def _names(contact: Any, body: str) -> bool:
    """Whether a contact is one of a body."""
    if not isinstance(contact, Contact):
        return bool(contact.self == body)
    return contact.between == "all" or any(
        body in (first, second) for _, first, _, second in contact.pairs()
    )


def _named(
    scene: Any, contact: Any, number: int, met: dict[frozenset[str], int]
) -> Iterator[Problem]:
    """Names that nothing has, and pairs that are none."""
    if not isinstance(contact, Contact):
        found = list(_nameless(scene, ("self",), contact.self, obstacles=False))
        yield from found or _once(met, ("self",), contact.self, contact.self, number)
        return
    if contact.between == "all":
        yield from _all_problems(scene, contact)
        return
    told: set[Path] = set()
    for at, first, then, second in contact.pairs():
        missing = [p for place, name in ((at, first), (then, second)) for p in
                   _nameless(scene, place, name, obstacles=True)]  # fmt: skip
        yield from (problem for problem in missing if problem.path not in told)
        told.update(problem.path for problem in missing)
        if missing:
            continue
        wrong = list(_no_pair(scene, then, first, second))
        yield from wrong or _once(met, then, first, second, number)
    if contact.on is not None and contact.pairs()[0][1] in _obstacles(scene):
        text = f"found nodes of '{contact.pairs()[0][1]}', which is an obstacle; `on` selects "
        yield Problem(("on",), f"{text}nodes of the first: write the body first")


def _obstacles(scene: Any) -> dict[str, Any]:
    """The obstacles by name, but for those that have the name of a body or tissue too."""
    others = {**scene.bodies, **tissues_of(scene)}
    return {name: one for name, one in scene.obstacles.items() if name not in others}


def _nameless(scene: Any, place: Path, name: str, *, obstacles: bool) -> Iterator[Problem]:
    """A name that nothing has, or whose surface is not there yet."""
    bodies, tissue = scene.bodies, tissues_of(scene)
    known = {**bodies, **tissue, **(_obstacles(scene) if obstacles else {})}
    if name not in known:
        what = "body or obstacle" if obstacles else "body"
        text = f"no {what} is named '{name}'{nearest(name, known)} Accepted: {one_of_words(known)}"
        yield Problem(place, text)
        return
    missing = surface_missing(scene, name)
    if missing:
        yield Problem(place, f"found '{name}', {missing}")


def surface_missing(scene: Any, name: str) -> str:
    """Why a body or tissue has no surface for contact; empty: it has one."""
    tissue = tissues_of(scene).get(name)
    if tissue is not None and tissue.inside is None:
        return "a tissue between bodies, which has no surface; one with `inside` is accepted"
    return ""


def _flat_problems(scene: Any) -> Iterator[Problem]:
    """What the rims of flat bodies do not have: areas."""
    flat = {name for name, body in scene.bodies.items() if body.plane is not None}
    for number, contact in enumerate(scene.contacts):
        with contextlib.suppress(Unknown):
            names = flat & _names_of(contact, scene)
            if names and contact.stiffness is not None:
                text = (
                    f"found {contact.stiffness:g} Pa/m for '{min(names)}', a flat body, whose rim "
                )
                text += "has no area; leave it out: the stiffness then comes from the body"
                yield Problem(("contacts", number, "stiffness"), text)


def _names_of(contact: Any, scene: Any) -> set[str]:
    """The names that a contact has, of bodies and obstacles."""
    if not isinstance(contact, Contact):
        return {contact.self}
    if contact.between == "all":
        return set(scene.bodies)
    return {name for _, first, _, second in contact.pairs() for name in (first, second)}


def meets_others(scene: Any, name: str) -> bool:
    """Whether a contact of the scene names a body."""
    for contact in getattr(scene, "contacts", ()):
        with contextlib.suppress(Unknown):
            if not isinstance(contact, Contact):
                named = contact.self == name
            else:
                named = contact.between == "all" or any(
                    name in (first, second) for _, first, _, second in contact.pairs()
                )
            if named:
                return True
    return False


def _no_pair(scene: Any, place: Path, first: str, second: str) -> Iterator[Problem]:
    if first == second:
        text = f"found '{first}' twice; a body that meets itself is written {{self: {first}}}"
        yield Problem(place, text)
    elif first in _obstacles(scene) and second in _obstacles(scene):
        if any(_obstacles(scene)[name].mass is not None for name in (first, second)):
            return
        text = f"found the obstacles '{first}' and '{second}', of which a contact moves neither; "
        yield Problem(place, f"{text}a pair with a body is accepted, or give one of them a mass")


def _once(
    met: dict[frozenset[str], int], place: Path, first: str, second: str, number: int
) -> Iterator[Problem]:
    """Each pair of names has one contact."""
    pair = frozenset((first, second))
    if pair not in met:
        met[pair] = number
        return
    both = f"'{first}' with itself" if first == second else f"'{first}' and '{second}'"
    text = f"found {both} in contacts[{met[pair]}] too; each pair once is accepted"
    yield Problem(place, text)


def _all_problems(scene: Any, contact: Contact) -> Iterator[Problem]:
    for name in (*scene.bodies, *tissues_of(scene)):
        with contextlib.suppress(Unknown):
            missing = surface_missing(scene, name)
            if missing:
                text = f"found all, and among the bodies '{name}', {missing.split(',')[0]}"
                yield Problem(("between",), f"{text}; name the pairs that meet instead")
    if contact.on is not None:
        text = "found `on` with all, which has no first body; name the pairs, or leave `on` out"
        yield Problem(("on",), text)


def _method_problems(scene: Any) -> Iterator[Problem]:
    """A method that is not there, or not for this step; fields that it does not have."""
    settings, step = scene.contact or ContactSettings(), scene.step.type
    there = one_of_words(STEPS_OF_METHOD)
    if settings.method not in ("auto", *STEPS_OF_METHOD):
        text = f"found {settings.method}, which is not there yet; accepted: auto, {there}"
        yield Problem(("contact", "method"), text)
        return
    method = method_of(scene)
    if method is None:
        wanted = settings.method
        steps = STEPS_OF_METHOD.get(wanted) or dict.fromkeys(
            step for steps in STEPS_OF_METHOD.values() for step in steps
        )
        asked = "" if wanted == "auto" else f" of the method {wanted}"
        count = counted(len(scene.contacts), "contact")
        text = f"found {step} with {count}{asked}; accepted with contact: {one_of_words(steps)}"
        yield Problem(("step",), text)
        return
    yield from _free_problems(scene, step)
    yield from _settings_problems(settings, method)
    if getattr(scene.step, "arc_length", False):
        text = "found true with contacts, which an arc length does not follow; leave it out"
        yield Problem(("step", "arc_length"), text)
    for number, contact in enumerate(scene.contacts):
        with contextlib.suppress(Unknown):
            bounceless = _bounceless(scene, contact, method, step)
            for problem in itertools.chain(_field_problems(contact, method, step), bounceless):
                yield Problem(("contacts", number, *problem.path), problem.text)


def _free_problems(scene: Any, step: str) -> Iterator[Problem]:
    """Obstacles with a mass: which steps move them."""
    if step in STEPS_OF_FREE:
        return
    for name, obstacle in scene.obstacles.items():
        with contextlib.suppress(Unknown):
            if obstacle.mass is not None:
                text = f"found {obstacle.mass:g} kg with the step {step}, which moves no free "
                steps = one_of_words(STEPS_OF_FREE)
                yield Problem(("obstacles", name, "mass"), f"{text}obstacle; accepted: {steps}")


def _settings_problems(settings: ContactSettings, method: str) -> Iterator[Problem]:
    if settings.penalty != "linear" and method != "penalty":
        text = f"found {settings.penalty} with the method {method}, which has no such law; "
        yield Problem(("contact", "penalty"), f"{text}leave it out, or take the method penalty")
    if method == "barrier" and not settings.travel:
        text = "found false with the method barrier, which holds surfaces apart on free ways "
        yield Problem(("contact", "travel"), f"{text}alone; leave it out")
    if settings.overlap == "separate" and not settings.travel:
        text = "found separate with travel: false, which refuses no overlap; leave one of them out"
        yield Problem(("contact", "overlap"), text)
    if settings.broad_phase == "fcl" and not _has_fcl():
        text = "found fcl, which this build of tissu is without; hierarchy, sweep_and_prune, grid "
        yield Problem(("contact", "broad_phase"), f"{text}and octree are accepted")


def _has_fcl() -> bool:
    from tissu._core import build_info

    return any(str(name).lower() == "fcl" for name in build_info()["libraries"])


def _bounceless(scene: Any, contact: Meeting, method: str, step: str) -> Iterator[Problem]:
    """Before obstacles with a mass, explicit springs need bodies, and others are not there."""
    e = contact.restitution
    if method != "penalty" or e is None or step == "static" or not isinstance(contact, Contact):
        return
    if contact.stiffness is not None or (step in _EXPLICIT and scene.bodies):
        return
    pairs = {name for _, a, _, b in contact.pairs() for name in (a, b)} or scene.obstacles
    free = [name for name in pairs if getattr(scene.obstacles.get(name), "mass", None) is not None]
    if free:
        steps = "implicit steps" if scene.bodies else "a scene without bodies"
        text = f"found {e:g}, but '{min(free)}' has a mass and the method penalty has no springs "
        yield Problem(
            ("restitution",),
            f"{text}for it in {steps}: leave it out, or take impulse in explicit steps",
        )


def _field_problems(contact: Meeting, method: str, step: str) -> Iterator[Problem]:
    """Fields that the method that runs does not have."""
    for name in ("restitution", "stiffness"):
        value = getattr(contact, name)
        if not value:
            continue
        having = [m for m, fields in FIELDS_OF_METHOD.items() if name in fields]
        if method not in having:
            text = f"found {name} {value:g}, which the method {method} does not "
            text += f"have, but {' and '.join(having)} alone; leave it out"
            yield Problem((name,), text)
    e = contact.restitution
    if method == "penalty" and e is not None and step == "static":
        text = f"found {e:g} in a static step, in which nothing meets at a speed; leave it out"
        yield Problem(("restitution",), text)
    elif method == "penalty" and e is not None and e < LEAST_RESTITUTION:
        text = f"found {e:g}, but a damper that does not pull gives back at least "
        other = ", or take impulse" if step in _EXPLICIT else ""
        text += f"{LEAST_RESTITUTION:.4f}; that to 1 is accepted: leave it out{other}"
        yield Problem(("restitution",), text)
