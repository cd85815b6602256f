"""Static steps where the energy has saddles: a soft cube that its own weight can topple."""

import numpy as np
import pytest

import tissu as ts


def soft_cube(sideways=0.0):
    """A cube twice as heavy as stiff, held at its bottom; `sideways` [m/s2] pushes it over."""
    mesh = ts.bar_mesh(size=(0.1, 0.1, 0.1), cells=(6, 6, 6), cell="hexahedron")
    law = ts.NeoHooke(young=500, poisson=0.45)
    scene = ts.Scene(
        bodies={"cube": ts.Body(mesh=mesh, law=law, density=1000)},
        gravity=(sideways, -9.81, 0),
        fixed=[ts.Fixed("cube", on=ts.Plane((0, 0, 0), (0, 1, 0)))],
        step=ts.Static(solver=ts.Cholesky()),
    )
    return scene.compile()


def least_eigenvalue(simulation):
    """Of the stiffness on free rows [N/m]."""
    free = np.repeat(simulation.meshes["cube"].points[:, 1] > 1e-9, 3)
    stiffness = simulation.stiffness().toarray()[np.ix_(free, free)]
    return np.linalg.eigvalsh(stiffness)[0]


def test_a_cube_that_stands_is_found_and_told_to_be_unstable():
    simulation = soft_cube()
    report = simulation.step()
    assert report.converged, report.message
    # In balance with its supports, to 1e-6 of the weight.
    assert simulation.reactions("cube").sum(axis=0)[1] == pytest.approx(9.81, rel=1e-4)
    assert len(simulation.inverted_cells("cube")) == 0
    # Newton's method converges fast to a saddle too; a descent alone does by a third an iteration.
    assert report.newton_iterations <= 20
    assert least_eigenvalue(simulation) < -0.01
    assert "an unstable equilibrium" in report.message


def test_a_cube_that_is_pushed_over_is_followed_to_where_it_rests():
    """The descent ends at a minimum of the energy: every eigenvalue of the tangent is positive."""
    simulation = soft_cube(sideways=0.5)
    report = simulation.step()
    assert report.converged, report.message
    assert "unstable" not in report.message
    assert least_eigenvalue(simulation) > 0
    total = simulation.reactions("cube").sum(axis=0)
    np.testing.assert_allclose(total, [-0.5, 9.81, 0], atol=1e-3)
