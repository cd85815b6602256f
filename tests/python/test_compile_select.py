"""Which nodes and faces selections mean, on a bar of 2 x 1 x 1 m with 2 x 1 x 1 boxes."""

import dataclasses

import numpy as np
import pytest

from tissu import (
    Body,
    Box,
    Cholesky,
    Fixed,
    Hooke,
    Nodes,
    Plane,
    Region,
    Scene,
    Sphere,
    Static,
    SurfaceNodes,
    Traction,
)
from tissu.compile.select import selected_faces
from tissu.errors import ParameterError
from tissu.mesh import bar_mesh, into_quadratic


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
    nodes = on.nodes(mesh)
    assert len(nodes) == count
    assert nodes.dtype == np.int32
    assert (np.diff(nodes) > 0).all()


def test_region(mesh):
    last = np.arange(mesh.cell_count // 2, mesh.cell_count)
    mesh = dataclasses.replace(mesh, regions={"tip": last})
    nodes = Region("tip").nodes(mesh)
    assert set(mesh.points[nodes, 0]) == {1.0, 2.0}
    with pytest.raises(ParameterError, match="no region 'tp'; did you mean 'tip'"):
        Region("tp").nodes(mesh)


def test_region_of_a_mesh_without_regions(mesh):
    with pytest.raises(ParameterError, match="names no regions"):
        Region("tip").nodes(dataclasses.replace(mesh, regions={}))


def test_node_numbers_beyond_the_mesh(mesh):
    with pytest.raises(ParameterError, match="found node 12; the mesh has the nodes 0 to 11"):
        Nodes([0, 12]).nodes(mesh)


def test_interior_node_is_not_on_the_surface():
    mesh = bar_mesh(size=(1, 1, 1), cells=(2, 2, 2))
    assert len(SurfaceNodes().nodes(mesh)) == 26


def test_faces_need_all_their_nodes(mesh):
    end = Box((2, None, None), None).nodes(mesh)
    (block,) = selected_faces(end, mesh)
    whole = {"tetra": ("triangle", (2, 3)), "hexahedron": ("quad", (1, 4))}
    assert (block.type, block.nodes.shape) == whole[mesh.volume_blocks[0].type]
    a, b, c = (mesh.points[block.nodes[:, corner]] for corner in range(3))
    normals = np.cross(b - a, c - a)
    np.testing.assert_allclose(normals, [[1, 0, 0]] * len(normals), atol=1e-15)
    assert selected_faces(end[:2], mesh) == ()


@pytest.mark.parametrize("cell", ["tetra", "hexahedron", "wedge", "pyramid"])
@pytest.mark.parametrize("order", [1, 2])
def test_traction_pulls_a_bar_evenly(cell, order):
    """A bar pulled at its end by a traction has one stress everywhere, in every element.

    Only the consistent nodal forces do that. sigma / E is 1e-6, so that Hooke's answer
    u_x = sigma x / E is met to the tolerance of Newton's method.
    """
    bar = bar_mesh(size=(2, 1, 1), cells=(2, 1, 1), cell=cell)
    mesh = bar if order == 1 else into_quadratic(bar)
    faces = {0: "x", 1: "y", 2: "z"}
    held = [
        Fixed("bar", on=Plane(point=(0, 0, 0), normal=np.eye(3)[axis]), axes=name)
        for axis, name in faces.items()
    ]
    scene = Scene(
        bodies={"bar": Body(mesh=mesh, law=Hooke(young=1e6, poisson=0.3), density=1.0)},
        fixed=held,
        loads=[Traction("bar", on=Plane(point=(2, 0, 0), normal=(1, 0, 0)), traction=(1, 0, 0))],
        step=Static(solver=Cholesky()),
    )
    simulation = scene.compile()
    simulation.step()
    expected = mesh.points * [1e-6, -0.3e-6, -0.3e-6]
    np.testing.assert_allclose(simulation.displacements("bar"), expected, atol=1e-14)
