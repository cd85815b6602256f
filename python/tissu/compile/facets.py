"""Triangles on both sides of round shapes: no part of them is off by more than a given share."""

from __future__ import annotations

import itertools
import math

import numpy as np

from tissu.compile.prepared import Floats, Ints

OFF = 1e-3
"""of the radius: how far vertices lie outside the exact surface, and middles of triangles inside"""


def sides_of_circle() -> int:
    """Sides of a regular polygon whose corners are that far outside, its sides that far inside."""
    return math.ceil(math.pi / math.acos((1.0 - OFF) / (1.0 + OFF)))


def cylinder(ends: Floats, radius: float) -> tuple[Floats, Ints]:
    """A prism, whose ends are those of the cylinder."""
    count = sides_of_circle()
    low, high = (_circle(end, ends[1] - ends[0], radius, count) for end in ends)
    places = np.concatenate([low, high])
    faces = []
    for i in range(count):
        j = (i + 1) % count
        faces += [(i, j, count + j), (i, count + j, count + i)]
    faces += [(0, i + 1, i) for i in range(1, count - 1)]
    faces += [(count, count + i, count + i + 1) for i in range(1, count - 1)]
    return places, np.array(faces, dtype=np.int32)


def cone(base: Floats, tip: Floats, radius: float) -> tuple[Floats, Ints]:
    """A pyramid over a polygon, with the tip and the base of the cone."""
    count = sides_of_circle()
    places = np.concatenate([_circle(base, tip - base, radius, count), [tip]])
    faces = [(i, (i + 1) % count, count) for i in range(count)]
    faces += [(0, i + 1, i) for i in range(1, count - 1)]
    return places, np.array(faces, dtype=np.int32)


def _circle(middle: Floats, axis: Floats, radius: float, count: int) -> Floats:
    """The corners, anticlockwise seen from where the axis points to."""
    axis = axis / np.linalg.norm(axis)
    first = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    first /= np.linalg.norm(first)
    turn = 2.0 * np.pi * np.arange(count) / count
    out = np.outer(np.cos(turn), first) + np.outer(np.sin(turn), np.cross(axis, first))
    return np.asarray(middle + (1.0 + OFF) * radius * out)


def ellipsoid(center: Floats, radii: Floats) -> tuple[Floats, Ints]:
    """A ball of triangles, drawn out along the axes: off by no more than that of each radius."""
    places, faces = _ball()
    return center + places * radii, faces


def _ball() -> tuple[Floats, Ints]:
    """Of radius 1: an icosahedron whose faces are divided until their middles are near enough."""
    parts = 1
    while True:
        places, faces = _divided(parts)
        normals = np.cross(
            places[faces[:, 1]] - places[faces[:, 0]], places[faces[:, 2]] - places[faces[:, 0]]
        )
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        lowest = np.einsum("ij,ij->i", normals, places[faces[:, 0]]).min()
        if (1.0 + OFF) * lowest >= 1.0 - OFF:
            return (1.0 + OFF) * places, faces
        parts += 1


def _divided(parts: int) -> tuple[Floats, Ints]:
    """Each face of the icosahedron in parts^2 triangles, with their corners on the ball."""
    corners, faces = _icosahedron()
    points: list[Floats] = []
    triangles: list[tuple[int, int, int]] = []
    for face in faces:
        a, b, c = corners[list(face)]
        number = {}
        for i, j in itertools.product(range(parts + 1), repeat=2):
            if i + j > parts:
                continue
            number[i, j] = len(points)
            points.append(a + (b - a) * (i / parts) + (c - a) * (j / parts))
        for i, j in number:
            if i + j < parts:
                triangles.append((number[i, j], number[i + 1, j], number[i, j + 1]))
            if i + j < parts - 1:
                triangles.append((number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]))
    places = np.array(points)
    places /= np.linalg.norm(places, axis=1)[:, None]
    _, kept, same = np.unique(np.round(places, 9), axis=0, return_index=True, return_inverse=True)
    return places[kept], np.asarray(same.reshape(-1)[np.array(triangles)], dtype=np.int32)


def _icosahedron() -> tuple[Floats, list[tuple[int, int, int]]]:
    """Corners and faces, anticlockwise seen from outside."""
    golden = (1.0 + math.sqrt(5.0)) / 2.0
    corners = np.array(
        [
            turned
            for a, b in itertools.product((-1.0, 1.0), (-golden, golden))
            for turned in ((0.0, a, b), (a, b, 0.0), (b, 0.0, a))
        ]
    )
    near = {
        (i, j)
        for i, j in itertools.combinations(range(12), 2)
        if np.linalg.norm(corners[i] - corners[j]) < 2.1
    }
    faces = []
    for i, j, k in itertools.combinations(range(12), 3):
        if {(i, j), (j, k), (i, k)} <= near:
            out = np.dot(np.cross(corners[j] - corners[i], corners[k] - corners[i]), corners[i])
            faces.append((i, j, k) if out > 0.0 else (i, k, j))
    return corners, faces
