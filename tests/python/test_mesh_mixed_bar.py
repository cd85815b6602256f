"""Bars of segments: every sequence of cell types, and faces that do not match."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from tissu import _core
from tissu.cli.app import app
from tissu.errors import ParameterError
from tissu.mesh import CellBlock, Mesh, bar_mesh, mixed_bar_mesh, read_mesh
from tissu.mesh.cell import cell_table
from tissu.mesh.segment import parse_segments
from tissu.mesh.surface import enclosed_volume

LINEAR = ("wedge", "pyramid", "hexahedron", "tetra")
SEQUENCES = [s for n in (1, 2, 3) for s in itertools.product(LINEAR, repeat=n)]
SEQUENCES += list(itertools.permutations(LINEAR))
QUADRATIC = ("wedge15", "pyramid13", "hexahedron20", "tetra10")


def segmented(cells: tuple[str, ...], width: int) -> Mesh:
    return mixed_bar_mesh(
        size=(6, 2, 1),
        cells=(width * len(cells), 2, 3),
        segments=[(cell, "stvk") for cell in cells],
        origin=(-1, 0, 2),
    )


def require_sound(mesh: Mesh) -> None:
    report, surface = mesh.quality(), mesh.surface()
    assert (mesh.cell_volumes() > 0).all()
    assert report.volume == pytest.approx(12.0, rel=1e-13)
    assert enclosed_volume(mesh.points, surface.triangles) == pytest.approx(12.0, rel=1e-13)
    assert report.area == pytest.approx(2 * (12 + 6 + 2), rel=1e-13)  # no face inside is left over
    assert (report.nonconforming_faces, report.overfull_faces, report.parts) == (0, 0, 1)
    assert (report.open_edges, report.clashing_edges, len(report.unused_nodes)) == (0, 0, 0)
    assert every_face_count(mesh) == {1, 2}


def every_face_count(mesh: Mesh) -> set[int]:
    """How many cells share a face, over all faces, counted from the table of faces alone."""
    count: dict[tuple[int, ...], int] = {}
    for block in mesh.volume_blocks:
        for corners, nodes in _core.cell_faces(cell_type=block.type):
            for face in np.sort(block.nodes[:, nodes[:corners]], axis=1):
                count[tuple(face)] = count.get(tuple(face), 0) + 1
    return set(count.values())


@pytest.mark.parametrize("width", [1, 2, 3])
def test_every_sequence_matches(width: int) -> None:
    for cells in SEQUENCES:
        require_sound(segmented(cells, width))


@pytest.mark.parametrize("cells", list(itertools.permutations(QUADRATIC)))
def test_quadratic_segments_match(cells: tuple[str, ...]) -> None:
    mesh = segmented(cells, 2)
    require_sound(mesh)
    assert {block.type for block in mesh.cells} == set(QUADRATIC)


def test_regions_carry_the_segments() -> None:
    mesh = mixed_bar_mesh(
        size=(8, 1, 1),
        cells=(24, 3, 3),
        segments=parse_segments("wedge6:stvk, pyramid5:stvk, hex8:stvk, tet4:hooke"),
    )
    names = ["1 wedge stvk", "2 pyramid stvk", "3 hexahedron stvk", "4 tetra hooke"]
    assert list(mesh.regions) == names
    assert sorted(np.concatenate(list(mesh.regions.values()))) == list(range(mesh.cell_count))
    volumes = mesh.cell_volumes()
    middles = np.concatenate([mesh.points[b.nodes].mean(axis=1) for b in mesh.volume_blocks])
    for i, name in enumerate(names):
        cells = mesh.regions[name]
        assert volumes[cells].sum() == pytest.approx(2.0)
        assert 2 * i < middles[cells, 0].min() < middles[cells, 0].max() < 2 * i + 2
    assert dict(mesh.quality().cells) == {
        "wedge": 2 * 54,
        "pyramid": 6 * 54 + 9,  # the layer of the tetrahedra towards the hexahedra
        "hexahedron": 54,
        "tetra": 6 * 45 + 10 * 9,
    }


def test_wedges_lie_down_between_tetrahedra() -> None:
    assert {b.type for b in segmented(("tetra", "wedge", "wedge", "tetra"), 2).cells} == {
        "tetra",
        "wedge",
    }
    assert any(b.type == "pyramid" for b in segmented(("hexahedron", "wedge", "tetra"), 2).cells)


@pytest.mark.parametrize(
    ("segments", "cells", "found"),
    [
        ([], 4, "no segment"),
        ([("brick", "")], 4, "'brick'"),
        ([("tetra", ""), ("tetra10", "")], 4, "do not match"),
        ([("hex27", ""), ("hex20", "")], 4, "do not match"),
        ([("tetra", "")] * 3, 4, "multiple of 3"),
    ],
)
def test_wrong_segments_are_refused(
    segments: list[tuple[str, str]], cells: int, found: str
) -> None:
    with pytest.raises(ParameterError, match=found):
        mixed_bar_mesh(size=(1, 1, 1), cells=(cells, 1, 1), segments=segments)


def test_segments_are_parsed() -> None:
    assert parse_segments("tet4:hooke,hex20 , wedge: a b") == [
        ("tetra", "hooke"),
        ("hexahedron20", ""),
        ("wedge", "a b"),
    ]
    with pytest.raises(ParameterError, match="found segment of cell type ''"):
        parse_segments("tet4,,hex8")


def glued(left: Mesh, right: Mesh) -> Mesh:
    """Two meshes whose nodes at like places become one."""
    points = np.vstack([left.points, right.points])
    _, first, number = np.unique(
        np.round(points, 9) + 0.0, axis=0, return_index=True, return_inverse=True
    )
    number = number.reshape(-1)
    cells = [CellBlock(b.type, number[b.nodes]) for b in left.cells]
    cells += [CellBlock(b.type, number[b.nodes + left.node_count]) for b in right.cells]
    return Mesh(points=points[first], cells=tuple(cells))


def cube(cell: str, x: float, split: str = "six") -> Mesh:
    return bar_mesh(size=(2, 2, 2), cells=(2, 2, 2), cell=cell, split=split, origin=(x, 0, 0))


@pytest.mark.parametrize(
    ("left", "right", "places", "cells"),
    [
        (("hexahedron", "six"), ("tetra", "six"), 4, 4 + 8),
        (("pyramid", "six"), ("tetra", "five"), 4, 4 + 8),
        (("wedge", "six"), ("tetra", "six"), 4, 4 + 8),
        (("tetra", "six"), ("tetra", "six_mirrored"), 2, 4 + 4),
        (("hexahedron", "six"), ("hexahedron20", "six"), 4, 4 + 4),
        (("hexahedron27", "six"), ("hexahedron20", "six"), 4, 4 + 4),
        (("tetra10", "six"), ("hexahedron20", "six"), 4, 4 + 8),
        (("hexahedron", "six"), ("wedge", "six"), 0, 0),
        (("tetra", "six"), ("tetra", "six"), 0, 0),
    ],
)
def test_faces_that_do_not_match_are_counted(
    left: tuple[str, str], right: tuple[str, str], places: int, cells: int
) -> None:
    report = glued(cube(left[0], 0, left[1]), cube(right[0], 2, right[1])).quality()
    assert report.nonconforming_faces == places
    assert len(report.nonconforming_cells) == cells
    assert ("NO MATCH" in str(report)) == (places > 0)


def test_a_hole_is_no_mismatch() -> None:
    """Where a tetrahedron is missing, four triangles of the boundary have four corners too."""
    mesh = bar_mesh(size=(3, 3, 3), cells=(3, 3, 3), split="five")
    whole = mesh.cells[0].nodes
    for cell in range(len(whole)):
        holed = Mesh(points=mesh.points, cells=(CellBlock("tetra", np.delete(whole, cell, 0)),))
        assert holed.quality().nonconforming_faces == 0


def test_bar_of_segments_from_the_command_line(tmp_path: Path) -> None:
    out = tmp_path / "bar.vtu"
    words = ["mesh", "bar", "--size", "8", "1", "1", "--cells", "8", "2", "2", "-o", str(out)]
    segments = "wedge6:stvk, pyramid5:stvk, hex8:stvk, tet4:hooke"
    result = CliRunner().invoke(app, [*words, "--segments", segments])
    assert result.exit_code == 0, result.output
    mesh = read_mesh(out)
    assert sorted(mesh.regions) == [
        *("1 wedge stvk", "2 pyramid stvk", "3 hexahedron stvk", "4 tetra hooke")
    ]
    assert {block.type for block in mesh.cells} <= set(cell_table())
    assert mesh.quality().nonconforming_faces == 0
