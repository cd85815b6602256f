"""Three ways to run the same tick: one by one in C++, by a thread in real time, and in NumPy."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from tissu import _haptic
from tissu.errors import ParameterError
from tissu.trocar.law import Law
from tissu.trocar.recording import Recorder
from tissu.trocar.report import Grant, Spread, Timing
from tissu.trocar.sample import Offered, Sample
from tissu.trocar.settings import ANY_TOOL, fields_of
from tissu.trocar.states import Status

if TYPE_CHECKING:
    from tissu.trocar.kinematics import Array
    from tissu.trocar.model import LocalModel


class Ticking(Protocol):
    """What the controller asks of what ticks."""

    def start(self, *, priority: int, lock_memory: bool, pin: bool, spin: float) -> None:
        """Begin."""
        ...

    def stop(self) -> None:
        """End."""
        ...

    def end(self) -> None:
        """Switch the motors off."""
        ...

    def step(self, ticks: int) -> None:
        """Take ticks."""
        ...

    def set(self, settings: _haptic.Settings, delay: float) -> None:
        """Change the settings from the next tick on."""
        ...

    def publish(self, model: LocalModel, tag: int) -> int:
        """Hand over a model; its stamp."""
        ...

    def report(self) -> dict[str, Any]:
        """The newest tick."""
        ...

    def records(self) -> dict[str, Array]:
        """Ticks since the last call."""
        ...

    def timing(self) -> Timing:
        """How the machine let it run."""
        ...


def ticking_of(mode: str, device: _haptic.Device, settings: _haptic.Settings) -> Ticking:
    """What runs ticks in a mode.

    Raises:
        ParameterError: a mode that is none.
    """
    if mode in ("stepped", "threaded"):
        return CompiledTicking(device, settings, threaded=mode == "threaded")
    if mode == "python":
        return LawTicking(device, settings)
    raise ParameterError(f"found the mode '{mode}'; stepped, threaded and python are accepted")


def in_core(model: LocalModel, tag: int) -> _haptic.LocalModel:
    """A model as the ticks take it, its compliance symmetric and definite.

    Raises:
        ParameterError: a number is not finite, a direction not of unit length, W indefinite.
    """
    made = _haptic.LocalModel(
        stamp=0,
        tag=tag,
        q_ref=model.joints,
        l=model.points,
        anchor=model.anchors,
        normal=model.normals,
        tangent=model.tangents,
        friction=model.friction,
        force=model.forces,
        W=model.compliance,
    )
    if model.blade is not None:
        blade = model.blade
        made.set_blade(
            l=blade.point,
            way=blade.way,
            anchor=blade.anchor,
            compliance=blade.compliance,
            limit=blade.limit,
        )
    made.check()
    made.settle_compliance()
    return made


class CompiledTicking:
    """The C++ tick, one by one or by the thread of a loop."""

    def __init__(
        self, device: _haptic.Device, settings: _haptic.Settings, *, threaded: bool
    ) -> None:
        """Begin, off."""
        self._run, self._threaded = _haptic.Run(device, settings), threaded
        self.recorder: Recorder | None = None

    def record(self, settings: _haptic.Settings) -> None:
        """Record from now on, before the first tick."""
        self.recorder = Recorder(self._run, settings)

    def start(self, *, priority: int, lock_memory: bool, pin: bool, spin: float) -> None:
        """Start the thread, if there is one."""
        if self._threaded:
            self._run.start(priority=priority, lock_memory=lock_memory, pin=pin, spin=spin)

    def stop(self) -> None:
        """Stop the thread, if there is one."""
        self._run.stop()

    def end(self) -> None:
        """Switch the motors off."""
        self._run.end()

    def step(self, ticks: int) -> None:
        """Take ticks."""
        self._run.step(ticks)

    def set(self, settings: _haptic.Settings, delay: float) -> None:
        """Change the settings from the next tick on."""
        self._run.set(settings, delay=delay)
        if self.recorder is not None:
            self.recorder.changed(settings)

    def publish(self, model: LocalModel, tag: int) -> int:
        """Hand over a model; its stamp."""
        made = in_core(model, tag)
        self._run.publish(made)
        if self.recorder is not None:
            self.recorder.published(model, made)
        return made.stamp

    def report(self) -> dict[str, Any]:
        """The newest tick."""
        if self.recorder is not None:
            self.recorder.gather()
        return self._run.report()

    def records(self) -> dict[str, Array]:
        """Ticks since the last call."""
        return self._run.records()

    def timing(self) -> Timing:
        """How the machine let it run."""
        found = self._run.timing()
        spreads = ("lateness", "compute", "read", "write", "model_age")
        return Timing(
            running=found["running"],
            ticks=found["ticks"],
            missed=found["missed"],
            held=found["held"],
            grants=tuple(Grant(*grant) for grant in found["grants"]),
            **{name: Spread(**found[name]) for name in spreads},
        )


class LawTicking:
    """The NumPy law, one by one: for study. What a tick takes is in its timing."""

    def __init__(self, device: _haptic.Device, settings: _haptic.Settings) -> None:
        """Begin, off."""
        self._device, self._law = device, Law(fields_of(settings))
        self._offered: Offered | None = None
        self._tick, self._written = 0, Status.ok
        self._taken: list[float] = []
        self._rows: list[dict[str, Any]] = []

    def start(self, *, priority: int, lock_memory: bool, pin: bool, spin: float) -> None:
        """Nothing: ticks are taken by `step`."""

    def stop(self) -> None:
        """Nothing."""

    def end(self) -> None:
        """Switch the motors off."""
        _haptic.write(self._device, [0.0] * 5, enable=False)

    def step(self, ticks: int) -> None:
        """Take ticks."""
        for _ in range(ticks):
            began = time.perf_counter()
            self._one()
            self._taken.append(time.perf_counter() - began)

    def _one(self) -> None:
        law = self._law
        status, found = _haptic.read(self._device)
        read = Status(status)
        tag = ANY_TOOL if law.settings["tag"] == ANY_TOOL else found["tag"]
        sample = Sample(tuple(found["counts"]), found["time_ns"], found["flags"], tag)
        now = round(self._tick * law.settings["period"] * 1e9)
        command = law.tick(sample, self._offered, now_ns=now, read=read, written=self._written)
        torque, enable = [*map(float, command), 0.0], law.state.name not in ("off", "fault")
        self._written = Status(_haptic.write(self._device, torque, enable=enable))
        row = {"number": self._tick, **found, "read": status, "written": int(self._written)}
        self._rows.append({**row, "command": torque, "enable": enable, "q": law.q.copy()})
        self._tick += 1

    def set(self, settings: _haptic.Settings, delay: float) -> None:
        """Change the settings from the next tick on."""
        settings.check(delay)
        self._law.settings = fields_of(settings)

    def publish(self, model: LocalModel, tag: int) -> int:
        """Hand over a model; its stamp."""
        in_core(model, tag)  # refuses what the ticks would
        stamp = 1 if self._offered is None else self._offered.stamp + 1
        now = round(max(0, self._tick - 1) * self._law.settings["period"] * 1e9)
        self._offered = Offered(model, stamp, now)
        return stamp

    def report(self) -> dict[str, Any]:
        """The newest tick."""
        law = self._law
        return {
            "tick": self._tick,
            "state": law.state.name,
            "reason": law.reason.name,
            "q": law.q.copy(),
            "torque": law.torque.copy(),
            "grip": 0.0 if law.sample is None else law.sample.counts[4] * law.settings["grip_size"],
            "stiffness": law.scale,
            "tag": 0 if law.sample is None else law.sample.tag,
            "stored": law.stored,
            "share": law.share,
            "tank": law.tank.energy,
            "given_out": law.tank.given_out,
            **law.felt(),
        }

    def records(self) -> dict[str, Array]:
        """Ticks since the last call."""
        rows, self._rows = self._rows, []
        return {name: np.array([row[name] for row in rows]) for name in (rows[0] if rows else ())}

    def timing(self) -> Timing:
        """What ticks took."""
        if not self._taken:
            return Timing()
        p50, p99, p999 = np.percentile(self._taken, [50.0, 99.0, 99.9])
        spread = Spread(len(self._taken), float(p50), float(p99), float(p999), max(self._taken))
        return Timing(ticks=len(self._taken), compute=spread)
