"""Colours of bodies and of bands, and the legend."""

from __future__ import annotations

from functools import cache

import numpy as np

from tissu.live_view.marks import Colour
from tissu.picture.layout import colours

COUNT = 16
"""Bands of a field."""
BODIES: tuple[Colour, ...] = (
    (204, 120, 102),
    (214, 176, 120),
    (150, 130, 180),
    (120, 160, 150),
    (190, 110, 140),
    (140, 150, 110),
)
"""Of the bodies, in turn."""
EDGE: Colour = (70, 45, 40)
OPENED: Colour = (150, 20, 30)
"""Of faces that cuts opened."""


@cache
def band_colours() -> tuple[Colour, ...]:
    """Of each band, from the lowest on."""
    table = 255 * colours()((np.arange(COUNT) + 0.5) / COUNT)[:, :3]
    return tuple((int(r), int(g), int(b)) for r, g, b in np.round(table))


def legend(label: str, unit: str, limits: tuple[float, float]) -> str:
    """The legend as HTML: the bands, with the values at their ends and in the middle."""
    boxes = "".join(
        f'<div style="flex:1;background:rgb({r},{g},{b})"></div>' for r, g, b in band_colours()
    )
    low, high = limits
    words = "".join(f"<span>{value:.3g}</span>" for value in (low, (low + high) / 2, high))
    named = f"{label} [{unit}]" if unit != "1" else label
    return (
        f'<div style="padding:0 1em 0.4em;font-size:0.85em"><div>{named}</div>'
        f'<div style="display:flex;height:1em;margin:0.2em 0">{boxes}</div>'
        f'<div style="display:flex;justify-content:space-between">{words}</div></div>'
    )
