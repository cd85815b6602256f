"""Points on a regular grid inside a region."""

from __future__ import annotations

import numpy as np

from tissu.errors import ParameterError
from tissu.mesh.cell import Floats
from tissu.sampling.region import Region, fitting

_ROUND_OFF = 1e-9  # of a cell: a side of exactly three spacings holds three


def grid_points(region: Region, spacing: float) -> Floats:
    """Points (n, 3) [m] inside a region on a grid along the axes, x fastest, then y, then z.

    Along each axis as many as fit between the bounds, in their middle: a box whose sides are
    whole numbers of spacings has points on its faces.

    Args:
        region: what the points lie in.
        spacing: distance of neighbours [m].

    Raises:
        ParameterError: a spacing that is not positive, is larger than the region or finds no point
            inside.
    """
    return _inside(region, spacing, np.floor(_spacings(region, spacing) + _ROUND_OFF) + 1.0)


def grid_cells(region: Region, spacing: float) -> Floats:
    """Centres (n, 3) [m], inside a region, of the cubes of a grid that covers its bounds.

    Along each axis as few cubes as cover the bounds, in their middle: a box whose sides are whole
    numbers of spacings is filled exactly. x fastest, then y, then z.

    Args:
        region: what the points lie in.
        spacing: side of the cubes [m].

    Raises:
        ParameterError: a spacing that is not positive, is larger than the region or finds no point
            inside.
    """
    return _inside(region, spacing, np.ceil(_spacings(region, spacing) - _ROUND_OFF))


def _spacings(region: Region, spacing: float) -> Floats:
    value = fitting(region, spacing, "spacing")
    return np.asarray(np.ptp(region.bounds, axis=0) / value)


def _inside(region: Region, spacing: float, counts: Floats) -> Floats:
    """Those of nx x ny x nz points in the middle of the bounds that are inside."""
    middle = region.bounds.mean(axis=0)
    along = [
        m + (np.arange(max(int(n), 1)) - (max(int(n), 1) - 1) / 2.0) * spacing
        for m, n in zip(middle, counts, strict=True)
    ]
    z, y, x = np.meshgrid(along[2], along[1], along[0], indexing="ij")
    points = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    found = points[region.inside(points)]
    if not len(found):
        raise ParameterError(
            f"found no point of the grid inside with spacing {spacing:g} m, in a region of "
            f"{' x '.join(f'{size:.3g}' for size in np.ptp(region.bounds, axis=0))} m; a fraction "
            "of its thickness is accepted: take a smaller spacing, or look at the mesh's unit"
        )
    return found
