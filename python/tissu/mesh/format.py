"""Which reader takes a file: by its ending, and by how it begins."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

from tissu.mesh.gmsh1 import read_gmsh1
from tissu.mesh.obj import read_obj
from tissu.mesh.off import read_off
from tissu.mesh.raw import RawMesh
from tissu.mesh.through_meshio import read_through_meshio
from tissu.mesh.trian import read_trian
from tissu.mesh.vtk_polydata import read_vtk_polydata

_OURS: dict[str, Callable[[Path], RawMesh]] = {
    ".trian": read_trian,
    ".obj": read_obj,
    ".off": read_off,
}

# How files begin -> what they are and the ending they should have.
_BEGINNINGS = (
    (rb"\s*\$(NOD|MeshFormat)", "Gmsh", ".msh"),
    (rb"\s*# vtk DataFile", "VTK legacy", ".vtk"),
    (rb"\s*(<\?xml[^>]*>\s*)?(<!--.*?-->\s*)*<VTKFile[^>]*UnstructuredGrid", "VTU", ".vtu"),
    (rb"\s*(ST)?C?N?OFF\s", "OFF", ".off"),
    (rb"\s*MeshVersionFormatted", "Medit", ".mesh"),
    (rb"\s*ply\s", "PLY", ".ply"),
    (rb"\s*solid\s", "STL", ".stl"),
    (rb"\s*\*(NODE|HEADING)", "Abaqus", ".inp"),
)


def reader(path: Path) -> Callable[[Path], RawMesh]:
    """What reads the file."""
    ending, head = path.suffix.lower(), _head(path)
    if ending in _OURS:
        return _OURS[ending]
    if ending == ".msh" and re.search(rb"^\s*\$NOD\b", head, re.MULTILINE):
        return read_gmsh1
    if ending == ".vtk" and re.search(rb"^\s*DATASET\s+POLYDATA", head, re.MULTILINE | re.I):
        return read_vtk_polydata
    return read_through_meshio


def sniffed(path: Path) -> str:
    """A remedy to add to an error when the file begins like one of another ending."""
    try:
        head = _head(path)
    except OSError:
        return ""
    for pattern, name, ending in _BEGINNINGS:
        if re.match(pattern, head, re.DOTALL | re.IGNORECASE) and path.suffix.lower() != ending:
            return f"; it begins like a {name} file: give it the ending {ending}"
    return ""


def _head(path: Path) -> bytes:
    with path.open("rb") as file:
        return file.read(2048)
