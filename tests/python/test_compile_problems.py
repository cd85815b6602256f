"""What compile() refuses, and what it notes: every problem of a scene in one error."""

import dataclasses

import numpy as np
import pytest

from tissu import (
    BarMesh,
    Body,
    Box,
    Fixed,
    Hooke,
    ImplicitEuler,
    MeshFile,
    NodalLoad,
    Nodes,
    Plane,
    Prescribed,
    Pressure,
    Region,
    Scene,
    Static,
    StVK,
    SurfaceNodes,
)
from tissu.errors import SceneError
from tissu.mesh import CellBlock, bar_mesh, write_mesh

BAR = BarMesh(size=(2, 1, 1), cells=(2, 1, 1))
SOFT = StVK(young=3e3, poisson=0.4)
END = Box(None, (0, None, None))


def scene(mesh=BAR, law=SOFT, **changes):
    body = Body(mesh=mesh, law=law, density=1000)
    return Scene(**{"bodies": {"bar": body}, "step": ImplicitEuler(0.01), **changes})


def notes(made):
    """The notes, but for that on the size: these bars are in metres."""
    return [note for note in made.check().notes if "more than any organ" not in note]


def problems(made):
    found = made.check().problems
    if found:
        with pytest.raises(SceneError) as caught:
            made.compile()
        assert caught.value.problems == found
    return found


def two_bars(gap=1.0):
    one = bar_mesh(size=(1, 1, 1), cells=(1, 1, 1))
    two = one.points + np.array([1.0 + gap, 0, 0])
    nodes = np.concatenate([one.cells[0].nodes, one.cells[0].nodes + len(one.points)])
    return dataclasses.replace(
        one, points=np.concatenate([one.points, two]), cells=(CellBlock("tetra", nodes),)
    )


def test_a_good_scene_has_none():
    made = scene(fixed=[Fixed("bar", on=END)])
    assert problems(made) == []
    assert notes(made) == []


def test_all_bodies_at_once(tmp_path):
    body = scene().bodies["bar"]
    made = scene(
        bodies={
            "a": body.replace(mesh=MeshFile(tmp_path / "no.vtu")),
            "b": body.replace(law={"in": SOFT}),
            "c": body,
        },
        fixed=[
            Fixed("c", on=Box((5, 5, 5), (6, 6, None))),
            Fixed("a", on=END),
            Fixed("c", on=Plane((9, 0, 0), (1, 0, 0))),
        ],
        loads=[NodalLoad("c", on=Nodes([99]), force=(1, 0, 0))],
    )
    reaches = "body 'c', which reaches x from 0 to 2 m, y from 0 to 1 m, z from 0 to 1 m"
    assert problems(made) == [
        f"bodies.a.mesh: {tmp_path / 'no.vtu'} does not exist; the path of a mesh file is accepted",
        "bodies.b.law.in: found region 'in', but the mesh names no regions",
        f"fixed[0].on: the box (min (5, 5, 5), max (6, 6, open)) selects no node of {reaches}",
        f"fixed[2].on: the plane (point (9, 0, 0), normal (1, 0, 0)) selects no node of {reaches}",
        "loads[0].on: found node 99; the mesh has the nodes 0 to 11",
    ]


def test_problems_of_a_file_have_lines(tmp_path):
    file = tmp_path / "bar.yaml"
    scene(fixed=[Fixed("bar", on=Box((9, 9, 9), None))]).save(file)
    found = problems(Scene.from_yaml(file))
    assert len(found) == 1
    line = file.read_text().splitlines().index("  on:") + 1
    assert found[0].startswith(f"{file}:{line}: fixed[0].on: the box")


def test_unreadable_mesh(tmp_path):
    (tmp_path / "bad.vtu").write_text("nonsense")
    found = problems(scene(mesh=MeshFile(tmp_path / "bad.vtu")))
    assert len(found) == 1
    assert "bad.vtu" in found[0]
    assert "is a folder" in problems(scene(mesh=MeshFile(tmp_path)))[0]


def test_surface_only():
    bar = bar_mesh(size=(1, 1, 1), cells=(1, 1, 1))
    triangles = bar.surface().triangles
    mesh = dataclasses.replace(bar, cells=(CellBlock("triangle", triangles),))
    assert "found triangle only; a body needs volume cells" in problems(scene(mesh))[0]


def test_cells_inside_out_and_flat():
    bar = bar_mesh(size=(2, 1, 1), cells=(2, 1, 1))
    nodes = bar.cells[0].nodes.copy()
    nodes[3, :2] = nodes[3, 1::-1]
    nodes[5, 0] = nodes[5, 1]
    found = problems(scene(dataclasses.replace(bar, cells=(CellBlock("tetra", nodes),))))
    assert "1 of 12 cells is inside out (first: 3)" in found[0]
    assert "1 of 12 cells is without volume (first: 5)" in found[1]


def test_cells_that_are_not_handled():
    bar = bar_mesh(size=(2, 1, 1), cells=(2, 1, 1))
    wedge = CellBlock("wedge12", np.arange(12)[None])
    found = problems(scene(dataclasses.replace(bar, cells=(*bar.cells, wedge))))
    assert "found cells of type wedge12, not handled; accepted: tetra, hexahedron" in found[0]


def test_node_that_no_cell_uses():
    bar = bar_mesh(size=(2, 1, 1), cells=(2, 1, 1))
    points = np.concatenate([bar.points, [[0.5, 0.5, 0.5]]])
    found = problems(scene(dataclasses.replace(bar, points=points)))
    assert "1 node is used by no volume cell (first: 12)" in found[0]
    assert "`tissu mesh convert FILE -o OTHER`" in found[0]
    assert "mesh.without_unused_nodes()" in found[0]


def test_position_that_is_not_finite(tmp_path):
    nodes = "$NOD\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 nan\n$ENDNOD\n"
    (tmp_path / "nan.msh").write_text(nodes + "$ELM\n1\n1 4 1 1 4 1 2 3 4\n$ENDELM\n")
    assert "finite" in problems(scene(MeshFile(tmp_path / "nan.msh")))[0]


def test_a_body_200_m_long(tmp_path):
    write_mesh(bar_mesh(size=(200, 60, 60), cells=(2, 1, 1)), tmp_path / "long.vtu")
    found = problems(scene(MeshFile(tmp_path / "long.vtu")))
    assert "the body is 200 m long (a mesh in millimetres?)" in found[0]
    assert problems(scene(MeshFile(tmp_path / "long.vtu", unit="mm"))) == []
    assert problems(scene(MeshFile(tmp_path / "long.vtu", unit="m"))) == []
    write_mesh(bar_mesh(size=(30, 6, 6), cells=(2, 1, 1)), tmp_path / "long.vtu")
    check = scene(MeshFile(tmp_path / "long.vtu")).check()
    assert check.ok
    assert ["30 m long" in note for note in check.notes if "millimetres" in note] == [True]


def test_regions_cover_each_cell_once():
    bar = bar_mesh(size=(2, 1, 1), cells=(2, 1, 1))
    left, right = np.arange(7), np.arange(5, 11)
    mesh = dataclasses.replace(bar, regions={"left": left, "right": right})
    laws = {"left": SOFT, "right": Hooke(young=1e4, poisson=0.3)}
    found = problems(scene(mesh, laws))
    assert "1 of 12 cells is in no region of the law (first: 11)" in found[0]
    assert "2 of 12 cells are in several regions of the law (first: 5, 6)" in found[1]
    assert "did you mean 'left'" in problems(scene(mesh, {"lft": SOFT}))[0]


def test_unknown_region_in_a_selection():
    found = problems(scene(fixed=[Fixed("bar", on=Region("tip"))]))
    assert found == ["fixed[0].on: found region 'tip', but the mesh names no regions"]


def test_load_on_no_whole_face():
    found = problems(scene(loads=[Pressure("bar", on=Nodes([0, 1]), pressure=1)]))
    assert "but no face of its surface with all its nodes" in found[0]


def test_two_motions_of_one_node():
    move = Prescribed("bar", on=SurfaceNodes(), axes="z", times=[0], displacements=[(0, 0, 1)])
    found = problems(scene(fixed=[Fixed("bar", on=END)], prescribed=[move]))
    assert len(found) == 1
    assert found[0].startswith("prescribed[0]: 4 nodes are held on z by fixed[0] too (first: ")
    assert problems(scene(fixed=[Fixed("bar", on=END, axes="xy")], prescribed=[move])) == []
    assert "prescribed[1]: 12 nodes" in problems(scene(prescribed=[move, move]))[0]


def test_static_needs_supports():
    assert "body 'bar' can move freely" in problems(scene(step=Static()))[0]
    partly = [Fixed("bar", on=END, axes="xy")]
    assert (
        "needs fixed or prescribed nodes on x, y and z"
        in problems(scene(step=Static(), fixed=partly))[0]
    )
    assert problems(scene(step=Static(), fixed=[Fixed("bar", on=END)])) == []
    found = problems(scene(two_bars(), step=Static(), fixed=[Fixed("bar", on=END)]))
    assert "1 of 2 separate parts of body 'bar' can move freely" in found[0]


def test_open_sides_of_a_box_are_told_as_open():
    found = problems(scene(fixed=[Fixed("bar", on=Box(None, (-1, None, 2.5)))]))
    assert "the box (min (open, open, open), max (-1, open, 2.5)) selects" in found[0]


def test_a_body_that_nothing_holds_falls():
    found = notes(scene(gravity=(0, 0, -9.81)))
    assert found == [
        "bodies.bar: nothing holds the body, so it falls; hold nodes with `fixed`, "
        "or leave gravity out"
    ]
    planned = scene(gravity=(0, 0, -9.81)).compile().plan().notes
    assert planned == tuple(scene(gravity=(0, 0, -9.81)).check().notes)
    held = scene(gravity=(0, 0, -9.81), fixed=[Fixed("bar", on=END, axes="z")])
    assert notes(held) == []
    assert notes(scene()) == []
    assert notes(scene(gravity=(0, 0, 0))) == []


def test_notes():
    held = [Fixed("bar", on=END)]
    assert "fly free" in scene(two_bars(), fixed=held).check().notes[0]
    assert "elements lock" in scene(law=Hooke(young=1, poisson=0.49)).check().notes[0]
    light = scene().bodies["bar"].replace(density=1.05)
    assert "was g/cm^3 meant?" in scene(bodies={"bar": light}).check().notes[0]
    flat = BarMesh(size=(1, 1, 1e-3), cells=(1, 1, 1))
    assert "slivers" in scene(flat).check().notes[0]
