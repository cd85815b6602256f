"""The bodies of a scene with other cells: more or fewer, of another order or family."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from fractions import Fraction
from math import floor
from typing import TYPE_CHECKING

from tissu.errors import MeshError
from tissu.mesh import Mesh, into_quadratic, refined
from tissu.mesh.cell import cell_table
from tissu.scene.bar import BarMesh, bar_dimension
from tissu.scene.selection import Nodes

if TYPE_CHECKING:
    from tissu.front import Scene
    from tissu.scene import Body
    from tissu.scene.load import Load
    from tissu.scene.support import Support

SCALES = tuple(Fraction(n, 12) for n in (3, 4, 6, 8, 9, 12, 18, 24, 36, 48))
"""Numbers of cells along each edge of a body, over those of the scene, that are tried."""

_QUADRATIC = {
    "tetra": "tetra10",
    "hexahedron": "hexahedron20",
    "wedge": "wedge15",
    "pyramid": "pyramid13",
    "triangle": "triangle6",
    "quad": "quad8",
    "line": "line3",
}
_LINEAR = {rich: plain for plain, rich in _QUADRATIC.items()} | {
    "hexahedron27": "hexahedron",
    "quad9": "quad",
}
FAMILIES = ("hexahedron", "quad")
"""Families of cells that are richer than others of their dimension, with the same nodes."""

Source = BarMesh | Mesh | None  # None: the body's own


class Resolutions:
    """Makes the bodies of a scene at other resolutions, each mesh once.

    Attributes:
        order: of the scene's own cells: 2 where every body that can change has quadratic ones.
        fixed: bodies that stay as they are, with the reason.
        families: richer ones that a generated bar of the scene may have in place of its own.
    """

    def __init__(self, scene: Scene, meshes: Mapping[str, Mesh]) -> None:
        self._scene = scene
        self._made: dict[tuple[str, Fraction, int, str], Source] = {}
        self._meshes = meshes
        self.fixed: dict[str, str] = {}
        self._makers: dict[str, Callable[[Fraction, int, str], Source]] = {}
        for name, body in scene.bodies.items():
            self._plan(name, body)
        orders = {_order(meshes[name]) for name in self._makers}
        self.order = min(orders, default=1)
        bars = [scene.bodies[name].mesh for name in self._makers]
        self.families = tuple(family for family in FAMILIES if any(_gains(b, family) for b in bars))

    def bodies(self, scale: Fraction, order: int, family: str = "") -> dict[str, Body] | None:
        """The bodies with `scale` times the cells along each edge, of an order (1 or 2).

        Args:
            scale: cells along each edge over those of the scene.
            order: of the cells.
            family: one of `families` for the bars that gain by it; empty: the scene's own.

        Returns:
            None where no mesh of these can be made, or all are the same as at another scale.
        """
        if family and family not in self.families:
            return None
        if scale == 1 and order == self.order and not family:
            return dict(self._scene.bodies)
        found = dict(self._scene.bodies)
        changed = False
        for name in self._makers:
            source = self._source(name, scale, order, family)
            same = source is None or source == found[name].mesh
            if same and (scale != 1 or _order(self._meshes[name]) != order):
                return None
            if not same:
                found[name] = found[name].replace(mesh=source)
                changed = True
        return found if changed else None

    @property
    def can_change(self) -> bool:
        """Whether there are other cells for any of the bodies."""
        return bool(self._makers)

    def exact(self, scale: Fraction) -> bool:
        """Whether all cells are `scale` times as many along each edge, none of them rounded."""
        counts = [
            count * scale
            for name in self._makers
            for count in getattr(self._scene.bodies[name].mesh, "cells", ())
            if isinstance(self._scene.bodies[name].mesh, BarMesh)
        ]
        return all(count.denominator == 1 for count in counts)

    def _source(self, name: str, scale: Fraction, order: int, family: str) -> Source:
        key = (name, scale, order, family)
        if key not in self._made:
            try:
                self._made[key] = self._makers[name](scale, order, family)
            except MeshError:
                self._made[key] = None
        return self._made[key]

    def _plan(self, name: str, body: Body) -> None:
        scene = self._scene
        supports: list[Support | Load] = [*scene.fixed, *scene.prescribed, *scene.loads]
        if any(isinstance(s.on, Nodes) and s.body == name for s in supports):
            self.fixed[name] = "nodes of it are selected by their numbers"
        elif body.start is not None and body.start.shape == "random":
            self.fixed[name] = "it begins at random places of its nodes"
        elif isinstance(body.mesh, BarMesh):
            bar = body.mesh
            self._makers[name] = lambda scale, order, family: _bar(bar, scale, order, family)
        elif self._meshes[name].thin_blocks:
            self.fixed[name] = "its sheets and lines come from a mesh that is not a bar"
        else:
            mesh = self._meshes[name]
            self._makers[name] = lambda scale, order, family: _mesh(mesh, scale, order)


def _order(mesh: Mesh) -> int:
    """2 where all cells have nodes in the middles of their edges."""
    table = cell_table()
    quadratic = (
        table[block.type].order > 1 if block.type in table else block.type in _LINEAR
        for block in mesh.body_blocks
    )
    return 2 if all(quadratic) else 1


def _gains(mesh: object, family: str) -> bool:
    """Whether a bar has cells of the family's dimension, but of another family."""
    if not isinstance(mesh, BarMesh) or mesh.segments is not None:
        return False
    return bar_dimension(mesh.cell) == bar_dimension(family) and not mesh.cell.startswith(family)


def _bar(bar: BarMesh, scale: Fraction, order: int, family: str) -> BarMesh | None:
    counts = [count * scale for count in bar.cells]
    if bar.segments is not None:
        same = order == (2 if _segments_are_quadratic(bar.segments) else 1)
        if not same or any(count.denominator > 1 for count in counts):
            return None
        return bar.replace(cells=[int(count) for count in counts])
    cells = [max(floor(count + Fraction(1, 2)), 1) if count else 0 for count in counts]
    own = family if family and _gains(bar, family) else bar.cell
    cell = (_QUADRATIC if order == 2 else _LINEAR).get(own, own)
    changes = {} if cell == bar.cell else {"cell": cell}
    unsplit = {"split": "six"} if own != bar.cell and bar.split != "six" else {}
    return bar.replace(cells=cells, **changes, **unsplit)


def _segments_are_quadratic(segments: str) -> bool:
    from tissu.mesh.segment import parse_segments

    return cell_table()[parse_segments(segments)[0][0]].order > 1


def _mesh(mesh: Mesh, scale: Fraction, order: int) -> Mesh | None:
    """A mesh of a file, halved once or twice, its cells made quadratic; never made coarser."""
    if scale not in (1, 2, 4) or (_order(mesh), order) == (2, 1):
        return None
    if _order(mesh) == 2:
        return None if scale != 1 else mesh
    found = mesh
    for _ in range(int(scale).bit_length() - 1):
        found = refined(found)
    if order == 2:
        found = into_quadratic(found)
    return None if found is mesh else dataclasses.replace(found, source=None)
