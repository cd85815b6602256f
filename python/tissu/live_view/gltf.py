"""Binary glTF 2.0 (.glb): surfaces that move, as morph targets whose weights follow the time.

The container is that of the Khronos Group's specification, glTF 2.0, 2021: a header, a piece of
JSON that says what there is, and a piece of numbers that it refers to.
"""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tissu.files import whole_file

_FLOAT, _UNSIGNED = 5126, 5125
_KINDS = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}
_POINTS_OF, _CORNERS_OF = 34962, 34963


class Gltf:
    """One scene, to which meshes, nodes and motions are added."""

    def __init__(self, *, name: str, up: ArrayLike) -> None:
        """Begin with a root.

        Args:
            name: of the scene.
            up: (3,) direction that is up; a reader of glTF takes y for it.
        """
        self._data: list[bytes] = []
        self._size = 0
        self._samplers: list[dict[str, Any]] = []
        self._channels: list[dict[str, Any]] = []
        self._root: dict[str, Any] = {"name": name, "rotation": _to_y(up), "children": []}
        self._all: dict[str, Any] = {
            "asset": {"version": "2.0", "generator": "tissu"},
            "scene": 0,
            "scenes": [{"name": name, "nodes": [0]}],
            "nodes": [self._root],
            "meshes": [],
            "materials": [],
            "accessors": [],
            "bufferViews": [],
        }

    def numbers(self, values: NDArray[Any], *, of: int | None = None, span: bool = False) -> int:
        """Numbers (n,) or (n, k) of float32 or uint32; gives the place that refers to them.

        Args:
            values: the numbers.
            of: what they are bound to, of glTF's constants.
            span: whether the smallest and largest are named.
        """
        rows = np.ascontiguousarray(values).reshape(len(values), -1)
        view = {"buffer": 0, "byteOffset": self._size, "byteLength": rows.nbytes}
        if of is not None:
            view["target"] = of
        self._data.append(rows.tobytes())
        self._size += rows.nbytes
        found: dict[str, Any] = {
            "bufferView": self._add("bufferViews", view),
            "componentType": _FLOAT if rows.dtype == np.float32 else _UNSIGNED,
            "count": len(rows),
            "type": _KINDS[rows.shape[1]],
        }
        if span:
            found["min"], found["max"] = rows.min(axis=0).tolist(), rows.max(axis=0).tolist()
        return self._add("accessors", found)

    def points(self, places: NDArray[np.float32]) -> int:
        """Places (n, 3) of points."""
        return self.numbers(places, of=_POINTS_OF, span=True)

    def corners(self, rows: NDArray[np.uint32]) -> int:
        """Numbers of points: of triangles (t, 3) or lines (l, 2)."""
        return self.numbers(rows.ravel(), of=_CORNERS_OF)

    def colour(self, name: str, colour: tuple[int, int, int], opacity: float = 1.0) -> int:
        """A surface of a colour, given as a screen shows it, 0 to 255, and of an opacity."""
        share = np.array(colour) / 255.0
        linear = np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)
        shine = {"metallicFactor": 0.0, "roughnessFactor": 0.8}
        painted = {"baseColorFactor": [*linear.tolist(), opacity], **shine}
        made = {"name": name, "doubleSided": True, "pbrMetallicRoughness": painted}
        if opacity < 1.0:
            made["alphaMode"] = "BLEND"
        return self._add("materials", made)

    def mesh(self, name: str, primitives: list[dict[str, Any]], **pose: ArrayLike) -> int:
        """A mesh at a pose, of `translation`, `rotation` x, y, z, w and `scale`; gives its node."""
        mesh: dict[str, Any] = {"name": name, "primitives": primitives}
        targets = len(primitives[0].get("targets", ()))
        if targets:
            mesh["weights"] = [0.0] * targets
        node = {
            "name": name,
            "mesh": self._add("meshes", mesh),
            **{what: np.asarray(numbers, dtype=float).tolist() for what, numbers in pose.items()},
        }
        self._root["children"].append(self._add("nodes", node))
        return int(self._root["children"][-1])

    def move(self, node: int, what: str, times: int, values: int, *, way: str = "LINEAR") -> None:
        """A motion of a node: what of it changes, at times [s]; both are places of numbers."""
        sampler = {"input": times, "output": values, "interpolation": way}
        self._samplers.append(sampler)
        target = {"node": node, "path": what}
        self._channels.append({"sampler": len(self._samplers) - 1, "target": target})

    def write(self, path: Path) -> None:
        """Write the file, whole or not at all.

        Raises:
            TissuError: it cannot be written.
        """
        if self._channels:
            motion = {"name": "run", "samplers": self._samplers, "channels": self._channels}
            self._all["animations"] = [motion]
        if self._size:
            self._all["buffers"] = [{"byteLength": self._size}]
        text = json.dumps({key: value for key, value in self._all.items() if value != []}).encode()
        text += b" " * (-len(text) % 4)
        whole = 12 + 8 + len(text) + 8 + self._size
        with whole_file(path) as partial, partial.open("wb") as file:
            file.write(struct.pack("<4sII", b"glTF", 2, whole))
            file.write(struct.pack("<I4s", len(text), b"JSON") + text)
            file.write(struct.pack("<I4s", self._size, b"BIN\0"))
            file.writelines(self._data)

    def _add(self, kind: str, thing: dict[str, Any]) -> int:
        """Its number among those of its kind."""
        self._all[kind].append(thing)
        return len(self._all[kind]) - 1


def _to_y(up: ArrayLike) -> list[float]:
    """The rotation, as quaternion x, y, z, w, that turns a direction to y."""
    x, y, z = np.asarray(up, dtype=float) / np.linalg.norm(up)
    if y < -1.0 + 1e-12:
        return [1.0, 0.0, 0.0, 0.0]
    found = np.array([-z, 0.0, x, 1.0 + y])  # of up x y and 1 + up . y
    return [float(value) for value in found / np.linalg.norm(found)]
