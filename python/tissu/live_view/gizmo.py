"""A gizmo: three axes and three rings on the page, by which something is moved and turned."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import viser

    from tissu.live_view.stage import Stage

Floats = NDArray[np.float64]

_SIZE = 0.18
"""Of a gizmo, as a share of the stage."""


@dataclass(frozen=True, slots=True, eq=False)
class Gizmo:
    """A gizmo that a tool offers.

    Attributes:
        name: of what it moves.
        lane: number of the simulation beside whose body it stands.
        place: (3,) where it stands now [m].
        wxyz: (4,) how it is turned now, a unit quaternion.
    """

    name: str
    lane: int
    place: Floats
    wxyz: Floats


class GizmoDrawing:
    """Gizmos on the page."""

    def __init__(
        self,
        scene: viser.SceneApi,
        stage: Stage,
        moved: Callable[[Gizmo, int | None], object],
    ) -> None:
        """Draw nothing yet.

        Args:
            scene: of the page.
            stage: where things stand.
            moved: called with where a page's hand has put a gizmo, and the number of the page;
                gives whether it may.
        """
        self._scene, self._stage, self._moved = scene, stage, moved
        self._drawn: dict[tuple[int, str], viser.TransformControlsHandle] = {}
        self._held: set[tuple[int, str]] = set()

    def show(self, gizmos: list[Gizmo]) -> None:
        """Draw these; one that a hand holds stays with the hand."""
        for key in set(self._drawn) - {(one.lane, one.name) for one in gizmos}:
            self._drawn[key].visible = False
        for one in gizmos:
            key, at = (one.lane, one.name), self._stage.on_page(one.place, one.lane)
            drawn = self._drawn.get(key)
            if drawn is None:
                drawn = self._drawn[key] = self._add(one, at)
            drawn.visible = True
            if key not in self._held:
                drawn.position, drawn.wxyz = at, one.wxyz

    def _add(self, gizmo: Gizmo, at: NDArray[np.float32]) -> viser.TransformControlsHandle:
        control = self._scene.add_transform_controls(
            f"/gizmos/{gizmo.lane}/{gizmo.name}",
            scale=_SIZE * self._stage.size,
            position=at,
            wxyz=gizmo.wxyz,
            depth_test=False,
        )

        async def felt(event: Any) -> None:  # in order only where it is a coroutine
            key = (gizmo.lane, gizmo.name)
            place = self._stage.in_space(control.position, gizmo.lane)
            now = Gizmo(gizmo.name, gizmo.lane, place, np.array(control.wxyz, dtype=float))
            if event.phase == "end" or not self._moved(now, event.client_id):
                self._held.discard(key)
            else:
                self._held.add(key)

        control.on_update(felt)
        return control
