"""Cells cut into eight: volume, shape, numbers of nodes, regions."""

import dataclasses

import numpy as np
import pytest

import tissu as ts


def bar(cell):
    return ts.bar_mesh(size=(0.4, 0.1, 0.1), cells=(3, 2, 1), cell=cell)


@pytest.mark.parametrize("cell", ["tetra", "hexahedron"])
def test_a_refined_mesh_fills_the_same_volume_with_cells_of_an_eighth(cell):
    mesh = bar(cell)
    fine = ts.refined(mesh)
    assert fine.cell_count == 8 * mesh.cell_count
    assert fine.cell_volumes() == pytest.approx(np.repeat(mesh.cell_volumes() / 8, 8), rel=1e-12)
    assert np.array_equal(fine.points[: mesh.node_count], mesh.points)
    assert not len(fine.unused_nodes)
    assert fine.surface_mesh().node_count == ts.refined(fine).surface_mesh().node_count / 4 + 1.5
    assert len(np.unique(np.round(fine.points, 9), axis=0)) == fine.node_count


def test_refined_hexahedra_are_those_of_a_finer_bar():
    fine = ts.refined(bar("hexahedron"))
    straight = ts.bar_mesh(size=(0.4, 0.1, 0.1), cells=(6, 4, 2), cell="hexahedron")
    assert {tuple(p) for p in np.round(fine.points, 9)} == {
        tuple(p) for p in np.round(straight.points, 9)
    }


def test_tetrahedra_keep_their_shape_and_faces_match():
    mesh = ts.read_mesh("examples/organ.vtu")
    fine = ts.refined(mesh)
    assert fine.volume() == pytest.approx(mesh.volume(), rel=1e-12)
    assert fine.quality().shapes.min() > 0.9 * mesh.quality().shapes.min()
    assert len(fine.surface().triangles) == 4 * len(mesh.surface().triangles)


def test_regions_follow():
    mesh = dataclasses.replace(bar("tetra"), regions={"left": np.array([1, 4])})
    fine = ts.refined(mesh)
    of_left = mesh.cell_volumes()[[1, 4]].sum()
    assert fine.cell_volumes()[fine.regions["left"]].sum() == pytest.approx(of_left, rel=1e-12)


def test_other_cells_are_refused():
    with pytest.raises(ts.MeshError, match="found cells of type wedge"):
        ts.refined(bar("wedge"))


def test_made_meshes_do_not_pass_for_their_file():
    mesh = ts.read_mesh("examples/organ.vtu")
    assert ts.refined(mesh).source is None
    assert ts.into_quadratic(mesh).source is None  # else a scene would save the linear file
