"""Which rules a scene may ask for."""

import numpy as np
import pytest

import tissu as ts


def scene(cell, quadrature, step):
    mesh = ts.bar_mesh(size=(2, 1, 1), cells=(4, 2, 2), cell=cell)
    law = ts.StVK(young=1e4, poisson=0.3)
    return ts.Scene(
        bodies={"bar": ts.Body(mesh=mesh, law=law, density=1e3, quadrature=quadrature)},
        fixed=[ts.Fixed("bar", on=ts.Box(None, (0, None, None)))],
        gravity=(0, 0, -0.1),
        step=step,
    )


@pytest.mark.parametrize(("cell", "modes"), [("hexahedron", 12), ("hexahedron20", 6), ("wedge", 6)])
def test_modes_without_energy_are_refused_in_a_dynamic_run(cell, modes):
    with pytest.raises(ts.SceneError, match=f"quadrature: reduced integration leaves {modes} disp"):
        scene(cell, "reduced", ts.ImplicitEuler("1 ms")).compile()


def test_a_rule_without_such_modes_is_welcome():
    simulation = scene("tetra", "reduced", ts.ImplicitEuler("1 ms")).compile()
    assert simulation.step().converged


def test_a_static_step_says_so_and_is_softer():
    """Serendipity hexahedra on 8 points, one of the most used elements: softer than on 27."""
    reduced = scene("hexahedron20", "reduced", ts.Static(solver=ts.Cholesky()))
    assert any(
        "6 displacements of a hexahedron20 without energy" in n for n in reduced.check().notes
    )
    sag = []
    for quadrature in ("reduced", "full"):
        simulation = scene("hexahedron20", quadrature, ts.Static(solver=ts.Cholesky())).compile()
        assert simulation.step().converged
        sag.append(np.abs(simulation.displacements("bar")[:, 2]).max())
    assert sag[1] < sag[0] < 1.1 * sag[1]
