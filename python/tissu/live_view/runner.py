"""The thread that owns the simulations: it steps them, and does what is asked between two steps."""

from __future__ import annotations

import math
import queue
import sys
import threading
import time
import traceback
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from tissu.errors import BusyError, TissuError
from tissu.live_view.pace import Pace

if TYPE_CHECKING:
    from tissu.simulation import Simulation, StepReport

T = TypeVar("T")
Simulations = Sequence["Simulation"]

_STATIC_STEP = 1.0 / 30.0
"""Simulated time of a step of a static scene [s]: it only moves along the loads' times."""
_IDLE = 0.05
"""How long a paused thread waits for a wish before it looks again [s]."""
_CLOSED = "found a call to a view that is closed; open another one, or call the simulation itself"
_PATIENCE = 5e-4
"""How long it waits while another thread is inside a simulation [s]."""


class _Wish(NamedTuple):
    """What another thread asked for: how it is done, and what is said where it is not."""

    grant: Callable[[], None]
    refuse: Callable[[], None]


class Runner:
    """Steps one or several simulations at a pace, all by the same time.

    No other thread touches them meanwhile: what it wants of them it asks for, and gets between two
    steps.

    Attributes:
        simulations: those that it owns; a wish may put another one into its place.
        reports: of the latest step, one for each.
        after_step: called with these after each step.
        error: the sentence of what went wrong last; empty: nothing since the last play.
        playing: whether it steps.
        achieved: simulated time for wall time of late; 0 when it does not step.
        spare: share of the wall time of late in which it waited for its pace; 1 when paused.
    """

    def __init__(
        self,
        simulations: Sequence[Simulation],
        *,
        speed: float = 1.0,
        playing: bool = True,
        between: Callable[[], object] = lambda: None,
        step: Callable[[Simulation], StepReport] | None = None,
    ) -> None:
        """Take them over.

        Args:
            simulations: at least one.
            speed: simulated seconds for each second of wall time; infinite: as fast as it goes.
            playing: whether it begins to step at once.
            between: called in the thread after each step, and while paused.
            step: takes a step of a simulation; absent: its own.
        """
        self.simulations = list(simulations)
        self.reports: list[StepReport] = []
        self.after_step: list[Callable[[Sequence[StepReport]], object]] = []
        self.error = ""
        self.playing = playing
        self.achieved = 0.0
        self.spare = 0.0 if playing else 1.0
        self._waited = 0.0
        self._pace = Pace(speed)
        self._between = between
        self._advance = own_step if step is None else step
        self._wishes: queue.SimpleQueue[_Wish] = queue.SimpleQueue()
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, name="tissu view", daemon=True)
        self._measured: tuple[float, float] | None = None

    def start(self) -> None:
        """Begin."""
        self._thread.start()

    def stop(self) -> None:
        """End after the step that it is in; wishes that are still there are refused."""
        self._ended.set()
        self._wishes.put(_Wish(lambda: None, lambda: None))
        if self._thread.is_alive() and threading.current_thread() is not self._thread:
            self._thread.join()
        self._refuse_all()

    def _refuse_all(self) -> None:
        """What was asked for and is not done any more has an answer too."""
        while True:
            try:
                self._wishes.get_nowait().refuse()
            except queue.Empty:
                return

    def ask(self, wish: Callable[[list[Simulation]], T]) -> Future[T]:
        """Call a function with the simulations between two steps.

        Its error is that of the future; a TissuError is the runner's `error` too, and pauses
        nothing.
        """
        promise: Future[T] = Future()
        if self._ended.is_set():
            promise.set_exception(TissuError(_CLOSED))
            return promise

        def granted() -> None:
            try:
                promise.set_result(wish(self.simulations))
            except TissuError as error:
                self.error = str(error)
                promise.set_exception(error)
            except Exception as error:
                self._fail(error)
                promise.set_exception(error)

        def refused() -> None:
            promise.set_exception(TissuError(_CLOSED))

        self._wishes.put(_Wish(granted, refused))
        if self._ended.is_set():
            self._refuse_all()
        return promise

    @property
    def speed(self) -> float:
        """Simulated seconds for each second of wall time; infinite: as fast as it goes."""
        return self._pace.speed

    @speed.setter
    def speed(self, value: float) -> None:
        def change(_: Any) -> None:
            self._pace.speed = value
            self._pace.restart()

        self.ask(change)

    def play(self) -> Future[None]:
        """Step on; an error that was shown is forgotten."""
        return self.ask(lambda _: self._set_playing(True))

    def pause(self) -> Future[None]:
        """Stand still after the present step."""
        return self.ask(lambda _: self._set_playing(False))

    def step_once(self) -> Future[None]:
        """Pause, and take one step."""

        def once(_: Any) -> None:
            self._set_playing(False)
            self.error = ""
            self._step()

        return self.ask(once)

    def restart_clock(self) -> None:
        """Called by a wish that sets time back."""
        self._pace.restart()
        self._measured = None

    def _set_playing(self, playing: bool) -> None:
        if playing and not self.playing:
            self.error = ""
        self.playing = playing
        self.achieved = 0.0
        self.spare = 0.0 if playing else 1.0
        self.restart_clock()

    def _run(self) -> None:
        while not self._ended.is_set():
            try:
                left, begin = self._time_left(), time.monotonic()
                self._grant(left)
                self._waited += min(left, time.monotonic() - begin)
                if self._ended.is_set():
                    return
                if self.playing and self._time_left() <= 0.0:
                    self._step()
                self._between()
            except BusyError:  # the program looks at a simulation: there is another moment
                self._ended.wait(_PATIENCE)
            except Exception as error:
                self._fail(error)

    def _time_left(self) -> float:
        """Wall time until the next step is due [s]."""
        if not self.playing:
            return _IDLE
        return self._pace.wait(now=time.monotonic(), time=self.simulations[0].time)

    def _grant(self, until: float) -> None:
        """Do what is asked, and wait for wishes when there is time."""
        end = time.monotonic() + until
        while not self._ended.is_set():
            left = end - time.monotonic()
            try:
                wish = self._wishes.get(timeout=left) if left > 0 else self._wishes.get_nowait()
            except queue.Empty:
                return
            wish.grant()
            if not self.playing or self._wishes.empty():
                return

    def _step(self) -> None:
        """One step of each; where one fails it stands at its last good one, and all pause."""
        try:
            self.reports = [self._patiently(one) for one in self.simulations]
        except TissuError as error:
            self._set_playing(False)
            self.error = str(error)
            return
        self._measure()
        for hear in self.after_step:
            hear(self.reports)

    def _patiently(self, simulation: Simulation) -> StepReport:
        """A step, after the program's own thread has left the simulation that it looks at."""
        while True:
            try:
                return self._advance(simulation)
            except BusyError:
                if self._ended.wait(_PATIENCE):
                    raise

    def _measure(self) -> None:
        """Simulated time for wall time and what was waited, over half a second."""
        now, simulated = time.monotonic(), self.simulations[0].time
        if self._measured is None:
            self._measured, self._waited = (now, simulated), 0.0
            return
        wall, before = self._measured
        if simulated < before:  # time was set back
            self._measured, self._waited = (now, simulated), 0.0
        elif now - wall >= 0.5:
            self.achieved = (simulated - before) / (now - wall)
            self.spare, self._waited = min(1.0, self._waited / (now - wall)), 0.0
            self._measured = (now, simulated)

    def _fail(self, error: Exception) -> None:
        """An error that is not of the scene: it pauses, is shown, and is printed in full."""
        self._set_playing(False)
        self.error = f"{type(error).__name__}: {error}"
        traceback.print_exception(error, file=sys.stderr)


def own_step(simulation: Simulation) -> StepReport:
    """A step of a simulation by itself."""
    return simulation.step(step_of(simulation))


def step_of(simulation: Simulation) -> float | None:
    """The time of its next step [s]; None: its own."""
    return _STATIC_STEP if simulation.scene.step.type == "static" else None


def speed_of(text: str) -> float:
    """A speed as the page writes it: "0.5 x", or "as fast as it goes"."""
    return math.inf if text.startswith("as") else float(text.split()[0])
