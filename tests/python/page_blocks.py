"""The blocks of a page of docs, and a page as the program that its reader types.

Python blocks run one after the other in one namespace, in a folder of their own. A block with a
title is a file of that name; a scene has no problems; C++ stands in that file of the sources.
Lines of `sh` blocks that begin with `tissu` run. A block of `text` after any of them is what it
prints, where an ellipsis stands for anything.
"""

from __future__ import annotations

import contextlib
import io
import re
import shlex
from dataclasses import dataclass
from pathlib import Path

from typer.testing import CliRunner

from tissu import Scene

DOCS = Path(__file__).parents[2] / "docs"
BLOCK = re.compile(r"^( *)```(\w+)([^\n]*)\n(.*?)^\1```", re.DOTALL | re.MULTILINE)


@dataclass(frozen=True)
class Block:
    """One block of a page: its language, its title if it has one, its text."""

    kind: str
    title: str
    text: str


def blocks_of(page: Path) -> list[Block]:
    """Blocks of a page in their order."""
    found = []
    for _, kind, info, text in BLOCK.findall(page.read_text(encoding="utf-8")):
        title = re.search(r'title="([^"]*)"', info)
        found.append(Block(kind, title[1] if title else "", text))
    return found


def has_python(page: Path) -> bool:
    """Whether a page shows Python that runs."""
    return any(block.kind == "python" for block in blocks_of(page))


def run(block: Block, names: dict[str, object], page: Path) -> str | None:
    """Runs a block; what it prints, or None of one that is not run."""
    if block.kind == "cpp":
        source = (DOCS.parent / block.title).read_text(encoding="utf-8")
        assert block.text in source, f"{page.name} shows what {block.title} has not"
        return None
    if block.title:
        Path(block.title).write_text(block.text, encoding="utf-8")
        if block.title.endswith(".yaml"):
            problems = Scene.from_yaml(Path(block.title)).check().problems
            assert not problems, f"{page.name}: {block.title}: {problems}"
        return None
    with contextlib.redirect_stdout(io.StringIO()) as out:
        if block.kind == "python":
            exec(compile(block.text, page.name, "exec"), names)
        elif block.kind == "sh":
            for line in block.text.splitlines():
                command(line, page)
        else:
            return None
    return out.getvalue()


def command(line: str, page: Path) -> None:
    """Runs a command of tissu; others, and the live view, are not run."""
    from tissu.cli.app import app

    words = shlex.split(line, comments=True)
    if words[:1] != ["tissu"] or words[1] == "view":
        return
    done = CliRunner().invoke(app, words[1:])
    assert done.exit_code == 0, f"{page.name}: {line}: {done.output}"
    print(done.output, end="")


def same(printed: str, shown: str) -> bool:
    """Whether what is printed is what a page shows."""
    pattern = re.escape(shown.strip()).replace("…", ".*")
    return re.fullmatch(pattern, printed.strip(), re.DOTALL) is not None


def run_page(page: Path) -> dict[str, object]:
    """Runs a page in the present folder; the names that its blocks left.

    Raises:
        AssertionError: it prints something else than it shows, or a command fails.
    """
    names: dict[str, object] = {}
    printed: str | None = None
    for block in blocks_of(page):
        if block.kind == "text" and printed is not None:
            assert same(printed, block.text), f"{page.name} shows\n{block.text}\nbut:\n{printed}"
        printed = run(block, names, page)
    return names
