"""Mesh, surface and quality report."""

from __future__ import annotations

import numpy as np
import pytest

from tissu.errors import MeshError
from tissu.mesh import CellBlock, Mesh, bar_mesh
from tissu.mesh.surface import enclosed_volume

TETRA = [[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]


def one(points: object, *blocks: tuple[str, list[list[int]]], **more: object) -> Mesh:
    cells = tuple(CellBlock(name, np.array(nodes)) for name, nodes in blocks)
    return Mesh(points=np.array(points, dtype=float), cells=cells, **more)


def test_arrays_are_read_only_copies() -> None:
    points = np.array(TETRA)
    mesh = Mesh(points=points, cells=(CellBlock("tetra", np.array([[0, 1, 2, 3]])),))
    points[0] = 9.0
    assert mesh.points[0, 0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        mesh.points[0] = 1.0
    with pytest.raises(ValueError, match="read-only"):
        mesh.cells[0].nodes[0] = 1
    assert mesh.cells[0].nodes.dtype == np.int32


def test_positions_that_are_not_finite_are_counted() -> None:
    points = np.zeros((9, 3))
    points[[1, 2, 3, 4, 5, 7]] = np.nan
    with pytest.raises(MeshError, match=r"6 of 9 nodes .* \(first: 1, 2, 3, 4, 5, \.\.\.\)"):
        one(points, ("tetra", [[0, 1, 2, 3]]))


@pytest.mark.parametrize("node", [-1, 4])
def test_nodes_that_do_not_exist_are_refused(node: int) -> None:
    with pytest.raises(MeshError, match="numbers from 0 to 3 are accepted"):
        one(TETRA, ("tetra", [[0, 1, 2, node]]))


def test_regions_that_do_not_fit_are_refused() -> None:
    with pytest.raises(MeshError, match="region 'skin'"):
        one(TETRA, ("tetra", [[0, 1, 2, 3]]), regions={"skin": [1]})


def test_unknown_cell_type_and_wrong_width_are_refused() -> None:
    with pytest.raises(MeshError, match="'blob'"):
        CellBlock("blob", np.zeros((1, 3)))
    with pytest.raises(MeshError, match="3 nodes per tetra"):
        CellBlock("tetra", np.zeros((1, 3)))


@pytest.mark.parametrize("nodes", [[[0.5, 1.9, 2, 3]], [[0, 1, 2, 2**32]]])
def test_numbers_are_not_cut_off(nodes) -> None:
    with pytest.raises(MeshError, match="whole numbers up to 2147483647 are accepted"):
        CellBlock("tetra", nodes)


def test_blocks_that_are_not_handled_stay_and_are_named() -> None:
    points = np.vstack([TETRA, np.random.default_rng(0).random((6, 3))])
    mesh = one(points, ("tetra", [[0, 1, 2, 3]]), ("wedge12", [list(range(4, 10))]))
    assert [block.type for block in mesh.volume_blocks] == ["tetra"]
    assert mesh.unhandled == ("wedge12",)
    assert mesh.cell_count == 1
    assert "NOT HANDLED" in str(mesh.quality())


def test_distorted_hexahedra_have_the_volume_of_their_surface() -> None:
    """The bilinear surface lies halfway between its two triangulations."""
    bar = bar_mesh(size=(3, 2, 2), cells=(3, 2, 2), cell="hexahedron")
    points = bar.points + 0.1 * np.random.default_rng(1).standard_normal(bar.points.shape)
    mesh = Mesh(points=points, cells=bar.cells)
    quads = mesh.surface().quads
    halves = [
        np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]),
        np.concatenate([quads[:, [0, 1, 3]], quads[:, [1, 2, 3]]]),
    ]
    mean = np.mean([enclosed_volume(mesh.points, triangles) for triangles in halves])
    assert mesh.volume() == pytest.approx(mean, rel=1e-12)


def test_surface_names_its_cells_and_quads() -> None:
    bar = bar_mesh(size=(2, 1, 1), cells=(2, 1, 1), cell="hexahedron")
    surface = bar.surface()
    assert surface.quads.shape == (10, 4)
    assert surface.triangles.shape == (20, 3)
    assert sorted(np.bincount(surface.cells)) == [10, 10]
    for triangle, cell in zip(surface.triangles, surface.cells, strict=True):
        assert set(triangle) <= set(bar.cells[0].nodes[cell])
    np.testing.assert_array_equal(surface.nodes, np.arange(12))


def test_surface_mesh_keeps_the_outer_nodes_only() -> None:
    skin = bar_mesh(size=(3, 3, 3), cells=(3, 3, 3), cell="hexahedron").surface_mesh()
    assert (skin.node_count, [block.type for block in skin.cells]) == (64 - 8, ["quad"])
    report = skin.quality()
    assert report.closed
    assert report.volume == pytest.approx(27.0)
    assert report.area == pytest.approx(54.0)
    assert skin.volume() == 0.0


def test_quality_of_a_good_mesh() -> None:
    report = bar_mesh(size=(3, 1, 1), cells=(3, 1, 1)).quality()
    assert (report.parts, report.open_edges, report.overfull_faces) == (1, 0, 0)
    assert len(report.inverted) == len(report.zero_volume) == len(report.unused_nodes) == 0
    assert report.size_ratio == pytest.approx(1.0)
    assert 0.0 < report.min_quality <= report.median_quality <= 1.0
    assert report.shapes[report.worst[0]] == report.min_quality
    text = str(report)
    assert "18 tetra" in text
    assert "closed" in text
    assert not any(word.isupper() and len(word) > 2 for word in text.split())  # no fault


def test_quality_names_faults() -> None:
    points = [*TETRA, [1, 1, 0], [5, 5, 5]]
    mesh = one(points, ("tetra", [[0, 1, 2, 3], [0, 2, 1, 3], [0, 1, 2, 4]]))
    report = mesh.quality()
    assert report.inverted.tolist() == [1]
    assert report.zero_volume.tolist() == [2]
    assert report.unused_nodes.tolist() == [5]
    for word in ("INVERTED", "NO VOLUME", "UNUSED", "OVERLAP"):
        assert word in str(report)


def test_tangled_hexahedron_is_inverted() -> None:
    bar = bar_mesh(size=(1, 1, 1), cells=(1, 1, 1), cell="hexahedron")
    points = bar.points.copy()
    points[[4, 7]] = points[[7, 4]]
    assert Mesh(points=points, cells=bar.cells).quality().inverted.tolist() == [0]


def test_unused_nodes_go_and_regions_stay() -> None:
    points = [[9, 9, 9], *TETRA, [8, 8, 8]]
    mesh = one(
        points, ("triangle", [[0, 1, 2], [1, 2, 3]]), ("tetra", [[1, 2, 3, 4]]), regions={"a": [0]}
    )
    assert mesh.unused_nodes.tolist() == [0, 5]
    clean = mesh.without_unused_nodes()
    np.testing.assert_array_equal(clean.points, TETRA)
    assert clean.cells[0].nodes.tolist() == [[0, 1, 2]]
    assert clean.cells[1].nodes.tolist() == [[0, 1, 2, 3]]
    assert clean.regions["a"].tolist() == [0]
    assert clean.notes == ("2 nodes dropped: no cell uses them",)
    assert clean.without_unused_nodes() is clean


def test_parts_are_numbered() -> None:
    points = np.vstack([TETRA, np.array(TETRA) + 5.0])
    mesh = one(points, ("tetra", [[0, 1, 2, 3], [4, 5, 6, 7]]))
    assert mesh.parts().tolist() == [0, 1]
    assert mesh.quality().parts == 2
    assert mesh.surface_mesh().quality().parts == 2


def test_surface_wound_inwards_and_clashing() -> None:
    faces = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [0, 2, 3]]  # of a tetrahedron, inwards
    inwards = one(TETRA, ("triangle", faces)).quality()
    assert inwards.volume == pytest.approx(-1 / 6)
    assert "wound inwards" in str(inwards)
    faces[0].reverse()
    assert one(TETRA, ("triangle", faces)).quality().clashing_edges == 3
    assert one(TETRA, ("triangle", faces[1:])).quality().open_edges == 3
