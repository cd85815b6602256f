"""Points inside surfaces, on sheets and along lines, and what belongs to each."""

import re

import numpy as np
import pytest

import tissu as ts
from closed_surfaces import (
    SURFACES,
    box,
    icosphere,
    l_shape,
    scattered,
    smallest_gap,
    to_nearest,
    torus,
)
from tissu import sampling as sp


@pytest.fixture(scope="module", params=SURFACES)
def surface(request):
    return SURFACES[request.param]()


def winding_numbers(surface, points):
    """The solid angle of all triangles over 4 pi (van Oosterom and Strackee 1983): another way."""
    a, b, c = np.moveaxis(surface.points[surface.triangles] - points[:, None, None], 2, 0)
    la, lb, lc = (np.linalg.norm(x, axis=2) for x in (a, b, c))
    up = (a * np.cross(b, c)).sum(axis=2)
    down = la * lb * lc + (a * b).sum(2) * lc + (b * c).sum(2) * la + (c * a).sum(2) * lb
    return np.arctan2(up, down).sum(axis=1) / (2 * np.pi)


# Surfaces


def test_inside_is_where_the_winding_number_is_one(surface):
    points = scattered(surface, 2000)
    assert np.array_equal(surface.inside(points), winding_numbers(surface, points) > 0.5)


def test_a_ray_through_edges_and_corners_is_counted_once():
    surface = sp.Surface(*icosphere(2))
    corners = surface.points[:, None] * np.array([-0.5, 0.0, 0.5, 0.99])[:, None]
    below = corners.reshape(-1, 3)  # rays from here along an axis hit corners all over
    assert surface.inside(below * 0.9).all()
    for axis in range(3):
        away = surface.points.copy()
        away[:, axis] = [-1.5, 1.5][axis % 2]
        assert not surface.inside(away).any()
        away[:, axis] = 0.0  # straight below corners, in the plane where the sphere is widest
        within = np.linalg.norm(away, axis=1) < 0.95
        assert surface.inside(away[within]).all()


def test_what_is_on_the_surface_is_inside(surface):
    middles = surface.points[surface.triangles].mean(axis=1)
    assert surface.inside(middles).all()
    assert surface.inside(surface.points[surface.triangles].reshape(-1, 3)).all()


def test_the_volume_is_that_of_the_mesh():
    mesh = ts.read_mesh("examples/organ.vtu")
    assert sp.Surface.of(mesh).volume == pytest.approx(mesh.volume(), rel=1e-12)
    assert l_shape().volume == pytest.approx(3.0, rel=1e-14)
    assert box().bounds == pytest.approx(np.array([[0, 0, 0], [0.4, 0.2, 0.1]]))


def test_distance_is_the_least_over_all_triangles(surface):
    from tissu.sampling.nearest import closest_on_triangles

    points = scattered(surface, 100, margin=1.0)
    corners = surface.points[surface.triangles]
    every = [
        np.linalg.norm(closest_on_triangles(np.tile(p, (len(corners), 1)), corners) - p, axis=1)
        for p in points
    ]
    assert surface.distance(points) == pytest.approx(np.min(every, axis=1), rel=1e-12)
    nearest = surface.nearest(points)
    away = np.linalg.norm(nearest - points, axis=1)
    assert away == pytest.approx(surface.distance(points), rel=1e-12)
    size = np.ptp(surface.bounds, axis=0).max()
    assert surface.distance(nearest).max() <= 1e-13 * size  # round-off of projecting twice


def test_distance_to_a_box_is_known():
    points = np.array([[0.2, 0.1, 0.05], [0.5, 0.1, 0.05], [-0.3, -0.4, 0.05], [0.2, 0.1, 0.09]])
    assert box().distance(points) == pytest.approx([0.05, 0.1, 0.5, 0.01])
    assert box().nearest(points)[1:3] == pytest.approx(np.array([[0.4, 0.1, 0.05], [0, 0, 0.05]]))


def test_each_point_may_have_a_reach_of_its_own():
    """More points than a piece of the loop has (512), so that threads share them."""
    tree = box().tree
    points = scattered(box(), 1200, margin=0.3)
    places, away = tree.nearest(points)
    limits = np.where(np.arange(len(points)) % 3 == 0, 0.5 * away, 2.0 * away + 1e-3)
    near, found = tree.nearest(points, limits)
    missed = limits < away
    assert missed.any()
    assert np.isinf(found[missed]).all()
    assert np.isnan(near[missed]).all()
    assert np.array_equal(near[~missed], places[~missed])
    assert np.array_equal(found[~missed], away[~missed])
    alone = [tree.nearest(points[i : i + 1])[1][0] for i in range(0, len(points), 7)]
    assert np.array_equal(alone, away[::7])
    with pytest.raises(ValueError, match="found 3 numbers for 1200 points"):
        tree.nearest(points, limits[:3])


def test_a_cavity_is_outside():
    points, rows = icosphere(1)
    both = np.concatenate([points, 0.5 * points])
    hollow = sp.Surface(both, np.concatenate([rows, rows[:, ::-1] + len(points)]))
    assert hollow.inside([[0, 0, 0], [0.7, 0, 0], [0, 0, 2]]).tolist() == [False, True, False]
    assert hollow.volume == pytest.approx(7 / 8 * sp.Surface(points, rows).volume)


def test_surfaces_that_do_not_close_are_refused():
    points, rows = icosphere(1)
    with pytest.raises(ts.MeshError, match=r"3 open edges of 120 \(first: between the nodes \d+ a"):
        sp.Surface(points, rows[1:])
    turned = rows.copy()
    turned[0] = turned[0][::-1]
    with pytest.raises(ts.MeshError, match="found 3 edges of 120 whose triangles are wound agai"):
        sp.Surface(points, turned)
    with pytest.raises(ts.MeshError, match="a surface that is flat"):
        sp.Surface(points * [1, 1, 0], rows)
    with pytest.raises(ts.MeshError, match="at least one triangle is accepted"):
        sp.Surface(points, np.empty((0, 3), int))
    with pytest.raises(ts.MeshError, match="nodes 0 to 42; numbers from 0 to 41"):
        sp.Surface(points, np.where(rows == rows.max(), 42, rows))
    points[5] = np.nan
    with pytest.raises(ts.MeshError, match=r"1 node whose position is not finite \(first: 5\)"):
        sp.Surface(points, rows)


def test_points_that_are_none_are_refused():
    for verb in (box().inside, box().distance, box().nearest):
        with pytest.raises(ts.ParameterError, match=r"found points of shape \(3,\)"):
            verb([0.0, 0.0, 0.0])
        with pytest.raises(ts.ParameterError, match="1 of 2 points whose position is not finite"):
            verb([[0.0, 0.0, 0.0], [np.nan, 0.0, 0.0]])


# Grids


def test_a_grid_fills_a_box_from_face_to_face():
    assert len(sp.grid_points(box(), 0.05)) == 9 * 5 * 3
    assert len(sp.grid_cells(box(), 0.05)) == 8 * 4 * 2
    points = sp.grid_points(box(), 0.05)
    assert [points.min(axis=0), points.max(axis=0)] == [
        pytest.approx(corner, abs=1e-15) for corner in box().bounds
    ]


@pytest.mark.parametrize("make", [sp.grid_points, sp.grid_cells])
def test_grids_are_symmetric(make):
    for region, spacing in ((box(), 0.03), (sp.Surface(*icosphere(3)), 0.17)):
        points = make(region, spacing)
        middle = region.bounds.mean(axis=0)
        here = {tuple(p) for p in np.round((points - middle) / spacing * 2).astype(int)}
        for axis in range(3):
            mirrored = {tuple(-c if k == axis else c for k, c in enumerate(p)) for p in here}
            assert mirrored == here
        assert region.inside(points).all()
        assert smallest_gap(points) == pytest.approx(spacing)


# Poisson-disk points


def test_poisson_points_keep_their_distance_and_leave_no_gap(surface):
    distance = 1.3 * (surface.volume / 150) ** (1 / 3)
    points = sp.poisson_points(surface, distance, seed=3)
    assert surface.inside(points).all()
    assert smallest_gap(points) >= distance
    places = scattered(surface, 20000)
    away = to_nearest(places[surface.inside(places)], points)
    assert away.max() < distance * 33 / 32  # room is looked for in cubes of this diagonal
    assert np.mean(away > distance) < 1e-3


def test_the_seed_decides():
    surface = sp.Surface(*icosphere(2))
    first = sp.poisson_points(surface, 0.4, seed=1)
    assert np.array_equal(first, sp.poisson_points(surface, 0.4, seed=1))
    other = sp.poisson_points(surface, 0.4, seed=2)
    assert first.shape != other.shape or not np.array_equal(first, other)
    assert np.array_equal(sp.poisson_points(surface, 0.4), sp.poisson_points(surface, 0.4, seed=0))


@pytest.mark.parametrize("count", [1, 20, 400])
def test_a_count_is_met(count):
    for region in (sp.Surface(*icosphere(2)), box((1.0, 0.05, 0.05), (10, 1, 1))):
        found = len(sp.poisson_count(region, count))
        assert abs(found - count) <= max(1.0, 0.03 * count)


# Unlucky inputs

LENGTHS = [
    (0.0, r"found (spacing|distance) 0.0; a positive length \[m\] is accepted"),
    (-1.0, "a positive length"),
    (np.nan, "found (spacing|distance) nan; a positive length"),
    (np.inf, "a positive length"),
    ("wide", "found (spacing|distance) 'wide'; a positive length"),
    (0.5, "which is larger than the body: its longest side is 0.4 m; .* take a smaller one"),
    (1e-6, "which makes a grid of .* cells; up to 5e.07 are accepted: take a larger one"),
]


@pytest.mark.parametrize("make", [sp.grid_points, sp.grid_cells, sp.poisson_points])
@pytest.mark.parametrize(("length", "words"), LENGTHS)
def test_unlucky_lengths_are_refused(make, length, words):
    with pytest.raises(ts.ParameterError, match=words) as caught:
        make(box(), length)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("count", [0, -3, 2.5, None])
def test_unlucky_counts_are_refused(count):
    with pytest.raises(ts.ParameterError, match="a whole number from 1 on is accepted"):
        sp.poisson_count(box(), count)


@pytest.mark.parametrize("seed", [-1, 0.5, None])
def test_unlucky_seeds_are_refused(seed):
    with pytest.raises(ts.ParameterError, match="a whole number from 0 on is accepted"):
        sp.poisson_points(box(), 0.1, seed=seed)


def test_the_remedy_of_a_surface_wound_inwards_turns_it():
    points, rows = icosphere(1)
    mesh = ts.Mesh(points=points, cells={"triangle": rows[:, ::-1]})
    with pytest.raises(ts.MeshError, match="wound inwards") as found:
        sp.Surface.of(mesh)
    remedy = re.search(r"ts\.Mesh\(.*\)", str(found.value))[0]
    turned = sp.Surface.of(eval(remedy, {"ts": ts, "mesh": mesh}))
    assert turned.volume == sp.Surface(points, rows).volume


def test_a_grid_that_misses_the_region_is_refused():
    words = r"no point of the grid inside with spacing 2\.5 m, in a region of .*; a fraction of its"
    with pytest.raises(ts.ParameterError, match=words):
        sp.grid_points(sp.Surface(*torus()), 2.5)  # its middle is the hole
