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
