"""Colours of diagrams: every series has its own, and it is seen on paper."""

import itertools

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.image import imread

from tissu.comparison.figure import draw
from tissu.comparison.table import Comparison, Row
from tissu.picture.series_colours import in_lab, series_colours


def test_forty_series_have_forty_colours_that_the_eye_tells_apart():
    """Five times the just noticeable distance of 2.3 in CIELAB (Mahy et al. 1994) at least."""
    seen = in_lab(np.array([to_rgb(colour) for colour in series_colours(40)]))
    nearest = min(np.linalg.norm(a - b) for a, b in itertools.combinations(seen, 2))
    assert nearest > 5 * 2.3
    paper = in_lab(np.ones((1, 3)))
    assert np.linalg.norm(seen - paper, axis=1).min() > 20


def test_more_series_change_no_colour():
    assert series_colours(40)[:12] == series_colours(12)
    assert series_colours(3) == series_colours(10)[:3]


def test_lab_is_that_of_the_standard():
    """sRGB red, green, blue and white under D65 (Lindbloom's tables, to the matrix's digits)."""
    known = [[53.24, 80.09, 67.20], [87.73, -86.18, 83.18], [32.30, 79.19, -107.86], [100, 0, 0]]
    assert in_lab(np.vstack([np.eye(3), np.ones((1, 3))])) == pytest.approx(
        np.array(known), abs=0.03
    )


def test_a_comparison_of_sixteen_models_shows_sixteen_colours(tmp_path):
    rows = tuple(
        Row(f"model {k}", "finished", mean_error=1e-3 * 1.3**k, ms_per_step=1.0 + k)
        for k in range(16)
    )
    assert draw(Comparison("bar", 10, "itself", rows), tmp_path / "x.png")
    pixels = (255 * imread(tmp_path / "x.png")[..., :3]).round().astype(int).reshape(-1, 3)
    colours, counts = np.unique(pixels, axis=0, return_counts=True)
    drawn = (counts > 40) & (np.ptp(colours, axis=1) > 25)  # a dot, or its like in the legend
    grey = (counts > 40) & (np.ptp(colours, axis=1) <= 2) & (colours[:, 0] == 0x7F)
    assert drawn.sum() + grey.any() == 16
