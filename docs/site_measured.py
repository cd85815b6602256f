"""A hook of MkDocs: each measured page ends with the script, the day and the machine of its tables.

They stand once, in the table of measured/index.md.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mkdocs.structure.pages import Page

INDEX = Path(__file__).resolve().parent / "measured" / "index.md"
ROW = re.compile(
    r"^\| \[[^\]]*\]\(([\w-]+\.md)\) \| [^|]* \| ([^|]*) \| ([^|]*) \| ([^|]*) \|$", re.M
)


@cache
def rows() -> dict[str, tuple[str, str, str]]:
    """Page -> what printed it, when, and on what."""
    found = ROW.findall(INDEX.read_text(encoding="utf-8"))
    return {page: (script, day, machine) for page, script, day, machine in found}


def on_page_markdown(markdown: str, page: Page, **_: object) -> str:
    """Adds the line to pages below measured."""
    folder, _, name = page.file.src_uri.rpartition("/")
    if folder != "measured" or name not in rows():
        return markdown
    script, day, machine = rows()[name]
    return f"{markdown}\n\n---\n\n*Tables of {day}, by {script}; {machine}.*\n"
