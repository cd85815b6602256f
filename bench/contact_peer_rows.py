"""Lines of the tables of bench/contact_peers.py, from what the programs took."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import Any

import numpy as np
from kernels import digits
from peer_contact_work import GRAVITY, SETUPS, SIDE, Bodies, Noted, split
from peer_turns import Subject, Taken
from peer_work import Facts, Work

NAMES = {"tissu": "tissu", "rapier": "Rapier", "mujoco": "MuJoCo", "newton": "Newton"}
IMPACT, WINDOW = 20, 50  # steps from the first contact on, and at most so many at the end
CROSSED = 1e-3  # of an edge: what crosses deeper interpenetrates
STICKS, RESTS = 1e-4, 1e-3  # m/s, the fastest creep of what sticks on a slope or rests on a plane
TOUCHING = 0.9  # of the steps at the end: what slides and touches in fewer hops
NEAR = 0.05  # of Coulomb's acceleration: what slides within it slides as it should


def program_of(subject: Subject) -> str:
    """Its name."""
    return NAMES[subject.program.removeprefix("contact_")]


def name_of(subject: Subject) -> str:
    """In the tables."""
    return f"{program_of(subject)}, {split(subject.way)[1]}"


def facts(subject: Subject) -> Facts:
    """What is said of its settings."""
    found = import_module(f"peer_{subject.program}").WAYS[split(subject.way)[1]]
    assert isinstance(found, Facts)
    return found


@dataclass(frozen=True)
class Measures:
    """What came of a run, depths in mean edges.

    Attributes:
        steps: CPU time of 10 ms in which something touches [ms]: p50, p99.
        plane: depth in the thickness above the plane: in the impact, and at the end.
        joint: the same between bodies.
        crosses: the deepest beyond the plane or inside another body, in the whole run.
        force: relative error of the force on the floor at the end: of its mean, and the worst.
        creep: of the fastest body along the plane at the end [m/s].
        slides: acceleration at the end over Coulomb's; nan: nothing should slide.
        touching: share of the steps at the end in which something touches.
        gained: most energy above the start, over the weight times the side of a cube.
        fell: whether a body has left its place in the stack.
    """

    steps: tuple[float, float]
    plane: tuple[float, float]
    joint: tuple[float, float]
    crosses: float
    force: tuple[float, float]
    creep: float
    slides: float
    touching: float
    gained: float
    fell: bool


def measures(work: Work, way: str, taken: Taken) -> Measures:
    """Of a run that has steps with a contact."""
    setup = split(way)[0]
    bodies, seen = Bodies(work, setup), np.array(taken.seen)
    touches = seen[:, Noted.TOUCHES] > 0.0
    first, last = int(np.argmax(touches)), min(WINDOW, len(seen) // 2)
    p50, p99 = np.percentile(np.array(taken.ms)[touches], (50, 99))
    impact, end = seen[first:][:IMPACT], seen[-last:]
    weight = -setup.gravity[2] * float(bodies.masses.sum())
    force = end[:, Noted.FORCE] / weight - 1.0
    centres = end[:, Noted.CENTRES :].reshape(last, -1, 3)
    seconds = work.dt * (last - 1)
    away = np.linalg.norm(centres[-1, :, :2] - centres[0, :, :2], axis=1)
    speed = np.diff(centres[:, 0, 0]) / work.dt
    gained = float(np.polyfit(work.dt * np.arange(len(speed)), speed, 1)[0])
    cosine = 1.0 / float(np.hypot(1.0, setup.tangent))
    should = GRAVITY * cosine * (setup.tangent - setup.friction)
    moved = np.abs(centres[-1] - bodies.points.mean(axis=1)).max()

    def deep(what: Noted) -> tuple[float, float]:
        return float(impact[:, what].max()) / bodies.edge, float(end[:, what].max()) / bodies.edge

    return Measures(
        steps=(float(p50), float(p99)),
        plane=deep(Noted.PLANE),
        joint=deep(Noted.JOINT),
        crosses=float(seen[:, Noted.CROSSES].max()) / bodies.edge,
        force=(abs(float(force.mean())), float(np.abs(force).max())),
        creep=float(away.max()) / seconds,
        slides=gained / should if should > 0.0 and setup.tangent else float("nan"),
        touching=float(touches[-last:].mean()),
        gained=float(seen[:, Noted.GAINED].max()) / (weight * SIDE),
        fell=bool(moved > SIDE / 2.0),
    )


def outcome(scene: str, found: Measures) -> str:
    """In words."""
    if found.gained > 1.0:
        word = "gains energy"
    elif scene == "stack":
        word = "falls" if found.fell else "stands"
    elif scene == "slide":
        word = "slides" if abs(found.slides - 1.0) < NEAR else "slides at another rate"
        word += "" if found.touching > TOUCHING else " and hops"
    elif scene == "stick":
        word = "sticks" if found.creep < STICKS else "creeps"
    else:
        word = "rests" if found.creep < RESTS else "drifts"
    return word if found.crosses < CROSSED else f"{word}, interpenetrates"


def head_of(scene: str) -> list[str]:
    """Of the table of a scene."""
    joints = ["joints at impact", "joints at the end"] if SETUPS[scene].bodies > 1 else []
    moves = "sliding" if scene == "slide" else "creep, mm/s"
    depths = ["plane at impact", "plane at the end", *joints, "crosses by"]
    forces = ["force error", "its worst"]
    return ["", "p50, ms", "p99, ms", *depths, *forces, moves, "unsolved", "outcome"]


def row(work: Work, subject: Subject, taken: Taken) -> list[str]:
    """A line under `head_of`."""
    scene = subject.way.partition("; ")[0]
    head = head_of(scene)
    finite = taken.why == "" and len(taken.seen) > 2
    if not finite or not np.array(taken.seen)[:, Noted.TOUCHES].any():
        why = taken.why or "nothing touched"
        why = "explodes: " + why if "finite" in why else why
        return [name_of(subject), *[""] * (len(head) - 2), why]
    found = measures(work, subject.way, taken)
    depths = [*found.plane, *(found.joint if "joints at impact" in head else ()), found.crosses]
    moves = f"{found.slides:.4f}" if scene == "slide" else f"{1e3 * found.creep:.2g}"
    reports = bool(np.array(taken.seen)[:, Noted.FORCE].any())
    return [
        name_of(subject),
        *map(digits, found.steps),
        *map(share, depths),
        *(map(share, found.force) if reports else ("does not say", "")),
        moves,
        "does not say" if taken.unsolved is None else str(taken.unsolved),
        outcome(scene, found),
    ]


def share(value: Any) -> str:
    """As a percentage of two digits."""
    return f"{100.0 * value:.2g} %"
