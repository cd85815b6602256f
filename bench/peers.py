"""Prints docs/measured/peers.md: programs from the package index beside tissu, on the same work.

    python bench/peers.py [--python PATH] [--steps N] [--write]
    python bench/peers.py --reference

MuJoCo, Rapier and Taichi run in the Python that --python names, this one where it is left out;
tissu runs in this one. A program that is not there is named as such. All are given the same mesh
and take turns of a few steps in one run, each in a process of its own, on one thread.

--reference computes bench/peers_reference.json anew, with which the tips are compared; minutes.
"""

from __future__ import annotations

import argparse
import datetime
import json
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

import tissu as ts
from tissu.cli.info import machine_line

sys.path.insert(0, str(Path(__file__).resolve().parent))
from kernels import commit, table
from peer_rows import (
    DROPPED_HEAD,
    EXPLICIT_HEAD,
    IMPACT,
    IMPLICIT_HEAD,
    WINDOW,
    dropped_row,
    explicit_row,
    implicit_row,
    listed,
    name_of,
    versions_of,
)  # fmt: skip
from peer_tissu import Bar
from peer_turns import Subject, Taken, side_by_side
from peer_work import CUBE, GRAVITY, HEIGHT, SIDE, SIZE, Work

ROOT = Path(__file__).resolve().parents[1]
PAGE, REFERENCE = ROOT / "docs" / "measured" / "peers.md", ROOT / "bench" / "peers_reference.json"
BEGIN, END = "<!-- bench/peers.py -->", "<!-- end of bench/peers.py -->"
PEERS = ("mujoco", "rapier", "taichi")
SIZES = {"10,368 tetrahedra": (48, 6, 6), "48,000 tetrahedra": (80, 10, 10)}
IMPLICIT = [
    *(Subject("tissu", way) for way in ("all defaults", "tolerance 1e-6")),
    *(Subject("tissu", way) for way in ("four steps of 2.5 ms", "BDF2")),
    *(Subject("rapier", "defaults"), Subject("mujoco", "discrete")),
]
DROPPED = [
    *(Subject(program, "dropped") for program in ("tissu", "rapier", "mujoco")),
    Subject("mujoco", "dropped, stiff contacts"),
]
FALLING = [Subject(program, "falling") for program in ("tissu", "rapier", "mujoco")]
EXPLICIT = [Subject(program, "explicit") for program in ("tissu", "taichi", "mujoco")]
EVERY = [*IMPLICIT, *EXPLICIT, *DROPPED]
DT, SHORT = 0.01, 2e-4  # s, of an implicit and an explicit step
STEPS, TURN = 100, 5  # implicit; explicit ones take ten times as many
FINER = 8  # steps of the reference for one of 10 ms


def bar(cells: tuple[int, int, int], dt: float) -> Work:
    """The bar, each cube cut into six tetrahedra."""
    mesh = ts.bar_mesh(size=SIZE, cells=cells, cell="tetra")
    return Work(np.array(mesh.points), np.array(mesh.cells[0].nodes), dt)


def cube() -> Work:
    """1,296 tetrahedra, 2 cm above the plane z = 0."""
    cells = (CUBE, CUBE, CUBE)
    mesh = ts.bar_mesh(size=(SIDE,) * 3, cells=cells, cell="tetra", origin=(0, 0, HEIGHT))
    return Work(np.array(mesh.points), np.array(mesh.cells[0].nodes), DT)


def reference_of(cells: tuple[int, int, int], steps: int, finer: int = FINER) -> list[list[float]]:
    """Tips (steps, 3) [m] after each 10 ms: BDF2 in short steps, each iterated to 1e-8."""
    running = Bar(bar(cells, DT / finer), "reference")
    tips = []
    for _ in range(steps):
        for _ in range(finer):
            running.step()
        tips.append([round(u, 9) for u in running.seen()])
    if running.unsolved():
        raise SystemExit(f"{running.unsolved()} steps of the reference did not converge")
    return tips


TEXT = """Each table is one run: the programs took turns of {turn} implicit steps or {many} explicit
ones, on one thread; times are CPU time of a step without the first. {versions}

{tables}

"off" of a bar is the distance of the middle of the free end from the reference, as a share of its
largest displacement: after {seconds:g} s, and as the root of the mean square over all steps. The
reference is the same mesh under St-Venant–Kirchhoff in steps of {fine:g} ms by BDF2. This error is
that of a program's time step, solver and law together. "unsolved" are the steps that the program
itself reports as not solved to its own tolerance.

The cube of 5 cm, E = 100 kPa, falls 2 cm. Its times are those of the steps from the first contact
on. "without" are those of the same cube if it meets no plane. "at impact" and "at rest" are the
depth of its lowest node in the plane, beyond the thickness that the program itself gives the
plane, in edges of 8.3 mm: the largest of {impact} steps from the first contact on, and of the last
{window} steps. "force" is the relative difference between the weight and the program's force on
the plane, as a mean over the last {window} steps.

{steps}

{lacks}

{machine}"""


def section(found: dict[str, dict[Subject, Taken]], references: dict[str, Any], steps: int) -> str:
    """All of it, from what `measured` gave."""
    tables, every = [], {}
    for name, taken in found.items():
        every.update(taken)
        size, kind = name.split("; ")
        if kind == "dropped":
            weight = GRAVITY * float(cube().masses.sum())
            rows = [
                dropped_row(s, t, taken[Subject(s.program, "falling")], weight)
                for s, t in taken.items()
                if s.way != "falling"
            ]
            tables.append(f"### {size}, dropped on a plane\n\n{table(DROPPED_HEAD, rows)}")
        elif kind == "implicit":
            rows = [implicit_row(s, t, references[size]) for s, t in taken.items()]
            tables.append(f"### {size}, a step of 10 ms\n\n{table(IMPLICIT_HEAD, rows)}")
        else:
            tissu = taken[Subject("tissu", "explicit")]
            rows = [explicit_row(s, t, tissu) for s, t in taken.items()]
            tables.append(f"### {size}, an explicit step of 0.2 ms\n\n{table(EXPLICIT_HEAD, rows)}")
    where = f"{machine_line()} Commit {commit()}, {datetime.date.today()}."
    return TEXT.format(
        turn=TURN,
        many=10 * TURN,
        versions=versions_of(every),
        tables="\n\n".join(tables),
        fine=1e3 * DT / FINER,
        seconds=steps * DT,
        impact=IMPACT,
        window=WINDOW,
        steps=listed(EVERY, "step"),
        lacks="These features of tissu are missing in the other programs:\n\n"
        + listed(EVERY, "lacks"),
        machine=f"Printed by `python bench/peers.py --write`; {where}",
    )


def runs(sizes: dict[str, Any], steps: int) -> list[tuple[str, list[Subject], Work, int, int]]:
    """Of each table its name, what runs, the work, how many steps, and how many at a time.

    Explicit steps run on the first size alone: what they cost grows in proportion.
    """
    found = [(f"{s}; implicit", IMPLICIT, bar(c, DT), steps, TURN) for s, c in sizes.items()]
    first, cells = next(iter(sizes.items()))
    short = (f"{first}; explicit", EXPLICIT, bar(cells, SHORT), 10 * steps, 10 * TURN)
    both = [*DROPPED, *FALLING]
    fall = ("A cube of 1,296 tetrahedra; dropped", both, cube(), round(1.5 * steps), TURN)
    return [*found, short, fall]


def measured(
    sizes: dict[str, Any], pythons: dict[str, str], steps: int
) -> dict[str, dict[Subject, Taken]]:
    """Every table's run."""
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, subjects, work, count, at_once in runs(sizes, steps):
            file = Path(folder) / "work.npz"
            work.write(file)
            taken = side_by_side(subjects, pythons, file, steps=count, turn=at_once)
            found[name] = taken
            for subject, of in taken.items():
                said = of.why or f"made in {of.making:.1f} s, p50 {of.p(50):.3g} ms"
                print(name, name_of(subject), said, sep=": ", file=sys.stderr, flush=True)
    return found


def put(page: str, text: str) -> str:
    """The page with the text between its markers."""
    before, found, rest = page.partition(BEGIN)
    _, closed, after = rest.partition(END)
    if not (found and closed):
        raise SystemExit(f"{PAGE.name} has no place between {BEGIN} and {END}")
    return f"{before}{BEGIN}\n\n{text}\n\n{END}{after}"


def main() -> int:
    """Runs, prints or writes."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--python", default=sys.executable, help="in which the peers are installed")
    parser.add_argument("--steps", type=int, default=STEPS, help="implicit ones of each")
    parser.add_argument("--write", action="store_true", help="to docs/measured/peers.md")
    parser.add_argument("--reference", action="store_true", help="computes the reference anew")
    asked = parser.parse_args()
    if asked.reference:
        tips = {size: reference_of(cells, STEPS) for size, cells in SIZES.items()}
        lines = [f"{json.dumps(size)}: {json.dumps(of)}" for size, of in tips.items()]
        REFERENCE.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")
        return 0
    if asked.write and commit().endswith("-dirty"):
        print("peers: what is printed names its commit; commit all changes first", file=sys.stderr)
        return 1
    references = json.loads(REFERENCE.read_text(encoding="utf-8"))
    steps = min(asked.steps, STEPS)
    text = section(measured(SIZES, dict.fromkeys(PEERS, asked.python), steps), references, steps)
    if asked.write:
        PAGE.write_text(put(PAGE.read_text(encoding="utf-8"), text), encoding="utf-8")
    else:
        print(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
