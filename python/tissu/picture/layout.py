"""The sheet a picture stands on: panels, colour bar, length bar and words, by matplotlib."""

from __future__ import annotations

import contextlib
import logging
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.errors import ParameterError, TissuError
from tissu.files import require_file_place, whole_file
from tissu.files.place import reason_of
from tissu.picture.camera import Camera

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import Colormap
    from matplotlib.figure import Figure

Array = NDArray[np.float64]

INK = "#30343b"
FAINT = "#8a9099"
PAPER = "#ffffff"
DPI = 100


def sheet(size: tuple[int, int]) -> Figure:
    """An empty figure of `size` pixels, drawn without a display."""
    with _without_notice():
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure

    figure = Figure(figsize=(size[0] / DPI, size[1] / DPI), dpi=DPI, facecolor=PAPER)
    FigureCanvasAgg(figure)
    return figure


@contextlib.contextmanager
def _without_notice() -> Iterator[None]:
    """Keeps matplotlib from announcing, once on each machine, that it looks for fonts."""
    logger = logging.getLogger("matplotlib.font_manager")
    before = logger.level
    logger.setLevel(logging.ERROR)
    try:
        yield
    finally:
        logger.setLevel(before)


def letters(size: tuple[int, int]) -> float:
    """Size of the letters [points] for a picture of `size` pixels."""
    return max(5.0, min(size[1] / 800, size[0] / 1600) * 13.0)


def panel(figure: Figure, left: int, top: int, camera: Camera) -> Axes:
    """Axes over the camera's pixels at a place of the sheet [pixels from the top left]."""
    width, height = figure.get_size_inches() * DPI
    wide, high = camera.size
    axes = figure.add_axes(
        (left / width, 1 - (top + high) / height, wide / width, high / height), frameon=False
    )
    axes.set_xlim(0, wide)
    axes.set_ylim(high, 0)
    axes.set_axis_off()
    return axes


def place(axes: Axes, picture: Array, camera: Camera) -> None:
    """Shows a rendered picture (h,w,4) pixel by pixel."""
    wide, high = camera.size
    axes.imshow(picture.clip(0, 1), extent=(0, wide, high, 0), interpolation="nearest", zorder=2)
    axes.set_xlim(0, wide)
    axes.set_ylim(high, 0)


def outline(axes: Axes, opacity: Array, colour: str = FAINT) -> None:
    """Draws the contour of a shape, given by its opacity (h,w), behind what is shown."""
    if opacity.max() < 0.5 or min(opacity.shape) < 2:
        return
    high, wide = opacity.shape
    x, y = np.arange(wide) + 0.5, np.arange(high) + 0.5
    axes.contour(x, y, opacity, [0.5], colors=[colour], linewidths=1.2, linestyles="--", zorder=1)


def length_bar(axes: Axes, camera: Camera, size: float) -> None:
    """A bar of a round length at the lower left: a parallel projection has one scale."""
    length = round_below(0.25 * camera.size[0] / camera.scale)
    left, low = 0.04 * camera.size[0], 0.96 * camera.size[1]
    right = left + length * camera.scale
    axes.plot([left, right], [low, low], color=INK, linewidth=2.2, solid_capstyle="butt", zorder=4)
    text = shown_length(length)
    axes.text((left + right) / 2, low - 5, text, ha="center", va="bottom", fontsize=size, color=INK)


def colours() -> Colormap:
    """Viridis without its darkest fifth, which hides the shape under shading."""
    from matplotlib import colormaps
    from matplotlib.colors import ListedColormap

    return ListedColormap(colormaps["viridis"](np.linspace(0.2, 1.0, 256)), name="tissu")


def colour_bar(
    figure: Figure,
    place: tuple[float, float, float, float],
    limits: tuple[float, float],
    label: str,
    size: float,
    colormap: Colormap,
) -> None:
    """A colour bar at (left, bottom, width, height), as shares of the sheet."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    axes = figure.add_axes(place)
    bar = figure.colorbar(ScalarMappable(Normalize(*limits), colormap), cax=axes)
    bar.set_label(label, fontsize=size, color=INK)
    axes.tick_params(labelsize=0.9 * size, colors=INK)
    bar.outline.set_visible(False)


def require_png(path: Path) -> None:
    """Pictures are PNG files, and are named so.

    Raises:
        ParameterError: a name that ends otherwise.
    """
    if path.suffix.lower() != ".png":
        found = f"that ends in {path.suffix}" if path.suffix else "without an ending"
        text = f"found the picture {path}, a name {found}; .png is accepted, such as "
        raise ParameterError(f"{text}{path.with_suffix('.png') if path.name else 'scene.png'}")


def save(figure: Figure, path: Path) -> None:
    """Writes a PNG file, whole or not at all.

    Raises:
        ParameterError: a name that ends otherwise.
        TissuError: the file cannot be written.
    """
    require_png(path)
    require_file_place(path, "picture")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise TissuError(f"picture {path}: cannot be written ({reason_of(error)})") from None
    with whole_file(path) as partial:
        figure.savefig(partial, format="png", dpi=DPI, facecolor=PAPER)


def round_below(value: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that is not above `value`."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(max(k for k in (1, 2, 5) if k * power <= value * (1 + 1e-9)) * power)


def shown_length(length: float) -> str:
    """A length [m] with a unit that suits it."""
    factor, unit = length_unit(length)
    return f"{length * factor:.3g} {unit}"


def length_unit(largest: float) -> tuple[float, str]:
    """Factor and unit in which lengths up to `largest` [m] are shown."""
    return _unit(largest, ((1e6, "µm"), (1e3, "mm"), (1.0, "m"), (1e-3, "km")))


def pressure_unit(largest: float) -> tuple[float, str]:
    """Factor and unit in which stresses up to `largest` [Pa] are shown."""
    return _unit(largest, ((1.0, "Pa"), (1e-3, "kPa"), (1e-6, "MPa"), (1e-9, "GPa")))


def _unit(largest: float, units: tuple[tuple[float, str], ...]) -> tuple[float, str]:
    for factor, unit in units:
        if largest * factor < 1000:
            return factor, unit
    return units[-1]
