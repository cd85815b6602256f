"""The part of a region that is nearest to each of some points: its volume, centre and moments."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from tissu.errors import ParameterError
from tissu.mesh.cell import Floats
from tissu.sampling.region import MOST_CELLS, Bools, Indices, Region, positions

_BLOCK = 6  # cells along the side of a block whose cells ask the same points


@dataclass(frozen=True, slots=True, eq=False)
class Shares:
    """What belongs to each of n points (its Voronoi cell within the region).

    Attributes:
        volumes: V (n,) [m3], all positive; they add up to the region's volume.
        centres: centroids (n, 3) [m].
        moments: integral of (x - p) (x - p)^T about the point p over its share (n, 3, 3) [m5].
    """

    volumes: Floats
    centres: Floats
    moments: Floats

    @property
    def inertia(self) -> Floats:
        """Integral of |r|^2 I - r r^T, r = x - p (n, 3, 3) [m5]; times density, the inertia."""
        trace = np.trace(self.moments, axis1=1, axis2=2)
        return np.asarray(trace[:, None, None] * np.eye(3) - self.moments)


def point_volumes(region: Region, points: ArrayLike, *, fineness: int = 200) -> Floats:
    """Volume (n,) [m3] of each point's share of a region; see `point_shares`."""
    return point_shares(region, points, fineness=fineness).volumes


def point_shares(region: Region, points: ArrayLike, *, fineness: int = 200) -> Shares:
    """What of a region is nearer to each point than to the others, on a grid of fine cells.

    A cell that the plane between its two nearest points cuts is divided between them, so that
    the shares of points on a grid are exact; then all are scaled to add up to the region's
    volume.

    Args:
        region: what is shared out.
        points: positions (n, 3) [m] inside it.
        fineness: about how many cells there are to each point.

    Raises:
        ParameterError: no points, points outside or at the same place, a fineness below 8, or a
            point that no fine cell is near to.
    """
    places = _distinct(region, points)
    centres, weights, size = fine_cells(region, len(places), fineness)
    shares = shared_out(places, centres, weights, np.broadcast_to(size, centres.shape))
    _require_positive(shares.volumes)
    factor = region.volume / float(shares.volumes.sum())
    volumes = shares.volumes * factor
    return Shares(volumes, shares.centres, shares.moments * factor)


def fine_cells(region: Region, count: int, fineness: int) -> tuple[Floats, Floats, Floats]:
    """Centres (m, 3), volumes (m,) and sides (3,) of the fine cells that are inside.

    Of a cell that the border cuts, as much as is inside of its eight halves, and their centre.
    """
    if not 8 <= fineness <= 100_000:
        raise ParameterError(f"found fineness {fineness!r}; numbers from 8 to 100000 are accepted")
    sides = np.ptp(region.bounds, axis=0)
    step = (region.volume / (count * fineness)) ** (1 / 3)
    counts = np.maximum(np.ceil(sides / step), 4).astype(np.int64)
    if counts.prod() > MOST_CELLS / 5:
        raise ParameterError(
            f"found {count} points with fineness {fineness}, which makes {counts.prod():.2g} "
            f"cells; up to {MOST_CELLS / 5:.0e} are accepted: take a smaller fineness"
        )
    size = sides / counts
    axes = np.meshgrid(*map(np.arange, counts), indexing="ij")
    middles = region.bounds[0] + (np.stack(axes, axis=-1) + 0.5) * size
    inside = region.inside(middles.reshape(-1, 3)).reshape(counts)
    border = _spread(inside) & _spread(~inside)
    whole, cut = middles[inside & ~border], middles[border]
    halves = np.array(list(itertools.product((-0.25, 0.25), repeat=3))) * size
    parts = cut[:, None] + halves
    within = region.inside(parts.reshape(-1, 3)).reshape(-1, 8)
    of = within.sum(axis=1)
    some = of > 0
    centre = (parts[some] * within[some][..., None]).sum(axis=1) / of[some, None]
    weights = np.concatenate([np.ones(len(whole)), of[some] / 8.0]) * size.prod()
    return np.concatenate([whole, centre]), weights, size


def _spread(mask: Bools) -> Bools:
    """The mask and the cells around it, and those at the ends, beyond which nothing is known."""
    found = np.pad(mask, 1, constant_values=True)
    for axis in range(3):
        body = np.moveaxis(found, axis, 0)
        body[1:-1] |= np.logical_or(body[:-2], body[2:])
    return found[1:-1, 1:-1, 1:-1]


def shared_out(points: Floats, centres: Floats, weights: Floats, sides: Floats) -> Shares:
    """Shares of cells (m, 3) of given weights (m,) and sides (m, 3) among points (n, 3).

    A point that gets nothing has the volume 0 and itself as the centre.
    """
    first, second, part = _two_nearest(points, centres, sides)
    volumes, sums = np.zeros(len(points)), np.zeros((len(points), 3))
    moments = np.zeros((len(points), 3, 3))
    for who, portion in ((first, part * weights), (second, (1.0 - part) * weights)):
        away = centres - points[who]
        volumes += np.bincount(who, weights=portion, minlength=len(points))
        for i in range(3):
            sums[:, i] += np.bincount(who, portion * away[:, i], len(points))
            for j in range(3):
                product = away[:, i] * away[:, j] + (i == j) * sides[:, i] ** 2 / 12.0
                moments[:, i, j] += np.bincount(who, portion * product, len(points))
    mean = sums / np.where(volumes > 0.0, volumes, 1.0)[:, None]
    return Shares(volumes, points + mean, moments)


def _two_nearest(points: Floats, centres: Floats, sides: Floats) -> tuple[Indices, Indices, Floats]:
    """The nearest and the second point of each cell, and which part of it is the nearest's.

    What is nearest anywhere within r of c is within D + 2 r of c, where D is the distance from c
    to its second nearest point.
    """
    first = np.zeros(len(centres), dtype=np.int64)
    second, part = first.copy(), np.ones(len(centres))
    if len(points) == 1:
        return first, second, part
    for block in _blocks(centres, _BLOCK * float(sides.max())):
        x = centres[block]
        middle = (x.min(axis=0) + x.max(axis=0)) / 2.0
        radius = np.linalg.norm(x - middle, axis=1).max()
        away = np.linalg.norm(points - middle, axis=1)
        near = np.flatnonzero(away <= np.partition(away, 1)[1] + 2.0 * radius * (1 + 1e-9) + 1e-300)
        square = ((x[:, None] - points[near]) ** 2).sum(axis=2)
        order = np.argpartition(square, 1, axis=1)[:, :2]
        two = np.take_along_axis(square, order, axis=1)
        order = np.where(two[:, :1] <= two[:, 1:], order, order[:, ::-1])
        first[block], second[block] = near[order].T
    between = points[first] - points[second]
    length = np.linalg.norm(between, axis=1)
    ahead = ((centres - (points[first] + points[second]) / 2.0) * between).sum(axis=1) / length
    width = np.linalg.norm(between / length[:, None] * sides, axis=1)
    return first, second, np.clip(0.5 + ahead / width, 0.5, 1.0)


def _blocks(centres: Floats, size: float) -> list[Indices]:
    """Numbers of the cells in each cube of a coarse grid."""
    place = np.floor((centres - centres.min(axis=0)) / size).astype(np.int64)
    shape = place.max(axis=0) + 1
    key = (place[:, 0] * shape[1] + place[:, 1]) * shape[2] + place[:, 2]
    order = np.argsort(key, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(key[order])) + 1)


def _distinct(region: Region, points: ArrayLike) -> Floats:
    places = positions(points)
    if not len(places):
        raise ParameterError("found no points; one or more inside the region are accepted")
    outside = np.flatnonzero(~region.inside(places))
    if len(outside):
        raise ParameterError(
            f"found {len(outside)} of {len(places)} points outside (first: {outside[0]}); points "
            "inside the region are accepted: leave these out"
        )
    _, kept, count = np.unique(places, axis=0, return_index=True, return_counts=True)
    if len(kept) < len(places):
        raise ParameterError(
            f"found {len(places) - len(kept)} of {len(places)} points at the place of another "
            f"(first: {kept[count > 1].min()}); points that differ are accepted: leave these out"
        )
    return places


def _require_positive(volumes: Floats) -> None:
    empty = np.flatnonzero(volumes <= 0.0)
    if len(empty):
        raise ParameterError(
            f"found {len(empty)} of {len(volumes)} points that no fine cell is near to (first: "
            f"{empty[0]}); points some distance apart are accepted: give a larger fineness, or "
            "space the points"
        )
