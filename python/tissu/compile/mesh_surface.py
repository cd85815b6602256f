"""The surface of a mesh that has no cells to simulate, as contact sees it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.compile.contact_surface import ContactSurface, halves_of
from tissu.compile.meshes import mesh_of
from tissu.compile.prepared import Findings, Floats, Ints
from tissu.errors import TissuError
from tissu.mesh.surface import edge_faults, enclosed_volume
from tissu.scene.problem import field_path

if TYPE_CHECKING:
    from tissu.scene.problem import Path


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
