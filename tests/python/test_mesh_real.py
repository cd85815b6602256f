"""Real organs and phantoms: each is read, and has the numbers its description gives."""

from __future__ import annotations

import numpy as np
import pytest

from mesh_data import shared
from tissu.mesh import read_mesh
from tissu.mesh.surface import edge_faults, enclosed_volume

# file, unit, nodes, volume cells, triangles of the surface, volume [m3]
VOLUMES = [
    ("liver.msh", "cm", 181, 596, 276, 36.56e-6),
    ("liver2.msh", "m", 507, 1493, 860, 1.1251),
    ("truthcylinder1.msh", "cm", 642, 2524, 706, 1513.4e-6),
    ("Ossicles.vtu", "mm", 1733, 5058, 3412, 27.145e-9),
    ("cylinder_Hexa.msh", "m", 5740, 4920, 3052, 2.0058e-4),
]
SURFACES = [
    ("liver.obj", 181, 274, True),
    ("liver-smooth.obj", 2194, 4384, True),
    ("liver2.obj", 1170, 2336, True),
    ("liver.vtk", 5008, 10000, True),
    ("coeur1.trian", 7778, 15552, True),
    ("malleus.obj", 1876, 3748, True),
    ("aneurysm3D_1.off", 7095, 14186, True),
    ("truthcylinder1.obj", 830, 1656, True),
    ("cylinder_Surface.obj", 1528, 3052, True),
    ("truthCylinder-Deformed.obj", 1839, 3440, False),
]


@pytest.mark.parametrize(("file", "unit", "nodes", "cells", "triangles", "volume"), VOLUMES)
def test_volume_mesh(
    file: str, unit: str, nodes: int, cells: int, triangles: int, volume: float
) -> None:
    mesh = read_mesh(shared("meshes", file), unit=unit)
    report, surface = mesh.quality(), mesh.surface()
    assert (mesh.node_count, mesh.cell_count, len(surface.triangles)) == (nodes, cells, triangles)
    assert mesh.volume() == pytest.approx(volume, rel=1e-4)
    assert enclosed_volume(mesh.points, surface.triangles) == pytest.approx(mesh.volume(), rel=1e-6)
    assert edge_faults(surface.triangles) == (0, 0)
    assert (report.parts, report.overfull_faces) == (1, 0)
    assert len(report.inverted) == len(report.zero_volume) == len(report.unused_nodes) == 0


@pytest.mark.parametrize(("file", "nodes", "triangles", "closed"), SURFACES)
def test_surface_mesh(file: str, nodes: int, triangles: int, closed: bool) -> None:
    mesh = read_mesh(shared("meshes", file))
    assert mesh.volume_blocks == ()
    assert (mesh.node_count, len(mesh.surface().triangles)) == (nodes, triangles)
    report = mesh.quality()
    assert (report.closed, report.clashing_edges) == (closed, 0)


def test_liver_has_the_quality_that_was_measured() -> None:
    report = read_mesh(shared("meshes", "liver.msh"), unit="cm").quality()
    assert report.min_quality == pytest.approx(0.079, abs=5e-4)
    assert report.median_quality == pytest.approx(0.595, abs=5e-4)
    np.testing.assert_allclose(np.ptp(report.bounds, axis=0), [0.065, 0.049, 0.044], atol=5e-4)


def test_liver_surface_is_a_sphere() -> None:
    surface = read_mesh(shared("meshes", "liver.msh")).surface()
    edges = 3 * len(surface.triangles) // 2
    assert len(surface.nodes) - edges + len(surface.triangles) == 2


def test_surface_of_the_phantom_is_the_one_that_came_with_it() -> None:
    computed = read_mesh(shared("meshes", "cylinder_Hexa.msh")).surface_mesh()
    given = read_mesh(shared("meshes", "cylinder_Surface.obj"))
    assert computed.quality().area == pytest.approx(given.quality().area, rel=1e-4)
    assert computed.node_count == given.node_count


def test_second_liver_says_what_was_left_out() -> None:
    mesh = read_mesh(shared("meshes", "liver2.msh"))
    assert mesh.notes == (
        "71 cells of type line left out of the volume",
        "860 cells of type triangle left out of the volume",
    )
    assert mesh.regions["2"].tolist() == list(range(1493))
