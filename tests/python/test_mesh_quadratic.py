"""Cells with nodes in the middles of their edges."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from tissu import _core
from tissu.errors import MeshError
from tissu.mesh import (
    CellBlock,
    Mesh,
    bar_mesh,
    into_quadratic,
    into_tetrahedra,
    read_mesh,
    write_mesh,
)
from tissu.mesh.cell import cell_table, handled_types, linear_type
from tissu.mesh.surface import enclosed_volume

QUADRATIC = [name for name in handled_types() if cell_table()[name].order == 2]


def bar(cell: str) -> Mesh:
    return bar_mesh(size=(3, 2, 1), cells=(3, 2, 2), cell=cell)


@pytest.mark.parametrize("cell", QUADRATIC)
def test_nodes_lie_in_the_middle_of_what_they_belong_to(cell: str) -> None:
    mesh, corners = bar(cell), cell_table()[cell].corners
    x = mesh.points[mesh.cells[0].nodes]
    ends = np.array(_core.cell_edges(cell_type=cell))
    middles = x[:, corners : corners + len(ends)]
    np.testing.assert_allclose(middles, x[:, ends].mean(axis=2), atol=1e-15)
    for count, face in _core.cell_faces(cell_type=cell):
        x_face = x[:, face]
        around = (x_face[:, :count] + np.roll(x_face[:, :count], -1, axis=1)) / 2
        np.testing.assert_allclose(x_face[:, count : 2 * count], around, atol=1e-15)
        if len(face) == 9:
            np.testing.assert_allclose(x_face[:, 8], x_face[:, :4].mean(axis=1), atol=1e-15)
    if cell == "hexahedron27":
        np.testing.assert_allclose(x[:, 26], x[:, :8].mean(axis=1), atol=1e-15)


@pytest.mark.parametrize("cell", QUADRATIC)
def test_no_two_nodes_lie_at_one_place(cell: str) -> None:
    mesh = bar(cell)
    assert len(np.unique(np.round(mesh.points, 9), axis=0)) == mesh.node_count


@pytest.mark.parametrize("cell", handled_types())
def test_reversed_cells_are_turned(cell: str) -> None:
    mesh = bar(cell)
    mirrored = dataclasses.replace(mesh, points=mesh.points * [1, 1, -1])
    assert mirrored.volume() == pytest.approx(-6.0)
    blocks, count = _core.turn_reversed_cells(
        positions=mirrored.points, blocks=mirrored.native_blocks()
    )
    assert count == mesh.cell_count
    turned = Mesh(points=mirrored.points, cells=tuple(CellBlock(*block) for block in blocks))
    report = turned.quality()
    assert (turned.cell_volumes() > 0).all()
    assert report.min_quality > 0
    assert (report.closed, report.clashing_edges, report.nonconforming_faces) == (True, 0, 0)
    assert enclosed_volume(turned.points, turned.surface().triangles) == pytest.approx(6.0)


@pytest.mark.parametrize("cell", handled_types())
@pytest.mark.parametrize("ending", [".vtu", ".vtk", ".msh"])
def test_cells_survive_files(tmp_path: Path, cell: str, ending: str) -> None:
    mesh = dataclasses.replace(bar(cell), regions={"left": np.array([0, 1])})
    write_mesh(mesh, tmp_path / f"a{ending}")
    found = read_mesh(tmp_path / f"a{ending}")
    assert [block.type for block in found.cells] == [cell]
    np.testing.assert_array_equal(found.cells[0].nodes, mesh.cells[0].nodes)
    np.testing.assert_allclose(found.points, mesh.points, rtol=1e-14)
    assert found.regions["left"].tolist() == [0, 1]
    assert found.notes == ()


@pytest.mark.parametrize("cell", handled_types())
def test_any_cells_become_tetrahedra(cell: str) -> None:
    mesh = dataclasses.replace(bar(cell), regions={"left": np.array([0])})
    shuffled = renumbered(mesh, np.random.default_rng(3).permutation(mesh.node_count))
    cut = into_tetrahedra(shuffled)
    report = cut.quality()
    per_cell = {4: 1, 5: 2, 6: 3, 8: 6}[cell_table()[cell].corners]
    assert cut.cell_count == per_cell * mesh.cell_count
    assert cut.cell_volumes().min() > 0
    assert report.volume == pytest.approx(6.0)
    assert report.closed
    assert (report.nonconforming_faces, len(report.unused_nodes)) == (0, 0)
    assert cut.regions["left"].tolist() == list(range(per_cell))


def test_regions_stay_and_mixed_cells_share_nodes() -> None:
    linear = bar("hexahedron")
    tip = np.array([[1.5, 1.0, 3.0]])
    top = np.array([[*linear.cells[0].nodes[6, 4:], linear.node_count]])
    mesh = Mesh(
        points=np.vstack([linear.points, tip]),
        cells=(*linear.cells, CellBlock("pyramid", top)),
        regions={"tip": np.array([12])},
    )
    made = into_quadratic(mesh)
    assert [block.type for block in made.cells] == ["hexahedron20", "pyramid13"]
    assert made.regions["tip"].tolist() == [12]
    assert made.quality().nonconforming_faces == 0
    assert made.volume() == pytest.approx(mesh.volume())


def test_cells_that_cannot_be_quadratic_are_refused() -> None:
    with pytest.raises(MeshError, match="tetra10"):
        into_quadratic(bar("tetra10"))
    with pytest.raises(MeshError, match="wedge"):
        into_quadratic(bar("wedge"), centres=True)


def test_table_of_linear_types() -> None:
    assert {linear_type(name) for name in handled_types()} == {
        *("tetra", "hexahedron", "wedge", "pyramid")
    }
    with pytest.raises(MeshError, match="9 nodes per tetra10; it has 10"):
        CellBlock("tetra10", np.zeros((1, 9)))


def renumbered(mesh: Mesh, order: np.ndarray) -> Mesh:
    place = np.argsort(order).astype(np.int32)
    cells = tuple(CellBlock(block.type, place[block.nodes]) for block in mesh.cells)
    return dataclasses.replace(mesh, points=mesh.points[order], cells=cells)
