"""Cuts while a simulation runs, what is there after them, and the way back."""

from __future__ import annotations

import dataclasses
import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tissu.cutting.blade import Blade, Place, inside_of, surface_of
from tissu.cutting.material import centres_of
from tissu.cutting.report import CutReport, Piece, cut_report
from tissu.errors import ParameterError
from tissu.mesh import CellBlock, Mesh
from tissu.simulation import following, repairing
from tissu.simulation.remains import Remains
from tissu.simulation.severing import Severing
from tissu.simulation.snapping import snapping
from tissu.simulation.track import anchor_again, places_in

if TYPE_CHECKING:
    from tissu import _core as core
    from tissu.compile import Check
    from tissu.front import Scene
    from tissu.scene.load import Load, Where

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

__all__ = ["Mark"]

_NEAREST = 0.02
"""A crossing within this share of an edge from its end goes to the end."""


@dataclass(frozen=True, slots=True, eq=False)
class Mark:
    """A state to which `Simulation.rewind` returns; kept in memory only."""

    _core: core.Mark
    _owner: object
    _meshes: dict[str, Mesh]
    _steps: int
    _unconverged: tuple[int, str]
    _compiled: tuple[Any, ...]
    _severed: Mapping[str, Ints]
    time: float
    """simulated time [s]"""

    def __repr__(self) -> str:
        """When it is."""
        return f"Mark(at t = {self.time:.6g} s)"


class Cutting(Remains, Severing):
    """The part of a simulation that cuts its bodies and its tissue."""

    scene: Scene
    _core: core.Simulation
    _steps: int
    _unconverged: tuple[int, str]
    _late_cuts: tuple[CutReport, ...]
    _world: core.World
    _check: Check
    _loads: Sequence[tuple[Load, Where]]
    _physics_known: dict[str, Any] | None

    if TYPE_CHECKING:

        @property
        def positions(self) -> Mapping[str, Floats]: ...
        def _require_body(self, name: str) -> None: ...
        def _follow_cells(self, body: str) -> None: ...
        @property
        def stable_step(self) -> float: ...
        def _lay_views(self) -> None: ...

    def cut(self, body: str, blade: Blade, *, refine: bool = False) -> CutReport:
        """Cut a body along a surface in present space, between two steps.

        Each cell that the blade divides is replaced by one undistorted copy for each part, with the
        share of the material in that part (virtual nodes: Molino et al. 2004). So mass, momenta,
        kinetic and elastic energy do not change. With `editing: {method: subdivide}` the cells are
        divided instead, and new nodes lie on the cut. With `{method: snap}` nodes move onto the cut
        first, where they may. Nodes and cells keep their numbers; new ones follow the last.
        `surface` and `material` give the cut itself.

        Points of connective tissue permanently lose the frames and nodes beyond the blade. Their
        weights are computed again from those that remain; mass and momenta do not change.

        Args:
            body: its name, or that of a tissue.
            blade: `ts.Plane` (all of the body), `ts.Disc`, `ts.Triangles` or `ts.Sweep`.
            refine: divide cells that a narrow blade pierces without crossing an edge.

        Returns:
            The report of the cut; empty if the blade met nothing.

        Raises:
            ParameterError: the scene was compiled without `editing: true`; no such body, or one
                that cannot be cut, with the reason; a node that is not at a finite place; a blade
                without area; no room for the new nodes; in a static scene, pieces that neither a
                support nor a contact holds. Then nothing has changed.
        """
        self._require_editing(body)
        self._require_finite(body)
        if not isinstance(refine, bool | np.bool_):
            raise ParameterError(f"found refine={refine!r} of a cut; True and False are accepted")
        if body in self._links:
            return self._sever(body, blade)
        sweep = surface_of(blade, self.positions[body])
        return self._cut_along(body, sweep, refine=bool(refine))

    def ablate(self, body: str, place: Place) -> CutReport:
        """Remove the cells whose centre of material lies in a region of present space.

        Cells that share only an edge or a node come apart, unlike after `remove_cells`. For tissue,
        the points that lie in the region are removed.

        Args:
            body: its name, or that of a tissue.
            place: a sphere, a capsule or a box.

        Raises:
            ParameterError: see `cut`; no cell would remain.
        """
        self._require_editing(body)
        self._require_finite(body)
        if body in self._links:
            return self._take_points(body, place)
        centres, numbers = centres_of(self.material(body))
        return self._ablate_cells(body, numbers[inside_of(place, centres)], len(numbers))

    def _require_finite(self, body: str) -> None:
        """Refuse a body of which a node is nowhere."""
        lost = np.flatnonzero(~np.isfinite(self.positions[body]).all(axis=1))
        if len(lost):
            x, y, z = self.positions[body][lost[0]]
            raise ParameterError(
                f"found node {lost[0]} of '{body}' at ({x:g}, {y:g}, {z:g}) m, which is not "
                "finite; a body whose nodes are all somewhere is accepted"
            )

    def _ablate_cells(self, body: str, cells: Ints, count: int, *, by: str = "") -> CutReport:
        """Take away cells out of `count` that there are."""
        if len(cells) == count:
            raise ParameterError(f"that would leave no cell of body '{body}'; keep at least one")
        gone = np.unique(cells).astype(np.int32)
        return self._made(
            body, lambda: self._core.ablate(body=body, cells=gone), by=by, ablated=True
        )

    def _cut_along(
        self,
        body: str,
        sweep: core.Sweep,
        *,
        refine: bool = False,
        by: str = "",
        nearest: float = _NEAREST,
        goes_on: bool = False,
    ) -> CutReport:
        """Cut; `nearest`: share of an edge from its end to go there; `goes_on`: no repair yet."""
        snaps = self.scene.editing is not None and self.scene.editing.snaps(body)
        repairs = not goes_on and repairing.repairs(self, body)  # type: ignore[arg-type]
        if repairs:
            self._core.require_repair(body)
        moves = (snaps or repairs) and self.scene.instruments
        rows = places_in(self, body) if moves else {}  # type: ignore[arg-type]
        report = self._made(
            body,
            lambda: self._core.cut(
                body=body,
                sweep=sweep,
                t0=nearest,
                refine=refine,
                divide=self._divides(body),
                **snapping(self, body),  # type: ignore[arg-type]
            ),
            by=by,
            repairs=repairs,
        )
        if rows and (report.nodes_moved or report.repairs):
            anchor_again(self, body, rows)  # type: ignore[arg-type]
        return report

    def _divides(self, body: str) -> bool:
        return self.scene.editing is not None and self.scene.editing.divides(body)

    def mark(self) -> Mark:
        """Store the present state, cuts included; `rewind` returns to it any number of times.

        The solver drops its memory of earlier steps, so that a run from here and one after `rewind`
        have the same bits.
        """
        compiled = (self.scene, self._world, self._check, self._loads)
        return Mark(
            self._core.mark(),
            self,
            dict(self._meshes),
            self._steps,
            self._unconverged,
            compiled,
            dict(self._severed),
            self._core.time,
        )

    def rewind(self, mark: object) -> None:
        """Return to a mark: state, time, cells, cuts, and the parameters at that time.

        Raises:
            ParameterError: it is a mark of another simulation.
        """
        if not isinstance(mark, Mark) or mark._owner is not self:
            raise ParameterError(
                "found a mark of another simulation; one that this simulation made is accepted"
            )
        self._core.rewind(mark._core)
        self._meshes.become(mark._meshes)
        self._steps = mark._steps
        self._unconverged = mark._unconverged
        self._late_cuts = ()
        self.scene, self._world, self._check, self._loads = mark._compiled
        self._physics_known = None
        self._become_severed(mark._severed)
        self._lay_views()

    def _made(
        self, body: str, make: Any, *, by: str, ablated: bool = False, repairs: bool = False
    ) -> CutReport:
        """Make a cut and follow it; go back where it leaves a static body with free pieces."""
        start = time.perf_counter()
        grabbed = self.scene.grabbing and following.grabs_of(self._core, body)
        mesh_before = self._meshes[body] if grabbed else None
        way_back = self._way_back()
        made = make()
        met = bool(made["cells_cut"] or made["cells_gone"] or made["nodes_moved"])
        if met:
            self._follow_cells(body)
        if met and repairs:
            made = repairing.with_repair(made, repairing.repaired(self, body))  # type: ignore[arg-type]
            self._follow_cells(body)
        pieces = self.pieces(body)
        self._refuse_free_pieces(body, pieces, way_back if met else None)
        released: tuple[int, ...] = ()
        if met and mesh_before is not None:
            released = following.follow(
                self._core,
                body,
                self._meshes[body],
                copied=made["copied"],
                before=None if ablated else mesh_before,
                material=lambda: self.material(body),
            )
        return cut_report(
            body,
            made,
            by=by,
            ablated=ablated,
            pieces=pieces,
            released=released,
            stable_step=self.stable_step if met and self._divides(body) else math.inf,
            milliseconds=1e3 * (time.perf_counter() - start),
        )

    def _way_back(self) -> Any:
        """A mark of the core in a static scene, whose cuts may have to be undone; else None."""
        return self._core.mark() if self.scene.step.type == "static" else None

    def _refuse_free_pieces(self, body: str, pieces: Sequence[Piece], way_back: Any) -> None:
        """Go back and refuse a cut that leaves a piece of a static body that nothing holds.

        Whether contacts hold it, the step finds, as in a scene that was compiled so.
        """
        free = [piece for piece in pieces if not piece.held]
        if way_back is None or not free or body in self.touching:
            return
        self._core.rewind(way_back)
        self._follow_cells(body)
        raise ParameterError(
            f"the cut would leave {len(free)} of {len(pieces)} pieces of body '{body}' without "
            f"support ({free[0]!r}), which has no equilibrium; hold it, or take an implicit "
            "method in time"
        )


def cut_mesh(
    rest: Mesh, runs: list[Any], roots: Ints, places: Floats, *, moved: bool = False
) -> Mesh:
    """The mesh of the cells of a body that was cut, in ascending number, at rest.

    Args:
        rest: of the first day.
        runs: type, numbers, origins, shares and nodes of runs of cells.
        roots: the first day's node of each node; -1 of those that a blade put on an edge.
        places: of all nodes at rest.
        moved: whether cuts have moved nodes at rest.
    """
    origins = np.concatenate([run[2] for run in runs])
    regions = {
        name: np.flatnonzero(np.isin(origins, cells)).astype(np.int32)
        for name, cells in rest.regions.items()
    }
    return dataclasses.replace(
        rest,
        points=places if moved else np.where(roots[:, None] < 0, places, rest.points[roots]),
        cells=tuple(CellBlock(type=run[0], nodes=run[4]) for run in runs),
        regions=regions,
        border_regions={},
        as_listed=True,
    )
