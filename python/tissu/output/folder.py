"""The folder of results, refused before the run when it cannot be written."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Iterator
from os import PathLike
from pathlib import Path

from tissu.errors import TissuError
from tissu.files import require_folder_place
from tissu.files.place import reason_of
from tissu.output.held import held_folder


def prepare_folder(path: str | PathLike[str]) -> Path:
    """Makes the folder and tries it.

    Raises:
        TissuError: something else lies there, or it cannot be made or written.
    """
    folder = require_folder_place(path, "output folder")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except (OSError, ValueError) as refused:
        raise TissuError(
            f"output folder {folder}: cannot be written ({reason_of(refused)}); "
            "name another folder (--out of a command)"
        ) from None
    return folder


@contextlib.contextmanager
def folder_of_run(path: str | PathLike[str]) -> Iterator[Path]:
    """Makes the folder, and holds it; a run refused before it writes anything leaves none behind.

    Raises:
        TissuError: something else lies there, it cannot be made or written, or another run writes
            there.
    """
    places = (Path(path), *Path(path).parents)
    new = [place for place in places if not os.path.lexists(place)]
    try:
        folder = prepare_folder(path)
        with held_folder(folder):
            yield folder
    except BaseException:
        for place in new:
            with contextlib.suppress(OSError):  # it holds something, or was not made
                place.rmdir()
        raise


def inner_folder(folder: Path, name: str) -> Path:
    """Makes a folder within a folder of results, which must still be there.

    Raises:
        TissuError: the folder of results was taken away, something else lies there, or it cannot
            be made.
    """
    inner = require_folder_place(folder / name, "output folder", within=True)
    try:
        inner.mkdir(exist_ok=True)
    except FileNotFoundError:
        raise TissuError(
            f"output folder {folder}: it was taken away while the scene ran, and what was written "
            "there with it; run the scene again with a folder that stays"
        ) from None
    except OSError as refused:
        raise TissuError(
            f"output folder {inner}: cannot be written ({reason_of(refused)})"
        ) from None
    return inner
