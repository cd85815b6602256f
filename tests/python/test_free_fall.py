"""A body that falls is not deformed: gravity pulls at the masses that inertia has."""

import numpy as np
import pytest

import tissu as ts

CELLS = ["tetra", "tetra10", "hexahedron", "hexahedron20", "hexahedron27"]
CELLS += ["wedge", "wedge15", "pyramid", "pyramid13"]


@pytest.mark.parametrize("cell", CELLS)
def test_every_node_falls_alike(cell):
    mesh = ts.bar_mesh(size=(0.1, 0.02, 0.02), cells=(4, 1, 1), cell=cell)
    scene = ts.Scene(
        bodies={"bar": ts.Body(mesh=mesh, law=ts.StVK(young=5e3, poisson=0.3), density=1e3)},
        gravity=(0, 0, -9.81),
        step=ts.ImplicitEuler(0.01, newton=ts.Newton()),
    )
    simulation = scene.compile()
    for _ in simulation.run(0.1):
        pass
    # Backward Euler falls by g h^2 n (n + 1) / 2 in n steps; Newton stops at 1e-6 of the load.
    np.testing.assert_allclose(
        simulation.displacements("bar"), [[0, 0, -9.81 * 1e-4 * 55]] * mesh.node_count, atol=1e-8
    )


@pytest.mark.parametrize("cells", [[2**32], [-1], [10**12]])
def test_a_cell_beyond_every_number_is_named(cells):
    mesh = ts.bar_mesh(size=(4, 1, 1), cells=(4, 1, 1), cell="hexahedron")
    body = ts.Body(mesh=mesh, law=ts.Hooke(young=1e3, poisson=0.3), density=1e3)
    scene = ts.Scene(bodies={"b": body}, step=ts.ImplicitEuler(0.01), editing=True)
    with pytest.raises(ts.ParameterError, match=f"found cell {cells[0]} of body"):
        scene.compile().remove_cells(body="b", cells=cells)
    with pytest.raises(ts.ParameterError, match="no body is named 'q'; there are b"):
        scene.compile().remove_cells(body="q", cells=[0])
