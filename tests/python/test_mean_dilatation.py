"""Mean dilatation: what locks near incompressibility, and how far the cure goes."""

import numpy as np
import pytest

import tissu as ts
from tissu.compile import check_scene

NEWTON = ts.Newton(iterations=60, tolerance=1e-9)
SIZE = (0.4, 0.1, 0.1)  # m
FIRST_ORDER = ("hexahedron", "tetra", "wedge", "pyramid")


def cantilever(cell, cells, model="fem", *, poisson=0.4999, quadrature="full", law=ts.NeoHooke):
    """A bar held at one end that its weight bends by a quarter of its length."""
    body = ts.Body(
        mesh=ts.BarMesh(size=SIZE, cells=cells, cell=cell),
        law=law(young=300e3, poisson=poisson),
        density=1000,
        model=model,
        quadrature=quadrature,
    )
    return ts.Scene(
        bodies={"bar": body},
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        gravity=(0, -9.81, 0),
        step=ts.Static(newton=NEWTON, solver=ts.Cholesky()),
    )


def sag(*args, **more):
    """How far the nodes of the free end go down, their mean [m]."""
    simulation = cantilever(*args, **more).compile()
    report = simulation.step()
    assert report.converged, report
    end = simulation.meshes["bar"].points[:, 0] > SIZE[0] - 1e-9
    return -simulation.displacements("bar")[end, 1].mean()


# Serendipity hexahedra at 2 x 2 x 2 points, which do not lock; see REFERENCE's test [m].
REFERENCE = 0.1165


def test_the_reference_is_what_quadratic_cells_converge_to():
    coarse, fine = (sag("hexahedron20", c, quadrature="reduced") for c in ((4, 2, 2), (8, 3, 3)))
    assert coarse < fine < REFERENCE
    assert fine > 0.96 * REFERENCE


# Coarse cells are still too stiff in bending, tetrahedra and wedges most; that is no locking: it
# goes with the square of their size, and stands in docs/measured/mean-dilatation.md.
@pytest.mark.parametrize(
    ("cell", "cured"),
    [("hexahedron", 0.03), ("tetra", 0.14), ("wedge", 0.09), ("pyramid", 0.03)],
)
def test_a_cantilever_bends_as_far_as_quadratic_cells_say(cell, cured):
    fem = sag(cell, (16, 4, 4)) / REFERENCE
    mean = sag(cell, (16, 4, 4), "mean-dilatation") / REFERENCE
    assert fem < 0.25
    assert abs(mean - 1) < cured


@pytest.mark.parametrize("cell", FIRST_ORDER)
def test_nothing_locks_more_as_poisson_goes_to_a_half(cell):
    found = [sag(cell, (8, 3, 3), "mean-dilatation", poisson=p) for p in (0.499, 0.4999, 0.499999)]
    assert found == pytest.approx([found[-1]] * 3, rel=5e-3)


def cook(cell, model, n, quadrature="full"):
    """Cook's membrane in plane strain: how far its upper corner goes up [mm]."""
    bar = ts.bar_mesh(size=(1, 1, 1), cells=(n, n, 1), cell=cell)
    x, y, z = bar.points.T
    points = np.stack([48 * x, 44 * x + y * (44 - 28 * x), z], axis=1) * 1e-3
    mesh = ts.Mesh(points=points, cells=bar.cells)
    body = ts.Body(
        mesh=mesh,
        law=ts.NeoHooke(young=240.565e6, poisson=0.4999),  # mu = 80.1938 MPa
        density=1000,
        model=model,
        quadrature=quadrature,
    )
    end = ts.Plane((48e-3, 0, 0), (1, 0, 0))
    scene = ts.Scene(
        bodies={"membrane": body},
        fixed=[
            ts.Fixed("membrane", on=ts.Plane((0, 0, 0), (1, 0, 0))),
            ts.Fixed("membrane", on=ts.Box((None,) * 3, (None,) * 3), axes="z"),
        ],
        loads=[ts.Traction("membrane", on=end, traction=(0, 100 / 16e-6, 0))],
        step=ts.Static(newton=NEWTON, solver=ts.Cholesky(), load_steps=4),
    )
    simulation = scene.compile()
    assert simulation.step().converged
    corner = np.linalg.norm(points[:, :2] - [48e-3, 60e-3], axis=1) < 1e-6
    return 1e3 * simulation.displacements("membrane")[corner, 1].mean()


def test_cooks_membrane():
    converged = cook("hexahedron20", "fem", 16, "reduced")
    assert cook("hexahedron", "fem", 16) < 0.85 * converged
    assert cook("hexahedron", "mean-dilatation", 16) == pytest.approx(converged, rel=0.02)
    assert cook("tetra", "fem", 16) < 0.6 * converged
    assert cook("tetra", "mean-dilatation", 16) == pytest.approx(converged, rel=0.1)


def notes(**changes):
    scene = cantilever(**{"cell": "tetra", "cells": (2, 1, 1), **changes})
    return [note for note in check_scene(scene).notes if "lock" in note]


def test_locking_is_reported_with_what_cures_it():
    (note,) = notes(poisson=0.45)
    assert "Poisson's ratio 0.45" in note
    assert "(tetra)" in note
    assert "model: mean_dilatation" in note
    assert notes(poisson=0.44) == []
    for cell in FIRST_ORDER[2:]:
        assert cell in notes(cell=cell)[0]
    for model in ("corotational", "mass-link", "mass-tensor"):
        assert len(notes(model=model, law=ts.Hooke)) == 1


def test_nothing_is_noted_of_what_does_not_lock():
    assert notes(model="mean-dilatation") == []
    assert notes(model="mass-spring", law=ts.Hooke) == []
    assert notes(cell="tetra10") == []
    assert notes(cell="hexahedron", quadrature="reduced") == []


def law(poisson, kind):
    """A law with kappa of a Poisson's ratio beside mu = 1."""
    kappa = 2 * (1 + poisson) / (3 * (1 - 2 * poisson))
    named = {
        "mooney": lambda **_: ts.MooneyRivlin(c1=0.4, c2=0.1, kappa=kappa),
        "yeoh": lambda **_: ts.Yeoh(c1=0.5, kappa=kappa),
    }
    return named[kind]


@pytest.mark.parametrize("kind", ["mooney", "yeoh"])
def test_laws_without_poissons_ratio_lock_by_their_moduli(kind):
    assert len(notes(law=law(0.46, kind))) == 1
    assert notes(law=law(0.44, kind)) == []
