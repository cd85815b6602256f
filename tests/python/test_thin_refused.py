"""What a scene refuses of sheets and lines, and that files and pictures show the others."""

import meshio
import numpy as np
import pytest

import tissu as ts
from tissu import (
    BarMesh,
    Body,
    Box,
    Fibres,
    Fixed,
    Hooke,
    ImplicitEuler,
    NeoHooke,
    Prescribed,
    Scene,
    Static,
    StVK,
)
from tissu.compile import check_scene
from tissu.errors import SceneError
from tissu.mesh import CellBlock, Mesh, bar_mesh
from tissu.output.series import write_vtu
from tissu.picture import draw

LAW = StVK(young=1e4, poisson=0.3)
PLATE = BarMesh(size=(0.2, 0.1, 0), cells=(2, 1, 0), cell="quad")
TILTED = [(0, 0, 0), (1, 0, 0), (1, 1, 1), (0, 1, 1)]


def problems(mesh=PLATE, law=LAW, **fields):
    body = Body(mesh=mesh, law=law, density=1e3, **fields)
    return check_scene(Scene(bodies={"b": body}, step=ImplicitEuler(0.01))).problems


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({}, "or give `thickness` for sheets of triangles and quads"),
        (
            {"mesh": BarMesh(size=(1, 1, 1), cells=(1, 1, 1)), "thickness": 0.1},
            "no triangles or quads",
        ),
        ({"thickness": 0.1, "section": 0.1}, "found a section, but no lines in the mesh"),
        ({"thickness": 0.1, "law": NeoHooke(young=1e4, poisson=0.3)}, "found neo_hooke for sheets"),
        (
            {
                "thickness": 0.1,
                "law": LAW.replace(fibres=Fibres(k1=1.0, k2=1.0, direction=(1, 0, 0))),
            },
            "found fibres in the law of sheets",
        ),
        (
            {
                "mesh": Mesh(points=TILTED, cells=(CellBlock("quad", [[0, 1, 2, 3]]),)),
                "thickness": 0.1,
                "plane": "stress",
            },
            "found z from 0 to 1 m",
        ),
        (
            {
                "mesh": Mesh(
                    points=[(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 1, 0)],
                    cells=(CellBlock("triangle", [[0, 1, 3], [0, 1, 2]]),),
                ),
                "thickness": 0.1,
            },
            "1 of 2 triangle cells is without area (first: 1)",
        ),
        (
            {
                "mesh": Mesh(
                    points=[(0, 0, 0), (1, 0, 0), (1, 0, 0)],
                    cells=(CellBlock("line", [[0, 1], [1, 2]]),),
                ),
                "section": 0.1,
            },
            "1 of 2 line cells is without length (first: 1)",
        ),
    ],
)
def test_problems_of_thin_bodies(fields, words):
    found = problems(**fields)
    assert len(found) == 1, found
    assert words in found[0]
    assert found[0].startswith("bodies.b")


@pytest.mark.parametrize(
    "fields", [{"thickness": 0.1}, {"thickness": 0.1, "law": Hooke(young=1e4, poisson=0.3)}]
)
def test_what_is_accepted(fields):
    assert problems(**fields) == []


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"plane": "strain"}, "found plane strain without thickness"),
        ({"plane": "bent", "thickness": 1.0}, "plane"),
        ({"thickness": 0.0}, "thickness"),
        ({"section": "1 mm"}, "a length; an area is accepted"),
    ],
)
def test_fields_that_a_body_refuses(fields, words):
    with pytest.raises(SceneError, match=words):
        Body(mesh=PLATE, law=LAW, density=1e3, **fields)


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"cell": "quad", "size": (1, 1, 1), "cells": (1, 1, 0)}, "0 along z"),
        ({"cell": "line", "size": (1, 0, 0), "cells": (1, 1, 0)}, "0 along y and z"),
        ({"cell": "hexahedron", "size": (1, 1, 1), "cells": (1, 1, 0)}, "three numbers"),
    ],
)
def test_bars_that_do_not_fill_their_dimensions(fields, words):
    with pytest.raises(SceneError, match=words):
        BarMesh(**fields)


def test_a_flat_body_is_not_moved_out_of_its_plane():
    body = Body(mesh=PLATE, law=LAW, density=1e3, thickness=0.1, plane="strain")
    moved = Prescribed("b", on=Box(None, None), axes="z", times=(0,), displacements=[(0, 0, 1)])
    found = check_scene(
        Scene(bodies={"b": body}, prescribed=[moved], step=ImplicitEuler(0.01))
    ).problems
    assert len(found) == 1
    assert "6 nodes are held on z by bodies.b.plane too" in found[0]


def test_boundary_faces_stay_mere_faces():
    solid = bar_mesh(size=(1, 1, 1), cells=(1, 1, 1), cell="hexahedron")
    mesh = Mesh(points=solid.points, cells=(*solid.cells, CellBlock("quad", solid.surface().quads)))
    body = Body(mesh=mesh, law=NeoHooke(young=1e4, poisson=0.3), density=1e3)
    simulation = Scene(bodies={"b": body}, step=ImplicitEuler(0.01)).compile()
    assert [block.type for block in simulation.meshes["b"].body_blocks] == ["hexahedron"]


def mixed(**changes):
    """A hexahedron, a sheet beside it, and a line from that, as a simulation."""
    solid = bar_mesh(size=(1, 1, 1), cells=(1, 1, 1), cell="hexahedron")
    points = np.vstack([solid.points, [(2, 0, 0), (2, 1, 0), (3, 0, 0)]])
    cells = (CellBlock("line", [[8, 10]]), *solid.cells, CellBlock("quad", [[1, 8, 9, 3]]))
    body = Body(
        mesh=Mesh(points=points, cells=cells), law=LAW, density=1e3, thickness=0.1, section=0.01
    )
    scene = Scene(
        bodies={"b": body},
        fixed=[Fixed("b", on=Box(None, (0, None, None)))],
        gravity=(0, 0, -1),
        step=ImplicitEuler(0.01),
        **changes,
    )
    return scene.compile()


def test_a_sheet_is_taken_out_while_it_runs():
    simulation = mixed(editing=True)
    simulation.step()
    simulation.remove_cells(body="b", cells=[1])
    assert simulation.step().converged
    mesh = simulation.meshes["b"]
    assert [block.type for block in mesh.body_blocks] == ["hexahedron", "line"]
    assert {name: cells.tolist() for name, cells in mesh.regions.items()} == {
        "volumes": [0],
        "sheets": [],
        "lines": [1],
    }
    assert len(simulation.cell_fields("b")["von_mises"]) == 2


def test_a_static_sheet_in_space_is_noted():
    body = Body(mesh=PLATE, law=LAW, density=1e3, thickness=0.1)
    held = [Fixed("b", on=Box(None, (0, None, None)))]
    for plane, noted in ((None, True), ("stress", False)):
        scene = Scene(bodies={"b": body.replace(plane=plane)}, fixed=held, step=Static())
        notes = check_scene(scene).notes
        assert any("do not resist bending" in note for note in notes) == noted


def test_files_hold_volumes_then_sheets_then_lines(tmp_path):
    simulation = mixed()
    for _ in range(3):
        simulation.step()
    write_vtu(tmp_path / "b.vtu", simulation.meshes["b"], simulation, "b")
    written = meshio.read(tmp_path / "b.vtu")
    assert [block.type for block in written.cells] == ["hexahedron", "quad", "line"]
    of_line = simulation.cell_fields("b")["von_mises"][2]
    assert of_line > 0
    assert written.cell_data["von_mises"][2].tolist() == [of_line]


def test_the_surface_holds_sheets_once():
    mesh = mixed().meshes["b"]
    assert mesh.surface().quads[-1].tolist() == [1, 8, 9, 3]
    assert len(mesh.surface().quads) == 7
    assert mesh.surface().cells.tolist() == [0] * 12 + [1] * 2


@pytest.mark.parametrize("field", ["displacement", "von_mises"])
@pytest.mark.parametrize("cell", ["line", "quad"])
def test_pictures_show_sheets_and_lines(tmp_path, cell, field):
    from matplotlib.image import imread

    size, cells = ((1, 0, 0), (4, 0, 0)) if cell == "line" else ((1, 0.3, 0), (4, 2, 0))
    body = Body(
        mesh=BarMesh(size=size, cells=cells, cell=cell),
        law=LAW,
        density=1e3,
        **({"section": 1e-4} if cell == "line" else {"thickness": 1e-2}),
    )
    held = Fixed("b", on=Box(None, (0, None, None)))
    simulation = Scene(
        bodies={"b": body}, fixed=[held], gravity=(3, 0, -1), step=ImplicitEuler(0.01)
    ).compile()
    simulation.step()
    draw(simulation, tmp_path / "b.png", size=(600, 300), field=field)
    picture = imread(tmp_path / "b.png")[..., :3]
    left = picture[60:240, :250].reshape(-1, 3)
    coloured = np.ptp(left, axis=1) > 0.1  # the clay of a body at rest; words and bars are grey
    assert coloured.sum() > (100 if cell == "line" else 2000)


def test_surfaces_named_in_a_file_have_laws_of_their_own(tmp_path):
    """Two triangles of a Gmsh file in the groups 1 and 2, beside a line in the group 1 of lines."""
    points = [(0.0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    meshio.write(
        tmp_path / "two.msh",
        meshio.Mesh(
            np.array(points),
            [("line", [[0, 1]]), ("triangle", [[0, 1, 2], [0, 2, 3]])],
            cell_data={
                "gmsh:physical": [np.array([1]), np.array([1, 2])],
                "gmsh:geometrical": [np.array([1]), np.array([1, 1])],
            },
            field_data={
                "left": np.array([1, 2]),
                "right": np.array([2, 2]),
                "edge": np.array([1, 1]),
            },
        ),
        file_format="gmsh22",
        binary=False,
    )
    soft, stiff = LAW, LAW.replace(young=3e4)
    body = Body(
        mesh=str(tmp_path / "two.msh"),
        law={"left": soft, "right": stiff},
        density=1e3,
        thickness=0.1,
        plane="strain",
    )
    simulation = Scene(bodies={"b": body}, step=ImplicitEuler(0.01)).compile()
    mesh = simulation.meshes["b"]
    assert {name: cells.tolist() for name, cells in mesh.regions.items()} == {
        "left": [0],
        "right": [1],
    }
    simulation.positions["b"][:, 0] *= 1.01
    stress = simulation.cell_fields("b")["von_mises"]
    assert stress[1] == pytest.approx(3 * stress[0], rel=1e-9)
    both = body.replace(section=1e-3, law={"left": soft, "right": stiff, "edge": stiff})
    again = Scene(bodies={"b": both}, step=ImplicitEuler(0.01)).compile().meshes["b"]
    assert again.regions["edge"].tolist() == again.regions["lines"].tolist() == [2]


def test_the_check_says_which_sheets_and_lines_there_are():
    body = Body(mesh=PLATE, law=LAW, density=1e3, thickness="2 mm", plane="strain")
    check = check_scene(Scene(bodies={"b": body}, step=ImplicitEuler(0.01)))
    told = [str(effect) for effect in check.effects]
    assert "sheets of b: bodies.b.thickness is 0.002 m, plane is strain" in told
    assert "lines" in check.absent
    assert "sheets" not in check.absent


def test_what_pulls_a_flat_body_along_z_is_noted():
    mesh = ts.bar_mesh(size=(1, 1, 0), cells=(1, 1, 0), cell="quad")
    body = ts.Body(
        mesh=mesh, law=ts.Hooke(young=1e3, poisson=0.3), density=1e3, thickness=0.1, plane="strain"
    )
    scene = ts.Scene(
        bodies={"b": body},
        gravity=(0, 0, -9.81),
        loads=[ts.NodalLoad("b", on=ts.Nodes([0]), force=(0, 0, 1))],
        step=ts.ImplicitEuler(0.01),
    )
    notes = scene.check().notes
    assert sum("whose `plane` holds z" in note for note in notes) == 2


@pytest.mark.parametrize(
    "wrong",
    [
        {"thickness": "-1 mm"},
        {"thickness": "1 mm", "plane": "foo"},
        {"thickness": "1 mm", "mass": 1},
        {"thickness": "1 mm", "law": "{type: neo_hooke, young: -1 kPa, poisson: 0.3}"},
    ],
)
def test_another_fault_does_not_hide_a_law_that_sheets_cannot_have(wrong):
    law = "{type: neo_hooke, young: 1 kPa, poisson: 0.3}"
    fields = {"law": law, "density": 1000, **wrong}
    body = "".join(f"    {name}: {value}\n" for name, value in fields.items())
    text = "bodies:\n  b:\n    mesh: {type: bar, size: [1, 1, 0], cells: [2, 2, 0], cell: quad}\n"
    text += f"{body}step: {{type: implicit_euler, dt: 10 ms}}\n"
    with pytest.raises(SceneError) as caught:
        ts.Scene.from_yaml_text(text).compile()
    assert len(caught.value.problems) == 2, caught.value.problems
    assert any("found neo_hooke for sheets" in problem for problem in caught.value.problems)
