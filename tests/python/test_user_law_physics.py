"""A law of one's own computes what a law of the library computes, and what its formula says."""

import numpy as np
import pytest

import tissu as ts

pytest.importorskip("sympy")

import sympy

from tissu.formula import (
    I4,
    I_C,
    II_C,
    LAME,
    POISSON,
    YOUNG,
    C,
    E,
    Ibar1,
    J,
    exp,
    ln,
    positive,
    tr,
)

mu, lam, jm, kappa, beta = sympy.symbols("mu lambda jm kappa beta")
CELLS = ["tetra", "hexahedron", "wedge", "pyramid", "hexahedron20"]


@pytest.fixture(scope="module")
def repeated():
    """The library's neo-Hooke, word for word."""
    return ts.law(
        "repeated",
        energy=mu / 2 * (I_C - 3) - mu * ln(J) + lam / 2 * ln(J) ** 2,
        parameters=[YOUNG, POISSON],
        constants=LAME,
    )


@pytest.fixture(scope="module")
def gent():
    return ts.law(
        "gent",
        energy=-mu * jm / 2 * ln(1 - (Ibar1 - 3) / jm) + kappa / 2 * (J - 1) ** 2,
        parameters={"mu": "Pa", "jm": "1", "kappa": "Pa"},
        text="Chains that lock.",
    )


def cube(cell, law, *, dt, cells=(1, 1, 1), **fields):
    body = ts.Body(mesh=ts.bar_mesh(size=(1, 1, 1), cells=cells, cell=cell), law=law, density=1e3)
    step = ts.ImplicitEuler(dt, solver=ts.Cholesky())
    return ts.Scene(bodies={"cube": body}, step=step, **fields).compile()


def deform(simulation, seed=3, size=0.05):
    noise = np.random.default_rng(seed).uniform(-size, size, simulation.positions["cube"].shape)
    simulation.positions["cube"][:] = 1.05 * simulation.positions["cube"] + noise


def velocity_after_a_step(cell, law, dt):
    simulation = cube(cell, law, dt=dt)
    deform(simulation)
    simulation.step()
    return simulation.velocities["cube"].copy(), simulation


@pytest.mark.parametrize("cell", CELLS)
def test_force_and_tangent_are_those_of_the_law_it_repeats(cell, repeated):
    own, theirs = repeated(young=3e4, poisson=0.3), ts.NeoHooke(young=3e4, poisson=0.3)
    # A step so short that it shows the force alone, and one so long that the tangent rules:
    # (M - h^2 K) v = h f. The bounds are round-off of sums over points, and of a factor of a
    # matrix whose condition is about 1e4.
    for dt, bound in ((1e-7, 1e-13), (0.1, 1e-10)):
        mine, _ = velocity_after_a_step(cell, own, dt)
        wanted, _ = velocity_after_a_step(cell, theirs, dt)
        assert np.abs(wanted).max() > 0.0
        assert np.abs(mine - wanted).max() < bound * np.abs(wanted).max(), dt


def hanging(law):
    mesh = ts.bar_mesh(size=(0.4, 0.1, 0.1), cells=(8, 2, 2))
    scene = ts.Scene(
        bodies={"bar": ts.Body(mesh=mesh, law=law, density=1e3, viscosity=ts.Rayleigh(mass=1.0))},
        fixed=[ts.Fixed("bar", on=ts.Box((None, None, None), (1e-9, None, None)))],
        gravity=(0, 0, -9.81),
        step=ts.ImplicitEuler(0.01, solver=ts.Cholesky()),
    )
    simulation = scene.compile()
    reports = list(simulation.run(0.3))
    assert all(report.converged for report in reports)
    return simulation


def test_a_whole_run_is_that_of_the_law_it_repeats(repeated):
    fibres = ts.Fibres(k1=5e3, k2=0.5, direction=(1, 0, 1))
    mine = hanging(repeated(young=3e4, poisson=0.3, fibres=fibres))
    theirs = hanging(ts.NeoHooke(young=3e4, poisson=0.3, fibres=fibres))
    moved = np.abs(theirs.displacements("bar")).max()
    assert moved > 0.01
    # Round-off of thirty steps, each with a factor of a matrix of condition about 1e5.
    assert np.abs(mine.positions["bar"] - theirs.positions["bar"]).max() < 1e-10 * moved
    assert mine.energy()["elastic"] == pytest.approx(theirs.energy()["elastic"], rel=1e-9)


@pytest.mark.parametrize("threads", [1, 2])
def test_regions_may_have_different_laws_of_ones_own(repeated, gent, threads):
    mesh = ts.bar_mesh(size=(2, 1, 1), cells=(4, 2, 2), cell="hexahedron")
    middle = mesh.points[mesh.volume_blocks[0].nodes].mean(axis=1)[:, 0]
    left, right = np.flatnonzero(middle < 1.0), np.flatnonzero(middle > 1.0)
    mesh = ts.Mesh(
        points=mesh.points,
        cells=mesh.cells,
        regions={"left": left.astype(np.int32), "right": right.astype(np.int32)},
    )

    def energy(laws):
        body = ts.Body(mesh=mesh, law=laws, density=1e3)
        step = ts.ImplicitEuler(1e-6)
        simulation = ts.Scene(bodies={"cube": body}, step=step, threads=threads).compile()
        deform(simulation, size=0.01)
        return simulation.energy()["elastic"]

    soft, stiff = repeated(young=1e4, poisson=0.3), repeated(young=5e4, poisson=0.4)
    theirs = ts.NeoHooke(young=1e4, poisson=0.3), ts.NeoHooke(young=5e4, poisson=0.4)
    wanted = energy({"left": theirs[0], "right": theirs[1]})
    assert energy({"left": soft, "right": stiff}) == pytest.approx(wanted, rel=1e-13)
    assert energy({"left": soft, "right": theirs[1]}) == pytest.approx(wanted, rel=1e-13)
    locking = gent(mu=1e4, jm=4.0, kappa=1e5)
    assert energy({"left": soft, "right": locking}) != pytest.approx(wanted, rel=1e-3)


def test_check_says_the_units_that_the_formula_declares(gent):
    words = "gent with mu 10000 Pa, jm 30, kappa 100000 Pa"
    assert gent(mu="10 kPa", jm=30, kappa=1e5).words() == words


def test_cells_are_removed_from_a_body_of_ones_own_law(gent):
    body = ts.Body(
        mesh=ts.bar_mesh(size=(3, 1, 1), cells=(3, 1, 1), cell="hexahedron"),
        law=gent(mu=1e4, jm=4.0, kappa=1e5),
        density=1e3,
    )
    scene = ts.Scene(bodies={"bar": body}, step=ts.ImplicitEuler(1e-3), editing=True)
    simulation = scene.compile()
    simulation.remove_cells(body="bar", cells=[2])
    assert simulation.step().converged
    assert simulation.energy()["elastic"] == pytest.approx(0.0, abs=1e-9)


def stretched(cell, law, stretch):
    """A cube between sliding planes, pulled: the answer is one homogeneous stretch."""

    def plane(axis, at):
        low, high = [None] * 3, [None] * 3
        low[axis], high[axis] = at - 1e-9, at + 1e-9
        return ts.Box(tuple(low), tuple(high))

    mesh = ts.bar_mesh(size=(1, 1, 1), cells=(2, 2, 2), cell=cell)
    pull = ts.Prescribed(
        "cube",
        on=plane(0, 1.0),
        axes="x",
        times=[0, 1],
        displacements=[(0, 0, 0), (stretch - 1.0, 0, 0)],
    )
    scene = ts.Scene(
        bodies={"cube": ts.Body(mesh=mesh, law=law, density=1e3)},
        fixed=[ts.Fixed("cube", on=plane(i, 0.0), axes="xyz"[i]) for i in range(3)],
        prescribed=[pull],
        step=ts.Static(
            newton=ts.Newton(iterations=40, tolerance=1e-12), load_steps=4, solver=ts.Cholesky()
        ),
    )
    simulation = scene.compile()
    assert simulation.step().converged
    moved = simulation.positions["cube"]
    side = moved[mesh.points[:, 1] > 1 - 1e-9, 1]
    assert np.ptp(side) < 1e-9
    return float(side.mean()), simulation


@pytest.mark.parametrize("cell", ["tetra10", "hexahedron", "wedge15", "pyramid13"])
def test_blatz_ko_thins_as_its_closed_form_says(cell):
    law = ts.law("blatz_ko", energy=mu / 2 * (II_C / J**2 + 2 * J - 5), parameters={"mu": "Pa"})
    for stretch in (0.8, 1.5):
        side, simulation = stretched(cell, law(mu=1e4), stretch)
        # W = mu/2 (1/l1^2 + 2/l2^2 + 2 l1 l2^2 - 5), dW/dl2 = 0: l2 = l1^(-1/4), and
        # P1 = mu (l1^(-1/2) - l1^-3), sigma1 = P1 / l2^2. Newton's tolerance bounds the error.
        assert side == pytest.approx(stretch**-0.25, abs=1e-9)
        P1 = 1e4 * (stretch**-0.5 - stretch**-3)
        found = simulation.cell_fields("cube")["von_mises"]
        assert found == pytest.approx(abs(P1) / side**2, rel=1e-7)


def test_gent_locks_as_its_formula_says(gent):
    M, limit, K, stretch = 1e4, 3.0, 4e4, 1.8
    side, simulation = stretched("hexahedron", gent(mu=M, jm=limit, kappa=K), stretch)
    volume = stretch * side**2
    I1 = volume ** (-2 / 3) * (stretch**2 + 2 * side**2)
    # No traction on the sides: dW/dl2 = 0 with d(J)/dl2 = 2 l1 l2.
    dJ = 2 * stretch * side
    dI1 = -2 / 3 * I1 / volume * dJ + volume ** (-2 / 3) * 4 * side
    slope = M / 2 * limit / (limit - (I1 - 3)) * dI1 + K * (volume - 1) * dJ
    assert abs(slope) < 1e-7 * M  # Newton's tolerance
    W = -M * limit / 2 * np.log(1 - (I1 - 3) / limit) + K / 2 * (volume - 1) ** 2
    assert simulation.energy()["elastic"] == pytest.approx(W, rel=1e-9)


x, y, z, b = sympy.symbols("x y z b")
length = sympy.sqrt(x**2 + y**2 + z**2)
VOLUME = kappa / 2 * (J - 1) ** 2
SOFT, BULK = {"mu": 1e4}, {"kappa": 3e4}
# Energy, values, constants: each way that the generator has of differentiating.
DERIVED = {
    "general_power": (mu / 2 * (I_C - 3 + (J ** (-2 * beta) - 1) / beta), SOFT | {"beta": 0.7}, {}),
    "traces": (kappa / 2 * tr(E) ** 2 + mu * tr(E * E), SOFT | BULK, {}),
    "exponential": (
        mu / (2 * b) * (exp(b * (Ibar1 - 3)) - 1) + VOLUME,
        SOFT | BULK | {"b": 2.0},
        {},
    ),
    "components": (mu / 2 * (I_C - 3 - 2 * ln(J) + C[0, 1] ** 2) + VOLUME, SOFT | BULK, {}),
    "fibre": (
        mu / 2 * (I_C - 3 - 2 * ln(J)) + kappa / 2 * positive(I4 - 1) ** 2,
        SOFT | BULK | {"x": 1.0, "y": 2.0, "z": -1.0},
        {"a0": x / length, "a1": y / length, "a2": z / length},
    ),
}


@pytest.mark.parametrize("name", DERIVED)
def test_force_and_tangent_are_derivatives_of_the_energy(name):
    energy, values, constants = DERIVED[name]
    parameters = {n: "Pa" if n in ("mu", "kappa") else "1" for n in values}
    law = ts.law(f"own_{name}", energy=energy, parameters=parameters, constants=constants)
    short, long = (cube("hexahedron", law(**values), dt=dt) for dt in (1e-7, 0.02))
    deform(short)
    start = short.positions["cube"].copy()
    nodal_mass = 1e3 / 8  # a cube: its eight nodes weigh the same

    def force(positions):
        short.positions["cube"][:] = positions
        short.velocities["cube"][:] = 0.0
        short.step()
        return short.velocities["cube"].copy() * nodal_mass / 1e-7

    def stored(positions):
        short.positions["cube"][:] = positions
        return short.energy()["elastic"]

    direction = np.random.default_rng(1).uniform(-1, 1, start.shape)
    h = 1e-4
    slope = (stored(start + h * direction) - stored(start - h * direction)) / (2 * h)
    f = force(start)
    # Central differences: h^2 of a curvature of order one, and 1e-16 / h of round-off.
    assert -np.sum(f * direction) == pytest.approx(slope, rel=1e-6)
    # One linear step of implicit Euler: M v / h - h K v = f, K v by differences of the force.
    long.positions["cube"][:] = start
    long.step()
    v = long.velocities["cube"].copy()
    scale = h / np.abs(v).max()
    Kv = (force(start + scale * v) - force(start - scale * v)) / (2 * scale)
    residual = nodal_mass * v / 0.02 - 0.02 * Kv - f
    # But for the turn that takes the moment which a linear step leaves: w x r, of equal masses.
    end = start + 0.02 * v
    r = end - end.mean(0)
    turns = np.stack([np.cross(axis, r).ravel() for axis in np.eye(3)], axis=1)
    residual -= (turns @ np.linalg.lstsq(turns, residual.ravel(), rcond=None)[0]).reshape(-1, 3)
    assert np.abs(0.02 * Kv).max() > 0.05 * np.abs(f).max()  # the tangent is seen
    assert np.abs(residual).max() < 1e-6 * np.abs(f).max()


def test_numbers_and_symbols_are_read_as_python_writes_them():
    # Floats for fractions, symbols with other assumptions, Max for the positive part.
    M, K = sympy.symbols("mu kappa", positive=True)
    written = 0.5 * M * (J ** (-2 / 3) * I_C - 3) + 0.5 * K * sympy.Max(J - 1, 0) ** 2 + VOLUME
    exact = mu / 2 * (J ** sympy.Rational(-2, 3) * I_C - 3) + kappa / 2 * positive(J - 1) ** 2
    parameters = {"mu": "Pa", "kappa": "Pa"}
    first = ts.law("numbers", energy=written, parameters=parameters)
    assert first.made == ts.law("numbers", energy=exact + VOLUME, parameters=parameters).made
