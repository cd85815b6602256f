"""The laws of the files that a YAML scene names."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from tissu.errors import LawError
from tissu.scene.problem import Problem
from tissu.user_law.define import read_law

if TYPE_CHECKING:
    from tissu.scene.law import UserLaw


def laws_of_scene(files: object, base: Path | None) -> tuple[list[type[UserLaw]], list[Problem]]:
    """The laws, and what is wrong with those that cannot be had."""
    laws: list[type[UserLaw]] = []
    problems: list[Problem] = []
    for number, file in enumerate(files if isinstance(files, list) else ()):
        if not isinstance(file, str):
            continue  # the scene's own check says so
        try:
            law = read_law((base or Path()) / file)
            if law.made in [other.made for other in laws]:
                continue
            if law.__name__ in [other.__name__ for other in laws]:
                raise LawError(f"{file}: another file has a law of this name; rename one of them.")
            laws.append(law)
        except LawError as error:
            problems.append(Problem(("laws", number), str(error)))
    return laws, problems
