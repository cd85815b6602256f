"""Places to look from."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import viser

    from tissu.live_view.stage import Stage

FOV = 0.6
"""Vertical angle of view [rad]."""
PRESETS: dict[str, tuple[float, float, float]] = {
    "the front": (0.0, 0.0, 1.0),
    "the back": (0.0, 0.0, -1.0),
    "the left": (-1.0, 0.0, 0.0),
    "the right": (1.0, 0.0, 0.0),
    "above": (0.0, 1.0, 0.02),
    "below": (0.0, -1.0, 0.02),
}
"""Directions from the scene to the eye: to the right, up, towards the first view, turned to the
nearest axis."""


def far_enough(stage: Stage) -> float:
    """Distance from which all of it is seen [page units]."""
    return float(0.62 * stage.size / np.tan(FOV / 2))


def first_place(stage: Stage) -> NDArray[np.float64]:
    """Where the first view is seen from (3,), as in the pictures of `draw` [page units]."""
    return np.asarray(stage.centre + far_enough(stage) * stage.axes[2])


def _nearest_axis(right: NDArray[np.float64], up: NDArray[np.float64]) -> NDArray[np.float64]:
    """The axis of space nearest to `right` that is level; `right` itself where none is."""
    axes = np.vstack([np.eye(3), -np.eye(3)])
    level = axes[np.abs(axes @ up) < 1e-6]
    chosen = right if len(level) == 0 else level[np.argmax(level @ right)]
    return np.asarray(chosen / np.linalg.norm(chosen))


def look_from(camera: viser.CameraHandle, preset: str, stage: Stage) -> None:
    """Move the camera of one page."""
    right = _nearest_axis(stage.axes[0] - (stage.axes[0] @ stage.up) * stage.up, stage.up)
    towards = np.cross(right, stage.up)
    along = np.array(PRESETS[preset]) @ np.stack([right, stage.up, towards])
    camera.up_direction = stage.up
    camera.position = stage.centre + far_enough(stage) * along / np.linalg.norm(along)
    camera.look_at = stage.centre
