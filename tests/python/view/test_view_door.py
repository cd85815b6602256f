"""The door before the page: who is let in, and what passes through."""

import contextlib
import gc
import socket
import socketserver
import threading
import urllib.error
import urllib.request

import pytest

import tissu as ts
from tissu.live_view.door import Door


class Echo(socketserver.BaseRequestHandler):
    """Answers everything with the same."""

    def handle(self):
        with contextlib.suppress(OSError):
            while data := self.request.recv(65536):
                self.request.sendall(data)


@pytest.fixture
def echo():
    """The port of a server of this machine."""
    with socketserver.ThreadingTCPServer(("127.0.0.1", 0), Echo) as server:
        server.daemon_threads = True
        thread = threading.Thread(target=server.serve_forever, args=(0.02,))
        thread.start()
        yield server.server_address[1]
        server.shutdown()
        thread.join()


@pytest.fixture
def opened(echo):
    """Makes doors, and closes them."""
    doors = []

    def make(**options):
        doors.append(
            Door(**{"host": "127.0.0.1", "port": 0, "behind": echo, "token": "", **options})
        )
        return doors[-1]

    yield make
    for door in doors:
        door.close()


def asked(door, *fields, line="GET / HTTP/1.1", host=None):
    """The first bytes that come back for a request."""
    head = [line, f"Host: {host or f'127.0.0.1:{door.port}'}", *fields, "", ""]
    with socket.create_connection(("127.0.0.1", door.port), timeout=10.0) as way:
        way.sendall("\r\n".join(head).encode())
        return way.recv(65536).decode()


def received(way, count):
    """So many bytes of a connection, or as many as come."""
    found = b""
    while len(found) < count and (data := way.recv(65536)):
        found += data
    return found


def test_what_may_pass_is_handed_through_and_back(opened):
    door = opened(word="a word")
    head = f"GET / HTTP/1.1\r\nHost: localhost:{door.port}\r\n\r\n"
    with socket.create_connection(("127.0.0.1", door.port), timeout=10.0) as way:
        way.sendall(head.encode())
        word = b"X-Tissu-Door: a word\r\n"
        first = received(way, len(head) + len(word))  # the echo begins with the head
        assert first == head.encode().replace(b"Host:", word + b"Host:")
        long = b"x" * 1_000_000 + b"\n"
        threading.Thread(target=way.sendall, args=(long,)).start()
        assert received(way, len(long)) == long


@pytest.mark.parametrize(
    ("host", "fields", "why"),
    [
        ("evil.example", (), "this machine is accepted"),  # a name that was bound to 127.0.0.1
        (None, ("Origin: http://evil.example",), "a page of another site"),
        (None, ("Origin: http://127.0.0.1:1",), "a page of another site"),
        (None, ("Origin: null",), "a page of another site"),
    ],
)
def test_other_sites_in_the_same_browser_are_refused(opened, host, fields, why):
    text = asked(opened(), "Upgrade: websocket", *fields, host=host)
    assert text.startswith("HTTP/1.1 403") and why in text


def test_our_own_page_may_open_its_websocket(opened):
    door = opened()
    ours = f"Origin: http://127.0.0.1:{door.port}"
    assert asked(door, "Upgrade: websocket", ours).startswith("GET /")


def test_without_the_token_nothing_is_shown_and_with_it_a_cookie_is_given(opened):
    door = opened(token="s3cret")
    assert asked(door).startswith("HTTP/1.1 403")
    assert asked(door, line="GET /?token=s3cre HTTP/1.1").startswith("HTTP/1.1 403")
    assert asked(door, "Cookie: tissu=wrong").startswith("HTTP/1.1 403")
    assert asked(door, "Upgrade: websocket", "Cookie: other=1").startswith("HTTP/1.1 403")
    given = asked(door, line="GET /?token=s3cret HTTP/1.1")
    assert given.startswith("HTTP/1.1 303") and "Set-Cookie: tissu=s3cret; HttpOnly" in given
    assert asked(door, "Cookie: a=b; tissu=s3cret").startswith("GET /")
    assert door.url == f"http://127.0.0.1:{door.port}/?token=s3cret"


@pytest.mark.parametrize("line", ["GET /", "", "\x00\xff", "GET / HTTP/1.1 more words"])
def test_what_is_no_request_is_answered_so(opened, line):
    assert asked(opened(), line=line).startswith("HTTP/1.1 400")


def test_a_port_that_is_taken_is_refused_with_a_sentence(opened, echo):
    with pytest.raises(ts.ParameterError, match=f"port {echo} of '127.0.0.1'.*is accepted"):
        Door(host="127.0.0.1", port=echo, behind=echo, token="")
    with pytest.raises(ts.ParameterError, match="accepted"):
        Door(host="192.0.2.1", port=0, behind=echo, token="")


def test_two_doors_take_ports_one_after_the_other(opened):
    one, other = opened(port=None), opened(port=None)
    assert 8080 <= one.port < other.port < 8100


def test_there_is_no_way_beside_the_door():
    """viser's own port refuses a page, and a websocket of its own protocol."""
    import viser

    cube = ts.BarMesh(size=(0.1, 0.1, 0.1), cells=(2, 2, 2), cell="tetra")
    body = ts.Body(mesh=cube, law=ts.StVK(young=1e3, poisson=0.3), density=1000)
    scene = ts.Scene(bodies={"cube": body}, step=ts.ImplicitEuler("10 ms"))
    with ts.view(scene.compile(), browser=False, playing=False) as view:
        inner = view._page.port
        with pytest.raises(urllib.error.HTTPError, match="403"):
            urllib.request.urlopen(f"http://127.0.0.1:{inner}/", timeout=10.0)
        fields = [
            f"Host: 127.0.0.1:{inner}",
            "Upgrade: websocket",
            "Connection: Upgrade",
            "Sec-WebSocket-Version: 13",
            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
            f"Sec-WebSocket-Protocol: viser-v{viser.__version__}",
        ]
        for port, status in ((inner, b"403"), (view._door.port, b"101")):
            with socket.create_connection(("127.0.0.1", port), timeout=10.0) as way:
                given = [f"Host: 127.0.0.1:{port}", *fields[1:]]
                way.sendall("\r\n".join(["GET / HTTP/1.1", *given, "", ""]).encode())
                assert way.recv(65536).split()[1] == status


def test_an_open_view_answers_and_a_closed_one_does_not():
    cube = ts.BarMesh(size=(0.1, 0.1, 0.1), cells=(2, 2, 2), cell="tetra")
    body = ts.Body(mesh=cube, law=ts.StVK(young=1e3, poisson=0.3), density=1000)
    scene = ts.Scene(bodies={"cube": body}, step=ts.ImplicitEuler("10 ms"))
    with (
        ts.view(scene.compile(), browser=False, playing=False) as view,
        urllib.request.urlopen(view.url, timeout=10.0) as page,
    ):
        assert page.status == 200 and b"<html" in page.read()[:500]
    with pytest.raises(urllib.error.URLError):
        urllib.request.urlopen(view.url, timeout=1.0)


@pytest.mark.parametrize("token", ["open sesame", "a;b", "é", "x" * 200])
def test_a_token_that_a_cookie_cannot_carry_is_refused(echo, token):
    with pytest.raises(ts.ParameterError, match="letters, digits, - and _"):
        Door(host="127.0.0.1", port=0, behind=echo, token=token)


def test_another_address_asks_for_a_token():
    cube = ts.BarMesh(size=(0.1, 0.1, 0.1), cells=(2, 2, 2), cell="tetra")
    body = ts.Body(mesh=cube, law=ts.StVK(young=1e3, poisson=0.3), density=1000)
    scene = ts.Scene(bodies={"cube": body}, step=ts.ImplicitEuler("10 ms"))
    with ts.view(scene.compile(), browser=False, playing=False, host="0.0.0.0") as view:
        address, token = view.url.split("?token=")
        assert len(token) >= 20
        with pytest.raises(urllib.error.HTTPError, match="403"):
            urllib.request.urlopen(address, timeout=10.0)


def test_a_door_shuts_while_connections_come_in(echo):
    """No task of a connection is left behind, be it just accepted, asked, or handed on."""
    head = b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n"
    gc.freeze()  # collections look at what is made here, and not at all that tests before have left
    for number in range(100):
        door = Door(host="127.0.0.1", port=0, behind=echo, token="")
        told = []
        door._loop.set_exception_handler(lambda _, context, told=told: told.append(context))
        ways = []
        for rest in (b"", head[:20], head, head):
            ways.append(socket.create_connection(("127.0.0.1", door.port), timeout=10.0))
            ways[-1].sendall(rest)
            if rest and number % 2:
                with contextlib.suppress(OSError):
                    ways[-1].settimeout(0.001)
                    ways[-1].recv(1)
        door.close()
        for way in ways:
            way.close()
        gc.collect()  # a task that waits for ever is complained of when it is collected
        assert told == [], told
    gc.unfreeze()
