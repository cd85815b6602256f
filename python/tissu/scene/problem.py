"""A problem of a scene: its place (field path, file, line) and one sentence."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

Path = tuple[str | int, ...]


@dataclass(frozen=True, slots=True)
class Source:
    """Where a scene was written.

    Attributes:
        file: name of the YAML file, or "text".
        lines: line (from 1) of each field, by its path.
    """

    file: str
    lines: Mapping[Path, int] = field(default_factory=dict)

    def line(self, path: Path) -> int:
        """Line of a field, or of the nearest field around it."""
        while path and path not in self.lines:
            path = path[:-1]
        return self.lines.get(path, 1)


@dataclass(frozen=True, slots=True)
class Problem:
    """What is wrong, and where: path of the field, and what was found and is accepted."""

    path: Path
    text: str

    def sentence(self, source: Source | None = None) -> str:
        """The problem with its file and line (where there is a file) and field path."""
        place = f"{source.file}:{source.line(self.path)}: " if source else ""
        name = field_path(self.path)
        return f"{place}{name}: {self.text}" if name else f"{place}{self.text}"


def field_path(path: Path) -> str:
    """A path as it is written in messages: ("fixed", 0, "on") -> "fixed[0].on"."""
    text = ""
    for part in path:
        if isinstance(part, int):
            text += f"[{part}]"
        else:
            text += f".{part}" if text else part
    return text


def nearest(word: object, known: Iterable[str]) -> str:
    """The known word nearest to `word`, as "; did you mean 'x'?"; "." when none is near."""
    close = nearest_word(word, known)
    return "." if close is None else f"; did you mean '{close}'?"


def nearest_word(word: object, known: Iterable[str]) -> str | None:
    """The known word nearest to `word`; None when none is near."""
    lower = {w.lower(): w for w in known}
    close = difflib.get_close_matches(str(word).lower(), list(lower), n=1, cutoff=0.5)
    return lower[close[0]] if close else None


def one_of_words(words: Iterable[str]) -> str:
    """Accepted words as a list in a sentence."""
    return ", ".join(words)
