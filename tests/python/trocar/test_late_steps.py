"""Which steps are late in real time, and what they lose, on a clock of the test's own."""

from __future__ import annotations

from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import pytest

import tissu.trocar.run as module
from tissu.trocar.run import Trocars

DT = 0.01


class Clock:
    """A clock that goes on when a step is computed, and when something sleeps."""

    def __init__(self) -> None:
        self.now = 100.0

    def monotonic(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.now += seconds


def test_a_late_step_is_counted_once_and_not_caught_up(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of five steps of 10 ms one takes 35 ms: it is late by 25 ms, and those after it are not."""
    clock = Clock()
    monkeypatch.setattr(module, "time", clock)
    simulation: Any = SimpleNamespace(time=0.0, scene=SimpleNamespace(trocars={}))

    def steps() -> Iterator[Any]:
        for taken in (0.004, 0.035, 0.004, 0.009, 0.001):
            clock.now += taken
            simulation.time += DT
            yield object()

    trocars = Trocars(simulation, realtime=True)
    ends = []
    with trocars:
        for _ in trocars.along(steps()):
            ends.append(clock.now - 100.0)
    assert ends == pytest.approx([0.010, 0.045, 0.055, 0.065, 0.075], abs=1e-9)
    assert trocars._late == 1
    assert trocars._behind == pytest.approx(0.025, abs=1e-9)
