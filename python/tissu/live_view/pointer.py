"""Where a pointer is: what it met when it was pressed, and where it has gone since."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Pointer:
    """A pointer at one moment of a press.

    Attributes:
        lane: number of the simulation whose body it met.
        body: name of that body.
        client: number of the page.
        eye: (3,) where it looks from [m].
        there: (3,) where it is now, on its ray [m]: of a drag, in the plane of the screen through
            the place that was pressed.
        place: (3,) the place of the body that was pressed, which moves with it [m].
    """

    lane: int
    body: str
    client: int
    eye: Floats
    there: Floats
    place: Floats


def met(eye: Floats, through: Floats, corners: Floats) -> Floats | None:
    """Where a ray first meets triangles, from either side; None: it misses them.

    Moeller and Trumbore 1997.

    Args:
        eye: (3,) where it begins [m].
        through: (3,) a point on it [m].
        corners: (t, 3, 3) of the triangles [m].
    """
    along = through - eye
    a, u, v = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    across = np.cross(along, v)
    volume = np.einsum("ti,ti->t", u, across)
    flat = np.abs(volume) < 1e-300
    scale = 1.0 / np.where(flat, 1.0, volume)
    off = eye - a
    second = scale * np.einsum("ti,ti->t", off, across)
    turned = np.cross(off, u)
    third = scale * (turned @ along)
    far = scale * np.einsum("ti,ti->t", v, turned)
    hit = ~flat & (second >= 0) & (third >= 0) & (second + third <= 1) & (far > 0)
    return eye + float(far[hit].min()) * along if hit.any() else None
