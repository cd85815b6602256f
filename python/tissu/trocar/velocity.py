"""Speeds from counts, by first-order adaptive windowing.

The longest window over which a straight line through its ends misses no sample by more than one
count (Janabi-Sharifi, Hayward, Chen 2000). One count in a tick alone would be 0.1 m/s.
"""

from __future__ import annotations

from collections.abc import Sequence

WINDOW = 32
"""Samples at most."""


def speed(positions: Sequence[float], count: float, period: float) -> float:
    """Speed of the last of positions, the newest at the end; 0 of a single one."""
    newest = list(positions)[-WINDOW:][::-1]
    best = 0.0
    for n in range(1, len(newest)):
        slope = (newest[0] - newest[n]) / n
        misses = [abs(newest[0] - slope * j - newest[j]) for j in range(1, n)]
        if max(misses, default=0.0) > count * (1.0 + 1e-9):
            break
        best = slope
    return best / period
