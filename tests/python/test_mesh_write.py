"""Round trips through files."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from tissu.errors import MeshError
from tissu.mesh import CellBlock, Mesh, bar_mesh, read_mesh, write_mesh


def mixed(regions: dict[str, list[int]]) -> Mesh:
    """Two tetrahedra, a hexahedron beside them and two of its faces."""
    bar = bar_mesh(size=(1, 1, 1), cells=(1, 1, 1), cell="hexahedron")
    apart = np.array([[5.0, 0, 0], [6, 0, 0], [5, 1, 0], [5, 0, 1], [6, 1, 1]])
    tetra = CellBlock("tetra", np.array([[8, 9, 10, 11], [9, 12, 10, 11]]))
    quads = CellBlock("quad", bar.surface().quads[:2])
    return Mesh(
        points=np.vstack([bar.points, apart]) / 3.0,
        cells=(tetra, quads, *bar.cells),
        regions={name: np.array(cells) for name, cells in regions.items()},
    )


def assert_same(found: Mesh, wanted: Mesh) -> None:
    np.testing.assert_allclose(found.points, wanted.points, rtol=1e-14)
    blocks = {block.type: block.nodes.tolist() for block in wanted.cells}
    assert {block.type: block.nodes.tolist() for block in found.cells} == blocks


@pytest.mark.parametrize("ending", [".vtu", ".vtk", ".msh", ".mesh", ".inp", ".xdmf"])
def test_mixed_cells_survive(tmp_path: Path, ending: str) -> None:
    mesh = mixed({})
    write_mesh(mesh, tmp_path / f"a{ending}")
    assert_same(read_mesh(tmp_path / f"a{ending}"), mesh)


@pytest.mark.parametrize("ending", [".vtu", ".vtk", ".xdmf"])
def test_overlapping_regions_survive(tmp_path: Path, ending: str) -> None:
    mesh = mixed({"left": [0, 1], "both": [0, 2]})
    write_mesh(mesh, tmp_path / f"a{ending}")
    regions = read_mesh(tmp_path / f"a{ending}").regions
    assert {name: cells.tolist() for name, cells in regions.items()} == {
        "left": [0, 1],
        "both": [0, 2],
    }


def test_regions_survive_in_gmsh(tmp_path: Path) -> None:
    write_mesh(mixed({"lobe": [0], "7": [1, 2]}), tmp_path / "a.msh")
    regions = read_mesh(tmp_path / "a.msh").regions
    assert {name: cells.tolist() for name, cells in regions.items()} == {"lobe": [0], "7": [1, 2]}
    with pytest.raises(MeshError, match="several regions"):
        write_mesh(mixed({"a": [0], "b": [0]}), tmp_path / "a.msh")


def test_regions_that_are_lost_are_said(tmp_path: Path) -> None:
    with pytest.warns(UserWarning, match="keeps no regions"):
        write_mesh(mixed({"lobe": [0]}), tmp_path / "a.inp")


@pytest.mark.parametrize("ending", [".obj", ".off", ".stl", ".ply"])
def test_surfaces_survive(tmp_path: Path, ending: str) -> None:
    skin = bar_mesh(size=(3, 2, 1), cells=(3, 2, 1)).surface_mesh()
    write_mesh(skin, tmp_path / f"a{ending}")
    report = read_mesh(tmp_path / f"a{ending}").quality()
    assert report.closed
    assert report.clashing_edges == 0
    assert report.volume == pytest.approx(6.0, rel=1e-6)


def test_lengths_are_written_in_metres(tmp_path: Path) -> None:
    write_mesh(bar_mesh(size=(3, 2, 1), cells=(1, 1, 1)), tmp_path / "a.vtu")
    small = read_mesh(tmp_path / "a.vtu", unit="mm")
    write_mesh(small, tmp_path / "b.vtu")
    np.testing.assert_array_equal(read_mesh(tmp_path / "b.vtu").points, small.points)


def test_replaced_mesh_is_checked_again() -> None:
    mesh = bar_mesh(size=(1, 1, 1), cells=(1, 1, 1))
    with pytest.raises(MeshError, match="not finite"):
        dataclasses.replace(mesh, points=np.full_like(mesh.points, np.inf))
