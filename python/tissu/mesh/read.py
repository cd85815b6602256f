"""Reading a mesh file of any known format, and bringing its content into order."""

from __future__ import annotations

import dataclasses
import math
import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tissu import _core
from tissu.counted import are, counted
from tissu.errors import MeshError, ParameterError
from tissu.files.place import kind_of_place, path_of, reason_of, shown_path
from tissu.mesh.cell import CellBlock, Floats, Ints, dimension
from tissu.mesh.format import reader, sniffed
from tissu.mesh.mesh import Mesh, first_five
from tissu.mesh.raw import RawMesh


def read_mesh(path: str | os.PathLike[str], *, unit: str = "m", scale: float = 1.0) -> Mesh:
    """Read a mesh: every format of meshio, Gmsh 1, VTK polydata, .trian, .off and .obj.

    Blocks of one type are joined; volume cells numbered in reverse are turned round; physical
    groups and cell tags become regions. `notes` of the mesh list these changes.

    Args:
        path: the file.
        unit: unit of length of the file: "m", "cm", "mm", "inch", ...
        scale: factor on all lengths, on top of the unit.

    Raises:
        MeshError: the file cannot be read, or does not contain a mesh; with the reason and the
            place.
        ParameterError: the unit is not one of length, or the scale is not positive.
    """
    factor = _factor(unit, scale)
    file = _existing(path_of(path, "the path of a mesh file", error=MeshError))
    try:
        raw = reader(file)(file)
    except MeshError as error:
        raise MeshError(f"{error}{sniffed(file)}") from None
    except OSError as error:
        raise MeshError(f"{file} cannot be read: {error.strerror}") from None
    try:
        return _ordered(raw, factor, source=str(file), unit=unit, scale=scale)
    except MeshError as error:
        raise MeshError(f"{file}: {error}") from None


def _factor(unit: str, scale: float) -> float:
    """What the file's numbers are multiplied by to be metres."""
    from tissu.units import LENGTH

    if not unit.strip():
        raise ParameterError(f"found unit {unit!r}; a unit of length is accepted: m, cm, mm, ...")
    if not (math.isfinite(scale) and scale > 0.0):
        raise ParameterError(f"found scale {scale!r}; a positive number is accepted")
    try:
        return LENGTH(f"1 {unit}") * scale
    except ParameterError as error:
        raise ParameterError(f"unit of the mesh: {error}") from None


def _existing(path: Path) -> Path:
    try:
        kind = kind_of_place(path)
    except (OSError, ValueError) as error:
        why = reason_of(error)
        raise MeshError(f"{shown_path(path)} cannot be read: {why}; name another file") from None
    if kind == "nothing":
        raise MeshError(f"{path} does not exist; the path of a mesh file is accepted")
    if kind != "a file":
        raise MeshError(f"{path} is {kind}; the path of a mesh file is accepted")
    if path.stat().st_size == 0:
        raise MeshError(f"{path} is empty; a mesh file is accepted")
    return path


def _ordered(raw: RawMesh, factor: float, *, source: str, unit: str, scale: float) -> Mesh:
    """The content of a file as a mesh."""
    notes = list(raw.notes)
    points = _three_columns(raw.points, notes) * factor
    blocks, rows = _together(raw.blocks)
    if not blocks:
        raise MeshError("found no cells; a mesh with cells or faces is accepted")
    mesh = Mesh(points=points, cells=blocks, source=source, unit=unit, scale=scale)
    blocks, turned = _turned(mesh)
    unused = mesh.unused_nodes
    notes += _left_out(blocks) + turned
    if len(unused):
        kind = "volume cell" if mesh.volume_blocks else "cell"
        idle = f"{counted(len(unused), 'node')} {are(len(unused))} used by no {kind}"
        notes.append(f"{idle} ({first_five(unused)})")
    return dataclasses.replace(
        mesh,
        cells=blocks,
        regions=_regions(raw, rows, blocks, mesh.volume_blocks),
        border_regions=_regions(raw, rows, blocks, mesh.border_blocks),
        notes=tuple(notes),
    )


def _three_columns(points: NDArray[Any], notes: list[str]) -> Floats:
    if points.ndim != 2 or not len(points) or not 2 <= points.shape[1] <= 3:
        raise MeshError(
            f"found points of shape {points.shape}; two or three coordinates each are accepted"
        )
    points = points.astype(np.float64)
    if points.shape[1] == 2:
        notes.append("points have two coordinates; z is 0")
        points = np.column_stack([points, np.zeros(len(points))])
    return points


def _together(
    raw: list[tuple[str, NDArray[Any]]],
) -> tuple[tuple[CellBlock, ...], list[list[int]]]:
    """Like blocks as one, and for each the numbers of the file's blocks it is made of."""
    rows: dict[str, list[int]] = {}
    for i, (name, nodes) in enumerate(raw):
        if len(nodes):
            rows.setdefault(name, []).append(i)
    blocks = [CellBlock(name, np.concatenate([raw[i][1] for i in of])) for name, of in rows.items()]
    return tuple(blocks), list(rows.values())


def _turned(mesh: Mesh) -> tuple[tuple[CellBlock, ...], list[str]]:
    """Blocks whose reversed volume cells are turned round, and a note."""
    if not mesh.volume_blocks:
        return mesh.cells, []
    native, count = _core.turn_reversed_cells(positions=mesh.points, blocks=mesh.native_blocks())
    if not count:
        return mesh.cells, []
    turned = dict(native)
    blocks = tuple(CellBlock(b.type, turned.get(b.type, b.nodes)) for b in mesh.cells)
    return blocks, [f"{counted(count, 'cell')} with reversed winding turned round"]


def _left_out(blocks: tuple[CellBlock, ...]) -> list[str]:
    """Notes on faces, lines and points beside a volume."""
    if not any(dimension(block.type) == 3 for block in blocks):
        return []
    return [
        f"{counted(len(block), 'cell')} of type {block.type} left out of the volume"
        for block in blocks
        if dimension(block.type) < 3
    ]


def _regions(
    raw: RawMesh,
    rows: list[list[int]],
    blocks: tuple[CellBlock, ...],
    among: tuple[CellBlock, ...],
) -> dict[str, Ints]:
    """Regions as numbers of the cells of some blocks; those without any are dropped."""
    rows_of = {block.type: of for block, of in zip(blocks, rows, strict=True)}
    regions = {}
    for name, masks in raw.regions.items():
        columns = [np.concatenate([masks[i] for i in rows_of[block.type]]) for block in among]
        cells = np.flatnonzero(np.concatenate(columns)) if columns else np.empty(0)
        if len(cells):
            regions[name] = cells.astype(np.int32)
    return regions
