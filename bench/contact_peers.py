"""Prints a part of docs/measured/contact.md: other programs beside tissu on scenes of contact.

    python bench/contact_peers.py [--python PATH] [--newton PATH] [--write] [SCENE …]

The scenes are cube, stack, stick, slide and rest of `tissu bench contact`, on meshes of tetrahedra
that all programs share. MuJoCo, Rapier and Newton run in the Python that --python names, this one
where it is left out; a program that is not there is named as such. All take turns of a few steps
in one run, each in a process of its own, on one thread. Without a scene all run, which takes a
quarter of an hour; a page names those that were run.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

import numpy as np

import tissu as ts
from tissu import scene as parts
from tissu.contact_cost import CASES

sys.path.insert(0, str(Path(__file__).resolve().parent))
from contact_peer_rows import (
    CROSSED,
    IMPACT,
    NEAR,
    RESTS,
    STICKS,
    TOUCHING,
    WINDOW,
    facts,
    head_of,
    name_of,
    program_of,
    row,
)  # fmt: skip
from kernels import commit, measured_at, table
from peer_contact_work import SETUPS
from peer_turns import Subject, Taken, side_by_side
from peer_work import Work
from section import MEASURED, put_between

PAGE = MEASURED / "contact.md"
DT, TURN = 0.01, 5  # s, and steps at a time
STEPS = {"stack": 200, "rest": 40}  # for which all of the scene takes the peers long
RUN = [
    ("contact_tissu", "defaults"),
    ("contact_rapier", "defaults"),
    ("contact_rapier", "best"),
    ("contact_mujoco", "defaults"),
    ("contact_mujoco", "best"),
    ("contact_newton", "defaults"),
    ("contact_newton", "best"),
]

TEXT = """The programs got the same meshes of tetrahedra (those of the slopes are cut from the
hexahedra, also for tissu), the same material, density, gravity and friction, and took turns of
{turn} steps of 10 ms, each on one thread. "best" are the best settings that a short search by
hand found. Times are CPU time of 10 ms of the scene in which something touches. **plane** is
the depth of the lowest node inside the thickness that a program gives its surfaces, **joints**
that between bodies, and **crosses by** is the largest depth of a node below the plane itself or
inside another body, in the whole run; all are measured from the positions of the nodes after
each 10 ms, in mean edges.
{versions}

{tables}

{settings}

"at impact" are the {impact} steps from the first contact on; "at the end" are the last {window}
steps, or half of a shorter run. {shorter} "force error" is that of the mean force on the floor
at the end, "its worst" that of a single step. A body that crosses by more than {crossed:g} % of
an edge interpenetrates. One that moves along the plane more slowly than {rests:g} mm/s rests,
and one that moves more slowly than {sticks:g} mm/s sticks to the slope. One that slides does so
within {near:g} % of Coulomb's acceleration, and hops if it touches in less than {touching:g} %
of the steps at the end. One gains energy if its kinetic energy and that of gravity rise above
the start by more than its weight times 5 cm. "unsolved" are the steps, also inner ones, that a
program itself reports as not solved.

MuJoCo has damping in proportion to mass and stiffness like tissu. Rapier has that of the mass
and its own elastic damping, computes in single precision, and runs in decimetres, because it
gives no elasticity to cells as small as these in metres. Newton has a viscosity of the shear
modulus times the same time constant, none of the mass, and computes in single precision. The
flexes of MuJoCo and the particles of Newton are given a thickness because their defaults, 5 mm
and 0.1 m, are wider than the gaps of 1 mm between the cubes at the start.

Printed by `python bench/contact_peers.py{scenes} --write`; {machine}"""


def work_of(scene: str) -> Work:
    """The tetrahedra of all bodies of a scene."""
    points, tetrahedra, count = [], [], 0
    for body in CASES[scene]().scene().bodies.values():
        shape = body.mesh
        assert isinstance(shape, parts.BarMesh)
        given = {"size": shape.size, "cells": shape.cells, "origin": shape.origin}
        mesh = ts.bar_mesh(cell="tetra", **given)  # type: ignore[arg-type]
        points.append(np.array(mesh.points))
        tetrahedra.append(np.array(mesh.cells[0].nodes) + count)
        count += len(mesh.points)
    return Work(np.concatenate(points), np.concatenate(tetrahedra), DT)


def steps_of(scene: str) -> int:
    """How many of 10 ms."""
    return STEPS.get(scene, round((CASES[scene]().scene().duration or 0.0) / DT))


def title(scene: str, work: Work) -> str:
    """Of a table."""
    return f"{CASES[scene]().name} ({len(work.tetrahedra):,} tetrahedra):"


def versions_of(taken: dict[Subject, Taken]) -> str:
    """A sentence."""
    known = {program_of(s): t.version for s, t in taken.items() if t.version}
    missing = {program_of(s) for s, t in taken.items() if t.why.startswith("not installed")}
    text = ", ".join(f"{name} {version}" for name, version in known.items())
    return f"{text}." + (f" Not installed: {', '.join(sorted(missing))}." if missing else "")


def section(scenes: list[str], pythons: dict[str, str]) -> str:
    """All of it; `pythons` as `side_by_side` takes them."""
    tables, every = [], {}
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "work.npz"
        for scene in scenes:
            work = work_of(scene)
            work.write(file)
            subjects = [Subject(program, f"{scene}; {settings}") for program, settings in RUN]
            taken = side_by_side(subjects, pythons, file, steps=steps_of(scene), turn=TURN)
            every.update(taken)
            rows = [row(work, subject, of) for subject, of in taken.items()]
            tables.append(f"{title(scene, work)}\n\n{table(head_of(scene), rows)}")
            print(tables[-1], file=sys.stderr, flush=True)
    said = {name_of(s): f"{facts(s).law}; {facts(s).step}" for s in every}
    return TEXT.format(
        turn=TURN,
        versions=versions_of(every),
        tables="\n\n".join(tables),
        settings="\n".join(f"- {name}: {text}." for name, text in said.items()),
        impact=IMPACT,
        window=WINDOW,
        shorter=" ".join(
            f'"{s}" is run for {DT * n:g} s.' for s, n in STEPS.items() if s in scenes
        ),
        crossed=100.0 * CROSSED,
        rests=1e3 * RESTS,
        sticks=1e3 * STICKS,
        near=100.0 * NEAR,
        touching=100.0 * TOUCHING,
        scenes="" if scenes == list(SETUPS) else " " + " ".join(scenes),
        machine=measured_at(),
    )


def main() -> int:
    """Runs, prints or writes."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=", ".join(SETUPS))
    parser.add_argument("--python", default=sys.executable, help="in which the peers are installed")
    parser.add_argument("--newton", help="the Python in which newton is; else that of --python")
    parser.add_argument("--write", action="store_true", help="to docs/measured/contact.md")
    asked = parser.parse_args()
    unknown = [scene for scene in asked.scenes if scene not in SETUPS]
    if unknown:
        parser.error(f"found scene '{unknown[0]}'; {', '.join(SETUPS)} are accepted")
    if asked.write and commit().endswith("-dirty"):
        print("contact_peers: the page names its commit; commit all changes first", file=sys.stderr)
        return 1
    pythons = {program: asked.python for program, _ in RUN if program != "contact_tissu"}
    pythons["contact_newton"] = asked.newton or asked.python
    text = section(asked.scenes or list(SETUPS), pythons)
    if asked.write:
        put_between(PAGE, "bench/contact_peers.py", f"\n{text}\n\n")
    else:
        print(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
