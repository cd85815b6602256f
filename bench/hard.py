"""Prints docs/hard-cases.md: every hard case with every method, by running them: --write."""

from __future__ import annotations

import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "hard"))

from hard_text import CHAPTERS  # noqa: E402
from outcome import CASES, Outcome, case, methods, names, outcome, with_method  # noqa: E402

import tissu as ts  # noqa: E402

PAGE = ROOT / "docs" / "hard-cases.md"
HEAD = """# Hard cases

Each row is a scene in `tests/hard/cases` that you can open and run with `tissu run`; each column a
method that is put in place of the scene's own. What comes of it is

- **steady**: in the last tenth of the run no node moves by more than a thousandth of the body;
- **bounded**: it still moves, and no node was ever farther from rest than the number says;
- **refused**: an error of one sentence, and the simulation stands at its last good step. The notes
  below the table give each sentence.

Numbers are the largest distance of a node from rest at any time, in sizes of the body. An asterisk:
some steps did not meet their tolerances and said so. `!`: cells are inside out at the end, and are
told. Explicit methods take nine tenths of their stable step (`dt: auto`) and are not run where that
makes more than 20,000 steps; the fixed point takes the scene's step or what contracts, if that is
smaller; implicit ones take the scene's.

"""


TAIL = "This page is printed by `python bench/hard.py --write`.\n"


def cell(found: Outcome, notes: list[str]) -> str:
    """One entry of the table."""
    if found.kind == "refused":
        said = found.message.replace(f"{ROOT}/", "")
        if said not in notes:
            notes.append(said)
        return f"refused ({notes.index(said) + 1})"
    marks = ("*" if found.unconverged else "") + ("!" if found.inverted else "")
    return f"{found.kind} {found.bound:.3g}{marks}"


def page() -> str:
    """The whole page."""
    columns, notes, rows = methods(), [], []
    for name in names():
        scene, entries = case(name), []
        for method in columns:
            begin = time.perf_counter()
            try:
                found = outcome(with_method(scene, method))
            except ts.SceneError as error:  # a step so small that the scene refuses it
                found = Outcome("refused", message=str(error).splitlines()[-1].removeprefix("- "))
            except Exception as error:
                raise RuntimeError(f"{name} with {method}") from error
            entries.append(cell(found, notes))
            spent = time.perf_counter() - begin
            print(f"{name:24} {method:18} {spent:6.1f} s  {found}", file=sys.stderr, flush=True)
        own = columns.index(scene.step.type)
        entries[own] = f"**{entries[own]}**"
        rows.append(f"| [{name}](../tests/hard/cases/{name}.yaml) | " + " | ".join(entries) + " |")
    table = ["| case | " + " | ".join(columns) + " |", "|---|" + "---|" * len(columns), *rows]
    about = [f"- `{name}`: {_first_comment(name)}" for name in names()]
    said = [f"{number}. {text}" for number, text in enumerate(notes, 1)]
    parts = [
        "\n".join(about),
        "The scene's own method is in bold.",
        "\n".join(table),
        "\n".join(said),
    ]
    return HEAD + "\n\n".join([*parts, CHAPTERS + "\n" + TAIL])


def _first_comment(name: str) -> str:
    lines = (CASES / f"{name}.yaml").read_text(encoding="utf-8").splitlines()
    return " ".join(line[2:] for line in lines if line.startswith("# "))


if __name__ == "__main__":
    text = page()
    if "--write" in sys.argv:
        PAGE.write_text(text, encoding="utf-8")
    else:
        print(text)
