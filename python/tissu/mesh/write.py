"""Writing a mesh through meshio, in metres, with its regions."""

from __future__ import annotations

import os
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from tissu.errors import MeshError
from tissu.files import require_file_place, whole_file
from tissu.mesh.cell import dimension, handled_types
from tissu.mesh.mesh import Mesh
from tissu.mesh.through_meshio import endings, formats, library, quiet, region_marks

_SURFACE_ONLY = ("obj", "off", "stl", "ply", "svg", "wkt")
_NUMBERED = {"gmsh": "gmsh:physical", "medit": "medit:ref"}  # one region per cell, by number
_MARKED = ("vtu", "vtk", "xdmf")


def write_mesh(mesh: Mesh, path: str | os.PathLike[str]) -> None:
    """Write a mesh in the format of the file's ending; lengths are in metres.

    Regions are kept in .vtu, .vtk, .xdmf, .msh and .mesh (the last two: at most one per cell; the
    last: by number); elsewhere a warning says that they are not.

    Raises:
        MeshError: no such format, a format that cannot hold this mesh, or a file that cannot be
            written.
    """
    file = require_file_place(path, error=MeshError)
    name = _format(file)
    if name in _SURFACE_ONLY and any(dimension(block.type) == 3 for block in mesh.cells):
        raise MeshError(
            f"{file}: {file.suffix} holds surfaces only; write mesh.surface_mesh(), or the whole "
            "mesh as .vtu"
        )
    cells = [(block.type, block.nodes) for block in mesh.cells]
    content = library().Mesh(mesh.points, cells, **_regions(mesh, name, file))
    with quiet(), whole_file(file, error=MeshError) as partial:
        try:
            library().write(partial, content, file_format="gmsh22" if name == "gmsh" else name)
        except OSError:
            raise
        except (Exception, SystemExit) as error:  # meshio's writers raise anything
            raise MeshError(f"{file} cannot be written as {name}: {error}") from None


def _format(file: Path) -> str:
    """The name of the format that the ending asks for.

    Raises:
        MeshError: there is none.
    """
    names = formats(file)
    if not names:
        raise MeshError(
            f"{file}: no format has the ending '{file.suffix}'; accepted: {' '.join(endings())}"
        )
    return names[0]


def _regions(mesh: Mesh, name: str, file: Path) -> dict[str, Any]:
    """What to hand to meshio for the regions."""
    if not mesh.regions:
        return {}
    marks = region_marks(mesh.cells, mesh.regions, handled_types())
    if name in _MARKED:
        return {"cell_data": marks}
    if name not in _NUMBERED:
        warnings.warn(f"{file}: a {name} file keeps no regions; .vtu does", stacklevel=3)
        return {}
    inside = [sum(columns) for columns in zip(*marks.values(), strict=True)]
    if any((np.asarray(count) > 1).any() for count in inside):
        raise MeshError(
            f"{file}: some cells are in several regions, a {name} file takes one; write .vtu"
        )
    numbers = _numbers(list(mesh.regions))
    tags = [np.zeros(len(block), dtype=np.int32) for block in mesh.cells]
    for number, columns in zip(numbers.values(), marks.values(), strict=True):
        for tag, column in zip(tags, columns, strict=True):
            tag[column == 1] = number
    named = {region: np.array([n, 3]) for region, n in numbers.items() if region != str(n)}
    data: dict[str, Any] = {_NUMBERED[name]: tags}
    if name == "gmsh":
        data["gmsh:geometrical"] = [np.ones(len(block), dtype=np.int32) for block in mesh.cells]
    return {"cell_data": data, "field_data": named if name == "gmsh" else {}}


def _numbers(regions: list[str]) -> dict[str, int]:
    """A number from 1 for each region; a region called by a number keeps it."""
    numbers = {name: int(name) for name in regions if name.isdecimal() and name == str(int(name))}
    free = (n for n in range(1, 2 * len(regions) + 1) if n not in numbers.values())
    return {name: numbers[name] if name in numbers else next(free) for name in regions}
