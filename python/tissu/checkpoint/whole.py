"""A file that is whole at every moment: the one before, or the new one; never a part of either."""

from __future__ import annotations

import contextlib
import os
import re
from pathlib import Path

from tissu.errors import CheckpointError
from tissu.files import require_file_place
from tissu.files.whole import runs

# A file that this process makes: what lies at its name already, a link above all, is not opened.
_NEW = os.O_WRONLY | os.O_CREAT | os.O_EXCL


def write_whole(path: Path, data: bytes) -> None:
    """Puts `data` in the place of a file, in one move that outlives a crash of the machine.

    Written beside its place and flushed to the disk, then renamed; the folder is flushed after it.
    What processes that were killed have left beside it is taken away first.

    Raises:
        CheckpointError: the place is neither new nor a regular file, or it cannot be written; a
            file that was there before still is.
    """
    require_file_place(path, "checkpoint", error=CheckpointError)
    place = Path(os.path.realpath(path))
    partial = _partial(place, os.getpid())
    try:
        _clear(place)
        partial.unlink(missing_ok=True)
        try:
            with os.fdopen(os.open(partial, _NEW, 0o666), "wb") as file:
                file.write(data)
                file.flush()
                os.fsync(file.fileno())
            os.replace(partial, place)
        finally:
            partial.unlink(missing_ok=True)
        _flush_folder(place.parent)
    except OSError as error:
        raise _unwritable(path, error) from None


def prepare_place(path: Path) -> None:
    """Makes the folder of a checkpoint and tries it, before a run rather than in its midst.

    Raises:
        CheckpointError: it is neither new nor a regular file, or nothing can be written there.
    """
    require_file_place(path, "checkpoint", error=CheckpointError)
    place = Path(os.path.realpath(path))
    probe = place.with_name(f".{place.name}.{os.getpid()}.probe")
    try:
        place.parent.mkdir(parents=True, exist_ok=True)
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise _unwritable(path, error) from None


def _partial(place: Path, process: int) -> Path:
    return place.with_name(f".{place.name}.{process}.partial")


def _clear(place: Path) -> None:
    """Removes what earlier writers of this file left that run no more."""
    pattern = re.compile(re.escape(f".{place.name}.") + r"(\d+)\.partial")
    for name in os.listdir(place.parent):
        match = pattern.fullmatch(name)
        if match is not None and not runs(int(match[1])):
            (place.parent / name).unlink(missing_ok=True)


def _flush_folder(folder: Path) -> None:
    """So that the new name of the file is on the disk too; not every file system can."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        with contextlib.suppress(OSError):
            os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _unwritable(path: Path, error: OSError) -> CheckpointError:
    why = error.strerror or str(error)
    return CheckpointError(
        f"checkpoint {path}: cannot be written ({why}); name a file in a folder that can be written"
    )
