"""Scenes of the gallery against closed forms. Others are in test_contact_examples.py and beside.

Tolerances: what round-off and the solvers leave where the discrete problem has the closed form
itself; else what its cells and steps leave, halved by halving them.
"""

import math
import re
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_bvp
from scipy.optimize import brentq, minimize

from tissu import Scene

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"
G = 9.81


def compiled(name):
    return Scene.from_yaml(EXAMPLES / f"{name}.yaml").compile()


def ended(name):
    """The simulation at the end of its run; every step converged."""
    simulation = compiled(name)
    for report in simulation.run():
        assert report.converged, report
    return simulation


def test_a_bar_twists_evenly():
    """By symmetry its middle turns by a quarter; both ends feel one torque about its axis."""
    simulation = ended("twist")
    rest, now = simulation.meshes["bar"].points, simulation.positions["bar"]
    middle = np.isclose(rest[:, 0], 0.15)
    a, b = (np.arctan2(p[middle, 2], p[middle, 1]) for p in (rest, now))
    off_axis = np.hypot(*rest[middle, 1:].T) > 1e-3
    turn = np.degrees(b - a)[off_axis] % 360
    assert turn.mean() == pytest.approx(90, abs=1e-6)
    forces, root = simulation.reactions("bar"), np.isclose(rest[:, 0], 0)
    torque = np.cross(now, forces)
    assert torque[root].sum(axis=0)[0] == pytest.approx(-torque[~root].sum(axis=0)[0], rel=1e-6)
    assert not len(simulation.inverted_cells("bar"))


def test_a_drum_is_held_by_its_pressure_over_its_area():
    """A following pressure on a surface with a flat rim: p times the area of the rim, upwards."""
    simulation = ended("drum")
    held = simulation.reactions("membrane").sum(axis=0)
    assert held == pytest.approx([0, 0, -1e3 * 0.1**2], abs=1e-6)
    assert simulation.displacements("membrane")[:, 2].min() >= 0


def test_stress_relaxes_as_its_prony_series():
    """One branch, weight 1 and tau = 0.2 s; T is 50 ms: 1 + tau / T (e^(T/tau) - 1) e^(-t/tau)."""
    simulation = compiled("relax")
    top = np.isclose(simulation.meshes["block"].points[:, 2], 0.02)
    elastic = 1e-4 * 1e5 * 1.1 * (1.1**2 - 1) / 2  # StVK in uniaxial stress: P = E F (F^2 - 1) / 2
    for _ in simulation.run():
        t = simulation.time
        if t > 0.1:
            force = simulation.reactions("block")[top, 2].sum()
            series = 1 + 0.2 / 0.05 * (math.exp(0.05 / 0.2) - 1) * math.exp(-t / 0.2)
            assert force == pytest.approx(
                elastic * series, rel=1e-3
            )  # the strain is not linear in t


def stretch(traction, fibres):
    """Stretch along the pull, by the energy that the laws' publications have."""
    young, nu, k1, k2 = 10e3, 0.3, 5e3, 2.0
    mu, lame = young / 2 / (1 + nu), young * nu / (1 + nu) / (1 - 2 * nu)

    def energy(z):
        along, across = z
        volume = along * across**2
        found = mu / 2 * (along**2 + 2 * across**2 - 3 - 2 * math.log(volume))
        found += lame / 2 * math.log(volume) ** 2 - traction * along
        if fibres:
            excess = max(volume ** (-2 / 3) * along**2 - 1, 0.0)
            found += k1 / 2 / k2 * (math.exp(k2 * excess**2) - 1)
        return found

    options = {"xatol": 1e-10, "fatol": 1e-13}
    return minimize(energy, [1.2, 0.95], method="Nelder-Mead", options=options).x[0]


def test_fibres_stiffen():
    simulation = ended("fibres")
    for body, fibres in (("plain", False), ("fibred", True)):
        end = np.isclose(simulation.meshes[body].points[:, 0], 0.1)
        found = 1 + simulation.displacements(body)[end, 0] / 0.1
        assert found == pytest.approx(stretch(6e3, fibres), rel=1e-5)


def test_a_truss_snaps_through_on_its_closed_path():
    """S A times twice the slope of a bar: von Mises' truss of St-Venant-Kirchhoff."""
    simulation, half, rise = compiled("snap"), 0.2, 0.04
    length, signs = math.hypot(half, rise), []
    for report in simulation.run():
        assert report.converged
        height = rise + simulation.displacements("truss")[1, 2]
        tension = 1e5 * 1e-4 * (half**2 + height**2 - length**2) / (2 * length**2)
        closed = 2 * tension * height / length
        assert simulation.reactions("truss")[1, 2] == pytest.approx(closed, rel=1e-9, abs=1e-12)
        signs.append(np.sign(round(closed, 9)))
    assert {-1.0, 1.0} <= set(signs)


def test_a_strip_rolls_into_a_circle():
    """Its end comes back to its root; what is left is that of 20 cells, 5e-5 of the length."""
    simulation = ended("roll")
    end = np.isclose(simulation.meshes["strip"].points[:, 0], 0.2)
    middle = simulation.positions["strip"][end].mean(axis=0)
    assert np.linalg.norm(middle[[0, 2]]) < 2e-4 * 0.2


def test_a_block_tumbles_with_its_energy_and_momentum():
    simulation = compiled("tumble")
    mass = simulation.mass_matrix().diagonal().reshape(-1, 3)[:, 0]

    def momenta():
        x, v = simulation.positions["block"], simulation.velocities["block"]
        return np.concatenate([mass @ v, mass @ np.cross(x, v)])

    energy, before = simulation.energy()["total"], momenta()
    for report in simulation.run():
        assert report.converged
    assert simulation.energy()["total"] == pytest.approx(energy, rel=1e-7)
    assert momenta() == pytest.approx(before, abs=1e-8 * np.abs(before).max())
    assert simulation.energy()["elastic"] > 0


def test_tetrahedra_lock_and_mean_dilatation_cures_them():
    simulation = ended("locking")
    sag = {body: -simulation.displacements(body)[:, 2].min() for body in simulation.bodies}
    assert sag["locked"] < 0.4 * sag["quadratic"]
    assert sag["cured"] == pytest.approx(sag["quadratic"], rel=0.1)
    assert sag["hexahedra"] == pytest.approx(sag["quadratic"], rel=0.03)


def test_a_cable_hangs_in_a_catenary():
    """Of 40 straight pieces that stretch by 1e-5: its sag is that of the curve within 1e-3."""
    simulation = ended("cable")
    a = brentq(lambda a: 2 * a * math.sinh(1.0 / (2 * a)) - 1.2, 0.1, 5.0)
    sag = a * (math.cosh(1.0 / (2 * a)) - 1)
    assert -simulation.positions["cable"][:, 2].min() == pytest.approx(sag, rel=1e-3)
    weight = 1e3 * 1e-5 * 1.2 * G
    assert simulation.reactions("cable")[:, 2].sum() == pytest.approx(weight, rel=1e-3)


def test_a_block_slides_with_coulombs_friction():
    simulation, seen = compiled("slide"), []
    for report in simulation.run():
        assert report.converged
        assert simulation.crossings() == []
        seen.append((simulation.time, simulation.velocities["block"][:, 0].mean()))
    late = np.array(seen)[50:]
    slope = np.polyfit(*late.T, 1)[0]
    assert slope == pytest.approx(G * (0.5 - 0.2 * math.sqrt(3) / 2), rel=1e-5)


def test_a_wave_arrives_when_it_should():
    """Speed sqrt(E / rho) = 10 m/s; behind the front all move with F / (A sqrt(E rho))."""
    simulation, middle = compiled("wave"), []
    for _ in simulation.run():
        middle.append((simulation.time, simulation.velocities["bar"][100, 0]))
    behind = 10e-3 / (1e-4 * math.sqrt(1e5 * 1e3))
    arrival = next(t for t, v in middle if v > behind / 2)
    assert arrival == pytest.approx(0.05, abs=1e-3)  # a step, and the width of the front
    assert simulation.velocities["bar"][150:195, 0].mean() == pytest.approx(behind, rel=1e-2)


def test_a_rod_bends_as_eulers_elastica():
    """P L^2 / (E I) = 3; 20 pieces are within half a percent of the length."""
    simulation = ended("rod")

    def slope(s, y):
        return np.array([y[1], -3 * np.cos(y[0])])

    ends = solve_bvp(
        slope, lambda a, b: np.array([a[0], b[1]]), np.linspace(0, 1, 50), np.full((2, 50), 0.5)
    )
    s = np.linspace(0, 1, 2001)
    angle = ends.sol(s)[0]
    closed = [np.mean(np.cos(angle)) - 1, 0, np.mean(np.sin(angle))]
    closed = [closed[0], 0, -abs(closed[2])]
    assert simulation.displacements("rod")[20] / 0.2 == pytest.approx(closed, abs=5e-3)


def test_every_scene_of_the_gallery_has_a_picture_and_a_file():
    page = (ROOT / "docs" / "gallery.md").read_text(encoding="utf-8")
    for scene in sorted(EXAMPLES.glob("*.yaml")):
        remedy = f"its section in docs/gallery.md; python docs/make_gallery.py {scene.stem}"
        assert f"../examples/{scene.name}" in page, remedy
        assert f"pictures/gallery/{scene.stem}.webp" in page, scene.name
        assert (ROOT / "docs/pictures/gallery" / f"{scene.stem}.webp").is_file()


def test_the_tests_that_the_gallery_names_are_there():
    page = (ROOT / "docs" / "gallery.md").read_text(encoding="utf-8")
    for name in re.findall(r"tested in `([^`]+)`", page):
        assert (ROOT / "tests/python" / name).is_file(), name
