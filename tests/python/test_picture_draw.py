"""The pictures that are written: size, colours, what they refuse."""

import numpy as np
import pytest
from matplotlib.image import imread

import tissu
from tissu.errors import ParameterError, TissuError
from tissu.picture import draw, draw_overlay
from tissu.picture.layout import length_unit, pressure_unit, round_below, shown_length


@pytest.fixture(scope="module")
def bent():
    scene = tissu.Scene(
        name="bent",
        bodies={
            "bar": tissu.Body(
                mesh=tissu.bar_mesh(size=(0.2, 0.05, 0.05), cells=(8, 2, 2)),
                law=tissu.StVK(young=2e4, poisson=0.4),
                density=1000.0,
            )
        },
        gravity=(0, 0, -9.81),
        fixed=[tissu.Fixed("bar", on=tissu.Box((-0.01, None, None), (1e-6, None, None)))],
        step=tissu.ImplicitEuler(dt=0.01),
        duration=0.1,
    )
    simulation = scene.compile()
    for _ in simulation.run(0.1):
        pass
    return simulation


def saturated(picture):
    """Pixels with a colour: neither paper nor ink."""
    return np.ptp(picture[..., :3], axis=-1) > 0.15


@pytest.mark.parametrize("field", ["displacement", "von_mises"])
@pytest.mark.parametrize("size", [(1600, 800), (400, 200)])
def test_both_shapes_and_the_colour_bar_are_there(bent, tmp_path, field, size):
    path = tmp_path / "sub" / "bent.png"
    draw(bent, path, size=size, field=field)
    picture = imread(path)
    assert picture.shape[:2] == (size[1], size[0])
    assert [p.name for p in path.parent.iterdir()] == ["bent.png"]
    shown = saturated(picture)
    left, right, bar = np.split(shown, [size[0] * 45 // 100, size[0] * 89 // 100], axis=1)
    assert left.sum() > 0.02 * left.size
    assert right.sum() > 0.02 * right.size
    assert bar.sum() > 0.02 * bar.size
    red, blue = picture[..., 0], picture[..., 2]
    assert (red > blue)[:, : left.shape[1]][left].all()  # at rest: one warm colour


def test_the_deformed_shape_hangs_lower_than_the_rest_shape(bent, tmp_path):
    draw(bent, tmp_path / "bent.png")
    shown = saturated(imread(tmp_path / "bent.png"))[100:]
    rows = np.arange(len(shown))
    low = [rows[half.any(axis=1)].max() for half in (shown[:, 16:720], shown[:, 720:1424])]
    assert low[1] > low[0] + 5


def test_the_viewer_stands_where_asked(bent, tmp_path):
    def extent(towards):
        draw(bent, tmp_path / "bent.png", towards=towards)
        half = saturated(imread(tmp_path / "bent.png"))[100:, 16:720]
        spans = [np.flatnonzero(half.any(axis=k)) for k in (0, 1)]
        return np.array([np.ptp(span) + 1 for span in spans])

    along, above = extent((1, 0, 0)), extent((0, 0, 1))
    assert along[0] / along[1] == pytest.approx(1.0, abs=0.02)  # the square end, to a pixel or two
    assert above.max() / above.min() == pytest.approx(4.0, abs=0.15)  # 0.2 m by 0.05 m


@pytest.mark.parametrize("towards", [(0, 0, 0), (1, 0), (np.nan, 0, 1), (np.inf, 0, 0)])
def test_a_viewer_nowhere_is_refused(bent, tmp_path, towards):
    with pytest.raises(ParameterError, match="as the direction to the viewer; three finite"):
        draw(bent, tmp_path / "a.png", towards=towards)
    assert not list(tmp_path.iterdir())


def test_wrong_requests_are_refused(bent, tmp_path):
    with pytest.raises(ParameterError, match="displacement, von_mises"):
        draw(bent, tmp_path / "a.png", field="heat")
    with pytest.raises(ParameterError, match="at least 200 x 100"):
        draw(bent, tmp_path / "a.png", size=(20, 20))
    (tmp_path / "file").write_text("")
    with pytest.raises(TissuError, match="cannot be written"):
        draw(bent, tmp_path / "file" / "a.png")
    assert [p.name for p in tmp_path.iterdir()] == ["file"]


def test_overlay_shows_every_surface_in_its_colour(tmp_path):
    cell = [[0, 1, 2]]
    a = np.array([[0, 0, 0], [1, 0, 0], [0, 0, 1]], dtype=float)
    path = tmp_path / "over.png"
    draw_overlay(
        path, [(a, cell, "red", "one"), (a + np.array([2, 0, 0]), cell, "blue", "two")], title="x"
    )
    picture = imread(path)[100:, :, :3]
    assert (picture[..., 0] > picture[..., 2] + 0.4).sum() > 5000
    assert (picture[..., 2] > picture[..., 0] + 0.4).sum() > 5000
    with pytest.raises(ParameterError, match="at least one surface"):
        draw_overlay(path, [])


def test_units_suit_the_numbers():
    assert shown_length(0.02) == "20 mm"
    assert shown_length(0.12345) == "123 mm"
    assert shown_length(2.0) == "2 m"
    assert length_unit(5e-5) == (1e6, "µm")
    assert pressure_unit(2500.0) == (1e-3, "kPa")
    assert [round_below(x) for x in (0.9, 1.0, 4.9, 0.05)] == [0.5, 1.0, 2.0, 0.05]
