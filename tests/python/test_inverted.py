"""Cells inside out are told, whether or not the step converged."""

import numpy as np
import pytest

import tissu as ts
from tissu.output import Series


@pytest.fixture
def simulation():
    mesh = ts.bar_mesh(size=(1, 1, 1), cells=(1, 1, 1), cell="hexahedron")
    scene = ts.Scene(
        bodies={"cube": ts.Body(mesh=mesh, law=ts.StVK(young=1e3, poisson=0.3), density=1e3)},
        step=ts.ImplicitEuler(dt="1 ms"),
    )
    return scene.compile()


def test_a_cell_at_rest_is_not_inverted(simulation, tmp_path):
    assert len(simulation.inverted_cells("cube")) == 0
    series = Series(simulation, tmp_path)
    series.write()
    assert series.inverted == ""


def test_a_mirrored_cell_is(simulation, tmp_path):
    simulation.positions["cube"][:] *= [-1.0, 1.0, 1.0]
    np.testing.assert_array_equal(simulation.inverted_cells("cube"), [0])
    series = Series(simulation, tmp_path)
    series.write()
    assert "at t = 0 s 1 cell of body 'cube' is inside out (0)" in series.inverted


def cube(law=None):
    return ts.Scene(
        bodies={
            "cube": ts.Body(
                mesh=ts.bar_mesh(size=(1, 1, 1), cells=(2, 2, 2), cell="hexahedron"),
                law=law or ts.StVK(young=1e3, poisson=0.3),
                density=1e3,
            )
        },
        fixed=[ts.Fixed("cube", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        step=ts.Static(solver=ts.Cholesky()),
    ).compile()


def test_an_equilibrium_inside_out_is_told():
    """Mirrored in the plane that is held StVK has no energy at all: in equilibrium, and no body."""
    simulation = cube()
    simulation.positions["cube"][:, 0] *= -1.0
    report = simulation.step()
    assert report.converged
    assert '8 cells of body "cube" are inside out (0, 1, 2, 3, 4, ...)' in report.message
    assert "inside out" in str(report)


def test_an_equilibrium_that_is_none_of_these_says_nothing():
    report = cube().step()
    assert report.converged
    assert report.message == ""


def test_one_corner_inside_out_is_enough():
    """A corner pushed far into its cell: det F is negative there, and positive in the mean."""
    simulation = cube()
    corner = np.flatnonzero((simulation.meshes["cube"].points == 1.0).all(axis=1))[0]
    simulation.positions["cube"][corner] -= 0.42
    cell = np.flatnonzero((simulation.meshes["cube"].cells[0].nodes == corner).any(axis=1))
    assert (simulation.cell_fields("cube")["volume_ratio"] > 0.0).all()
    np.testing.assert_array_equal(simulation.inverted_cells("cube"), cell)


def led(model, **changes):
    """A bar of Hooke's law whose held end is led by its own length, in one static step."""
    mesh = ts.BarMesh(size=(0.4, 0.1, 0.1), cells=(8, 3, 3), cell="hexahedron")
    body = ts.Body(mesh=mesh, law=ts.Hooke(young="10 kPa", poisson=0.3), density=1e3, model=model)
    way = ((0, 0, 0), (0.4, 0, 0))
    end = ts.Plane((0, 0, 0), (1, 0, 0))
    lead = ts.Prescribed("bar", on=end, times=(0, 1), displacements=way)
    scene = ts.Scene(
        bodies={"bar": body},
        prescribed=[lead],
        step=ts.Static(solver=ts.Cholesky()),
        **changes,
    )
    return scene.compile()


def test_a_condensed_region_is_judged_where_its_inner_nodes_are_now():
    """They follow what is kept: none of its cells is inside out, wherever the end is led."""
    simulation = led("condensed")
    report = simulation.step()
    assert report.converged
    assert report.message == ""
    moved = simulation.displacements("bar")
    assert moved == pytest.approx(np.tile([0.4, 0.0, 0.0], (len(moved), 1)), abs=1e-10)


def test_a_condensed_region_that_is_inside_out_is_told():
    """Its end is led through the rest of it."""
    mesh = ts.BarMesh(size=(0.4, 0.1, 0.1), cells=(8, 3, 3), cell="hexahedron")
    body = ts.Body(
        mesh=mesh, law=ts.Hooke(young="10 kPa", poisson=0.3), density=1e3, model="condensed"
    )
    lead = ts.Prescribed(
        "bar",
        on=ts.Plane((0.4, 0, 0), (1, 0, 0)),
        times=(0, 1),
        displacements=((0, 0, 0), (-0.9, 0, 0)),
    )
    report = (
        ts.Scene(
            bodies={"bar": body},
            fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
            prescribed=[lead],
            step=ts.Static(solver=ts.Cholesky()),
        )
        .compile()
        .step()
    )
    assert report.converged
    assert '72 cells of body "bar" are inside out' in report.message
