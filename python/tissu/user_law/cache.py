"""Compiled laws are kept: one file for each text, compiler, set of flags and version of tissu.

A library is code that is loaded into the process. It is taken from a folder that only this user may
enter, and only with a record of the digests of its source and of its bytes; those very bytes are
loaded. A library is made under another name and renamed when it is whole.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path

from tissu.errors import LawError
from tissu.user_law.compiler import Compiler, header_files, run_compiler
from tissu.user_law.private import private_bytes, private_folder


def cache_folder() -> Path:
    """$TISSU_CACHE, else `tissu` in the user's cache folder, with `laws` in it.

    Raises:
        LawError: it cannot be made, nothing can be written there, or others than this user may.
    """
    asked = os.environ.get("TISSU_CACHE", "")
    base = os.environ.get("XDG_CACHE_HOME", "")
    try:
        root = Path(asked) if asked else (Path(base) if base else Path.home() / ".cache") / "tissu"
        folder = root.absolute() / "laws"
        private_folder(folder.parent)
        private_folder(folder)
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
) -> bytes:
    """The compiled library, made if it is not there yet or is not what was made.

    Args:
        name: of the law: the files are called after it.
        source: its C++.
        compiler: what compiles it.
        flags: how.
        again: make it even if it is there.

    Raises:
        LawError: the compiler refuses the text (its messages are kept, the error says where), or
            the folder cannot be written.
    """
    folder = cache_folder()
    stem = f"{name}-{key_of(source, compiler, flags)}"
    kept = None if again else _kept(folder, stem, source)
    if kept is not None:
        return kept
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
            raise _not_compiled(name, compiler, folder / log.name)
        return _keep(folder, source, made)
    except OSError as error:
        raise _unwritable(folder, error) from None
    finally:
        shutil.rmtree(work, ignore_errors=True)


def _not_compiled(name: str, compiler: Compiler, log: Path) -> LawError:
    return LawError(
        f"{name}: {compiler.command[0]} does not compile the made code; its messages are in {log}, "
        "and g++ 11 or newer is needed."
    )


def _keep(folder: Path, source: str, made: Path) -> bytes:
    """Moves a library that was made into the folder, with its record; its bytes."""
    made.chmod(0o600)
    data = made.read_bytes()
    record = made.with_suffix(".json")
    record.write_text(json.dumps(_digests(source, data)), encoding="utf-8")
    record.chmod(0o600)
    made.replace(folder / made.name)
    record.replace(folder / record.name)
    return data


def _kept(folder: Path, stem: str, source: str) -> bytes | None:
    """The library that was kept; None where it, or its record, is not what was made."""
    data, record = private_bytes(folder / f"{stem}.so"), private_bytes(folder / f"{stem}.json")
    if data is None or record is None:
        return None
    try:
        whole = json.loads(record) == _digests(source, data)
    except (ValueError, RecursionError):
        return None
    return data if whole else None


def _digests(source: str, library: bytes) -> dict[str, str]:
    return {
        "source": hashlib.sha256(source.encode()).hexdigest(),
        "library": hashlib.sha256(library).hexdigest(),
    }
