"""Threads and simulations: one thread at a time in one simulation, two simulations side by side."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import pytest

import tissu as ts

PUBLIC = sorted(name for name in dir(ts.Simulation) if not name.startswith("_"))


def _scene(cells: int, name: str = "bar", **changes: Any) -> ts.Scene:
    bar = ts.Body(
        mesh=ts.BarMesh(size=(0.4, 0.1, 0.1), cells=(4 * cells, cells, cells), cell="hexahedron"),
        law=ts.StVK(young=2e4, poisson=0.3),
        density=1000.0,
    )
    fields = {
        "name": name,
        "bodies": {"bar": bar},
        "fixed": [ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        "gravity": (0, 0, -9.81),
        "step": ts.ImplicitEuler(0.01, solver=ts.ConjugateGradient(tolerance=1e-6)),
        "duration": 1.0,
        "editing": True,
    }
    return ts.Scene(**{**fields, **changes})


class _Halted:
    """A core whose step begins and then waits until it may go on."""

    def __init__(self, core: Any) -> None:
        self._core = core
        self.begun, self.may_end = threading.Event(), threading.Event()

    def __getattr__(self, name: str) -> Any:
        return getattr(self._core, name)

    def step(self, h: float) -> Any:
        self.begun.set()
        assert self.may_end.wait(60.0)
        return self._core.step(h)


@contextmanager
def _in_a_step(simulation: ts.Simulation) -> Iterator[None]:
    """Another thread is in the middle of a step meanwhile."""
    halted = _Halted(simulation._core)
    simulation._core = halted  # type: ignore[assignment]
    thread = threading.Thread(target=simulation.step, name="surgeon")
    thread.start()
    try:
        assert halted.begun.wait(60.0)
        yield
    finally:
        halted.may_end.set()
        thread.join()
        simulation._core = halted._core


def _touch(simulation: ts.Simulation, name: str) -> None:
    found = getattr(simulation, name)
    if callable(found):
        found()


@pytest.fixture(scope="module")
def simulation() -> ts.Simulation:
    return _scene(1).compile()


@pytest.mark.parametrize("name", PUBLIC)
def test_no_member_lets_a_second_thread_in(simulation: ts.Simulation, name: str) -> None:
    """Every public method and property, those of later versions too."""
    with _in_a_step(simulation), pytest.raises(ts.BusyError):
        _touch(simulation, name)


def test_the_refusal_names_both_threads_and_what_to_do(simulation: ts.Simulation) -> None:
    with _in_a_step(simulation), pytest.raises(ts.BusyError) as told:
        simulation.remove_cells(body="bar", cells=[0])
    assert str(told.value) == (
        "found thread 'MainThread' at `remove_cells` of simulation 'bar' while thread 'surgeon' is "
        "in its `step`; one thread at a time is accepted: wait for that call, or give each thread "
        "a simulation of its own"
    )


def test_a_refused_entry_leaves_no_trace() -> None:
    """The same bits as of a simulation that no second thread touched, and the same cells."""
    alone, touched = _scene(1).compile(), _scene(1).compile()
    alone.step()
    with _in_a_step(touched):
        for name in PUBLIC:
            with pytest.raises(ts.BusyError):
                _touch(touched, name)
    assert touched.time == alone.time
    assert touched.meshes["bar"].cell_count == alone.meshes["bar"].cell_count
    assert np.array_equal(touched.positions["bar"], alone.positions["bar"])


def test_the_door_opens_again_after_an_error(simulation: ts.Simulation) -> None:
    with pytest.raises(ts.ParameterError):
        simulation.step(-1.0)
    thread = threading.Thread(target=simulation.step)
    before = simulation.time
    thread.start()
    thread.join()
    assert simulation.time == pytest.approx(before + 0.01, rel=1e-12)


def test_two_threads_at_one_simulation_take_whole_steps_only() -> None:
    """What both were let to do is what one of them would have done, bit for bit."""
    shared, alone = _scene(3).compile(), _scene(3).compile()
    taken: list[int] = []

    def steps() -> None:
        for _ in range(15):
            try:
                taken.append(shared.step().number)
            except ts.BusyError:
                continue

    threads = [threading.Thread(target=steps) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sorted(taken) == list(range(1, len(taken) + 1))
    for _ in taken:
        alone.step()
    assert np.array_equal(shared.positions["bar"], alone.positions["bar"])


def _is_inside(simulation: ts.Simulation) -> bool:
    """Whether a thread is in it: then its time cannot be asked for."""
    try:
        simulation.time  # noqa: B018
    except ts.BusyError:
        return True
    return False


def test_two_simulations_step_at_the_same_time() -> None:
    """Five whole steps of the small one lie within one step of the large one.

    The large one is found occupied before and after them, and finished no step in between: a lock
    that both shared would have kept the small one out until then. The pauses give an interpreter
    that is not left during a step the occasion to end it.
    """
    large, small = _scene(12, "large").compile(), _scene(1, "small").compile()
    finished, within = [0], threading.Event()

    def run() -> None:
        while not within.is_set() and finished[0] < 200:
            try:
                large.step()
            except ts.BusyError:
                continue
            finished[0] += 1

    thread = threading.Thread(target=run)
    thread.start()
    while thread.is_alive() and not within.is_set():
        before, entered = finished[0], _is_inside(large)
        if not entered:
            continue
        for _ in range(5):
            small.step()
            time.sleep(1e-4)
        if _is_inside(large) and finished[0] == before:
            within.set()
    thread.join()
    assert within.is_set()
    alone = _scene(1, "small").compile()
    for _ in range(round(small.time / 0.01)):
        alone.step()
    assert np.array_equal(small.positions["bar"], alone.positions["bar"])
