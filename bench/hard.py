"""Prints docs/measured/hard-cases.md: every hard case with every method, by running them: --write.

--contact prints, or writes, the chapter on contact alone.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "hard"))

from outcome import (  # noqa: E402
    CASES,
    CONTACT,
    Outcome,
    case,
    methods,
    names,
    outcome,
    with_method,
)

import tissu as ts  # noqa: E402

PAGE = ROOT / "docs" / "measured" / "hard-cases.md"
HEAD = """# Hard cases

This page shows how every integrator copes with scenes that are known to break simulators. Each row
is a scene in `tests/hard/cases`, which `tissu run` can run. Each column is an integrator instead
of the scene's own. There are three outcomes:

- **steady**: in the last tenth of the run no node moves by more than a thousandth of the body;
- **bounded**: the body still moves;
- **refused**: there is an error of one sentence, and the simulation stands at its last good step.
  The notes below the table give each sentence.

The guide describes how [static steps](../guide/statics.md) and
[energies](../guide/integrators.md#energy-that-grows) are judged.

Numbers are the largest distance of a node from its rest position at any time, in sizes of the body.
An asterisk means that some steps did not meet their tolerances; their reports say so. `!` means
that cells are inside out at the end; `tissu run` prints this. Explicit methods took nine tenths of
their stable step; `dt: auto` takes four fifths now. They are not run if this would take more
than 20,000 steps. The
fixed-point iteration takes the scene's step, or the longest step for which it contracts. Implicit
methods take the scene's step.

"""


BEGIN, END = "<!-- contact -->", "<!-- end of contact -->"
CONTACT_HEAD = """## Contact

These scenes are in `tests/hard/contact`, and run with methods that have contact. The exact audit
runs after every step. An entry that does not mention crossings had none.
`tests/hard/test_contact_*.py` tests the outcome of each case: forces against closed forms, momenta
to round-off, the same bits on 1, 2 and 4 threads. [The limits of
contact](../guide/contact.md#limits) are in the guide.

"""
TAIL = """\
`tests/hard/test_contact_edits.py` removes cells while surfaces press on each other. While the two
livers touch, it removes a third of the touching cells three times. In another test it removes all
touching cells of one liver, again and again, until nothing touches. The contact forces on the
remaining surfaces are the same to the bit after each removal. No surface crosses another in any
step. The bits are the same with 1, 2 and 4 threads, and with a checkpoint between two removals.

This page is printed by `python bench/hard.py --write`.
"""


def cell(found: Outcome, notes: list[str]) -> str:
    """One entry of the table."""
    if found.kind == "refused":
        said = found.message.replace(f"{ROOT}/", "")
        if said not in notes:
            notes.append(said)
        return f"refused ({notes.index(said) + 1})"
    marks = (r"\*" if found.unconverged else "") + ("!" if found.inverted else "")
    crossings = f", {found.crossings} cross" if found.crossings else ""
    return f"{found.kind} {found.bound:.3g}{marks}{crossings}"


def rows(folder: Path, columns: list[str], notes: list[str]) -> list[str]:
    """A line of the table for every case of a folder; refusals are added to the notes."""
    lines = []
    for name in names(folder):
        scene, entries = case(name, folder), []
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
        link = f"[{name}](../../{folder.relative_to(ROOT)}/{name}.yaml)"
        lines.append(f"| {link} | " + " | ".join(entries) + " |")
    return lines


def table(folder: Path, columns: list[str]) -> str:
    """What the cases are about, the table, and its notes."""
    notes: list[str] = []
    lines = rows(folder, columns, notes)
    about = [f"- `{name}`: {_first_comment(folder / f'{name}.yaml')}" for name in names(folder)]
    head = "| case | " + " | ".join(columns) + " |"
    parts = [
        "\n".join(about),
        "The scene's own method is in bold.",
        "\n".join([head, "|---|" + "---|" * len(columns), *lines]),
        "\n".join(f"{number}. {text}" for number, text in enumerate(notes, 1)),
    ]
    return "\n\n".join(part for part in parts if part)


def contact() -> str:
    """The chapter on contact, between its markers."""
    return f"{BEGIN}\n\n{CONTACT_HEAD}{table(CONTACT, ['implicit_euler', 'bdf2'])}\n\n{END}\n"


def page() -> str:
    """The whole page."""
    return "\n".join([HEAD + table(CASES, methods()), "", contact(), TAIL])


def with_contact(text: str) -> str:
    """The page as it stands, with its chapter on contact written anew."""
    before, begun, rest = text.partition(BEGIN)
    _, ended, after = rest.partition(f"{END}\n")
    if not (begun and ended):
        raise RuntimeError(f"{PAGE.name} has no place between {BEGIN} and {END}")
    return before + contact() + after


def _first_comment(path: Path) -> str:
    lines = path.read_text(encoding="utf-8").splitlines()
    return " ".join(line[2:] for line in lines if line.startswith("# "))


if __name__ == "__main__":
    only = "--contact" in sys.argv
    text = with_contact(PAGE.read_text(encoding="utf-8")) if only else page()
    if "--write" in sys.argv:
        PAGE.write_text(text, encoding="utf-8")
    else:
        print(text)
