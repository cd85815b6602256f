"""Loads after cells are gone: tractions act on the area that is left, and nothing on lost nodes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tissu as ts
from cut_states import damped_bar

TIP = ts.Plane((0.1, 0, 0), (1, 0, 0))
TOP = ts.Plane((0, 0, 0.04), (0, 0, 1))
CORNER = ts.Box(min=(0.085, 0.02, None))  # at the tip: half of its cells
VALUE = 100.0  # [Pa]
KINDS = ("hexahedron", "tetra", "wedge", "pyramid", "tetra10", "hexahedron20", "hexahedron27")


def _loads(on: Any) -> dict[str, Any]:
    return {
        "traction": ts.Traction("b", on=on, traction=(VALUE, 20.0, -30.0), name="L"),
        "dead pressure": ts.Pressure("b", on=on, pressure=-VALUE, follows=False, name="L"),
        "pressure": ts.Pressure("b", on=on, pressure=-VALUE, name="L"),
    }


def _scene(load: Any, cell: Any = "hexahedron", method: Any = "virtual") -> ts.Scene:
    body = damped_bar(cell)
    return ts.Scene(
        bodies={"b": body},
        fixed=[ts.Fixed("b", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        loads=[load],
        step=ts.ImplicitEuler(0.01),
        editing=ts.Editing(room="400 %", method=method),
    )


def _total(simulation: ts.Simulation) -> Any:
    return simulation.forces()[simulation.rows("b")].sum(axis=0)


def _area(simulation: ts.Simulation, axis: int, value: float) -> float:
    """What is left at rest of a face of the bar [m2]."""
    surface = simulation.surface("b")
    rest = surface.carried(simulation.meshes["b"].points)[surface.triangles]
    on = (np.abs(rest[:, :, axis] - value) < 1e-9).all(axis=1) & ~surface.cut
    sides = rest[on][:, 1:] - rest[on][:, :1]
    return float(0.5 * np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1).sum())


def _gone(scene: ts.Scene, place: Any) -> Any:
    """The cells that an ablation takes away."""
    simulation = scene.compile()
    every = simulation.remaining_cells("b")
    simulation.ablate("b", place)
    return np.setdiff1d(every, simulation.remaining_cells("b"))


def _accepted() -> list[tuple[str, str, str]]:
    """Bodies with a pressure on curved faces are not cut."""
    flat = ("hexahedron", "tetra", "wedge")
    return [
        (cell, load, how)
        for cell in KINDS
        for load in ("traction", "dead pressure", "pressure")
        for how in ("ablate", "remove_cells")
        if load != "pressure" or how != "ablate" or cell in flat
    ]


@pytest.mark.parametrize(("cell", "load", "how"), _accepted())
def test_it_acts_on_the_area_that_is_left(cell: str, load: str, how: str) -> None:
    scene = _scene(_loads(TIP)[load], cell)
    simulation = scene.compile()
    before = _total(simulation)
    assert before[0] == pytest.approx(VALUE * 16e-4)
    if how == "ablate":
        simulation.ablate("b", CORNER)
    else:
        simulation.remove_cells(
            body="b", cells=_gone(_scene(_loads(TIP)["traction"], cell), CORNER)
        )
    left = _area(simulation, 0, 0.1)
    assert 6e-4 < left < 10e-4
    np.testing.assert_allclose(_total(simulation), before * left / 16e-4, atol=1e-12)


@pytest.mark.parametrize("load", ["traction", "dead pressure"])
def test_a_face_goes_though_its_nodes_have_other_cells(load: str) -> None:
    simulation = _scene(_loads(TOP)[load]).compile()
    before = _total(simulation)
    simulation.remove_cells(body="b", cells=_gone(_scene(_loads(TOP)[load]), _middle()))
    assert _area(simulation, 2, 0.04) == pytest.approx(36e-4)
    np.testing.assert_allclose(_total(simulation), before * 0.9, atol=1e-12)


def _middle() -> ts.Sphere:
    """One hexahedron in the middle of the bar's top."""
    return ts.Sphere((0.05, 0.01, 0.03), 0.005)


@pytest.mark.parametrize("load", ["traction", "dead pressure"])
@pytest.mark.parametrize(
    ("method", "cell"),
    [
        ("virtual", "hexahedron"),
        ("virtual", "tetra"),
        ("virtual", "tetra10"),
        ("subdivide", "tetra"),  # only tetrahedra are divided
    ],
)
def test_of_a_cut_face_what_has_material_is_loaded(cell: str, load: str, method: str) -> None:
    simulation = _scene(_loads(TOP)[load], cell, method).compile()
    before = _total(simulation)
    simulation.cut("b", ts.Plane((0.048, 0.02, 0.02), (1, 0.1, 0.05)))
    np.testing.assert_allclose(_total(simulation), before, atol=1e-14)
    simulation.ablate("b", ts.Box(min=(0.049, None, None), max=(0.071, None, None)))
    left = _area(simulation, 2, 0.04)
    assert 20e-4 < left < 36e-4
    np.testing.assert_allclose(_total(simulation), before * left / 40e-4, atol=1e-12)


def test_other_directions_at_an_edge() -> None:
    """A dead pressure on all faces, some of which are gone."""
    load = ts.Pressure("b", on=ts.SurfaceNodes(), pressure=VALUE, follows=False)
    simulation = _scene(load).compile()
    assert np.abs(_total(simulation)).max() < 1e-12
    simulation.ablate("b", CORNER)
    expected = VALUE * np.array([8e-4, 8e-4, 0.0])  # of the opposite faces, which are whole
    np.testing.assert_allclose(_total(simulation), expected, atol=1e-12)


@pytest.mark.parametrize("cell", ["hexahedron", "tetra"])
def test_a_load_on_a_lost_node_is_gone(cell: str) -> None:
    load = ts.NodalLoad("b", on=TIP, force=(0.16, 0, 0), name="L")
    simulation = _scene(load, cell).compile()
    simulation.ablate("b", CORNER)
    forces = simulation.forces()[simulation.rows("b")]
    lost = (simulation.mass_matrix().diagonal()[::3] == 0)[simulation.rows("b")]
    tip = simulation.meshes["b"].points[:, 0] > 0.1 - 1e-9
    assert lost.any()
    assert not forces[lost].any()
    np.testing.assert_allclose(forces.sum(axis=0)[0], 0.16 * (tip & ~lost).sum() / tip.sum())
    for _ in range(400):
        simulation.step()
    reactions = simulation.reactions("b")
    assert not reactions[lost].any()
    np.testing.assert_allclose(-reactions.sum(axis=0)[0], forces.sum(axis=0)[0], rtol=1e-4)


@pytest.mark.parametrize("load", ["traction", "dead pressure", "nodal"])
@pytest.mark.parametrize("first", ["change", "edit"])
def test_a_load_that_is_changed_live(load: str, first: str) -> None:
    nodal = ts.NodalLoad("b", on=TIP, force=(0.16, 0, 0), name="L")
    simulation = _scene({**_loads(TIP), "nodal": nodal}[load]).compile()

    def double() -> None:
        live = simulation.load("L")
        if load == "traction":
            live.traction = (2 * VALUE, 40.0, -60.0)
        elif load == "nodal":
            live.force = (0.32, 0, 0)
        else:
            live.pressure = -2 * VALUE

    other = _scene({**_loads(TIP), "nodal": nodal}[load]).compile()
    other.ablate("b", CORNER)
    if first == "change":
        double()
    simulation.ablate("b", CORNER)
    if first == "edit":
        double()
    np.testing.assert_allclose(_total(simulation), 2.0 * _total(other), rtol=1e-12, atol=1e-15)
    simulation.load("L").reset()
    np.testing.assert_allclose(_total(simulation), _total(other), rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize("load", ["traction", "dead pressure", "pressure"])
@pytest.mark.parametrize("how", ["ablate", "cut and ablate", "remove_cells"])
def test_a_resumed_run_has_the_same_bits(load: str, how: str, tmp_path: Path) -> None:
    scene = _scene(_loads(TOP)[load])
    live = scene.compile()
    for _ in range(3):
        live.step()
    if how == "remove_cells":
        live.remove_cells(body="b", cells=_gone(scene, _middle()))
    if how == "cut and ablate":
        live.cut("b", ts.Plane((0.048, 0.02, 0.02), (1, 0.1, 0.05)))
    if how != "remove_cells":
        live.ablate("b", ts.Box(min=(0.049, None, None), max=(0.071, None, None)))
    live.save_checkpoint(tmp_path / "there.ckpt")
    resumed = scene.compile(checkpoint=tmp_path / "there.ckpt")
    np.testing.assert_array_equal(resumed.forces(), live.forces())
    for _ in range(3):
        live.step()
        resumed.step()
    np.testing.assert_array_equal(resumed.positions["b"], live.positions["b"])


def test_the_rim_of_a_flat_body() -> None:
    mesh = ts.bar_mesh(size=(0.1, 0.04, 0), cells=(5, 2, 0), cell="quad")
    body = ts.Body(
        mesh=mesh,
        law=ts.StVK(young=8e3, poisson=0.3),
        density=1000.0,
        thickness=2e-3,
        plane="stress",
    )
    scene = ts.Scene(
        bodies={"b": body},
        fixed=[ts.Fixed("b", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        loads=[ts.Traction("b", on=TIP, traction=(VALUE, 0, 0))],
        step=ts.ImplicitEuler(0.01),
        editing=True,
    )
    simulation = scene.compile()
    assert _total(simulation)[0] == pytest.approx(VALUE * 0.04 * 2e-3)
    simulation.ablate("b", ts.Box(min=(0.085, 0.02, None)))
    assert _total(simulation)[0] == pytest.approx(VALUE * 0.02 * 2e-3)


@pytest.mark.parametrize("cell", ["hexahedron", "tetra"])
def test_a_slice_within_cells_bears_the_load_of_its_face(cell: str) -> None:
    """None of its nodes has material."""
    simulation = _scene(_loads(TOP)["traction"], cell).compile()
    for x in (0.047, 0.053):
        simulation.cut("b", ts.Plane((x, 0, 0), (1, 0, 0)))
    simulation.ablate("b", ts.Box(min=(0.054, None, None)))
    simulation.ablate("b", ts.Box(max=(0.046, None, None)))
    assert len(simulation.pieces("b")) == 1
    np.testing.assert_allclose(_total(simulation)[0], VALUE * 0.04 * 0.006, rtol=1e-9)
