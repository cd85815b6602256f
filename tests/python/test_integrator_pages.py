"""What the tables of integrators.md and explicit-implicit.md in docs/measured are made of."""

from __future__ import annotations

import math
import sys
from pathlib import Path

import numpy as np
import pytest

import tissu as ts

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench"))

import explicit_implicit as cubes
import fixed_point
import integrators


def test_the_oscillator_has_the_frequency_of_its_closed_form() -> None:
    simulation = integrators.oscillator(ts.RK4())
    assert simulation.largest_frequency() == pytest.approx(integrators.omega_of_oscillator())


# Between two halvings of a period's step the next term of the error changes the order by its ratio.
@pytest.mark.parametrize(
    ("name", "order", "tolerance"),
    [("symplectic_euler", 1, 0.05), ("rk2", 2, 0.02), ("rk4", 4, 0.05), ("bdf2", 2, 0.02)],
)
def test_orders_of_the_oscillator(name: str, order: int, tolerance: float) -> None:
    make = integrators.METHODS[name]
    errors = [integrators.oscillator_error(make, n) for n in (80, 160)]
    assert integrators.orders(errors) == [pytest.approx(order, abs=tolerance)]


def test_orders_are_those_of_powers_of_the_step() -> None:
    assert integrators.orders([8.0, 4.0, 1.0]) == [1.0, 2.0]


def test_implicit_euler_divides_the_energy_by_one_and_h2_omega2() -> None:
    """In each step, of any linear oscillator."""
    per_period, periods = 50, 3
    omega = integrators.omega_of_oscillator()
    h = 2 * math.pi / omega / per_period
    simulation = integrators.oscillator(integrators.METHODS["implicit_euler"](h))
    found = integrators.energies(simulation, per_period, periods)
    steps = np.arange(1, per_period * periods + 1).reshape(found.shape)
    np.testing.assert_allclose(found, (1 + (h * omega) ** 2) ** -steps.astype(float), rtol=1e-10)


def test_the_limit_of_explicit_euler_is_told_in_its_refusal() -> None:
    numbers = integrators.refusal()
    # exp(0.02 h) = 1 + h^2 omega^2: the closed form is its first term, h of 1e-5 s.
    assert numbers["limit"] == pytest.approx(numbers["closed"], rel=1e-4)
    assert f"{numbers['limit']:.4g}" in numbers["said"]
    found = integrators.stable_limit(numbers["said"])
    assert found == f"refused above {1e3 * numbers['limit']:.2g} ms"


def test_explicit_euler_by_hand_grows_as_predicted() -> None:
    """A cell with one free node: its led node begins a vibration, and explicit Euler feeds it."""
    omega, h = integrators.omega_of_oscillator(), 5e-3
    steps = round(cubes.TIME / h)
    simulation = integrators.oscillator(ts.SymplecticEuler(h))
    x, v = simulation.positions["cell"], simulation.velocities["cell"]
    first = simulation.energy()["total"]
    for _ in range(steps):
        before = v[7].copy()
        simulation.step()
        x[7] -= h * (v[7] - before)
    grown = math.sqrt(simulation.energy()["total"] / first)
    assert grown == pytest.approx(cubes.growth(omega, h), rel=1e-9)


def test_explicit_euler_by_hand_stretches_a_cube() -> None:
    """Below its growth it ends as symplectic Euler does, to first order in the step."""
    scene = cubes.cube(1e3, 1e4, ts.SymplecticEuler(1e-3), cells=2)
    by_hand = cubes.forward_euler(scene.compile(), 1e-3)
    simulation = scene.compile()
    for _ in simulation.run(cubes.TIME):
        pass
    rest = simulation.meshes["cube"].points
    apart = np.linalg.norm(simulation.positions["cube"] - rest * (1.05, 1, 1), axis=1).max()
    assert by_hand == pytest.approx(float(apart), rel=0.05)


def test_every_step_of_the_paper_is_refused_to_explicit_euler() -> None:
    limits = [cubes.cube(*pair, ts.ExplicitEuler()).compile().stable_step for pair in cubes.PAIRS]
    for pair, limit in zip(cubes.PAIRS, limits, strict=True):
        omega = cubes.cube(*pair, ts.ExplicitEuler()).compile().largest_frequency()
        assert limit == pytest.approx(cubes.euler_limit(omega), rel=1e-3)
        assert limit < min(cubes.PAPER_EXPLICIT[pair])
    assert cubes.is_refused(cubes.PAIRS[0], 1e-4)


def scene(step: object, **changes: object) -> ts.Scene:
    """A small cube."""
    return cubes.cube(1e3, 1e5, step, cells=2, **changes)


def test_power_iteration_finds_the_frequency_that_lanczos_finds() -> None:
    held = scene(ts.BDF2(1e-3), prescribed=[])
    _, omega = fixed_point.fastest_mode(held)
    assert omega == pytest.approx(held.compile().largest_frequency(), rel=1e-5)


@pytest.mark.parametrize("h_omega", [0.4, 0.9, 1.3])
def test_the_fixed_point_contracts_as_predicted(h_omega: float) -> None:
    held = scene(ts.BDF2(1e-3), prescribed=[])
    mode, omega = fixed_point.fastest_mode(held)
    speed = fixed_point.SMALL * omega * mode
    h = h_omega / omega
    first, later = fixed_point.first_contraction(h_omega), fixed_point.later_contraction(h_omega)
    found = fixed_point.contraction(held, [h], first, speed)
    if first < 1.0:
        assert found == pytest.approx(first, rel=1e-2)
    else:
        assert math.isnan(found)
    start = min(h, 0.9 / omega)
    assert fixed_point.contraction(held, [start, h, h], later, speed) == pytest.approx(
        later, rel=1e-2
    )


def test_rows_of_the_fixed_point_say_what_is_refused() -> None:
    table = fixed_point.fixed_point_table(scene, (0.5, 2.0))
    slow, fast = table.splitlines()[2:]
    assert "refused" not in slow
    assert fast.count("refused") == 3  # two contractions, and the plain iteration
