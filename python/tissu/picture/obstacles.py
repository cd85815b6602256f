"""Obstacles in a picture beside what is pictured: grey, and a little transparent before a body."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.picture.surface import FINER, flatten, render_layer

if TYPE_CHECKING:
    from tissu.picture.camera import Camera
    from tissu.picture.surface import Layer
    from tissu.simulation import Simulation

Array = NDArray[np.float64]

STONE = (0.72, 0.73, 0.75)
"""Colour of obstacles."""
VEIL = 0.6
"""Opacity of an obstacle before a body."""
_AROUND = 0.5
"""How far beyond the bodies obstacles are kept in view, as a share of the bodies' extent."""


@dataclass(frozen=True, slots=True)
class Obstacles:
    """The surfaces of all obstacles as one.

    Attributes:
        rest: (n,3) points at rest [m].
        now: (n,3) points now [m].
        triangles: (t,3) numbers of points.
        bounded: (n,) whether a point belongs to an obstacle that has an end, unlike a plane.
    """

    rest: Array
    now: Array
    triangles: NDArray[np.int64]
    bounded: NDArray[np.bool_]

    def in_view(self, bodies: Array) -> list[Array]:
        """Points at rest and now that a view of bodies with these points (n,3) shows too."""
        low, high = bodies.min(axis=0), bodies.max(axis=0)
        room = _AROUND * float(np.linalg.norm(high - low))
        found = []
        for points in (self.rest, self.now):
            near = ((points >= low - room) & (points <= high + room)).all(axis=1)
            found.append(points[near & self.bounded])
        return found


def obstacles_of(simulation: Simulation) -> Obstacles | None:
    """Those of a simulation that meet bodies; None where there is none."""
    surfaces = [simulation.obstacle_surface(name) for name in simulation.obstacles]
    if not surfaces:
        return None
    starts = np.cumsum([0, *(len(one.rest) for one in surfaces)])
    return Obstacles(
        rest=np.concatenate([one.rest for one in surfaces]),
        now=np.concatenate([one.points for one in surfaces]),
        triangles=np.concatenate(
            [one.triangles + start for one, start in zip(surfaces, starts, strict=False)]
        ).astype(np.int64),
        bounded=np.concatenate([np.full(len(one.rest), not one.endless) for one in surfaces]),
    )


def render_beside(
    body: Layer, points: Array, triangles: NDArray[np.int64], *, camera: Camera
) -> Array:
    """RGBA (h,w,4) of a body with obstacles before and behind it.

    Args:
        body: rendered with `camera` enlarged by `FINER`.
        points: (n,3) of the obstacles [m].
        triangles: (t,3) numbers of points.
        camera: the view.
    """
    stone = render_layer(points, triangles, None, camera=camera.enlarged(FINER), colour=STONE)
    before = stone.covered & (stone.nearness > body.nearness)
    share = np.where(before, np.where(body.covered, VEIL, 1.0), 0.0)
    share = np.where(stone.covered & ~body.covered, 1.0, share)[..., None]
    colour = share * stone.colour + (1.0 - share) * body.colour
    return flatten(colour, (body.covered | stone.covered).astype(np.float64))
