"""The convex hull of the points of an obstacle."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.compile.mesh_surface import solid_surface
from tissu.compile.meshes import mesh_of
from tissu.errors import TissuError

if TYPE_CHECKING:
    from tissu.compile.contact_surface import ContactSurface
    from tissu.compile.prepared import Findings
    from tissu.scene.convex_obstacle import ConvexObstacle
    from tissu.scene.problem import Path

_FLAT = 1e-6
"""of the largest width: points that are thinner than it lie in one plane"""


def hull_of(name: str, obstacle: ConvexObstacle, findings: Findings) -> ContactSurface | None:
    """The triangles of the hull, anticlockwise seen from outside.

    Returns:
        None, and a problem, where there is none.
    """
    from scipy.spatial import ConvexHull

    place: Path = ("obstacles", name, "points" if obstacle.mesh is None else "mesh")
    try:
        points = np.array(obstacle.points or mesh_of(obstacle.mesh).points, dtype=np.float64)
    except TissuError as error:
        findings.problem(place, str(error))
        return None
    around = points - points.mean(axis=0)
    scaled = around / (np.abs(around).max() or 1.0)
    spread = np.linalg.svd(scaled, compute_uv=False)
    if len(points) < 4 or not spread[2] > _FLAT * spread[0]:
        text = f"found {len(points)} points that enclose no volume; four or more that do not lie "
        findings.problem(place, f"{text}in one plane are accepted")
        return None
    hull = ConvexHull(scaled)
    used, numbers = np.unique(hull.simplices, return_inverse=True)
    vertices, triangles = points[used], numbers.reshape(-1, 3).astype(np.int32)
    corners = vertices[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    inward = np.einsum("ij,ij->i", normals, hull.equations[:, :3]) < 0.0
    triangles[inward] = triangles[inward][:, [0, 2, 1]]
    return solid_surface(vertices, triangles, closed=True)
