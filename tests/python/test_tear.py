"""Material opens where its largest principal stress, averaged over a length, is too large."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import tissu as ts
from tissu.cutting.overstress import front_of, overstressed

STRENGTH = 5e3
LENGTH = 0.03


def strip(pull: float, cells: tuple[int, int, int] = (12, 4, 2), **changes: Any) -> ts.Scene:
    """A strip that is drawn out by `pull` [m] without inertia to speak of."""
    mesh = ts.bar_mesh(size=(0.3, 0.1, 0.05), cells=cells, cell="tetra")
    end = ts.Plane((0.3, 0, 0), (1, 0, 0))
    return ts.Scene(
        **{
            "bodies": {
                "strip": ts.Body(mesh=mesh, law=ts.Hooke(young=1e5, poisson=0.0), density=1.0)
            },
            "fixed": [ts.Fixed("strip", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
            "prescribed": [
                ts.Prescribed(
                    "strip", on=end, times=(0, 1), displacements=[(0, 0, 0), (pull, 0, 0)]
                )
            ],
            "step": ts.ImplicitEuler(dt=0.05),
            "editing": ts.Editing(room="400 %"),
            "tear": [ts.Tear("strip", strength=STRENGTH, length=LENGTH)],
        }
        | changes
    )


def cuts(made: ts.Scene, steps: int) -> tuple[ts.Simulation, list[list[ts.CutReport]]]:
    simulation = made.compile()
    return simulation, [list(simulation.step().cuts) for _ in range(steps)]


@pytest.mark.parametrize("cells", [(12, 4, 2), (18, 4, 2)])
def test_a_strip_tears_at_its_strength(cells: tuple[int, int, int]) -> None:
    """Sigma = E e, whatever the mesh: it bears strain below strength / E, and none above."""
    strain = STRENGTH / 1e5
    whole, none = cuts(strip(0.98 * strain * 0.3, cells), 20)
    assert not any(none)
    assert not whole.surface("strip").cut.any()
    torn, found = cuts(strip(1.1 * strain * 0.3, cells), 19)
    when = [number for number, some in enumerate(found) if some]
    # The stress reaches the strength at 1 / 1.1 of the way, 18.2 of 20 steps.
    assert when == [18]
    assert all(report.by == "tear" for report in found[18])
    assert torn.surface("strip").cut.any()


def test_a_notch_tears_through() -> None:
    """The tear goes on from its front, straight across the pull, until the strip is in two."""
    made = strip(1.6 * STRENGTH / 1e5 * 0.3, (18, 6, 3), step=ts.ImplicitEuler(dt=0.02))
    simulation = made.compile()
    corners = [(0.15, -0.01, -1), (0.15, 0.036, -1), (0.15, 0.036, 1), (0.15, -0.01, 1)]
    simulation.cut("strip", ts.Triangles(corners, [(0, 1, 2), (0, 2, 3)]))
    reports: list[ts.CutReport] = []
    for _ in range(40):
        reports += simulation.step().cuts
        if len(simulation.pieces("strip")) > 1:
            break
    assert len(reports) > 2  # 1.5 lengths at most go at once
    for report in reports:
        assert abs(report.mass_change) <= 1e-12 * 0.0015
        assert report.elastic_energy_change == pytest.approx(0.0, abs=1e-9)
    large, small = simulation.pieces("strip")
    assert large.volume == pytest.approx(0.75e-3, rel=1e-6)
    assert small.volume == pytest.approx(0.75e-3, rel=1e-6)
    surface = simulation.surface("strip")
    rest = surface.carried(simulation.meshes["strip"].points)
    torn = rest[np.unique(surface.triangles[surface.cut])]
    np.testing.assert_allclose(torn[:, 0], 0.15, rtol=0, atol=1e-3 * LENGTH)


def test_the_mean_stress_is_that_of_the_cells_around() -> None:
    """Against sums over all pairs; the worst first, of equal ones the lowest number."""
    random = np.random.default_rng(4)
    centres = random.uniform(0.0, 1.0, (200, 3))
    stress = random.standard_normal((200, 3, 3))
    stress = 100.0 * (stress + np.swapaxes(stress, 1, 2))
    stress[7] = np.nan
    volumes = random.uniform(0.5, 1.5, 200)
    known = np.isfinite(stress).all(axis=(1, 2))
    expected, peaks = [], []
    own = np.array([np.linalg.eigvalsh(s)[2] if np.isfinite(s).all() else 0.0 for s in stress])
    for centre in centres:
        near = (np.linalg.norm(centres - centre, axis=1) <= 0.2) & known
        mean = np.einsum("m,mij->ij", volumes[near], stress[near]) / volumes[near].sum()
        expected.append(np.linalg.eigvalsh(mean)[2])
        peaks.append(np.flatnonzero(near)[np.argmax(own[near])])
    found = overstressed(centres, stress, volumes, strength=60.0, length=0.2, apart=0.0, most=200)
    order = np.argsort(-np.array(expected), kind="stable")
    worst = [i for i in order if expected[i] > 60.0]
    np.testing.assert_array_equal([one.place for one in found], centres[np.array(peaks)[worst]])
    np.testing.assert_allclose(
        [one.ratio for one in found], np.array(expected)[worst] / 60.0, rtol=1e-12
    )
    few = overstressed(centres, stress, volumes, strength=60.0, length=0.2, apart=0.4, most=3)
    assert len(few) <= 3
    places = np.array([one.place for one in few])
    for i, place in enumerate(places):
        assert (np.linalg.norm(places[:i] - place, axis=1) >= 0.4).all()
    assert not overstressed(centres, stress, volumes, strength=1e4, length=0.2, apart=0.0, most=9)


def test_the_front_of_a_slit_is_found() -> None:
    simulation = strip(0.0, tear=[]).compile()
    corners = [(0.15, -1, -1), (0.15, 0.05, -1), (0.15, 0.05, 1), (0.15, -1, 1)]
    simulation.cut("strip", ts.Triangles(corners, [(0, 1, 2), (0, 2, 3)]))
    surface = simulation.surface("strip")
    rest = surface.carried(simulation.meshes["strip"].points)
    found = front_of(surface.triangles.astype(np.int64), surface.cut, rest)
    front = rest[found[:, :2]]
    lengths = np.linalg.norm(front[:, 1] - front[:, 0], axis=1)
    assert lengths.sum() == pytest.approx(0.05, rel=1e-9)  # once across the thickness
    np.testing.assert_allclose(front[..., :2], np.broadcast_to((0.15, 0.05), (*front.shape[:2], 2)))


def test_what_cannot_tear_is_refused() -> None:
    short = strip(0.0, tear=[ts.Tear("strip", strength=1e3, length=1e-3)])
    with pytest.raises(ts.SceneError, match="mean edge of the cells") as refused:
        short.compile()
    assert short.check().problems == refused.value.problems
    with pytest.raises(ts.SceneError, match="no body is named 'stripe'"):
        strip(0.0, tear=[ts.Tear("stripe", strength=1e3, length=1e-3)])
    with pytest.raises(ts.SceneError, match="write editing: true"):
        strip(0.0, editing=None)
    mesh = ts.bar_mesh(size=(0.3, 0.1, 0.05), cells=(12, 4, 2), cell="tetra")
    springs = ts.Body(
        mesh=mesh, law=ts.Hooke(young=1e5, poisson=0.25), density=1.0, model="mass_spring"
    )
    with pytest.raises(ts.SceneError, match="tear"):
        strip(0.0, bodies={"strip": springs}).compile()
