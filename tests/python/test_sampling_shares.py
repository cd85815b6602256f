"""What of a region belongs to each point: volumes, centres, moments."""

import numpy as np
import pytest

import tissu as ts
from closed_surfaces import SURFACES, box, icosphere, scattered
from tissu import sampling as sp


@pytest.fixture(scope="module", params=SURFACES)
def surface(request):
    return SURFACES[request.param]()


def test_shares_of_cells_of_a_grid_are_the_cells():
    points = sp.grid_cells(box(), 0.05)
    shares = sp.point_shares(box(), points)
    # Planes between points on a grid cut fine cells squarely: nothing is left but round-off.
    assert shares.volumes == pytest.approx(np.full(len(points), 0.05**3), rel=1e-9)
    assert shares.volumes.sum() == pytest.approx(box().volume, rel=1e-14)


def test_shares_add_up_and_are_positive(surface):
    points = sp.poisson_count(surface, 60)
    shares = sp.point_shares(surface, points)
    assert shares.volumes.min() > 0.0
    assert shares.volumes.sum() == pytest.approx(surface.volume, rel=1e-14)
    # Against random places: 20 000 of them give a sixtieth with a standard error of 5 %.
    places = scattered(surface, 60000, margin=0.0)
    places = places[surface.inside(places)]
    owner = np.linalg.norm(places[:, None] - points, axis=2).argmin(axis=1)
    counted = np.bincount(owner, minlength=len(points))
    expected = shares.volumes / surface.volume * len(places)
    assert (np.abs(counted - expected) < 5.0 * np.sqrt(expected) + 0.02 * expected).all()
    assert np.array_equal(shares.volumes, sp.point_volumes(surface, points))


def test_moments_of_one_point_are_those_of_the_body():
    surface, point = box(), np.array([[0.1, 0.05, 0.05]])
    shares = sp.point_shares(surface, point, fineness=4000)
    size, away = np.array([0.4, 0.2, 0.1]), np.array([0.1, 0.05, 0.0])
    exact = surface.volume * (np.diag(size**2 / 12.0) + np.outer(away, away))
    # The cells fill the box and each has the moment of a box: only round-off is left.
    assert shares.moments[0] == pytest.approx(exact, rel=1e-9, abs=1e-12 * exact.max())
    assert shares.centres[0] == pytest.approx([0.2, 0.1, 0.05], rel=1e-9)
    inertia = surface.volume * (size[1] ** 2 + size[2] ** 2) / 12.0 + surface.volume * 0.05**2
    assert shares.inertia[0, 0, 0] == pytest.approx(inertia, rel=1e-9)


def test_inertia_of_shares_is_that_of_a_ball():
    surface = sp.Surface(*icosphere(4))
    points = sp.poisson_count(surface, 40)
    shares = sp.point_shares(surface, points, fineness=1000)
    # Steiner: moments about the points, moved to the middle, add up to those of the ball.
    first = shares.volumes[:, None] * (shares.centres - points)
    moved = (
        shares.moments
        + points[:, :, None] * first[:, None]
        + first[:, :, None] * points[:, None]
        + shares.volumes[:, None, None] * points[:, :, None] * points[:, None]
    )
    total = moved.sum(axis=0)
    # Flat triangles of 0.14 lose 0.2 % of the volume, and 5/3 of that of the moment.
    assert total == pytest.approx(4 * np.pi / 15 * np.eye(3), rel=0.01, abs=0.005)


def test_points_that_cannot_share_are_refused():
    with pytest.raises(ts.ParameterError, match=r"1 of 2 points outside \(first: 1\)"):
        sp.point_volumes(box(), [[0.1, 0.1, 0.05], [1.0, 0.1, 0.05]])
    with pytest.raises(ts.ParameterError, match="1 of 2 points at the place of another"):
        sp.point_volumes(box(), [[0.1, 0.1, 0.05]] * 2)
    with pytest.raises(ts.ParameterError, match="found no points"):
        sp.point_volumes(box(), np.empty((0, 3)))
    with pytest.raises(ts.ParameterError, match="found fineness 2;"):
        sp.point_volumes(box(), [[0.1, 0.1, 0.05]], fineness=2)
