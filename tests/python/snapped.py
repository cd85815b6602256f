"""Bodies whose nodes a cut moves, for the tests of such cuts."""

from __future__ import annotations

from typing import Any

import tissu as ts
from divided import scene

BESIDE = ts.Plane(point=(0.213, 0.05, 0.05), normal=(1.0, 0.1, -0.05))
"""It lies 13 mm from a layer of nodes of bars with cells of 5 cm."""


def snapping(body: ts.Body | None = None, **changes: Any) -> ts.Scene:
    editing = ts.Editing(method="snap", room="900 %")
    return scene(body, **{"editing": editing} | changes)


def free(body: ts.Body | None = None, **changes: Any) -> ts.Simulation:
    return snapping(body, **{"fixed": [], "gravity": None} | changes).compile()
