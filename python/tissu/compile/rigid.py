"""Mass, centre and inertia of free obstacles, whose density is even."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from tissu.compile.prepared import Floats, Ints
from tissu.scene.obstacle import BoxObstacle, CapsuleObstacle, SphereObstacle
from tissu.scene.obstacle_part import Obstacle


class Rigid(NamedTuple):
    """A rigid body.

    Attributes:
        inertia: (3, 3) about the centre of mass, in axes of space [kg m2].
        velocity: (3,) at the start [m/s].
        spin: (3,) angular velocity at the start [rad/s].
    """

    mass: float
    inertia: Floats
    velocity: Floats
    spin: Floats


def rigid_of(obstacle: Obstacle, vertices: Floats, triangles: Ints) -> Rigid:
    """The rigid body of an obstacle with a mass; a mesh is that of its closed surface."""
    assert obstacle.mass is not None
    mass = obstacle.mass
    if isinstance(obstacle, SphereObstacle):
        inertia = 0.4 * mass * obstacle.radius**2 * np.eye(3)
    elif isinstance(obstacle, CapsuleObstacle):
        inertia = _capsule(mass, np.array(obstacle.ends), obstacle.radius)
    elif isinstance(obstacle, BoxObstacle):
        squares = (np.array(obstacle.max) - np.array(obstacle.min)) ** 2
        inertia = mass / 12.0 * np.diag(squares.sum() - squares)
    else:
        inertia = _solid(mass, vertices, triangles)
    still = (0.0, 0.0, 0.0)
    velocity, spin = obstacle.velocity or still, obstacle.spin or still
    return Rigid(mass, inertia, np.array(velocity), np.array(spin))


def centre_of(vertices: Floats, triangles: Ints) -> Floats:
    """Centre (3,) of the volume inside a closed surface [m]."""
    corners = vertices[triangles]
    volumes = _volumes(corners)
    return np.asarray((volumes[:, None] * corners.sum(axis=1)).sum(axis=0) / (4.0 * volumes.sum()))


def _volumes(corners: Floats) -> Floats:
    """Six times the signed volumes, between each triangle and the origin."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    return np.asarray(np.einsum("ij,ij->i", a, np.cross(b, c)))


def _capsule(mass: float, ends: Floats, radius: float) -> Floats:
    """A cylinder between two halves of a ball, whose centres are 3/8 of a radius from it."""
    way = ends[1] - ends[0]
    length = float(np.linalg.norm(way))
    cylinder, balls = math.pi * radius**2 * length, 4.0 / 3.0 * math.pi * radius**3
    rod, ball = (mass * part / (cylinder + balls) for part in (cylinder, balls))
    along = rod * radius**2 / 2.0 + ball * 0.4 * radius**2
    across = rod * (length**2 / 12.0 + radius**2 / 4.0)
    across += ball * (0.4 * radius**2 + length**2 / 4.0 + 3.0 / 8.0 * length * radius)
    axis = way / length
    return across * np.eye(3) + (along - across) * np.outer(axis, axis)


def _solid(mass: float, vertices: Floats, triangles: Ints) -> Floats:
    """Of tetrahedra between the triangles and the centre: (sum x x^T + S S^T) / 20, S = sum x."""
    corners = (vertices - centre_of(vertices, triangles))[triangles]
    volumes = _volumes(corners)
    sums = corners.sum(axis=1)
    squares = np.einsum("tki,tkj->tij", corners, corners) + np.einsum("ti,tj->tij", sums, sums)
    second = np.einsum("t,tij->ij", volumes, squares) / 20.0 / volumes.sum() * mass
    return np.asarray(np.trace(second) * np.eye(3) - second)
