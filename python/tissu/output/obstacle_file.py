"""VTU files of an obstacle, and of the mesh with which a body meets others, at a time."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.files import whole_file

if TYPE_CHECKING:
    from tissu.simulation import Simulation

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]


def write_obstacle(path: Path, simulation: Simulation, name: str) -> None:
    """Writes the triangles of an obstacle at the present time.

    Raises:
        TissuError: the file cannot be written.
    """
    surface = simulation.obstacle_surface(name)
    _write(path, surface.rest, surface.points, surface.triangles)


def write_contact_surface(path: Path, simulation: Simulation, body: str) -> None:
    """Writes the surface with which a body meets others at the present time.

    Raises:
        TissuError: the file cannot be written.
    """
    surface = simulation.contact_surface(body)
    _write(path, surface.rest, surface.points, surface.triangles)


def _write(path: Path, rest: Floats, points: Floats, triangles: Ints) -> None:
    from tissu.mesh.through_meshio import library

    meshio = library()
    result = meshio.Mesh(
        points, [("triangle", triangles)], point_data={"displacement": points - rest}
    )
    with whole_file(path) as partial:
        meshio.write(partial, result, file_format="vtu")
