"""Every hard case, run as its file has it, with a stated numeric outcome."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from outcome import Outcome, case, names, outcome

import tissu as ts


@cache
def of(name: str) -> tuple[Outcome, ts.Simulation | None]:
    """What came of a case, and the simulation at its end; each is run once."""
    simulations: list[ts.Simulation] = []
    return outcome(case(name), keep=simulations), simulations[0] if simulations else None


def end(name: str) -> ts.Simulation:
    """The simulation at the end of a case that ran to it."""
    found, simulation = of(name)
    assert found.kind != "refused", found.message
    assert simulation is not None
    assert simulation.time == pytest.approx(simulation.scene.duration, rel=1e-9)
    return simulation


def moved(name: str) -> np.ndarray:
    """Displacements of a case's only body at its end [m]."""
    simulation = end(name)
    return simulation.displacements(simulation.bodies[0])


def equilibrium(name: str) -> np.ndarray:
    """Displacements of the same body in static equilibrium, to 1e-9 of the load [m]."""
    scene = case(name)
    step = ts.Static(newton=ts.Newton(iterations=60, tolerance=1e-9), solver=ts.Cholesky())
    simulation = scene.replace(step=step, duration=None).compile()
    assert all(report.converged for report in simulation.run())
    return simulation.displacements(simulation.bodies[0])


SLOW_TO_RECOVER = ("point_corotational", "plane_neo", "random_neo", "random_corotational")
RECOVER = (*SLOW_TO_RECOVER, "inside_out_corotational")
TESTED = {
    *("compression", "compression_neo", "contrast", "flight", "floating", "huge_step", "impact"),
    *("incompressible", "large_swing", "one_element", "parts", "rest", "sliver", "thin"),
    *("tiny_step", "turns", *RECOVER),
}


def test_every_case_has_an_outcome() -> None:
    """A new scene without a stated outcome fails here."""
    assert set(names()) == TESTED


@pytest.mark.parametrize("name", sorted(TESTED - {"floating"}))
def test_no_value_is_ever_out_of_bounds(name: str) -> None:
    """Nothing is ever further from rest than what falls or flies."""
    found, _ = of(name)
    fall = {"flight": 12.0, "parts": 4.5}
    assert found.bound < fall.get(name, 1.5)
    assert np.isfinite(moved(name)).all()


@pytest.mark.parametrize("name", RECOVER)
def test_crushed_bodies_find_back_to_rest(name: str) -> None:
    """No node is farther from rest than a millionth of the body, no cell is inside out."""
    found, simulation = of(name)
    assert simulation is not None
    assert np.abs(moved(name)).max() < 1e-7
    assert found.inverted == 0
    # Four times e^(-5 s) of mass damping alone would leave this share of the energy at most.
    assert simulation.energy()["total"] < 1e-12


@pytest.mark.parametrize("name", ["huge_step", "one_element", "thin", "contrast", "rest"])
def test_it_comes_to_the_static_equilibrium(name: str) -> None:
    """To what is left of the swing after the damping: a thousandth of the body's size at most."""
    size = np.ptp(end(name).meshes[end(name).bodies[0]].points, axis=0).max()
    tolerance = 1e-8 if name == "huge_step" else 1e-3 * size
    np.testing.assert_allclose(moved(name), equilibrium(name), rtol=0, atol=tolerance)


def test_the_equilibrium_of_a_contrast_stops_at_round_off_and_says_so() -> None:
    """Positions of 0.2 m have units of 3e-17 m in the last place, and a block of 200 GPa of 2.5 cm
    cells makes forces of 1e-7 N of each; the load is 3 mN.

    Whole steps of Newton's method get there, though the first leaves 1e9 times the load.
    """
    scene = case("contrast")
    step = ts.Static(newton=ts.Newton(iterations=60, tolerance=1e-9), solver=ts.Cholesky())
    report = scene.replace(step=step, duration=None).compile().step()
    assert report.converged
    assert report.newton_iterations <= 10
    assert 1e-9 < report.residual < 1e-2
    assert "equilibrium to round-off" in report.message


def test_the_stiff_half_of_a_contrast_is_rigid_and_the_soft_half_right() -> None:
    """Bones ten thousand times softer are as rigid to the soft part."""
    scene = case("contrast")
    laws = dict(scene.bodies["bar"].law)
    laws["2 hexahedron stiff"] = ts.StVK(young="20 MPa", poisson=0.3)
    softer = scene.replace(bodies={"bar": scene.bodies["bar"].replace(law=laws)}).compile()
    for _ in softer.run():
        pass
    simulation = end("contrast")
    np.testing.assert_allclose(moved("contrast"), softer.displacements("bar"), atol=2e-5)
    points = simulation.meshes["bar"].points
    stiff = points[:, 0] > 0.1 - 1e-9
    rest, now = points[stiff], simulation.positions["bar"][stiff]
    before = np.linalg.norm(rest[:, None] - rest[None], axis=2)
    after = np.linalg.norm(now[:, None] - now[None], axis=2)
    # The weight of 10 cm over 200 GPa: strains of 1e-10; positions have 1e-16.
    assert np.abs(after - before).max() < 1e-9


def test_an_incompressible_bar_keeps_its_volume() -> None:
    """J - 1 = pressure / bulk modulus: some kPa over 100 MPa in each cell."""
    ratios = end("incompressible").cell_fields("bar")["volume_ratio"]
    assert np.abs(ratios - 1.0).max() < 2e-4
    assert np.abs(moved("incompressible")).max() > 0.01


def test_a_foil_of_slivers_stretches_by_its_closed_form() -> None:
    """P = E/2 F (F^2 - 1) = rho g L / 2 at nu = 0: half the weight hangs on the free edge."""
    half_weight, young = 1000 * 9.81 * 1.0 / 2, 1e6
    roots = np.roots([young / 2, 0, -young / 2, -half_weight])
    stretch = next(root.real for root in roots if abs(root.imag) < 1e-12 and root.real > 1)
    simulation = end("sliver")
    free = simulation.meshes["foil"].points[:, 0] == 1.0
    # Shear between the four edges of a foil of two triangles; e^(-20) of the swing.
    assert moved("sliver")[free, 0].mean() == pytest.approx(stretch - 1, rel=2e-2)
    assert np.abs(moved("sliver")[:, 2]).max() < 1e-6


def test_compression_beyond_the_strength_of_stvk_is_bounded_and_told() -> None:
    """The law lets cells turn inside out there: they are counted; the led face is in its place."""
    found, simulation = of("compression")
    assert simulation is not None
    assert found.bound == pytest.approx(0.6, abs=1e-12)
    assert found.inverted == len(simulation.inverted_cells("cube"))
    assert found.unconverged <= 5


def test_neo_hooke_holds_where_stvk_does_not() -> None:
    """Its closed form at F = 0.4: the lateral stretch that makes the sides free of stress."""
    found, simulation = of("compression_neo")
    assert simulation is not None
    assert found.inverted == 0
    assert found.unconverged == 0
    lame, mu = 10e3 * 0.3 / (1.3 * 0.4), 10e3 / 2.6
    # mu (s^2 - 1) + lambda ln(s^2 F) = 0
    low, high = 1.0, 2.0
    for _ in range(60):
        s = (low + high) / 2
        low, high = (s, high) if mu * (s * s - 1) + lame * np.log(s * s * 0.4) < 0 else (low, s)
    sides = simulation.meshes["cube"].points[:, 0] == 0.1
    np.testing.assert_allclose(moved("compression_neo")[sides, 0], 0.1 * (s - 1), rtol=1e-4)


def test_steps_of_a_microsecond_lose_nothing() -> None:
    """The free end has not felt the clamp: h^2 g n (n + 1) / 2, backward Euler's free fall."""
    simulation = end("tiny_step")
    n, h = 2000, 1e-6
    tip = simulation.meshes["bar"].points[:, 0] == 0.2
    # Elastic waves reach it by a share (c t / cell)^2 = (9 m/s 2 ms / 5 cm)^2 per cell in between.
    fall = moved("tiny_step")[tip, 2]
    np.testing.assert_allclose(fall, -9.81 * h * h * n * (n + 1) / 2, rtol=1e-3)


def test_ten_turns_end_where_they_began() -> None:
    found, _ = of("turns")
    # What a swing of e^(-…) leaves after three seconds at rest: less than a thousandth of 20 cm.
    assert np.abs(moved("turns")).max() < 2e-4
    assert found.inverted == 0
    assert found.unconverged == 0


def test_an_impact_at_100_m_per_s_never_gains_energy() -> None:
    """1/2 m v^2 of the free nodes at the start is the most there ever is."""
    simulation = case("impact").compile()
    most = simulation.energy()["total"]
    before = most
    for report in simulation.run():
        assert report.converged, report
        now = simulation.energy()["total"]
        assert now <= before * (1 + 1e-6)
        before = now
    assert len(simulation.inverted_cells("block")) == 0


def test_large_swings_of_stvk_stay_below_the_energy_they_have() -> None:
    """Linearised once, this scene used to explode: the weight's potential is all there is."""
    simulation = case("large_swing").compile()
    start = simulation.energy()["total"]
    for _ in simulation.run():
        assert simulation.energy()["total"] <= start + 1e-3 * abs(start)


def test_disconnected_parts_go_their_own_ways() -> None:
    simulation = end("parts")
    points = simulation.meshes["pair"].points
    n, h = 50, 0.01
    free = points[:, 0] > 0.15
    # CG stops at 1e-6 of the weight in each of fifty steps.
    expected = -9.81 * h * h * n * (n + 1) / 2
    np.testing.assert_allclose(moved("parts")[free, 2], expected, rtol=1e-5)
    assert np.abs(moved("parts")[~free]).max() < 0.05


def test_free_flight_keeps_momenta_and_energy() -> None:
    simulation = case("flight").compile()
    mesh = simulation.meshes["block"]
    straight = simulation.energy()["total"]
    start = simulation.positions["block"].mean(axis=0)
    for _ in simulation.run():
        # Midpoint keeps no cubic energy exactly; h^2 omega^2 / 24 of what is elastic.
        assert simulation.energy()["total"] == pytest.approx(straight, rel=1e-2)
    # The nodes' mean is not the centre of mass of lumped masses, but moves with it on the whole.
    way = simulation.positions["block"].mean(axis=0) - start
    np.testing.assert_allclose(way, [2.0, 0.0, 1.0], atol=0.05)
    assert np.isfinite(mesh.points).all()


def test_a_body_without_support_has_no_equilibrium_and_is_named() -> None:
    found, _ = of("floating")
    assert found.kind == "refused"
    for word in ("block", "freely", "static"):
        assert word in found.message
