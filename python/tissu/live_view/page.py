"""The page: a viser server on this machine, drawings and panels, and the thread that feeds it."""

from __future__ import annotations

import contextlib
import io
import threading
import time
from typing import TYPE_CHECKING, Any

import numpy as np

from tissu.live_view.body_drawing import BodyDrawing
from tissu.live_view.cameras import FOV, first_place
from tissu.live_view.colouring import Colouring
from tissu.live_view.colours import BODIES
from tissu.live_view.gizmo import Gizmo, GizmoDrawing
from tissu.live_view.latest import Latest
from tissu.live_view.marks_drawing import MarksDrawing
from tissu.live_view.panels import panels_of
from tissu.live_view.pointer import Pointer
from tissu.live_view.ration import processor_time
from tissu.live_view.server import open_server

if TYPE_CHECKING:
    import viser

    from tissu.live_view.frame import Frame
    from tissu.live_view.session import Session

RATE = 30.0
"""Frames a second that are sent at most."""
_PANELS = 5.0
"""Times a second that the panels are written at most."""


class Page:
    """The page of a session.

    Attributes:
        frames: where the newest frame is left for it.
        sent: how many frames it has shown.
        cost: processor time of the latest one, with its way to the door, without new colours [s].
        senders: numbers of the threads that take part in it, the door's too.
        server: viser's.
    """

    def __init__(self, session: Session, *, title: str, word: str) -> None:
        """Open the server, on a free port of this machine only.

        Args:
            session: what is shown.
            title: of the page.
            word: that the door brings with every request.

        Raises:
            TissuError: viser is not installed.
        """
        self.frames: Latest[Frame] = Latest()
        self.sent = 0
        self.cost = 0.0
        self.senders: set[int] = set()
        self._colouring = Colouring(session)
        self._session = session
        self.server = open_server(title, word)
        session.recorder.of(self.server)
        self._prepare_scene()
        self._panels = panels_of(self.server.gui, session)
        self._bodies: dict[tuple[int, str], BodyDrawing] = {}
        self._gizmos = GizmoDrawing(self.server.scene, session.stage, self._moved)
        self._marks: dict[tuple[int, str], MarksDrawing] = {}
        self._panels_due = 0.0
        self._worked: tuple[frozenset[int], float] = (frozenset(), 0.0)
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._feed, name="tissu page", daemon=True)
        self.server.on_client_connect(self._come)
        self.server.on_client_disconnect(self._leave)

    @property
    def port(self) -> int:
        """Where viser listens, on this machine only."""
        return self.server.get_port()

    @property
    def watched(self) -> bool:
        """Whether a page is open, so that frames are of use."""
        return self._session.rights.count > 0

    def start(self) -> None:
        """Begin to show frames."""
        self._thread.start()

    def halt(self) -> None:
        """Show no more frames; the threads that send may end then, whose time is counted."""
        self._ended.set()
        if self._thread.is_alive():
            self._thread.join()

    def stop(self) -> None:
        """Close the pages."""
        self.halt()
        with contextlib.redirect_stdout(io.StringIO()):
            self.server.stop()

    async def _come(self, client: viser.ClientHandle) -> None:
        self.senders.add(threading.get_ident())  # viser's own, which sends
        self._session.rights.come(client.client_id)

    async def _leave(self, client: viser.ClientHandle) -> None:
        self._session.rights.leave(client.client_id)

    def _prepare_scene(self) -> None:
        scene, stage = self.server.scene, self._session.stage
        self.server.gui.configure_theme(show_logo=False, show_share_button=False)
        self.server.gui.main_panel.dock_right()
        scene.set_up_direction(stage.up)
        camera = self.server.initial_camera
        camera.position, camera.look_at, camera.up = first_place(stage), stage.centre, stage.up
        camera.fov, camera.near, camera.far = FOV, 1e-3 * stage.size, 1e3 * stage.size

    def _feed(self) -> None:
        """Show the newest frame, over and over."""
        self.senders.add(threading.get_ident())
        while not self._ended.is_set():
            begin = time.monotonic()
            frame = self.frames.take(0.25)
            if frame is not None:
                self.show(frame)
                self._session.recorder.pass_time()
                self.sent += 1
                self._count_cost()
            self._ended.wait(max(0.0, begin + 1.0 / RATE - time.monotonic()))

    def _count_cost(self) -> None:
        """What the threads that send have worked since the frame before."""
        senders = frozenset(self.senders)
        before, self._worked = self._worked, (senders, processor_time(senders))
        if before[0] == senders:
            self.cost = max(0.0, self._worked[1] - before[1] - self._colouring.cost)
        self._colouring.cost = 0.0

    def show(self, frame: Frame) -> None:
        """Draw a frame."""
        with self.server.atomic():
            if self._colouring.are_due(frame):
                with self._colouring.anew(frame) as limits:
                    for (lane, name), body in frame.bodies.items():
                        self._drawing(lane, name).colour(body, limits)
            for (lane, name), body in frame.bodies.items():
                drawing = self._drawing(lane, name)
                drawing.show(body, edges=self._session.show_edges)
                drawing.be_touchable(self._session.touch.on_bodies)
            self._gizmos.show(frame.gizmos)
            for key in {*self._marks, *frame.marks}:
                self._marks_of(*key).show(frame.marks.get(key, ()))
        if time.monotonic() >= self._panels_due:
            self._panels_due = time.monotonic() + 1.0 / _PANELS
            for panel in self._panels:
                panel.show(frame)

    def _drawing(self, lane: int, name: str) -> BodyDrawing:
        found = self._bodies.get((lane, name))
        if found is None:
            number = sum(1 for other, _ in self._bodies if other == lane)
            found = BodyDrawing(
                self.server.scene,
                f"{lane}/{name}",
                stage=self._session.stage,
                lane=lane,
                colour=BODIES[number % len(BODIES)],
                felt=lambda event: self._felt(lane, name, event),
            )
            self._bodies[lane, name] = found
        return found

    def _marks_of(self, lane: int, name: str) -> MarksDrawing:
        found = self._marks.get((lane, name))
        if found is None:
            found = MarksDrawing(
                self.server.scene, f"{lane}/{name}", stage=self._session.stage, lane=lane
            )
            self._marks[lane, name] = found
        return found

    def _moved(self, gizmo: Gizmo, client: int | None) -> bool:
        """A hand has put a gizmo somewhere; whether it may."""
        if client is None or not self._session.rights.may(client):
            return False
        self._session.touch.turn(gizmo)
        return True

    def _felt(self, lane: int, name: str, event: Any) -> None:
        """A pointer was pressed on a body, moved or released."""
        if not self._session.rights.may(event.client_id):
            return
        stage, click = self._session.stage, not hasattr(event, "phase")
        eye = np.array(event.ray_origin if click else event.client.camera.position)
        there = eye + np.array(event.ray_direction) if click else event.end_position
        pointer = Pointer(
            lane=lane,
            body=name,
            client=event.client_id,
            eye=stage.in_space(eye, lane),
            there=stage.in_space(there, lane),
            place=stage.in_space(there if click else event.start_position, lane),
        )
        self._session.touch.feel("click" if click else event.phase, pointer)
