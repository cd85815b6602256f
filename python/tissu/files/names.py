"""Names of scenes and bodies as parts of file names."""

from __future__ import annotations

import hashlib
import re
from collections import Counter
from collections.abc import Iterable

_LONGEST = 80  # bytes; file systems take 255, and numbers and endings come on top
_DIGITS = 8  # of the digest that distinguishes two names


def file_name(name: str) -> str:
    """A name as part of a file name: letters, digits, "_", "-" and "." stay, the rest is "_".

    What is too long for a file system is cut, with the digest of the whole name at its end.
    """
    plain = re.sub(r"[^\w.-]+", "_", name).strip("._") or "scene"
    if len(plain.encode("utf-8", "replace")) <= _LONGEST:
        return plain
    kept = plain.encode("utf-8", "replace")[: _LONGEST - _DIGITS - 1].decode("utf-8", "ignore")
    return f"{kept}-{_digest(name)}"


def distinct_names(names: Iterable[str]) -> dict[str, str]:
    """A file name for each name, no two alike.

    A name that is a file name already keeps it. Of the others, those that `file_name` makes equal
    ("a/b" and "a:b", "b" and "b ") get a digest of the whole name at their end.
    """
    given = list(dict.fromkeys(names))
    plain = {name: file_name(name) for name in given}
    result = {name: name for name, made in plain.items() if name == made}
    count = Counter(plain.values())
    for name in given:
        if name in result:
            continue
        made = plain[name] if count[plain[name]] == 1 else f"{plain[name]}-{_digest(name)}"
        while made in result.values():
            made += "_"
        result[name] = made
    return result


def _digest(name: str) -> str:
    return hashlib.sha256(name.encode("utf-8", "surrogatepass")).hexdigest()[:_DIGITS]
