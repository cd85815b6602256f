"""Object File Format (.off): a surface of polygons.

Source of the layout: Geomview manual, section "OFF: polyhedral surfaces".
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from tissu.mesh.lines import Lines
from tissu.mesh.polygon import face_blocks
from tissu.mesh.raw import RawMesh


def read_off(path: Path) -> RawMesh:
    """Faces of any number of corners; colours, normals and texture coordinates are left out.

    Raises:
        MeshError: what the file holds is not such a surface; says the line.
    """
    lines = Lines(path)
    head = lines.words("OFF")
    if not re.fullmatch(r"(ST)?C?N?OFF", head[0]) or "BINARY" in head:
        raise lines.error(head, "OFF (text, three coordinates)")
    counts = head[1:] or lines.words("the numbers of nodes and faces")
    if len(counts) < 2 or not all(word.isdecimal() for word in counts[:2]):
        raise lines.error(counts, "the numbers of nodes and faces")
    points = lines.table(int(counts[0]), 3, "nodes: x y z")
    sizes, corners = [], []
    for _ in range(int(counts[1])):
        words = lines.words("a face")
        try:
            size = int(words[0])
            face = [int(word) for word in words[1 : 1 + size]]
        except ValueError:
            raise lines.error(words, "a number of corners and that many node numbers") from None
        if size < 1 or len(face) != size:
            raise lines.error(words, "a number of corners and that many node numbers")
        sizes.append(size)
        corners += face
    blocks, notes = face_blocks(np.array(sizes, dtype=int), np.array(corners, dtype=int))
    return RawMesh(points, blocks, notes=notes)
