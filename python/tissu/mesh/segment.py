"""Segments of a bar: what each is made of, and how it meets its neighbours."""

from __future__ import annotations

import reprlib
from collections.abc import Sequence
from dataclasses import dataclass

from tissu.errors import ParameterError
from tissu.mesh.cell import cell_table, handled_types, linear_type

ALIASES = {
    "tet4": "tetra",
    "tet10": "tetra10",
    "hex8": "hexahedron",
    "hex20": "hexahedron20",
    "hex27": "hexahedron27",
    "wedge6": "wedge",
    "pyramid5": "pyramid",
}
"""Names of cell types that say the number of nodes -> meshio's."""


@dataclass(frozen=True, slots=True)
class Segment:
    """A piece of a bar along x.

    Attributes:
        cell: type as meshio names it.
        region: name of the region of its cells.
        left: whether the face towards -x is cut into quads; False: triangles, or no matter.
        right: the same towards +x.
        lying: of wedges, whether their triangles look along x.
    """

    cell: str
    region: str
    left: bool
    right: bool
    lying: bool

    @property
    def base(self) -> str:
        """The linear cell with the same corners."""
        return linear_type(self.cell)


def parse_segments(text: str) -> list[tuple[str, str]]:
    """Pairs (cell type, label) from text such as "wedge6:stvk, hex8:stvk, tet4:hooke".

    Raises:
        ParameterError: a part names no cell type.
    """
    parts = [part.strip() for part in text.split(",")]
    pairs = [part.partition(":")[::2] for part in parts]
    return [(_named(cell.strip()), label.strip()) for cell, label in pairs]


def segments_of(pairs: Sequence[tuple[str, str]]) -> list[Segment]:
    """Segments that know their neighbours; numbered from 1 in the names of their regions.

    Wedges between tetrahedra lie with their triangles towards them. Elsewhere hexahedra, pyramids
    and wedges show quads, which tetrahedra meet with a layer of pyramids.

    Raises:
        ParameterError: no pairs, no segment, no such cell type, or types whose middle nodes do not
            match.
    """
    _require_pairs(pairs)
    cells = [_named(cell) for cell, _ in pairs]
    _require_alike(cells)
    bases = [linear_type(cell) for cell in cells]
    lying = [_lies(bases, i) for i in range(len(bases))]
    quads = [base != "tetra" and not lies for base, lies in zip(bases, lying, strict=True)]
    return [
        Segment(
            cell=cells[i],
            region=" ".join(filter(None, (str(i + 1), cells[i], pairs[i][1]))),
            left=i > 0 and quads[i - 1],
            right=i + 1 < len(cells) and quads[i + 1],
            lying=lying[i],
        )
        for i in range(len(cells))
    ]


def _require_pairs(pairs: object) -> None:
    accepted = "a list of pairs (cell type, label) is accepted, such as [('hex8', 'a')]"
    if not isinstance(pairs, (list, tuple)):
        raise ParameterError(f"found the segments {reprlib.repr(pairs)}; {accepted}")
    for pair in pairs:
        two = isinstance(pair, (list, tuple)) and len(pair) == 2
        if not two or not all(isinstance(word, str) for word in pair):
            raise ParameterError(f"found the segment {reprlib.repr(pair)}; {accepted}")


def _named(cell: str) -> str:
    name = ALIASES.get(cell, cell)
    if name not in handled_types():
        accepted = ", ".join((*handled_types(), *ALIASES))
        raise ParameterError(f"found segment of cell type '{cell}'; {accepted} are accepted")
    return name


def _require_alike(cells: list[str]) -> None:
    """Middle nodes on both sides of every face, or on neither."""
    if not cells:
        raise ParameterError("found no segment of the bar; one or more are accepted")
    orders = {cell_table()[cell].order for cell in cells}
    centred = {cell == "hexahedron27" for cell in cells}
    if len(orders) > 1 or len(centred) > 1:
        raise ParameterError(
            f"found segments of {', '.join(dict.fromkeys(cells))}, whose middle nodes do not "
            "match; accepted: all linear, all quadratic but hexahedron27, or hexahedron27 alone"
        )


def _lies(bases: list[str], i: int) -> bool:
    """Whether wedges, those in segments beside them included, meet tetrahedra and nothing else."""
    if bases[i] != "wedge":
        return False
    before = next((base for base in reversed(bases[:i]) if base != "wedge"), None)
    after = next((base for base in bases[i + 1 :] if base != "wedge"), None)
    return {before, after} - {None} == {"tetra"}
