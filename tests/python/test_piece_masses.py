"""Masses of pieces: of the material of each body, whatever tissue hangs on it."""

from __future__ import annotations

import pytest

import tissu as ts

SUMMED = 1e-12
"""relative: round-off of sums over a thousand cells"""


def total(simulation: ts.Simulation) -> float:
    """All mass of the scene, as it is lumped [kg]."""
    diagonal = simulation.mass_matrix().diagonal().reshape(-1, 3)
    names = [*simulation.bodies, *simulation.tissue]
    return float(sum(diagonal[simulation.rows(name), 0].sum() for name in names))


def require_densities(simulation: ts.Simulation) -> None:
    summed = 0.0
    parts = {**simulation.scene.bodies, **simulation.scene.tissue}
    for name, part in parts.items():
        for piece in simulation.pieces(name):
            assert piece.mass == pytest.approx(part.density * piece.volume, rel=SUMMED)
            summed += piece.mass
    assert summed == pytest.approx(total(simulation), rel=SUMMED)


def test_tissue_is_not_counted_twice() -> None:
    """Before, blocks had a third more than density times volume."""
    simulation = ts.examples.scene("tissue").replace(editing=True).compile()
    require_densities(simulation)
    report = simulation.cut("fascia", ts.Plane((0, 0, 0.055), (0, 0, 1)))
    assert report.mass_change == 0.0
    require_densities(simulation)


def test_copies_of_cells_have_their_share() -> None:
    """A slot in a block to which tissue is tied: its cells are copied, and a sphere is taken."""
    simulation = ts.examples.scene("tissue").replace(editing=True).compile()
    slot = ts.Sweep([[(0.06, y, 0.0885), (0.06, y, 0.12)] for y in (-0.01, 0.11)])
    assert simulation.cut("upper", slot).cells_cut > 0
    require_densities(simulation)
    gone = simulation.ablate("lower", ts.Sphere((0.05, 0.05, 0.0), 0.025))
    density = simulation.scene.bodies["lower"].density
    assert gone.mass_change == pytest.approx(density * gone.volume_change, rel=1e-9)
    require_densities(simulation)


@pytest.mark.parametrize("model", ["shell", "frames"])
def test_sheets(model: str) -> None:
    """Two sheets whose nodes have rotations, and tissue that fills the gap."""

    def sheet(z: float) -> ts.Body:
        return ts.Body(
            mesh=ts.BarMesh(size=(0.1, 0.1, 0), cells=(5, 5, 0), cell="triangle", origin=(0, 0, z)),
            law=ts.Hooke(young=1e5, poisson=0.3),
            model=model,
            thickness="2 mm",
            density=1050,
        )

    tissue = ts.Tissue(
        between=("upper", "lower"),
        inside=ts.BarMesh(
            size=(0.08, 0.08, 0.03), cells=(1, 1, 1), cell="hexahedron", origin=(0.01, 0.01, 0.03)
        ),
        frames=30,
        points=100,
        law=ts.NeoHooke(young=6e3, poisson=0.3),
        density=1000,
    )
    simulation = ts.Scene(
        bodies={"upper": sheet(0.06), "lower": sheet(0.03)},
        tissue={"fascia": tissue},
        step=ts.ImplicitEuler("2 ms"),
        editing=True,
    ).compile()
    require_densities(simulation)
