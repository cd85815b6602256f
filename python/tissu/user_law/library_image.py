"""A library whose bytes are checked, as a file that cannot be changed between check and load."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

_KEPT: list[int] = []
"""Descriptors of what was loaded. They stay open: the loader knows a library by its name, and
the name of one that is closed would be given to the next."""


def library_image(name: str, data: bytes) -> str:
    """A path from which the loader reads these very bytes.

    Args:
        name: of the law, for debuggers.
        data: the library.

    Raises:
        OSError: no memory, or no folder, for it.
    """
    if hasattr(os, "memfd_create"):
        descriptor = os.memfd_create(name, os.MFD_CLOEXEC)
        _KEPT.append(descriptor)
        with os.fdopen(os.dup(descriptor), "wb") as file:
            file.write(data)
        return f"/proc/self/fd/{descriptor}"
    place = (
        Path(tempfile.mkdtemp(prefix="tissu-law-")) / f"{name}.so"
    )  # a folder of this user alone
    place.write_bytes(data)
    return str(place)
