"""The folder of results, refused before the run when not writable, and files that are whole."""

from __future__ import annotations

import contextlib
import os
import re
import tempfile
from collections.abc import Iterator
from os import PathLike
from pathlib import Path

from tissu.errors import TissuError


def prepare_folder(path: str | PathLike[str]) -> Path:
    """Makes the folder and tries it.

    Raises:
        TissuError: it cannot be made or written.
    """
    folder = Path(path)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except FileExistsError:
        raise TissuError(
            f"output folder {folder}: it is a file, a folder is accepted; name another with --out"
        ) from None
    except OSError as error:
        why = error.strerror or str(error)
        raise TissuError(
            f"output folder {folder}: cannot be written ({why}); name another with --out"
        ) from None
    return folder


@contextlib.contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A temporary name to write to; the file gets its own name when complete, or is never there.

    Raises:
        TissuError: it cannot be written, a full disk for one.
    """
    partial = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        yield partial
        partial.replace(path)
    except OSError as error:
        raise TissuError(f"{path}: cannot be written ({error.strerror or error})") from None
    finally:
        with contextlib.suppress(OSError):
            partial.unlink(missing_ok=True)


def file_name(name: str) -> str:
    """A name of a scene or body as part of a file name."""
    return re.sub(r"[^\w.-]+", "_", name).strip("._") or "scene"
