"""Methods that make undamped vibrations grow: the stable step where only parts are damped.

The reference is the spectrum of the simulation's own matrices: with the eigenvalues z of
x'' = -M^-1 (K x + C x'), a step multiplies by 1 + h z (explicit Euler) or 1 + h z + (h z)^2 / 2
(Runge-Kutta of second order), which may grow by e^(h / 100).
"""

from __future__ import annotations

import numpy as np
import pytest

import tissu as ts

GROWTH = 0.01
"""[1/s]"""
SLACK = 0.025

FACTORS = {
    ts.ExplicitEuler: lambda z: np.abs(1 + z),
    ts.RK2: lambda z: np.abs(1 + z + z * z / 2),
}

VISCOSITIES = {
    "kelvin_voigt": ts.KelvinVoigt(eta=20.0),
    "rayleigh": ts.Rayleigh(mass=5.0, stiffness=0.001),
    "stiffness": ts.Rayleigh(stiffness=2e-4),
    "mass": ts.Rayleigh(mass=50.0),
}


def block(x=0.0, viscosity=None, young=2e5, cells=(3, 2, 1)):
    return ts.Body(
        mesh=ts.BarMesh(size=(0.06, 0.04, 0.02), cells=cells, cell="hexahedron", origin=(x, 0, 0)),
        law=ts.StVK(young=young, poisson=0.3),
        density=1000,
        viscosity=viscosity,
    )


def stable_step(bodies, step, **fields):
    return ts.Scene(bodies=bodies, step=step(), **fields).compile().stable_step


def limit_of_spectrum(simulation, factor):
    """The longest step up to which no step makes any mode grow by more than GROWTH [s].

    Of two over the largest damping at most: what is damped as fast is taken as if nothing held it.
    """
    K = simulation.stiffness().toarray()
    C = simulation.damping().toarray()
    m = simulation.mass_matrix().diagonal()[:, None]
    one = np.eye(len(m))
    modes = np.linalg.eigvals(np.block([[0 * one, one], [-K / m, -C / m]]))
    # Modes that do not move have a double eigenvalue zero, which round-off splits.
    modes = modes[np.abs(modes) > 1e-3 * np.abs(modes).max()]
    steps = np.geomspace(1e-10, 1e-1, 10001)
    bad = [h for h in steps if factor(h * modes).max() > np.exp(GROWTH * h) * (1 + 1e-12)]
    return min(bad[0], 2 / np.linalg.eigvals(C / m).real.max())


@pytest.mark.parametrize("viscosity", VISCOSITIES)
@pytest.mark.parametrize("method", FACTORS)
def test_a_damped_body_leaves_the_step_of_an_undamped_one(method, viscosity):
    """Two bodies that do not touch: the shorter of their steps. It was that of the damped one.

    SLACK: the bound of worlds in which damping differs may be a fiftieth below what is found, and
    shapes are found to a few thousandths.
    """
    damped = VISCOSITIES[viscosity]
    alone = [
        stable_step({"a": block()}, method),
        stable_step({"b": block(0.5, damped)}, method),
    ]
    both = stable_step({"a": block(), "b": block(0.5, damped)}, method)
    assert both == pytest.approx(min(alone), rel=SLACK)
    assert alone[0] < 0.5 * alone[1]


@pytest.mark.parametrize("ratio", [1e-4, 1e-2, 1e2, 1e4])
@pytest.mark.parametrize("method", FACTORS)
def test_the_stiffness_of_the_damped_body_does_not_hide_the_other(method, ratio):
    """Soft beside stiff, whose damping is far larger than anything of the undamped body."""
    damped = block(0.5, ts.Rayleigh(stiffness=2e-4), young=2e5 * ratio)
    alone = [stable_step({"a": block()}, method), stable_step({"b": damped}, method)]
    both = stable_step({"b": damped, "a": block()}, method)
    assert both == pytest.approx(min(alone), rel=SLACK)


@pytest.mark.parametrize("viscosity", ["kelvin_voigt", "rayleigh", "stiffness", "mass"])
@pytest.mark.parametrize("method", FACTORS)
def test_no_mode_grows_and_no_step_is_given_away(method, viscosity):
    """A damped body has nearly the step that its spectrum allows.

    The bound is that of all shapes, not of the modes alone: shorter by 14 % where explicit Euler
    lives of the damping of each, by 4 % at most elsewhere. With Kelvin and Voigt it was longer than
    the spectrum's. The sweep has shares of 2e-3.
    """
    simulation = ts.Scene(
        bodies={"a": block(viscosity=VISCOSITIES[viscosity])}, step=method()
    ).compile()
    limit = limit_of_spectrum(simulation, FACTORS[method])
    least = 0.85 if (method, viscosity) == (ts.ExplicitEuler, "kelvin_voigt") else 0.96
    assert least * limit <= simulation.stable_step <= 1.002 * limit


@pytest.mark.parametrize("ratio", [1e-2, 10.0, 1e3])
@pytest.mark.parametrize("method", FACTORS)
def test_a_body_whose_parts_are_damped_differently(method, ratio):
    """One viscosity, and half of the body stiffer: its own modes are damped less in their periods.

    The bound is that of shapes: it may be a tenth below the step that the modes allow, and a third
    with explicit Euler, whose steps were up to a fifth too long.
    """
    halves = {
        "left": ts.Box(min=(-1, -1, -1), max=(0.03, 1, 1)),
        "right": ts.Box(min=(0.03, -1, -1), max=(1, 1, 1)),
    }
    body = block(viscosity=VISCOSITIES["kelvin_voigt"], cells=(6, 2, 1))
    body = body.replace(
        mesh=body.mesh.replace(regions=halves),
        law={
            "left": ts.StVK(young=2e5, poisson=0.3),
            "right": ts.StVK(young=2e5 * ratio, poisson=0.3),
        },
    )
    simulation = ts.Scene(bodies={"a": body}, step=method()).compile()
    limit = limit_of_spectrum(simulation, FACTORS[method])
    least = 0.66 if method is ts.ExplicitEuler else 0.9
    assert least * limit <= simulation.stable_step <= 1.002 * limit


@pytest.mark.parametrize(("method", "dt"), [(ts.RK2, 1e-4), (ts.ExplicitEuler, 5e-6)])
def test_a_given_step_is_refused_whatever_is_damped_beside(method, dt):
    for damped in VISCOSITIES.values():
        with pytest.raises(ts.TissuError, match="is stable up to"):
            ts.Scene(bodies={"a": block(), "b": block(0.5, damped)}, step=method(dt)).compile()


@pytest.mark.parametrize("viscosity", ["kelvin_voigt", "rayleigh"])
def test_an_undamped_body_keeps_its_energy_beside_a_damped_one(viscosity):
    """It had 1e4 times its energy in steps that all said they had converged.

    5 %: what RK2 may add in 0.05 s, by 1 % a second of the amplitude, and what is damped of b.
    """
    bodies = {"a": block(), "b": block(0.5, VISCOSITIES[viscosity])}
    simulation = ts.Scene(bodies=bodies, step=ts.RK2()).compile()
    velocities = simulation.velocities["a"]
    velocities[:] += 0.05 * np.random.default_rng(0).normal(size=velocities.shape)
    before = simulation.energy()["total"]
    for report in simulation.run("50 ms"):
        assert report.converged
    assert simulation.energy()["total"] == pytest.approx(before, rel=0.05)


@pytest.mark.parametrize("method", [ts.RK4, ts.SymplecticEuler])
def test_methods_that_bear_undamped_vibrations_take_the_shortest_step_too(method):
    damped = block(0.5, VISCOSITIES["kelvin_voigt"])
    alone = [stable_step({"a": block()}, method), stable_step({"b": damped}, method)]
    both = stable_step({"a": block(), "b": damped}, method)
    assert both == pytest.approx(min(alone), rel=0.01)
