"""Which sources can be compiled together, as one file that includes them.

Most of the time of a compile goes into headers and templates that sources share, neighbours most of
all. Two sources go together if they define no private name (a name in a namespace without a name)
alike.

    python unity_groups.py SOURCE...    prints "NUMBER SOURCE" for each source that is in a group
"""

import re
import sys
from collections.abc import Iterable
from dataclasses import dataclass
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


@dataclass
class Group:
    """Sources that are compiled together, and the private names of all of them."""

    sources: list[Path]
    names: set[str]

    def takes(self, other: "Group") -> bool:
        """Whether another group has room in it, and no name of it."""
        room = len(self.sources) + len(other.sources) <= MOST
        return room and self.names.isdisjoint(other.names)

    def take(self, other: "Group") -> None:
        """Take the sources of another group."""
        self.sources += other.sources
        self.names |= other.names


def joined(parts: Iterable[Group], *, one_folder: bool) -> list[Group]:
    """Each part in the first group that takes it."""
    found: list[Group] = []
    for part in parts:
        folder = part.sources[0].parent
        for group in found:
            near = not one_folder or group.sources[0].parent == folder
            if near and group.takes(part):
                group.take(part)
                break
        else:
            found.append(part)
    return found


def groups(sources: Iterable[Path]) -> list[list[Path]]:
    """MOST sources at most together: of one folder first, and what is left alone with others."""
    parts = [Group([path], own_names(path.read_text(encoding="utf-8"))) for path in sorted(sources)]
    found = joined(joined(parts, one_folder=True), one_folder=False)
    return [group.sources for group in found]


def main(sources: list[str]) -> None:
    """Prints the groups of more than one source."""
    several = [group for group in groups(map(Path, sources)) if len(group) > 1]
    for number, group in enumerate(several):
        for source in group:
            print(number, source)


if __name__ == "__main__":
    main(sys.argv[1:])
