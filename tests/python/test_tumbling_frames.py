"""Frames that tumble: explicit methods and bdf2 keep the energy of free rods, and their orders."""

from __future__ import annotations

import numpy as np
import pytest

import tissu as ts

SPINS = [(20, 5, 20), (10, 2, 5), (60, 0, 5)]
"""[rad/s]; the rod lies along x"""


def rod(spin=(0, 0, 0), cells=6, length=0.1, section=5e-5):
    return ts.Body(
        mesh=ts.bar_mesh(size=(length, 0, 0), cells=(cells, 0, 0), cell="line"),
        law=ts.StVK(young=1e6, poisson=0.3),
        model="frames",
        section=section,
        density=1000,
        start=ts.Start(spin=spin),
    )


def energies(simulation, time):
    """Energies after each step, as shares of the first."""
    start = simulation.energy()["total"]
    found = []
    while simulation.time < time:
        simulation.step()
        found.append(simulation.energy()["total"] / start)
    return np.array(found)


@pytest.mark.parametrize("spin", SPINS)
def test_symplectic_steps_keep_the_energy_of_a_free_rod(spin) -> None:
    """A symplectic method's energy oscillates with h omega of what vibrates, here 1.5 % at most.

    Turns by h omega, which are explicit Euler for the gyroscopic part, let it grow without bound.
    """
    simulation = ts.Scene(bodies={"rod": rod(spin)}, step=ts.SymplecticEuler()).compile()
    found = energies(simulation, 3.0)
    assert np.abs(found - 1).max() < 0.03


@pytest.mark.parametrize("dt", [0.002, 0.01])
@pytest.mark.parametrize("spin", [*SPINS, (5, 1, 30)])
def test_bdf2_adds_no_energy_to_a_free_rod(spin, dt) -> None:
    """Like solid bars, rods lose some by the damping of the method; the start may add a percent."""
    simulation = ts.Scene(bodies={"rod": rod(spin)}, step=ts.BDF2(dt)).compile()
    assert energies(simulation, 3.0).max() < 1.01


def spinning(step):
    """A rod that turns about its axis at 300 rad/s and bends across it."""
    length = 0.04
    body = rod(cells=5, length=length, section=1e-5)
    simulation = ts.Scene(bodies={"rod": body}, step=step).compile()
    simulation.state["velocities"][simulation.rows("rod", rotations=True)] = (300, 0, 0)
    x = np.array(simulation.positions["rod"])[:, 0] / length - 0.5
    across = 4 * x * x - 1 / 3
    simulation.velocities["rod"][:] = 0.3 * np.stack([0 * x, across, 0.3 * across], 1)
    return simulation


def place_after(method, dt, time):
    simulation = spinning(method(dt))
    for _ in range(round(time / dt)):
        simulation.step()
    return np.array(simulation.positions["rod"])


@pytest.mark.parametrize(
    ("method", "order", "dt", "time"), [(ts.RK4, 4, 2e-5, 0.0064), (ts.RK2, 2, 2e-6, 0.0016)]
)
def test_runge_kutta_has_its_order_where_frames_spin(method, order, dt, time) -> None:
    """Differences between halved steps fall by 2^order; half an order is for higher ones."""
    places = [place_after(method, dt / 2**k, time) for k in range(3)]
    ratio = np.abs(places[0] - places[1]).max() / np.abs(places[1] - places[2]).max()
    assert np.log2(ratio) > order - 0.5


@pytest.mark.parametrize("method", ["impulse", "penalty"])
def test_a_rod_under_a_block_stays_where_it_is(method) -> None:
    """A soft block falls on a rod that lies on the floor: nothing gives energy but its fall."""
    rods = ts.Body(
        mesh=ts.bar_mesh(
            size=(0.04, 0, 0), cells=(5, 0, 0), cell="line", origin=(-0.005, 0.0148, 0.004)
        ),
        law=ts.StVK(young=1e6, poisson=0.3),
        model="frames",
        section=1e-5,
        density=1000,
    )
    block = ts.Body(
        mesh=ts.bar_mesh(
            size=(0.03, 0.03, 0.03), cells=(2, 2, 2), cell="tetra", origin=(0, 0, 0.03)
        ),
        law=ts.StVK(young=3e5, poisson=0.3),
        density=800,
        start=ts.Start(spin=(5, -8, 3)),
    )
    scene = ts.Scene(
        bodies={"rod": rods, "block": block},
        obstacles={"floor": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact("all", friction=0.4)],
        contact=ts.ContactSettings(method=method),
        gravity=(0, 0, -9.81),
        step=ts.SymplecticEuler(),
    )
    assert energies(scene.compile(), 0.25).max() < 1.05
