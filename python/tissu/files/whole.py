"""A file that gets its name when it is complete: the one before, or the new one, or none."""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

from tissu.errors import TissuError
from tissu.files.place import reason_of, require_file_place


@contextlib.contextmanager
def whole_file(path: Path, *, error: Callable[[str], TissuError] = TissuError) -> Iterator[Path]:
    """A place to write to; what is written there gets its own name when it is complete.

    The place has the file's own name in a folder of its own, which only this user may enter:
    nothing that lies beside the file is opened. Files that a format writes beside it move with it.

    Raises:
        TissuError: the place is neither new nor a regular file, or it cannot be written, as on a
            full disk.
    """
    require_file_place(path, error=error)
    work = None
    try:
        work = Path(tempfile.mkdtemp(prefix=f".writing-{os.getpid()}-", dir=path.parent))
        yield work / path.name
        for made in sorted(work.iterdir()):
            os.replace(made, require_file_place(path.parent / made.name, error=error))
    except (OSError, ValueError) as refused:
        raise error(f"{path}: cannot be written ({reason_of(refused)})") from None
    finally:
        if work is not None:
            shutil.rmtree(work, ignore_errors=True)


def clear_unfinished(folder: Path) -> None:
    """Takes away what `whole_file` left in a folder in processes that were killed."""
    with contextlib.suppress(OSError):
        for name in os.listdir(folder):
            match = re.fullmatch(r"\.writing-(\d+)-\w+", name)
            if match is not None and not runs(int(match[1])):
                shutil.rmtree(folder / name, ignore_errors=True)


def runs(process: int) -> bool:
    """Whether a process of this number runs on this machine."""
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (PermissionError, OverflowError):
        return True
    return True
