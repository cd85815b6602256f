"""The command `python -m tissu.codegen --check | --update | --list`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from tissu.codegen import cpp, listing
from tissu.codegen.checks import check_law
from tissu.codegen.definition import LAWS, Law, read_laws
from tissu.codegen.elements import element_texts
from tissu.codegen.scene_laws import scene_laws
from tissu.errors import LawError

ROOT = Path(__file__).resolve().parents[3]
HEADERS = "cpp/include/tissu/law/generated"
ELEMENTS = "cpp/include/tissu/element/generated"
TABLE = "cpp/src/law/generated/laws.cpp"
SCENE = "python/tissu/scene/generated/laws.py"


def made_files(laws: Sequence[Law], root: Path) -> dict[Path, str]:
    """Every file with its formatted text."""
    files = {root / HEADERS / f"{law.name}.h": cpp.header(law) for law in laws}
    files[root / HEADERS / "all.h"] = listing.type_list(laws)
    files[root / TABLE] = listing.table(laws)
    made = {path: cpp.formatted(text, path) for path, text in files.items()}
    made[root / SCENE] = scene_laws(laws)
    return made | {root / path: text for path, text in element_texts().items()}


def _left_over(files: dict[Path, str], root: Path) -> list[Path]:
    """Made files that no law and no element asks for."""
    found = [*sorted((root / HEADERS).glob("*.h")), *sorted((root / ELEMENTS).glob("*.h"))]
    return [path for path in found if path not in files]


def stale(files: dict[Path, str], root: Path) -> list[str]:
    """One sentence for each file that is not what it should be."""
    problems = []
    for path, text in files.items():
        if not path.exists():
            problems.append(f"{path.relative_to(root)} is missing")
        elif path.read_text(encoding="utf-8") != text:
            problems.append(f"{path.relative_to(root)} is not what the formulae give")
    left = _left_over(files, root)
    return problems + [f"{path.relative_to(root)} has no law or element" for path in left]


def update(files: dict[Path, str], root: Path) -> list[str]:
    """Writes what changed, takes out what is left over; one line for each."""
    done = []
    for path, text in files.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
            done.append(f"wrote {path.relative_to(root)}")
    for path in _left_over(files, root):
        path.unlink()
        done.append(f"removed {path.relative_to(root)}")
    return done


def print_list(laws: Sequence[Law]) -> None:
    """Laws, parameters and operation counts."""
    for law in laws:
        names = ", ".join(f"{p.name} [{p.unit}]" for p in law.parameters)
        print(f"{law.name}{' (addition)' if law.addition else ''}: {names}\n  W = {law.formula}")
        for name, make in cpp.QUESTIONS.items():
            print(f"  {name}: {make(law.energy).count()}")


def main(arguments: Sequence[str] | None = None) -> int:
    """0, or 1 where a file is stale, or 2 where a law is refused."""
    parser = argparse.ArgumentParser(prog="python -m tissu.codegen", description=__doc__)
    job = parser.add_mutually_exclusive_group(required=True)
    job.add_argument("--check", action="store_true", help="1 when the C++ is not what they give")
    job.add_argument("--update", action="store_true", help="write the C++")
    job.add_argument("--list", action="store_true", help="laws, parameters, operation counts")
    parser.add_argument("--laws", type=Path, default=LAWS, help="folder of the formulae")
    parser.add_argument("--root", type=Path, default=ROOT, help="folder that cpp/ is in")
    given = parser.parse_args(arguments)
    try:
        laws = read_laws(given.laws)
        if given.list:
            print_list(laws)
            return 0
        for law in laws:
            check_law(law)
        files = made_files(laws, given.root)
    except LawError as error:
        print(error, file=sys.stderr)
        return 2
    if given.update:
        print("\n".join(update(files, given.root)) or "codegen: nothing changed")
        return 0
    problems = stale(files, given.root)
    print("\n".join([*problems, "run: make codegen"] if problems else ["codegen: up to date"]))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
