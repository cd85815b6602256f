"""The files that a command reads, in whose place it writes nothing."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from tissu.errors import ParameterError
from tissu.scene.part import Part


def input_files(file: Path, scene: Part) -> list[Path]:
    """The file of a scene and all that it names: meshes, laws, paths of hands, plug-ins."""
    return list(dict.fromkeys([file, *_named(scene)]))


def _named(value: object) -> Iterator[Path]:
    if isinstance(value, Path):
        yield value
    elif isinstance(value, Part):
        law = getattr(getattr(type(value), "made", None), "file", None)  # of a user-defined law
        if isinstance(law, Path):
            yield law
        for item in value.__dict__.values():
            yield from _named(item)
    elif isinstance(value, Mapping):
        for item in value.values():
            yield from _named(item)
    elif isinstance(value, (list, tuple)):
        for item in value:
            yield from _named(item)
    elif isinstance(source := getattr(value, "source", None), str):  # a mesh in memory
        yield Path(source)


def require_apart(what: str, places: Iterable[Path], inputs: Iterable[Path]) -> None:
    """Refuse to write in the place of a file that is read, or into a folder that holds one.

    Args:
        what: the option or argument that names the places, for the message.
        places: files that are written, and folders whose files are taken away.
        inputs: the files that are read.

    Raises:
        ParameterError: the first that is not apart.
    """
    read = list(inputs)
    for place in places:
        for file in read:
            if _same(place, file) or _same(place, file.parent):
                raise ParameterError(
                    f"{what}: found {file}, which the scene is read from and which would be "
                    "replaced; name another place"
                )


def _same(one: Path, other: Path) -> bool:
    try:
        return os.path.samefile(one, other)
    except (OSError, ValueError):  # one is not there
        return False
