"""Several surfaces in one picture, each in its colour: computed beside measured."""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tissu.errors import ParameterError
from tissu.picture import layout
from tissu.picture.camera import Camera, look_at
from tissu.picture.surface import FINER, Layer, flatten, render_layer

Array = NDArray[np.float64]
Surface = tuple[ArrayLike, ArrayLike, str, str]

VEIL = 0.72  # opacity of a surface in front of others


def draw_overlay(
    path: str | PathLike[str],
    surfaces: Sequence[Surface],
    *,
    up: ArrayLike = (0.0, 0.0, 1.0),
    size: tuple[int, int] = (1000, 800),
    title: str = "",
) -> None:
    """Writes a PNG of several surfaces in one view, the nearer ones a little transparent.

    Args:
        path: the PNG file; its folder is made.
        surfaces: points (n,3) [m], triangles (t,3), colour as matplotlib names it, label.
        up: (3,) direction to the top of the picture, minus gravity as a rule.
        size: width and height [pixels].
        title: a line above.

    Raises:
        ParameterError: no surface, or arrays that do not fit together.
        TissuError: the file cannot be written.
    """
    from matplotlib.patches import Patch

    if not surfaces:
        raise ParameterError("an overlay needs at least one surface")
    figure, text = layout.sheet(size), layout.letters((2 * size[0], size[1]))
    top = round(0.08 * size[1])
    panel_size = (size[0], size[1] - top)
    camera = look_at([s[0] for s in surfaces], size=panel_size, up=up)
    axes = layout.panel(figure, 0, top, camera)
    layout.place(axes, _together(surfaces, camera), camera)
    layout.length_bar(axes, camera, text)
    patches = [Patch(color=colour, label=label) for _, _, colour, label in surfaces]
    axes.legend(
        handles=patches, loc="upper right", frameon=False, fontsize=text, labelcolor=layout.INK
    )
    figure.text(0.5, 0.945, title, ha="center", fontsize=1.3 * text, color=layout.INK)
    layout.save(figure, Path(path))


def _together(surfaces: Sequence[Surface], camera: Camera) -> Array:
    """RGBA (h,w,4) of all surfaces in one view."""
    from matplotlib.colors import to_rgb

    fine = camera.enlarged(FINER)
    layers = [
        render_layer(points, triangles, None, camera=fine, colour=to_rgb(colour))
        for points, triangles, colour, _ in surfaces
    ]
    return flatten(*blend(layers))


def blend(layers: Sequence[Layer]) -> tuple[Array, Array]:
    """Colour (h,w,3) and opacity (h,w) of layers, sorted by nearness at each pixel."""
    covered = np.stack([layer.covered for layer in layers])
    anywhere = covered.any(axis=0)
    covered = covered[:, anywhere]
    colours = np.stack([layer.colour[anywhere] for layer in layers])
    order = np.argsort([layer.nearness[anywhere] for layer in layers], axis=0)  # farthest first
    pixel = np.arange(covered.shape[1])
    mixed = np.zeros((len(pixel), 3))
    below = np.zeros(len(pixel), dtype=bool)
    for rank in order:
        covers = covered[rank, pixel]
        share = np.where(covers, np.where(below, VEIL, 1.0), 0.0)[:, None]
        mixed = share * colours[rank, pixel] + (1 - share) * mixed
        below |= covers
    result: Array = np.zeros((*anywhere.shape, 3))
    result[anywhere] = mixed
    return result, np.where(anywhere, 1.0, 0.0)
