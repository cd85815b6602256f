"""Compiled laws are kept: one file for each text, compiler, set of flags and version of tissu.

A library is made under another name and renamed when it is whole, so that two processes that make
the same law at once both find a whole one.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path

from tissu.errors import LawError
from tissu.user_law.compiler import Compiler, header_files, run_compiler


def cache_folder() -> Path:
    """$TISSU_CACHE, else `tissu` in the user's cache folder, with `laws` in it.

    Raises:
        LawError: it cannot be made, or nothing can be written there.
    """
    asked = os.environ.get("TISSU_CACHE", "")
    base = os.environ.get("XDG_CACHE_HOME", "")
    try:
        root = Path(asked) if asked else (Path(base) if base else Path.home() / ".cache") / "tissu"
        folder = root.absolute() / "laws"
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, RuntimeError) as error:
        raise _unwritable(asked or "~/.cache/tissu", error) from None
    return folder


def _unwritable(folder: Path | str, error: Exception) -> LawError:
    reason = getattr(error, "strerror", None) or str(error)
    return LawError(
        f"compiled laws cannot be kept in {folder} ({reason}); name a folder that can be written "
        "in TISSU_CACHE."
    )


def key_of(source: str, compiler: Compiler, flags: Sequence[str]) -> str:
    """What a library depends on, as 20 hexadecimal digits."""
    from tissu._core import build_info

    total = hashlib.sha256()
    parts = [source, *compiler.command, compiler.version, *flags, str(build_info()["version"])]
    for part in parts:
        total.update(part.encode() + b"\0")
    for header in header_files():
        total.update(header.read_bytes() + b"\0")
    return total.hexdigest()[:20]


def library_for(
    name: str, source: str, compiler: Compiler, flags: list[str], *, again: bool = False
) -> Path:
    """The path of the compiled library, made if it is not there yet.

    Args:
        name: of the law: the files are called after it.
        source: its C++.
        compiler: who compiles it.
        flags: how.
        again: make it even if it is there.

    Raises:
        LawError: the compiler refuses the text (its messages are kept, the error says where), or
            the folder cannot be written.
    """
    folder = cache_folder()
    stem = f"{name}-{key_of(source, compiler, flags)}"
    library = folder / f"{stem}.so"
    if library.exists() and not again:
        return library
    try:
        work = Path(tempfile.mkdtemp(prefix=".making-", dir=folder))
    except OSError as error:
        raise _unwritable(folder, error) from None
    try:
        text, made = work / f"{stem}.cpp", work / f"{stem}.so"
        text.write_text(source, encoding="utf-8")
        said = run_compiler(compiler, flags, text, made)
        text.replace(folder / text.name)
        if said:
            log = work / f"{stem}.log"
            log.write_text(said.replace(str(work), str(folder)), encoding="utf-8")
            log.replace(folder / log.name)
            raise LawError(
                f"{name}: {compiler.command[0]} does not compile the made code; its messages are "
                f"in {folder / log.name}, and g++ 11 or newer is needed."
            )
        made.replace(library)
    except OSError as error:
        raise _unwritable(folder, error) from None
    finally:
        shutil.rmtree(work, ignore_errors=True)
    return library
