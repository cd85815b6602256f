"""What of a scene its motion depends on, as plain data, and where two scenes differ in it."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterator, Mapping
from itertools import zip_longest
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import BaseModel

from tissu.counted import counted

if TYPE_CHECKING:
    from tissu.mesh import Mesh
    from tissu.scene.scene import SceneData

# Names, how long and how fast it runs and what is written: the same motion with any of them. The
# files of laws too: the laws themselves stand in the bodies.
_LEFT_OUT = frozenset({"name", "duration", "threads", "output", "laws"})
_LONG = 64  # numbers of an array that is compared by its digest
_SHOWN = 3  # differences


def physics_of(scene: SceneData, meshes: Mapping[str, Mesh]) -> dict[str, Any]:
    """Everything that the motion of a scene depends on, with each mesh by its digest.

    Args:
        scene: the scene.
        meshes: body -> its mesh at rest, all cells there.
    """
    fields = {name: getattr(scene, name) for name in type(scene).model_fields}
    data = {name: _plain(value) for name, value in fields.items() if name not in _LEFT_OUT}
    for body, mesh in meshes.items():
        data["bodies"][body]["mesh"] = _mesh(mesh)
    return dict(json.loads(json.dumps(data, allow_nan=False)))


def differences(there: Mapping[str, Any], here: Mapping[str, Any]) -> str:
    """Where two scenes differ, the first of them in full; empty when they do not."""
    found = list(_differences(there, here, ""))
    if len(found) > _SHOWN:
        more = counted(len(found) - _SHOWN, "more difference")
        return ", ".join(found[:_SHOWN]) + f", and {more}"
    return ", ".join(found)


def _differences(one: Any, two: Any, path: str) -> Iterator[str]:
    """Field by field; parts of another type in that alone."""
    if isinstance(one, Mapping) and isinstance(two, Mapping):
        same_type = one.get("type") == two.get("type")
        for name in {**one, **two} if same_type else ("type",):
            below = f"{path}.{name}" if path else str(name)
            yield from _differences(one.get(name), two.get(name), below)
    elif isinstance(one, list) and isinstance(two, list) and _has_parts(one + two):
        for number, (item, other) in enumerate(zip_longest(one, two)):
            yield from _differences(item, other, f"{path}[{number}]")
    elif one != two:
        yield f"{path} is {_shown(one)} there and {_shown(two)} here"


def _plain(value: Any) -> Any:
    """A value as JSON knows it; a law of one's own with the digest of its formula."""
    if isinstance(value, BaseModel):
        fields = {name: _plain(getattr(value, name)) for name in type(value).model_fields}
        made = getattr(type(value), "made", None)
        return fields if made is None else {**fields, "formula": made.digest}
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray) and value.size > _LONG:
        return f"{value.dtype} {value.shape} {_digest(value)}"
    if isinstance(value, (np.ndarray, np.generic)):
        return _plain(value.tolist())
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else str(value)
    return value if value is None or isinstance(value, (bool, int, str)) else str(value)


def _mesh(mesh: Mesh) -> str:
    parts: list[Any] = [mesh.points]
    names: list[Any] = [list(mesh.thin)]
    for block in mesh.cells:
        names.append(block.type)
        parts.append(block.nodes)
    for regions in (mesh.regions, mesh.border_regions):
        for name in sorted(regions):
            names.append(name)
            parts.append(regions[name])
    size = f"{counted(mesh.node_count, 'node')}, {counted(mesh.cell_count, 'cell')}"
    return f"{size}, digest {_digest(*parts, np.frombuffer(json.dumps(names).encode(), np.uint8))}"


def _digest(*arrays: Any) -> str:
    total = hashlib.sha256()
    for values in arrays:
        total.update(f"{values.dtype} {values.shape}".encode())
        total.update(np.ascontiguousarray(values).tobytes())
    return total.hexdigest()[:16]


def _has_parts(values: list[Any]) -> bool:
    return any(isinstance(value, Mapping) for value in values)


def _shown(value: Any) -> str:
    if value is None:
        return "absent"
    text = str(value.get("type", "given") if isinstance(value, Mapping) else value)
    return text if len(text) <= 60 else f"{text[:57]}..."
