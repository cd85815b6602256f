"""Points on sheets and along lines; the space between two bodies."""

import numpy as np
import pytest

import tissu as ts
from closed_surfaces import box, icosphere, smallest_gap, to_nearest
from tissu import sampling as sp

# Sheets and lines


def test_points_on_a_sphere_keep_their_distance_and_share_its_area():
    points, rows = icosphere(3)
    found = sp.sheet_points((points, rows), 0.2, seed=1)
    a, b, c = points[rows].swapaxes(0, 1)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    assert found.sizes.sum() == pytest.approx(area, rel=1e-13)
    assert found.sizes.min() > 0.0
    assert smallest_gap(found.points) >= 0.2
    # None of the fine triangles of an eighth is left, so the gaps are wider by less than one.
    assert to_nearest(a, found.points).max() < 0.2 * (1 + 1 / 8)
    outwards = found.points / np.linalg.norm(found.points, axis=1, keepdims=True)
    assert (found.directions * outwards).sum(axis=1).min() > 0.98
    assert np.array_equal(found.points, sp.sheet_points((points, rows), 0.2, seed=1).points)


@pytest.mark.parametrize("cell", ["triangle", "quad"])
def test_sheets_of_a_mesh(cell):
    sheet = ts.bar_mesh(size=(0.4, 0.2, 0.0), cells=(3, 2, 0), cell=cell)
    found = sp.sheet_points(sheet, 0.05)
    assert found.sizes.sum() == pytest.approx(0.08, rel=1e-13)
    assert np.abs(found.directions) == pytest.approx(np.tile([0, 0, 1], (len(found), 1)))
    # Discs of 9/8 of the distance cover the sheet, at best as hexagons do (2 pi / 27^0.5 fold);
    # those of half the distance lie in the sheet and 0.025 m around, at best pi / 12^0.5 of it.
    least = 0.08 * 2 * np.pi / 27**0.5 / (np.pi * (0.05 * 9 / 8) ** 2)
    most = 0.45 * 0.25 * np.pi / 12**0.5 / (np.pi * 0.025**2)
    assert least <= len(found) <= most


def test_points_along_a_bent_line():
    corners = np.array([[0, 0, 0], [1, 0, 0], [1, 2, 0]], dtype=float)
    found = sp.line_points((corners, np.array([[0, 1], [2, 1]])), 0.5)
    assert found.sizes == pytest.approx(np.full(6, 0.5))
    assert found.points[:3] == pytest.approx(np.array([[0.25, 0, 0], [0.75, 0, 0], [1, 0.25, 0]]))
    assert found.directions[2] == pytest.approx([0, 1, 0])


def test_points_along_a_tree_and_a_ring():
    turn = 2 * np.pi * np.arange(60) / 60
    ring = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    branches = np.array([[0, 0, 1], [0, 0, 2], [1, 0, 3], [-1, 0, 3]], dtype=float)
    around = np.stack([np.arange(60), (np.arange(60) + 1) % 60], axis=1)
    segments = np.concatenate([around, [[60, 61], [61, 62], [61, 63]]])
    found = sp.line_points((np.concatenate([ring, branches]), segments), 0.3)
    length = 120 * np.sin(np.pi / 60) + 1 + 2 * np.sqrt(2)
    assert found.sizes.sum() == pytest.approx(length, rel=1e-13)
    assert found.sizes == pytest.approx(np.full(len(found), 0.3), rel=0.2)
    assert np.linalg.norm(found.directions, axis=1) == pytest.approx(np.ones(len(found)))


def test_lines_of_a_mesh():
    line = ts.bar_mesh(size=(0.4, 0.0, 0.0), cells=(5, 0, 0), cell="line")
    assert sp.line_points(line, 0.1).points[:, 0] == pytest.approx([0.05, 0.15, 0.25, 0.35])


def test_what_is_no_sheet_or_line_is_refused():
    points, rows = icosphere(0)
    with pytest.raises(ts.ParameterError, match="found distance 3 m, which is larger than the sh"):
        sp.sheet_points((points, rows), 3.0)
    with pytest.raises(ts.ParameterError, match="found distance nan; a positive length"):
        sp.sheet_points((points, rows), np.nan)
    with pytest.raises(ts.MeshError, match="at least one triangle"):
        sp.sheet_points((points, rows[:0]), 0.1)
    with pytest.raises(ts.MeshError, match=r"found segments of shape \(20, 3\)"):
        sp.line_points((points, rows), 0.1)
    with pytest.raises(ts.MeshError, match="found segments with the nodes 0 to 99"):
        sp.line_points((points, [[0, 99]]), 0.1)
    with pytest.raises(ts.MeshError, match="found segments whose length is 0"):
        sp.line_points((points, [[1, 1]]), 0.1)
    with pytest.raises(ts.ParameterError, match="found spacing 9 m"):
        sp.line_points((points, [[0, 1]]), 9.0)


# Between two bodies


def plates(gap=0.1):
    shape = {"size": (1.0, 1.0, 0.05), "cells": (3, 3, 1)}
    return box(**shape), box(**shape, origin=(0.0, 0.0, 0.05 + gap))


def balls(apart=2.3, level=2):
    return sp.Surface(*icosphere(level)), sp.Surface(*icosphere(level, centre=(0, 0, apart)))


def test_between_plates_is_a_slab_with_a_round_rim():
    region = sp.between(*plates(), 0.2)
    assert region.gap == pytest.approx(0.1, rel=1e-12)
    # Half a cylinder along each side and quarters of a ball at the corners.
    exact = 0.1 + 4 * np.pi * 0.05**2 / 2 + 4 / 3 * np.pi * 0.05**3
    assert abs(region.volume - exact) < 4 * region.volume_error
    assert region.volume_error < 0.01 * exact
    places = [[0.5, 0.5, 0.1], [0.5, 0.5, 0.02], [0.5, 0.5, -0.01], [-0.04, 0.5, 0.1]]
    assert region.inside(places).tolist() == [True, False, False, True]
    assert not region.inside([[-0.06, 0.5, 0.1], [0.5, 0.5, 0.21], [5.0, 0.0, 0.0]]).any()


def test_reach_limits_the_way_from_body_to_body():
    a, b = balls()
    volumes = [sp.between(a, b, reach).volume for reach in (0.4, 0.6, 0.9)]
    assert volumes == sorted(volumes)
    region = sp.between(a, b, 0.6)
    rng = np.random.default_rng(0)
    places = rng.uniform(*region.bounds, (4000, 3))
    places = places[region.inside(places)]
    assert (a.distance(places) + b.distance(places) <= 0.6).all()
    assert not (a.inside(places) | b.inside(places)).any()
    assert region.gap == pytest.approx(0.3, rel=1e-12)  # each ball has a corner at its pole


def test_patches_narrow_the_tissue():
    a, b = balls()
    near_a = np.flatnonzero(a.points[:, 2] > 0.9)
    near_b = np.flatnonzero(b.points[:, 2] < 2.3 - 0.9)
    whole, part = sp.between(a, b, 0.9), sp.between(a, b, 0.9, nodes_a=near_a, nodes_b=near_b)
    assert part.volume < 0.9 * whole.volume
    assert part.inside([[0.0, 0.0, 1.15]]).all()
    aside = [[0.55, 0.0, 1.15]]
    assert whole.inside(aside).all()
    assert not part.inside(aside).any()


def test_points_and_shares_between():
    region = sp.between(*plates(), 0.2)
    points = sp.poisson_points(region, 0.15)
    assert region.inside(points).all()
    assert smallest_gap(points) >= 0.15
    volumes = sp.point_volumes(region, points, fineness=50)
    assert volumes.min() > 0.0
    assert volumes.sum() == pytest.approx(region.volume, rel=1e-14)


def test_bodies_that_intersect_or_are_too_far_apart_are_refused():
    a, _ = balls()
    b = sp.Surface(*icosphere(2, centre=(0, 0, 1.8)))
    with pytest.raises(ts.MeshError, match=r"intersect, at least 0.1\d* m deep; .* move one away"):
        sp.between(a, b, 0.5)
    with pytest.raises(ts.MeshError, match="intersect"):
        sp.between(a, sp.Surface(*icosphere(1, radius=0.3)), 0.5)
    # Two bars that cross: no node of one is in the other.
    along, across = box((3.0, 0.4, 0.4), (1, 1, 1)), box((0.5, 3.0, 0.2), (1, 1, 1), (1, -1, 0.1))
    with pytest.raises(ts.MeshError, match="intersect"):
        sp.between(along, across, 0.5)
    with pytest.raises(ts.ParameterError, match=r"the gap is 0\.1 m; a reach of more than that"):
        sp.between(*plates(), 0.05)
    with pytest.raises(ts.ParameterError, match="found reach 0; a positive length"):
        sp.between(*plates(), 0)


def test_chosen_nodes_must_be_nodes_of_triangles():
    with pytest.raises(ts.ParameterError, match="1 nodes_a that no triangle has"):
        sp.between(*plates(), 0.2, nodes_a=[0])
    for wrong in ([99], [0.5], [], [[1, 2, 3]]):
        with pytest.raises(ts.ParameterError, match="numbers of nodes from 0 to 31 are accepted"):
            sp.between(*plates(), 0.2, nodes_b=wrong)


def test_bodies_may_touch():
    region = sp.between(box(), box(origin=(0.0, 0.1, 0.1)), 0.05)
    assert region.gap == pytest.approx(0.0, abs=1e-12)
    # Nothing fits between the faces that touch; beside them, wedges of tissue tie the bodies.
    assert 0.0 < region.volume < 0.4 * 0.05**2 * 4
