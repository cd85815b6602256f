"""Mean dilatation: what locks near incompressibility, and how far the cure goes."""

import pytest

import tissu as ts

NEWTON = ts.Newton(iterations=60, tolerance=1e-9)
SIZE = (0.4, 0.1, 0.1)  # m
POISSON = 0.4999


def cantilever(cell, cells, model, poisson=POISSON, split=None):
    """A bar held at one end that its weight bends by a fifth of its length."""
    mesh = ts.BarMesh(size=SIZE, cells=cells, cell=cell, **({"split": split} if split else {}))
    body = ts.Body(
        mesh=mesh, law=ts.NeoHooke(young=300e3, poisson=poisson), density=1000, model=model
    )
    return ts.Scene(
        bodies={"bar": body},
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        gravity=(0, -9.81, 0),
        step=ts.Static(newton=NEWTON, solver=ts.Cholesky()),
    )


def sag(cell, cells, model="fem", **more):
    """How far the nodes of the free end go down, their mean [m]."""
    simulation = cantilever(cell, cells, model, **more).compile()
    report = simulation.step()
    assert report.converged, report
    points = simulation.meshes["bar"].points
    end = points[:, 0] > SIZE[0] - 1e-9
    return -simulation.displacements("bar")[end, 1].mean()


@pytest.fixture(scope="module")
def converged():
    """Quadratic hexahedra, which do not lock in bending."""
    return sag("hexahedron27", (16, 4, 4))


@pytest.mark.parametrize(
    ("cell", "locked", "cured"),
    [("hexahedron", 0.9, 0.1), ("tetra", 0.9, 0.1), ("wedge", 0.9, 0.1), ("pyramid", 0.9, 0.1)],
)
def test_a_cantilever_bends_as_far_as_quadratic_cells_say(cell, locked, cured, converged):
    off = {
        model: sag(cell, (16, 4, 4), model) / converged - 1 for model in ("fem", "mean-dilatation")
    }
    print(cell, off, converged)
    assert off["fem"] < -locked
    assert abs(off["mean-dilatation"]) < cured
