"""A VTU file of an obstacle where it is at a time."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from tissu.files import whole_file

if TYPE_CHECKING:
    from tissu.simulation import Simulation


def write_obstacle(path: Path, simulation: Simulation, name: str) -> None:
    """Writes the triangles of an obstacle at the present time.

    Raises:
        TissuError: the file cannot be written.
    """
    from tissu.mesh.through_meshio import library

    meshio = library()
    surface = simulation.obstacle_surface(name)
    result = meshio.Mesh(
        surface.points,
        [("triangle", surface.triangles)],
        point_data={"displacement": surface.points - surface.rest},
    )
    with whole_file(path) as partial:
        meshio.write(partial, result, file_format="vtu")
