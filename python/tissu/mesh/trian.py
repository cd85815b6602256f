"""INRIA's .trian: a number of nodes and x y z for each, a number of triangles and their corners.

Corners are numbered from 0; the numbers of the three neighbours that follow are not needed.
"""

from __future__ import annotations

from pathlib import Path

from tissu.mesh.lines import Lines, whole
from tissu.mesh.raw import RawMesh


def read_trian(path: Path) -> RawMesh:
    """A surface of triangles.

    Raises:
        MeshError: what the file holds is not such a surface; says the line.
    """
    lines = Lines(path)
    points = lines.table(lines.count("nodes"), 3, "nodes: x y z")
    corners = lines.table(lines.count("triangles"), 3, "triangles: three node numbers")
    return RawMesh(points, [("triangle", whole(lines, corners, "node numbers"))])
