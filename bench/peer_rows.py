"""Lines of docs/measured/peers.md, from what the programs took."""

from __future__ import annotations

from importlib import import_module
from typing import Any

import numpy as np
from kernels import digits
from peer_turns import Subject, Taken
from peer_work import CUBE, SIDE, Facts

NAMES = {"tissu": "tissu", "mujoco": "MuJoCo", "rapier": "Rapier", "taichi": "Taichi"}
IMPACT, WINDOW = 20, 50  # steps from the first contact on, and at the end
TIMES = ["p50, ms", "p99, ms"]
IMPLICIT_HEAD = ["", "law", "first, ms", *TIMES, "off at the end", "off, all steps", "unsolved"]
EXPLICIT_HEAD = ["", "law", *TIMES, "from tissu's tip"]
DROPPED_HEAD = ["", "law", "without, ms", *TIMES, "at impact", "at rest", "force", "unsolved"]


def facts(subject: Subject) -> Facts:
    """What is said of it."""
    found = import_module(f"peer_{subject.program}").WAYS[subject.way]
    assert isinstance(found, Facts)
    return found


def share(value: float) -> str:
    """As a percentage of two digits."""
    return f"{100.0 * value:.2g} %"


def name_of(subject: Subject) -> str:
    """In the tables."""
    return f"{NAMES[subject.program]}, {subject.way}"


def unsolved(taken: Taken) -> str:
    """How many steps it says are not solved."""
    return "does not say" if taken.unsolved is None else str(taken.unsolved)


def ended(subject: Subject, taken: Taken, head: list[str]) -> list[str]:
    """A row without numbers, with the reason."""
    return [name_of(subject), taken.why, *[""] * (len(head) - 2)]


def implicit_row(subject: Subject, taken: Taken, reference: Any) -> list[str]:
    """A line of the table of implicit steps."""
    if taken.why:
        return ended(subject, taken, IMPLICIT_HEAD)
    end, over = taken.errors(reference)
    times = [digits(ms) for ms in (taken.first, taken.p(50), taken.p(99))]
    return [name_of(subject), facts(subject).law, *times, share(end), share(over), unsolved(taken)]


def explicit_row(subject: Subject, taken: Taken, against: Taken) -> list[str]:
    """A line of the table of explicit steps; `against` has the tips to compare with."""
    if taken.why:
        return ended(subject, taken, EXPLICIT_HEAD)
    away = share(taken.errors(against.seen)[0]) if not against.why else ""
    return [name_of(subject), facts(subject).law, digits(taken.p(50)), digits(taken.p(99)), away]


def dropped_row(subject: Subject, taken: Taken, bare: Taken, weight: float) -> list[str]:
    """A line of the table of the cube: its steps from the first contact on.

    Args:
        subject: of the line.
        taken: of it.
        bare: of the same cube that falls for ever.
        weight: of the cube [N].
    """
    if taken.why:
        return ended(subject, taken, DROPPED_HEAD)
    depth, force = np.array(taken.seen).T
    first = int(np.argmax(force > 0.0))
    p50, p99 = np.percentile(np.array(taken.ms)[first:], (50, 99))
    without = bare.p(50) if not bare.why else float("nan")
    edge = SIDE / CUBE
    off = abs(float(force[-WINDOW:].mean()) / weight - 1.0)
    deep = [share(float(of.max()) / edge) for of in (depth[first:][:IMPACT], depth[-WINDOW:])]
    times = [digits(ms) for ms in (without, float(p50), float(p99))]
    return [name_of(subject), facts(subject).law, *times, *deep, share(off), unsolved(taken)]


def listed(subjects: list[Subject], what: str) -> str:
    """What the facts say, a line each."""
    said = {name_of(s): getattr(facts(s), what) for s in subjects if getattr(facts(s), what)}
    return "\n".join(f"- {name}: {text}." for name, text in said.items())


def versions_of(found: dict[Subject, Taken]) -> str:
    """A sentence."""
    known = {NAMES[s.program]: taken.version for s, taken in found.items() if taken.version}
    missing = {NAMES[s.program] for s, taken in found.items() if taken.why.startswith("not inst")}
    text = ", ".join(f"{name} {version}" for name, version in known.items())
    return f"{text}." + (f" Not installed: {', '.join(sorted(missing))}." if missing else "")
