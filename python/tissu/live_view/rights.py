"""Which page may touch: the first one that is open, or every one where that was asked for."""

from __future__ import annotations


class Rights:
    """The pages that are open, in the order in which they came."""

    def __init__(self, *, shared: bool) -> None:
        """No page is open; `shared`: all may touch."""
        self._shared = shared
        self._open: list[int] = []

    @property
    def count(self) -> int:
        """Number of open pages."""
        return len(self._open)

    def come(self, client: int) -> None:
        """A page was opened."""
        if client not in self._open:
            self._open.append(client)

    def leave(self, client: int) -> None:
        """A page was closed; the next one may touch then."""
        if client in self._open:
            self._open.remove(client)

    def may(self, client: int | None) -> bool:
        """Whether a page may touch; what is not a page, a program, may."""
        return client is None or self._shared or self._open[:1] == [client]
