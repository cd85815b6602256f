"""Node tags in Gmsh files of text: meshio takes a tag that no node can have for that of another."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path


def impossible_tag(path: Path) -> str | None:
    """A cell with a node tag below 1, in words; None in files that have none or are not looked at.

    Only files of text of the versions 2 and 4 are. What else is wrong with them, their reader says.
    """
    content = path.read_bytes()
    form = content.partition(b"$MeshFormat")[2][:100].split()
    if len(form) < 2 or form[1] != b"0" or form[0][:1] not in (b"2", b"4"):
        return None
    section = content.partition(b"$Elements")[2].partition(b"$EndElements")[0]
    lines = [line for line in section.split(b"\n") if line.strip()]
    try:
        for cell, nodes in _cells_of_2(lines) if form[0][:1] == b"2" else _cells_of_4(lines):
            for node in nodes:
                if node[:1] in b"0-" and int(node) < 1:
                    return f"cell {int(cell)} has the node {int(node)}; tags from 1 on are accepted"
    except (ValueError, IndexError):
        return None
    return None


def _cells_of_2(lines: list[bytes]) -> Iterator[tuple[bytes, list[bytes]]]:
    """Lines of `number type tags tag... node...`, after their count."""
    for line in lines[1:]:
        words = line.split()
        yield words[0], words[3 + int(words[2]) :]


def _cells_of_4(lines: list[bytes]) -> Iterator[tuple[bytes, list[bytes]]]:
    """Blocks of `dimension entity type count` and as many lines of `number node...`."""
    at = 1
    while at < len(lines):
        count = int(lines[at].split()[3])
        for line in lines[at + 1 : at + 1 + count]:
            words = line.split()
            yield words[0], words[1:]
        at += 1 + count
