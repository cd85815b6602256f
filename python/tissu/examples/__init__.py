"""The example scenes, which come with tissu wherever it is installed.

organ = tissu.examples.organ()      # a Scene
tissu.examples.copy("organ", "here")
"""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import TYPE_CHECKING

from tissu.errors import ParameterError, TissuError
from tissu.files import require_folder_place, whole_file
from tissu.files.place import reason_of

if TYPE_CHECKING:
    from tissu.front import Scene

_FOLDERS = (Path(__file__).resolve().parent, Path(__file__).resolve().parents[3] / "examples")


def folder() -> Path:
    """Where the examples are: in the installed package, or in the checkout.

    Raises:
        TissuError: in neither.
    """
    for place in _FOLDERS:
        if (place / "organ.yaml").is_file():
            return place
    raise TissuError(f"the examples are missing in {_FOLDERS[0]}; install tissu again")


def names() -> list[str]:
    """Names of the examples."""
    return sorted(path.stem for path in folder().glob("*.yaml"))


def file(name: str) -> Path:
    """The scene file of an example.

    Raises:
        ParameterError: there is none of this name.
    """
    if name not in names():
        raise ParameterError(f"found example '{name}'; {', '.join(names())} are accepted")
    return folder() / f"{name}.yaml"


def scene(name: str) -> Scene:
    """An example as a scene.

    Raises:
        ParameterError: there is none of this name.
    """
    from tissu.front import Scene

    return Scene.from_yaml(file(name))


def organ() -> Scene:
    """A soft organ, held at its back and pulled by gravity: the scene of the README."""
    return scene("organ")


def copy(name: str, place: str | os.PathLike[str]) -> list[Path]:
    """Copies an example's scene and its meshes into a folder, and gives their paths.

    Raises:
        ParameterError: there is none of this name.
        TissuError: another file lies in the place of one, or it cannot be written.
    """
    source, target = file(name), require_folder_place(place, "folder")
    text = source.read_text(encoding="utf-8")
    meshes = [path for path in sorted(folder().glob("*.vtu")) if _names(text, path.name)]
    copied = []
    for path in (source, *meshes):
        data, there = path.read_bytes(), target / path.name
        try:
            target.mkdir(parents=True, exist_ok=True)
            if there.is_file() and there.read_bytes() != data:
                raise TissuError(f"{there}: found another file; name another folder")
        except OSError as error:
            raise TissuError(f"{there}: cannot be written ({reason_of(error)})") from None
        with whole_file(there) as partial:
            partial.write_bytes(data)
        copied.append(there)
    return copied


def _names(text: str, mesh: str) -> bool:
    return re.search(rf"(?<![\w.-]){re.escape(mesh)}(?![\w.-])", text) is not None
