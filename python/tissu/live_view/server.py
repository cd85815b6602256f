"""viser's server, which only the door may ask.

viser asks for nothing: another user or a page of another site that finds its port could touch
the simulation. So every request must bring a word that only the door knows. viser has no place for
such a check; the function of websockets by which it opens its server is given one while it does.
"""

from __future__ import annotations

import contextlib
import io
import threading
from collections.abc import Iterator
from http import HTTPStatus
from typing import TYPE_CHECKING, Any

from tissu.errors import TissuError

if TYPE_CHECKING:
    import viser

FIELD = "X-Tissu-Door"
"""Field of a request's head with the word."""
_OPENING = threading.Lock()


def open_server(title: str, word: str) -> viser.ViserServer:
    """A server on a free port of this machine.

    Args:
        title: of the page.
        word: that every request must bring in `FIELD`.

    Raises:
        TissuError: viser is not installed.
    """
    try:
        import viser
    except ImportError:
        raise TissuError(
            "the view needs viser, which is not installed; python -m pip install 'tissu[view]'"
        ) from None
    # Its greeting names a port that is not ours.
    with _OPENING, contextlib.redirect_stdout(io.StringIO()), _asking_for(word):
        return viser.ViserServer(host="127.0.0.1", port=0, label=title, verbose=False)


@contextlib.contextmanager
def _asking_for(word: str) -> Iterator[None]:
    """Servers of websockets that are opened meanwhile refuse requests without the word."""
    from websockets.asyncio import server

    serve: Any = server.serve

    def guarded(*given: Any, process_request: Any, **more: Any) -> Any:
        def judged(connection: Any, request: Any) -> Any:
            if request.headers.get(FIELD) != word:
                return connection.respond(
                    HTTPStatus.FORBIDDEN, "connect through the address that the view printed\n"
                )
            return process_request(connection, request)

        return serve(*given, process_request=judged, **more)

    server.serve = guarded  # type: ignore[assignment,misc]
    try:
        yield
    finally:
        server.serve = serve  # type: ignore[misc]
