"""What the rasteriser shows, against what is known: areas, depths, colours."""

import numpy as np
import pytest

from tissu.errors import ParameterError
from tissu.picture import Camera, look_at, render_surface

FRONT = np.eye(3)  # looked at along -z, x to the right, y up


def sphere(rings=40, centre=(0.0, 0.0, 0.0), radius=1.0):
    """A closed surface of triangles, outward."""
    u, v = np.meshgrid(np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, 2 * rings + 1))
    points = np.stack([np.sin(u) * np.cos(v), np.sin(u) * np.sin(v), np.cos(u)], axis=-1)
    number = np.arange(points.shape[0] * points.shape[1]).reshape(points.shape[:2])
    a, b, c, d = number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]
    cells = np.concatenate([np.stack(t, axis=-1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])
    return np.asarray(centre) + radius * points.reshape(-1, 3), cells


def camera(size=(200, 160), scale=60.0):
    return Camera(FRONT, np.zeros(3), scale, size)


def test_silhouette_has_the_area_of_the_projected_sphere():
    points, cells = sphere()
    picture = render_surface(points, cells, camera=camera())
    assert picture.shape == (160, 200, 4)
    assert picture[..., 3].sum() == pytest.approx(np.pi * 60.0**2, rel=5e-3)


def test_every_pixel_inside_is_covered_and_none_outside():
    points, cells = sphere()
    opacity = render_surface(points, cells, camera=camera())[..., 3]
    y, x = np.mgrid[:160, :200] + 0.5
    distance = np.hypot(x - 100, y - 80)
    assert (opacity[distance < 58.5] == 1).all()
    assert (opacity[distance > 61.5] == 0).all()


def test_triangles_that_share_edges_leave_no_gap():
    rng = np.random.default_rng(3)
    n = 30
    x, y = np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n))
    points = np.stack([x.ravel(), y.ravel(), rng.normal(size=n * n)], axis=1)
    inner = (np.abs(points[:, :2]) < 0.999).all(axis=1)
    points[inner, :2] += rng.uniform(-0.015, 0.015, (inner.sum(), 2))
    number = np.arange(n * n).reshape(n, n)
    a, b, c, d = number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]
    cells = np.concatenate([np.stack(t, axis=-1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])
    opacity = render_surface(points, cells, camera=camera())[..., 3]
    assert (opacity[20:140, 40:160] == 1).all()
    assert opacity.sum() == 120 * 120


@pytest.mark.parametrize("front", [0, 1])
def test_the_nearer_of_two_spheres_hides_the_other(front):
    depth = [0.0, 0.0]
    depth[front] = 3.0
    left = sphere(centre=(-0.4, 0, depth[0]))
    right = sphere(centre=(0.4, 0, depth[1]))
    points = np.vstack([left[0], right[0]])
    cells = np.vstack([left[1], right[1] + len(left[0])])
    values = np.repeat([0.0, 1.0], [len(left[0]), len(right[0])])
    picture = render_surface(points, cells, values, camera=camera(), colormap="coolwarm")
    red, blue = picture[80, 100, 0], picture[80, 100, 2]  # both cover the middle
    assert (red > blue) == (front == 1)


def test_spheres_that_cut_each_other_meet_where_they_are_equally_near():
    left, right = sphere(centre=(-0.5, 0, 0)), sphere(centre=(0.5, 0, 0))
    points = np.vstack([left[0], right[0]])
    cells = np.vstack([left[1], right[1] + len(left[0])])
    values = np.repeat([0.0, 1.0], [len(left[0]), len(right[0])])
    picture = render_surface(points, cells, values, camera=camera(), colormap="coolwarm")
    row = picture[80]
    assert (row[45:98, 2] > row[45:98, 0]).all()
    assert (row[102:155, 0] > row[102:155, 2]).all()


def test_a_surface_that_faces_the_viewer_has_the_colour_of_its_value():
    from matplotlib import colormaps

    points = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=float)
    cells = [[0, 1, 2], [0, 2, 3]]
    picture = render_surface(points, cells, points[:, 0], camera=camera(), limits=(-1, 1))
    for column, value in ((55, 0.125), (100, 0.5), (145, 0.875)):
        wanted = np.array(colormaps["viridis"](value)[:3])
        assert picture[80, column, :3] == pytest.approx(wanted, abs=0.05)


def test_values_of_triangles_are_flat():
    points = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=float)
    picture = render_surface(points, [[0, 1, 2], [0, 2, 3]], [0.0, 1.0], camera=camera())
    below, above = picture[110, 130, :3], picture[50, 70, :3]
    assert np.allclose(below, picture[120, 140, :3])
    assert np.allclose(above, picture[60, 80, :3])
    assert not np.allclose(below, above, atol=0.2)


def test_light_comes_from_above_and_edges_of_a_box_stay_edges():
    points, cells = sphere()
    picture = render_surface(points, cells, camera=camera())
    assert picture[45, 90, :3].sum() > picture[125, 110, :3].sum() + 0.3
    box = np.array([[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)], dtype=float)
    quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    faces = [[q[0], q[i], q[i + 1]] for q in quads for i in (1, 2)]
    view = look_at([box], size=(200, 160))
    shown = render_surface(box, faces, camera=view)
    inside = np.round(shown[shown[..., 3] == 1][:, :3], 2)
    pixels = np.unique(inside, axis=0, return_counts=True)[1]
    assert np.sort(pixels)[-3:].sum() > 0.9 * len(inside)  # three faces, flat


def test_a_face_seen_from_behind_is_lit_like_from_the_front():
    points = np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], dtype=float)
    front = render_surface(points, [[0, 1, 2]], camera=camera())
    back = render_surface(points, [[0, 2, 1]], camera=camera())
    assert np.allclose(front, back)


def test_degenerate_and_absent_triangles_draw_nothing():
    points = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0]], dtype=float)
    for cells in (np.empty((0, 3), dtype=int), [[0, 1, 2]], [[0, 0, 0]]):
        picture = render_surface(points, cells, camera=camera())
        assert np.isfinite(picture).all()
        assert picture[..., 3].sum() == 0


def test_what_lies_outside_of_the_picture_is_cut_off():
    points, cells = sphere(radius=20.0)
    assert (render_surface(points, cells, camera=camera())[..., 3] == 1).all()
    away = points + np.array([100.0, 0, 0])
    assert render_surface(away, cells, camera=camera())[..., 3].sum() == 0


def test_wrong_arrays_are_refused():
    points, cells = sphere(4)
    with pytest.raises(ParameterError, match="triangles name points 0 to"):
        render_surface(points, cells + 1000, camera=camera())
    with pytest.raises(ParameterError, match="found the shape"):
        render_surface(points, cells, np.zeros(3), camera=camera())
    with pytest.raises(ParameterError, match=r"shape \(n, 3\)"):
        render_surface(points[:, :2], cells, camera=camera())


def test_many_triangles_are_drawn():
    points, cells = sphere(160)
    assert len(cells) > 100_000
    opacity = render_surface(points, cells, camera=camera((800, 600), 250.0))[..., 3]
    assert opacity.sum() == pytest.approx(np.pi * 250.0**2, rel=2e-3)


@pytest.mark.parametrize("up", [(0, 0, 1), (0, 1, 0), (1, 0, 0), (0.3, -0.5, 2.0)])
def test_camera_shows_all_of_a_shape_with_up_upwards(up):
    points = np.random.default_rng(1).normal(size=(500, 3)) * [3.0, 1.0, 0.5] + 10.0
    view = look_at([points, points + 1.0], size=(320, 200), up=up)
    assert view.axes @ view.axes.T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(view.axes) == pytest.approx(1.0)
    assert view.axes[0] @ np.array(up) == pytest.approx(0.0, abs=1e-12)
    assert view.axes[1] @ np.array(up) > 0
    for shape in (points, points + 1.0):
        seen = view.project(shape)
        assert (seen[:, :2] > 0).all()
        assert (seen[:, :2] < [320, 200]).all()


def test_camera_refuses_what_it_cannot_show():
    with pytest.raises(ParameterError, match="at least one point"):
        look_at([np.empty((0, 3))], size=(10, 10))
    with pytest.raises(ParameterError, match="finite"):
        look_at([[[0, 0, np.nan]]], size=(10, 10))
    with pytest.raises(ParameterError, match="pixels"):
        look_at([[[0, 0, 0]]], size=(0, 10))
    assert np.isfinite(look_at([[[1, 2, 3]]], size=(10, 10)).scale)
