"""Segments joined into stretches."""

from __future__ import annotations

import numpy as np

from tissu.mesh.cell import Ints


def chains(segments: Ints) -> list[list[int]]:
    """Nodes along each stretch between ends and branchings of segments (s, 2), and each ring."""
    pairs = [(int(a), int(b)) for a, b in np.unique(np.sort(segments, axis=1), axis=0)]
    around: dict[int, list[int]] = {}
    for a, b in pairs:
        around.setdefault(a, []).append(b)
        around.setdefault(b, []).append(a)
    left = set(pairs)
    ends = [node for node, others in around.items() if len(others) != 2]
    found = []
    for start in [*ends, *around]:  # what no end leads to is a ring, and starts anywhere
        for first in around[start]:
            if (min(start, first), max(start, first)) in left:
                found.append(_walk(start, first, around, left))
    return found


def _walk(
    start: int, first: int, around: dict[int, list[int]], left: set[tuple[int, int]]
) -> list[int]:
    """The nodes from `start` on up to an end, a branching or the start; takes its segments."""
    way = [start, first]
    left.discard((min(start, first), max(start, first)))
    while way[-1] != start and len(around[way[-1]]) == 2:
        here, before = way[-1], way[-2]
        after = next(other for other in around[here] if other != before)
        left.discard((min(here, after), max(here, after)))
        way.append(after)
    return way
