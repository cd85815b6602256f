"""A recording of what the page shows: one HTML file that plays without a server."""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import TYPE_CHECKING

from tissu.errors import ParameterError, TissuError
from tissu.files import require_file_place, whole_file

if TYPE_CHECKING:
    import viser
    from viser.infra import StateSerializer


def recording_place(path: Path) -> Path:
    """The path, where a recording can be written there.

    Raises:
        ParameterError: it is neither an .html nor a .glb file.
        TissuError: something else is there, or there is no folder that may be written to.
    """
    if path.suffix not in (".html", ".glb"):
        raise ParameterError(
            f"found the recording {path}; a file that ends with .html or .glb is accepted"
        )
    require_file_place(path, "recording")
    if not os.path.isdir(path.parent) or not os.access(path.parent, os.W_OK):
        raise TissuError(
            f"recording {path}: cannot be written: found no folder {path.parent} that may be "
            "written to; name another place"
        )
    return path


class Recorder:
    """Records the messages sent to the page, each with its time.

    A recording stays in memory until it ends.
    """

    def __init__(self) -> None:
        """Nothing is recorded."""
        self._server: viser.ViserServer | None = None
        self._kept: StateSerializer | None = None
        self._before = 0.0

    def of(self, server: viser.ViserServer) -> None:
        """Take the server of the page."""
        self._server = server

    @property
    def running(self) -> bool:
        """Whether it records."""
        return self._kept is not None

    def begin(self) -> None:
        """Record from now on."""
        assert self._server is not None  # the page names it before anything is pressed
        if self._kept is None:
            self._before = time.monotonic()
            self._kept = self._server.get_scene_serializer()

    def pass_time(self) -> None:
        """Called for each frame: the next one comes later by the time until then."""
        kept = self._kept
        if kept is not None:
            now = time.monotonic()
            kept.insert_sleep(now - self._before)
            self._before = now

    def html(self) -> str:
        """End it; the page that plays it."""
        kept, self._kept = self._kept, None
        return "" if kept is None else kept.as_html()

    def finish(self, path: Path) -> None:
        """End it, and write the page that plays it.

        Raises:
            TissuError: it cannot be written.
        """
        text = self.html()
        with whole_file(path) as partial:
            partial.write_text(text, encoding="utf-8")
