"""What a trocar is doing, and why it gives no force."""

from __future__ import annotations

from enum import IntEnum


class State(IntEnum):
    """What a trocar is doing. Only `free` and `contact` give force."""

    off = 0
    homing = 1
    empty = 2
    free = 3
    contact = 4
    held = 5
    fault = 6

    @property
    def gives_force(self) -> bool:
        """Whether the tissue is felt."""
        return self in (State.free, State.contact)


class Reason(IntEnum):
    """Why a trocar is held, in fault, or does not come home."""

    none = 0
    reads_failed = 1
    writes_failed = 2
    device_fault = 3
    not_finite = 4
    model_stalled = 5
    too_fast = 6
    tag_changed = 7
    late = 8
    ends_not_found = 9

    @property
    def words(self) -> str:
        """The reason, and what to do."""
        return _WORDS[self]


class Status(IntEnum):
    """What reading or writing a device gave."""

    ok = 0
    none = 1
    broken = 2
    gone = 3


class Flag(IntEnum):
    """Bits of the flags of a sample."""

    homed = 1
    enabled = 2
    tool_in = 4
    fault = 8


AGAIN = "stop the trocar and start it again"
ACKNOWLEDGE = "acknowledge it"
_WORDS = {
    Reason.none: "",
    Reason.reads_failed: f"the device gave no sample five times in a row; check it, then {AGAIN}",
    Reason.writes_failed: f"the device took no command five times in a row; check it, then {AGAIN}",
    Reason.device_fault: f"the device reports a fault of its own; clear it there, then {AGAIN}",
    Reason.not_finite: f"a model or a torque was not finite three times in a row; {AGAIN}",
    Reason.model_stalled: "no model of the tissue came for longer than a second; the next one ends "
    "it",
    Reason.too_fast: f"the tip moved faster than its limit; {ACKNOWLEDGE} when the device is well",
    Reason.tag_changed: "the tag changed while the tool was in; take the tool out",
    Reason.ends_not_found: "the axes came to rest before both of their ends; let go of the handle, "
    "or free what blocks it",
    Reason.late: "more than five ticks in a row were missed; "
    f"{ACKNOWLEDGE} when the machine has time",
}
