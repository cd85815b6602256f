"""Which nodes and faces selections mean, on a bar of 2 x 1 x 1 m with 2 x 1 x 1 boxes."""

import dataclasses

import numpy as np
import pytest

from tissu.compile.select import selected_nodes, selected_triangles
from tissu.errors import ParameterError
from tissu.mesh import bar_mesh
from tissu.scene import Box, Nodes, Plane, Region, Sphere, SurfaceNodes


@pytest.fixture(params=["tetra", "hexahedron"])
def mesh(request):
    return bar_mesh(size=(2.0, 1.0, 1.0), cells=(2, 1, 1), cell=request.param)


@pytest.mark.parametrize(
    ("on", "count"),
    [
        (Box(), 12),
        (Box((0, 0, 0), (0, 1, 1)), 4),
        (Box((None, None, 1), None), 6),
        (Box((0, 0, 0), (0.9999999999, 1, 1)), 8),  # 1e-10 m below a node: round-off
        (Box((0, 0, 0), (0.999, 1, 1)), 4),
        (Sphere((0, 0, 0), 1), 4),
        (Plane((2, 0, 0), (5, 0, 0)), 4),
        (Plane((1.5, 0, 0), (-1, 0, 0), 0.5), 8),
        (Nodes([3, 1, 3]), 2),
        (SurfaceNodes(), 12),
        (Box((5, 5, 5), (6, 6, 6)), 0),
    ],
)
def test_nodes(mesh, on, count):
    nodes = selected_nodes(on, mesh)
    assert len(nodes) == count
    assert nodes.dtype == np.int32
    assert (np.diff(nodes) > 0).all()


def test_region(mesh):
    last = np.arange(mesh.cell_count // 2, mesh.cell_count)
    mesh = dataclasses.replace(mesh, regions={"tip": last})
    nodes = selected_nodes(Region("tip"), mesh)
    assert set(mesh.points[nodes, 0]) == {1.0, 2.0}
    with pytest.raises(ParameterError, match="no region 'tp'; did you mean 'tip'"):
        selected_nodes(Region("tp"), mesh)


def test_region_of_a_mesh_without_regions(mesh):
    with pytest.raises(ParameterError, match="names no regions"):
        selected_nodes(Region("tip"), dataclasses.replace(mesh, regions={}))


def test_node_numbers_beyond_the_mesh(mesh):
    with pytest.raises(ParameterError, match="found node 12; the mesh has the nodes 0 to 11"):
        selected_nodes(Nodes([0, 12]), mesh)


def test_interior_node_is_not_on_the_surface():
    mesh = bar_mesh(size=(1, 1, 1), cells=(2, 2, 2))
    assert len(selected_nodes(SurfaceNodes(), mesh)) == 26


def test_faces_need_all_their_nodes(mesh):
    end = selected_nodes(Box((2, None, None), None), mesh)
    triangles = selected_triangles(end, mesh)
    assert triangles.shape == (2, 3)
    a, b, c = (mesh.points[triangles[:, corner]] for corner in range(3))
    normals = np.cross(b - a, c - a)
    np.testing.assert_allclose(normals, [[1, 0, 0]] * 2, atol=1e-15)
    assert selected_triangles(end[:2], mesh).shape == (0, 3)
