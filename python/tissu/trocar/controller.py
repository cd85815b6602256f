"""The controller of a trocar: it decides, supervises and reports; the ticks run below it.

The same tick runs in three ways: stepped (simulated time, the same bits every time), threaded (real
time, in C++ without the interpreter's lock) and python (the NumPy law, for study).

    controller = Controller(scene.trocars["right"])
    with controller:
        for _ in range(100):
            controller.step(10)
            report = controller.report()
            controller.publish(LocalModel.plane(report.q, through=..., normal=..., stiffness=500.0))
"""

from __future__ import annotations

from collections.abc import Mapping
from types import TracebackType
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from typing_extensions import Self

from tissu.arrays import real_array
from tissu.errors import ParameterError
from tissu.reading import written
from tissu.scene.trocar.tool import tag_of, tag_text
from tissu.scene.trocar.trocar import Trocar
from tissu.trocar import kinematics
from tissu.trocar.model import LocalModel
from tissu.trocar.opened import open_device
from tissu.trocar.recording import Recording
from tissu.trocar.report import Report, Timing
from tissu.trocar.settings import ANY_TOOL, settings_of
from tissu.trocar.states import Reason, State
from tissu.trocar.ticking import CompiledTicking, Ticking, ticking_of

if TYPE_CHECKING:
    from tissu import _haptic
    from tissu.trocar.kinematics import Array

Mode = Literal["stepped", "threaded", "python"]
STALE = 0.1
"""s: a model that is older is reported, whatever the step of the tissue is."""
LONGEST_SPIN = 86_400.0
"""s that a thread may spend awake before a tick"""
SUPERVISED = 0.04
"""s between two looks at the tool while ticks are stepped: the rate of a display."""


class Controller:
    """Holds one device: states, tool, gains, limits, start and stop.

    Attributes:
        trocar: the part of the scene.
        mode: how ticks are run.
        tool: name of the tool in the device; None: no tool that the scene knows.
        device: the device that is read and written.
    """

    def __init__(
        self,
        trocar: Trocar,
        *,
        mode: Mode = "stepped",
        device: _haptic.Device | None = None,
        record: bool = False,
        trust_plugins: bool = False,
    ) -> None:
        """Open the device; the trocar is off.

        Args:
            trocar: a part of a scene.
            mode: how ticks are run.
            device: an open device; absent: the one that the trocar names.
            trust_plugins: whether the file of a plug-in, which is a program, may run.
            record: whether all ticks are kept for `recording`; not in the mode python.

        Raises:
            TissuError: the device is not there, does not answer, or has another controller.
            ParameterError: a mode that is none, a stiffness that is not passive for the device, or
                something else than a trocar.
        """
        _refuse_other(
            trocar, Trocar, "trocar", 'one of a scene is accepted: scene.trocars["right"]'
        )
        self.trocar, self.mode = trocar, mode
        self._tools = {tag_of(tag): name for tag, name in trocar.tools.items()}
        first = next(iter(self._tools), 1)
        if device is None:
            device = open_device(trocar, first, trust_plugins=trust_plugins)
        self.device = device
        self._delay = max(trocar.device.loop_delay(), float(self.device.info()["delay"]))
        self._settings = settings_of(trocar)
        self._settings.check(self._delay)
        self._ticking: Ticking = ticking_of(mode, self.device, self._settings)
        if record:
            if not isinstance(self._ticking, CompiledTicking):
                text = "found record with the mode python; stepped and threaded record"
                raise ParameterError(text)
            self._ticking.record(self._settings)
        self._port = (trocar.port.frame(), np.array(trocar.port.at))
        self.tool: str | None = None

    def __enter__(self) -> Self:
        self.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.stop()

    # ---- start and stop

    def start(
        self,
        *,
        priority: int = 60,
        lock_memory: bool = True,
        pin: bool = True,
        spin: float = 0.0,
    ) -> None:
        """Switch on; threaded, begin to tick in real time.

        The trocar goes from off through homing to empty, and gives force once a known tool is in.

        Args:
            priority: of SCHED_FIFO; 0: not asked for.
            lock_memory: whether pages are to stay in memory.
            pin: whether the thread is to stay on the last processor.
            spin: last part of each wait that is spent awake [s].

        Raises:
            ParameterError: a spin that is not a time from 0 to a day.
            TissuError: its thread runs already, or the machine gives none.
        """
        given: object = spin
        if not isinstance(given, (int, float)) or not 0.0 <= given <= LONGEST_SPIN:
            text = f"found the spin {written(spin)}; 0 to {LONGEST_SPIN:g} s is accepted"
            raise ParameterError(text)
        self._set(run=True)
        self._ticking.start(priority=priority, lock_memory=lock_memory, pin=pin, spin=spin)

    def stop(self) -> None:
        """Switch off: the motors have no power when it returns."""
        self._ticking.stop()
        self._set(run=False)
        self._ticking.step(1)
        self._ticking.end()

    def acknowledge(self) -> None:
        """Continue after the trocar was held: it starts again as if the tool had just entered."""
        self._set(acknowledged=self._settings.acknowledged + 1)

    # ---- the ticks

    def step(self, ticks: int = 1) -> Report:
        """Take ticks one after the other, in simulated time; the tool is looked at between them.

        Raises:
            TissuError: the trocar runs in real time.
            ParameterError: fewer than one tick, or not a whole number.
        """
        given: object = ticks
        whole = isinstance(given, (int, np.integer)) and not isinstance(given, bool)
        if not whole or ticks < 1:
            raise ParameterError(f"found {written(ticks)} ticks; one or more are accepted")
        most = max(1, round(SUPERVISED / self._settings.period))
        while ticks > 0:
            now = min(ticks, most)
            self._ticking.step(now)
            self.supervise()
            ticks -= now
        return self.report()

    def publish(self, model: LocalModel) -> int:
        """Pass the newest model of the tissue to the ticks, and return its stamp.

        Places and directions are in the port's axes (`into_port`).

        Raises:
            ParameterError: a number is not finite, a direction that is not of unit length, an
                indefinite W, or an argument that is not a model.
        """
        _refuse_other(model, LocalModel, "model", "a LocalModel is accepted")
        tag = self._settings.tag if model.tag is None else model.tag
        return self._ticking.publish(model, tag)

    def expect_models(self, every: float) -> None:
        """Say how often a model comes [s]: one older than two of these and 100 ms is stale.

        `Touch` calls it with the step of the scene.

        Raises:
            ParameterError: not a time above 0.
        """
        given: object = every
        if not isinstance(given, (int, float)) or not 0.0 < given < np.inf:
            raise ParameterError(f"found {written(every)}; a time above 0 s is accepted")
        stale = max(2.0 * float(given), STALE)
        if stale != self._settings.stale:
            self._set(stale=stale)

    def supervise(self) -> None:
        """Check which tool is in the device, and accept it if the scene knows it.

        Called by `step`; in the mode threaded a program calls it, or `report`,
        at the rate of a display.
        """
        self._look(self._ticking.report())

    def _look(self, found: Mapping[str, Any]) -> None:
        if State[found["state"]].gives_force or not self._tools:
            return
        tag = int(found["tag"])
        if tag in self._tools and tag != self._settings.tag:
            self._set(tag=tag)

    def _set(self, **changes: Any) -> None:
        for name, value in changes.items():
            setattr(self._settings, name, value)
        self._ticking.set(self._settings, self._delay)

    # ---- what it says

    def report(self) -> Report:
        """The newest tick, its tool, and what is to be done."""
        found = self._ticking.report()
        self._look(found)
        state, reason = State[found["state"]], Reason[found["reason"]]
        tag = int(found["tag"])
        name = self._tools.get(tag) if self._tools else "tool"
        self.tool = name if state.gives_force or state is State.held else None
        R, at = self._port
        return Report(
            tick=int(found["tick"]),
            time=float(found["tick"]) * self._settings.period,
            state=state,
            reason=reason,
            problem=self._problem(state, reason, tag),
            tool=self.tool,
            tag=0 if tag == ANY_TOOL else tag,
            q=found["q"],
            tip=at + R @ kinematics.position(found["q"]),
            axis=R @ kinematics.axis(found["q"]),
            force=R @ found["force"],
            torque=found["torque"],
            grip=float(found["grip"]),
            coupling=float(found["stiffness"]),
            contacts=int(found["contacts"]),
            stored=float(found["stored"]),
            share=float(found["share"]),
            tank=float(found["tank"]),
            given_out=float(found["given_out"]),
            model_age=float(found["model_age"]),
            stale=float(found["model_age"]) > self._settings.stale,
            disagreement=float(found["disagreement"]),
            limited=bool(found["limited"]),
            timing=self.timing(),
        )

    def _problem(self, state: State, reason: Reason, tag: int) -> str:
        if state is State.empty and tag and self._tools and tag not in self._tools:
            known = ", ".join(f"{tag_text(t)} ({name})" for t, name in self._tools.items())
            return f"found the tag {tag_text(tag)}, which no tool of the scene has; known: {known}"
        driven = any(self._settings.homing_torque)
        if state is State.homing and not driven:
            return (
                "the device does not know its zero; home it, as its manual says, and it reports so"
            )
        return reason.words

    def timing(self) -> Timing:
        """Lateness of the ticks, and the rights that the machine granted."""
        return self._ticking.timing()

    def records(self) -> dict[str, Array]:
        """Ticks since this was called last, at most 4,096: an array for each field.

        Their `counts`, `flags`, `tag`, `read` and `written` come from the device, `command` and
        `enable` went to it; `number` counts periods.
        """
        return self._ticking.records()

    def recording(self) -> Recording:
        """Everything since the start, of a controller that records.

        Raises:
            ParameterError: it does not record, or ticks were lost because no report was asked for.
        """
        ticking = self._ticking
        if not isinstance(ticking, CompiledTicking) or ticking.recorder is None:
            raise ParameterError("nothing was recorded; make the controller with record=True")
        return ticking.recorder.recording()

    # ---- the port

    def into_port(self, places: Array) -> Array:
        """Places (n, 3) [m] of the scene in the port's axes, as models have them.

        Raises:
            ParameterError: not rows of three numbers.
        """
        R, at = self._port
        return np.asarray((_in_rows(places, "places") - at) @ R)

    def turned_into_port(self, directions: Array) -> Array:
        """Directions (n, 3) of the scene in the port's axes.

        Raises:
            ParameterError: not rows of three numbers.
        """
        return np.asarray(_in_rows(directions, "directions") @ self._port[0])

    def stiffness(self) -> Array:
        """K_c of the axes (4,) [N m/rad, N m/rad, N m/rad, N/m]."""
        return np.array(self._settings.stiffness)


def _refuse_other(value: object, kind: type, what: str, accepted: str) -> None:
    """What is not of a kind."""
    if not isinstance(value, kind):
        raise ParameterError(f"found the {what} {written(value)}; {accepted}")


def _in_rows(values: Array, what: str) -> Array:
    """Numbers (n, 3); three alone are one row."""
    found = real_array(values, what)
    if found.size % 3 or not 0 < found.ndim <= 2:
        raise ParameterError(f"found {what} of shape {found.shape}; (n, 3) is accepted")
    return np.asarray(found.reshape(-1, 3), dtype=float)
