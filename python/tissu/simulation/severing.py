"""Cuts of connective tissue: which links a blade severs, and what goes on without them."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tissu import _core
from tissu.counted import counted
from tissu.cutting.report import CutReport, Piece
from tissu.errors import ParameterError, TissuError
from tissu.simulation import grab as kept
from tissu.simulation import hanging
from tissu.simulation.lumped import give_back_to, momenta_of
from tissu.simulation.twist import joined, labels_of, rows_of

if TYPE_CHECKING:
    from tissu import _core as core
    from tissu.cutting.blade import Blade, Place
    from tissu.front import Scene
    from tissu.mesh import Mesh
    from tissu.simulation.meshes import Meshes
    from tissu.ties import Left, Links

Floats = NDArray[np.float64]
Pairs = NDArray[np.int32]

__all__: list[str] = []

_NONE = np.empty((0, 2), dtype=np.int32)
_ROUND_OFF = 1e-9
"""of a step, above the stable one of an explicit method"""


class Severing:
    """The part of a simulation that cuts its tissue."""

    scene: Scene
    _core: core.Simulation
    _links: dict[str, Links]
    _severed: dict[str, Pairs]
    _lefts: dict[str, tuple[Pairs, Left]]
    _rest_points: dict[str, Floats]
    _rest: dict[str, Mesh]
    _meshes: Meshes

    if TYPE_CHECKING:

        @property
        def positions(self) -> Mapping[str, Floats]: ...

        @property
        def touching(self) -> tuple[str, ...]: ...

    def _sever(self, tissue: str, blade: Blade) -> CutReport:
        """Cut a tissue along a surface in present space."""
        from tissu.cutting.blade import surface_of

        places = np.concatenate([self._core.points(tissue), self._origins(tissue)])
        return self._lose(tissue, self._crossed(tissue, surface_of(blade, places)), by="")

    def _sever_along(self, tissue: str, sweep: core.Sweep, *, by: str) -> CutReport | None:
        """Sever the links that a blade crosses; None where there are none."""
        pairs = self._crossed(tissue, sweep)
        return self._lose(tissue, pairs, by=by) if len(pairs) else None

    def _crossed(self, tissue: str, sweep: core.Sweep) -> Pairs:
        """The links that a blade crosses."""
        links, severed = self._links[tissue], self._pairs(tissue)
        pairs = links.without(severed)
        there = np.unique(pairs[:, 0])
        now = self._core.points(tissue)[np.searchsorted(there, pairs[:, 0])]
        origins = self._origins(tissue)[pairs[:, 1]]
        crossed = _core.severed(sweep=sweep, begins=np.ascontiguousarray(origins), ends=now)
        return pairs[crossed]

    def _take_points(self, tissue: str, place: Place, *, by: str = "") -> CutReport:
        """Take away the points of a tissue that lie in a region of present space."""
        from tissu.cutting.blade import inside_of

        return self._take(tissue, inside_of(place, self._core.points(tissue)), by=by)

    def _take(self, tissue: str, inside: NDArray[np.bool_], *, by: str = "") -> CutReport:
        pairs = self._links[tissue].without(self._pairs(tissue))
        gone = np.unique(pairs[:, 0])[inside]
        return self._lose(tissue, pairs[np.isin(pairs[:, 0], gone)], by=by, ablated=True)

    def _lose(self, tissue: str, pairs: Pairs, *, by: str, ablated: bool = False) -> CutReport:
        """Go on without some links; nothing has changed where it is refused."""
        start = time.perf_counter()
        if tissue in self.touching:
            raise ParameterError(
                f"'{tissue}' is not cut: its surface meets others, and follows no cut; leave it "
                "out of the contacts"
            )
        links, before = self._links[tissue], self._pairs(tissue)
        there = self._left(tissue)
        if not len(pairs):
            pieces = self._tissue_pieces(tissue)
            return _report(tissue, by, pieces=pieces, start=start, ablated=ablated)
        severed = np.unique(np.concatenate([before, pairs]), axis=0)
        left = links.left(severed)
        gone = np.setdiff1d(there.kept, left.kept)
        idle = self._require_severable(tissue, there, left)
        world = self._with_points(self._core.world, tissue, left, self.positions[tissue])
        energy, momenta = self._core.energy(), rows_of(self._core).momenta()
        stable = self._stable_mark()
        touched = np.intersect1d(np.unique(pairs[:, 0]), left.kept)
        had = momenta_of(self, tissue, there, touched)
        self._core.replace_world(world=world)
        self._core.forget_forces()
        give_back_to(self, tissue, left, touched, had - momenta_of(self, tissue, left, touched))
        self._require_stable(tissue, stable)
        self._severed[tissue], self._lefts[tissue] = severed, (severed, left)
        self._rest_points[tissue] = links.points[left.kept]
        now, change = self._core.energy(), rows_of(self._core).momenta() - momenta
        return _report(
            tissue,
            by,
            pieces=self._tissue_pieces(tissue),
            start=start,
            ablated=ablated,
            links_severed=len(pairs),
            points_gone=tuple(int(p) for p in gone),
            volume_change=-float(links.volumes[gone].sum()),
            mass_change=-float(links.masses[gone].sum()),
            momentum_change=change[:3],
            angular_momentum_change=change[3:],
            kinetic_energy_change=now["kinetic"] - energy["kinetic"],
            elastic_energy_change=now["elastic"] - energy["elastic"],
            released=self._let_go(tissue, idle),
            relaid=True,
        )

    def _require_severable(self, tissue: str, there: Left, left: Left) -> NDArray[np.int64]:
        """Refuse what has no sequel; returns the frames that no point follows any more."""
        if not len(left.kept):
            raise ParameterError(
                f"that would leave no point of tissue '{tissue}'; keep at least one"
            )
        own = np.arange(self._links[tissue].own)
        idle = np.setdiff1d(own, left.weights.frames)
        first = self._core.body_range(tissue)[0]
        for support in (*self.scene.fixed, *self.scene.prescribed):
            name = support.name
            if name is None or support.body != tissue or not self._core.is_led_live(name):
                continue
            if np.isin(self._core.led_nodes(name), idle + first).any():
                raise ParameterError(
                    f"the cut would take the last point from a frame of the support '{name}', "
                    "which is led live; release it first, or lead it after the cut"
                )
        if self.scene.step.type == "static":
            falling = [self._unsupported(tissue, one) for one in (there, left)]
            if falling[1] > falling[0]:
                raise ParameterError(
                    f"the cut of '{tissue}' would leave "
                    f"{counted(falling[1] - falling[0], 'more part')} of the scene without "
                    "support, which has no equilibrium; hold it, or take an implicit method in time"
                )
        return idle

    def _unsupported(self, tissue: str, left: Left) -> int:
        """How many parts of the scene nothing holds, where a tissue has these points."""
        labels, rows = hanging.labels(self, {tissue: left}), hanging.active(self, {tissue: left})
        return len(np.setdiff1d(labels[rows], hanging.held(self, labels)))

    def _stable_mark(self) -> Any:
        """A way back, where a step may come to be too long for the frames that are left."""
        dt = getattr(self.scene.step, "dt", None)
        stable = self._core.stable_step() if isinstance(dt, float) else np.inf
        if not isinstance(dt, float) or not np.isfinite(stable) or dt > stable:
            return None
        return self._core.mark(), dt

    def _require_stable(self, tissue: str, mark: Any) -> None:
        if mark is None:
            return
        back, dt = mark
        try:
            stable = self._core.stable_step()
        except TissuError:  # it is not a number
            self._core.rewind(back)
            raise
        if dt > stable * (1.0 + _ROUND_OFF):
            self._core.rewind(back)
            raise ParameterError(
                f"the cut of '{tissue}' would leave frames so light or points so stiff that the "
                f"step of {dt:g} s is above the stable one of {stable:.4g} s; take a smaller step, "
                "or an implicit method"
            )

    def _let_go(self, tissue: str, idle: NDArray[np.int64]) -> tuple[int, ...]:
        """Release the grabs of frames that no point follows any more."""
        if not self.scene.grabbing:
            return ()
        grabs, first = kept.records(self._core), self._core.body_range(tissue)[0]
        parted = [n for n, grab in grabs.items() if np.isin(grab.nodes, idle + first).any()]
        if parted:
            kept.keep(self._core, {n: g for n, g in grabs.items() if n not in parted})
        return tuple(parted)

    def _tissue_pieces(self, tissue: str) -> tuple[Piece, ...]:
        """The points of a tissue that hang together by frames that they share, the most first."""
        links, left = self._links[tissue], self._left(tissue)
        weights = left.weights._replace(frames=self._rows(tissue, left)[left.weights.frames])
        groups = labels_of(weights, joined(weights, np.arange(self._core.world.blocks)))
        labels = hanging.labels(self, {})
        held = np.isin(labels_of(weights, labels), hanging.held(self, labels))
        pieces = [
            Piece(
                cells=left.kept[groups == group].astype(np.int32),
                volume=float(links.volumes[left.kept[groups == group]].sum()),
                mass=float(links.masses[left.kept[groups == group]].sum()),
                held=bool(held[groups == group].any()),
            )
            for group in np.unique(groups)
        ]
        return tuple(sorted(pieces, key=lambda piece: -piece.volume))

    def _pairs(self, tissue: str) -> Pairs:
        return self._severed.get(tissue, _NONE)

    def _left(self, tissue: str) -> Left:
        """The points that a tissue has now."""
        pairs = self._pairs(tissue)
        known = self._lefts.get(tissue)
        if known is None or known[0] is not pairs:
            known = self._lefts[tissue] = (pairs, self._links[tissue].left(pairs))
        return known[1]

    def _rows(self, tissue: str, left: Left) -> NDArray[np.int32]:
        """Rows of the unknowns of a tissue's own frames and of the nodes that it shares."""
        first, count = self._core.body_range(tissue)
        others = [self._core.body_range(body)[0] + node for body, node in left.shared]
        return np.array([*range(first, first + count), *others], dtype=np.int32)

    def _origins(self, tissue: str) -> Floats:
        """Where what the points may follow is now (n, 3) [m]."""
        near = [self.positions[body][node] for body, node in self._links[tissue].near]
        return np.concatenate([self.positions[tissue], np.reshape(near, (-1, 3))])

    def _with_points(
        self, world: core.World, tissue: str, left: Left, places: Floats
    ) -> core.World:
        links, weights = self._links[tissue], left.weights
        return world.with_points(
            tissue=tissue,
            shared=left.shared,
            frames=np.ascontiguousarray(weights.frames, dtype=np.int32),
            weights=np.ascontiguousarray(weights.weights),
            gradients=np.ascontiguousarray(weights.gradients),
            positions=np.ascontiguousarray(links.points[left.kept]),
            volumes=np.ascontiguousarray(links.volumes[left.kept]),
            places=np.ascontiguousarray(places),
        )

    def _as_severed(self, world: core.World, places: Mapping[str, Floats]) -> core.World:
        """A world of the first day with the tissue as blades have left it.

        Args:
            world: in which no link is severed.
            places: of the frames of each tissue; those without a point are held there [m].
        """
        for tissue in self._severed:
            world = self._with_points(world, tissue, self._left(tissue), places[tissue])
        return world

    def _become_severed(self, severed: Mapping[str, Pairs]) -> None:
        """Take the severed links of another moment, whose world is there already."""
        self._severed = dict(severed)
        for tissue, links in self._links.items():
            self._rest_points[tissue] = links.points[self._left(tissue).kept]


def _report(
    tissue: str, by: str, *, pieces: tuple[Piece, ...], start: float, **made: Any
) -> CutReport:
    """A report of tissue, which has no cells and no faces."""
    nothing: dict[str, Any] = {
        **dict.fromkeys(("cells_cut", "cells_new", "cells_gone", "nodes_new", "faces_opened"), 0),
        "parts_nothing": False,
        "bridges": 0,
        **dict.fromkeys(("area", "rest_area", "volume_change", "mass_change", "work"), 0.0),
        "momentum_change": np.zeros(3),
        "angular_momentum_change": np.zeros(3),
        "kinetic_energy_change": 0.0,
        "elastic_energy_change": 0.0,
        "links_severed": 0,
        "points_gone": (),
        "unresolved": (),
        "released": (),
        "relaid": False,
        "stable_step": math.inf,
        "nodes_moved": 0,
        "least_quality": math.inf,
        "repairs": None,
    }
    milliseconds = 1e3 * (time.perf_counter() - start)
    return CutReport(
        body=tissue, by=by, pieces=pieces, milliseconds=milliseconds, **{**nothing, **made}
    )
