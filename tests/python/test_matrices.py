"""Forces and matrices of a simulation against differences, sums and each other."""

import numpy as np
import pytest

import tissu as ts
from field_states import LAWS, STATES, body_of, put, simulation_of

HELD = ts.Plane((0, 0, 0), (1, 0, 0))
END = ts.Plane((0.2, 0, 0), (1, 0, 0))


def deformed(simulation, seed=3):
    random = np.random.default_rng(seed)
    put(simulation, STATES["stretch"] @ STATES["shear"])
    x = simulation.positions["b"]
    x += random.normal(0, 1e-3, x.shape)
    return x


@pytest.mark.parametrize("law", ["hooke", "stvk", "stable_neo_hooke", "fibres"])
@pytest.mark.parametrize("cell", ["tetra", "hexahedron", "wedge15", "quad8", "line3"])
def test_forces_are_minus_the_slope_of_the_energy(cell, law):
    if law in ("stable_neo_hooke", "fibres") and cell in ("quad8", "line3"):
        law = "stvk"
    simulation = simulation_of(body_of(cell, LAWS[law]))
    x = deformed(simulation)
    found, h = simulation.forces()[simulation.rows("b")], 1e-7
    scale = np.abs(found).max()
    for node in {0, len(x) // 2, len(x) - 1}:
        for axis in range(3):
            energies = []
            for sign in (1, -1):
                x[node, axis] += sign * h
                energies.append(simulation.energy()["elastic"])
                x[node, axis] -= sign * h
            slope = (energies[0] - energies[1]) / (2 * h)
            # Round-off of the energy, 1e-16 of some J, over h.
            assert found[node, axis] == pytest.approx(-slope, abs=1e-6 * scale)


@pytest.mark.parametrize(
    "cell, fields",
    [
        ("tetra", {}),
        ("hexahedron20", {}),
        ("hexahedron", {"model": "mean_dilatation"}),
        ("hexahedron", {"model": ts.Corotational(tangent="exact")}),
        ("tetra", {"model": "mass_tensor"}),
        ("tetra", {"model": "mass_spring"}),
        ("quad", {"plane": "strain"}),
        ("triangle6", {}),
        ("line", {}),
    ],
)
def test_stiffness_is_minus_the_slope_of_the_forces(cell, fields):
    law = (
        "hooke"
        if fields.get("model") in ("mass_spring", ts.Corotational(tangent="exact"))
        else "stvk"
    )
    simulation = simulation_of(body_of(cell, LAWS[law], **fields))
    x = deformed(simulation)
    K = simulation.stiffness()
    assert K.shape == (3 * len(x), 3 * len(x))
    direction, h = np.random.default_rng(1).normal(0, 1, x.shape), 1e-7
    sides = []
    for sign in (1, -1):
        x += sign * h * direction
        sides.append(simulation.forces().ravel())
        x -= sign * h * direction
    slope = (sides[0] - sides[1]) / (2 * h)
    np.testing.assert_allclose(K @ direction.ravel(), -slope, atol=1e-6 * np.abs(slope).max())
    assert abs(K - K.T).max() < 1e-10 * abs(K).max()


def test_damping_is_minus_the_slope_of_the_forces_in_velocity():
    body = body_of("hexahedron", LAWS["stvk"], viscosity=ts.KelvinVoigt(eta=20.0, zeta=10.0))
    simulation = simulation_of(body)
    deformed(simulation)
    v = simulation.velocities["b"]
    v[:] = np.random.default_rng(4).normal(0, 1, v.shape)
    before = simulation.forces()
    D = simulation.damping()
    v += 1.0  # a common velocity strains nothing, …
    np.testing.assert_allclose(simulation.forces(), before, atol=1e-9 * np.abs(before).max())
    change = np.random.default_rng(5).normal(0, 1, v.shape)
    v += change  # … and viscosity is linear in the others
    expected = -(simulation.forces() - before).ravel()
    np.testing.assert_allclose(D @ change.ravel(), expected, atol=1e-9 * np.abs(expected).max())
    assert np.abs(expected).max() > 0


def test_rayleigh_damping_is_a_sum_of_mass_and_stiffness():
    body = body_of("tetra", LAWS["hooke"], viscosity=ts.Rayleigh(mass=3.0, stiffness=0.02))
    simulation = simulation_of(body)
    M, K, D = simulation.mass_matrix(), simulation.stiffness(), simulation.damping()
    np.testing.assert_allclose(
        D.toarray(), (3.0 * M + 0.02 * K).toarray(), atol=1e-10 * abs(D).max()
    )


@pytest.mark.parametrize(
    "cell, model", [("tetra", "fem"), ("hexahedron20", "fem"), ("quad", "frames")]
)
def test_mass_matrix_sums_to_the_mass(cell, model):
    simulation = simulation_of(body_of(cell, LAWS["stvk"], model=model))
    M = simulation.mass_matrix()
    volume = 0.2 * 0.1 * (0.1 if cell != "quad" else 0.01)
    rows = simulation.rows("b")
    nodal = M.diagonal().reshape(-1, 3)[rows]
    assert nodal.sum(axis=0) == pytest.approx([1e3 * volume] * 3, rel=1e-12)
    if model == "fem":
        assert M.sum() == pytest.approx(3e3 * volume, rel=1e-12)
        assert M.nnz == 3 * len(nodal)
    else:
        inertia = M.diagonal().reshape(-1, 3)[simulation.rows("b", rotations=True)]
        assert (inertia > 0).all()


def test_eigenfrequencies_of_the_matrices_are_those_of_the_simulation():
    """The largest omega of K y = omega^2 M y over free rows, by SciPy and by Lanczos' method."""
    from scipy.linalg import eigh

    scene = ts.Scene(
        bodies={"b": body_of("hexahedron", LAWS["stvk"])},
        fixed=[ts.Fixed("b", on=HELD)],
        step=ts.ImplicitEuler("1 ms"),
    )
    simulation = scene.compile()
    free = np.repeat(simulation.meshes["b"].points[:, 0] > 0, 3)
    K = simulation.stiffness().toarray()[np.ix_(free, free)]
    M = simulation.mass_matrix().toarray()[np.ix_(free, free)]
    omega = np.sqrt(eigh(K, M, eigvals_only=True)[-1])
    assert simulation.largest_frequency() == pytest.approx(omega, rel=1e-3)


def test_forces_are_zero_where_nothing_is_held_and_minus_the_reactions_elsewhere():
    scene = ts.Scene(
        bodies={"b": body_of("hexahedron", LAWS["neo_hooke"])},
        gravity=(0, 0, -9.81),
        fixed=[ts.Fixed("b", on=HELD)],
        loads=[ts.Traction("b", on=END, traction=(300, 0, 100))],
        step=ts.Static(newton=ts.Newton(iterations=40, tolerance=1e-10), solver=ts.Cholesky()),
    )
    simulation = scene.compile()
    assert simulation.step().converged
    forces, given = simulation.forces(), simulation.reactions("b")
    held = simulation.meshes["b"].points[:, 0] == 0
    load = 300 * 0.01
    assert np.abs(forces[~held]).max() < 1e-8 * load
    np.testing.assert_array_equal(forces[held], -given[held])
    weight = 1e3 * 0.002 * 9.81
    assert given.sum(axis=0) == pytest.approx((-load, 0, weight - 100 * 0.01), abs=1e-7)


@pytest.mark.parametrize("cell, model", [("quad", "frames"), ("triangle", "shell")])
def test_moments_of_a_clamp_balance_a_load_at_the_end(cell, model):
    """A strip along x, force F along z at its end: sum of x cross f and moments is that of F."""
    force = 1e-4
    scene = ts.Scene(
        bodies={
            "b": body_of(cell, LAWS["hooke"] if model == "shell" else LAWS["stvk"], model=model)
        },
        fixed=[ts.Fixed("b", on=HELD)],
        loads=[ts.NodalLoad("b", on=END, force=(0, 0, force))],
        step=ts.Static(newton=ts.Newton(iterations=40, tolerance=1e-10), solver=ts.Cholesky()),
    )
    simulation = scene.compile()
    assert simulation.step().converged
    given, moments = simulation.reactions("b"), simulation.reactions("b", moments=True)
    x = simulation.positions["b"]
    assert given.sum(axis=0) == pytest.approx((0, 0, -force), abs=1e-9 * force)
    total = np.cross(x, given).sum(axis=0) + moments.sum(axis=0)
    end = simulation.meshes["b"].points[:, 0] > 0.2 - 1e-9
    arm = x[end].mean(axis=0)
    assert total == pytest.approx(-np.cross(arm, (0, 0, force)), abs=1e-6 * force * 0.2)
    assert not moments[simulation.meshes["b"].points[:, 0] > 0].any()
    assert np.abs(moments).max() > 0.1 * force * 0.2 / 4


def test_bodies_without_rotations_have_no_moments():
    simulation = simulation_of(body_of("tetra", LAWS["stvk"]))
    with pytest.raises(ts.ParameterError, match="found body 'b', whose nodes have no rotation"):
        simulation.reactions("b", moments=True)
