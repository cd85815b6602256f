"""What holds a body after edits: grabs on copies of cells, on what is gone, and what is refused."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import tissu as ts
from cut_states import damped_bar

ROOT = ts.Plane((0, 0, 0), (1, 0, 0))
TIP = ts.Plane((0.1, 0, 0), (1, 0, 0))
AT = 0.048  # of the cut along x [m]
CORNER = ts.Box(min=(0.079, 0.019, 0.019))  # one hexahedron at the tip, or as much of tetrahedra

BLOCKS: dict[str, Any] = {
    "tetra": "virtual",
    "tetra-divided": "subdivide",
    "tetra-moved": "snap",
    "hexahedron": "virtual",
    "wedge": "virtual",
    "pyramid": "virtual",
    "tetra10": "virtual",
    "hexahedron20": "virtual",
}


def _scene(kind: str = "hexahedron", **changes: Any) -> ts.Scene:
    cell: Any = kind.split("-")[0]
    body = damped_bar(cell)
    fields: dict[str, Any] = {
        "bodies": {"b": body},
        "step": ts.ImplicitEuler(0.01),
        "editing": ts.Editing(room="300 %", method=BLOCKS[kind]),
        "grabbing": True,
    }
    return ts.Scene(**{**fields, **changes})


def _rises(simulation: ts.Simulation, steps: int = 12) -> tuple[float, float]:
    """How far the pieces on both sides of the cut have gone along z, in the mean [m]."""
    for _ in range(steps):
        simulation.step()
    material = simulation.material("b")
    moved = np.abs((material.points - material.mesh.points)[:, 2])
    x = material.mesh.points[:, 0]
    return float(moved[x < AT - 2e-3].mean()), float(moved[x > AT + 2e-3].mean())


def _pulls_one_side(simulation: ts.Simulation, x: float) -> None:
    left, right = _rises(simulation)
    own, other = (left, right) if x < AT else (right, left)
    assert own > 1e-4
    assert other < 1e-3 * own


@pytest.mark.parametrize("x", [0.042, 0.055])
@pytest.mark.parametrize("kind", BLOCKS)
def test_a_grab_holds_the_piece_that_has_its_place(kind: str, x: float) -> None:
    simulation = _scene(kind).compile()
    simulation.cut("b", ts.Plane((AT, 0.02, 0.02), (1, 0, 0)))
    grab = simulation.grab("b", (x, 0.022, 0.017), target=(x, 0.022, 0.037), stiffness=20.0)
    np.testing.assert_allclose(grab.position, (x, 0.022, 0.017), atol=1e-12)
    _pulls_one_side(simulation, x)


@pytest.mark.parametrize("x", [0.042, 0.055])
@pytest.mark.parametrize("kind", BLOCKS)
def test_a_drag_holds_the_piece_that_has_its_place(kind: str, x: float) -> None:
    simulation = _scene(kind).compile()
    simulation.cut("b", ts.Plane((AT, 0.02, 0.02), (1, 0, 0)))
    grab = simulation.drag("b", (x, 0.022, 0.04), stiffness=20.0)
    np.testing.assert_allclose(grab.position, (x, 0.022, 0.04), atol=1e-9)
    grab.target = grab.position + np.array([0, 0, 0.02])
    _pulls_one_side(simulation, x)


THIN: dict[str, dict[str, Any]] = {
    "quad": {"thickness": 2e-3, "law": ts.StVK(young=1e5, poisson=0.3)},
    "triangle": {"thickness": 2e-3, "law": ts.StVK(young=1e5, poisson=0.3)},
    "line": {"section": 1e-6, "law": ts.StVK(young=1e6, poisson=0.3)},
    "shell": {"thickness": 2e-3, "law": ts.Hooke(young=1e5, poisson=0.3), "model": "shell"},
}


@pytest.mark.parametrize("x", [0.0425, 0.055])
@pytest.mark.parametrize("kind", THIN)
def test_sheets_shells_and_lines_too(kind: str, x: float) -> None:
    cell = "triangle" if kind == "shell" else kind
    size, cells = ((0.1, 0, 0), (5, 0, 0)) if kind == "line" else ((0.1, 0.06, 0), (5, 3, 0))
    body = ts.Body(
        mesh=ts.bar_mesh(size=size, cells=cells, cell=cell),
        density=1000.0,
        viscosity=ts.Rayleigh(mass=20.0),
        **THIN[kind],
    )
    scene = ts.Scene(bodies={"b": body}, step=ts.ImplicitEuler(0.01), editing=True, grabbing=True)
    y = 0.0 if kind == "line" else 0.033
    for drags in (False, True) if kind != "shell" else (True,):
        simulation = scene.compile()
        simulation.cut("b", ts.Plane((AT, 0, 0), (1, 0, 0)))
        if drags:
            simulation.drag("b", (x, y, 0.0), stiffness=0.5).target = (x, y, 0.01)
        else:
            simulation.grab("b", (x, y, 0.0), target=(x, y, 0.01), stiffness=0.5)
        _pulls_one_side(simulation, x)


def test_a_place_whose_material_is_gone_is_in_no_cell_of_the_copies() -> None:
    simulation = _scene().compile()
    simulation.cut("b", ts.Plane((AT, 0.02, 0.02), (1, 0, 0)))
    simulation.ablate("b", ts.Box(min=(AT, None, None), max=(0.061, None, None)))
    simulation.grab("b", (0.045, 0.022, 0.017), target=(0, 0, 0), stiffness=1.0)
    with pytest.raises(ts.ParameterError, match="in no cell of 'b' at rest"):
        simulation.grab("b", (0.055, 0.022, 0.017), target=(0, 0, 0), stiffness=1.0)


@pytest.mark.parametrize("place", [(0.095, 0.035, 0.035), 53])
@pytest.mark.parametrize("kind", ["hexahedron", "tetra"])
@pytest.mark.parametrize("how", ["ablate", "remove_cells"])
def test_a_grab_of_what_is_gone_is_released(kind: str, place: Any, how: str) -> None:
    fixed = [ts.Fixed("b", on=ROOT)]
    simulation = _scene(kind, fixed=fixed).compile()
    gone = simulation.grab("b", place, target=(0.1, 0.04, 0.08), stiffness=2.0)
    stays = simulation.grab("b", (0.05, 0.01, 0.01), target=(0.05, 0.01, 0.01), stiffness=2.0)
    if how == "ablate":
        report = simulation.ablate("b", CORNER)
        assert report.released == (1,)
    else:
        other = _scene(kind, fixed=fixed).compile()
        other.ablate("b", CORNER)
        left = other.remaining_cells("b")
        gone_cells = np.setdiff1d(simulation.remaining_cells("b"), left)
        simulation.remove_cells(body="b", cells=gone_cells)
    assert gone.released
    assert not stays.released
    simulation.step()
    assert np.abs(simulation.reactions("b")).max() < 1e-9


def test_a_grab_between_cells_that_stay_is_released_with_its_cell() -> None:
    """All nodes of the cell in the middle belong to others too."""
    mesh = ts.BarMesh(size=(0.12, 0.12, 0.12), cells=(3, 3, 3), cell="hexahedron")
    body = ts.Body(mesh=mesh, law=ts.StVK(young=8e3, poisson=0.3), density=1000.0)
    scene = ts.Scene(bodies={"b": body}, step=ts.ImplicitEuler(0.01), editing=True, grabbing=True)
    simulation = scene.compile()
    grab = simulation.grab("b", (0.06, 0.06, 0.061), target=(0.06, 0.06, 0.2), stiffness=2.0)
    at_its_corner = simulation.grab("b", (0.04, 0.04, 0.04), target=(0, 0, 0), stiffness=2.0)
    assert simulation.ablate("b", ts.Sphere((0.06, 0.06, 0.06), 0.01)).released == (1,)
    assert grab.released
    assert not at_its_corner.released


def test_a_grab_goes_on_in_the_part_of_a_divided_cell() -> None:
    simulation = _scene("tetra-divided").compile()
    x = 0.0495
    grab = simulation.grab("b", (x, 0.022, 0.017), target=(x, 0.022, 0.037), stiffness=20.0)
    report = simulation.cut("b", ts.Plane((AT, 0.02, 0.02), (1, 0, 0)))
    assert report.released == ()
    np.testing.assert_allclose(grab.position, (x, 0.022, 0.017), atol=1e-12)
    _pulls_one_side(simulation, x)


def test_a_node_without_cells_is_refused_by_name() -> None:
    simulation = _scene().compile()
    simulation.ablate("b", CORNER)
    with pytest.raises(ts.ParameterError, match="node 53 of 'b', which has no cell"):
        simulation.grab("b", 53, target=(0.1, 0.04, 0.08), stiffness=2.0)


def test_a_support_without_cells_is_refused_by_name() -> None:
    led = ts.Prescribed(
        "b", on=TIP, times=(0, 1), displacements=((0, 0, 0), (0, 0, 0.02)), name="P"
    )
    simulation = _scene(fixed=[ts.Fixed("b", on=ROOT)], prescribed=[led]).compile()
    simulation.ablate("b", ts.Box(min=(0.085, None, None)))
    with pytest.raises(ts.ParameterError, match="'P' of 'b', none of whose nodes has a cell left"):
        simulation.lead("P")


@pytest.mark.parametrize("how", ["cut", "ablate"])
def test_a_node_that_is_nowhere_is_named(how: str) -> None:
    simulation = _scene().compile()
    simulation.positions["b"][17] = np.nan
    with pytest.raises(ts.ParameterError, match=r"node 17 of 'b' at \(nan, nan, nan\) m"):
        if how == "cut":
            simulation.cut("b", ts.Plane((0.05, 0, 0), (1, 0.1, 0.2)))
        else:
            simulation.ablate("b", CORNER)


def test_a_bad_blade_or_region_is_no_problem_of_the_scene() -> None:
    for wrong in (lambda: ts.Plane((0, 0, 0), (0, 0, 0)), lambda: ts.Sphere((0, 0, 0), -1)):
        with pytest.raises(ts.SceneError, match=r"^1 problem:\n- ") as refused:
            wrong()
        assert "scene" not in str(refused.value)


def _line(frames: bool) -> ts.Scene:
    """Five cells of 12 mm; as a rod if its nodes are frames."""
    model: dict[str, Any] = {"model": ts.Frames()} if frames else {}
    body = ts.Body(
        mesh=ts.bar_mesh(size=(0.06, 0, 0), cells=(5, 0, 0), cell="line"),
        law=ts.StVK(young=1e4, poisson=0.3),
        density=1000.0,
        section=4e-6,
        **model,
    )
    return ts.Scene(bodies={"b": body}, step=ts.ImplicitEuler(2e-3), editing=True, grabbing=True)


@pytest.mark.parametrize("frames", [False, True])
@pytest.mark.parametrize("at", [0.0125, 0.018, 0.0235, 0.024])
def test_a_drag_of_a_line_holds_the_piece_that_has_its_place(frames: bool, at: float) -> None:
    """Cut within a cell and at a node: the other piece gets no momentum."""
    scene = _line(frames)
    for x in (0.6 * at, at - 1e-5, at + 1e-5, 0.5 * (at + 0.026), at + 0.004):
        simulation = scene.compile()
        simulation.cut("b", ts.Plane((at, 0, 0), (1, 0, 0)))
        grab = simulation.drag("b", (x, 0, 0))
        np.testing.assert_allclose(grab.position, (x, 0, 0), atol=1e-12)
        grab.target = (x, 0.002, 0)
        simulation.step()
        material = simulation.material("b")
        moved = np.abs(material.points - material.mesh.points)[:, 1]
        lines = material.mesh.body_blocks[0].nodes
        left = material.mesh.points[lines][:, :, 0].mean(axis=1) < at
        own, other = (left, ~left) if x < at else (~left, left)
        assert moved[lines[own]].any()
        assert not moved[lines[other]].any()


@pytest.mark.parametrize("at", [0.0125, 0.018, 0.0235])
def test_a_drag_of_a_rod_takes_a_frame_with_material(at: float) -> None:
    """Nodes 1 and 2 are those of the cut cell; copies of them lie beyond the cut."""
    simulation = _line(frames=True).compile()
    simulation.cut("b", ts.Plane((at, 0, 0), (1, 0, 0)))
    assert simulation.drag("b", (at - 1e-5, 0, 0)).point.nodes.tolist() == [1]
    assert simulation.drag("b", (at + 1e-5, 0, 0)).point.nodes.tolist() == [2]
