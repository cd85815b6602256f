"""Colours of the series of a diagram: as many as are asked for, all of them different.

Matplotlib's ten come first. Each one after them is the colour of a grid that is farthest from the
paper and from all before it in CIELAB, where distance is what the eye sees of it (CIE 15:2004).
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_GRID = 9  # shades of red, green and blue each
_LIGHTEST = 80.0  # of 100: thin lines stand out from the paper
_TO_XYZ = np.array(  # linear sRGB, over the white of D65 (IEC 61966-2-1)
    [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
) / np.array([[0.9505], [1.0], [1.089]])


@lru_cache(maxsize=8)
def series_colours(count: int) -> tuple[str, ...]:
    """Colours of `count` series as #rrggbb; those of fewer series are the first of these."""
    from matplotlib.colors import TABLEAU_COLORS

    chosen = [str(colour) for colour in TABLEAU_COLORS.values()][:count]
    shades = np.linspace(0.0, 1.0, _GRID)
    grid = np.stack(np.meshgrid(shades, shades, shades, indexing="ij"), axis=-1).reshape(-1, 3)
    seen = in_lab(grid)
    grid, seen = grid[seen[:, 0] <= _LIGHTEST], seen[seen[:, 0] <= _LIGHTEST]
    apart = np.full(len(grid), np.inf)
    for taken in ((1.0, 1.0, 1.0), (0.0, 0.0, 0.0), *map(_numbers, chosen)):
        apart = np.minimum(apart, _distances(seen, np.array(taken)))
    while len(chosen) < count:
        colour = grid[int(np.argmax(apart))]
        chosen.append("#" + "".join(f"{round(255 * part):02x}" for part in colour))
        apart = np.minimum(apart, _distances(seen, colour))
    return tuple(chosen)


def in_lab(colours: Array) -> Array:
    """CIELAB coordinates (n, 3) of sRGB colours (n, 3) in [0, 1]."""
    linear = np.where(colours > 0.04045, ((colours + 0.055) / 1.055) ** 2.4, colours / 12.92)
    x = linear @ _TO_XYZ.T
    f = np.where(x > (6 / 29) ** 3, np.cbrt(x), x / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.stack(
        [116 * f[:, 1] - 16, 500 * (f[:, 0] - f[:, 1]), 200 * (f[:, 1] - f[:, 2])], axis=1
    )


def _distances(seen: Array, colour: Array) -> Array:
    return np.asarray(np.linalg.norm(seen - in_lab(colour[None]), axis=1))


def _numbers(colour: str) -> tuple[float, ...]:
    return tuple(int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
