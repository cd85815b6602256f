"""What comes into a tick: a sample of the device, and the newest model of the tissue."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from tissu.trocar.kinematics import AXES, Array
from tissu.trocar.model import LocalModel
from tissu.trocar.states import Flag


@dataclass(frozen=True, slots=True)
class Sample:
    """What a device says: (5,) counts, its time [ns], flags, and the tag of the tool."""

    counts: tuple[int, ...]
    time_ns: int = 0
    flags: int = int(Flag.homed | Flag.enabled | Flag.tool_in)
    tag: int = 1

    def has(self, flag: Flag) -> bool:
        """Whether a flag is set."""
        return bool(self.flags & flag)


@dataclass(frozen=True, slots=True)
class Offered:
    """A model with its stamp, which counts up, and the time that it was published at [ns]."""

    model: LocalModel
    stamp: int
    time_ns: int


@dataclass(slots=True)
class Motion:
    """What a sample says of the joints: their steps and speeds."""

    step: Array = field(default_factory=lambda: np.zeros(AXES))
    speed: Array = field(default_factory=lambda: np.zeros(AXES))
    fresh: bool = False
    fast: bool = False
