"""Methods of a scene: what each does to a bar, what is refused, and the stable step."""

from __future__ import annotations

import math

import numpy as np
import pytest

import tissu as ts
from tissu.scene.step import STEPS, Explicit, Implicit

EXPLICIT = tuple(cls for cls in STEPS if issubclass(cls, Explicit))
IMPLICIT = tuple(cls for cls in STEPS if issubclass(cls, Implicit))
STEP = {"dt": "5 ms"}


def bar(step: object, **changes: object) -> ts.Scene:
    """A soft bar that is held at one end and falls at the other."""
    body = ts.Body(
        mesh=ts.BarMesh(size=(0.2, 0.05, 0.05), cells=(4, 1, 1), cell="hexahedron"),
        law=ts.StVK(young="60 kPa", poisson=0.3),
        density=1000,
        viscosity=ts.Rayleigh(mass=20.0),
    )
    fields = {
        "bodies": {"bar": body},
        "gravity": (0, 0, -9.81),
        "fixed": [ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        "step": step,
        "duration": 2.0,
    }
    return ts.Scene(**{**fields, **changes})  # type: ignore[arg-type]


def sag(scene: ts.Scene) -> float:
    """How far the end hangs down after the run [m]."""
    simulation = scene.compile()
    for report in simulation.run():
        assert report.converged, report
    return -float(simulation.displacements("bar")[:, 2].min())


@pytest.fixture(scope="module")
def equilibrium() -> float:
    """The sag at rest."""
    return sag(bar(ts.Static(newton=ts.Newton(iterations=30, tolerance=1e-10))))


# e^(-10 * 2) of the first swing is left after two seconds, and what tolerances of 1e-6 leave.
@pytest.mark.parametrize("method", EXPLICIT)
def test_explicit_methods_settle_at_the_equilibrium(method: type, equilibrium: float) -> None:
    """With the stable step, taken by the word auto."""
    assert sag(bar(method())) == pytest.approx(equilibrium, rel=1e-5)


@pytest.mark.parametrize("method", IMPLICIT)
def test_implicit_methods_settle_at_the_equilibrium(method: type, equilibrium: float) -> None:
    assert sag(bar(method(**STEP))) == pytest.approx(equilibrium, rel=1e-4)


@pytest.mark.parametrize("anderson", [0, 5])
def test_the_fixed_point_settles_at_the_equilibrium(anderson: int, equilibrium: float) -> None:
    omega = bar(ts.ImplicitEuler("1 ms")).compile().largest_frequency()
    step = ts.BDF2FixedPoint(dt=0.8 / omega, anderson=anderson)
    assert sag(bar(step)) == pytest.approx(equilibrium, rel=1e-4)


def test_the_word_auto_is_symplectic_euler_with_its_stable_step() -> None:
    text = bar(ts.SymplecticEuler()).to_yaml()
    scene = ts.Scene.from_yaml_text(text)
    assert scene.step == ts.SymplecticEuler(dt="auto")
    lines = [line for line in text.splitlines() if not line.startswith((" ", "step"))]
    assert "duration: 2.0" in lines
    short = ts.Scene.from_yaml_text(text.replace("step:", "step: auto\n_step:").split("_step:")[0])
    assert short.step == scene.step


def test_auto_takes_nine_tenths_of_the_stable_step_and_ends_on_time() -> None:
    simulation = bar(ts.SymplecticEuler(), duration=0.1).compile()
    # The damping of 20 / s lowers 2 / omega.
    omega, damping = simulation.largest_frequency(), 20.0
    limit = (math.sqrt(damping**2 + 4 * omega**2) - damping) / omega**2
    assert simulation.stable_step == pytest.approx(limit, rel=1e-3)
    assert simulation.dt == pytest.approx(0.8 * simulation.stable_step)
    reports = list(simulation.run())
    assert simulation.time == pytest.approx(0.1, abs=1e-12)
    assert 0.1 / limit < len(reports) < 1.5 * 0.1 / limit
    assert "stable up to" in str(simulation.plan())


@pytest.mark.parametrize("method", EXPLICIT)
def test_a_step_above_the_stable_one_is_refused_with_the_limit(method: type) -> None:
    limit = bar(method()).compile().stable_step
    with pytest.raises(ts.SceneError) as error:
        bar(method(dt=1.1 * limit)).compile()
    assert f"{limit:.4g}" in str(error.value)
    assert "step.dt" in str(error.value)
    simulation = bar(method(dt=0.9 * limit)).compile()
    with pytest.raises(ts.ParameterError, match="is stable up to"):
        simulation.step(1.1 * limit)
    assert simulation.time == 0.0


def test_implicit_methods_have_no_stable_step() -> None:
    simulation = bar(ts.BDF2("5 ms")).compile()
    assert simulation.stable_step == math.inf
    assert "stable up to" not in str(simulation.plan())


def test_nothing_stiff_has_no_step_of_its_own() -> None:
    scene = bar(ts.SymplecticEuler())
    everything = ts.Fixed("bar", on=ts.Box())
    with pytest.raises(ts.SceneError, match="nothing is stiff"):
        scene.replace(fixed=[everything]).compile()


@pytest.mark.parametrize(
    ("step", "words"),
    [
        ({"type": "rk5", "dt": 1e-3}, ["rk5", "rk4"]),
        ({"type": "bdf2"}, ["dt", "missing"]),
        ({"type": "bdf2", "dt": "auto"}, ["auto"]),
        ({"type": "rk4", "dt": "fast"}, ["fast", "auto"]),
        ({"type": "rk4", "dt": "-1 ms"}, ["-0.001", "auto"]),
        ({"type": "newmark", "dt": 0.1, "beta": 0.1}, ["0.1", "gamma / 2"]),
        ({"type": "newmark", "dt": 0.1, "gamma": 0.3}, ["gamma"]),
        ({"type": "implicit_euler", "dt": 0.1, "indefinite": "ignore"}, ["indefinite"]),
        ({"type": "bdf2_fixed_point", "dt": 0.1, "anderson": 20}, ["anderson"]),
        ({"type": "symplectic_euler", "solver": {"type": "cholesky"}}, ["solver", "unknown key"]),
        ("automatic", ["automatic"]),
    ],
)
def test_wrong_steps_are_refused_in_one_sentence(step: object, words: list[str]) -> None:
    with pytest.raises(ts.SceneError) as error:
        bar(step)
    for word in words:
        assert word in str(error.value)


def test_every_method_round_trips_through_yaml() -> None:
    for cls in STEPS:
        scene = bar(cls(dt=1e-3) if "dt" in cls.model_fields else cls())
        assert ts.Scene.from_yaml_text(scene.to_yaml()) == scene


def test_methods_keep_going_after_cells_are_removed() -> None:
    for cls in (*EXPLICIT, *IMPLICIT):
        scene = bar(cls() if cls in EXPLICIT else cls(dt="2 ms"), editing=True)
        simulation = scene.compile()
        for _ in range(5):
            simulation.step()
        simulation.remove_cells(body="bar", cells=[3])
        for _ in range(5):
            simulation.step()
        assert np.isfinite(simulation.positions["bar"]).all()


def test_refuse_leaves_the_state_at_the_last_good_step() -> None:
    """A bar that is pressed far together: its tangent is indefinite."""
    lead = ts.Prescribed(
        "bar",
        on=ts.Plane((0.2, 0, 0), (1, 0, 0)),
        times=(0, 0.2),
        displacements=[(0, 0, 0), (-0.15, 0, 0)],
    )

    def pressed(indefinite: str) -> ts.Simulation:
        step = ts.ImplicitEuler("50 ms", indefinite=indefinite, solver=ts.Cholesky())  # type: ignore[arg-type]
        return bar(step, prescribed=[lead], duration=0.2).compile()

    simulation = pressed("refuse")
    with pytest.raises(ts.TissuError, match="not positive definite"):
        for _ in simulation.run():
            last = simulation.time
    assert simulation.time == last
    for word in ("project", "regularise"):
        simulation = pressed(word)
        assert sum(report.indefinite for report in simulation.run()) > 0
        assert np.isfinite(simulation.positions["bar"]).all()


def test_a_body_starts_as_asked() -> None:
    scene = bar(ts.ImplicitEuler("1 ms"))
    body = scene.bodies["bar"].replace(
        start=ts.Start(velocity=(0, "3 m/s", 0), spin=(0, 0, "90 deg/s"))
    )
    simulation = scene.replace(bodies={"bar": body}).compile()
    rest = simulation.meshes["bar"].points
    expected = np.array((0, 3.0, 0)) + np.cross((0, 0, np.pi / 2), rest - rest.mean(axis=0))
    expected[rest[:, 0] == 0.0] = 0.0  # held
    np.testing.assert_allclose(simulation.velocities["bar"], expected, atol=1e-15)
    assert any(effect.name == "start of bar" for effect in simulation.plan().effects)


@pytest.mark.parametrize("shape", ["point", "plane", "random", "inside_out"])
def test_shapes_of_the_start(shape: str) -> None:
    scene = bar(ts.ImplicitEuler("1 ms"))
    body = scene.bodies["bar"].replace(start=ts.Start(shape=shape, seed=2))  # type: ignore[arg-type]
    simulation = scene.replace(bodies={"bar": body}, fixed=[]).compile()
    rest, now = simulation.meshes["bar"].points, simulation.positions["bar"]
    low, high = rest.min(axis=0), rest.max(axis=0)
    assert (now >= low - 1e-12).all()
    assert (now <= high + 1e-12).all()
    extents = np.ptp(now, axis=0)
    if shape == "point":
        assert extents.max() == 0.0
    elif shape == "plane":
        assert extents[2] == 0.0
    elif shape == "inside_out":
        assert len(simulation.inverted_cells("bar")) == 4
    else:
        assert np.abs(now - rest).max() > 0.01
        again = scene.replace(bodies={"bar": body}, fixed=[]).compile()
        np.testing.assert_array_equal(again.positions["bar"], now)
