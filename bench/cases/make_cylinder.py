"""Makes cylinder_N.vtu: a rod of 6 m and radius 1 m, N x N hexahedra across."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import tissu as ts

HERE = Path(__file__).parent
ACROSS = (4, 8, 12)


def cylinder(across: int) -> ts.Mesh:
    """A square bar whose sections are mapped to discs."""
    bar = ts.bar_mesh(
        size=(6, 2, 2),
        cells=(6 * across // 2, across, across),
        cell="hexahedron",
        origin=(0, -1, -1),
    )
    x, y, z = bar.points.T
    disc = (y * np.sqrt(1 - z**2 / 2), z * np.sqrt(1 - y**2 / 2))
    return ts.Mesh(points=np.stack([x, *disc], axis=1), cells=bar.cells)


if __name__ == "__main__":
    for across in ACROSS:
        ts.write_mesh(cylinder(across), HERE / f"cylinder_{across}.vtu")
