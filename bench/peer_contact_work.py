"""The scenes of bench/contact_peers.py as numbers, and the audit that every program's nodes meet.

NumPy alone: a program may run in a Python of its own, in which tissu is not installed. The scenes
are those of tissu.contact_cost.scenes; a slope's hexahedra are cut into tetrahedra for all.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import Any

import numpy as np
from peer_work import Work

YOUNG, POISSON, GRAVITY = 100e3, 0.3, 9.81  # Pa, 1, m/s2
SIDE = 0.05  # m, of a cube
GAP = 0.02  # of a mean edge: the thickness that programs are given unless their defaults have one
FAR = 1.0  # m, the clearance where nothing is near


@dataclass(frozen=True)
class Setup:
    """What a scene has besides its mesh.

    Attributes:
        bodies: how many, of equal meshes, from the bottom to the top.
        friction: of all with all.
        tangent: of the slope; gravity leans along x.
        damping: Rayleigh's, in proportion to the mass [1/s] and to the stiffness [s].
    """

    bodies: int = 1
    friction: float = 0.0
    tangent: float = 0.0
    damping: tuple[float, float] = (2.0, 0.005)

    @property
    def gravity(self) -> tuple[float, float, float]:
        """As a vector [m/s2]."""
        cosine = 1.0 / float(np.hypot(1.0, self.tangent))
        return GRAVITY * cosine * self.tangent, 0.0, -GRAVITY * cosine


SETUPS = {
    "cube": Setup(),
    "stack": Setup(bodies=5, friction=0.5),
    "stick": Setup(friction=0.5, tangent=0.45, damping=(0.0, 0.01)),
    "slide": Setup(friction=0.5, tangent=0.55, damping=(0.0, 0.01)),
    "rest": Setup(),
}


def split(way: str) -> tuple[Setup, str]:
    """The scene and the settings that a way "SCENE; SETTINGS" names."""
    scene, _, settings = way.partition("; ")
    return SETUPS[scene], settings


def surface_of(tetrahedra: Any) -> Any:
    """Triangles (t, 3) that belong to one tetrahedron, turned outwards."""
    faces = tetrahedra[:, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]].reshape(-1, 3)
    _, first, count = np.unique(
        np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True
    )
    return faces[np.sort(first[count == 1])]


def mean_edge(points: Any, triangles: Any) -> float:
    """Of a surface [m], each edge counted at each of its triangles."""
    corners = points[triangles]
    return float(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean())


class Noted(IntEnum):
    """Where Audit.seen has its numbers; the centres follow."""

    TOUCHES = 0  # whether the program has a contact
    FORCE = 1  # on the floor, as the program reports it [N]
    PLANE = 2  # depth of the lowest node inside the thickness above the plane [m]
    JOINT = 3  # depth of bodies inside the thickness between them [m]
    CROSSES = 4  # depth beyond the plane itself or inside another body [m]
    GAINED = 5  # kinetic energy and that of gravity, above the start [J]
    CENTRES = 6


class Bodies:
    """The bodies of a work: equal parts of its nodes and tetrahedra.

    Attributes:
        points: of each body (n, 3) [m] at the start.
        tetrahedra: of one, of which all have the same.
        triangles: of its surface.
        masses: of each body's nodes [kg].
        edge: the mean one of the surface [m].
    """

    def __init__(self, work: Work, setup: Setup) -> None:
        count = setup.bodies
        self.points = work.points.reshape(count, -1, 3)
        self.tetrahedra = work.tetrahedra[: len(work.tetrahedra) // count]
        self.triangles = surface_of(self.tetrahedra)
        self.masses = work.masses.reshape(count, -1)
        self.edge = mean_edge(self.points[0], self.triangles)


class Audit:
    """Looks at the nodes after every step of 10 ms, whatever a program says of its contacts."""

    def __init__(
        self, bodies: Bodies, setup: Setup, dt: float, *, thickness: tuple[float, float]
    ) -> None:
        """`thickness`: how far a program holds nodes from the plane, and bodies from others [m]."""
        self._bodies, self._dt, self._thickness = bodies, dt, thickness
        self._gravity = np.array(setup.gravity)
        self._before = bodies.points
        self._start = self._energy(bodies.points)

    def seen(self, places: Any, touches: bool, force: float) -> list[float]:
        """What is noted of a step.

        Args:
            places: of the nodes of each body (bodies, n, 3) [m].
            touches: whether the program has a contact.
            force: that it reports on the floor [N].

        Returns:
            The numbers that Noted names, and the centre of each body [m].
        """
        places = np.asarray(places, dtype=np.float64).reshape(self._bodies.points.shape)
        if not np.isfinite(places).all():
            return [float("nan")]
        gained = self._energy(places) - self._start
        self._before = places
        centres = (places * self._bodies.masses[..., None]).sum(axis=1)
        centres /= self._bodies.masses.sum(axis=1)[:, None]
        lowest, apart = float(places[..., 2].min()), self._apart(places)
        near = (lowest - self._thickness[0], apart - self._thickness[1])
        crosses = max(0.0, -lowest, -apart)
        noted = (float(touches), force, *(max(0.0, -away) for away in near), crosses, gained)
        return [*map(float, noted), *map(float, centres.ravel())]

    def _energy(self, places: Any) -> float:
        speed = (places - self._before) / self._dt
        each = 0.5 * (speed**2).sum(axis=2) - places @ self._gravity
        return float((self._bodies.masses * each).sum())

    def _apart(self, places: Any) -> float:
        """The least distance of a surface's nodes from another body's surface, signed [m]."""
        nearest = FAR
        nodes = np.unique(self._bodies.triangles)
        for k, body in enumerate(places):
            low, high = body.min(axis=0) - self._bodies.edge, body.max(axis=0) + self._bodies.edge
            for other, of in enumerate(places):
                found = of[nodes]
                found = found[((found > low) & (found < high)).all(axis=1)]
                if other == k or len(found) == 0:
                    continue
                away = distances(found, body[self._bodies.triangles])
                away[inside(found, body[self._bodies.tetrahedra])] *= -1.0
                nearest = min(nearest, float(away.min()))
        return nearest


def inside(points: Any, cells: Any) -> Any:
    """Which of the points (p, 3) lie in one of the tetrahedra (e, 4, 3)."""
    edges = np.moveaxis(cells[:, 1:] - cells[:, :1], 1, 2)
    parts = np.einsum("eij,pej->pei", np.linalg.inv(edges), points[:, None] - cells[None, :, 0])
    return ((parts >= 0.0).all(axis=2) & (parts.sum(axis=2) <= 1.0)).any(axis=1)


def distances(points: Any, triangles: Any) -> Any:
    """Of each point (p, 3) the distance from the nearest triangle (t, 3, 3) [m]."""
    a, b, c = (triangles[None, :, k] for k in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=2, keepdims=True)
    p = points[:, None]
    flat, over, best = np.abs(((p - a) * normal).sum(axis=2)), True, np.inf
    for start, end in ((a, b), (b, c), (c, a)):
        along = end - start
        over = over & ((np.cross(along, p - start) * normal).sum(axis=2) >= 0.0)
        t = ((p - start) * along).sum(axis=2) / (along**2).sum(axis=2)
        foot = start + np.clip(t, 0.0, 1.0)[..., None] * along
        best = np.minimum(best, np.linalg.norm(p - foot, axis=2))
    return np.where(over, flat, best).min(axis=1)
