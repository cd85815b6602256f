"""Makes cook_N.vtu: Cook's membrane, N x N hexahedra and one across its thickness of 1 m."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import tissu as ts

HERE = Path(__file__).parent
CELLS = (4, 8, 16, 32)


def membrane(cells: int) -> ts.Mesh:
    """A square bar whose left side goes from 0 to 44 m and whose right side from 44 to 60 m."""
    bar = ts.bar_mesh(size=(1, 1, 1), cells=(cells, cells, 1), cell="hexahedron")
    x, y, z = bar.points.T
    up = 44 * x + (44 - 28 * x) * y
    return ts.Mesh(points=np.stack([48 * x, up, z], axis=1), cells=bar.cells)


if __name__ == "__main__":
    for cells in CELLS:
        ts.write_mesh(membrane(cells), HERE / f"cook_{cells}.vtu")
