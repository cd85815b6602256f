"""Obstacles as the core takes them: a plane, or vertices, edges and triangles at rest."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from tissu.compile import facets
from tissu.compile.contact_surface import ContactSurface, halves_of
from tissu.compile.hull import hull_of
from tissu.compile.mesh_surface import solid_surface, surface_of_mesh, without_area
from tissu.compile.prepared import Findings, Floats, Ints
from tissu.compile.rigid import Rigid, centre_of, rigid_of
from tissu.scene.convex_obstacle import (
    ConeObstacle,
    ConvexObstacle,
    CylinderObstacle,
    EllipsoidObstacle,
)
from tissu.scene.direction import unit_vector
from tissu.scene.obstacle import (
    BoxObstacle,
    CapsuleObstacle,
    MeshObstacle,
    PlaneObstacle,
    SphereObstacle,
)

if TYPE_CHECKING:
    from tissu._core import WorldBuilder
    from tissu.scene.motion import Motion
    from tissu.scene.obstacle_part import Obstacle

_LONG = 1.0
"""m: an obstacle above it is larger than any tool or bone; a mesh in millimetres read as metres"""

# Corners of a box are numbered x + 2 y + 4 z; faces anticlockwise seen from outside.
_BOX = (
    *((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4)),
    *((2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)),
)


class PreparedObstacle(NamedTuple):
    """An obstacle with its surface, or with the normal (3,) of length 1 of its plane.

    Attributes:
        origin: (3,) what is led, and what moments are taken about [m]; of one with a mass its
            centre.
        rigid: its mass and inertia where it moves freely.
    """

    name: str
    origin: Floats
    surface: ContactSurface | None
    normal: Floats | None
    motion: Motion | None
    rigid: Rigid | None = None

    @property
    def size(self) -> float:
        """Mean edge of its surface, or radius where it has none [m]; 0 of a plane."""
        if self.surface is None:
            return 0.0
        if not len(self.surface.triangles):
            return float(self.surface.radius[0])
        return self.surface.mean_edge

    def add_to(self, builder: WorldBuilder) -> None:
        """Put it into the world."""
        motion = None if self.motion is None else self.motion.in_core()
        if self.surface is None:
            assert self.normal is not None  # a plane
            builder.add_plane(name=self.name, normal=self.normal, origin=self.origin, motion=motion)
            return
        builder.add_obstacle(
            name=self.name,
            origin=self.origin,
            motion=motion,
            rigid=self.rigid,
            **{key: value for key, value in self.surface._asdict().items() if key != "riders"},
        )


def prepared_obstacle(name: str, obstacle: Obstacle, findings: Findings) -> PreparedObstacle | None:
    """The obstacle of a scene; None, and a problem, where its mesh is none.

    Raises:
        Unknown: a field of it could not be read.
    """
    normal: Floats | None = None
    surface: ContactSurface | None = None
    motion = obstacle.motion  # unknown where the obstacle is
    if isinstance(obstacle, PlaneObstacle):
        origin, normal = np.array(obstacle.point), unit_vector(obstacle.normal)
    elif isinstance(obstacle, SphereObstacle):
        surface = _made([obstacle.center], points=[0], radius=obstacle.radius)
        origin = np.array(obstacle.center)
    elif isinstance(obstacle, CapsuleObstacle):
        surface = _made(obstacle.ends, edges=[(0, 1)], radius=obstacle.radius)
        origin = np.mean(obstacle.ends, axis=0)
    elif isinstance(obstacle, BoxObstacle):
        surface = _box(obstacle)
        origin = np.mean([obstacle.min, obstacle.max], axis=0)
    elif isinstance(obstacle, _FACETED):
        surface = solid_surface(*_facets(obstacle), closed=True)
        origin = _middle(obstacle)
    else:
        surface = _of_points(name, obstacle, findings)
        if surface is None:
            return None
        origin = (surface.vertices.min(axis=0) + surface.vertices.max(axis=0)) / 2.0
        if obstacle.mass is not None:
            if not surface.closed:
                text = f"found {obstacle.mass:g} kg for a surface that is not closed, which has no "
                findings.problem(("obstacles", name, "mass"), f"{text}centre of mass; close it")
                return None
            origin = centre_of(surface.vertices, surface.triangles)
    rigid = None
    if obstacle.mass is not None and surface is not None:
        rigid = rigid_of(obstacle, surface.vertices, surface.triangles)
    return PreparedObstacle(name, origin, surface, normal, motion, rigid)


_FACETED = (CylinderObstacle, ConeObstacle, EllipsoidObstacle)


def _facets(obstacle: Obstacle) -> tuple[Floats, Ints]:
    """The triangles of a round shape."""
    if isinstance(obstacle, CylinderObstacle):
        return facets.cylinder(np.array(obstacle.ends), obstacle.radius)
    if isinstance(obstacle, ConeObstacle):
        return facets.cone(np.array(obstacle.base), np.array(obstacle.tip), obstacle.radius)
    assert isinstance(obstacle, EllipsoidObstacle)
    return facets.ellipsoid(np.array(obstacle.center), np.array(obstacle.radii))


def _middle(obstacle: Obstacle) -> Floats:
    """What a round shape is led by: its middle, of a cone that between base and tip."""
    if isinstance(obstacle, CylinderObstacle):
        return np.asarray(np.mean(obstacle.ends, axis=0))
    if isinstance(obstacle, ConeObstacle):
        return np.asarray(np.mean([obstacle.base, obstacle.tip], axis=0))
    assert isinstance(obstacle, EllipsoidObstacle)
    return np.array(obstacle.center)


def _of_points(name: str, obstacle: Obstacle, findings: Findings) -> ContactSurface | None:
    """The surface of a mesh, or the hull of points."""
    if isinstance(obstacle, ConvexObstacle):
        return hull_of(name, obstacle, findings)
    assert isinstance(obstacle, MeshObstacle)
    return _of_mesh(name, obstacle, findings)


def _made(
    vertices: object, *, points: object = (), edges: object = (), radius: float
) -> ContactSurface:
    """Vertices, and edges between them, of one radius."""
    places = np.array(vertices, dtype=np.float64)
    return ContactSurface(
        vertices=places,
        triangles=np.empty((0, 3), dtype=np.int32),
        edges=np.array(edges, dtype=np.int32).reshape(-1, 2),
        points=np.array(points, dtype=np.int32),
        radius=np.full(len(places), radius),
        closed=False,
    )


def _box(box: BoxObstacle) -> ContactSurface:
    """Twelve triangles."""
    sides = [(a, b) for a, b in zip(box.min, box.max, strict=True)]
    corners = np.array([(x, y, z) for z, y, x in itertools.product(*reversed(sides))])
    quads = np.array(_BOX, dtype=np.int32)
    return solid_surface(corners, halves_of(corners, quads), closed=True)


def _of_mesh(name: str, obstacle: MeshObstacle, findings: Findings) -> ContactSurface | None:
    """The boundary of the mesh's volume, or its faces; a closed one is turned outward."""
    place = ("obstacles", name, "mesh")
    surface = surface_of_mesh(obstacle.mesh, place, findings)
    if surface is None:
        return None
    wrong = without_area(surface)
    if wrong:
        findings.problem(place, wrong)
        return None
    if not surface.closed:
        findings.note(
            f"obstacles.{name}.mesh: its surface is not closed or its faces look both ways, so "
            "that bodies meet it from both sides"
        )
    size = float(np.ptp(surface.vertices, axis=0).max())
    if size > _LONG:
        findings.note(
            f"obstacles.{name}.mesh: is {size:.4g} m long; where the file is written in another "
            "unit, say so: mesh: {file: ..., unit: mm}"
        )
    return surface
