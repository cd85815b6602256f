"""A film of the simulations: what is seen at moments of simulated time, written as glTF."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tissu.live_view.body_drawing import normals
from tissu.live_view.colours import BODIES
from tissu.live_view.film_rigid import Look, RigidFilm, instruments, obstacles
from tissu.live_view.gltf import Gltf
from tissu.live_view.surface import Seen, places_of, seen_of

if TYPE_CHECKING:
    from tissu.live_view.stage import Stage
    from tissu.simulation import Simulation

Points = NDArray[np.float32]

EVERY = 1.0 / 30.0
"""Simulated time between two moments at first [s]."""
MOST_MOMENTS = 600
"""Moments of a film; when there are more, every second one goes."""
MOST_POINTS = 20_000_000
"""Places of nodes in all moments together, 12 bytes each; the same."""


@dataclass(slots=True, eq=False)
class Shot:
    """A body in the moments between two changes of its cells.

    Attributes:
        seen: what is seen of it then.
        places: (k, 3) float32 of its nodes in each moment, by the number of the moment.
    """

    seen: Seen
    places: dict[int, Points] = field(default_factory=dict)


class Film:
    """Looks at simulations after their steps, in the thread that owns them.

    Attributes:
        times: of its moments, since it began [s of simulated time].
    """

    def __init__(self, stage: Stage, *, more: Sequence[Look] = ()) -> None:
        """Nothing was seen yet.

        Args:
            stage: where simulations stand beside each other.
            more: what is there beside bodies, obstacles and instruments.
        """
        self.times: dict[int, float] = {}
        self._stage = stage
        self._shots: dict[tuple[int, str], list[Shot]] = {}
        self._rigid = RigidFilm([obstacles, instruments, *more])
        self._every = EVERY
        self._next = 0
        self._before = 0.0  # simulated time of the latest look
        self._passed = 0.0

    def look(self, simulations: Sequence[Simulation], *, last: bool = False) -> None:
        """Keep the present moment, if it is due or the last one."""
        now = simulations[0].time
        if self.times:  # time that was set back begins again where it had come to
            self._passed += now - self._before if now >= self._before else self._every
        self._before = now
        latest = self.times[self._next - 1] if self.times else -np.inf
        due = self._passed >= latest + (1.0 - 1e-9) * self._every
        if self._passed <= latest or not (due or last):
            return
        self._keep(simulations)
        self._thin()

    def write(self, path: Path, *, name: str) -> None:
        """Write it as binary glTF.

        Raises:
            TissuError: it cannot be written.
        """
        gltf = Gltf(name=name, up=self._stage.up)
        for number, ((lane, body), shots) in enumerate(self._shots.items()):
            called = body if lane == 0 else f"{body} (beside)"
            count = len({one for other, one in self._shots if other == 0})
            colour = gltf.colour(body, BODIES[number % count % len(BODIES)])
            place = self._stage.shifts[lane] / self._stage.factor
            nodes = [self._add(gltf, called, shot, colour, place) for shot in shots]
            self._switch(gltf, shots, nodes)
        self._rigid.write(gltf, self.times, self._stage)
        gltf.write(path)

    def _keep(self, simulations: Sequence[Simulation]) -> None:
        self.times[self._next] = self._passed
        for lane, simulation in enumerate(simulations):
            for name in simulation.meshes:
                now = seen_of(simulation, name)
                if not len(now.triangles) and not len(now.lines):
                    continue
                shots = self._shots.setdefault((lane, name), [])
                if not shots or shots[-1].seen is not now:
                    shots.append(Shot(now))
                places = places_of(simulation, name, now).astype(np.float32)
                shots[-1].places[self._next] = places
        self._rigid.keep(self._next, simulations)
        self._next += 1

    def _thin(self) -> None:
        """Keep every second moment where there are too many."""
        points = self._rigid.size + sum(
            len(shot.seen.nodes) * len(shot.places)
            for shots in self._shots.values()
            for shot in shots
        )
        if len(self.times) <= 2 or (len(self.times) <= MOST_MOMENTS and points <= MOST_POINTS):
            return
        kept = list(self.times)[::2]
        self._next, self._every = len(kept), 2.0 * self._every
        self.times = {number: self.times[old] for number, old in enumerate(kept)}
        self._rigid.thin({old: number for number, old in enumerate(kept)})
        for key, shots in self._shots.items():
            for shot in shots:
                found = [(new, shot.places.get(old)) for new, old in enumerate(kept)]
                shot.places = {new: places for new, places in found if places is not None}
            self._shots[key] = [shot for shot in shots if shot.places]

    def _add(
        self, gltf: Gltf, name: str, shot: Shot, colour: int, place: NDArray[np.float64]
    ) -> int:
        """A mesh that moves through the moments of a shot; gives its node."""
        first, *others = shot.places.values()
        triangles, lines = (
            rows.astype(np.uint32) for rows in (shot.seen.triangles, shot.seen.lines)
        )
        facing = normals(first, shot.seen.triangles)
        shown = np.where(
            facing.any(axis=1, keepdims=True), facing, np.array([0, 0, 1], dtype=np.float32)
        )
        corners = {"POSITION": gltf.points(first), "NORMAL": gltf.numbers(shown)}
        targets = [
            {
                "POSITION": gltf.points(at - first),
                "NORMAL": gltf.numbers(normals(at, shot.seen.triangles) - facing),
            }
            for at in others
        ]
        primitives: list[dict[str, Any]] = [
            {"attributes": corners, "indices": gltf.corners(rows), "material": colour, "mode": mode}
            for rows, mode in ((triangles, 4), (lines, 1))
            if len(rows)
        ]
        if targets:
            primitives = [{**one, "targets": targets} for one in primitives]
        node = gltf.mesh(name, primitives, translation=place)
        if targets:
            at = np.array([self.times[number] for number in shot.places], dtype=np.float32)
            weights = np.eye(len(at), dtype=np.float32)[:, 1:]
            gltf.move(node, "weights", gltf.numbers(at, span=True), gltf.numbers(weights.ravel()))
        return node

    def _switch(self, gltf: Gltf, shots: Sequence[Shot], nodes: Sequence[int]) -> None:
        """Show each shot until the next one begins, by its scale."""
        if len(shots) < 2:
            return
        begins = np.array([self.times[min(shot.places)] for shot in shots], dtype=np.float32)
        times = gltf.numbers(begins, span=True)
        for row, node in zip(np.eye(len(shots), dtype=np.float32), nodes, strict=True):
            scales = gltf.numbers(np.repeat(row[:, None], 3, axis=1))
            gltf.move(node, "scale", times, scales, way="STEP")
