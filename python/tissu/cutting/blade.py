"""Blades: surfaces in present space along which a body is cut."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tissu import _core, units
from tissu.arrays import real_array
from tissu.errors import ParameterError
from tissu.scene.selection import Box, Plane, Sphere

if TYPE_CHECKING:
    from tissu._core import Sweep as CoreSweep

Floats = NDArray[np.float64]

_FARTHEST = 1e12
"""times the size of the body: a blade's places are as accurate as a ten-thousandth of the body"""

__all__ = ["Capsule", "Disc", "Sweep", "Triangles"]


@dataclass(frozen=True, slots=True, eq=False)
class Disc:
    """A disc across `normal`, as a polygon of 32 sides.

    Attributes:
        center: (3,) [m].
        normal: of any length but zero (3,).
        radius: [m], or text such as "2 cm".
    """

    center: ArrayLike
    normal: ArrayLike
    radius: units.Number

    def _surface(self, places: Floats) -> CoreSweep:
        center, radius = _triple(self.center, "the center"), units.LENGTH(self.radius)
        _refuse_far([*center, radius], places)
        return _core.disc_sweep(
            center=center, normal=_triple(self.normal, "the normal"), radius=radius
        )


@dataclass(frozen=True, slots=True, eq=False)
class Triangles:
    """A surface of triangles; those that share an edge are one blade.

    Attributes:
        points: (n, 3) [m].
        triangles: numbers of points (t, 3).
    """

    points: ArrayLike
    triangles: ArrayLike

    def _surface(self, places: Floats) -> CoreSweep:
        points = _rows(self.points, "points")
        corners = real_array(self.triangles, "triangles")
        if corners.ndim != 2 or corners.shape[1] != 3 or corners.dtype.kind not in "iu":
            raise ParameterError(
                f"found triangles of type {corners.dtype} and shape {corners.shape}; whole numbers "
                "(t, 3) are accepted"
            )
        if corners.size and (corners.min() < 0 or corners.max() >= len(points)):
            raise ParameterError(
                f"found triangles of the points {corners.min()} to {corners.max()}; 0 to "
                f"{len(points) - 1} are accepted"
            )
        _refuse_far(points, places)
        return _core.triangles_sweep(points=points, triangles=corners.astype(np.int32))


@dataclass(frozen=True, slots=True, eq=False)
class Sweep:
    """The ruled surface that an edge sweeps through several moments.

    Attributes:
        edges: places (k, m, 3) of the m points of the edge at k moments [m]; both at least 2.
    """

    edges: ArrayLike

    def _surface(self, places: Floats) -> CoreSweep:
        edges = np.ascontiguousarray(real_array(self.edges, "edges"), dtype=np.float64)
        if edges.ndim != 3 or edges.shape[2] != 3 or min(edges.shape[:2]) < 2:
            raise ParameterError(
                f"found edges of shape {edges.shape}; (k, m, 3) is accepted: m points of an edge "
                "at k moments, at least two of both"
            )
        _refuse_far(edges, places)
        return _core.edge_sweep(
            places=edges.reshape(-1, 3),
            moments=edges.shape[0],
            points=edges.shape[1],
            incision=-1,
            past=0,
        )


Blade = Plane | Disc | Triangles | Sweep
"""What cuts."""


def surface_of(blade: object, places: Floats) -> CoreSweep:
    """The blade as the core has it; a plane is as large as the body, which is at `places` (n, 3).

    Raises:
        ParameterError: it is not a blade, has no area, or has numbers that are not finite or too
            large beside the body.
    """
    if isinstance(blade, Plane):
        _refuse_far(blade.point, places)
        return _core.plane_sweep(
            point=np.array(blade.point),
            normal=np.array(blade.normal),
            low=places.min(axis=0),
            high=places.max(axis=0),
        )
    if isinstance(blade, Disc | Triangles | Sweep):
        return blade._surface(places)
    raise ParameterError(
        f"found {type(blade).__name__} as a blade; ts.Plane, ts.Disc, ts.Triangles and ts.Sweep "
        "are accepted"
    )


@dataclass(frozen=True, slots=True, eq=False)
class Capsule:
    """All points no farther than `radius` from the line between two ends: a swept ball.

    Attributes:
        ends: both ends (2, 3) [m]; if they are the same place, it is a ball.
        radius: [m], or text such as "2 mm".
    """

    ends: ArrayLike
    radius: units.Number

    def box(self) -> tuple[Floats, Floats]:
        """Its smallest and its largest corner (3,) [m]."""
        a, b, radius = self._read()
        return np.minimum(a, b) - radius, np.maximum(a, b) + radius

    def holds(self, points: Floats) -> NDArray[np.bool_]:
        """Whether each of the points (n, 3) [m] lies in it."""
        a, b, radius = self._read()
        axis = b - a
        square = float(axis @ axis)
        share = np.zeros(len(points))
        if square > 0.0:
            share = np.clip((points - a) @ axis / square, 0.0, 1.0)
        return np.asarray(np.linalg.norm(points - a - share[:, None] * axis, axis=1) <= radius)

    def _read(self) -> tuple[Floats, Floats, float]:
        ends, radius = _rows(self.ends, "ends"), units.LENGTH(self.radius)
        if ends.shape != (2, 3) or not np.isfinite(ends).all():
            raise ParameterError(
                f"found ends of shape {ends.shape} of a capsule; two finite points are accepted"
            )
        if not radius > 0.0:
            raise ParameterError(f"found a capsule of radius {radius:g} m; above 0 is accepted")
        return ends[0], ends[1], radius


Place = Sphere | Box | Capsule
"""Where cells are ablated."""


def inside_of(place: object, points: Floats) -> NDArray[np.bool_]:
    """Which points (e, 3) lie in a place.

    Raises:
        ParameterError: it is not a place.
    """
    if isinstance(place, Capsule):
        return place.holds(points)
    if not isinstance(place, Sphere | Box):
        found = type(place).__name__
        accepted = "ts.Sphere, ts.Capsule and ts.Box are accepted"
        raise ParameterError(f"found {found} to ablate; {accepted}")
    return place._inside(points, 0.0)


def _refuse_far(numbers: ArrayLike, places: Floats) -> None:
    """Refuse a blade with numbers [m] that are too large beside a body at places (n, 3)."""
    largest = float(np.abs(np.asarray(numbers, dtype=float)).max(initial=0.0))
    accepted = _FARTHEST * float(np.ptp(places, axis=0).max())
    if math.isfinite(largest) and largest > accepted > 0.0:
        raise ParameterError(
            f"found a blade with a place or a radius of {largest:g} m; at most {accepted:g} m is "
            "accepted, 1e12 times the size of the body"
        )


def _triple(values: ArrayLike, what: str) -> Floats:
    found = real_array(values, what)
    if found.shape != (3,):
        raise ParameterError(f"found {what} of shape {found.shape}; three numbers are accepted")
    return np.ascontiguousarray(found, dtype=np.float64)


def _rows(values: ArrayLike, what: str) -> Any:
    found = real_array(values, what)
    if found.ndim != 2 or found.shape[1] != 3:
        raise ParameterError(f"found {what} of shape {found.shape}; (n, 3) is accepted")
    return np.ascontiguousarray(found, dtype=np.float64)
