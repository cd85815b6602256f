"""What keeps its shape in a film: obstacles, instruments, trocars, with their motions.

A shape is written once, about its own origin; the animation moves, turns and scales its node.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tissu.cutting.kinds import ablator_of
from tissu.live_view.layers.obstacles import COLOUR as OBSTACLE
from tissu.live_view.layers.obstacles import OPACITY
from tissu.live_view.tools.instrument import COLOUR as INSTRUMENT
from tissu.live_view.tools.obstacle import quaternion, tools_of_trocars
from tissu.live_view.turned import capsule

if TYPE_CHECKING:
    from tissu.live_view.gltf import Gltf
    from tissu.live_view.marks import Colour
    from tissu.live_view.stage import Stage
    from tissu.scene.instrument import Instrument
    from tissu.simulation import Simulation

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
ONE, NONE = np.ones(3), np.zeros(3)


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """Triangles or lines of one colour.

    Attributes:
        colour: red, green, blue, 0 to 255.
        points: (n, 3) about its own origin [m].
        corners: (t, 3) places in `points` of triangles, or (l, 2) of lines.
        opacity: 0 to 1.
    """

    colour: Colour
    points: Floats
    corners: Ints
    opacity: float = 1.0


@dataclass(frozen=True, slots=True, eq=False)
class Placed:
    """A shape in the scene at one moment.

    Attributes:
        name: its name, once in a simulation.
        shape: the same object in every moment.
        place: (3,) of its origin [m].
        turn: (3, 3) rotation.
        scale: (3,) factors along its own axes, before the rotation; zeros: it is not there.
    """

    name: str
    shape: Shape
    place: Floats
    turn: Floats
    scale: Floats = field(default_factory=lambda: ONE)


_PARTS = {"translation": slice(3), "rotation": slice(3, 7), "scale": slice(7, 10)}
"""Of a row."""
Look = Callable[["Simulation", int], Iterable[Placed]]
"""Gives what is there, of a simulation and the number of its lane."""


@dataclass(slots=True, eq=False)
class _Track:
    """A shape, and its rows of place (3), quaternion x, y, z, w (4) and scale (3) by moments."""

    shape: Shape
    rows: dict[int, Floats] = field(default_factory=dict)


class RigidFilm:
    """The rigid part of a film."""

    def __init__(self, looks: Sequence[Look]) -> None:
        """Nothing was seen yet.

        Args:
            looks: what is asked in each moment.
        """
        self._looks = looks
        self._tracks: dict[tuple[int, str], _Track] = {}

    @property
    def size(self) -> int:
        """Numbers of all moments together, as places of nodes count."""
        return sum(4 * len(track.rows) for track in self._tracks.values())

    def keep(self, moment: int, simulations: Sequence[Simulation]) -> None:
        """Keep where everything is now."""
        for lane, simulation in enumerate(simulations):
            for look in self._looks:
                for one in look(simulation, lane):
                    track = self._tracks.setdefault((lane, one.name), _Track(one.shape))
                    before = next(reversed(track.rows.values()), None)
                    track.rows[moment] = _row(one, before)

    def thin(self, kept: Mapping[int, int]) -> None:
        """Keep some moments, by their old numbers, under new ones."""
        for track in self._tracks.values():
            track.rows = {kept[old]: row for old, row in track.rows.items() if old in kept}

    def write(self, gltf: Gltf, times: Mapping[int, float], stage: Stage) -> None:
        """Add a node for each thing, and its motion."""
        for (lane, name), track in self._tracks.items():
            if track.rows:
                called = name if lane == 0 else f"{name} (beside)"
                _add(gltf, called, track, times, stage.shifts[lane] / stage.factor)


def obstacles(simulation: Simulation, _lane: int) -> list[Placed]:
    """The obstacles of a scene, each about its middle."""
    found = []
    for name in simulation.obstacles:
        surface = simulation.obstacle_surface(name)
        middle = surface.rest.mean(axis=0)
        own = surface.rest - middle
        place = surface.points.mean(axis=0)
        shape = Shape(OBSTACLE, own, surface.triangles.astype(np.int64), OPACITY)
        found.append(Placed(name, shape, place, _turn(own, surface.points - place)))
    return found


def instruments(simulation: Simulation, _lane: int) -> list[Placed]:
    """The edges of knives and the tips of ablators that no trocar leads."""
    led = tools_of_trocars(simulation)
    return [
        instrument(simulation, name) for name in simulation.scene.instruments if name not in led
    ]


def instrument(simulation: Simulation, name: str, *, there: bool = True) -> Placed:
    """An instrument of a scene, about the origin of its own axes."""
    part, tool = simulation.scene.instruments[name], simulation.instruments[name]
    scale = ONE if there else NONE
    return Placed(name, _shape_of(part), tool.position, tool.rotation, scale)


def _shape_of(part: Instrument) -> Shape:
    """The edge of a knife as lines; the surface of an ablator."""
    points, ablator = part.points(), ablator_of(part)
    if ablator is None:
        steps = np.arange(len(points) - 1)
        return Shape(INSTRUMENT, points, np.stack([steps, steps + 1], axis=1))
    surface, triangles = capsule(points[0], points[-1], ablator.radius)
    return Shape(INSTRUMENT, surface, triangles, OPACITY)


def _turn(rest: Floats, now: Floats) -> Floats:
    """The rotation from places (n, 3) to others, both about their middles (Kabsch 1976)."""
    left, _, right = np.linalg.svd(now.T @ rest)
    sign = np.sign(np.linalg.det(left @ right))
    return np.asarray(left @ np.diag([1.0, 1.0, sign]) @ right)


def _row(one: Placed, before: Floats | None) -> Floats:
    """Its place, quaternion and scale; what is not there stays where it was."""
    if before is not None and not one.scale.any():
        return np.concatenate([before[:7], NONE])
    w, x, y, z = quaternion(one.turn)
    turn = np.array([x, y, z, w])
    if before is not None and turn @ before[3:7] < 0.0:  # the shorter way between two moments
        turn = -turn
    return np.concatenate([one.place, turn, one.scale])


def _add(gltf: Gltf, name: str, track: _Track, times: Mapping[int, float], shift: Floats) -> None:
    """A node with its first pose, and channels of what changes."""
    shape, rows = track.shape, np.array(list(track.rows.values()))
    rows[:, :3] += shift
    corners = {"POSITION": gltf.points(shape.points.astype(np.float32))}
    primitive: dict[str, Any] = {
        "attributes": corners,
        "indices": gltf.corners(shape.corners.astype(np.uint32)),
        "material": gltf.colour(name, shape.colour, shape.opacity),
        "mode": 4 if shape.corners.shape[1] == 3 else 1,
    }
    first = rows[0]
    node = gltf.mesh(name, [primitive], translation=first[:3], rotation=first[3:7], scale=first[7:])
    moments = np.array([times[moment] for moment in track.rows], dtype=np.float32)
    if len(moments) < 2:
        return
    at: int | None = None
    for what, part in (
        ("translation", slice(3)),
        ("rotation", slice(3, 7)),
        ("scale", slice(7, 10)),
    ):
        if np.ptp(rows[:, part], axis=0).any():
            at = gltf.numbers(moments, span=True) if at is None else at
            # What comes and goes does so at a moment; it does not grow meanwhile.
            gone = what == "scale" and not rows[:, part].any(axis=1).all()
            values = gltf.numbers(rows[:, part].astype(np.float32))
            gltf.move(node, what, at, values, way="STEP" if gone else "LINEAR")
