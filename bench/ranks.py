"""Two tests of ranks: how often ranks given out by chance differ as much as those found.

Exact for few values, by counting; the sums of many ranks are all but normal. Equal values share
their rank.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

MOST_COUNTED = 50  # values


def rank_sum_chance(old: Sequence[float], new: Sequence[float]) -> float:
    """Mann and Whitney's test, of independent values: the old ones' sum of ranks among all."""
    ranks = doubled_ranks(np.array([*old, *new]))
    found = int(ranks[: len(old)].sum())
    if len(ranks) <= MOST_COUNTED:
        return chance_of(sums_of_subsets(tuple(sorted(ranks.tolist())), len(old)), found)
    every = len(ranks)
    variance = len(old) * len(new) / (every - 1) * float(np.var(ranks))
    return normal_chance(found - len(old) * float(np.mean(ranks)), variance)


def signed_rank_chance(differences: Sequence[float]) -> float:
    """Wilcoxon's test, of pairs: the sum of ranks of the differences above zero."""
    found = np.array([d for d in differences if d != 0.0])
    if not len(found):
        return 1.0
    ranks = doubled_ranks(np.abs(found))
    above = int(ranks[found > 0.0].sum())
    if len(ranks) <= MOST_COUNTED:
        return chance_of(sums_of_subsets(tuple(sorted(ranks.tolist())), None), above)
    return normal_chance(above - 0.5 * float(ranks.sum()), 0.25 * float((ranks**2).sum()))


def doubled_ranks(values: NDArray[np.float64]) -> NDArray[np.int64]:
    """Twice the rank of each value: whole numbers, also where values are equal."""
    below = (values[None, :] < values[:, None]).sum(axis=1)
    equal = (values[None, :] == values[:, None]).sum(axis=1)
    return np.asarray(2 * below + equal + 1, dtype=np.int64)


@lru_cache(maxsize=64)
def sums_of_subsets(ranks: tuple[int, ...], size: int | None) -> NDArray[np.float64]:
    """How many subsets of the ranks, of this size or of any, have each sum."""
    total = sum(ranks)
    if size is None:
        counts = np.zeros(total + 1)
        counts[0] = 1.0
        for rank in ranks:
            counts[rank:] += counts[: total + 1 - rank].copy()
        return counts
    by_size = np.zeros((size + 1, total + 1))
    by_size[0, 0] = 1.0
    for rank in ranks:
        by_size[1:, rank:] += by_size[:-1, : total + 1 - rank].copy()
    return np.asarray(by_size[size])


def chance_of(counts: NDArray[np.float64], found: int) -> float:
    """How often a sum is as far from its mean as the one found."""
    sums = np.arange(len(counts))
    mean = (sums * counts).sum() / counts.sum()
    far = np.abs(sums - mean) >= abs(found - mean) - 1e-9
    return float(counts[far].sum() / counts.sum())


def normal_chance(distance: float, variance: float) -> float:
    """The same for a normal sum at a distance from its mean."""
    return math.erfc(abs(distance) / math.sqrt(2.0 * variance)) if variance > 0.0 else 1.0
