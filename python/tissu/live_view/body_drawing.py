"""A body on the page: its surface, its edges and lines, and the bands of a field."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tissu.live_view.bands import Band, bands
from tissu.live_view.colours import COUNT, EDGE, OPENED, band_colours

if TYPE_CHECKING:
    import viser

    from tissu.live_view.frame import BodyFrame
    from tissu.live_view.marks import Colour
    from tissu.live_view.stage import Stage
    from tissu.live_view.surface import Seen

Points = NDArray[np.float32]

_OUT = 5e-4
"""How far edges stand before the surface, as a share of the stage."""
_OUT_EVERY = 0.25
"""Wall time after which the side on which they stand is found again [s]."""


class BodyDrawing:
    """One body.

    Attributes:
        surface: its mesh on the page, which the pointer meets; None: it has no face.
    """

    def __init__(
        self,
        scene: viser.SceneApi,
        name: str,
        *,
        stage: Stage,
        lane: int,
        colour: Colour,
        felt: Callable[[Any], None],
    ) -> None:
        """Take a name for it on the page; nothing is drawn yet.

        Args:
            scene: of the page.
            name: of the body there.
            stage: where it stands.
            lane: of its simulation.
            colour: of its surface.
            felt: called with viser's events when a pointer is pressed on it.
        """
        self.surface: viser.MeshHandle | None = None
        self._scene, self._name = scene, name
        self._stage, self._lane, self._colour = stage, lane, colour
        self._felt, self._touchable = felt, False
        self._seen: Seen | None = None
        self._opened: viser.MeshHandle | None = None
        self._edges: viser.MeshHandle | None = None
        self._edge_faces = np.empty((0, 3), dtype=np.uint32)
        self._edges_shown = False
        self._out = np.empty((0, 3), dtype=np.float32)
        self._out_due = 0.0
        self._bands: list[Band] = []
        self._bands_new = False
        self._painted: dict[int, viser.MeshHandle] = {}

    def colour(self, body: BodyFrame, limits: tuple[float, float] | None) -> None:
        """Find the colours of the field that the body has now; `show` draws them.

        Args:
            body: the body.
            limits: of the colours; None: the body has its own colour.
        """
        self._bands, self._bands_new = [], True
        if limits is not None and body.values is not None and len(body.seen.triangles):
            self._bands = bands(body.seen.triangles, body.values, limits=limits, count=COUNT)

    def show(self, body: BodyFrame, *, edges: bool) -> None:
        """Draw the body where it is now.

        Args:
            body: the body.
            edges: whether edges are drawn.
        """
        at = self._stage.on_page(body.positions, self._lane)
        self._show_surface(at, body.seen)
        self._show_edges(at, body.seen, shown=edges)
        self._show_opened(at, body.seen)
        if self.surface is not None:
            # The surface stays for the pointer where its bands are painted in its place.
            self.surface.opacity = 0.0 if self._bands else None
        self._show_bands(at)
        self._seen = body.seen

    def be_touchable(self, wanted: bool) -> None:
        """Whether a press on it is felt; else it turns the view, as one beside it does."""
        if self.surface is None or wanted == self._touchable:
            return
        self._touchable = wanted
        if not wanted:
            self.surface.remove_drag_callback()
            self.surface.remove_click_callback()
            return

        async def felt(event: Any) -> None:  # in order only where it is a coroutine
            self._felt(event)

        self.surface.on_drag("left")(felt)
        self.surface.on_click(felt)

    def _show_surface(self, at: Points, seen: Seen) -> None:
        faces = seen.triangles if seen.cut is None else seen.triangles[~seen.cut]
        if not len(faces):
            return
        if self.surface is None:
            self.surface = self._scene.add_mesh_simple(
                f"/bodies/{self._name}", at, faces, color=self._colour, side="double"
            )
            return
        self.surface.vertices = at
        if seen is not self._seen:
            self.surface.faces = faces.astype(np.uint32)

    def _show_opened(self, at: Points, seen: Seen) -> None:
        """Faces that cuts opened, in a colour of their own where no field is painted."""
        cut = np.zeros(len(seen.triangles), dtype=bool) if seen.cut is None else seen.cut
        opened = seen.triangles[cut].astype(np.uint32)
        if not len(opened) or self._bands:
            if self._opened is not None:
                self._opened.visible = False
            return
        if self._opened is None:
            self._opened = self._scene.add_mesh_simple(
                f"/opened/{self._name}", at, opened, color=OPENED, side="double"
            )
            return
        self._opened.visible = True
        self._opened.vertices = at
        if seen is not self._seen:
            self._opened.faces = opened

    def _show_edges(self, at: Points, seen: Seen, *, shown: bool) -> None:
        """Edges, and lines, which are always drawn, as triangles without area."""
        same = seen is self._seen and shown == self._edges_shown
        if not same:
            ends = np.concatenate([seen.edges, seen.lines]) if shown else seen.lines
            self._edge_faces = ends[:, [0, 1, 1]].astype(np.uint32)
            self._edges_shown = shown
        if not len(self._edge_faces):
            if self._edges is not None:
                self._edges.visible = False
            return
        now = time.monotonic()
        if not same or now >= self._out_due:  # it turns slowly, and is dear
            self._out = np.float32(_OUT * self._stage.size) * normals(at, seen.triangles)
            self._out_due = now + _OUT_EVERY
        out, faces = at + self._out, self._edge_faces
        if self._edges is None:
            self._edges = self._scene.add_mesh_simple(
                f"/edges/{self._name}", out, faces, color=EDGE, wireframe=True, opacity=0.35
            )
            return
        self._edges.visible = True
        self._edges.vertices = out
        if not same:
            self._edges.faces = faces

    def _show_bands(self, at: Points) -> None:
        if self._bands_new:
            for number in set(self._painted) - {band.number for band in self._bands}:
                self._painted[number].visible = False
        for band in self._bands:
            mesh, points = self._painted.get(band.number), band.points(at)
            if mesh is None:
                self._painted[band.number] = self._scene.add_mesh_simple(
                    f"/bands/{self._name}/{band.number}",
                    points,
                    band.triangles,
                    color=band_colours()[band.number],
                    side="double",
                )
                continue
            mesh.visible = True
            mesh.vertices = points
            if self._bands_new:
                mesh.faces = band.triangles
        self._bands_new = False


def normals(at: Points, triangles: NDArray[np.int64]) -> Points:
    """Unit normals (n, 3) at the points of a surface; zero where no triangle is."""
    a, b, c = (at[triangles[:, k]] for k in range(3))
    across = np.cross(b - a, c - a)
    corners = triangles.T.ravel()
    sums = [np.bincount(corners, np.tile(across[:, i], 3), minlength=len(at)) for i in range(3)]
    found = np.stack(sums, axis=1)
    size = np.linalg.norm(found, axis=1, keepdims=True)
    return np.asarray(found / np.maximum(size, 1e-30), dtype=np.float32)
