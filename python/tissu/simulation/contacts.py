"""What touches what in a simulation, and obstacles that are led while it runs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tissu.errors import ParameterError
from tissu.simulation.entry import one_thread_at_a_time
from tissu.simulation.lead import rigid_way, seconds_of

if TYPE_CHECKING:
    from tissu import _core as core
    from tissu.front import Scene
    from tissu.reading import Number, VectorLike
    from tissu.simulation.entry import Entry

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]
Bools = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class Contacts:
    """The contacts of the latest step, a row for each; copies.

    A contact joins up to four vertices: a vertex and a face, two edges, a vertex and an edge, two
    vertices, or a vertex and a plane. Weights are positive on its first side and negative on its
    second one.

    Attributes:
        between: names of both sides; of a body that meets itself twice the same.
        entry: (m,) numbers of the pairs of the scene, each pair of names counted as `check` says.
        nodes: (m, 4) numbers in their body or obstacle; -1: none.
        weights: (m, 4).
        points: (m, 3) where it acts, on the first side [m].
        normals: (m, 3) of length 1, from the second side to the first.
        gaps: (m,) distance of the surfaces, less that at which they rest [m].
        forces: (m, 3) on the first side [N]; the second one has the opposite.
        sliding: (m,) whether friction gave way.
    """

    between: list[tuple[str, str]]
    entry: Ints
    nodes: Ints
    weights: Floats
    points: Floats
    normals: Floats
    gaps: Floats
    forces: Floats
    sliding: Bools

    def __len__(self) -> int:
        """How many there are."""
        return len(self.between)


class Wrench(NamedTuple):
    """A force (3,) [N] and a moment (3,) [N m]."""

    force: Floats
    moment: Floats


class Crossing(NamedTuple):
    """An edge that goes through a triangle, or a vertex behind a plane.

    Attributes:
        body: of the edge.
        other: of the triangle, or the plane.
        edge: two nodes of `body`; the second is -1: a vertex alone.
        triangle: three nodes of `other`; -1: a plane.
    """

    body: str
    other: str
    edge: tuple[int, int]
    triangle: tuple[int, int, int]


@one_thread_at_a_time
class LedObstacle:
    """An obstacle by its name, which may be given a live target. Made by `Simulation.obstacle`."""

    def __init__(self, *, simulation: core.Simulation, entry: Entry, name: str) -> None:
        """Take an obstacle of the scene."""
        self._core = simulation
        self._entry = entry
        self._name = name

    def __repr__(self) -> str:
        """What it is called, and whether it has a live target."""
        return f"LedObstacle('{self._name}', {'its own path' if self.released else 'led live'})"

    @property
    def name(self) -> str:
        """Its name."""
        return self._name

    @property
    def position(self) -> Floats:
        """Where its origin is (3,) [m]; docs/contact.md says what the origin is."""
        return self._core.obstacle_place(self._name)

    @property
    def released(self) -> bool:
        """Whether it follows its own path, or is on its way back to it."""
        return not self._core.is_obstacle_led(self._name)

    def move(
        self,
        displacement: VectorLike = (0.0, 0.0, 0.0),
        *,
        angle: Number | str = 0.0,
        axis: VectorLike = (0.0, 0.0, 1.0),
        center: VectorLike = (0.0, 0.0, 0.0),
        over: Number | str | None = None,
    ) -> None:
        """Lead it to a rotation from rest, then a displacement from rest, see `Lead.move`.

        Args:
            displacement: from rest (3,) [m].
            angle: of the rotation from rest [rad], or text such as "30 deg".
            axis: direction of the rotation's axis, of any length but zero.
            center: a point of the axis at rest (3,) [m].
            over: time until it is there [s]; None: the next step.

        Raises:
            ParameterError: a value is not finite or of another quantity; an axis of length zero; a
                time that is not positive.
        """
        way = rigid_way(displacement, angle=angle, axis=axis, center=center)
        self._core.lead_obstacle(name=self._name, over=seconds_of(over), **way)

    def release(self, *, over: Number | str | None = None) -> None:
        """Hand it back to its own path; once more does nothing.

        Args:
            over: time until it is there [s]; None: the next step.

        Raises:
            ParameterError: a time that is not positive.
        """
        self._core.release_obstacle(name=self._name, over=seconds_of(over))


class Touched:
    """The part of a simulation that says what touches what."""

    scene: Scene
    _core: core.Simulation
    _entry: Entry

    def contacts(self) -> Contacts:
        """The contacts of the latest step.

        Raises:
            ParameterError: a scene without `contacts`.
        """
        names, found = self._surfaces(), self._core.contacts()
        return Contacts(
            between=[(names[a], names[b]) for a, b in found["surfaces"]],
            entry=found["pairs"],
            nodes=found["nodes"],
            weights=found["weights"],
            points=found["points"],
            normals=found["normals"],
            gaps=found["gaps"],
            forces=found["forces"],
            sliding=found["sliding"],
        )

    def force_on(self, name: str) -> Wrench:
        """What the contacts of the latest step give to a body or an obstacle.

        The moment is about the origin of an obstacle, where it is now, and about that of space for
        a body.

        Raises:
            ParameterError: no such name among what meets something; a scene without `contacts`.
        """
        names = self._surfaces()
        if name not in names:
            raise ParameterError(f"found '{name}'; accepted: {', '.join(names)}")
        return Wrench(*self._core.contact_force_on(names.index(name)))

    def crossings(self) -> list[Crossing]:
        """The exact audit: edges that go through triangles, and vertices behind planes, now.

        Of what the scene says meets; empty is what `travel: true` promises.

        Raises:
            ParameterError: a scene without `contacts`.
        """
        names = self._surfaces()
        return [
            Crossing(names[a], names[b], (edge[0], edge[1]), (face[0], face[1], face[2]))
            for a, b, edge, face in self._core.crossings()
        ]

    def obstacle(self, name: str) -> LedObstacle:
        """An obstacle of the scene, to be led live from the next step on.

        Live targets stand in the state: checkpoints carry them.

        Raises:
            ParameterError: no obstacle of that name; a scene without `contacts`.
        """
        self._surfaces()
        if name not in self.scene.obstacles:
            accepted = ", ".join(self.scene.obstacles) or "this scene has none"
            raise ParameterError(f"found no obstacle named '{name}'; accepted: {accepted}")
        return LedObstacle(simulation=self._core, entry=self._entry, name=name)

    def _surfaces(self) -> list[str]:
        if not self.scene.contacts:
            raise ParameterError("found a scene without contacts; one with `contacts` is accepted")
        return self._core.contact_surfaces()
