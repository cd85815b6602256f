"""Which sources can be compiled together, as one file that includes them.

Most of the time of a compile goes into headers and templates that neighbouring sources share. Two
sources go together if they are in one folder and define no private name (a name in a namespace
without a name) alike.

    python unity_groups.py SOURCE...    prints "NUMBER SOURCE" for each source that is in a group
"""

import re
import sys
from collections.abc import Iterable
from pathlib import Path

MOST = 8
"""sources of a group: more of them save little, take more memory and leave processors idle"""
MACROS = re.compile(r"(TYPED_)?TEST(_\w+)?|INSTANTIATE_\w+|static_assert|PrintTo")


def own_names(text: str) -> set[str]:
    """What a source defines in namespaces without a name."""
    names: set[str] = set()
    for part in re.findall(r"^namespace \{$(.*?)^\}  // namespace$", text, re.M | re.S):
        for line in re.findall(r"^[A-Za-z].*", part, re.M):
            found = re.match(r"(?:struct|class|enum class|using) (?:\w+::)*(\w+)", line)
            found = found or re.search(r"(\w+)(?:\[.*?\])? ?(?:=|\{|;|$)", line.split("(")[0])
            names.update(found.groups() if found else ())
    return {name for name in names if not MACROS.fullmatch(name)}


def groups(sources: Iterable[Path]) -> list[list[Path]]:
    """Sources of one folder, MOST at most together, in the order of their paths."""
    found: list[tuple[list[Path], set[str]]] = []
    for source in sorted(sources):
        own = own_names(source.read_text(encoding="utf-8"))
        for group, names in found:
            if group[0].parent == source.parent and len(group) < MOST and names.isdisjoint(own):
                group.append(source)
                names.update(own)
                break
        else:
            found.append(([source], own))
    return [group for group, _ in found]


def main(sources: list[str]) -> None:
    """Prints the groups of more than one source."""
    several = [group for group in groups(map(Path, sources)) if len(group) > 1]
    for number, group in enumerate(several):
        for source in group:
            print(number, source)


if __name__ == "__main__":
    main(sys.argv[1:])
