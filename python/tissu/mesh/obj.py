"""Wavefront .obj: the lines v (nodes) and f (faces); the rest is for drawing and is left out.

Source of the layout: Wavefront, "Advanced Visualizer manual", appendix B1.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from tissu.errors import MeshError
from tissu.mesh.lines import text_of
from tissu.mesh.polygon import face_blocks
from tissu.mesh.raw import RawMesh


def read_obj(path: Path) -> RawMesh:
    """Faces of any number of corners, written v, v/vt, v//vn or v/vt/vn, also counted backwards.

    Raises:
        MeshError: what the file holds is not such a surface; says the line.
    """
    points: list[list[float]] = []
    sizes: list[int] = []
    corners: list[int] = []
    text = text_of(path).replace("\\\r\n", "  ").replace("\\\n", " ")
    for number, line in enumerate(text.splitlines(), start=1):
        words = line.split("#", 1)[0].split()
        if not words or words[0] not in ("v", "f"):
            continue
        try:
            if words[0] == "v":
                points.append(_node(words))
            else:
                face = [_corner(word, len(points)) for word in words[1:]]
                sizes.append(len(face))
                corners += face
        except ValueError:
            raise MeshError(
                f"{path}, line {number}: found '{line.strip()[:60]}'; 'v x y z' or "
                "'f a b c' with node numbers from 1 (or -1 backwards) is accepted"
            ) from None
    if not points:
        raise MeshError(f"{path}: found no line 'v x y z'; a Wavefront file with nodes is accepted")
    blocks, notes = face_blocks(np.array(sizes, dtype=int), np.array(corners, dtype=int))
    return RawMesh(np.array(points), blocks, notes=notes)


def _node(words: list[str]) -> list[float]:
    x, y, z = (float(word) for word in words[1:4])
    return [x, y, z]


def _corner(word: str, known: int) -> int:
    """Place of a corner among the nodes: numbered from 1, or backwards from the last one read."""
    number = int(word.split("/", 1)[0])
    if number == 0 or number < -known:
        raise ValueError
    return number - 1 if number > 0 else known + number
