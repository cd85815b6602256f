"""Loads that are changed while a simulation runs: the bits of scenes that have them so."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import tissu as ts

BAR = ts.Body(
    mesh=ts.BarMesh(size=(0.4, 0.1, 0.1), cells=(4, 2, 2), cell="hexahedron"),
    law=ts.StVK(young=2e4, poisson=0.3),
    density=1000.0,
)
ROOT = ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))
END = ts.Plane((0.4, 0, 0), (1, 0, 0))
STEPS = {
    "implicit": ts.ImplicitEuler(2e-3),
    "explicit": ts.SymplecticEuler(1e-4),
    "static": ts.Static(solver=ts.Cholesky()),
}
FORCE = ts.NodalLoad("bar", on=END, force=(0, 0, 0))
TRACTION = ts.Traction("bar", on=END, traction=(0, 0, 5))
PRESSURE = ts.Pressure("bar", on=END, pressure=9)
DEAD = ts.Pressure("bar", on=END, pressure=0, follows=False)
LOADS: dict[str, tuple[Any, str, Any, Any]] = {
    "force": (FORCE, "force", ("20 mN", 0, 0.3), (0.02, 0, 0.3)),
    "traction": (TRACTION, "traction", (0, 7, "30 Pa"), (0, 7, 30)),
    "pressure": (PRESSURE, "pressure", "0.05 kPa", 50.0),
    "dead": (DEAD, "pressure", 50.0, 50.0),
}


def _scene(load: Any, step: Any, **changes: Any) -> ts.Scene:
    fields = {"bodies": {"bar": BAR}, "fixed": [ROOT], "loads": [load], "step": step}
    return ts.Scene(**{**fields, **changes})


def _run(simulation: ts.Simulation, steps: int = 3) -> Any:
    for _ in range(steps):
        assert simulation.step().converged
    return simulation.positions["bar"].copy()


@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("name", LOADS)
def test_a_changed_load_has_the_bits_of_a_scene_with_it(name: str, step: str) -> None:
    load, quantity, value, si = LOADS[name]
    live = _scene(load, STEPS[step]).compile()
    handle = live.load(0)
    setattr(handle, quantity, value)
    assert getattr(handle, quantity) == pytest.approx(np.array(si), abs=0.0, rel=1e-15)
    changed = _scene(load.replace(**{quantity: value}), STEPS[step]).compile()
    found = _run(live)
    assert np.array_equal(found, _run(changed))
    assert not np.array_equal(found, _run(_scene(load, STEPS[step]).compile()))
    assert live.energy() == changed.energy()


@pytest.mark.parametrize("name", LOADS)
def test_reset_is_the_scene_again(name: str) -> None:
    load, quantity, value, _ = LOADS[name]
    live, plain = (_scene(load, STEPS["implicit"]).compile() for _ in range(2))
    handle = live.load(0)
    setattr(handle, quantity, value)
    handle.factor = 3
    handle.reset()
    assert np.array_equal(np.array(getattr(handle, quantity)), np.array(getattr(load, quantity)))
    assert handle.factor == 1.0
    assert np.array_equal(_run(live), _run(plain))


@pytest.mark.parametrize("name", LOADS)
def test_a_factor_holds_in_place_of_the_times(name: str) -> None:
    load, quantity, value, _ = LOADS[name]
    load = load.replace(**{quantity: value})
    steady = load.replace(times=[0.0], factors=[0.25])
    ramped = load.replace(times=[0.0, 1.0], factors=[0.0, 8.0])
    live = _scene(ramped, STEPS["implicit"]).compile()
    handle = live.load(0)
    assert handle.factor == 0.0
    handle.factor = 0.25
    assert handle.factor == 0.25
    assert np.array_equal(_run(live), _run(_scene(steady, STEPS["implicit"]).compile()))
    handle.factor = None
    assert handle.factor == pytest.approx(8.0 * live.time, rel=1e-14)


def test_a_linear_body_answers_in_proportion() -> None:
    """Hooke's law: the tip of a bar under the traction t goes t L / E."""
    body = BAR.replace(law=ts.Hooke(young=2e4, poisson=0.0))
    load = ts.Traction("bar", on=END, traction=(0, 0, 0), name="pull")
    simulation = _scene(load, STEPS["static"], bodies={"bar": body}).compile()
    pull = simulation.load("pull")
    for traction in (100.0, 200.0, -50.0, 0.0):
        pull.traction = (traction, 0, 0)
        assert simulation.step().converged
        tip = simulation.displacements("bar")[-1]
        # Newton's tolerance of 1e-9 of the load.
        assert tip == pytest.approx((traction * 0.4 / 2e4, 0, 0), abs=1e-9)


@pytest.mark.parametrize("step", ["implicit", "explicit"])
@pytest.mark.parametrize("name", LOADS)
def test_a_checkpoint_carries_what_was_changed(name: str, step: str, tmp_path: Any) -> None:
    load, quantity, value, _ = LOADS[name]
    first = _scene(load, STEPS[step]).compile()
    _run(first)
    setattr(first.load(0), quantity, value)
    first.load(0).factor = 0.5
    _run(first)
    first.save_checkpoint(tmp_path / "mid.tissu")
    second = first.scene.compile(checkpoint=tmp_path / "mid.tissu")
    assert second.load(0).factor == 0.5
    assert np.array_equal(
        np.array(getattr(second.load(0), quantity)), np.array(getattr(first.load(0), quantity))
    )
    assert np.array_equal(_run(first), _run(second))


def test_cells_may_go_after_a_change() -> None:
    load, _, value, _ = LOADS["force"]
    simulation = _scene(load, STEPS["implicit"], editing=True).compile()
    simulation.load(0).force = value
    simulation.remove_cells(body="bar", cells=[1])
    assert simulation.load(0).force == pytest.approx((0.02, 0, 0.3))
    simulation.step()
    assert simulation.positions["bar"][-1, 2] > 0.1


def test_a_moment_on_frames() -> None:
    frames = BAR.replace(model=ts.Frames(lever="half"))
    load = ts.Moment("bar", on=END, moment=(0, 0, 0), name="twist")
    live = _scene(load, STEPS["implicit"], bodies={"bar": frames}).compile()
    live.load("twist").moment = ("1 N mm", 0, 0)
    other = _scene(load.replace(moment=(1e-3, 0, 0)), STEPS["implicit"], bodies={"bar": frames})
    found = _run(live)
    assert np.array_equal(found, _run(other.compile()))
    assert np.abs(found - live.meshes["bar"].points).max() > 1e-9


def test_what_is_refused() -> None:
    load = LOADS["force"][0].replace(name="pull")
    simulation = _scene(load, STEPS["implicit"]).compile()
    for which, text in (
        ("pul", "did you mean 'pull'"),
        (1, "found load 1; 0 to 0 are accepted"),
        (True, "found load True"),
    ):
        with pytest.raises(ts.ParameterError, match=text):
            simulation.load(which)
    with pytest.raises(ts.ParameterError, match="found pressure of the nodal load on bar"):
        simulation.load("pull").pressure = 3
    for value in ("3 Pa", (1, 2), (0, 0, float("nan"))):
        with pytest.raises(ts.TissuError):
            simulation.load("pull").force = value
    assert not np.any(simulation.load("pull").force)


def test_a_name_is_that_of_one_load() -> None:
    load = LOADS["force"][0].replace(name="pull")
    scene = _scene(load, STEPS["implicit"], loads=[load]).check()
    assert scene.ok
    with pytest.raises(ts.SceneError, match="found 'pull' twice"):
        _scene(load, STEPS["implicit"], loads=[load, load]).compile()
