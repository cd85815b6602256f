"""Notes on scenes that can be computed, but may not be what was meant: told by check and by run."""

import numpy as np
import pytest

import tissu as ts

LEFT = ts.Box((None, None, None), (1e-6, None, None))
RIGHT = ts.Box((0.2 - 1e-6, None, None), (None, None, None))
BAR = ts.Body(
    mesh=ts.BarMesh(size=(0.2, 0.1, 0.1), cells=(2, 1, 1)),
    law=ts.StVK(young=1e4, poisson=0.3),
    density=1e3,
)
FIXED = ts.Fixed("bar", on=LEFT)


def notes(body=BAR, *, step=None, **fields):
    given = {"fixed": [FIXED], "step": step or ts.ImplicitEuler(0.01)} | fields
    return ts.Scene(bodies={"bar": body}, **given).check().notes


def about(found, *words):
    return [note for note in found if all(word in note for word in words)]


def test_an_ordinary_scene_has_no_note():
    loads = [
        ts.NodalLoad("bar", on=RIGHT, force=(0, 0, -1)),
        ts.Pressure("bar", on=RIGHT, pressure=10.0),
        ts.Traction("bar", on=RIGHT, traction=(0, 0, -1)),
    ]
    assert notes(gravity=(0, 0, -9.81), loads=loads) == []


@pytest.mark.parametrize(
    ("load", "said"),
    [
        (ts.NodalLoad("bar", on=LEFT, force=(0, 0, -1)), "loads[0]: 4 of 4 loaded nodes are held"),
        (ts.Traction("bar", on=LEFT, traction=(1, 0, 0)), "2 of 2 loaded faces are held"),
        (ts.Pressure("bar", on=LEFT, pressure=5.0), "2 of 2 loaded faces are held"),
        (ts.Pressure("bar", on=ts.SurfaceNodes(), pressure=5.0), "2 of 20 loaded faces are held"),
        (ts.NodalLoad("bar", on=ts.Nodes([0, 1]), force=(0, 0, 1)), "1 of 2 loaded nodes is held"),
    ],
)
def test_a_load_on_held_nodes(load, said):
    (note,) = about(notes(loads=[load]), "loads[0]", "held")
    assert said in note


def test_a_load_across_the_held_axis_is_none():
    held = ts.Fixed("bar", on=LEFT, axes="x")
    along = ts.NodalLoad("bar", on=LEFT, force=(1, 0, 0))
    across = ts.NodalLoad("bar", on=LEFT, force=(1, 0, -1))
    assert about(notes(fixed=[held], loads=[along]), "4 of 4 loaded nodes")
    assert not about(notes(fixed=[held], loads=[across]), "loads[0]")


def test_a_body_larger_than_any_organ():
    mesh = ts.bar_mesh(size=(200.0, 100.0, 100.0), cells=(2, 1, 1))
    (note,) = about(notes(BAR.replace(mesh=mesh)), "bodies.bar: is 200 m long")
    assert "unit: mm" in note
    one = ts.bar_mesh(size=(1.0, 0.1, 0.1), cells=(2, 1, 1))
    assert not about(notes(BAR.replace(mesh=one)), "long")


@pytest.mark.parametrize(
    ("law", "young"),
    [
        (ts.StVK(young=4.0, poisson=0.3), "4 Pa"),  # kPa meant
        (ts.NeoHooke(young=2.1e11, poisson=0.3), "2.1e+11 Pa"),  # steel
        # mu = 2 (c1 + c2) = 6, E = 9 kappa mu / (3 kappa + mu) = 17.982
        (ts.MooneyRivlin(c1=2.0, c2=1.0, kappa=2000.0), "17.98 Pa"),
    ],
)
def test_a_stiffness_that_no_tissue_has(law, young):
    (note,) = about(notes(BAR.replace(law=law)), "bodies.bar.law: Young's modulus at rest")
    assert f"is {young}, outside what tissue has" in note


def test_pressure_that_follows_a_linear_body():
    hooke = BAR.replace(law=ts.Hooke(young=1e4, poisson=0.3))
    load = ts.Pressure("bar", on=RIGHT, pressure=5.0)
    (note,) = about(notes(hooke, loads=[load]), "loads[0]: the pressure follows the surface")
    assert "hooke knows small displacements only" in note
    assert not about(notes(hooke.replace(model=ts.Corotational()), loads=[load]), "follows")
    assert not about(notes(loads=[load]), "follows")


def test_a_linear_body_that_should_turn():
    hooke = BAR.replace(law=ts.Hooke(young=1e4, poisson=0.3))
    spinning = hooke.replace(start=ts.Start(spin=(0, 0, 3.0)))
    assert about(notes(spinning, fixed=[]), "bodies.bar: hooke takes a turn", "starts with a spin")
    rotation = ts.Rotation(center=(0.2, 0, 0), axis=(1, 0, 0), angles=(0.0, 1.0))
    led = ts.Prescribed("bar", on=RIGHT, times=(0.0, 1.0), rotation=rotation)
    assert about(notes(hooke, prescribed=[led]), "hooke takes a turn", "prescribed[0] turns it")
    assert not about(notes(prescribed=[led]), "takes a turn")


def test_a_body_condensed_in_part_that_may_turn():
    mesh = ts.bar_mesh(size=(0.2, 0.1, 0.1), cells=(4, 2, 2))
    core = np.flatnonzero(mesh.points[mesh.cells[0].nodes].mean(axis=1)[:, 0] > 0.1)
    rest = np.setdiff1d(np.arange(mesh.cell_count), core)
    mesh = ts.Mesh(points=mesh.points, cells=mesh.cells, regions={"core": core, "rest": rest})
    body = BAR.replace(
        mesh=mesh,
        law={"core": ts.Hooke(young=1e4, poisson=0.3), "rest": ts.StVK(young=1e4, poisson=0.3)},
        model={"core": ts.Condensed(keep="surface"), "rest": ts.FEM()},
    )
    loose = [ts.Fixed("bar", on=ts.Nodes([0]))]
    assert about(notes(body, fixed=loose), "a condensed region takes a turn", "fewer than three")
    assert not about(notes(body), "takes a turn")


def layers(ratio, solver):
    """A bar of tetrahedra whose every other layer is so many times as stiff as the rest."""
    far = ts.Box(("0.1", None, None), (None, None, None))
    mesh = ts.BarMesh(size=(0.2, 0.1, 0.1), cells=(4, 2, 2), cell="tetra", regions={"stiff": far})
    soft, stiff = (ts.StableNeoHooke(young=1e4 * k, poisson=0.3) for k in (1.0, ratio))
    step = ts.ImplicitEuler(0.01, solver=solver)
    return notes(BAR.replace(mesh=mesh, law={"stiff": stiff, "rest": soft}), step=step)


def test_a_stiff_part_with_a_loose_tolerance():
    (note,) = about(layers(1e6, ts.Auto()), "bodies.bar", "1e+06 times as stiff")
    assert "step.solver.tolerance 1e-05" in note
    assert not about(layers(1e4, ts.Auto()), "times as stiff")
    for exact in (ts.Auto(tolerance=1e-7), ts.Cholesky()):
        assert not about(layers(1e6, exact), "times as stiff")
