"""The laws of the files that a scene names: programs, which run only where they are trusted."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from tissu.errors import LawError
from tissu.files.place import kind_of_place, reason_of
from tissu.scene.problem import Problem
from tissu.user_law.define import read_law

if TYPE_CHECKING:
    from tissu.scene.law import UserLaw

TRUST = "--trust-laws, or trust_laws=True in Python"


def untrusted(files: object) -> list[Problem]:
    """The problem of a scene that names files with laws, and was read without trust in them."""
    if not files:
        return []
    text = "found files with laws, which are programs and run when the scene is read; read them "
    text += f"first, and if you trust them all, run the scene with {TRUST}"
    return [Problem(("laws",), text)]


def laws_of_scene(files: object, base: Path | None) -> tuple[list[type[UserLaw]], list[Problem]]:
    """Runs the files, and gives their laws and what is wrong with those that cannot be had.

    Only files in the scene's folder or below it are run, links followed.
    """
    laws: list[type[UserLaw]] = []
    problems: list[Problem] = []
    for number, file in enumerate(files if isinstance(files, list) else ()):
        if not isinstance(file, str):
            continue  # the scene's own check says so
        try:
            law = read_law(_inside(file, base or Path()))
            if law.made in [other.made for other in laws]:
                continue
            if law.__name__ in [other.__name__ for other in laws]:
                raise LawError(f"{file}: another file has a law of this name; rename one of them.")
            laws.append(law)
        except LawError as error:
            problems.append(Problem(("laws", number), str(error)))
    return laws, problems


def _inside(file: str, base: Path) -> Path:
    """The path of a file in the scene's folder, as the scene names it.

    Raises:
        LawError: it is elsewhere, or no regular file.
    """
    path = base / file
    try:
        folder, place = base.resolve(), path.resolve()
        kind = kind_of_place(place)
    except (OSError, ValueError, RuntimeError) as error:
        raise LawError(f"{file}: the file cannot be read: {reason_of(error)}") from None
    if not place.is_relative_to(folder):
        raise LawError(
            f"{file}: the file is {place}, outside the scene's folder {folder}; laws of a scene "
            "are read from its folder or below: copy the file there."
        )
    if kind == "nothing":
        raise LawError(
            f"{path}: no such file; a Python file with the formula of a law is accepted."
        )
    if kind != "a file":
        raise LawError(
            f"{path}: found {kind}; a Python file with the formula of a law is accepted."
        )
    return path
