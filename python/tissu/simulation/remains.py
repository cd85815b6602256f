"""What is there of the bodies of a simulation, cut or not."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.cutting.material import Material, MaterialSurface, material_now, surface_now
from tissu.cutting.quality import Quality, quality_of
from tissu.cutting.report import Piece
from tissu.errors import ParameterError
from tissu.mesh import Mesh, into_tetrahedra

if TYPE_CHECKING:
    from tissu import _core as core
    from tissu.front import Scene

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

__all__: list[str] = []


class Remains:
    """The part of a simulation that looks at the material of its bodies."""

    scene: Scene
    _core: core.Simulation
    _meshes: dict[str, Mesh]
    _rest: dict[str, Mesh]

    if TYPE_CHECKING:

        @property
        def positions(self) -> Mapping[str, Floats]: ...
        def _require_body(self, name: str) -> None: ...

    def surface(self, body: str) -> MaterialSurface:
        """The surface of the material of a body as it is now.

        Raises:
            ParameterError: no such body; the scene was compiled without `editing: true`.
        """
        self._require_editing(body)
        return surface_now(self._core.material_surface(body), self.positions[body])

    def material(self, body: str) -> Material:
        """The material of a body as a conforming mesh, at rest and now.

        Raises:
            ParameterError: no such body; the scene was compiled without `editing: true`.
        """
        self._require_editing(body)
        found = self._core.material_mesh(body)
        return material_now(found, self._meshes[body].points, self.positions[body])

    def is_cut(self, body: str) -> bool:
        """Whether a blade has parted nodes of a body, so that its cells overlap.

        Raises:
            ParameterError: no body of that name.
        """
        self._require_body(body)
        rest = self._rest.get(body)
        return rest is not None and self._meshes[body].node_count > rest.node_count

    def pieces(self, body: str) -> tuple[Piece, ...]:
        """The connected parts of the material of a body, the largest first.

        Raises:
            ParameterError: no such body; the scene was compiled without `editing: true`.
        """
        self._require_editing(body)
        runs = self._core.body_cells(body)
        held_nodes = np.zeros(self._meshes[body].node_count, dtype=bool)
        held_nodes[self._core.unfree_nodes(body)[1]] = True
        held = np.zeros(1 + max(int(run[1][-1]) for run in runs), dtype=bool)
        for run in runs:
            held[run[1]] = held_nodes[run[4]].any(axis=1)
        whole = self._core.totals(body)
        found = [
            Piece(
                cells=cells,
                volume=volume,
                mass=whole["mass"] * volume / whole["volume"],
                held=bool(held[cells].any()),
            )
            for cells, volume in self._core.pieces(body)
        ]
        return tuple(sorted(found, key=lambda piece: -piece.volume))

    def origin(self, body: str) -> Ints:
        """The cell of the first day (e,) that each cell of `meshes[body]` comes from.

        Raises:
            ParameterError: no such body; the scene was compiled without `editing: true`.
        """
        self._require_editing(body)
        return np.concatenate([run[2] for run in self._core.body_cells(body)])

    def born(self, body: str) -> Ints:
        """The node of the first day (n,) that each node of `meshes[body]` is a copy of, or is.

        Raises:
            ParameterError: no such body; the scene was compiled without `editing: true`.
        """
        self._require_editing(body)
        return self._core.roots(body)

    def quality(self, body: str, *, rest: bool = False) -> Quality:
        """How far the tetrahedra of the material of a body are from the regular one.

        Cells of other types count as the tetrahedra between their corners.

        Args:
            body: its name.
            rest: at rest, in place of now.

        Raises:
            ParameterError: no such body; the scene was compiled without `editing: true`.
        """
        found = self.material(body)
        placed = found.mesh if rest else dataclasses.replace(found.mesh, points=found.points)
        cut = into_tetrahedra(placed)
        nodes = np.concatenate([block.nodes for block in cut.volume_blocks])
        return quality_of(cut.points[nodes])

    def _require_editing(self, body: str) -> None:
        self._require_body(body)
        if not self.scene.editing:
            raise ParameterError(
                "the scene was compiled without editing; write editing: true to cut its bodies"
            )
