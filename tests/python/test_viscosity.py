"""Viscosities of a scene: what is accepted, what is said of them, and closed forms."""

import numpy as np
import pytest

import tissu as ts
from tissu import (
    BarMesh,
    Body,
    Box,
    Centroid,
    Condensed,
    Fixed,
    ImplicitEuler,
    KelvinVoigt,
    Newton,
    Prescribed,
    Prony,
    PronyBranch,
    Scene,
    Static,
    StVK,
)
from tissu.compile import check_scene
from tissu.errors import SceneError

LAW = StVK(young=1e4, poisson=0.0)
BAR = Body(mesh=BarMesh(size=(1, 1, 1), cells=(2, 2, 2)), law=LAW, density=1e3)
RELAXING = Prony(branches=[PronyBranch(weight=0.6, time="200 ms")])
BOTTOM = Fixed("bar", on=Box((None, None, None), (None, None, 0)))


def scene(viscosity, **fields):
    body = BAR.replace(viscosity=viscosity, **fields.pop("body", {}))
    return Scene(
        **{"bodies": {"bar": body}, "fixed": [BOTTOM], "step": ImplicitEuler(0.01), **fields}
    )


@pytest.mark.parametrize(
    ("viscosity", "words"),
    [
        (KelvinVoigt(eta="40 Pa s"), "kelvin_voigt, eta 40 Pa s, zeta 0 Pa s"),
        (Centroid(coefficient="2e5 N s/m^4"), "centroid, coefficient 200000 N s/m^4"),
        (RELAXING, "prony, weight 0.6 time 0.2 s"),
    ],
)
def test_said_written_and_run(viscosity, words):
    made = scene(viscosity)
    effects = [str(effect) for effect in made.check().effects]
    assert f"viscosity of bar: bodies.bar.viscosity is {words}" in effects
    assert Scene.from_yaml_text(made.to_yaml()) == made
    simulation = made.compile()
    simulation.step()
    assert any("viscosity" in row.effect for row in simulation.profile().rows)


def test_units_and_their_refusals():
    assert KelvinVoigt(eta="3 mPa s", zeta="1 kPa*s") == KelvinVoigt(eta=3e-3, zeta=1e3)
    with pytest.raises(SceneError, match="found '3 kPa', which is a pressure; a viscosity is"):
        KelvinVoigt(eta="3 kPa")
    with pytest.raises(SceneError, match="coefficient: found '1 Pa s', which is a viscosity"):
        Centroid(coefficient="1 Pa s")


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: KelvinVoigt(), "found no eta and no zeta; leave viscosity out"),
        (lambda: KelvinVoigt(eta=-1), "eta: found -1; at least 0"),
        (lambda: Centroid(coefficient=0), "coefficient: found 0; more than 0"),
        (lambda: Prony(branches=[]), "at least 1"),
        (lambda: Prony(branches=[PronyBranch(weight=0.1, time=1)] * 17), "at most 16"),
        (lambda: PronyBranch(weight=-0.1, time=1), "weight: found -0.1; more than 0"),
        (lambda: PronyBranch(weight=0.1, time="1 mm"), "time: found '1 mm', which is a length"),
    ],
)
def test_refused(make, message):
    with pytest.raises(SceneError, match=message):
        make()


def test_refused_of_a_body():
    (problem,) = check_scene(scene(RELAXING, step=Static())).problems
    assert "found prony for a static step, which has no time for stress to relax in" in problem
    assert "1.6 times its stiffness that at once" in problem
    flat = {"mesh": BarMesh(size=(1, 1, 0), cells=(2, 2, 0), cell="quad"), "thickness": 0.1}
    problems = check_scene(scene(RELAXING, body=flat)).problems
    assert any("found prony for 4 cells of sheets or lines" in text for text in problems)
    assert not check_scene(scene(KelvinVoigt(eta=1.0), body=flat)).problems
    problems = check_scene(scene(KelvinVoigt(eta=1.0), body={"model": Condensed()})).problems
    assert any("found kelvin_voigt for a condensed region" in text for text in problems)


def held_and_led(viscosity, height, ramp):
    """A column that does not get thicker, whose top is led up by `height` in `ramp` seconds."""
    top = Prescribed(
        "bar",
        on=Box((None, None, 1), (None, None, None)),
        times=[0, ramp],
        displacements=[(0, 0, 0), (0, 0, height)],
    )
    step = ImplicitEuler(0.01, newton=Newton(iterations=20, tolerance=1e-10), solver=ts.Cholesky())
    light = {"density": 1.0}  # so that inertia has no part: its slowest period is 0.04 s
    return scene(viscosity, prescribed=[top], step=step, body=light).compile()


def test_stress_relaxes():
    """The standard linear solid: the energy above the law's own falls as exp(-2 t / tau)."""
    height, ramp, tau = 0.2, 0.1, 0.2
    elastic, relaxing = held_and_led(None, height, ramp), held_and_led(RELAXING, height, ramp)
    for simulation in (elastic, relaxing):
        for _ in simulation.run(ramp + 2 * tau):
            pass
    first = relaxing.energy()["elastic"] - elastic.energy()["elastic"]
    for simulation in (elastic, relaxing):
        for _ in simulation.run(tau):
            pass
    second = relaxing.energy()["elastic"] - elastic.energy()["elastic"]
    # What is left of the vibration, and of the strain that is not even along the column.
    assert second / first == pytest.approx(np.exp(-2.0), rel=1e-3)


def test_time_set_back_leaves_the_memory_its_age():
    """The clock may be set: what counts is the time since the memory was written."""
    one, other = held_and_led(RELAXING, 0.2, 0.1), held_and_led(RELAXING, 0.2, 0.1)
    for simulation in (one, other):
        for _ in simulation.run(0.2):
            pass
    other._core.time = 100.0
    one.step()
    other.step()
    np.testing.assert_allclose(one.positions["bar"], other.positions["bar"], rtol=0, atol=1e-12)
