"""Readers: small files of each format that is read here, and what a reader does to a mesh."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tissu.errors import MeshError, ParameterError
from tissu.mesh import read_mesh

GMSH1 = """$NOD
5
10 0 0 0
2 1 0 0
30 0 1 0
4 0 0 1
77 1 1 1
$ENDNOD
$ELM
4
1 15 0 1 1 10
2 2 9 1 3 10 2 30
3 4 3 1 4 10 2 30 4
4 4 5 1 4 2 77 30 4
$ENDELM
"""

GMSH2 = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
2 9 "skin"
3 1 "liver lobe"
3 2 "tumour"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 1 1 1
$EndNodes
$Elements
3
1 2 2 9 1 1 2 3
2 4 2 1 1 1 2 3 4
3 4 2 2 1 2 5 3 4
$EndElements
"""

POLYDATA = """# vtk DataFile Version 3.0
a pyramid and a strip
ASCII
DATASET POLYDATA
POINTS 5 float
0 0 0 1 0 0 1 1 0
0 1 0 0.5 0.5 1
POLYGONS 3 13
4 0 3 2 1
3 0 1 4
3 1 2 4
TRIANGLE_STRIPS 1 5
4 2 3 4 0
CELL_DATA 4
SCALARS s float
"""


def write(path: Path, text: str | bytes) -> Path:
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def test_gmsh1_with_scattered_numbers(tmp_path: Path) -> None:
    mesh = read_mesh(write(tmp_path / "a.msh", GMSH1))
    assert [block.type for block in mesh.cells] == ["vertex", "triangle", "tetra"]
    assert mesh.cells[2].nodes.tolist() == [[0, 1, 2, 3], [1, 4, 2, 3]]
    assert mesh.points[4].tolist() == [1, 1, 1]
    assert {name: cells.tolist() for name, cells in mesh.regions.items()} == {"3": [0], "5": [1]}
    assert mesh.notes == (
        "1 cell of type vertex left out of the volume",
        "1 cell of type triangle left out of the volume",
    )


def test_gmsh1_with_windows_lines(tmp_path: Path) -> None:
    mesh = read_mesh(write(tmp_path / "a.msh", GMSH1.replace("\n", "\r\n")))
    assert mesh.cell_count == 2


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("30 0 1 0\n", "30 0 one 0\n", "line 5: found '30 0 one 0'"),
        ("30 0 1 0\n", "30 0 1\n", "line 5: found '30 0 1'"),
        ("30 0 1 0\n", "2 0 1 0\n", "node 2 is listed more than once"),
        ("2 77 30 4\n", "2 78 30 4\n", "uses node 78, which is not among"),
        ("4 5 1 4 2 77", "99 5 1 4 2 77", "line 14: .* a type with its number of nodes"),
        ("4 4 5 1 4 2 77 30 4", "4 4 5 1 4 2 77 30", "line 14: "),
        ("$ENDELM", "", "the file ends after line 14"),
        ("\n4\n1 15", "\n400\n1 15", "400 elements are announced"),
        ("$ELM", "$EML", r"where \$ELM is expected"),
        ("0 0 1\n", "0 0 nan\n", "1 of 5 nodes whose position is not finite"),
    ],
)
def test_gmsh1_faults_are_said_with_their_place(
    tmp_path: Path, old: str, new: str, said: str
) -> None:
    assert old in GMSH1
    with pytest.raises(MeshError, match=said):
        read_mesh(write(tmp_path / "a.msh", GMSH1.replace(old, new, 1)))


def test_gmsh2_physical_names_are_regions(tmp_path: Path) -> None:
    mesh = read_mesh(write(tmp_path / "a.msh", GMSH2))
    regions = {name: cells.tolist() for name, cells in mesh.regions.items()}
    assert regions == {"liver lobe": [0], "tumour": [1]}


@pytest.mark.parametrize("ending", [".vtk", ".VTK"])
def test_polydata_text(tmp_path: Path, ending: str) -> None:
    mesh = read_mesh(write(tmp_path / f"a{ending}", POLYDATA))
    report = mesh.quality()
    assert {b.type: len(b) for b in mesh.cells} == {"triangle": 4, "quad": 1}
    assert report.closed
    assert report.clashing_edges == 0
    assert report.volume == pytest.approx(1 / 3)


@pytest.mark.parametrize("new", [False, True])
def test_polydata_binary(tmp_path: Path, new: bool) -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=">f8")
    faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    version = "5.1" if new else "3.0"
    text = f"# vtk DataFile Version {version}\nx\nBINARY\nDATASET POLYDATA\nPOINTS 4 double\n"
    content = text.encode() + points.tobytes()
    if new:
        content += b"\nMETADATA\nINFORMATION 0\n\nPOLYGONS 5 12\nOFFSETS vtktypeint64\n"
        content += np.arange(0, 13, 3).astype(">i8").tobytes()
        content += b"\nCONNECTIVITY vtktypeint64\n" + faces.astype(">i8").tobytes() + b"\n"
    else:
        rows = np.column_stack([np.full(4, 3), faces])
        content += b"\nPOLYGONS 4 16\n" + rows.astype(">i4").tobytes() + b"\n"
    mesh = read_mesh(write(tmp_path / "a.vtk", content))
    assert mesh.quality().volume == pytest.approx(1 / 6)
    with pytest.raises(MeshError, match="truncated"):
        read_mesh(write(tmp_path / "b.vtk", content[:-20]))


def test_trian(tmp_path: Path) -> None:
    text = "4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n4\n0 2 1 1 2 3\n0 1 3 0 2 3\n1 2 3 0 1 3\n0 3 2 0 1 2\n"
    assert read_mesh(write(tmp_path / "a.trian", text)).quality().volume == pytest.approx(1 / 6)
    with pytest.raises(MeshError, match="line 3: found '1 0'"):
        read_mesh(write(tmp_path / "b.trian", text.replace("1 0 0\n", "1 0\n", 1)))


@pytest.mark.parametrize(
    "head", ["OFF\n8 6 0\n", "OFF 8 6 12\n", "# made by hand\nCOFF\n\n8 6 0\n"]
)
def test_off(tmp_path: Path, head: str) -> None:
    nodes = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    faces = "4 0 3 2 1 255 0 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n"
    mesh = read_mesh(write(tmp_path / "a.off", head + nodes + faces))
    assert [(block.type, len(block)) for block in mesh.cells] == [("quad", 6)]
    assert mesh.quality().volume == pytest.approx(1.0)
    with pytest.raises(MeshError, match="nodes"):
        read_mesh(write(tmp_path / "b.off", head + nodes + faces.replace("6 7", "6 8")))


def test_obj_with_texture_normals_and_polygons(tmp_path: Path) -> None:
    text = """mtllib x.mtl
v 0 0 0
v 2 0 0 1 0 0
v 3 1 0
v 2 2 0
v 0 2 0
v 0 0 5
vt 0 0
vn 0 0 1
f 1/1/1 2/1/1 3//1 4/1 \\
  5
f -6 -5 -1  # backwards
"""
    mesh = read_mesh(write(tmp_path / "a.obj", text))
    assert [(block.type, len(block)) for block in mesh.cells] == [("triangle", 4)]
    assert mesh.cells[0].nodes[0].tolist() == [0, 1, 5]
    assert mesh.quality().area == pytest.approx(5.0 + 5.0)
    assert mesh.notes == ("1 face of more than four corners split into triangles",)


@pytest.mark.parametrize("line", ["f 1 2 0", "f 1 2 x", "v 1 2", "f -9 1 2"])
def test_obj_faults_are_said_with_their_line(tmp_path: Path, line: str) -> None:
    with pytest.raises(MeshError, match=f"line 4: found '{line}'"):
        read_mesh(write(tmp_path / "a.obj", f"v 0 0 0\nv 1 0 0\nv 0 1 0\n{line}\n"))


def test_unit_and_scale_multiply_and_are_kept(tmp_path: Path) -> None:
    path = write(tmp_path / "a.msh", GMSH1)
    mesh = read_mesh(path, unit="mm", scale=2.0)
    assert mesh.bounds[1].tolist() == [0.002, 0.002, 0.002]
    assert (mesh.source, mesh.unit, mesh.scale) == (str(path), "mm", 2.0)
    assert read_mesh(path, unit="inch").bounds[1, 0] == pytest.approx(0.0254)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"unit": "kg"}, "mass"),
        ({"unit": "foo"}, "foo"),
        ({"unit": ""}, "unit"),
        ({"scale": 0.0}, "0"),
    ],
)
def test_wrong_unit_or_scale_is_refused(tmp_path: Path, arguments: dict, said: str) -> None:
    with pytest.raises(ParameterError, match=said):
        read_mesh(write(tmp_path / "a.msh", GMSH1), **arguments)


def test_reversed_cells_are_turned_round(tmp_path: Path) -> None:
    mesh = read_mesh(write(tmp_path / "a.msh", GMSH1.replace("4 10 2 30 4", "4 10 30 2 4")))
    assert (mesh.cell_volumes() > 0).all()
    assert mesh.notes[-1] == "1 cell with reversed winding turned round"


def test_unused_nodes_are_kept_and_noted(tmp_path: Path) -> None:
    text = GMSH1.replace("4\n1 15", "3\n1 15").replace("4 4 5 1 4 2 77 30 4\n", "")
    mesh = read_mesh(write(tmp_path / "a.msh", text))
    assert mesh.unused_nodes.tolist() == [4]
    assert mesh.notes[-1] == "1 node is used by no volume cell (4)"


GMSH4 = """\
$MeshFormat
4.1 0 8
$EndMeshFormat
$Nodes
1 4 1 4
3 0 0 4
1
2
3
4
0 0 0
1 0 0
0 1 0
0 0 1
$EndNodes
$Elements
1 1 7 7
3 0 4 1
7 1 2 3 4
$EndElements
"""


@pytest.mark.parametrize("tag", ["0", "-1"])
def test_gmsh_tags_that_no_node_can_have(tmp_path: Path, tag: str) -> None:
    """The library below takes 0 for the last node, and -1 for the one before."""
    two = GMSH4.replace("4.1 0 8", "2.2 0 8").replace("1 4 1 4\n3 0 0 4\n1\n2\n3\n4\n", "4\n")
    for number, row in enumerate(("0 0 0", "1 0 0", "0 1 0", "0 0 1"), start=1):
        two = two.replace(f"\n{row}\n", f"\n{number} {row}\n")
    two = two.replace("1 1 7 7\n3 0 4 1\n7 1", "1\n7 4 2 0 0 1")
    for text, nodes in ((GMSH4, "7 1 2 3 4"), (two, "0 0 1 2 3 4")):
        assert read_mesh(write(tmp_path / "a.msh", text)).cells[0].nodes.tolist() == [[0, 1, 2, 3]]
        assert text.count(nodes) == 1
        wrong = text.replace(nodes, nodes.replace("2 3 4", f"{tag} 3 4"))
        with pytest.raises(MeshError, match=f"a.msh: cell 7 has the node {tag}; tags from 1 on"):
            read_mesh(write(tmp_path / "a.msh", wrong))
