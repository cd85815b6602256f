"""Poisson-disk points inside a region: nowhere nearer than a distance, nowhere a gap."""

from __future__ import annotations

import itertools
from operator import index

import numpy as np

from tissu.errors import ParameterError
from tissu.mesh.cell import Floats
from tissu.sampling.darts import Darts
from tissu.sampling.region import Indices, Region, drawn, fitting

_ROUNDS = (16, 4, 4, 4, 4, 4)  # of darts, one in each cell, before cells are halved
_DENSITY = 0.8  # points per distance^3 of a large region, measured; where the search starts
_CORNERS = np.array([(0.5, 0.5, 0.5), *itertools.product((0.0, 1.0), repeat=3)])


def poisson_points(region: Region, distance: float, *, seed: int = 0) -> Floats:
    """Points (n, 3) [m] inside a region, no two nearer than `distance`, with no room for another.

    Room is looked for down to cubes of diagonal distance / 32: nothing inside is further than
    33/32 of the distance from a point, but for parts of the region thinner than a fifth of the
    distance, of which corners may be missed. The same seed gives the same points.

    Args:
        region: what the points lie in.
        distance: smallest distance of two points [m].
        seed: of the random numbers.

    Raises:
        ParameterError: a distance that is not positive, is larger than the region or finds no
            point inside.
    """
    darts = Darts(region.bounds, fitting(region, distance, "distance"))
    rng = drawn(seed)
    cells = np.stack(np.meshgrid(*map(np.arange, darts.shape), indexing="ij"), axis=-1)
    cells = cells.reshape(-1, 3)
    for level, rounds in enumerate(_ROUNDS):
        size = darts.side / 2**level
        cells = _throw(region, darts, cells, size, rounds, rng)
        if level + 1 < len(_ROUNDS):
            halves = np.array(list(itertools.product((0, 1), repeat=3)))
            cells = (2 * cells[:, None] + halves).reshape(-1, 3)
            cells = _uncovered(darts, cells, size / 2)
    _fill(region, darts, cells, darts.side / 2 ** (len(_ROUNDS) - 1), rng)
    if not len(darts.samples):
        raise ParameterError(
            f"found no place inside for a point with distance {distance:g} m; a region that is "
            "not much thinner than the distance is accepted: take a smaller one"
        )
    return darts.samples


def _throw(
    region: Region,
    darts: Darts,
    cells: Indices,
    size: float,
    rounds: int,
    rng: np.random.Generator,
) -> Indices:
    """Rounds of one dart in each cell; the cells that are left, where something was inside."""
    seen = np.zeros(len(cells), dtype=bool)
    for _ in range(rounds):
        places = darts.low + (cells + rng.random(cells.shape)) * size
        free = darts.free(places)
        found = np.zeros(len(cells), dtype=bool)
        found[free] = region.inside(places[free])
        seen |= found
        if darts.accept(places[found], rng):
            keep = ~darts.covered(darts.low + (cells + 0.5) * size, size / 2)
            cells, seen = cells[keep], seen[keep]
    unseen = np.flatnonzero(~seen)
    corners = darts.low + (cells[unseen, None] + _CORNERS) * size
    inside = region.inside(corners.reshape(-1, 3)).reshape(-1, len(_CORNERS))
    seen[unseen] = inside.any(axis=1)
    return cells[seen]


def _uncovered(darts: Darts, cells: Indices, size: float) -> Indices:
    return cells[~darts.covered(darts.low + (cells + 0.5) * size, size / 2)]


def _fill(
    region: Region, darts: Darts, cells: Indices, size: float, rng: np.random.Generator
) -> None:
    """Puts points at centres and corners of the last cells until none of these places is free."""
    places = (darts.low + (cells[:, None] + _CORNERS) * size).reshape(-1, 3)
    places = places[darts.free(places)]
    places = places[region.inside(places)]
    while len(places):
        darts.accept(places, rng)
        places = places[darts.free(places)]


def poisson_count(region: Region, count: int, *, seed: int = 0) -> Floats:
    """About `count` Poisson-disk points (n, 3) [m]: to 3 percent, or one point of few.

    Raises:
        ParameterError: a count below 1, or the region as `poisson_points`.
    """
    return poisson_search(region, count, seed=seed)[0]


def poisson_distance(region: Region, count: int, *, seed: int = 0) -> float:
    """The distance [m] at which `poisson_points` with this seed gives about `count` points.

    Raises:
        ParameterError: a count below 1, or the region as `poisson_points`.
    """
    return poisson_search(region, count, seed=seed)[1]


def poisson_search(region: Region, count: int, *, seed: int = 0) -> tuple[Floats, float]:
    """What `poisson_count` and `poisson_distance` give, for one search.

    Raises:
        ParameterError: a count below 1, or the region as `poisson_points`.
    """
    try:
        wanted = index(count)
    except TypeError:
        wanted = 0
    if wanted < 1:
        raise ParameterError(f"found count {count!r}; a whole number from 1 on is accepted")
    longest = float(np.ptp(region.bounds, axis=0).max())
    low, high = 0.0, longest  # too many points at low, too few at high
    distance = min(float((_DENSITY * region.volume / wanted) ** (1 / 3)), longest)
    tried: list[tuple[int, float, Floats]] = []
    for _ in range(12):
        points = poisson_points(region, distance, seed=seed)
        found = len(points)
        tried.append((abs(found - wanted), distance, points))
        if tried[-1][0] <= 0.03 * wanted:
            break
        low, high = (distance, high) if found > wanted else (low, distance)
        distance *= float((found / wanted) ** (1 / 3))
        if not low < distance < high:
            distance = (low + high) / 2
    _, distance, points = min(tried, key=lambda one: one[:2])
    return points, distance
