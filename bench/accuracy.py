"""Writes docs/measured/accuracy.md and its pictures: the cases of `tissu bench accuracy`.

    python bench/accuracy.py --write [--preset full] [--meshes FOLDER] [CASE …]

The page is written after each case; sections of cases that are not asked for stay as they are.
Without --write it is printed. Cases that need meshes which are not there are left out.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

from kernels import table

from tissu.accuracy import Run, Study, front, read_cases, study
from tissu.accuracy.figure import draw
from tissu.accuracy.front import sentence
from tissu.accuracy.table import COLUMNS, cells, curves, printed
from tissu.cli.bench import missing
from tissu.cli.info import machine_line

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "measured" / "accuracy.md"
HEAD = """# Accuracy

Which setting reaches a given error in the least time? This page compares elements, laws, models,
integrators and solvers by the time that they take to reach an error. `tissu bench accuracy` runs
cases with known answers, with all the settings that each case names, and writes the error and the
time of each run:

```
tissu bench accuracy                     # all cases, about two minutes
tissu bench accuracy bar swing           # some
tissu bench accuracy --preset full       # all runs of all cases
tissu bench accuracy --list              # what cases there are
```

`results/accuracy/accuracy.html` is a single page with the diagrams, the tables and the answers.
`accuracy.csv` holds the same runs, as does `accuracy.parquet` with `tissu[parquet]`. Each diagram
is a PNG.

- **Error**: the mean distance from the reference over its places (a deflection curve, points, a
  whole field), as a share of the largest displacement. The reference is never a beam formula,
  except in the column "as in the paper".
- **Time**: the wall time from the scene to the result, with all preparations. Runs under 0.2 s are
  taken three times, and the fastest counts.
- **Front**: the runs that no other run beats in both error and time.
- **To reach** an error: the time at which a power law, fitted between two runs of a curve, reaches
  this error.
- **As in the paper**: the error against the paper's own reference.

## A case of your own

A case is a scene, `NAME.yaml`, which `tissu run` takes as well, and a study, `NAME.study.yaml`:

```yaml
title: A bar that is pulled
reference: {type: points, body: bar, file: NAME.npz}   # or curve, affine, place
choices:
  - name: "{cell}"                                     # the value of a varied field
    vary:                                              # every combination; the last makes a curve
      bodies.bar.mesh.cell: [hexahedron, tetra]
      bodies.bar.mesh.cells: [[4, 2, 2], [8, 4, 4]]
    small: {bodies.bar.mesh.cells: [[4, 2, 2]]}        # instead, in the small preset
```

`tissu bench accuracy --cases FOLDER` runs the cases of a folder. References are `points` (arrays
`points` and `displacements` of an .npz; nodes elsewhere are not compared), `curve` (stations along
a line, a cubic between them), `affine` (u = G X) and `place` (the displacement of one place). The
cases of tissu are in `bench/cases`. `make_references.py` there computes the references that are
tissu's own.

"""
TAIL = "Written by `python bench/accuracy.py --write`;"


def rows_of(head: list[str], rows: list[list[str]]) -> str:
    """A table; nothing where there are no rows."""
    return table(head, rows) if rows else ""


def best(one: Study) -> str:
    """The runs of the front, as a table."""
    wanted = {id(run) for run in front(one.runs)}
    rows = [
        [row[0].removesuffix(" *"), *row[1:]]
        for run, row in zip(one.runs, cells(one), strict=True)
        if id(run) in wanted
    ]
    return rows_of(["run", *COLUMNS], rows)


def near(run: Run) -> str:
    """How near a run came that did not meet its tolerances."""
    if run.share is None or run.seconds is None:
        return ""
    return f" ({100.0 * run.share:.3g} %, {1e3 * run.seconds:.3g} ms)"


def section(one: Study) -> str:
    """A case of the page."""
    case = one.case
    failed = [f"- {r.label}: {r.outcome}: {r.why}{near(r)}" for r in one.runs if not r.counts]
    parts = [
        f"## {case.title}",
        case.about,
        f"**{sentence(one)}**",
        f"![Error against time](../pictures/accuracy-{case.name}.png)",
        f"The front, of {len(one.runs)} runs ({one.preset} preset):",
        best(one),
        rows_of(*curves(one)),
        rows_of(*printed(one)),
        "\n".join(f"- {note}" for note in case.notes),
        "\n".join(failed),
    ]
    return "\n\n".join(part for part in parts if part) + "\n"


def kept() -> dict[str, str]:
    """The sections of the page as it is, by the names of their cases."""
    if not PAGE.exists():
        return {}
    whole = PAGE.read_text(encoding="utf-8").partition(TAIL)[0]
    found = {}
    for text in whole.split("\n## ")[1:]:
        _, picture, rest = text.partition("(pictures/accuracy-")
        if picture:
            found[rest.partition(".png)")[0]] = f"## {text.rstrip()}\n"
    return found


def main() -> None:
    """Runs, prints or writes."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="CASE")
    parser.add_argument("--preset", choices=("small", "full"), default="full")
    parser.add_argument("--meshes", type=Path)
    parser.add_argument("--write", action="store_true")
    asked = parser.parse_args()
    begin = time.perf_counter()
    every = [case.name for case in read_cases(ROOT / "bench" / "cases", [])]
    parts = kept() if asked.write else {}
    text = ""
    for case in read_cases(ROOT / "bench" / "cases", asked.names):
        if missing(case, asked.meshes):
            continue
        one = study(case, asked.preset, meshes=asked.meshes)
        print(case.name, sentence(one), f"{time.perf_counter() - begin:.0f} s", file=sys.stderr)
        parts[case.name] = section(one)
        ordered = [parts[name] for name in every if name in parts]
        text = HEAD + "\n".join([*ordered, f"{TAIL} {machine_line()}\n"])
        if not asked.write:
            continue
        figure = draw(one)
        if figure is not None:
            picture = ROOT / "docs" / "pictures" / f"accuracy-{case.name}.png"
            figure.savefig(picture, dpi=80, format="png")
        PAGE.write_text(text, encoding="utf-8")
    if not asked.write:
        print(text)


if __name__ == "__main__":
    main()
