"""Grabbed points: closed forms, forces, letting go, checkpoints, what is refused."""

from __future__ import annotations

import threading
from typing import Any

import numpy as np
import pytest

import tissu as ts

LENGTH, SIDE, YOUNG = 0.4, 0.1, 2e4
AXIAL = YOUNG * SIDE**2 / LENGTH  # stiffness of the bar along x [N/m]
ROOT = ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))
DT = 2e-3

STEPS = {
    "implicit": ts.ImplicitEuler(DT),
    "iterated": ts.Newmark(DT),
    "explicit": ts.SymplecticEuler(1e-4),
}


def _bar(cell: str = "hexahedron", cells: tuple[int, int, int] = (4, 2, 2), **body: Any) -> ts.Body:
    law = body.pop("law", ts.Hooke(young=YOUNG, poisson=0.0))
    mesh = ts.BarMesh(size=(LENGTH, SIDE, SIDE), cells=cells, cell=cell)
    return ts.Body(mesh=mesh, law=law, density=1000.0, **body)


def _scene(body: ts.Body | None = None, **changes: Any) -> ts.Scene:
    fields: dict[str, Any] = {
        "bodies": {"bar": body or _bar()},
        "fixed": [ROOT],
        "step": ts.Static(solver=ts.Cholesky()),
        "grabbing": True,
    }
    return ts.Scene(**{**fields, **changes})


def _bending(step: Any, **changes: Any) -> ts.Scene:
    """A bar that turns as it swings."""
    body = _bar(law=ts.StVK(young=YOUNG, poisson=0.3))
    return _scene(body, step=step, gravity=(0, 0, -9.81), **changes)


def _last(simulation: ts.Simulation) -> int:
    return int(simulation.meshes["bar"].node_count - 1)


@pytest.mark.parametrize("solver", [ts.Cholesky(), ts.ConjugateGradient(tolerance=1e-12)])
@pytest.mark.parametrize("stiffness", [0.2 * AXIAL, 5.0 * AXIAL])
def test_a_bar_and_a_spring_in_series(solver: Any, stiffness: float) -> None:
    """One cell across: a grab at the middle of the end pulls evenly on its four nodes."""
    scene = _scene(_bar(cells=(4, 1, 1)), step=ts.Static(solver=solver))
    simulation = scene.compile()
    pull = 0.03
    grab = simulation.grab("bar", (LENGTH, 0.05, 0.05), (LENGTH + pull, 0.05, 0.05), stiffness)
    assert simulation.step().converged
    drawn = pull * stiffness / (stiffness + AXIAL)
    end = simulation.meshes["bar"].points[:, 0] > LENGTH - 1e-9
    # Newton's tolerance of 1e-9 of the load.
    assert simulation.displacements("bar")[end] == pytest.approx(
        np.tile((drawn, 0, 0), (4, 1)), abs=1e-8 * pull
    )
    assert grab.force == pytest.approx((AXIAL * drawn, 0, 0), abs=1e-6 * AXIAL * drawn)
    assert simulation.reactions("bar").sum(axis=0) == pytest.approx(
        -grab.force, abs=1e-6 * AXIAL * drawn
    )


@pytest.mark.parametrize("cell", ["tetra", "tetra10", "hexahedron", "hexahedron20", "wedge"])
def test_a_place_is_carried_by_its_cell(cell: str) -> None:
    """The place goes where a linear displacement takes it, and the force keeps its moment."""
    simulation = _scene(_bar(cell)).compile()
    place = np.array((0.23, 0.031, 0.072))
    grab = simulation.grab("bar", place, place + np.array((0, 0, 0.01)), 3.0)
    assert grab.position == pytest.approx(place, abs=1e-14)
    gradient = np.array([[0.1, 0.2, 0.0], [0.0, -0.1, 0.3], [0.05, 0.0, 0.2]])
    before = simulation.forces()
    rest = simulation.meshes["bar"].points
    pulled = before[: len(rest)] - _without(simulation)
    assert pulled.sum(axis=0) == pytest.approx(grab.force, abs=1e-12)
    assert np.cross(rest, pulled).sum(axis=0) == pytest.approx(
        np.cross(place, grab.force), abs=1e-12
    )
    simulation.positions["bar"][:] = rest + rest @ gradient.T
    assert grab.position == pytest.approx(place + gradient @ place, abs=1e-13)


def _without(simulation: ts.Simulation) -> Any:
    """Forces at rest of the same scene with nothing grabbed."""
    return simulation.scene.compile().forces()[: simulation.meshes["bar"].node_count]


def test_the_matrix_is_the_derivative_of_the_force() -> None:
    simulation = _bending(STEPS["implicit"]).compile()
    bare = simulation.stiffness().toarray()
    place = (0.23, 0.031, 0.072)
    grab = simulation.grab("bar", place, (0.3, 0.1, 0.1), 70.0)
    added = simulation.stiffness().toarray() - bare
    step = 1e-3
    node = int(np.flatnonzero(np.abs(added).sum(axis=1))[-1] // 3)  # one that carries the place
    forces = []
    for sign in (1.0, -1.0):
        simulation.positions["bar"][node, 2] += sign * step
        full = simulation.forces()
        force = grab.force
        grab.release()
        forces.append(full - simulation.forces())
        grab = simulation.grab("bar", place, (0.3, 0.1, 0.1), 70.0)
        assert forces[-1].sum(axis=0) == pytest.approx(force, abs=1e-11)
        simulation.positions["bar"][node, 2] -= sign * step
    slope = (forces[0] - forces[1]).ravel() / (2 * step)
    held = simulation.meshes["bar"].points[:, 0] < 1e-9
    slope.reshape(-1, 3)[held] = 0.0
    found = added[:, 3 * node + 2]
    # Round-off of forces of some 100 N over the step.
    assert min(np.abs(found - slope).max(), np.abs(found + slope).max()) < 1e-8
    assert np.abs(found).max() > 1.0


@pytest.mark.parametrize("name", STEPS)
def test_letting_go_gives_the_bits_of_a_run_without(name: str) -> None:
    plain = _bending(STEPS[name], grabbing=False).compile()
    grabbed = _bending(STEPS[name]).compile()
    for number in range(8):
        if number in (2, 5):
            grab = grabbed.grab("bar", _last(grabbed), (0, 0, 1), "1 N/mm")
            assert np.linalg.norm(grab.force) > 500.0
            grab.release()
            assert grab.released
        plain.step()
        grabbed.step()
    assert np.array_equal(plain.positions["bar"], grabbed.positions["bar"])
    assert np.array_equal(plain.velocities["bar"], grabbed.velocities["bar"])


@pytest.mark.parametrize("name", STEPS)
def test_a_checkpoint_goes_on_with_its_grabs_bit_for_bit(name: str, tmp_path: Any) -> None:
    simulation = _bending(STEPS[name]).compile()
    kept = simulation.grab("bar", (0.31, 0.04, 0.02), (0.31, 0.04, 0.1), 4.0)
    gone = simulation.grab("bar", _last(simulation), (0.3, 0.1, 0.1), 3.0)
    for _ in range(4):
        simulation.step()
    gone.release()
    kept.target = ("30 cm", 0.05, 0.12)
    simulation.save_checkpoint(tmp_path / "mid.tissu")
    other = simulation.scene.compile(checkpoint=tmp_path / "mid.tissu")
    (found,) = other.grabs
    assert (found.body, found.stiffness) == ("bar", 4.0)
    assert np.array_equal(found.target, (0.3, 0.05, 0.12))
    for _ in range(4):
        simulation.step()
        other.step()
    assert np.array_equal(simulation.positions["bar"], other.positions["bar"])
    assert np.array_equal(kept.force, found.force)
    assert np.linalg.norm(kept.force) > 0.01


def test_a_free_body_swings_about_its_target() -> None:
    """Every node by k_i = m_i w^2: u'' = w^2 (d - u) of a rigid body, by the method's own rule."""
    omega, drawn = 20.0, 0.02
    scene = _scene(fixed=[], step=ts.ImplicitEuler(DT, solver=ts.Cholesky()))
    simulation = scene.compile()
    masses = simulation.mass_matrix().diagonal()[::3]
    points = simulation.meshes["bar"].points
    for node, place in enumerate(points):
        simulation.grab(
            "bar", node, place + np.array((0, drawn, 0)), float(masses[node]) * omega**2
        )
    u = v = 0.0
    for _ in range(50):
        simulation.step()
        v = (v + DT * omega**2 * (drawn - u)) / (1.0 + (DT * omega) ** 2)
        u += DT * v
        # The linear solver is direct: round-off of 50 steps.
        expected = np.tile((0, u, 0), (len(points), 1))
        assert simulation.displacements("bar") == pytest.approx(expected, abs=1e-12)
    total = sum(grab.force for grab in simulation.grabs)
    assert total == pytest.approx((0, masses.sum() * omega**2 * (drawn - u), 0), abs=1e-9)


def test_the_stable_step_knows_what_is_grabbed() -> None:
    simulation = _bending(STEPS["explicit"]).compile()
    simulation.step()
    before = simulation.stable_step
    grab = simulation.grab("bar", _last(simulation), (0.4, 0.1, 0.1), "100 kN/mm")
    stiff = simulation.stable_step
    assert stiff < 0.1 * before
    assert simulation.largest_frequency() * stiff == pytest.approx(2.0, rel=0.1)
    with pytest.raises(ts.ParameterError, match="stable up to"):
        simulation.step()
    grab.release()
    assert simulation.stable_step == pytest.approx(before, rel=1e-6)


def test_a_point_off_a_frame_turns_with_it() -> None:
    """p = x + R offset; the force acts at x, with the moment (R offset) x f about it."""
    law = ts.StVK(young=YOUNG, poisson=0.3)
    simulation = _scene(_bar(law=law, model=ts.Frames()), step=ts.ImplicitEuler(DT)).compile()
    node, offset = _last(simulation), np.array((0.05, 0.0, 0.0))
    rest = simulation.meshes["bar"].points[node] + offset
    grab = simulation.grab("bar", node, rest + np.array((0, 0, 0.01)), 5.0, offset=offset)
    assert grab.position == pytest.approx(rest, abs=1e-14)
    for _ in range(10):
        assert simulation.step().converged
    arm = simulation.rotations("bar")[node] @ offset
    assert np.abs(arm - offset).max() > 1e-5
    assert grab.position == pytest.approx(simulation.positions["bar"][node] + arm, abs=1e-15)
    force, full = grab.force, simulation.forces()
    grab.release()
    added = full - simulation.forces()
    expected = np.zeros_like(added)
    expected[simulation.rows("bar").start + node] = force
    expected[simulation.rows("bar", rotations=True).start + node] = np.cross(arm, force)
    # Round-off of the elastic forces, below 1 N.
    assert added == pytest.approx(expected, abs=1e-13)


def test_it_follows_a_moved_target_and_says_what_it_is() -> None:
    simulation = _scene(_bar(cells=(4, 1, 1))).compile()
    grab = simulation.grab("bar", (LENGTH, 0.05, 0.05), (LENGTH, 0.05, 0.05), "100 N/m")
    assert repr(grab) == "Grab(of 'bar' to (0.4, 0.05, 0.05) m, 100 N/m)"
    for pull in (0.01, 0.02, 0.0):
        grab.target = (LENGTH + pull, 0.05, 0.05)
        assert simulation.step().converged
        force = 1.0 / (1.0 / 100.0 + 1.0 / AXIAL) * pull
        assert grab.force == pytest.approx((force, 0, 0), abs=1e-6)
    grab.stiffness = 250.0
    assert grab.stiffness == 250.0
    grab.release()
    grab.release()
    assert simulation.grabs == ()
    with pytest.raises(ts.ParameterError, match="that was let go"):
        grab.target = (0, 0, 0)


def test_energy_is_that_of_the_spring() -> None:
    simulation = _scene().compile()
    simulation.grab("bar", _last(simulation), (LENGTH, SIDE, SIDE + 0.02), 30.0)
    assert simulation.energy()["potential"] == pytest.approx(0.5 * 30.0 * 0.02**2, rel=1e-12)


REFUSED = {
    "body": (("bra", 3, (0, 0, 0), 1.0), {}, "did you mean 'bar'"),
    "node": (("bar", 999, (0, 0, 0), 1.0), {}, "found node 999 of 'bar'; 0 to 44 are accepted"),
    "place": (("bar", (1, 0, 0), (0, 0, 0), 1.0), {}, "in no cell of 'bar'"),
    "held": (("bar", 0, (0, 0, 0), 1.0), {}, "held or led on all axes"),
    "stiffness": (("bar", 44, (0, 0, 0), 0.0), {}, "stiffness of 0 N/m"),
    "unit": (("bar", 44, (0, 0, 0), "3 N"), {}, "a stiffness is accepted"),
    "target": (("bar", 44, (0, 0), 1.0), {}, "three components"),
    "offset": (("bar", 44, (0, 0, 0), 1.0), {"offset": (0, 0, 1)}, "have no rotation"),
    "nan": (("bar", 44, (0, 0, float("nan")), 1.0), {}, "not finite"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_refused(name: str) -> None:
    given, named, text = REFUSED[name]
    simulation = _scene().compile()
    with pytest.raises(ts.ParameterError, match=text):
        simulation.grab(*given, **named)
    assert simulation.grabs == ()


def test_a_scene_that_does_not_ask_for_it_has_none() -> None:
    simulation = _scene(grabbing=False).compile()
    assert simulation.grabs == ()
    assert "grabs" in simulation.plan().absent
    with pytest.raises(ts.ParameterError, match=r"scene\.replace\(grabbing=True\)"):
        simulation.grab("bar", 44, (0, 0, 0), 1.0)


def test_nodes_of_a_condensed_region_are_refused() -> None:
    body = _bar(law=ts.StVK(young=YOUNG, poisson=0.3), model="condensed", law_for_model="nearest")
    simulation = _scene(body).compile()
    points = simulation.meshes["bar"].points
    inner = int(np.abs(points - (0.2, 0.05, 0.05)).sum(axis=1).argmin())
    with pytest.raises(ts.ParameterError, match="inside a condensed region"):
        simulation.grab("bar", inner, (0, 0, 0), 1.0)


def test_another_thread_waits_its_turn() -> None:
    simulation = _scene().compile()
    grab = simulation.grab("bar", 44, (0.4, 0.1, 0.2), 1.0)
    refused = []

    def look() -> None:
        try:
            _ = grab.force
        except ts.BusyError as error:
            refused.append(str(error))

    with simulation._entry.entered("step"):
        thread = threading.Thread(target=look)
        thread.start()
        thread.join()
    assert len(refused) == 1


def test_cells_may_go_while_it_holds() -> None:
    simulation = _bending(STEPS["implicit"], editing=True).compile()
    grab = simulation.grab("bar", _last(simulation), (0.4, 0.1, 0.2), 3.0)
    simulation.step()
    simulation.remove_cells(body="bar", cells=[5])
    (found,) = simulation.grabs
    assert np.array_equal(found.force, grab.force)
    simulation.step()
