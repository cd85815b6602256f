"""A folder of results that one process holds while it writes there, so that no other mixes with it.

The lock is the system's own, on the folder itself: it goes with the process, however that ends, and
no file is left. Where a file system, or a system, has no such locks, nothing is held.
"""

from __future__ import annotations

import contextlib
import errno
import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

from tissu.errors import TissuError

_TAKEN = (errno.EWOULDBLOCK, errno.EAGAIN)
_held: dict[tuple[int, int], list[int]] = {}
"""Folder (device and number) -> its descriptor, and how often this process holds it."""


@contextlib.contextmanager
def held_folder(folder: Path) -> Iterator[None]:
    """Holds the folder inside.

    Raises:
        TissuError: another process holds it.
    """
    release = hold(folder)
    try:
        yield
    finally:
        release()


def hold(folder: Path) -> Callable[[], None]:
    """Holds the folder until what it returns is called; a process may hold it several times.

    Raises:
        TissuError: another process holds it.
    """
    try:
        descriptor = os.open(folder, os.O_RDONLY)
    except OSError:
        return _nothing
    found = os.fstat(descriptor)
    key = (found.st_dev, found.st_ino)
    if key in _held:
        os.close(descriptor)
        _held[key][1] += 1
    elif _locked(descriptor, folder):
        _held[key] = [descriptor, 1]
    else:
        return _nothing
    process = os.getpid()
    return lambda: _release(key, process)


def _locked(descriptor: int, folder: Path) -> bool:
    """Whether the folder is locked now; else its descriptor is closed.

    Raises:
        TissuError: another process holds it.
    """
    if sys.platform == "win32":
        os.close(descriptor)
        return False
    import fcntl

    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        os.close(descriptor)
        if error.errno in _TAKEN:
            raise TissuError(
                f"output folder {folder}: found another run of tissu that writes there, one at a "
                "time is accepted; wait for its end, or name another folder (--out of a command)"
            ) from None
        return False
    return True


def _release(key: tuple[int, int], process: int) -> None:
    if os.getpid() != process or key not in _held:  # a copy of the process holds nothing
        return
    _held[key][1] -= 1
    if not _held[key][1]:
        descriptor, _ = _held.pop(key)
        with contextlib.suppress(OSError):
            import fcntl

            fcntl.flock(descriptor, fcntl.LOCK_UN)  # also what a copy of the process has of it
        os.close(descriptor)


def _nothing() -> None:
    """What releases a folder that is not held."""
