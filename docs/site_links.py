"""A hook of MkDocs: links that leave docs work on the site as they do in the repository.

A page may link to an example, a test or README.md. Such a file is copied below `source/` of the
site, as a page where it is Markdown, and the link goes there. A notebook's link goes to its page.
"""

from __future__ import annotations

import posixpath
import re
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mkdocs.config.defaults import MkDocsConfig
    from mkdocs.structure.files import Files
    from mkdocs.structure.pages import Page

ROOT = Path(__file__).resolve().parent.parent
LINK = re.compile(r"\]\(([^()#\s]+)(#[^()\s]*)?\)")
SOURCE = "source/"


def place_of(page: str) -> str:
    """Where a page of the site stands in the repository."""
    return page.removeprefix(SOURCE) if page.startswith(SOURCE) else f"docs/{page}"


def uri_of(path: str, page: str = "") -> str:
    """Where a file of the repository stands on the site, seen from a page.

    A notebook is its page, but on that page itself, which gives the file.
    """
    if not path.startswith("docs/"):
        return SOURCE + path
    path = path.removeprefix("docs/")
    its_page = f"{path.removesuffix('.ipynb')}.md"
    return its_page if path.endswith(".ipynb") and page != its_page else path


def target_of(link: str, page: str) -> str | None:
    """The file of the repository that a link of a page goes to; none of other addresses."""
    if ":" in link or link.startswith("/"):
        return None
    path = posixpath.normpath(posixpath.join(posixpath.dirname(place_of(page)), link))
    return path if not path.startswith("..") and (ROOT / path).is_file() else None


def outside(text: str, page: str) -> set[str]:
    """Files outside docs that a page links to."""
    found = {target_of(link, page) for link, _ in LINK.findall(text)}
    return {path for path in found if path is not None and not path.startswith("docs/")}


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Adds what pages link to outside docs, and what those pages link to in turn."""
    from mkdocs.structure.files import File

    waiting = [file.src_uri for file in files if file.is_documentation_page()]
    seen: set[str] = set()
    while waiting:
        page = waiting.pop()
        path = ROOT / place_of(page)
        text = path.read_text(encoding="utf-8") if path.is_file() else ""
        for name in outside(text, page) - seen:
            seen.add(name)
            uri = uri_of(name)
            files.append(File.generated(config, uri, abs_src_path=str(ROOT / name)))
            if name.endswith(".md"):
                waiting.append(uri)
    return files


def on_page_markdown(markdown: str, page: Page, **_: object) -> str:
    """Turns the links of a page to where their files stand on the site."""
    here = page.file.src_uri

    def turned(found: re.Match[str]) -> str:
        path = target_of(found[1], here)
        if path is None:
            return found[0]
        link = posixpath.relpath(uri_of(path, here), posixpath.dirname(here) or ".")
        return f"]({link}{found[2] or ''})"

    return LINK.sub(turned, markdown)
