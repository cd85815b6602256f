"""Lists sentences that a native reader may stumble over: python .ci/english.py [FILE …].

It looks for patterns of the ten rules in CONTRIBUTING.md. It gates nothing: a match may be right.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LONGEST = 45  # words of a sentence
PATTERNS = {
    "'is no N'": r"(?<!here )\b(?:is|are|was|were) no (?!longer|more\b|less\b)[a-z]+",
    "who, whom or nobody for a thing": r"\b(?:who|whom|nobody|somebody)\b",
    "code does not tell": r"\b(?:tells?|told)\b",
    "a clause for a noun": r"(?:^|[.:;] )(?:What|Where|Whether) [a-z]+ (?:has|have|is|are|does)\b",
    "a verb is missing": r"(?:^|[.:] )(?:Of|In place of|By) [a-z]+(?: [a-z]+){0,3}[,;.]",
    "'beside' for 'in addition to'": r"\bbeside (?:it|them|that)\b",
    "'anew' twice": r"\banew\b[^.]*\banew\b",
}
FENCE = re.compile(r"^ *```.*?^ *```", re.DOTALL | re.MULTILINE)


def prose(path: Path) -> str:
    """The words of a page without code, tables and links; line numbers stay."""
    text = path.read_text(encoding="utf-8")
    text = FENCE.sub(lambda found: "\n" * found[0].count("\n"), text)
    text = re.sub(r"^(?:\||#|    |<!--).*$", "", text, flags=re.MULTILINE)
    text = re.sub(r"\]\([^)]*\)", "]", text)
    return re.sub(r"`[^`\n]*`", "`code`", text)


def found(path: Path) -> Iterator[tuple[int, str, str]]:
    """Line, rule and words of each match."""
    text = prose(path)
    for rule, pattern in PATTERNS.items():
        for match in re.finditer(pattern, text, re.MULTILINE):
            shown = " ".join(text[max(match.start() - 30, 0) : match.end() + 30].split())
            yield text.count("\n", 0, match.start()) + 1, rule, shown
    for match in re.finditer(r"[^.!?\n][^.!?]*[.!?](?=\s)", re.sub(r"\n\n+", " . ", text)):
        words = match[0].split()
        if len(words) > LONGEST:
            yield 0, f"a sentence of {len(words)} words", " ".join(words[:12]) + " …"


def main(names: list[str]) -> None:
    """Lists the matches of the files, or of every page."""
    pages = [Path(name) for name in names] or [
        *(ROOT / name for name in ("README.md", "CONTRIBUTING.md")),
        *sorted((ROOT / "docs").rglob("*.md")),
    ]
    for path in pages:
        for line, rule, words in sorted(found(path)):
            print(f"{path}:{line or ''}: {rule}: {words}")


if __name__ == "__main__":
    main(sys.argv[1:])
