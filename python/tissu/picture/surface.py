"""One surface as a picture with a transparent background."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tissu.errors import ParameterError
from tissu.picture.camera import Camera
from tissu.picture.raster import Seen, rasterise
from tissu.picture.shading import corner_normals, shade

if TYPE_CHECKING:
    from matplotlib.colors import Colormap

Array = NDArray[np.float64]

CLAY = (0.80, 0.47, 0.40)  # colour of a surface without values
FINER = 2  # pixels rendered for each one shown, in each direction
PORTION = 16384  # pixels that are shaded at once: what is between stays in the cache
STEP = 6.0  # a jump in nearness [pixels] that is drawn as an edge


@dataclass(frozen=True, slots=True)
class Layer:
    """A rendered surface: colour (h,w,3), whether it covers (h,w), nearness (h,w; -inf: none)."""

    colour: Array
    covered: NDArray[np.bool_]
    nearness: Array


def render_surface(
    points: ArrayLike,
    triangles: ArrayLike,
    values: ArrayLike | None = None,
    *,
    camera: Camera,
    colour: tuple[float, float, float] = CLAY,
    colormap: str | Colormap = "viridis",
    limits: tuple[float, float] | None = None,
) -> Array:
    """A shaded surface as RGBA (height, width, 4) in [0, 1], transparent beside the surface.

    Args:
        points: (n,3) [m].
        triangles: (t,3) numbers of points.
        values: (n,) or (t,), coloured through the colour map; None: one colour.
        camera: the view.
        colour: red, green, blue in [0, 1] of a surface without values.
        colormap: a colour map of matplotlib, or its name.
        limits: values at both ends of the colour map; None: the smallest and largest value.

    Raises:
        ParameterError: arrays whose shapes do not fit together, or numbers of points that are not.
    """
    fine = camera.enlarged(FINER)
    layer = render_layer(
        points,
        triangles,
        values,
        camera=fine,
        colour=colour,
        colormap=colormap,
        limits=limits,
    )
    shown = np.zeros((camera.size[1], camera.size[0], 4))
    rows, columns = (_reach(np.asarray(layer.covered.any(axis=k))) for k in (1, 0))
    part = tuple(slice(FINER * some.start, FINER * some.stop) for some in (rows, columns))
    shown[rows, columns] = flatten(layer.colour[part], layer.covered[part].astype(np.float64))
    return shown


def _reach(covered: NDArray[np.bool_]) -> slice:
    """The shown pixels from the first to the last of which a finer one is covered."""
    at = np.flatnonzero(covered) // FINER
    return slice(int(at[0]), int(at[-1]) + 1) if len(at) else slice(0, 0)


def render_layer(
    points: ArrayLike,
    triangles: ArrayLike,
    values: ArrayLike | None,
    *,
    camera: Camera,
    colour: tuple[float, float, float],
    colormap: str | Colormap = "viridis",
    limits: tuple[float, float] | None = None,
) -> Layer:
    """A shaded surface at the camera's own pixels; arguments as for `render_surface`."""
    at, cells = _checked(points, triangles)
    width, height = camera.size
    seen = rasterise(camera.project(at), cells, camera.size)
    turned = at @ camera.axes.T
    normals = corner_normals(turned, cells)
    a, b, c = (turned[cells[:, k], :2] for k in range(3))
    towards = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    paint = _paint(values, cells, at, colour, colormap, limits)
    picture = np.zeros((height * width, 3))
    for start in range(0, len(seen.pixel), PORTION):
        some = seen.part(slice(start, start + PORTION))
        normal = (some.weights[:, None] @ normals[some.triangle])[:, 0]
        picture[some.pixel] = shade(paint(some), normal, towards[some.triangle])
    nearness = np.full(height * width, -np.inf)
    nearness[seen.pixel] = seen.nearness
    near = nearness.reshape(height, width)
    shown = picture.reshape(height, width, 3)
    window = _window(seen, width)
    shown[window] *= (1 - 0.45 * edges(near[window]))[..., None]
    return Layer(shown, np.isfinite(near), near)


def _window(seen: Seen, width: int) -> tuple[slice, slice]:
    """The rows and columns in which something is seen, and one more on each side."""
    if not len(seen.pixel):
        return slice(0), slice(0)
    row, column = seen.pixel // width, seen.pixel % width
    low, left = max(int(row[0]) - 1, 0), max(int(column.min()) - 1, 0)
    return slice(low, int(row[-1]) + 2), slice(left, int(column.max()) + 2)


def edges(nearness: Array) -> Array:
    """(h,w) of 0 and 1: covered pixels at the near side of a jump in nearness."""
    near = np.where(np.isfinite(nearness), nearness, np.nan)
    edge = np.zeros(near.shape)
    for view, mark in ((near, edge), (near.T, edge.T)):
        here, before, after = view[1:-1], view[:-2], view[2:]
        # Second differences: a surface seen at a grazing angle is steep, but does not jump.
        mark[1:-1] += (np.abs(2 * here - before - after) > STEP) & (here > np.fmin(before, after))
    return np.minimum(edge, 1.0)


def flatten(colour: Array, opacity: Array) -> Array:
    """RGBA of the shown pixels from the finer ones: colour (h,w,3), opacity (h,w)."""
    parts = [(slice(i, None, FINER), slice(j, None, FINER)) for i, j in np.ndindex(FINER, FINER)]
    alpha = sum((opacity[at] for at in parts), np.zeros(())) / FINER**2
    total = sum((colour[at] * opacity[at][..., None] for at in parts), np.zeros(())) / FINER**2
    return np.dstack([total / np.maximum(alpha, 1e-9)[..., None], alpha])


def _checked(points: ArrayLike, triangles: ArrayLike) -> tuple[Array, NDArray[np.int64]]:
    at = np.asarray(points, dtype=np.float64)
    cells = np.asarray(triangles, dtype=np.int64).reshape(-1, 3)
    if at.ndim != 2 or at.shape[1] != 3:
        raise ParameterError(f"points of a surface have the shape (n, 3); found {at.shape}")
    if len(cells) and not (cells.min() >= 0 and cells.max() < len(at)):
        found = f"{cells.min()} to {cells.max()}"
        raise ParameterError(f"triangles name points 0 to {len(at) - 1}; found {found}")
    return at, cells


def _paint(
    values: ArrayLike | None,
    cells: NDArray[np.int64],
    points: Array,
    colour: tuple[float, float, float],
    colormap: str | Colormap,
    limits: tuple[float, float] | None,
) -> Callable[[Seen], Array]:
    """What gives the colours (p,3) of seen pixels."""
    from matplotlib import colormaps

    if values is None:
        return lambda seen: np.broadcast_to(np.array(colour), (len(seen.pixel), 3))
    every = np.asarray(values, dtype=np.float64)
    if every.shape not in ((len(points),), (len(cells),)):
        raise ParameterError(
            f"values of a surface: one for each of {len(points)} points or {len(cells)} triangles; "
            f"found the shape {every.shape}"
        )
    at_corners = every[cells] if every.shape == (len(points),) else every[:, None].repeat(3, axis=1)
    low, high = limits or (float(every.min()), float(every.max()))
    chosen = colormaps[colormap] if isinstance(colormap, str) else colormap

    def mapped(seen: Seen) -> Array:
        at_pixel = (at_corners[seen.triangle] * seen.weights).sum(axis=1)
        share = (at_pixel - low) / (high - low) if high > low else np.zeros_like(at_pixel)
        return np.asarray(chosen(share)[:, :3], dtype=np.float64)

    return mapped
