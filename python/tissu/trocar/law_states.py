"""How a trocar goes from state to state in a tick: the part of the law that counts failures."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.trocar.kinematics import AXES
from tissu.trocar.states import Flag, Reason, State, Status

if TYPE_CHECKING:
    from tissu.trocar.law import Law
    from tissu.trocar.sample import Motion, Offered

_FAILURES = 5
"""Reads or writes in a row that fail."""
_NOT_FINITE = 3
_OTHER_TAG = 20
"""Samples in a row with another tag: a single one is noise."""
_LATE = 5
"""Ticks in a row that may be missed."""
_RETURN = 0.002
"""m below where it was out, at which a tool is in again."""


def model_age(offered: Offered | None, now_ns: int) -> float:
    """Age of the newest model [s]; 0 of none, or where the clock stepped back."""
    if offered is None or offered.stamp == 0:
        return 0.0
    return max(0.0, 1e-9 * (now_ns - offered.time_ns))


def change_state(
    law: Law, motion: Motion, age: float, late: int, read: Status, written: Status
) -> None:
    """The state after a sample."""
    if not law.settings["run"]:
        law.state, law.reason = State.off, Reason.none
        law.failed_reads = law.failed_writes = law.bad_models = 0
    elif law.state is not State.fault and _fault(law, read, written) is not Reason.none:
        law.reason = _fault(law, read, written)
        law.state, law.homed = State.fault, False
    elif not law.homed and law.state is not State.fault:
        law.state, law.reason = State.homing, Reason.none
    else:
        _go_on(law, motion, age, late)
    law.acknowledged = law.settings["acknowledged"]


def _fault(law: Law, read: Status, written: Status) -> Reason:
    if law.failed_reads >= _FAILURES or read is Status.gone:
        return Reason.reads_failed
    if law.failed_writes >= _FAILURES or written is Status.gone:
        return Reason.writes_failed
    if law.sample is not None and law.sample.has(Flag.fault):
        return Reason.device_fault
    return Reason.not_finite if law.bad_models >= _NOT_FINITE else Reason.none


def _hold(law: Law, motion: Motion, age: float, late: int) -> Reason:
    if motion.fast:
        return Reason.too_fast
    if law.other_tag >= _OTHER_TAG:
        return Reason.tag_changed
    if late > _LATE:
        return Reason.late
    stalled = age > law.settings["stall"] + law.settings["fade"]
    return Reason.model_stalled if stalled else Reason.none


def _has_tool(law: Law, below: float) -> bool:
    sample = law.sample
    if sample is None or not (sample.has(Flag.tool_in) and sample.has(Flag.enabled)):
        return False
    return bool(law.q[3] >= law.settings["joint_low"][3] + below)


def _go_on(law: Law, motion: Motion, age: float, late: int) -> None:
    sample, tag = law.sample, law.settings["tag"]
    if law.state in (State.off, State.homing):
        law.state = State.empty if law.homed else State.homing
    elif law.state is State.empty:
        known = motion.fresh and sample is not None and tag != 0 and sample.tag == tag
        if known and _has_tool(law, _RETURN):
            _enter(law)
    elif law.state.gives_force:
        assert sample is not None  # a force has had a sample
        if motion.fresh:
            same = sample.tag == law.tag or not sample.has(Flag.tool_in)
            law.other_tag = 0 if same else law.other_tag + 1
        reason = _hold(law, motion, age, late)
        if not _has_tool(law, 0.0) or tag != law.tag:
            law.state = State.empty
        elif reason is not Reason.none:
            law.state, law.reason = State.held, reason
    elif law.state is State.held and _ends(law, age):
        law.state, law.reason = State.empty, Reason.none


def _ends(law: Law, age: float) -> bool:
    """Whether what held it is over."""
    if law.acknowledged != law.settings["acknowledged"]:
        return True
    if law.reason is Reason.model_stalled:
        return age <= float(law.settings["stall"])
    out = law.sample is not None and not law.sample.has(Flag.tool_in)
    return law.reason is Reason.tag_changed and out


def _enter(law: Law) -> None:
    """The newest model is taken whatever was there before; K_c begins at 0."""
    assert law.sample is not None
    law.model, law.G, law.g0 = None, np.zeros((0, AXES)), np.zeros(0)
    law.forces, law.slip, law.shift = (np.zeros(3) for _ in range(3))
    law.tag, law.other_tag, law.ramp = law.sample.tag, 0, 0.0
    law.reason, law.state = Reason.none, State.free
