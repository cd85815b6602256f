"""Gmsh's first text format: $NOD ... $ENDNOD $ELM ... $ENDELM.

Source of the layout: Gmsh reference manual, section "MSH file format version 1 (Legacy)".
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tissu.errors import MeshError
from tissu.mesh.lines import Lines, whole
from tissu.mesh.raw import RawMesh, tagged_regions

_HEXAHEDRON = [*range(8), 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15]

# Gmsh's number of a cell type -> name, and where VTK's nodes stand among Gmsh's.
_TYPES: dict[int, tuple[str, list[int]]] = {
    1: ("line", [0, 1]),
    2: ("triangle", [0, 1, 2]),
    3: ("quad", [0, 1, 2, 3]),
    4: ("tetra", [0, 1, 2, 3]),
    5: ("hexahedron", [0, 1, 2, 3, 4, 5, 6, 7]),
    6: ("wedge", [0, 1, 2, 3, 4, 5]),
    7: ("pyramid", [0, 1, 2, 3, 4]),
    8: ("line3", [0, 1, 2]),
    9: ("triangle6", [0, 1, 2, 3, 4, 5]),
    11: ("tetra10", [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]),
    12: ("hexahedron27", [*_HEXAHEDRON, 22, 23, 21, 24, 20, 25, 26]),
    15: ("vertex", [0]),
    17: ("hexahedron20", _HEXAHEDRON),
    18: ("wedge15", [0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11]),
    19: ("pyramid13", [0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12]),
}


def read_gmsh1(path: Path) -> RawMesh:
    """Nodes with any numbers, cells of several types; physical groups become regions.

    Raises:
        MeshError: what the file holds is not such a mesh; says the line.
    """
    lines = Lines(path)
    numbers, points = _nodes(lines)
    rows = _elements(lines)
    blocks: list[tuple[str, NDArray[Any]]] = []
    tags: list[NDArray[Any]] = []
    for kind in dict.fromkeys(kind for kind, _, _ in rows):
        of_kind = [(tag, nodes) for k, tag, nodes in rows if k == kind]
        name, order = _TYPES[kind]
        nodes = np.array([nodes for _, nodes in of_kind])[:, order]
        blocks.append((name, _renumbered(path, name, nodes, numbers)))
        tags.append(np.array([tag for tag, _ in of_kind]))
    return RawMesh(points, blocks, tagged_regions(tags, {}, ignore_zero=True))


def _nodes(lines: Lines) -> tuple[NDArray[Any], NDArray[Any]]:
    _go_to(lines, "$NOD")
    table = lines.table(lines.count("nodes"), 4, "nodes: number x y z")
    _end(lines, "$ENDNOD")
    numbers = whole(lines, table[:, :1], "node numbers")[:, 0]
    unique, count = np.unique(numbers, return_counts=True)
    if (count > 1).any():
        raise MeshError(f"{lines.path}: node {unique[count > 1][0]} is listed more than once")
    return numbers, table[:, 1:]


def _elements(lines: Lines) -> list[tuple[int, int, list[int]]]:
    """Type, physical group and node numbers of each cell."""
    _go_to(lines, "$ELM")
    count = lines.count("elements")
    if count > lines.left:
        lines.rows(count, "elements")
    layout = "a whole number each for element, type, physical and elementary group, nodes"
    result = []
    for _ in range(count):
        words = lines.words("an element")
        try:
            numbers = [int(word) for word in words]
        except ValueError:
            raise lines.error(words, layout) from None
        if len(numbers) < 6 or len(numbers) != 5 + numbers[4]:
            raise lines.error(words, layout)
        _, kind, tag, _, size, *nodes = numbers
        if kind not in _TYPES or size != len(_TYPES[kind][1]):
            known = ", ".join(f"{k} {name}" for k, (name, _) in _TYPES.items())
            raise lines.error(words, f"a type with its number of nodes ({known})")
        result.append((kind, tag, nodes))
    _end(lines, "$ENDELM")
    return result


def _renumbered(path: Path, name: str, nodes: NDArray[Any], numbers: NDArray[Any]) -> NDArray[Any]:
    """The file's node numbers as places in the list of nodes."""
    if not len(numbers):
        raise MeshError(f"{path}: the file lists no node")
    order = np.argsort(numbers)
    place = np.minimum(np.searchsorted(numbers, nodes, sorter=order), len(numbers) - 1)
    unknown = nodes[numbers[order[place]] != nodes]
    if unknown.size:
        raise MeshError(
            f"{path}: a {name} uses node {unknown[0]}, which is not among the "
            f"{len(numbers)} nodes of $NOD"
        )
    return np.asarray(order[place])


def _go_to(lines: Lines, keyword: str) -> None:
    while lines.words(keyword)[0] != keyword:
        pass


def _end(lines: Lines, keyword: str) -> None:
    words = lines.words(keyword)
    if words[0] != keyword:
        raise lines.error(words, keyword)
