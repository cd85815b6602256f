"""`tissu mesh bar` and `convert`: what their options mean, and the mesh that is written."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, cast

from tissu import units
from tissu.counted import counted
from tissu.errors import ParameterError
from tissu.mesh import Mesh, bar_mesh, mixed_bar_mesh, write_mesh
from tissu.mesh.segment import parse_segments

if TYPE_CHECKING:
    from tissu.mesh.bar import Split

Three = tuple[float, float, float]
LONGEST_ORGAN = 1.0
"""m: a mesh above it, read as metres, may be in millimetres"""


@dataclass(frozen=True, slots=True)
class Bar:
    """The box of a bar: lengths [m], numbers of grid cells, smallest corner [m]."""

    size: Three
    cells: tuple[int, int, int]
    origin: Three


def lengths(option: str, texts: Sequence[str]) -> Three:
    """Three lengths [m], each a number in metres or a text with its unit.

    Raises:
        ParameterError: one of them is not a length; says of which option.
    """
    try:
        x, y, z = (units.LENGTH(text) for text in texts)
    except ParameterError as error:
        raise ParameterError(f"option {option}: {error}") from None
    return x, y, z


def made_bar(bar: Bar, *, cell: str | None, split: str | None, segments: str | None) -> Mesh:
    """The bar of like cells, or of segments; None: the option is not given.

    Raises:
        ParameterError: options that are not accepted, or not together.
    """
    size, cells, origin = bar.size, bar.cells, bar.origin
    if segments is None:
        wanted = cast("Split", split or "six")  # bar_mesh says when it is none
        return bar_mesh(size=size, cells=cells, cell=cell or "tetra", split=wanted, origin=origin)
    if cell is not None or split is not None:
        given = "--cell" if cell is not None else "--split"
        raise ParameterError(
            f"found {given} and --segments; the segments name their cells: leave {given} out"
        )
    pairs = parse_segments(segments)
    return mixed_bar_mesh(size=size, cells=cells, segments=pairs, origin=origin)


def described(mesh: Mesh, *, in_metres: bool) -> str:
    """Size, quality and faults of a mesh; a doubt where its lengths were taken as metres."""
    low, high = mesh.bounds
    size, text = float((high - low).max()), str(mesh.quality())
    if in_metres and size > LONGEST_ORGAN:
        text += f"\n  note           {size:.4g} m is more than any organ; in millimetres? --unit mm"
    return text


def written(mesh: Mesh, output: Path) -> None:
    """Writes the mesh and says what it holds."""
    write_mesh(mesh, output)
    cells = mesh.cell_count or sum(len(block) for block in mesh.cells)
    print(f"{output}: {counted(mesh.node_count, 'node')}, {counted(cells, 'cell')}")
