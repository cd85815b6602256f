"""Prints the lines, files and floors of every C++ room as a table in Markdown.

The floors of a room are the files in the longest chain of includes inside it: a room of which no
file includes another has one. `--out docs/reference/rooms.md` writes the page.
"""

import argparse
import sys
from collections import defaultdict
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from check_arrows import CPP, INCLUDE, TOPS, cpp_files, included_path

HEAD = """# The rooms of the core

Printed by `python .ci/floors.py --out docs/reference/rooms.md`, not written by hand. The floors of
a room are the files in the longest chain of includes inside it. Rooms stand in the order in which
they may include each other; the table of what may include what is in `.ci/check_arrows.py`.

| room | lines | files | floors |
|---|---:|---:|---:|
"""


def rooms() -> dict[str, dict[str, str]]:
    """Room -> file -> text; a pair of files that is a room of its own is part of its folder."""
    found: dict[str, dict[str, str]] = defaultdict(dict)
    for room, path in cpp_files():
        below = path.relative_to(next(top for top in TOPS if path.is_relative_to(top)))
        shown = room if room != below.with_suffix("").as_posix() else below.parent.as_posix()
        found[shown][str(path)] = path.read_text(encoding="utf-8")
    return found


def included_here(name: str, files: dict[str, str]) -> set[str]:
    """Those of the files that one of them includes."""
    below = {included_path(Path(name), match[1]) for match in INCLUDE.finditer(files[name])}
    inner = {str(top / path) for top in TOPS for path in below if path is not None}
    return inner & files.keys()


def floors(files: dict[str, str]) -> int:
    """The files in the longest chain of includes among these; none of them twice."""
    heights: dict[str, int] = {}

    def height(name: str, above: frozenset[str]) -> int:
        if name not in heights:
            others = included_here(name, files) - above
            heights[name] = 1 + max((height(o, above | {name}) for o in others), default=0)
        return heights[name]

    return max(height(name, frozenset({name})) for name in files)


def table() -> str:
    """A row for each room in the order of the arrows."""
    rows = []
    found = rooms()
    for room in [*(room for room in CPP if room in found), *sorted(set(found) - set(CPP))]:
        lines = sum(text.count("\n") for text in found[room].values())
        rows.append(f"| {room} | {lines} | {len(found[room])} | {floors(found[room])} |\n")
    return "".join(rows)


def main() -> int:
    """Prints the page, or writes it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path)
    out = parser.parse_args().out
    if out is None:
        print(HEAD + table(), end="")
    else:
        out.write_text(HEAD + table(), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
