"""Led nodes with a displacement each: an affine field on the whole border is the body's own."""

from __future__ import annotations

import numpy as np
import pytest

import tissu as ts

CUBE = ts.bar_mesh(size=(0.1, 0.1, 0.1), cells=(2, 2, 2), cell="hexahedron")
SLOPE = np.array([[0.02, 0.01, 0.0], [0.0, -0.01, 0.03], [0.01, 0.0, 0.015]])
BORDER = np.unique(CUBE.surface().triangles)


def _scene(on: ts.Nodes | ts.SurfaceNodes, own: np.ndarray, **more: object) -> ts.Scene:
    led = ts.Prescribed("cube", on=on, times=[0, 1], node_displacements=[0 * own, own], **more)
    body = ts.Body(mesh=CUBE, law=ts.Hooke(young=1e4, poisson=0.3), density=1e3)
    step = ts.Static(solver=ts.Cholesky())
    return ts.Scene(bodies={"cube": body}, prescribed=[led], step=step)


@pytest.mark.parametrize("order", ["surface", "increasing", "decreasing"])
def test_an_affine_border_gives_an_affine_body(order: str) -> None:
    """Patch test: the one inner node moves as the affine field says, whatever the order of ids."""
    ids = BORDER[::-1] if order == "decreasing" else BORDER
    on = ts.SurfaceNodes() if order == "surface" else ts.Nodes(ids)
    simulation = _scene(on, CUBE.points[ids] @ SLOPE.T).compile()
    simulation.step()
    moved = simulation.displacements("cube")
    assert moved == pytest.approx(CUBE.points @ SLOPE.T, abs=1e-9)  # round-off of the factor


def test_a_common_displacement_is_added() -> None:
    """The field of the nodes and a translation of all of them."""
    common = [(0.0, 0, 0), (0.001, 0, 0)]
    scene = _scene(ts.Nodes(BORDER), CUBE.points[BORDER] @ SLOPE.T, displacements=common)
    simulation = scene.compile()
    simulation.step()
    expected = CUBE.points @ SLOPE.T + [0.001, 0, 0]
    assert simulation.displacements("cube") == pytest.approx(expected, abs=1e-9)


def test_as_many_as_nodes_are_asked_for() -> None:
    with pytest.raises(ts.SceneError, match="of 25 nodes for 26 selected; one for each"):
        _scene(ts.Nodes(BORDER), CUBE.points[BORDER[1:]]).compile()
    with pytest.raises(ts.SceneError, match="found a node twice"):
        _scene(ts.Nodes([*BORDER, 0]), CUBE.points[[*BORDER, 0]]).compile()
    with pytest.raises(ts.SceneError, match="list of node displacement"):
        ts.Prescribed(
            "cube", on=ts.SurfaceNodes(), times=[0], node_displacements=np.zeros((2, 3, 3))
        )


@pytest.mark.parametrize("wrong", [3, [3], [[3]], [[[0, 0]]], [[["1 s", 0, 0]]], "a"])
def test_what_is_no_displacement_is_refused_in_a_sentence(wrong: object) -> None:
    with pytest.raises(ts.SceneError, match=r"node_displacements.*accepted"):
        ts.Prescribed("cube", on=ts.SurfaceNodes(), times=[0], node_displacements=wrong)  # type: ignore[arg-type]


def test_it_is_read_from_yaml_and_written() -> None:
    text = """
bodies:
  line:
    mesh: {type: bar, size: [1, 0, 0], cells: [2, 0, 0], cell: line}
    law: {type: hooke, young: 1 kPa, poisson: 0}
    section: 1 cm^2
    density: 1000
prescribed:
  - {body: line, on: {type: nodes, ids: [2, 0]}, times: [0, 1],
     node_displacements: [[[0, 0, 0], [0, 0, 0]], [[1 cm, 0, 0], [0, 0, 2 mm]]]}
step: {type: implicit_euler, dt: 10 ms}
"""
    scene = ts.Scene.from_yaml_text(text)
    assert scene.prescribed[0].node_displacements[1] == ((0.01, 0, 0), (0, 0, 0.002))
    assert ts.Scene.from_yaml_text(scene.to_yaml()) == scene
