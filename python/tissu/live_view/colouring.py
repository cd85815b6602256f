"""When bodies are coloured anew, and the limits of the colours then."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np

from tissu.live_view.ration import Ration

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from tissu.live_view.frame import Frame
    from tissu.live_view.session import Session
    from tissu.live_view.surface import Seen

SHARE = 0.01
"""Of a processor, that new colours may take of a simulation that has no time to spare."""
_LONGEST = 5.0
"""The longest that dear colours stay as they are [s]."""

Limits = tuple[float, float]


class Colouring:
    """The colours of a page.

    Bodies move with every frame. Their colours are found anew where the values have changed and
    the time allows; at once where the field or the cells are others, or the limits are fitted.

    Attributes:
        cost: processor time of the colours since the last frame [s].
    """

    def __init__(self, session: Session) -> None:
        """No field is shown."""
        self.cost = 0.0
        self._session = session
        self._ration = Ration(SHARE, longest=_LONGEST)
        self._field = ""
        self._of: dict[tuple[int, str], tuple[Seen, NDArray[np.float64] | None]] = {}

    def are_due(self, frame: Frame) -> bool:
        """Whether this frame is coloured anew."""
        if not frame.field:
            return bool(self._field)
        now = {key: (body.seen, body.values) for key, body in frame.bodies.items()}
        before = self._of
        other = now.keys() != before.keys() or any(now[key][0] is not before[key][0] for key in now)
        if frame.field != self._field or self._session.limits is None or other:
            return True
        self._ration.share = self._session.share(SHARE)
        if not self._ration.is_due(time.monotonic()):
            return False
        return any(now[key][1] is not before[key][1] for key in now)

    @contextmanager
    def anew(self, frame: Frame) -> Iterator[Limits | None]:
        """The limits for this frame; None: nothing is coloured. What it takes is counted."""
        begun, before = time.monotonic(), time.thread_time()
        self._field = frame.field
        self._of = {key: (body.seen, body.values) for key, body in frame.bodies.items()}
        yield self._limits(frame)
        self.cost = time.thread_time() - before
        self._ration.spent(self.cost, begun=begun)

    def _limits(self, frame: Frame) -> Limits | None:
        """Limits of the colours, wide enough for this frame."""
        values = [
            b.values[np.isfinite(b.values)] for b in frame.bodies.values() if b.values is not None
        ]
        every = np.concatenate([np.empty(0), *values])
        if not frame.field or not len(every):
            return None
        low, high = float(every.min()), float(every.max())
        if low >= 0.0 and frame.field != "volume_ratio":
            low = 0.0
        before = self._session.limits
        if before is not None:
            low, high = min(low, before[0]), max(high, before[1])
        self._session.limits = (low, high if high > low else low + max(abs(low), 1e-12))
        return self._session.limits
