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
    from tissu.simulation.meshes import Meshes
    from tissu.ties import Links

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

__all__: list[str] = []


class Remains:
    """The part of a simulation that looks at the material of its bodies."""

    scene: Scene
    _core: core.Simulation
    _meshes: Meshes
    _rest: dict[str, Mesh]

    if TYPE_CHECKING:

        @property
        def positions(self) -> Mapping[str, Floats]: ...

        _links: dict[str, Links]

        def _require_body(self, name: str) -> None: ...
        def _tissue_pieces(self, tissue: str) -> tuple[Piece, ...]: ...

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
        """Whether a blade has separated or moved nodes of a body, or divided its cells.

        Raises:
            ParameterError: no body of that name.
        """
        self._require_body(body)
        rest = self._rest.get(body)
        if rest is None:
            return False
        return self._core.body_range(body)[1] > rest.node_count or self._core.moved(body)

    def pieces(self, body: str) -> tuple[Piece, ...]:
        """The connected parts of the material of a body or of a tissue, the largest first.

        Raises:
            ParameterError: no such body; the scene was compiled without `editing: true`.
        """
        self._require_editing(body)
        if body in self._links:
            return self._tissue_pieces(body)
        found = self._core.pieces(body)
        mass, whole = self._core.mass(body), sum(volume for _, volume, _ in found)
        pieces = [
            Piece(cells=cells, volume=volume, mass=mass * volume / whole, held=held)
            for cells, volume, held in found
        ]
        return tuple(sorted(pieces, key=lambda piece: -piece.volume))

    def origin(self, body: str) -> Ints:
        """The original cell (e,) that each cell of `meshes[body]` comes from.

        Raises:
            ParameterError: no such body; the scene was compiled without `editing: true`.
        """
        self._require_editing(body)
        return np.concatenate([run[2] for run in self._core.body_cells(body)])

    def born(self, body: str) -> Ints:
        """The original node (n,) that each node of `meshes[body]` is, or is a copy of.

        -1 for a node that a blade put on an edge, where cuts divide cells; see `made_of`.

        Raises:
            ParameterError: no such body; the scene was compiled without `editing: true`.
        """
        self._require_editing(body)
        return self._core.roots(body)

    def made_of(self, body: str) -> tuple[Ints, Floats]:
        """The original nodes between which each node of `meshes[body]` lies at rest.

        Returns:
            nodes (n, 4), -1 beyond the last, and their weights (n, 4), which sum to 1. A node on an
            edge that a repair made may lie between more than four: it has none, and weights of 0.

        Raises:
            ParameterError: no such body; the scene was compiled without `editing: true`.
        """
        self._require_editing(body)
        _, nodes, weights = self._core.made_of(body)
        return nodes, weights

    def quality(self, body: str, *, rest: bool = False) -> Quality:
        """Measures of the shape of the material's tetrahedra, each 1 for the regular one.

        Cells of other types count as the tetrahedra between their corners.

        Args:
            body: its name.
            rest: measure the rest shape instead of the present one.

        Raises:
            ParameterError: no such body; the scene was compiled without `editing: true`; a body of
                sheets or lines.
        """
        found = self.material(body)
        if not found.mesh.volume_blocks:
            raise ParameterError(
                f"found {_thin(found.mesh)} '{body}'; the quality of bodies of volume cells is "
                "accepted"
            )
        placed = found.mesh if rest else dataclasses.replace(found.mesh, points=found.points)
        cut = into_tetrahedra(placed)
        nodes = np.concatenate([block.nodes for block in cut.volume_blocks])
        return quality_of(cut.points[nodes])

    def _require_editing(self, body: str) -> None:
        self._require_body(body)
        if not self.scene.editing:
            raise ParameterError(
                "the scene was compiled without editing; write editing: true to cut its bodies and "
                "to list their pieces"
            )


def _thin(mesh: Mesh) -> str:
    """What a mesh without volume cells is."""
    return "the lines" if mesh.thin == (1,) else "the sheet"
