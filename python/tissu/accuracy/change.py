"""A scene with fields changed, named by their paths."""

from __future__ import annotations

import copy
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from tissu.errors import ParameterError
from tissu.front import Scene
from tissu.yaml_io import scene_mapping


def changed(
    file: Path,
    changes: Mapping[str, Any],
    meshes: Path | None = None,
    *,
    trust_laws: bool = False,
) -> Scene:
    """The scene of a file with other values at some paths (`bodies.bar.mesh.cells`).

    Args:
        file: the scene.
        changes: values by path; null takes the field away.
        meshes: where mesh files are looked for that are not beside the scene.
        trust_laws: whether the files of its laws, which are programs, may run.

    Raises:
        ParameterError: a path leads nowhere.
        SceneError: the changed scene is not one.
    """
    data = copy.deepcopy(scene_mapping(file))
    for path, value in changes.items():
        _set(data, path.split("."), value, path)
    if meshes is not None:
        for body in data["bodies"].values():
            mesh = body.get("mesh")
            if (
                isinstance(mesh, dict)
                and "file" in mesh
                and not (file.parent / mesh["file"]).exists()
            ):
                mesh["file"] = str(meshes / mesh["file"])
    return Scene.from_yaml_text(json.dumps(data), base=file.parent, trust_laws=trust_laws)


def _set(data: Any, path: list[str], value: Any, whole: str) -> None:
    *way, last = path
    for part in way:
        if isinstance(data, list) and part.isdigit() and int(part) < len(data):
            data = data[int(part)]
        elif isinstance(data, dict) and part in data:
            data = data[part]
        else:
            raise ParameterError(f"{whole}: the scene has no '{part}' there to change")
    if isinstance(data, list):
        data[int(last)] = value
    elif not isinstance(data, dict):
        raise ParameterError(f"{whole}: the scene has no fields there to change")
    elif value is None:
        data.pop(last, None)
    else:
        data[last] = value
