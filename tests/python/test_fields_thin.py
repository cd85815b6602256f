"""Fields of plane bodies, sheets and lines: as a body of volumes in the same state has them."""

import numpy as np
import pytest

import tissu as ts
from field_states import LINES, SHEETS, TURN, body_of, put, simulation_of, von_mises
from tissu import _core

E, NU = 1000.0, 0.3
STVK = ts.StVK(young=E, poisson=NU)
HOOKE = ts.Hooke(young=E, poisson=NU)
IN_PLANE = np.diag([1.2, 0.9, 1.0])
SHEARED = np.array([[1.2, 0.1, 0], [-0.05, 0.9, 0], [0, 0, 1.0]])


def thinned(F, law=STVK, across=(2,)):
    """F with the columns `across` stretched by the s that leaves no stress: closed forms.

    StVK: E_nn = -nu / (1 - nu) tr(E) in a sheet, -nu E in a line; s^2 = 1 + 2 E_nn. Hooke: the
    same of the small strain.
    """
    F = F.copy()
    kept = [i for i in range(3) if i not in across]
    strain = (F.T @ F - np.eye(3)) / 2 if law is STVK else (F + F.T) / 2 - np.eye(3)
    ratio = NU / (1 - NU) if len(kept) == 2 else NU
    e = -ratio * sum(strain[i, i] for i in kept)
    s = np.sqrt(1 + 2 * e) if law is STVK else 1 + e
    for i in across:
        F[:, i] *= s
    return F


def of_volume(F, law=STVK):
    """All fields of a hexahedron of volumes in the state F."""
    simulation = simulation_of(body_of("hexahedron", law))
    put(simulation, F)
    return {name: value[0] for name, value in simulation.fields(ts.FIELD_NAMES).items()}


def expect(simulation, expected):
    """Every field, at points, cells and nodes, to round-off."""
    for at in ("points", "cells", "nodes"):
        for name, found in simulation.fields(ts.FIELD_NAMES, at).items():
            scale = max(np.abs(expected[name]).max(), 1e-3 * E if "stress" in name else 1e-3)
            assert np.abs(found - expected[name]).max() < 1e-9 * scale, (name, at)


def test_the_lists_of_these_tests_are_whole():
    assert {row[0] for row in _core.elements() if row[2] == 2} == set(SHEETS)
    assert {row[0] for row in _core.elements() if row[2] == 1} == set(LINES)
    of_thin = {name for name, *_, dimensions in _core.laws() if {1, 2} & set(dimensions)}
    assert of_thin == {"stvk", "hooke"}


@pytest.mark.parametrize(
    "plane, stress, ratio",
    [("strain", 294.6, 1.08), ("stress", 310.3, 1.0205), (None, 310.3, 1.0205)],
)
def test_the_numbers_that_were_reported(plane, stress, ratio):
    """StVK of 1 kPa and 0.3, stretched 1.2 x 0.9; before: 322, 293, 293, and 1.08 for all."""
    simulation = simulation_of(body_of("quad", STVK, plane=plane))
    put(simulation, IN_PLANE)
    fields = simulation.cell_fields("b")
    assert fields["von_mises"] == pytest.approx(stress, abs=0.1)
    assert fields["volume_ratio"] == pytest.approx(ratio, abs=1e-4)


@pytest.mark.parametrize("law", [STVK, HOOKE], ids=["stvk", "hooke"])
@pytest.mark.parametrize("cell", SHEETS)
def test_plane_strain_is_a_volume_that_keeps_its_thickness(cell, law):
    simulation = simulation_of(body_of(cell, law, plane="strain"))
    put(simulation, SHEARED)
    expect(simulation, of_volume(SHEARED, law))
    sigma = simulation.field("cauchy_stress")
    assert sigma[:, 2, 2].min() > 40  # it presses on what holds it


@pytest.mark.parametrize("law", [STVK, HOOKE], ids=["stvk", "hooke"])
@pytest.mark.parametrize("plane", ["stress", None])
@pytest.mark.parametrize("cell", SHEETS)
def test_plane_stress_is_a_volume_that_thins(cell, plane, law):
    simulation = simulation_of(body_of(cell, law, plane=plane))
    put(simulation, SHEARED)
    F = thinned(SHEARED, law)
    expect(simulation, of_volume(F, law))
    sigma = simulation.field("cauchy_stress")
    assert np.abs(sigma[:, 2]).max() < 1e-9 * E
    assert F[2, 2] < 0.96


@pytest.mark.parametrize("cell", SHEETS)
def test_a_sheet_may_lie_any_way_in_space(cell):
    """Turned by TURN and stretched in its plane, then turned over by the state's own rotation."""
    simulation = simulation_of(body_of(cell, STVK))
    over = np.diag([1.0, -1.0, -1.0])
    put(simulation, TURN @ over @ SHEARED)
    expect(simulation, of_volume(TURN @ over @ thinned(SHEARED)))
    assert simulation.inverted_cells("b").size == 0


@pytest.mark.parametrize("law", [STVK, HOOKE], ids=["stvk", "hooke"])
@pytest.mark.parametrize("cell", LINES)
def test_a_line_thins_all_around(cell, law):
    F = np.diag([1.2, 1.0, 1.0])
    simulation = simulation_of(body_of(cell, law))
    put(simulation, F)
    thin = thinned(F, law, across=(1, 2))
    expect(simulation, of_volume(thin, law))
    if law is STVK:
        tension = E / 2 * (1.2**2 - 1) * 1.2  # P = E/2 (s^2 - 1) s on the section at rest
        sigma = tension / thin[1, 1] ** 2
        assert simulation.cell_fields("b")["von_mises"] == pytest.approx(sigma, rel=1e-9)
        assert simulation.cell_fields("b")["volume_ratio"] == pytest.approx(1.2 * thin[1, 1] ** 2)


@pytest.mark.parametrize("cell", LINES)
def test_a_turned_line_has_turned_stress(cell):
    simulation = simulation_of(body_of(cell, STVK))
    put(simulation, TURN @ np.diag([1.2, 1.0, 1.0]))
    thin = thinned(np.diag([1.2, 1.0, 1.0]), across=(1, 2))
    sigma = von_mises(of_volume(thin)["cauchy_stress"])
    t = TURN[:, 0]
    np.testing.assert_allclose(
        simulation.field("cauchy_stress"),
        np.broadcast_to(sigma * np.outer(t, t), (len(simulation.field("von_mises")), 3, 3)),
        atol=1e-9 * E,
    )


@pytest.mark.parametrize("plane", ["strain", "stress"])
@pytest.mark.parametrize("cell", SHEETS)
def test_a_mirrored_plane_cell_is_reported(cell, plane, tmp_path):
    """Nodes of the right half are folded over its left side: those cells are inside out."""
    simulation = simulation_of(body_of(cell, STVK, plane=plane))
    x = simulation.positions["b"]
    x[:, 0] = np.where(x[:, 0] > 0.1 + 1e-9, 0.2 - x[:, 0], x[:, 0])
    mirrored = simulation.inverted_cells("b")
    centre = simulation.meshes["b"].points[simulation.meshes["b"].body_blocks[0].nodes].mean(axis=1)
    assert mirrored.tolist() == np.flatnonzero(centre[:, 0] > 0.1).tolist()
    assert (simulation.field("volume_ratio")[mirrored] < 0).all()
    from tissu.output import Series

    series = Series(simulation, tmp_path)
    series.write()
    assert "inside out" in series.inverted


def test_beyond_the_reach_of_a_law_fields_are_not_numbers():
    """StVK: no thickness is free of stress where tr(E) nu / (1 - nu) is above 1/2."""
    simulation = simulation_of(body_of("quad", STVK))
    put(simulation, np.diag([1.7, 1.7, 1.0]))
    assert np.isnan(simulation.field("von_mises")).all()
    assert np.isnan(simulation.field("principal_stresses", "nodes")).all()


@pytest.mark.parametrize("plane", ["strain", "stress", None])
@pytest.mark.parametrize("cell", ["quad", "triangle"])
def test_sheets_of_frames_thin_as_sheets_do(cell, plane):
    """Frames were free to thin in plane strain too, without a word."""
    simulation = simulation_of(body_of(cell, STVK, model="frames", plane=plane))
    put(simulation, SHEARED)
    expected = of_volume(SHEARED if plane == "strain" else thinned(SHEARED))
    volume = 0.2 * 0.1 * 0.01
    energy = simulation.energy()["elastic"]
    assert energy == pytest.approx(expected["energy_density"] * volume, rel=1e-9)
    found = simulation.field("volume_ratio", "points")
    np.testing.assert_allclose(found, expected["volume_ratio"], rtol=1e-9)
    stress = simulation.field("cauchy_stress", "points")
    np.testing.assert_allclose(stress, np.broadcast_to(expected["cauchy_stress"], stress.shape),
                               atol=1e-6 * E)  # fmt: skip


def test_a_shell_has_its_membrane_stress_and_thins():
    """A stretch of 1e-4: the shell is linear, so it agrees to the square of the strain."""
    F = np.eye(3) + 1e-4 * (SHEARED + SHEARED.T - 2 * np.eye(3)) / 2
    simulation = simulation_of(body_of("triangle", HOOKE, model="shell"))
    put(simulation, F)
    expected = of_volume(thinned(F, HOOKE), HOOKE)
    for name in ("cauchy_stress", "von_mises", "volume_ratio", "green_strain"):
        found = simulation.field(name)
        scale = np.abs(expected[name]).max()
        np.testing.assert_allclose(
            found, np.broadcast_to(expected[name], found.shape), atol=1e-3 * scale, err_msg=name
        )
    assert len(simulation.field("von_mises", "points")) == 3 * len(simulation.field("von_mises"))


def test_a_bent_shell_has_its_stress_at_the_faces():
    """A strip clamped at its end under a moment M per width: sigma = 6 M / t^2 (nu = 0)."""
    t, moment, width = 2e-3, 1e-4, 0.05
    scene = ts.Scene(
        bodies={
            "b": ts.Body(
                mesh=ts.BarMesh(size=(0.2, width, 0), cells=(16, 4, 0), cell="triangle"),
                law=ts.Hooke(young=1e6, poisson=0.0),
                density=1e3,
                thickness=t,
                model="shell",
            )
        },
        fixed=[ts.Fixed("b", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        loads=[
            ts.Moment("b", on=ts.Plane((0.2, 0, 0), (1, 0, 0)), moment=(0, moment * width, 0)),
        ],
        step=ts.Static(solver=ts.Cholesky()),
    )
    simulation = scene.compile()
    assert simulation.step().converged
    points = simulation.field("cauchy_stress", "points").reshape(-1, 3, 3, 3)
    inner = (
        np.abs(simulation.integration_points().positions.reshape(-1, 3, 3)[:, 0, 0] - 0.1) < 0.05
    )
    top, middle, bottom = (points[inner, k, 0, 0] for k in range(3))
    expected = 6 * moment / t**2
    assert np.abs(top).mean() == pytest.approx(expected, rel=0.02)  # nodes share the moment equally
    np.testing.assert_allclose(top, -bottom, rtol=1e-3)
    assert np.abs(middle).max() < 1e-3 * expected
    of_cells = simulation.field("von_mises")[inner]
    assert of_cells.mean() == pytest.approx(expected, rel=0.02)
    assert (np.sign(top) == np.sign(top[0])).all()
