"""Which places may be written to: new ones, regular files, and folders for what goes in folders.

A device, a pipe, a socket, a folder in the place of a file, and a link to nothing are refused
before anything is opened: to replace /dev/null by a file breaks the machine, and to open a pipe
waits for a reader that may never come.
"""

from __future__ import annotations

import os
import reprlib
import stat
from collections.abc import Callable
from pathlib import Path

from tissu.errors import TissuError

_LONGEST = 500  # characters of a path in a message
_KINDS = {
    stat.S_IFDIR: "a folder",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
    stat.S_IFLNK: "a link to nothing",
}


def kind_of_place(path: str | os.PathLike[str]) -> str:
    """What lies at a path, links followed, in words: nothing, a file, a folder, a device.

    Raises:
        OSError: it cannot be looked at: a folder above it is closed, or the name is too long.
        ValueError: no file system takes the name: it holds a NUL or half a character.
    """
    try:
        mode = os.stat(path).st_mode
    except FileNotFoundError:
        return "a link to nothing" if os.path.islink(path) else "nothing"
    return "a file" if stat.S_ISREG(mode) else _KINDS.get(stat.S_IFMT(mode), "a special file")


def shown_path(path: str | os.PathLike[str]) -> str:
    """A path in a message: cut when it is long, and without what no terminal can show."""
    text = os.fsdecode(os.fspath(path)).encode("utf-8", "backslashreplace").decode()
    text = text.replace("\0", "\\0")
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}..."


def path_of(
    value: object, accepted: str, *, error: Callable[[str], TissuError] = TissuError
) -> Path:
    """What was given as a path, as one.

    Args:
        value: a text or a path.
        accepted: what it should be, for the message: "the path of a mesh file".
        error: what makes the error of its sentence.

    Raises:
        TissuError: it is neither a text nor a path.
    """
    try:
        return Path(value)  # type: ignore[arg-type]
    except TypeError:
        raise error(f"found {reprlib.repr(value)}; {accepted} is accepted") from None


def reason_of(error: Exception) -> str:
    """Why the system refused, in a few words."""
    return str(getattr(error, "strerror", None) or error)


def require_file_place(
    path: str | os.PathLike[str], what: str = "", *, error: Callable[[str], TissuError] = TissuError
) -> Path:
    """The path, when a file may be written there: the place is new, or a regular file.

    Args:
        path: the place.
        what: what is to be written there, for the message: "checkpoint".
        error: what makes the error of its sentence.

    Raises:
        TissuError: it is neither new nor a regular file, or it cannot be looked at.
    """
    named = f"{what} {shown_path(path)}".strip()
    try:
        kind = kind_of_place(path)
    except (OSError, ValueError) as refused:
        raise error(
            f"{named}: cannot be written ({reason_of(refused)}); name another place"
        ) from None
    if kind not in ("nothing", "a file"):
        raise error(
            f"{named}: cannot be written: found {kind}; a new place or a regular file is accepted"
        )
    return Path(path)


def require_folder_place(path: str | os.PathLike[str], what: str, *, within: bool = False) -> Path:
    """The path, when a folder may be made there or is there already.

    Args:
        path: the place; a link that was named by the user leads to its folder.
        what: what the folder is for, for the message.
        within: tissu made the name itself, inside a folder of results: a link there leads to a
            folder that was not named, and is refused.

    Raises:
        TissuError: something else lies there, or it cannot be looked at.
    """
    try:
        kind = kind_of_place(path)
        if within and os.path.islink(path):
            kind = "a link"
    except (OSError, ValueError) as refused:
        raise TissuError(
            f"{what} {shown_path(path)}: cannot be written ({reason_of(refused)}); "
            "name another folder (--out of a command)"
        ) from None
    if kind not in ("nothing", "a folder"):
        article = "it is a file" if kind == "a file" else f"found {kind}"
        raise TissuError(
            f"{what} {shown_path(path)}: {article}, a folder is accepted; "
            "name another folder (--out of a command)"
        )
    return Path(path)
