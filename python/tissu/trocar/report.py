"""What a trocar says of itself, at the rate of a display."""

from __future__ import annotations

from dataclasses import dataclass, field

from tissu.trocar.kinematics import Array
from tissu.trocar.states import Reason, State


@dataclass(frozen=True, slots=True)
class Spread:
    """How long something took, of many times [s]."""

    count: int = 0
    p50: float = 0.0
    p99: float = 0.0
    p999: float = 0.0
    max: float = 0.0

    def __str__(self) -> str:
        us = ", ".join(
            f"{name} {1e6 * value:.0f}"
            for name, value in (
                ("p50", self.p50),
                ("p99", self.p99),
                ("p99.9", self.p999),
                ("max", self.max),
            )
        )
        return f"{us} us"


@dataclass(frozen=True, slots=True)
class Grant:
    """Something that was asked of the machine; a refusal is not an error.

    Attributes:
        what: such as "SCHED_FIFO 60".
        granted: whether it was given.
        error: errno where it was not.
        remedy: what to do about it; empty where it was granted.
    """

    what: str
    granted: bool
    error: int
    remedy: str

    def __str__(self) -> str:
        if self.granted:
            return f"{self.what}: granted"
        return f"{self.what}: refused (errno {self.error}); {self.remedy}"


@dataclass(frozen=True, slots=True)
class Timing:
    """How well the machine let the ticks run.

    Attributes:
        running: whether a thread runs them now.
        ticks: since the start.
        missed: periods without a tick.
        held: how often more than five in a row were missed.
        lateness: from when a tick was due to when it began.
        compute: of a whole tick.
        read: of reading the device.
        write: of writing it.
        model_age: of the model that was felt.
        grants: what was asked of the machine.
    """

    running: bool = False
    ticks: int = 0
    missed: int = 0
    held: int = 0
    lateness: Spread = field(default_factory=Spread)
    compute: Spread = field(default_factory=Spread)
    read: Spread = field(default_factory=Spread)
    write: Spread = field(default_factory=Spread)
    model_age: Spread = field(default_factory=Spread)
    grants: tuple[Grant, ...] = ()

    def __str__(self) -> str:
        lines = [f"{self.ticks} ticks, {self.missed} missed, held {self.held} times"]
        lines += [f"lateness: {self.lateness}", f"compute: {self.compute}"]
        lines += [f"read: {self.read}", f"write: {self.write}"]
        return "\n".join([*lines, *map(str, self.grants)])


@dataclass(frozen=True, slots=True)
class Report:
    """A trocar at one tick.

    Attributes:
        tick: its number.
        time: of the ticks [s].
        state: what it is doing.
        reason: why it is held or in fault.
        problem: one sentence where something is to be done; empty: nothing.
        tool: name of the tool that is in; None: none that is known.
        tag: of the tool.
        q: (4,) pitch, roll, own rotation [rad] and depth [m].
        tip: (3,) place of the tip in the scene [m].
        axis: (3,) unit vector along the tool into the body, in the scene.
        force: (3,) of the tissue on the tool, in the scene [N].
        torque: (4,) that the joints should feel [N m, N m, N m, N].
        grip: angle of the tool's grip, of a device that has a fifth channel [rad]; it is read, and
            never driven.
        coupling: share of the stiffness K_c that is in use; 0: no force is given.
        contacts: with a force.
        stored: energy in coupling and tissue [J].
        share: of the newest model's force that is felt; the rest waits for the tank.
        tank: energy that may be given out [J].
        given_out: energy that was given out since the start [J].
        model_age: of the model that is felt [s].
        stale: whether that is more than 100 ms, and than two steps of the tissue: the tissue is
            late, and its latest model is still felt.
        disagreement: of the mean force of the ticks and that of the slow step [N].
        limited: whether a limit cut the torque.
        timing: how the machine let it run.
    """

    tick: int
    time: float
    state: State
    reason: Reason
    problem: str
    tool: str | None
    tag: int
    q: Array
    tip: Array
    axis: Array
    force: Array
    torque: Array
    grip: float
    coupling: float
    contacts: int
    stored: float
    share: float
    tank: float
    given_out: float
    model_age: float
    stale: bool
    disagreement: float
    limited: bool
    timing: Timing

    def __str__(self) -> str:
        tool = "no tool" if self.tool is None else self.tool
        text = f"t = {self.time:.3f} s: {self.state.name}, {tool}, "
        force = float((self.force @ self.force) ** 0.5)
        text += f"depth {1e3 * self.q[3]:.1f} mm, force {force:.3f} N"
        return f"{text}; {self.problem}" if self.problem else text
