"""Meshes: read, written, made, measured."""

from tissu.mesh.bar import bar_mesh
from tissu.mesh.cell import CellBlock
from tissu.mesh.mesh import Mesh
from tissu.mesh.mixed_bar import mixed_bar_mesh
from tissu.mesh.quadratic import into_quadratic
from tissu.mesh.quality import QualityReport
from tissu.mesh.read import read_mesh
from tissu.mesh.refine import refined
from tissu.mesh.surface import Surface
from tissu.mesh.tetrahedra import into_tetrahedra
from tissu.mesh.write import write_mesh

__all__ = [
    "CellBlock",
    "Mesh",
    "QualityReport",
    "Surface",
    "bar_mesh",
    "into_quadratic",
    "into_tetrahedra",
    "mixed_bar_mesh",
    "read_mesh",
    "refined",
    "write_mesh",
]
