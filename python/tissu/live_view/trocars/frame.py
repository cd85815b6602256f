"""What the page is given of a trocar at one moment."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

COLUMNS = (
    *("time", "force of steps", "force of ticks"),
    *("pitch torque", "roll torque", "rotation torque", "depth force"),
    *("pitch", "roll", "rotation", "depth"),
)
"""Of `TrocarFrame.history` [s, N, N m, N, rad, m]: what the hand feels, and where it has the tool.
"""


@dataclass(frozen=True, slots=True, eq=False)
class TrocarFrame:
    """A trocar at one moment.

    Attributes:
        name: of the trocar.
        lane: number of the simulation that it is in.
        state: of its ticks, by name.
        problem: what is to be done, in one sentence; empty: nothing.
        tool: name of the tool that is in; None: none that is known.
        next_tool: name of the tool that is to be in, of a simulated device; None: none.
        hand: what leads it: scene, browser or device.
        slow: force of the tissue's latest step on the tool [N].
        fast: the same of the latest tick, which the hand feels [N].
        torque: (4,) that the joints feel [N m, N m, N m, N].
        joints: (4,) where the hand has the tool [rad, rad, rad, m].
        wanted: (4,) where the page wants it.
        ahead: how far the hand's tip is from that of the tool in the tissue [m].
        contacts: that the ticks feel.
        length: of the arrow of 1 N [m].
        history: (k, 11) of late, with the columns `COLUMNS`.
    """

    name: str
    lane: int
    state: str
    problem: str
    tool: str | None
    next_tool: str | None
    hand: str
    slow: float
    fast: float
    torque: Floats
    joints: Floats
    wanted: Floats
    ahead: float
    contacts: int
    length: float
    history: Floats
