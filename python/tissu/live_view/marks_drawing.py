"""The marks of a layer or a tool on the page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import viser

    from tissu.live_view.marks import Marks
    from tissu.live_view.stage import Stage


Drawn = Any
"""Of viser: a point cloud, arrows, line segments or a mesh."""
Kind = Literal["points", "arrows", "lines", "surface"]
KINDS: tuple[Kind, ...] = ("points", "arrows", "lines", "surface")


class MarksDrawing:
    """Draws the marks of one simulation and removes those that it no longer has."""

    def __init__(self, scene: viser.SceneApi, name: str, *, stage: Stage, lane: int) -> None:
        """Take a name for them on the page; nothing is drawn yet."""
        self._scene, self._name, self._stage, self._lane = scene, name, stage, lane
        self._drawn: dict[tuple[Kind, int], Drawn] = {}
        self._places: dict[tuple[Kind, int], NDArray[np.float64]] = {}
        self._labels: dict[int, viser.LabelHandle] = {}

    def show(self, marks: Sequence[Marks]) -> None:
        """Draw these."""
        wanted = {
            (kind, number): (places, one)
            for number, one in enumerate(marks)
            for kind in KINDS
            if len(places := getattr(one, kind))
        }
        for key in set(self._drawn) - set(wanted):
            self._drawn[key].visible = False
        for key, (places, one) in wanted.items():
            kind, drawn, known = key[0], self._drawn.get(key), self._places.get(key)
            self._places[key] = places
            if drawn is not None:
                drawn.visible = True
            if places is known:  # what stands still is not sent again
                continue
            at = self._stage.on_page(places, self._lane)
            if drawn is None:
                self._drawn[key] = self._add(*key, at, one)
                continue
            if kind == "surface":
                drawn.vertices, drawn.faces = _mesh(at)
            else:
                drawn.points = at
        self._show_labels([label for one in marks for label in one.labels])

    def _add(self, kind: Kind, number: int, at: NDArray[np.float32], marks: Marks) -> Drawn:
        name, size = f"/marks/{self._name}/{kind} {number}", self._stage.size
        colour = marks.colour
        if kind == "points":
            return self._scene.add_point_cloud(
                name,
                at,
                colour,
                point_size=0.006 * size,
                point_shape="circle",
                precision="float32",
            )
        if kind == "arrows":
            return self._scene.add_arrows(
                name,
                at,
                colour,
                shaft_radius=0.002 * size,
                head_radius=0.006 * size,
                head_length=0.02 * size,
            )
        if kind == "surface":
            return self._scene.add_mesh_simple(
                name,
                *_mesh(at),
                color=colour,
                opacity=None if marks.opacity >= 1.0 else marks.opacity,
                flat_shading=True,
                side="double",
            )
        return self._scene.add_line_segments(
            name, at, colour, thickness=3.0, thickness_units="screen"
        )

    def _show_labels(self, labels: Sequence[tuple[NDArray[np.float64], str]]) -> None:
        for number in set(self._labels) - set(range(len(labels))):
            self._labels[number].visible = False
        for number, (place, text) in enumerate(labels):
            at = self._stage.on_page(place, self._lane)
            drawn = self._labels.get(number)
            if drawn is None:
                name = f"/marks/{self._name}/label {number}"
                self._labels[number] = self._scene.add_label(name, text, position=at)
                continue
            drawn.visible, drawn.text, drawn.position = True, text, at


def _mesh(corners: NDArray[np.float32]) -> tuple[NDArray[np.float32], NDArray[np.uint32]]:
    """Points and triangles of a surface by its corners (t, 3, 3)."""
    points = corners.reshape(-1, 3)
    return points, np.arange(len(points), dtype=np.uint32).reshape(-1, 3)
