"""Measures of tetrahedra against other formulae for the same."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import tissu as ts
from tissu.cutting.quality import Quality, quality_of

REGULAR = np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)], dtype=float)[[0, 2, 1, 3]]
MEASURES = ("shape", "edges", "inner", "radii", "solid_angle", "dihedral")


def random_tetrahedra(count: int = 300) -> np.ndarray:
    corners = np.random.default_rng(2).standard_normal((count, 4, 3))
    turned = np.linalg.det(corners[:, 1:] - corners[:, :1]) < 0
    corners[turned] = corners[turned][:, [1, 0, 2, 3]]
    return corners


def test_all_are_one_for_the_regular_one() -> None:
    quality = quality_of(np.array([0.3 * REGULAR + 5.0]))
    for name in MEASURES:
        assert getattr(quality, name)[0] == pytest.approx(1.0, rel=1e-12), name
    assert quality.volume[0] > 0.0


def solid_angle(corners: np.ndarray, at: int) -> float:
    """Van Oosterom and Strackee (1983)."""
    a, b, c = (corners[k] - corners[at] for k in range(4) if k != at)
    na, nb, nc = (np.linalg.norm(v) for v in (a, b, c))
    over = na * nb * nc + (a @ b) * nc + (a @ c) * nb + (b @ c) * na
    return float(2 * np.arctan2(abs(a @ np.cross(b, c)), over))


def dihedrals(corners: np.ndarray) -> list[float]:
    """At each edge, between the two other corners seen along it."""
    found = []
    for a, b in itertools.combinations(range(4), 2):
        c, d = (k for k in range(4) if k not in (a, b))
        axis = (corners[b] - corners[a]) / np.linalg.norm(corners[b] - corners[a])
        p, q = (v - (v @ axis) * axis for v in (corners[c] - corners[a], corners[d] - corners[a]))
        found.append(float(np.arccos(p @ q / np.linalg.norm(p) / np.linalg.norm(q))))
    return found


def test_they_are_what_they_say() -> None:
    tetrahedra = random_tetrahedra()
    quality = quality_of(tetrahedra)
    for i, corners in enumerate(tetrahedra):
        lengths = [np.linalg.norm(a - b) for a, b in itertools.combinations(corners, 2)]
        # The sphere through the corners: |x - c|^2 the same of all; the one inside: 3 V / S.
        rows, sides = corners[1:] - corners[0], np.sum(corners[1:] ** 2 - corners[0] ** 2, axis=1)
        center = np.linalg.solve(2 * rows, sides)
        outer = np.linalg.norm(center - corners[0])
        area = sum(
            0.5 * np.linalg.norm(np.cross(b - a, c - a))
            for a, b, c in itertools.combinations(corners, 3)
        )
        inner = 3 * quality.volume[i] / area
        assert quality.radii[i] == pytest.approx(3 * inner / outer, rel=1e-8)
        assert quality.inner[i] == pytest.approx(12 / 6**0.5 * inner / max(lengths), rel=1e-9)
        assert quality.edges[i] == pytest.approx(min(lengths) / max(lengths), rel=1e-12)
        least = min(solid_angle(corners, k) for k in range(4))
        assert quality.solid_angle[i] == pytest.approx(least / 0.5512856, rel=1e-6)
        assert quality.dihedral[i] == pytest.approx(min(dihedrals(corners)) / 1.2309594, rel=1e-6)
    assert (quality.radii <= 1.0).all()


def test_the_two_types_of_bad_ones() -> None:
    needle = [(0, 0, 0), (0.1, 0, 0), (0, 0.1, 0), (0, 0, 3)]
    flat = [(1, 0, -0.01), (0, 1, 0.01), (-1, 0, -0.01), (0, -1, 0.01)]
    quality = quality_of(np.array([needle, [flat[k] for k in (0, 1, 3, 2)], REGULAR], dtype=float))
    np.testing.assert_array_equal(quality.has_short_edge, [True, False, False])
    np.testing.assert_array_equal(quality.is_flat, [False, True, False])


def measures(corners: list[tuple[float, float, float]]) -> Quality:
    tetrahedron = np.array(corners, dtype=float)
    if np.linalg.det(tetrahedron[1:] - tetrahedron[0]) < 0:
        tetrahedron = tetrahedron[[0, 2, 1, 3]]
    return quality_of(tetrahedron[None])


SHAPES = [0.3, 0.1, 0.02]
ROOT2, ROOT3 = 2**0.5, 3**0.5


@pytest.mark.parametrize("e", SHAPES)
def test_a_sliver_by_formula(e: float) -> None:
    """Corners (+-1, 0, -e) and (0, +-1, e): four edges sqrt(2 + 4 e^2), two of 2, V = 4 e / 3."""
    found = measures([(1, 0, -e), (-1, 0, -e), (0, 1, e), (0, -1, e)])
    side, volume = (2 + 4 * e * e) ** 0.5, 4 * e / 3
    mean_square = (4 * side**2 + 2 * 4) / 6
    area = 4 * 0.5 * 2 * (side**2 - 1) ** 0.5  # four triangles of base 2
    center = (1 + e * e) ** 0.5  # from the origin
    assert found.volume[0] == pytest.approx(volume, rel=1e-12)
    assert found.shape[0] == pytest.approx(6 * ROOT2 * volume / mean_square**1.5, rel=1e-12)
    assert found.edges[0] == pytest.approx(side / 2, rel=1e-12)  # blind: near 0.7
    assert found.radii[0] == pytest.approx(3 * 3 * volume / area / center, rel=1e-9)
    assert found.inner[0] == pytest.approx(12 / 6**0.5 * 3 * volume / area / 2, rel=1e-12)
    # At the four edges the outward normals are (0, 2 e, -1) and (2 e, 0, 1), each over its length.
    least = np.arccos(1 / (1 + 4 * e * e))
    assert found.dihedral[0] == pytest.approx(least / np.arccos(1 / 3), rel=1e-9)
    assert found.is_flat[0] == (found.radii[0] < 0.1)


@pytest.mark.parametrize("e", SHAPES)
def test_a_needle_by_formula(e: float) -> None:
    """A pyramid of height 1 over an equilateral triangle whose corners lie e from its middle."""
    base = [(e * np.cos(a), e * np.sin(a), 0.0) for a in 2 * np.pi / 3 * np.arange(3)]
    found = measures([*base, (0.0, 0.0, 1.0)])
    short, long, volume = ROOT3 * e, (1 + e * e) ** 0.5, 3 * ROOT3 / 4 * e * e / 3
    mean_square = (short**2 + long**2) / 2
    area = 3 * ROOT3 / 4 * e * e + 3 * 0.5 * short * (long**2 - short**2 / 4) ** 0.5
    outer = (1 + e * e) / 2
    assert found.shape[0] == pytest.approx(6 * ROOT2 * volume / mean_square**1.5, rel=1e-12)
    assert found.edges[0] == pytest.approx(short / long, rel=1e-12)
    assert found.radii[0] == pytest.approx(3 * 3 * volume / area / outer, rel=1e-9)
    # The side faces have normals along (cos a, sin a, e / 2), 120 degrees apart in a. The angle
    # between two faces is pi less that of their outward normals; for small e it is 60 degrees.
    across = np.pi - np.arccos((-0.5 + e * e / 4) / (1 + e * e / 4))
    assert found.dihedral[0] == pytest.approx(across / np.arccos(1 / 3), rel=1e-9)
    assert found.has_short_edge[0] == (short / long < 0.2)
    apex = solid_angle(np.array([*base, (0.0, 0.0, 1.0)]), 3)
    assert found.solid_angle[0] == pytest.approx(apex / np.arccos(23 / 27), rel=1e-9)


@pytest.mark.parametrize("e", SHAPES)
def test_a_cap_by_formula(e: float) -> None:
    """A pyramid of height e over an equilateral triangle whose corners lie 1 from its middle."""
    base = [(np.cos(a), np.sin(a), 0.0) for a in 2 * np.pi / 3 * np.arange(3)]
    found = measures([*base, (0.0, 0.0, e)])
    rim, slope, volume = ROOT3, (1 + e * e) ** 0.5, ROOT3 / 4 * e
    mean_square = (rim**2 + slope**2) / 2
    area = 3 * ROOT3 / 4 + 3 * 0.5 * rim * (slope**2 - rim**2 / 4) ** 0.5
    outer = (1 + e * e) / (2 * e)
    assert found.shape[0] == pytest.approx(6 * ROOT2 * volume / mean_square**1.5, rel=1e-12)
    assert found.edges[0] == pytest.approx(slope / rim, rel=1e-12)  # blind: near 0.58
    assert found.radii[0] == pytest.approx(3 * 3 * volume / area / outer, rel=1e-9)
    # A side face rises by e over the inner radius 1 / 2 of the base.
    assert found.dihedral[0] == pytest.approx(np.arctan(2 * e) / np.arccos(1 / 3), rel=1e-9)


def test_without_a_volume_all_but_the_edges_are_zero() -> None:
    found = measures([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0)])
    for name in ("volume", "shape", "inner", "radii", "solid_angle", "dihedral"):
        assert getattr(found, name)[0] == pytest.approx(0.0, abs=1e-12), name
    assert found.edges[0] == pytest.approx(ROOT2 / 2, rel=1e-12)


def test_of_a_body_that_is_cut() -> None:
    mesh = ts.bar_mesh(size=(0.4, 0.1, 0.1), cells=(8, 2, 2), cell="hexahedron")
    made = ts.Scene(
        bodies={"bar": ts.Body(mesh=mesh, law=ts.StVK(young=5e4, poisson=0.3), density=1e3)},
        step=ts.ImplicitEuler(dt=0.005),
        editing=True,
    )
    simulation = made.compile()
    before = simulation.quality("bar")
    assert before.volume.sum() == pytest.approx(4e-3, rel=1e-12)
    assert len(before.volume) == 6 * 32
    simulation.cut("bar", ts.Plane((0.213, 0, 0), (1, 0.3, 0.2)))
    simulation.positions["bar"][:] *= 2.0
    now, rest = simulation.quality("bar"), simulation.quality("bar", rest=True)
    assert len(now.volume) > len(before.volume)
    assert rest.volume.sum() == pytest.approx(4e-3, rel=1e-12)
    assert now.volume.sum() == pytest.approx(8 * 4e-3, rel=1e-12)
    np.testing.assert_allclose(now.radii, rest.radii, rtol=1e-6)  # of a body twice as large
    assert "least: shape" in repr(now)
    with pytest.raises(ts.ParameterError, match="accepted: bar"):
        simulation.quality("liver")
