"""The energy-momentum method: pieces and bodies that nothing joins exchange nothing."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import tissu as ts
from piece_momenta import momenta, pieces


@pytest.mark.parametrize("dt", [0.002, 0.005])
@pytest.mark.parametrize("held", [False, True])
def test_a_piece_at_rest_stays_while_another_vibrates(dt: float, held: bool) -> None:
    """A bar is cut in two; one half rests, held or free, and the other flies off, stretched.

    Nothing acts on the half at rest: its momentum is round-off, 1e-12 of that of the other. It had
    got a tenth of it in 0.2 s. The other keeps its own to Newton's tolerance, 1e-9 of what acts in
    a step: 1e-7 over a hundred steps.
    """
    mesh = ts.bar_mesh(size=(0.06, 0.02, 0.02), cells=(6, 2, 2), cell="tetra")
    law = ts.StableNeoHooke(young="20 kPa", poisson=0.35)
    simulation = ts.Scene(
        bodies={"bar": ts.Body(mesh=mesh, law=law, density=1000)},
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))] if held else [],
        step=ts.EnergyMomentum(dt),
        editing=True,
    ).compile()
    simulation.step()
    simulation.cut("bar", ts.Plane((0.03, 0, 0), (1, 0, 0)))
    still, flying = pieces(simulation, "bar")
    x, v = simulation.positions["bar"], simulation.velocities["bar"]
    centre = x[flying].mean(axis=0)
    x[flying] = centre + (x[flying] - centre) * (1.3, 1, 1)
    v[flying] = np.array((0.2, 0, 0)) + np.cross((0, 5, 10), x[flying] - centre)
    linear, angular = momenta(simulation, "bar", flying)
    for _ in range(round(0.2 / dt)):
        assert simulation.step().converged
    size = np.linalg.norm(linear)
    of_still = momenta(simulation, "bar", still)
    assert np.linalg.norm(of_still[0]) <= 1e-12 * size
    assert np.linalg.norm(of_still[1]) <= 1e-12 * size * 0.06
    now = momenta(simulation, "bar", flying)
    assert np.linalg.norm(now[0] - linear) <= 1e-7 * size
    assert np.linalg.norm(now[1] - angular) <= 1e-7 * np.linalg.norm(angular)


MODELS: dict[str, dict[str, Any]] = {
    "fem": {"law": ts.StableNeoHooke(young=2e4, poisson=0.3)},
    "fem hexahedra": {"law": ts.StVK(young=2e4, poisson=0.3), "cell": "hexahedron"},
    "mean dilatation": {
        "law": ts.NeoHooke(young=2e4, poisson=0.3),
        "model": ts.MeanDilatation(),
        "cell": "hexahedron",
    },
    "mean dilatation, tetra": {
        "law": ts.NeoHooke(young=2e4, poisson=0.45),
        "model": ts.MeanDilatation(),
    },
    "corotational": {"law": ts.Hooke(young=2e4, poisson=0.3), "model": ts.Corotational()},
    "mass spring": {"law": ts.Hooke(young=2e4, poisson=0.25), "model": ts.MassSpring()},
    "mass tensor": {"law": ts.StVK(young=2e4, poisson=0.3), "model": ts.MassTensor()},
    "mass link": {"law": ts.StVK(young=2e4, poisson=0.3), "model": ts.MassLink()},
    "rayleigh": {
        "law": ts.StVK(young=2e4, poisson=0.3),
        "viscosity": ts.Rayleigh(mass=0.5, stiffness=1e-4),
    },
}


def bars(count: int, cell: str) -> ts.Mesh:
    """One mesh of bars beside each other."""
    one = [
        ts.bar_mesh(size=(0.03, 0.02, 0.02), cells=(3, 2, 2), cell=cell, origin=(0.05 * i, 0, 0))
        for i in range(count)
    ]
    nodes = len(one[0].points)
    blocks = [part.body_blocks[0].nodes + nodes * i for i, part in enumerate(one)]
    return ts.Mesh(
        points=np.vstack([part.points for part in one]),
        cells=(ts.CellBlock(cell, np.vstack(blocks)),),
    )


def shaken(count: int, cell: str = "tetra", **body: Any) -> ts.Simulation:
    """Bars of one body, each stretched and turning in its own way, after 30 steps of 2 ms."""
    simulation = ts.Scene(
        bodies={"bars": ts.Body(mesh=bars(count, cell), density=1000, **body)},
        step=ts.EnergyMomentum("2 ms", solver=ts.Cholesky()),
    ).compile()
    nodes = len(simulation.positions["bars"]) // count
    for i in range(count):
        own = slice(nodes * i, nodes * (i + 1))
        x = simulation.positions["bars"]
        centre = x[own].mean(axis=0)
        x[own] = centre + (x[own] - centre) * (1.2 - 0.3 * i, 1, 1)
        spin = np.cross((3, 5 - 20 * i, 10), x[own] - centre)
        simulation.velocities["bars"][own] = spin + np.array((0.1, 0.3 * i, 0))
    for _ in range(30):
        assert simulation.step().converged
    return simulation


@pytest.mark.parametrize("name", MODELS)
def test_a_bar_moves_beside_another_as_alone(name: str) -> None:
    """To 1e-7 of its length: thirty steps that are solved to 1e-9 of what acts on both."""
    alone = shaken(1, **MODELS[name])
    both = shaken(2, **MODELS[name])
    x = alone.positions["bars"]
    np.testing.assert_allclose(both.positions["bars"][: len(x)], x, rtol=0, atol=1e-7 * 0.03)


def test_many_pieces_of_a_body_keep_their_momenta() -> None:
    """To 1e-7 of the sum of the sizes, 100 steps of a tolerance of 1e-9."""
    simulation = shaken(6, law=ts.StableNeoHooke(young=2e4, poisson=0.3))
    nodes = len(simulation.positions["bars"]) // 6
    parts = [np.arange(nodes * i, nodes * (i + 1)) for i in range(6)]
    before = [momenta(simulation, "bars", part) for part in parts]
    for _ in range(70):
        assert simulation.step().converged
    size = sum(np.linalg.norm(p) for p, _ in before)
    turning = sum(np.linalg.norm(turn) for _, turn in before)
    for part, (linear, angular) in zip(parts, before, strict=True):
        now = momenta(simulation, "bars", part)
        assert np.linalg.norm(now[0] - linear) <= 1e-7 * size
        assert np.linalg.norm(now[1] - angular) <= 1e-7 * turning


def test_bodies_in_contact_are_solved_together() -> None:
    """Two blocks hit each other: the sum of their momenta stays.

    To 1e-6 of what one had, the tolerance of the linear solver in contact.
    """
    law = ts.StableNeoHooke(young=1e5, poisson=0.3)
    meshes = [
        ts.bar_mesh(size=(0.05, 0.05, 0.05), cells=(2, 2, 2), cell="hexahedron", origin=origin)
        for origin in ((0, 0, 0), (0.052, 0.01, 0.005))
    ]
    simulation = ts.Scene(
        bodies={
            name: ts.Body(mesh=mesh, law=law, density=1000, start=ts.Start(velocity=(speed, 0, 0)))
            for name, mesh, speed in zip("ab", meshes, (1.0, -0.5), strict=True)
        },
        contacts=[ts.Contact(("a", "b"))],
        step=ts.EnergyMomentum("1 ms"),
    ).compile()
    every = np.arange(27)
    before = sum(momenta(simulation, name, every)[0] for name in "ab")
    struck = momenta(simulation, "a", every)[0]
    for _ in range(30):
        assert simulation.step().converged
    after = sum(momenta(simulation, name, every)[0] for name in "ab")
    assert np.linalg.norm(momenta(simulation, "a", every)[0] - struck) > 0.1
    np.testing.assert_allclose(after, before, rtol=0, atol=1e-6 * np.linalg.norm(struck))


def test_condensed_parts_have_nothing_to_correct() -> None:
    """Two bars of one condensed body, whose energy is quadratic: each moves as it does alone.

    To 1e-7 of its length, as above. Nodes on the surface stay; two inside each bar go.
    """
    body: dict[str, Any] = {
        "law": ts.Hooke(young=2e4, poisson=0.3),
        "model": ts.Condensed(keep="surface"),
    }
    alone = shaken(1, **body)
    both = shaken(2, **body)
    x = alone.positions["bars"]
    np.testing.assert_allclose(both.positions["bars"][: len(x)], x, rtol=0, atol=1e-7 * 0.03)
