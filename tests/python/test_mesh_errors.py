"""What is not a mesh gives one sentence, whatever it is."""

from __future__ import annotations

from pathlib import Path

import pytest

from tissu.errors import MeshError
from tissu.mesh import CellBlock, Mesh, bar_mesh, read_mesh, write_mesh

VOLUMES = [".vtu", ".vtk", ".msh", ".mesh", ".inp", ".xdmf", ".bdf", ".su2", ".mdpa", ".dat"]
SURFACES = [".obj", ".off", ".stl", ".ply", ".wkt"]
GARBAGE = bytes(range(256)) * 3


def refused(path: Path) -> str:
    with pytest.raises(MeshError) as caught:
        read_mesh(path)
    text = str(caught.value)
    assert text.startswith(str(path))
    assert "\n" not in text
    return text.removeprefix(str(path))


def test_missing_file(tmp_path: Path) -> None:
    assert refused(tmp_path / "no.vtu") == " does not exist; the path of a mesh file is accepted"


def test_folder(tmp_path: Path) -> None:
    assert "is a folder" in refused(tmp_path)


def test_unknown_ending(tmp_path: Path) -> None:
    path = tmp_path / "a.organ"
    path.write_text("organ")
    assert "no format has the ending '.organ'" in refused(path)


@pytest.mark.parametrize("ending", [*VOLUMES, *SURFACES, ".trian"])
def test_empty_file_and_garbage(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"a{ending}"
    path.write_bytes(b"")
    assert "is empty" in refused(path)
    path.write_bytes(GARBAGE)
    refused(path)


@pytest.mark.parametrize("ending", [*VOLUMES, *SURFACES])
def test_truncated_file(tmp_path: Path, ending: str) -> None:
    """Also where meshio by itself would wait for the end of the file for ever."""
    bar = bar_mesh(size=(2, 1, 1), cells=(2, 1, 1))
    path = tmp_path / f"a{ending}"
    write_mesh(bar.surface_mesh() if ending in SURFACES else bar, path)
    assert read_mesh(path).node_count == 12
    whole = path.read_bytes()
    shares = (0.2,) if ending == ".obj" else (0.2, 0.5, 0.8)  # .obj does not count its faces
    for share in shares:
        path.write_bytes(whole[: int(share * len(whole))])
        refused(path)


def test_wrong_ending_has_a_remedy(tmp_path: Path) -> None:
    write_mesh(bar_mesh(size=(1, 1, 1), cells=(1, 1, 1)), tmp_path / "a.vtu")
    wrong = (tmp_path / "a.vtu").rename(tmp_path / "a.msh")
    assert refused(wrong).endswith("begins like a VTU file: give it the ending .vtu")


def test_nothing_is_printed(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "a.vtk"
    path.write_text("# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4\n")
    refused(path)
    assert capfd.readouterr() == ("", "")


def test_file_without_cells(tmp_path: Path) -> None:
    path = tmp_path / "a.obj"
    path.write_text("v 0 0 0\nv 1 0 0\n")
    assert "found no cells" in refused(path)


def test_writing_says_what_it_cannot(tmp_path: Path) -> None:
    bar = bar_mesh(size=(1, 1, 1), cells=(1, 1, 1))
    with pytest.raises(MeshError, match="no format has the ending"):
        write_mesh(bar, tmp_path / "a.organ")
    with pytest.raises(MeshError, match="surfaces only"):
        write_mesh(bar, tmp_path / "a.stl")
    with pytest.raises(MeshError, match="cannot be written"):
        write_mesh(bar, tmp_path / "no" / "a.vtu")


@pytest.mark.parametrize("ending", [".msh", ".vtk", ".stl", ".ply"])
def test_damaged_binary_files_are_refused_in_words(tmp_path: Path, ending: str) -> None:
    import meshio

    bar = bar_mesh(size=(1, 1, 1), cells=(2, 2, 2))
    cells = {
        ".stl": [("triangle", bar.surface().triangles)],
        ".ply": [("triangle", bar.surface().triangles)],
    }
    file = tmp_path / f"bar{ending}"
    content = meshio.Mesh(bar.points, cells.get(ending, [("tetra", bar.cells[0].nodes)]))
    meshio.write(file, content, binary=True)
    whole = file.read_bytes()
    damaged = 0
    for number in range(80):
        at = number // 2 * (len(whole) // 40)  # bytes overwritten here, or the file cut
        rest = b"\xff\xd0\xf0\x82" * 10 + whole[at + 40 :] if number % 2 else b"\xff"
        file.write_bytes(whole[:at] + rest)
        try:
            read_mesh(file)
        except MeshError as error:
            assert "codec" not in str(error)
            assert "Unicode" not in str(error)
            damaged += "not text where text is expected; is it damaged?" in str(error)
    assert damaged > 0


def test_cells_may_be_given_as_meshio_takes_them() -> None:
    points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    block = CellBlock("tetra", [[0, 1, 2, 3]])
    for cells in ([("tetra", [[0, 1, 2, 3]])], {"tetra": [[0, 1, 2, 3]]}, (block,)):
        mesh = Mesh(points=points, cells=cells)
        assert [(b.type, b.nodes.tolist()) for b in mesh.cells] == [("tetra", [[0, 1, 2, 3]])]


@pytest.mark.parametrize("cells", [[3], ["tetra"], [("tetra",)], [(4, [[0, 1, 2, 3]])], "tetra"])
def test_what_are_no_cells_is_said(cells: object) -> None:
    with pytest.raises(MeshError, match="among the cells; blocks of cells are accepted"):
        Mesh(points=[[0, 0, 0]], cells=cells)
