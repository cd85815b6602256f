"""Any element with any law, from a scene to its equilibrium."""

import numpy as np
import pytest

import tissu as ts
from typical_laws import typical_laws

CELLS = [
    "tetra",
    "tetra10",
    "hexahedron",
    "hexahedron20",
    "hexahedron27",
    "wedge",
    "wedge15",
    "pyramid",
    "pyramid13",
]
LAWS = typical_laws() | {
    "hooke": ts.Hooke(young=3e4, poisson=0.3),
    "stvk": ts.StVK(young=3e4, poisson=0.3),
    "neo_hooke": ts.NeoHooke(young=3e4, poisson=0.3),
    "stable_neo_hooke": ts.StableNeoHooke(young=3e4, poisson=0.3),
    "mooney_rivlin": ts.MooneyRivlin(c1=4e3, c2=1e3, kappa=5e4),
    "yeoh": ts.Yeoh(c1=5e3, c2=200.0, c3=10.0, kappa=5e4),
    "arruda_boyce": ts.ArrudaBoyce(mu=9e3, lambda_m=1.8, kappa=5e4),
    "fibres": ts.NeoHooke(
        young=3e4, poisson=0.3, fibres=ts.Fibres(k1=5e3, k2=0.5, direction=(1, 0, 0))
    ),
}


def stretched(cell, law):
    """A cube between sliding planes, pulled by a tenth: the answer is one homogeneous stretch."""
    mesh = ts.bar_mesh(size=(1, 1, 1), cells=(2, 2, 2), cell=cell)
    low, high = (None, None, None), (None, None, None)

    def plane(axis, at):
        return ts.Box(
            tuple(at - 1e-9 if i == axis else v for i, v in enumerate(low)),
            tuple(at + 1e-9 if i == axis else v for i, v in enumerate(high)),
        )

    scene = ts.Scene(
        bodies={"cube": ts.Body(mesh=mesh, law=law, density=1e3)},
        fixed=[ts.Fixed("cube", on=plane(i, 0.0), axes="xyz"[i]) for i in range(3)],
        prescribed=[
            ts.Prescribed(
                "cube",
                on=plane(0, 1.0),
                axes="x",
                times=[0, 1],
                displacements=[(0, 0, 0), (0.1, 0, 0)],
            )
        ],
        step=ts.Static(newton=ts.Newton(iterations=30, tolerance=1e-11), solver=ts.Cholesky()),
    )
    simulation = scene.compile()
    report = simulation.step()
    assert report.converged, report
    return mesh, simulation


@pytest.mark.parametrize("law", LAWS)
def test_every_element_gives_the_same_homogeneous_stretch(law):
    energies, sides = {}, {}
    for cell in CELLS:
        mesh, simulation = stretched(cell, LAWS[law])
        moved = simulation.positions["cube"]
        side = moved[mesh.points[:, 1] > 1 - 1e-9, 1]
        # A homogeneous state: Newton's tolerance on a cube of one metre.
        scale = (1.1, side[0], side[0])
        assert np.abs(moved - mesh.points * scale).max() < 1e-8, cell
        assert mesh.volume() == pytest.approx(1.0, rel=1e-12)
        energies[cell], sides[cell] = simulation.energy()["elastic"], side[0]
    assert np.ptp(list(sides.values())) < 1e-8, sides
    assert np.ptp(list(energies.values())) < 1e-8 * energies["tetra"], energies
    assert 0.9 < sides["tetra"] < 1.0  # it thins


def test_fibres_stiffen_along_themselves_only():
    _, plain = stretched("hexahedron", LAWS["neo_hooke"])
    _, along = stretched("hexahedron", LAWS["fibres"])
    across = ts.NeoHooke(
        young=3e4, poisson=0.3, fibres=ts.Fibres(k1=5e3, k2=0.5, direction=(0, 1, 0))
    )
    _, sideways = stretched("hexahedron", across)
    energy = plain.energy()["elastic"]
    assert along.energy()["elastic"] > 1.05 * energy
    # Across the pull the fibres are slack: they add nothing.
    assert sideways.energy()["elastic"] == pytest.approx(energy, rel=1e-12)


@pytest.mark.parametrize(
    ("cell", "cells", "nearest"), [("tetra10", (8, 1, 1), 0.02), ("hexahedron20", (8, 1, 1), 0.005)]
)
def test_quadratic_elements_reach_the_reference_of_the_bar_on_a_coarse_mesh(cell, cells, nearest):
    # The converged tip of case A (StVK, nu = 0) is -0.607597 m; first-order meshes of this size are
    # off by half of it. The bound is what quadratic interpolation of the clamp's corner leaves.
    mesh = ts.bar_mesh(size=(8, 1, 1), cells=cells, cell=cell, origin=(0, -0.5, -0.5))
    body = ts.Body(mesh=mesh, law=ts.StVK(young=1e8, poisson=0.0), density=1000.0)
    scene = ts.Scene(
        bodies={"bar": body},
        fixed=[ts.Fixed("bar", on=ts.Box((None, None, None), (1e-9, None, None)))],
        gravity=(0, -9.81, 0),
        step=ts.Static(newton=ts.Newton(iterations=20, tolerance=1e-10), solver=ts.Cholesky()),
    )
    simulation = scene.compile()
    assert simulation.step().converged
    end = mesh.points[:, 0] > 8 - 1e-9
    tip = simulation.displacements("bar")[end, 1].mean()
    assert abs(tip / -0.607597 - 1) < nearest, tip
