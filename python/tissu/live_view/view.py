"""A view: simulations that run in a thread of their own, and a page that shows them."""

from __future__ import annotations

import os
import threading
import time
import webbrowser
from collections.abc import Callable
from concurrent.futures import Future
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from tissu.errors import ParameterError
from tissu.live_view.bands import MOST_CUT
from tissu.live_view.door import Door, new_token
from tissu.live_view.film import Film
from tissu.live_view.frame import SHARE, FrameTaker
from tissu.live_view.page import RATE, Page
from tissu.live_view.ration import Ration
from tissu.live_view.recorder import Recorder, recording_place
from tissu.live_view.rights import Rights
from tissu.live_view.runner import Runner
from tissu.live_view.session import Session
from tissu.live_view.stage import stage_of
from tissu.live_view.surface import seen
from tissu.live_view.touch import Touch
from tissu.live_view.undo import Undo
from tissu.live_view.viewed import holding, require_simulations, require_together, trocars_of
from tissu.picture.draw import up_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from tissu.simulation import Simulation

T = TypeVar("T")

_SHARE = 0.025
"""Of a processor, that frames may take of a simulation that has no time to spare."""
_LONGEST = 1.0
"""The longest wait for a frame [s]."""
_HERE = ("127.0.0.1", "localhost", "::1")


class View:
    """A page on which one or two simulations run live.

    They belong to the thread of the view until it is closed. `ask` calls a function with them
    between two steps. Another thread inside one of them delays its next step. Points may be grabbed
    even if the scene has no `grabbing: true`, and supports without a name get one.

    Attributes:
        url: the address of the page.
    """

    def __init__(
        self,
        simulation: Simulation,
        *,
        beside: Simulation | None = None,
        port: int | None = None,
        host: str = "127.0.0.1",
        token: str | None = None,
        browser: bool = True,
        shared: bool = False,
        record: str | os.PathLike[str] | None = None,
        speed: float = 1.0,
        playing: bool = True,
        hand: str = "scene",
        trust_plugins: bool = False,
    ) -> None:
        """Open the page, and begin to run.

        Args:
            simulation: what is shown.
            beside: another one, shown at its right and stepped with it; grabs act on both.
            port: of the page; absent: the first that is free, from 8080 on.
            host: address to listen on; another than this machine asks for a token.
            token: that a page must bring; absent: a new one where `host` asks for it, else none.
            browser: whether the page is opened in a browser.
            shared: whether every page may touch; else the first one that is open.
            record: a file that is written when the view is closed: .html keeps everything that
                is shown and plays in a browser without a server; .glb is glTF of bodies, obstacles,
                instruments and trocars, up to 30 moments of each simulated second.
            speed: simulated seconds for each second of wall time; infinite: as fast as it goes.
            playing: whether it runs at once.
            hand: what holds simulated trocars at first: `scene`, the hand that the scene gives
                them, or `browser`, that of the page.
            trust_plugins: whether the plug-in of a trocar, which is a program, may run.

        Raises:
            ParameterError: the port is taken; the simulations have other time steps; a recording
                that is neither an .html nor a .glb file; what a trocar of the scene refuses.
            TissuError: viser is not installed; the recording has no place; the device of a trocar
                does not answer.
        """
        simulations = [simulation] if beside is None else [simulation, beside]
        require_simulations(simulations)
        require_together(simulations)
        self._record = None if record is None else recording_place(Path(record))
        self._closed = threading.Event()
        if not speed > 0.0:
            raise ParameterError(f"found a speed of {speed:g}; a positive one is accepted")
        for one in simulations:
            one.allow_touch()
        self._trocars = trocars_of(simulations, hand=hand, trust_plugins=trust_plugins)
        try:
            self._open(simulations, speed=speed, playing=playing, shared=shared)
            if hand == "browser":
                self._session.touch.choose("hold trocar")
            self._open_door(host=host, port=port, token=token)
        except BaseException:
            if self._trocars is not None:
                self._trocars.close()
            raise
        self._film: Film | None = None
        if self._record is not None and self._record.suffix == ".glb":
            more = [] if self._trocars is None else [self._trocars.placed]
            self._film = Film(self._session.stage, more=more)
            self._film.look(simulations)
        elif self._record is not None:
            self._session.recorder.begin()
        self._page.start()
        self._runner.start()
        if browser:
            webbrowser.open(self.url)

    def _open(
        self, simulations: list[Simulation], *, speed: float, playing: bool, shared: bool
    ) -> None:
        """What the page shows and how it runs."""
        first, trocars = simulations[0], self._trocars
        self._taker = FrameTaker(trocars)
        self._ration = Ration(_SHARE, shortest=1.0 / RATE, longest=_LONGEST)
        self._runner = Runner(
            simulations,
            speed=speed,
            playing=playing,
            between=self._between,
            step=None if trocars is None else trocars.step,
        )
        undo = Undo(trocars)
        if trocars is not None:
            trocars.before_touch.append(undo.remember)
        rest: list[ArrayLike] = [m.points for m in {**first.meshes, **first.tissue}.values()]
        rest += [] if trocars is None else [trocars.points()]
        self._session = Session(
            runner=self._runner,
            taker=self._taker,
            touch=Touch(
                self._runner,
                more=[] if trocars is None else [holding(simulations, trocars)],
                before=undo.remember,
            ),
            rights=Rights(shared=shared),
            stage=stage_of(rest, up_of(first), lanes=len(simulations)),
            recorder=Recorder(),
            begin_again=self.reset,
            undo=undo,
            trocars=trocars,
            show_edges=all(len(seen(mesh).triangles) <= MOST_CUT for mesh in first.meshes.values()),
        )
        self._runner.after_step.append(self._session.touch.hear)

    def _open_door(self, *, host: str, port: int | None, token: str | None) -> None:
        """The page itself, and the door before it."""
        word = new_token()
        title = self._runner.simulations[0].scene.name
        self._page = Page(self._session, title=title, word=word)
        if token is None:
            token = "" if host in _HERE else new_token()
        try:
            self._door = Door(host=host, port=port, behind=self._page.port, token=token, word=word)
        except BaseException:
            self._page.stop()
            raise
        self.url = self._door.url
        self._page.senders.add(self._door.thread)

    def __repr__(self) -> str:
        """Scene and address."""
        return f"View('{self._runner.simulations[0].scene.name}' at {self.url})"

    def _repr_html_(self) -> str:
        """The page, in a notebook."""
        return f'<iframe src="{self.url}" width="100%" height="600" frameborder="0"></iframe>'

    def __enter__(self) -> View:
        """The view."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close it."""
        self.close()

    def ask(self, wish: Callable[[list[Simulation]], T]) -> Future[T]:
        """Call a function with the simulations between two steps."""
        return self._runner.ask(wish)

    def play(self) -> None:
        """Continue to run."""
        self._runner.play().result()

    def pause(self) -> None:
        """Pause, and return when the simulations stand still."""
        self._runner.pause().result()

    def step(self) -> None:
        """Pause, and take one step."""
        self._runner.step_once().result()

    def undo(self) -> Future[None]:
        """Return to before the latest press of a tool, or the latest touch of a trocar."""
        return self._runner.ask(self._session.go_back)

    def reset(self) -> Future[None]:
        """Return every simulation to its first state, with its present parameters."""

        def begin(simulations: list[Simulation]) -> None:
            for simulation in simulations:
                simulation.reset()
            if self._trocars is not None:
                self._trocars.reset(simulations)
            self._session.undo.forget()
            self._session.touch.forget()
            self._runner.error = ""
            self._runner.restart_clock()
            for look in self._session.after_reset:
                look(simulations)

        return self._runner.ask(begin)

    @property
    def message(self) -> str:
        """The latest error; empty: none."""
        return self._runner.error

    @property
    def pages(self) -> int:
        """Number of open pages."""
        return self._session.rights.count

    @property
    def frames_sent(self) -> int:
        """Number of frames that were sent to the page."""
        return self._page.sent

    def wait(self, seconds: float | None = None) -> None:
        """Wait for the given time, or until Ctrl-C."""
        self._closed.wait(seconds)

    def close(self) -> None:
        """Stop the simulations after their present step, and close the page.

        Raises:
            TissuError: the recording cannot be written.
        """
        if self._closed.is_set():
            return
        self._closed.set()
        self._runner.stop()
        if self._trocars is not None:
            self._trocars.close()
        self._page.halt()
        self._door.close()
        try:
            if self._record is not None:
                self._finish(self._record)
        finally:
            self._page.stop()

    def _finish(self, record: Path) -> None:
        """Write the recording that was asked for, after the last step."""
        if self._film is None:
            self._session.recorder.finish(record)
            return
        simulations = self._runner.simulations
        self._film.look(simulations, last=True)
        self._film.write(record, name=simulations[0].scene.name)

    def _between(self) -> None:
        """After a step, in the simulations' thread: a frame for the page when one is due."""
        if self._film is not None:
            self._film.look(self._runner.simulations)
        now = time.monotonic()
        wanted = self._page.watched or self._session.recorder.running
        if not wanted or not self._ration.is_due(now) or self._page.frames.waiting:
            return
        self._ration.share = self._session.share(_SHARE)
        self._taker.ration.share = self._session.share(SHARE)
        frame = self._taker.take(self._runner, self._session.touch)
        self._ration.spent(self._taker.cost + self._page.cost, begun=now)
        self._page.frames.put(frame)
