"""The surface of a mesh that has no cells to simulate, as contact sees it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.compile.contact_surface import ContactSurface, halves_of
from tissu.compile.meshes import mesh_of
from tissu.compile.prepared import Findings, Floats, Ints
from tissu.counted import counted
from tissu.errors import TissuError
from tissu.mesh.surface import edge_faults, enclosed_volume
from tissu.scene.problem import field_path

if TYPE_CHECKING:
    from tissu.scene.problem import Path

_FLAT = 1e-14
"""of the square of its longest edge: twice the area of a triangle below it is round-off"""


def solid_surface(vertices: Floats, triangles: Ints, *, closed: bool) -> ContactSurface:
    """Triangles alone, without thickness."""
    return ContactSurface(
        vertices=vertices,
        triangles=triangles.astype(np.int32),
        edges=np.empty((0, 2), dtype=np.int32),
        points=np.empty(0, dtype=np.int32),
        radius=np.empty(0),
        closed=closed,
    )


def surface_of_mesh(source: object, place: Path, findings: Findings) -> ContactSurface | None:
    """The boundary of the mesh's volume, or its faces; a closed one is turned outward.

    Returns:
        None, and a problem, where the mesh has neither.
    """
    try:
        mesh = mesh_of(source)
        outer = mesh.surface()
    except TissuError as error:
        findings.problem(place, str(error))
        return None
    whole = outer.triangles[: len(outer.triangles) - 2 * len(outer.quads)]
    faces = np.concatenate([whole, halves_of(mesh.points, outer.quads)])
    if not len(faces):
        text = "found no triangle, quad or volume cell; a mesh with one of them is accepted"
        findings.problem(place, text)
        return None
    used, numbers = np.unique(faces, return_inverse=True)
    vertices, triangles = mesh.points[used], numbers.reshape(-1, 3).astype(np.int32)
    closed = edge_faults(triangles) == (0, 0)
    if closed and enclosed_volume(vertices, triangles) < 0.0:
        triangles = triangles[:, [0, 2, 1]]
        findings.note(f"{field_path(place)}: its faces look inward; they are turned outward")
    return solid_surface(vertices, triangles, closed=closed)


def without_area(surface: ContactSurface) -> str:
    """What is wrong where no triangle has corners that do not lie on a line; empty: nothing.

    Nothing of such a surface has a side that a body could be on.
    """
    corners = surface.vertices[surface.triangles]
    edges = corners - np.roll(corners, 1, axis=1)
    longest = (edges**2).sum(axis=2).max(axis=1)
    twice = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
    if not len(corners) or (twice > _FLAT * longest).any():
        return ""
    at = ", ".join(f"({x:g}, {y:g}, {z:g})" for x, y, z in corners[0])
    text = f"found {counted(len(corners), 'triangle')}, none of which has an area, the first with "
    return (
        text + f"the corners {at} m; a mesh with an area is accepted: look at its units and cells"
    )
