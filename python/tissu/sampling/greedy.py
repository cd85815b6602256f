"""As many of given places as keep a distance, taken in a drawn order."""

from __future__ import annotations

import itertools

import numpy as np

from tissu.mesh.cell import Floats
from tissu.sampling.region import Indices


def spaced(places: Floats, distance: float, rng: np.random.Generator) -> Indices:
    """Numbers (n,), increasing, of places (m, 3) no two nearer than `distance` [m].

    Every place that is left out is nearer than the distance to one that is taken.
    """
    cell = np.floor((places - places.min(axis=0)) / distance).astype(np.int64) + 1
    shape = cell.max(axis=0) + 2
    strides = np.array([shape[1] * shape[2], shape[2], 1])
    key = cell @ strides
    order = np.argsort(key, kind="stable")
    ordered = key[order]
    rows = np.array(list(itertools.product((-1, 0, 1), repeat=2))) @ strides[:2]
    open_ = np.ones(len(places), dtype=bool)
    taken = []
    for place in rng.permutation(len(places)).tolist():
        if not open_[place]:
            continue
        taken.append(place)
        low = np.searchsorted(ordered, key[place] + rows - 1)
        high = np.searchsorted(ordered, key[place] + rows + 1, side="right")
        near = np.concatenate([order[a:b] for a, b in zip(low, high, strict=True)])
        near = near[open_[near]]
        away = places[near] - places[place]
        open_[near[np.einsum("ij,ij->i", away, away) < distance**2]] = False
    return np.sort(np.array(taken, dtype=np.int64))
