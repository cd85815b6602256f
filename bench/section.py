"""Sections of the pages in docs/measured that scripts of their own print."""

from __future__ import annotations

from pathlib import Path

MEASURED = Path(__file__).resolve().parents[1] / "docs" / "measured"
PAGE = MEASURED / "solvers.md"


def marks(name: str) -> tuple[str, str]:
    """The lines between which a section stands."""
    return f"<!-- {name}: printed by a script -->\n", f"<!-- end of {name} -->\n"


def put(name: str, text: str) -> None:
    """Replaces a section, or adds it at the end of the page."""
    page, (begin, end) = PAGE.read_text(encoding="utf-8"), marks(name)
    before, found, rest = page.partition(begin)
    after = rest.partition(end)[2] if found else ""
    gap = "" if found else "\n"
    PAGE.write_text(f"{before}{gap}{begin}{text}{end}{after}", encoding="utf-8")


def put_between(page: Path, name: str, text: str) -> None:
    """Replaces what stands between the marks of a script on a page.

    Raises:
        SystemExit: the page has no such marks.
    """
    begin, end = f"<!-- {name} -->\n", f"<!-- end of {name} -->\n"
    before, found, rest = page.read_text(encoding="utf-8").partition(begin)
    _, closed, after = rest.partition(end)
    if not (found and closed):
        raise SystemExit(f"{page.name} has no place between {begin.strip()} and {end.strip()}")
    page.write_text(f"{before}{begin}{text}{end}{after}", encoding="utf-8")


def kept() -> str:
    """All sections, for a script that prints the rest of the page."""
    page = PAGE.read_text(encoding="utf-8")
    first = page.find("<!-- ")
    return "" if first < 0 else "\n" + page[first:]
