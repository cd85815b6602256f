"""What touches what while a simulation runs: contacts, their forces, and the audit of crossings."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tissu.errors import ParameterError
from tissu.simulation.contact_at_nodes import (
    FAR,
    ContactAtNodes,
    Riders,
    contact_at_nodes,
    contact_at_vertices,
    vertex_areas,
)
from tissu.simulation.obstacle_surface import ObstacleSurface, plane_square, round_surface

if TYPE_CHECKING:
    from collections.abc import Mapping

    from tissu import _core as core
    from tissu.front import Scene
    from tissu.mesh import Mesh
    from tissu.simulation.meshes import Meshes

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]
Bools = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class Contacts:
    """The m contacts that press at the end of the latest step.

    Attributes:
        surfaces: names of the bodies and obstacles to which the numbers in `pairs` refer.
        pairs: the two surfaces of each contact (m, 2): the one on which `forces` act, and the other
            one.
        nodes: whose places the contact joins, numbers in their own body or obstacle (m, 4); -1:
            none; -2 - r: point r of the material of a body that was cut, or vertex r of the mesh
            that `surface_of` gives it, which nodes carry.
        weights: of these (m, 4). The distance vector is the sum of weight times place.
        points: where the forces act (m, 3) [m], on the surface of the first of the pair. With
            friction, those of sheets, and of lines whose nodes are not frames, are on the middle,
            half a thickness away: friction acts there. The moment that `force_on` gives of the
            first surface is that of the forces at these points.
        normals: from the other one to the first (m, 3).
        gaps: distance beyond that at which the surfaces rest (m,) [m]; negative: inside the gap.
        forces: on the first of the pair (m, 3) [N]; the opposite force acts on the other one.
        sliding: whether the contact slides (m,).
        areas: on which they act (m,) [m2]: a share of the surface at rest.
    """

    surfaces: tuple[str, ...]
    pairs: Ints
    nodes: Ints
    weights: Floats
    points: Floats
    normals: Floats
    gaps: Floats
    forces: Floats
    sliding: Bools
    areas: Floats

    def __len__(self) -> int:
        """How many contacts there are."""
        return len(self.gaps)

    def __repr__(self) -> str:
        """How many there are, and of what."""
        met = sorted({self.surfaces[number] for number in np.unique(self.pairs)})
        return f"Contacts({len(self)} of {', '.join(met)})" if len(self) else "Contacts(none)"

    @property
    def pressures(self) -> Floats:
        """Normal force over area (m,) [Pa]; 0 for edges of no area."""
        normal = np.einsum("ij,ij->i", self.forces, self.normals)
        pressed = np.zeros_like(normal)
        np.divide(normal, self.areas, out=pressed, where=self.areas > 0.0)
        return np.asarray(pressed)


class BodySurface(NamedTuple):
    """The surface with which a body or a tissue meets others.

    Attributes:
        rest: its vertices at rest (n, 3) [m].
        points: where they are now (n, 3) [m].
        triangles: numbers of vertices (t, 3).
        nodes: nodes of the body (n, m) that carry each vertex; 0 beyond the last. Frames carry it
            with their rotations, too.
        weights: of these (n, m), which sum to one for each vertex; 0 beyond the last. Nodes of
            other bodies that carry a vertex of a tissue are left out.
    """

    rest: Floats
    points: Floats
    triangles: Ints
    nodes: Ints
    weights: Floats

    def carried(self, values: Floats) -> Floats:
        """Values (n, ...) at the vertices of values at the nodes of the body."""
        return np.asarray(np.einsum("vk,vk...->v...", self.weights, values[self.nodes]))


class Wrench(NamedTuple):
    """A force and a moment.

    Attributes:
        force: (3,) [N].
        moment: (3,) [N m].
    """

    force: Floats
    moment: Floats


class Crossing(NamedTuple):
    """An edge of one surface that goes through a triangle of another, or a vertex behind a plane.

    Attributes:
        surface: name of the body or obstacle of the edge.
        edge: its two nodes; one alone for a vertex behind a plane. Point r of cut material, or
            of a mesh of `surface_of`, is -2 - r.
        other: name of the body or obstacle of the triangle, or of the plane.
        triangle: its three nodes; empty for a plane.
    """

    surface: str
    edge: tuple[int, ...]
    other: str
    triangle: tuple[int, ...]


class Overlap(NamedTuple):
    """Two surfaces whose thicknesses are inside each other.

    Attributes:
        surface: name of the body or obstacle.
        other: name of the other one, or the same.
        depth: how far, at the deepest place [m].
    """

    surface: str
    other: str
    depth: float


class Touched:
    """The part of a simulation that says what touches what."""

    scene: Scene
    _core: core.Simulation
    _rest: dict[str, Mesh]
    _tissue: dict[str, Mesh]
    _meshes: Meshes

    if TYPE_CHECKING:

        @property
        def positions(self) -> Mapping[str, Floats]:
            """Body -> where its nodes are (n, 3) [m]."""
            raise NotImplementedError

    def contacts(self) -> Contacts:
        """The contacts that press, as the latest step left them; none before the first step.

        Raises:
            ParameterError: the scene has no contacts.
        """
        self._require_contact()
        return Contacts(tuple(self._core.contact_surfaces()), *self._core.contacts())

    @property
    def touching(self) -> tuple[str, ...]:
        """Names of the bodies that contacts name, then of the obstacles; none without contacts."""
        return tuple(self._core.contact_surfaces()) if self.scene.contacts else ()

    @property
    def obstacles(self) -> tuple[str, ...]:
        """Names of the obstacles; none in a scene without contacts."""
        return tuple(self.scene.obstacles) if self.scene.contacts else ()

    def contact_at_nodes(self, body: str) -> ContactAtNodes:
        """Contact pressure [Pa] and gap [m] at the nodes of a body, of the latest step.

        Raises:
            ParameterError: the scene has no contacts; the body meets nothing.
        """
        self._require_contact()
        self._require_meeting(body)
        if body in self.scene.tissue:
            raise ParameterError(f"found {body!r}, a tissue; a body is accepted")
        areas = np.zeros(self._meshes[body].node_count)
        found = self._core.contact_areas(body)
        areas[: len(found)] = found
        riders = Riders(*self._core.contact_riders(body))
        return contact_at_nodes(self.contacts(), body, areas, riders)

    def contact_at_points(self, body: str, points: Ints) -> ContactAtNodes:
        """Contact pressure [Pa] and gap [m] at points of a body's material, of the latest step.

        Each point of the surface has the forces that act on itself, over its own area. Points that
        are not on it have no pressure, and a gap of 1e30. A body whose surface is a mesh of its own
        has the values of `contact_at_nodes` at points that are nodes, and no contact elsewhere.

        Args:
            body: its name.
            points: `numbers` of `material(body)` or `surface(body)`.

        Raises:
            ParameterError: the scene has no contacts; the body meets nothing.
        """
        if body in self.own_surfaces:
            found = self.contact_at_nodes(body)
            vertices = np.arange(len(found.gap), dtype=np.int32)
        else:
            self._require_contact()
            self._require_meeting(body)
            known, rest, _ = self._core.contact_vertices(body)
            corners = self._core.contact_surface(body)[0]
            triangles = np.searchsorted(known, corners).astype(np.int32)
            vertices, areas = known - (known < 0), vertex_areas(triangles, rest)
            found = contact_at_vertices(self.contacts(), body, vertices, areas)
        place = np.searchsorted(vertices, points)
        there = np.isin(points, vertices)
        pressure, gap = np.zeros(len(points)), np.full(len(points), FAR)
        pressure[there], gap[there] = found.pressure[place[there]], found.gap[place[there]]
        return ContactAtNodes(pressure, gap)

    @property
    def own_surfaces(self) -> tuple[str, ...]:
        """Names of the bodies whose surface is a mesh of its own (`surface_of`), and of tissues."""
        own = {*(self.scene.contact.surface_of if self.scene.contact else ()), *self.scene.tissue}
        return tuple(name for name in self.touching if name in own)

    def contact_surface(self, body: str) -> BodySurface:
        """The triangles with which a body or a tissue meets others, at rest and now.

        Raises:
            ParameterError: the scene has no contacts; the body meets nothing.
        """
        self._require_contact()
        self._require_meeting(body)
        triangles = self._core.contact_surface(body)[0]
        numbers, begin, of_nodes, of_weights = self._core.contact_riders(body)
        of_weights = np.where(of_nodes < 0, 0.0, of_weights)
        of_nodes = np.maximum(of_nodes, 0)
        names, places = np.unique(triangles, return_inverse=True)
        if body in self.own_surfaces:
            names = names[::-1]  # as the mesh has them
            places = len(names) - 1 - places
        # A vertex is a node, but for what `contact_riders` lists: number - 1 below zero.
        listed = np.searchsorted(numbers, names - (names < 0))
        rides = np.isin(names - (names < 0), numbers)
        widest = max(1, int(np.diff(begin).max(initial=0)))
        nodes = np.zeros((len(names), widest), dtype=np.int32)
        weights = np.zeros((len(names), widest))
        nodes[~rides, 0], weights[~rides, 0] = names[~rides], 1.0
        for k in range(widest):
            item = begin[listed[rides]] + k
            there = np.flatnonzero(rides)[item < begin[listed[rides] + 1]]
            item = item[item < begin[listed[rides] + 1]]
            nodes[there, k], weights[there, k] = of_nodes[item], of_weights[item]
        found = BodySurface(
            rest=np.empty(0),
            points=np.empty(0),
            triangles=places.reshape(-1, 3).astype(np.int32),
            nodes=nodes,
            weights=weights,
        )
        if body in self.scene.tissue or self.scene.bodies[body].has_rotations:
            known, rest, now = self._core.contact_vertices(body)
            there = np.searchsorted(known, names)
            return found._replace(rest=rest[there], points=now[there])
        rest = np.asarray(self._meshes[body].points)
        now = np.array(self.positions[body])
        return found._replace(rest=found.carried(rest), points=found.carried(now))

    def _require_meeting(self, body: str) -> None:
        bodies = [name for name in self.touching if name not in self.scene.obstacles]
        if body not in bodies:
            hint = f"a body that meets something is accepted: {', '.join(bodies)}"
            raise ParameterError(f"found {body!r}; {hint}")

    def _spread_over_nodes(self, body: str, points: Ints, shares: Floats) -> tuple[Any, Any]:
        """The nodes, each once, that carry points of a surface, and their parts of the shares."""
        riders = Riders(*self._core.contact_riders(body))
        _, nodes, parts = riders.shared(points, shares)
        found, place = np.unique(nodes, return_inverse=True)
        return found.astype(np.int64), np.bincount(place, parts)

    def obstacle_surface(self, name: str) -> ObstacleSurface:
        """The surface of an obstacle as triangles, at rest and now.

        Round obstacles have points on their exact surface; a plane is a square of it, a fifth
        longer than the extent of the bodies and the tissue.

        Raises:
            ParameterError: the scene has no contacts, or no obstacle of that name.
        """
        self._require_contact()
        if name not in self.obstacles:
            hint = f"accepted: {', '.join(self.obstacles) or 'none, since there is none'}"
            raise ParameterError(f"found obstacle {name!r}; {hint}")
        vertices, triangles, edges, points, radius, origin, normal = self._core.obstacle_surface(
            name
        )
        if normal is None:
            rest, faces = round_surface(vertices, triangles, edges, points, radius)
        else:
            meshes = [*self._rest.values(), *self._tissue.values()]
            places = [mesh.points for mesh in meshes] or [np.array([origin])]
            rest, faces = plane_square(origin, normal, np.concatenate(places))
        now = self._core.obstacle_places(name=name, rest=rest)
        return ObstacleSurface(rest, now, faces, normal is not None)

    def force_on(self, name: str) -> Wrench:
        """The force and the moment of all contacts on a body or obstacle in the latest step.

        Its impulse over the step is the change of momentum that contacts made, with two exceptions.
        With `BDF2` the force is that of the equation at the end of the step, and the sum of
        impulses over many steps agrees with the momentum to second order in dt. With `Newmark` and
        `ImplicitMidpoint` friction is reported within Coulomb's bound, and what acted differs from
        it by a few percent of the bound (docs/guide/contact.md, Limits).

        Args:
            name: of the body or obstacle.

        Returns:
            The force [N], and the moment [N m]: for an obstacle about its present origin (the point
                of a plane, the center of others), for a body about the origin of space.

        Raises:
            ParameterError: the scene has no contacts; nothing of that name meets anything.
        """
        self._require_contact()
        known = self._core.contact_surfaces()
        if name not in known:
            hint = f"; accepted: {', '.join(known)}"
            raise ParameterError(f"found {name!r}, which meets nothing in this scene{hint}")
        return Wrench(*self._core.contact_force_on(name))

    def crossings(self) -> list[Crossing]:
        """Present crossings of the surfaces in contact; with `travel: true` there are never any.

        The answer is exact for the present positions: it uses exact signs. Surfaces that just touch
        count as crossing.

        Raises:
            ParameterError: the scene has no contacts.
        """
        self._require_contact()
        names = self._core.contact_surfaces()
        return [
            Crossing(
                names[a],
                tuple(n for n in edge if n != -1),
                names[b],
                tuple(t for t in face if t != -1),
            )
            for a, edge, b, face in self._core.crossings()
        ]

    def overlaps(self) -> list[Overlap]:
        """Present depths inside balls, rods, sheets and lines; `crossings` tests their middles.

        For each pair of surfaces in contact, the deepest place is found from the distance of their
        middles and both half thicknesses. Within a body, no more than 0.9 of the distance at rest
        counts as thickness. A surface without thickness in contact with a ball rises into it by at
        most the gap, between the contact points.

        Raises:
            ParameterError: the scene has no contacts.
        """
        self._require_contact()
        names = self._core.contact_surfaces()
        return [Overlap(names[a], names[b], depth) for a, b, depth in self._core.overlaps()]

    def _require_contact(self) -> None:
        if not self.scene.contacts:
            raise ParameterError(
                "this scene has no contacts: nothing meets anything; add `contacts` to it, such "
                "as ts.Contact(['liver', 'probe'])"
            )
