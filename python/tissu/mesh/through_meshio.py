"""Every file that meshio reads: silenced, and its ways of failing turned into one error."""

from __future__ import annotations

import contextlib
import io
import warnings
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tissu.errors import MeshError
from tissu.mesh.cell import cell_table, dimension
from tissu.mesh.gmsh_tags import impossible_tag
from tissu.mesh.raw import RawMesh, tagged_regions
from tissu.mesh.truncated import finite

REGION_MARK = (
    "region:"  # cell data of this name say which cells are in a region; write_mesh makes them
)

# Cell data that number the regions, and whether 0 means none.
_TAGS = {
    "gmsh:physical": True,
    "medit:ref": False,
    "cell_tags": True,
    "su2:tag": False,
    "nastran:ref": False,
    "ugrid:ref": False,
    "avsucd:material": False,
    "netgen:index": False,
    "flac3d:group": False,
    "tetgen:ref": False,
    "material": False,
    "region": False,
}


def library() -> Any:
    """The library meshio, with the dimensions of wedge15 and pyramid13, which it omits."""
    import meshio

    for row in cell_table().values():
        meshio._mesh.topological_dimension.setdefault(row.name, row.dimension)
    return meshio


def formats(path: Path) -> list[str]:
    """Names of the formats that files with this ending may have, the likeliest first."""
    meshio = library()
    suffixes = "".join(path.suffixes).lower()
    endings = sorted((e for e in meshio.extension_to_filetypes if suffixes.endswith(e)), key=len)
    found: list[str] = meshio.extension_to_filetypes[endings[-1]] if endings else []
    return found[::-1]  # of ansys and gmsh, gmsh


def endings() -> list[str]:
    """Endings of the files that meshio knows."""
    meshio = library()
    return sorted(meshio.extension_to_filetypes)


@contextlib.contextmanager
def quiet() -> Iterator[io.StringIO]:
    """Keeps what meshio prints, and its warnings to itself."""
    said = io.StringIO()
    with (
        contextlib.redirect_stdout(said),
        contextlib.redirect_stderr(said),
        warnings.catch_warnings(),
        np.errstate(all="ignore"),
    ):
        warnings.simplefilter("ignore")
        yield said


def read_through_meshio(path: Path) -> RawMesh:
    """Nodes, all cells, and regions from whatever the format calls its groups.

    Raises:
        MeshError: meshio does not know the ending, or cannot read the file.
    """
    meshio = library()
    names = formats(path)
    if not names:
        raise MeshError(
            f"{path}: no format has the ending '{path.suffix}'; accepted: "
            f"{' '.join(sorted({*endings(), '.trian'}))}"
        )
    reasons = []
    wrong = impossible_tag(path) if "gmsh" in names else None
    if wrong is not None:
        raise MeshError(f"{path}: {wrong}")
    for name in names:
        with quiet() as said:
            try:
                with finite(path, name) as file:
                    mesh = meshio.read(file, file_format=name)
            except (Exception, SystemExit) as error:  # meshio's readers raise anything
                reasons.append(_reason(name, error, said.getvalue()))
                continue
        if "not closed" in said.getvalue():
            raise MeshError(f"{path}: a section of the {name} file has no end; is it truncated?")
        return _raw(path, mesh, said.getvalue())
    raise MeshError(f"{path} cannot be read as {' or '.join(names)} ({reasons[0]})")


def _reason(name: str, error: BaseException, said: str) -> str:
    """Why a format's reader gave up, in one line."""
    if isinstance(error, UnicodeDecodeError):
        return "it holds bytes that are not text where text is expected; is it damaged?"
    if isinstance(error, (KeyError, IndexError)):
        return (
            f"a cell or a set names what is not in the file: {' '.join(str(error).split())[:100]}"
        )
    if isinstance(error, MemoryError):
        return "it announces more numbers than the memory holds; is one of its counts damaged?"
    if isinstance(error, SystemExit):  # then what it printed holds the reason, before its verdict
        text = said.replace("\n", " ").split("Error:")[0]
    else:
        text = str(error)
    text = " ".join(text.split())
    text = text.rstrip(".") or "it does not follow the format"
    kind = "" if type(error).__name__ in ("ReadError", "SystemExit") else type(error).__name__
    return f"{kind}: {text[:160]}" if kind else text[:160]


def _raw(path: Path, mesh: Any, said: str) -> RawMesh:
    blocks = []
    for block in mesh.cells:
        try:
            nodes = np.array(block.data, dtype=np.int64).reshape(len(block.data), -1)
        except ValueError:
            raise MeshError(
                f"{path}: found cells of type '{block.type}' with different numbers of nodes; "
                "cells of a fixed number of nodes are accepted"
            ) from None
        blocks.append((block.type, nodes))
    raw = RawMesh(np.asarray(mesh.points), blocks, _regions(mesh))
    if said.strip():
        raw.notes.append("meshio: " + " ".join(said.split()))
    return raw


def _regions(mesh: Any) -> dict[str, list[NDArray[np.bool_]]]:
    """Regions from cell data, then from cell sets."""
    found: dict[str, list[NDArray[np.bool_]]] = {}
    for name, data in mesh.cell_data.items():
        values = [np.asarray(block) for block in data]
        if any(block.ndim != 1 or block.dtype.kind not in "iub" for block in values):
            if name not in _TAGS or any(block.ndim != 1 for block in values):
                continue
            values = [np.nan_to_num(block).astype(np.int64) for block in values]
        if name.startswith(REGION_MARK):
            found[name.removeprefix(REGION_MARK)] = [block != 0 for block in values]
        elif name in _TAGS:
            found |= _tagged(mesh, name, values)
    sizes = [len(block.data) for block in mesh.cells]
    for name, members in mesh.cell_sets.items():
        if not name.startswith("gmsh:") and len(members) == len(sizes):
            found[name] = [_mask(of, size) for of, size in zip(members, sizes, strict=True)]
    return found


def _tagged(mesh: Any, tag: str, values: list[NDArray[Any]]) -> dict[str, list[NDArray[np.bool_]]]:
    """Regions of numbered cells; Gmsh's physical groups are numbered for each dimension anew."""
    if tag != "gmsh:physical":
        return tagged_regions(values, _names(mesh, tag), ignore_zero=_TAGS[tag])
    found: dict[str, list[NDArray[np.bool_]]] = {}
    for m in (3, 2, 1):
        own = [
            of if dimension(block.type) == m else np.zeros_like(of)
            for of, block in zip(values, mesh.cells, strict=True)
        ]
        for name, masks in tagged_regions(own, _physical(mesh, m), ignore_zero=True).items():
            before = found.get(name, [np.zeros(len(mask), dtype=bool) for mask in masks])
            found[name] = [a | b for a, b in zip(before, masks, strict=True)]
    return found


def _physical(mesh: Any, of_dimension: int) -> dict[int, str]:
    """Names of Gmsh's physical groups of a dimension by their numbers."""
    return {
        int(value[0]): name
        for name, value in mesh.field_data.items()
        if np.size(value) == 2 and int(value[1]) == of_dimension
    }


def _names(mesh: Any, tag: str) -> dict[int, str]:
    """Names of the numbers of regions: the families of MED."""
    if tag == "cell_tags":
        families: Mapping[int, list[str]] = getattr(mesh, "cell_tags", {})
        return {number: " ".join(names) for number, names in families.items()}
    return {}


def _mask(members: Any, size: int) -> NDArray[np.bool_]:
    mask = np.zeros(size, dtype=bool)
    if members is not None and np.size(members):
        mask[np.asarray(members, dtype=np.int64)] = True
    return mask


def region_marks(
    blocks: tuple[Any, ...], regions: Mapping[str, NDArray[np.int32]], handled: tuple[str, ...]
) -> dict[str, list[NDArray[np.int32]]]:
    """Cell data that keep the regions: for each block 1 where a cell is in the region."""
    marks: dict[str, list[NDArray[np.int32]]] = {}
    for name, cells in regions.items():
        first, columns = 0, []
        for block in blocks:
            column = np.zeros(len(block), dtype=np.int32)
            if block.type in handled and dimension(block.type) == 3:
                inside = cells[(cells >= first) & (cells < first + len(block))]
                column[inside - first] = 1
                first += len(block)
            columns.append(column)
        marks[REGION_MARK + name] = columns
    return marks
