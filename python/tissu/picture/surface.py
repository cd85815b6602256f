"""One surface as a picture with a transparent background."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tissu import _core
from tissu.errors import ParameterError
from tissu.picture.camera import Camera
from tissu.picture.normals import corner_normals

if TYPE_CHECKING:
    from matplotlib.colors import Colormap

Array = NDArray[np.float64]

CLAY = (0.80, 0.47, 0.40)  # colour of a surface without values
FINER = 2  # pixels rendered for each one shown, in each direction
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
    layer = render_layer(
        points,
        triangles,
        values,
        camera=camera.enlarged(FINER),
        colour=colour,
        colormap=colormap,
        limits=limits,
    )
    return flatten(layer.colour, layer.covered.astype(np.float64))


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
    turned = at @ camera.axes.T
    a, b, c = (turned[cells[:, k], :2] for k in range(3))
    towards = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    at_corners, table, (low, high) = _paint(values, cells, at, colormap, limits)
    shown, near = _core.render(
        corners=camera.project(at),
        triangles=cells,
        normals=corner_normals(turned, cells),
        towards=towards,
        values=at_corners,
        table=table,
        low=low,
        high=high,
        colour=colour,
        width=camera.size[0],
        height=camera.size[1],
        step=STEP,
    )
    return Layer(shown, np.isfinite(near), near)


def flatten(colour: Array, opacity: Array) -> Array:
    """RGBA of the shown pixels from the finer ones: colour (h,w,3), opacity (h,w)."""
    return _core.shown_pixels(colour=colour, opacity=opacity, finer=FINER)


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
    colormap: str | Colormap,
    limits: tuple[float, float] | None,
) -> tuple[Array, Array, tuple[float, float]]:
    """Values (t,3) at the corners, the table of colours (m,3), and the values at its ends."""
    if values is None:
        return np.empty((0, 3)), np.empty((0, 3)), (0.0, 1.0)
    from matplotlib import colormaps

    every = np.asarray(values, dtype=np.float64)
    if every.shape not in ((len(points),), (len(cells),)):
        raise ParameterError(
            f"values of a surface: one for each of {len(points)} points or {len(cells)} triangles; "
            f"found the shape {every.shape}"
        )
    at_corners = every[cells] if every.shape == (len(points),) else every[:, None].repeat(3, axis=1)
    chosen = colormaps[colormap] if isinstance(colormap, str) else colormap
    parts, beyond = chosen(np.arange(chosen.N)), chosen(np.array([-1.0, 2.0, np.nan]))
    table = np.concatenate([parts, beyond])[:, :3]
    return at_corners, table, limits or (float(every.min()), float(every.max()))
