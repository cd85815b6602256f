"""Strain and stress as arrays: every element, law and model in homogeneous states."""

import warnings
from pathlib import Path

import numpy as np
import pytest
import sympy

import tissu as ts
from field_states import (
    LAWS,
    STATES,
    VOLUMES,
    body_of,
    put,
    simulation_of,
    stress_of_energy,
    von_mises,
)
from tissu import _core
from tissu.formula import I_C, J, ln
from tissu.simulation import tensors

ROUND_OFF = 1e-11  # of the largest entry: some hundred operations on numbers of size 1
OF_DIFFERENCES = 1e-7  # see stress_of_energy
STEP = ts.ImplicitEuler("1 ms")
PLACES = ("points", "cells", "nodes")


def near(found, expected, tolerance):
    """All rows equal one tensor, to a share of its largest entry."""
    expected = np.asarray(expected)
    scale = max(np.abs(expected).max(), 1e-300)
    return np.abs(found - expected).max() <= tolerance * scale


def test_the_lists_of_these_tests_are_whole():
    assert {row[0] for row in _core.elements() if row[2] == 3} == set(VOLUMES)
    assert {row[0] for row in _core.laws()} - {"fibre"} == set(LAWS) - {"fibres"}


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("cell", VOLUMES)
def test_every_element_and_law_has_the_stress_of_its_energy(cell, law, state):
    simulation = simulation_of(body_of(cell, LAWS[law]))
    F = put(simulation, STATES[state])
    volume = simulation.meshes["b"].volume()
    P = stress_of_energy(simulation, F, volume)
    J = np.linalg.det(F)
    sigma = (P @ F.T + F @ P.T) / (2 * J)
    inverse = np.linalg.inv(F)
    S = (inverse @ P + P.T @ inverse.T) / 2
    for at in PLACES:
        found = simulation.fields(ts.FIELD_NAMES, at)
        assert near(found["deformation_gradient"], F, ROUND_OFF), at
        assert near(found["green_strain"], (F.T @ F - np.eye(3)) / 2, 10 * ROUND_OFF), at
        assert near(found["first_piola_kirchhoff_stress"], P, OF_DIFFERENCES), at
        assert near(found["second_piola_kirchhoff_stress"], S, OF_DIFFERENCES), at
        assert near(found["cauchy_stress"], sigma, OF_DIFFERENCES), at
        assert near(found["von_mises"], von_mises(sigma), 10 * OF_DIFFERENCES), at
        assert near(found["volume_ratio"], J, ROUND_OFF), at
        W = simulation.energy()["elastic"] / volume
        assert near(found["energy_density"], W, ROUND_OFF), at
        sorted_values = np.linalg.eigvalsh(sigma)[::-1]
        assert near(found["principal_stresses"], sorted_values, 10 * OF_DIFFERENCES), at
        strains = np.linalg.eigvalsh((F.T @ F - np.eye(3)) / 2)[::-1]
        assert near(found["principal_strains"], strains, 10 * ROUND_OFF), at
    if state != "shear" or law != "hooke":
        assert abs(sigma).max() > 100  # there is something to compare


def lame(young, poisson):
    return young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))


@pytest.mark.parametrize("state", STATES)
def test_closed_forms_of_stvk_and_neo_hooke(state):
    """S = lambda tr(E) I + 2 mu E; tau = mu (F F^T - I) + lambda ln(J) I."""
    F, (la, mu) = STATES[state], lame(3e4, 0.3)
    E, J = (F.T @ F - np.eye(3)) / 2, np.linalg.det(F)
    simulation = simulation_of(body_of("hexahedron", LAWS["stvk"]))
    put(simulation, F)
    S = la * np.trace(E) * np.eye(3) + 2 * mu * E
    assert near(simulation.field("second_piola_kirchhoff_stress"), S, 1e-11)
    assert near(simulation.field("cauchy_stress"), F @ S @ F.T / J, 1e-11)
    W = la / 2 * np.trace(E) ** 2 + mu * np.sum(E * E)
    assert near(simulation.field("energy_density"), W, 1e-10)
    simulation = simulation_of(body_of("wedge15", LAWS["neo_hooke"]))
    put(simulation, F)
    tau = mu * (F @ F.T - np.eye(3)) + la * np.log(J) * np.eye(3)
    assert near(simulation.field("cauchy_stress", "nodes"), tau / J, 1e-11)


@pytest.mark.parametrize("law", [name for name in LAWS if name != "hooke"])
def test_a_turned_body_has_turned_stress_and_the_same_invariants(law):
    simulation = simulation_of(body_of("tetra", LAWS[law]))
    F, R = STATES["shear"] @ STATES["stretch"], STATES["turned"]
    R = np.linalg.svd(R)[0] @ np.linalg.svd(R)[2]
    put(simulation, F)
    before = {name: simulation.field(name) for name in ts.FIELD_NAMES}
    put(simulation, R @ F)
    after = {name: simulation.field(name) for name in ts.FIELD_NAMES}
    turned = R @ before["cauchy_stress"] @ R.T
    np.testing.assert_allclose(after["cauchy_stress"], turned, atol=1e-9 * np.abs(turned).max())
    same = (
        "green_strain",
        "second_piola_kirchhoff_stress",
        "von_mises",
        "principal_stresses",
        "principal_strains",
        "energy_density",
        "volume_ratio",
    )
    for name in same:
        scale = np.abs(before[name]).max()
        np.testing.assert_allclose(after[name], before[name], atol=1e-9 * scale, err_msg=name)


MODELS = {
    "corotational": (["tetra", "hexahedron", "wedge", "pyramid"], "hooke"),
    "mass_link": (["tetra"], "stvk"),
    "mass_tensor": (["tetra"], "stvk"),
    "mean_dilatation": (["tetra", "hexahedron", "wedge", "pyramid"], "neo_hooke"),
    "frames": (["tetra", "hexahedron", "wedge"], "neo_hooke"),
}
OF_MODELS = [(model, cell, law) for model, (cells, law) in MODELS.items() for cell in cells]


@pytest.mark.parametrize("model, cell, law", OF_MODELS)
def test_models_have_the_stress_of_their_energy(model, cell, law):
    """Frames are not turned here: then they carry any affine motion."""
    simulation = simulation_of(body_of(cell, LAWS[law], model=model))
    F = put(simulation, STATES["stretch"] @ STATES["shear"])
    volume = simulation.meshes["b"].volume()
    P = stress_of_energy(simulation, F, volume)
    found = simulation.fields(ts.FIELD_NAMES, "points")
    assert near(found["deformation_gradient"], F, ROUND_OFF)
    assert near(found["first_piola_kirchhoff_stress"], P, OF_DIFFERENCES)
    sigma = P @ F.T / np.linalg.det(F)
    assert near(found["cauchy_stress"], (sigma + sigma.T) / 2, OF_DIFFERENCES)
    assert near(found["energy_density"], simulation.energy()["elastic"] / volume, 1e-10)


# Of corotational cells tetrahedra alone: in others the turning of R adds a force beside the stress.
CONJUGATE = [row for row in OF_MODELS if row[0] != "corotational" or row[1] == "tetra"]


@pytest.mark.parametrize("model, cell, law", [("fem", "hexahedron20", "yeoh"), *CONJUGATE])
def test_stress_gives_back_the_energy_and_the_virtual_work_of_any_state(model, cell, law):
    """sum w P : dF = dE for a small change of any state, and sum w W = E."""
    random = np.random.default_rng(5)
    simulation = simulation_of(body_of(cell, LAWS[law], model=model))
    rest = simulation.meshes["b"].points
    state = rest @ STATES["stretch"].T + random.normal(0, 2e-3, rest.shape)
    if model != "frames":  # whose rotations stay where they are
        state = state @ STATES["turned"].T
    along, h = random.normal(0, 1, rest.shape), 1e-7

    def look(by):
        simulation.positions["b"][:] = state + by * along
        F = simulation.field("deformation_gradient", "points")
        return F, simulation.energy()["elastic"]

    (F1, e1), (F0, e0) = look(h), look(-h)
    F, energy = look(0)
    points = simulation.integration_points()
    assert points.volumes.sum() == pytest.approx(simulation.meshes["b"].volume(), rel=1e-12)
    W = simulation.field("energy_density", "points")
    assert points.volumes @ W == pytest.approx(energy, rel=1e-10)
    P = simulation.field("first_piola_kirchhoff_stress", "points")
    work = np.einsum("p,pij,pij", points.volumes, P, F1 - F0)
    assert work == pytest.approx(e1 - e0, rel=1e-5)  # round-off of e1 - e0
    assert np.abs(np.linalg.det(F) - simulation.field("volume_ratio", "points")).max() < 1e-12


@pytest.mark.parametrize("rotation", ["small", "frame", "polar"])
@pytest.mark.parametrize("cell", ["tetra", "hexahedron", "wedge", "pyramid"])
def test_corotational_stress_is_that_of_its_force(cell, rotation):
    """f_a = -sum w P grad_a with R as it is: the work of a motion that does not turn the cells.

    A stretch along the axes that R = I has, on cells whose rest shape is distorted too.
    """
    random = np.random.default_rng(8)
    mesh = ts.bar_mesh(size=(0.2, 0.1, 0.1), cells=(2, 1, 1), cell=cell)
    mesh = ts.Mesh(points=mesh.points + random.normal(0, 4e-3, mesh.points.shape), cells=mesh.cells)
    body = ts.Body(
        mesh=mesh,
        law=LAWS["hooke"],
        density=1e3,
        model=ts.Corotational(rotation=rotation, tangent="approximate"),
    )
    simulation = simulation_of(body)
    points = simulation.integration_points()
    x = simulation.positions["b"]
    x[:] = mesh.points * [1.1, 0.95, 1.02] + random.normal(0, 1e-3, x.shape)
    if rotation != "small":
        x[:] = x @ np.linalg.qr(STATES["turned"])[0].T
    W = simulation.field("energy_density", "points")
    assert points.volumes @ W == pytest.approx(simulation.energy()["elastic"], rel=1e-10)
    # Virtual work of u = G x: sum_a f_a . G x_a = -sum w P : (G F), for the force of `frame` and
    # `small`, and of `polar` in tetrahedra; in other cells the spin has a force beside P.
    if rotation == "polar" and cell != "tetra":
        return
    f = simulation.forces()[simulation.rows("b")]
    F = simulation.field("deformation_gradient", "points")
    P = simulation.field("first_piola_kirchhoff_stress", "points")
    G = random.normal(0, 1, (3, 3))
    work = np.einsum("p,pij,pij", points.volumes, P, G @ F)
    assert -np.sum(f * (x @ G.T)) == pytest.approx(work, rel=1e-9)


def test_a_condensed_region_has_the_fields_of_its_elements():
    """The inner nodes are where the kept ones put them; then all is as in fem."""
    end = ts.Plane((0.2, 0, 0), (1, 0, 0))
    made = {}
    for model in ("fem", "condensed"):
        scene = ts.Scene(
            bodies={"b": body_of("hexahedron", LAWS["hooke"], model=model)},
            fixed=[ts.Fixed("b", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
            loads=[ts.Traction("b", on=end, traction=(20, 0, 10))],
            step=ts.Static(solver=ts.Cholesky()),
        )
        made[model] = scene.compile()
        made[model].step()
    for name in ts.FIELD_NAMES:
        found, expected = (made[m].field(name, "points") for m in ("condensed", "fem"))
        np.testing.assert_allclose(found, expected, atol=1e-7 * np.abs(expected).max())


def test_laws_made_at_run_time_have_fields_too():
    mu, kappa = sympy.symbols("mu kappa")
    energy = mu / 2 * (I_C - 3 - 2 * ln(J)) + kappa / 2 * (J - 1) ** 2
    law = ts.law("soft_tissue", energy=energy, parameters={"mu": "Pa", "kappa": "Pa"})
    simulation = simulation_of(body_of("hexahedron", law(mu=1e4, kappa=3e4)))
    F = put(simulation, STATES["turned"])
    volume = np.linalg.det(F)
    sigma = 1e4 * (F @ F.T - np.eye(3)) / volume + 3e4 * (volume - 1) * np.eye(3)
    assert near(simulation.field("cauchy_stress"), sigma, 1e-11)


def test_quadratic_displacements_have_their_stress_at_every_node():
    """u quadratic, Hooke: sigma is linear in X; the fit in each cell is exact, at the rim too."""
    simulation = simulation_of(body_of("hexahedron20", LAWS["hooke"]))
    X = simulation.meshes["b"].points
    G = np.zeros((len(X), 3, 3))
    c = 0.01
    u = np.stack([c * X[:, 0] ** 2, c * X[:, 0] * X[:, 1], c * X[:, 2] * X[:, 0]], axis=1)
    G[:, 0, 0], G[:, 1, 0], G[:, 1, 1] = 2 * c * X[:, 0], c * X[:, 1], c * X[:, 0]
    G[:, 2, 0], G[:, 2, 2] = c * X[:, 2], c * X[:, 0]
    simulation.positions["b"][:] = X + u
    la, mu = lame(3e4, 0.3)
    e = (G + np.swapaxes(G, 1, 2)) / 2
    P = la * np.einsum("nii", e)[:, None, None] * np.eye(3) + 2 * mu * e
    found = simulation.field("first_piola_kirchhoff_stress", "nodes")
    np.testing.assert_allclose(found, P, atol=1e-10 * np.abs(P).max())


def test_fields_of_several_cell_types_and_laws_are_in_the_order_of_the_mesh():
    segments = ts.BarMesh(
        size=(0.3, 0.1, 0.1), cells=(3, 1, 1), segments="wedge6:stvk, hex8:stvk, tet4:hooke"
    )
    body = ts.Body(mesh=segments, law=LAWS["stvk"], density=1e3)
    simulation = simulation_of(body)
    X = simulation.meshes["b"].points
    simulation.positions["b"][:, 0] += 0.5 * X[:, 0] ** 2  # each cell has a stretch of its own
    points = simulation.integration_points("b")
    ratio = simulation.field("volume_ratio", "points")
    assert (np.diff(points.cells) >= 0).all()
    assert len(ratio) == len(points.cells) > simulation.meshes["b"].cell_count
    share = np.bincount(points.cells, points.volumes * ratio) / np.bincount(
        points.cells, points.volumes
    )
    np.testing.assert_allclose(share, simulation.field("volume_ratio"), rtol=1e-12)
    np.testing.assert_allclose(ratio, 1 + points.positions[:, 0], atol=0.05)  # cells are not small
    np.testing.assert_allclose(simulation.cell_fields("b")["volume_ratio"], share, rtol=1e-12)


def test_removed_cells_take_their_fields_along():
    body = body_of("hexahedron", LAWS["stvk"])
    simulation = ts.Scene(bodies={"b": body}, step=STEP, editing=True).compile()
    X = simulation.meshes["b"].points
    simulation.positions["b"][:, 0] += X[:, 0] ** 2
    before = simulation.field("volume_ratio")
    simulation.remove_cells(body="b", cells=[0])
    np.testing.assert_allclose(simulation.field("volume_ratio"), before[1:], rtol=1e-12)
    loose = simulation.field("volume_ratio", "nodes")[X[:, 0] == 0]
    assert np.isnan(loose).all()


@pytest.mark.parametrize(
    "asked, words",
    [
        (("cauchy", "cells"), "found the field 'cauchy'; accepted: deformation_gradient, "),
        (("von_mises", "faces"), "found the place 'faces'; accepted: cells, points, nodes"),
        (("von_mises", "cells", "c"), "found body 'c'; accepted: b"),
    ],
)
def test_what_is_unknown_is_refused_in_a_sentence(asked, words):
    simulation = simulation_of(body_of("tetra", LAWS["stvk"]))
    with pytest.raises(ts.ParameterError, match="^" + words):
        simulation.field(*asked)


def test_springs_have_no_stress_and_say_what_they_have():
    simulation = simulation_of(body_of("tetra", LAWS["hooke"], model="mass_spring"))
    words = "the model mass_spring of body 'b', .* energy_density and volume_ratio at cells"
    with pytest.raises(ts.ParameterError, match=words):
        simulation.field("von_mises")
    put(simulation, STATES["stretch"])
    ratio = np.linalg.det(STATES["stretch"])
    assert near(simulation.field("volume_ratio"), ratio, ROUND_OFF)
    volume = simulation.meshes["b"].cell_volumes()
    energy = volume @ simulation.field("energy_density")
    assert energy == pytest.approx(simulation.energy()["elastic"], rel=1e-10)
    with pytest.raises(ts.ParameterError, match=words):
        simulation.field("volume_ratio", "points")


def test_one_of_several_bodies_is_named():
    body = body_of("tetra", LAWS["stvk"])
    simulation = ts.Scene(bodies={"b": body, "c": body}, step=STEP).compile()
    with pytest.raises(ts.ParameterError, match="where there are 2 bodies; accepted: b, c"):
        simulation.field("von_mises")
    assert len(simulation.field("von_mises", body="c")) == simulation.meshes["c"].cell_count


def test_the_example_of_the_page_runs():
    page = (Path(__file__).parents[2] / "docs/guide/fields.md").read_text(encoding="utf-8")
    names: dict[str, object] = {}
    exec(page.split("```python")[1].split("```")[0], names)
    load = 3e3 * 0.01
    assert names["pull"] == pytest.approx((-load, 0, 0), abs=1e-5 * load)  # Newton's tolerance
    assert names["sigma"][-1, 0, 0] == pytest.approx(3e3, rel=0.3)  # the section narrows
    assert names["peak"] > 3e3
    for name in ts.FIELD_NAMES:
        assert f"`{name}`" in page


def test_a_stress_that_is_not_finite_has_no_measure_and_no_warning():
    """Cells without volume: P F^T / det F is infinite where it has an entry, and else nan."""
    for values in ([np.inf, 0.0], [np.nan, 1.0]):
        sigma = np.array([np.diag([*values, 1.0]), np.eye(3)])
        with warnings.catch_warnings(action="error"):
            np.testing.assert_array_equal(tensors.von_mises(sigma), [np.nan, 0.0])
