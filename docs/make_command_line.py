"""Writes docs/reference/command-line.md from the commands of the typer application."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args, get_type_hints

from typer import Typer

from tissu.cli.app import app

PAGE = Path(__file__).parent / "reference" / "command-line.md"
HEAD = """# Command line

`tissu COMMAND --help` prints what stands here. `-h` is short for `--help`, and `tissu --version`
prints the version. Every command takes `--debug`, which shows a traceback instead of a sentence.

A command ends with a status: [0 is success](errors.md#exit-status). Errors are sentences on stderr.
"""


def commands(some: Typer, name: str) -> Iterator[tuple[str, Any]]:
    """Every command with its full name and the function behind it."""
    for command in some.registered_commands:
        found = command.callback
        assert found is not None
        yield f"{name} {command.name or found.__name__}", found
    for group in some.registered_groups:
        assert group.typer_instance is not None
        yield from commands(group.typer_instance, f"{name} {group.name}")


def written(name: str, kind: Any, info: Any) -> str:
    """How an argument or an option is written."""
    if type(info).__name__ == "ArgumentInfo":
        return f"`{info.metavar or name.upper()}`"
    first = [info.default] if str(info.default).startswith("-") else []  # where Annotated puts it
    switches = ", ".join([*first, *(info.param_decls or ())] or [f"--{name.replace('_', '-')}"])
    if kind is bool:
        return f"`{switches}`"
    kinds = {int: "NUMBER", float: "NUMBER", Path: "PATH"}
    given = [one for one in (get_args(kind) or (kind,)) if one is not type(None)]
    return f"`{switches} {info.metavar or kinds.get(given[0], 'TEXT')}`"


def default_of(kind: Any, default: Any) -> str:
    """The default, where there is one to name."""
    if default is inspect.Parameter.empty:
        return "required"
    if kind is bool:
        return "on" if default else "off"
    if default in (None, "", Path()):
        return ""
    return f"`{' '.join(default) if isinstance(default, tuple) else default}`"


def rows(function: Any) -> Iterator[str]:
    """A row for each argument and option."""
    hints = get_type_hints(function, include_extras=True)
    for name, parameter in inspect.signature(function).parameters.items():
        kind, info = get_args(hints[name])[:2]
        if name == "debug":
            continue
        words = " ".join((info.help or "").split())
        cells = (written(name, kind, info), default_of(kind, parameter.default), words)
        yield "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def section(name: str, function: Any) -> str:
    """A command: what it does, and its arguments and options."""
    lines = [f"## {name}", "", " ".join((inspect.getdoc(function) or "").split())]
    found = list(rows(function))
    return "\n".join([*lines, "", "| | default | |", "|---|---|---|", *found] if found else lines)


def page() -> str:
    """The whole page."""
    sections = [section(name, function) for name, function in commands(app, "tissu")]
    return "\n\n".join([HEAD.rstrip(), *sections, "This page is printed by `make codegen`."]) + "\n"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
