"""Folders and files that only this user can have written: code is loaded from there alone."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from tissu.errors import LawError

_OTHERS = 0o022  # may write: group, everybody
_OPEN = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC


def private_folder(path: Path) -> Path:
    """Makes a folder that only this user may enter, or checks that it is one.

    A folder of this user that others may read is closed to them.

    Raises:
        LawError: it belongs to another user, others may write in it, or it is a link.
        OSError: it cannot be made or looked at.
    """
    path.mkdir(mode=0o700, parents=True, exist_ok=True)
    found = os.lstat(path)
    if not stat.S_ISDIR(found.st_mode):
        raise _refused(path, "it is a link or a file, which may lead to what others wrote")
    if found.st_uid != os.geteuid():
        raise _refused(path, f"it belongs to the user {found.st_uid}")
    if found.st_mode & _OTHERS:
        raise _refused(path, "other users may write in it; empty it and close it with chmod 700")
    if stat.S_IMODE(found.st_mode) != 0o700:
        os.chmod(path, 0o700)
    return path


def private_bytes(path: Path) -> bytes | None:
    """The bytes of a regular file that this user alone may write; None where it is not one."""
    try:
        descriptor = os.open(path, _OPEN)
    except OSError:
        return None
    with os.fdopen(descriptor, "rb") as file:
        found = os.fstat(descriptor)
        own = found.st_uid == os.geteuid() and not found.st_mode & _OTHERS
        return file.read() if stat.S_ISREG(found.st_mode) and own else None


def _refused(path: Path, why: str) -> LawError:
    return LawError(
        f"compiled laws are not kept in {path}: {why}; name a folder of your own in TISSU_CACHE."
    )
