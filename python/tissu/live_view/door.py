"""The door to the page: it lets in who may see it, and hands everything else through.

viser listens on this machine only, and the door stands before it on the address and port that were
asked for. It refuses a page of another site that the same browser
shows (its Origin is not ours, or it names this machine otherwise), and, on an address that other
machines reach, a caller without the token.
"""

from __future__ import annotations

import asyncio
import contextlib
import hmac
import re
import secrets
import threading
import weakref
from http.cookies import SimpleCookie
from typing import Any
from urllib.parse import parse_qs, urlsplit

from tissu.errors import ParameterError
from tissu.live_view.server import FIELD

FIRST_PORT, PORTS = 8080, 20
"""Where a port is looked for when none is asked for."""
_HEAD = 65536
"""Longest head of a request [bytes]."""
_TURNS = 4
"""turns of the loop in which a connection that was just accepted has come to its task"""
_PATIENCE = 10.0
"""How long a head may take [s]."""
_HERE = ("127.0.0.1", "localhost", "::1")
_COOKIE = "tissu"
_TOKEN = re.compile("[A-Za-z0-9_-]{1,128}")


def new_token() -> str:
    """A token that cannot be guessed."""
    return secrets.token_urlsafe(18)


class Door:
    """Listens on an address, and hands what may pass to a port of this machine.

    Attributes:
        host: the address.
        port: the port.
        token: that must be brought; empty: none.
    """

    def __init__(
        self, *, host: str, port: int | None, behind: int, token: str, word: str = ""
    ) -> None:
        """Open it.

        Args:
            host: address to listen on.
            port: to listen on; None: the first that is free of 20, from 8080 on.
            behind: port of this machine to which it leads.
            token: that must be brought; empty: none.
            word: that it brings itself to what is behind.

        Raises:
            ParameterError: the port is taken, the address does not exist, or a token that no cookie
                carries.
        """
        if token and not _TOKEN.fullmatch(token):
            raise ParameterError(
                f"found the token {token[:30]!r}; up to 128 letters, digits, - and _ are accepted"
            )
        self.host, self.token, self._behind, self._word = host, token, behind, word
        self._meetings: set[asyncio.Task[Any]] = set()
        self._ways: weakref.WeakSet[asyncio.WriteTransport] = weakref.WeakSet()
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(
            target=self._loop.run_forever, name="tissu door", daemon=True
        )
        self._thread.start()
        ports = [port] if port is not None else list(range(FIRST_PORT, FIRST_PORT + PORTS))
        try:
            self._server = asyncio.run_coroutine_threadsafe(self._open(ports), self._loop).result()
        except BaseException:
            self._end_loop()
            raise
        self.port = int(self._server.sockets[0].getsockname()[1])

    @property
    def thread(self) -> int:
        """Number of the thread that hands everything on."""
        return self._thread.ident or 0

    @property
    def url(self) -> str:
        """The address of the page, token included."""
        host = f"[{self.host}]" if ":" in self.host else self.host
        if self.host in ("0.0.0.0", "::"):
            host = "localhost"
        return f"http://{host}:{self.port}/" + (f"?token={self.token}" if self.token else "")

    def close(self) -> None:
        """Shut it; what is inside is cut off."""
        asyncio.run_coroutine_threadsafe(self._shut(), self._loop).result()
        self._end_loop()

    def _end_loop(self) -> None:
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()

    async def _open(self, ports: list[int]) -> asyncio.Server:
        for port in ports:
            try:
                return await asyncio.start_server(self._meet, self.host, port, limit=_HEAD)
            except OSError as error:
                why = error
        some = f"port {ports[0]}" if len(ports) == 1 else f"a port from {ports[0]} to {ports[-1]}"
        raise ParameterError(
            f"found no way to listen on {some} of {self.host!r} ({why.strerror or why}); a free "
            "port of an address of this machine is accepted"
        )

    async def _shut(self) -> None:
        # No more are accepted. The server closes once those that were have come to their tasks: a
        # connection that is on its way while it closes stays open for ever (Python 3.11).
        for listening in self._server.sockets:
            self._loop.remove_reader(listening.fileno())
        quiet = 0
        while quiet < _TURNS:
            others = asyncio.all_tasks() - {asyncio.current_task()}
            # Again and again: before Python 3.12, wait_for may swallow a cancellation.
            for task in self._meetings:
                task.cancel()
            if others:
                await asyncio.wait(others, timeout=0.01)
            for way in list(self._ways):
                way.abort()
            await asyncio.sleep(0)
            quiet = 0 if others else quiet + 1
        self._server.close()

    async def _meet(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """One connection, which carries one request or one websocket."""
        self._ways.add(writer.transport)
        task = asyncio.current_task()
        assert task is not None
        self._meetings.add(task)
        try:
            with contextlib.suppress(OSError, asyncio.CancelledError, asyncio.IncompleteReadError):
                await self._serve(reader, writer)
        finally:
            self._meetings.discard(task)
            writer.close()

    async def _serve(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        try:
            head = await asyncio.wait_for(reader.readuntil(b"\r\n\r\n"), _PATIENCE)
        except (asyncio.LimitOverrunError, asyncio.TimeoutError):
            return
        answer = self.judge(head)
        if answer is not None:
            writer.write(answer)
            return await writer.drain()
        inner, out = await asyncio.open_connection("127.0.0.1", self._behind)
        self._ways.add(out.transport)
        out.write(self._with_word(head))
        try:
            await asyncio.gather(_hand_on(reader, out), _hand_on(inner, writer))
        finally:
            out.close()

    def _with_word(self, head: bytes) -> bytes:
        """The head with the word for what is behind, after its first line."""
        first, end, rest = head.partition(b"\r\n")
        return first + end + f"{FIELD}: {self._word}\r\n".encode() + rest

    def judge(self, head: bytes) -> bytes | None:
        """What a request is answered by the door itself; None: it passes."""
        lines = head.decode("latin-1").split("\r\n")
        words = lines[0].split(" ")
        if len(words) != 3:
            return _answer("400 Bad Request", "found no request of HTTP")
        fields = {
            name.strip().lower(): value.strip()
            for name, colon, value in (line.partition(":") for line in lines[1:])
            if colon
        }
        host, origin = fields.get("host", ""), fields.get("origin")
        name = urlsplit(f"//{host}").hostname or ""
        if self.host in _HERE and name not in _HERE:
            return _answer("403 Forbidden", f"found host {name}; this machine is accepted")
        if origin is not None and urlsplit(origin).netloc != host:
            return _answer("403 Forbidden", "found a page of another site; ours is accepted")
        if not self.token:
            return None
        given = parse_qs(urlsplit(words[1]).query).get("token", [""])[0]
        if _same(given, self.token):
            cookie = f"{_COOKIE}={self.token}; HttpOnly; SameSite=Strict; Path=/"
            return _answer("303 See Other", "", "Location: /", f"Set-Cookie: {cookie}")
        known = SimpleCookie(fields.get("cookie", "")).get(_COOKIE)
        if known is not None and _same(known.value, self.token):
            return None
        return _answer("403 Forbidden", "found no token; the address that tissu printed has it")


def _same(one: str, other: str) -> bool:
    """Whether two tokens are equal, in a time that does not tell how far they are."""
    return hmac.compare_digest(one.encode(), other.encode())


def _answer(status: str, text: str, *fields: str) -> bytes:
    body = text.encode()
    head = [
        f"HTTP/1.1 {status}",
        "Content-Type: text/plain; charset=utf-8",
        f"Content-Length: {len(body)}",
        "Connection: close",
        *fields,
    ]
    return "\r\n".join([*head, "", ""]).encode() + body


async def _hand_on(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    """Hand on bytes as they come, no faster than they are taken."""
    while data := await reader.read(_HEAD):
        writer.write(data)
        await writer.drain()
    if writer.can_write_eof():
        writer.write_eof()
