"""Shells are cut as sheets are; their nodes' rotations and spins go with the copies."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tissu as ts
from cut_states import SOLVED, shaken
from same_ends import require_same_ends, seconds

ROUND_OFF = 1e-12
"""Of sums over some thousand numbers: a few hundred times the spacing of doubles."""
MASS = 0.4 * 0.1 * 4e-3 * 1000.0
SLANTED = ts.Plane(point=(0.213, 0.05, 0.0), normal=(1.0, 0.31, -0.27))
HELD = ts.Plane(point=(0, 0, 0), normal=(1, 0, 0))
TIGHT = ts.ConjugateGradient(tolerance=1e-12)
EXACT = ts.ImplicitEuler(dt=0.005, solver=TIGHT)


def shell(cells: tuple[int, int, int] = (16, 4, 0), length: float = 0.4, **body: Any) -> ts.Body:
    return ts.Body(
        mesh=ts.bar_mesh(size=(length, 0.1, 0), cells=cells, cell="triangle"),
        **{
            "law": ts.Hooke(young=5e6, poisson=0.3),
            "density": 1000.0,
            "thickness": 4e-3,
            "model": "shell",
        }
        | body,
    )


def scene(body: ts.Body | None = None, **changes: Any) -> ts.Scene:
    return ts.Scene(
        **{
            "bodies": {"shell": shell() if body is None else body},
            "fixed": [ts.Fixed("shell", on=HELD)],
            "gravity": (0.0, 0.0, -9.81),
            "step": ts.ImplicitEuler(dt=0.005),
            "editing": ts.Editing(room="400 %"),
        }
        | changes
    )


def spun(simulation: ts.Simulation, seed: int = 1) -> ts.Simulation:
    """Bent and moving, with rotations of a step behind it and a spin of its own at each node."""
    shaken(simulation, seed)
    simulation.velocities["shell"][:] *= 0.2
    simulation.step()
    first, count = simulation._core.first_rotation("shell"), len(simulation.positions["shell"])
    spins = np.random.default_rng(seed).standard_normal((count, 3))
    simulation._core.velocities[first : first + count] = spins
    assert np.abs(simulation.rotations("shell") - np.eye(3)).max() > 1e-3
    return simulation


def nodes_of(simulation: ts.Simulation, piece: ts.Piece) -> np.ndarray[Any, Any]:
    (block,) = simulation.meshes["shell"].body_blocks
    return np.unique(block.nodes[np.isin(simulation.remaining_cells("shell"), piece.cells)])


def random_blade(random: np.random.Generator) -> Any:
    center = random.uniform((0, 0, -0.002), (0.4, 0.1, 0.002))
    normal = np.append(random.standard_normal(2), 0.3 * random.standard_normal())
    if random.random() < 0.3:  # along a row of edges of a shell at rest
        normal = np.eye(3)[random.integers(2)]
    if random.integers(3) == 0:
        return ts.Plane(tuple(center), tuple(normal))
    return ts.Disc(center, normal, random.uniform(0.01, 0.08))


@pytest.mark.parametrize("seed", range(6))
def test_random_cuts_keep_mass_momenta_and_energies_spin_included(seed: int) -> None:
    """Ten blades one after the other; the first goes through all."""
    random = np.random.default_rng(seed)
    made = scene(shell((12, 4, 0)), fixed=[], editing=ts.Editing(room="5000 %"))
    simulation = spun(made.compile(), seed)
    for number in range(10):
        before = simulation.energy()
        report = simulation.cut("shell", SLANTED if number == 0 else random_blade(random))
        assert number > 0 or (report.cells_cut > 0 and len(report.pieces) == 2)
        assert abs(report.mass_change) <= ROUND_OFF * MASS
        assert np.abs(report.momentum_change).max() <= ROUND_OFF * MASS * 3.0
        assert np.abs(report.angular_momentum_change).max() <= ROUND_OFF * MASS
        assert sum(piece.mass for piece in report.pieces) == pytest.approx(MASS, rel=1e-11)
        after = simulation.energy()
        for kind in ("kinetic", "elastic", "potential"):
            assert after[kind] == pytest.approx(before[kind], rel=ROUND_OFF)
    turned, born = simulation.rotations("shell"), simulation.born("shell")
    assert len(born) > 65
    for node in range(65, len(born)):
        np.testing.assert_array_equal(turned[node], turned[born[node]])
    simulation.step()
    assert np.isfinite(simulation.positions["shell"]).all()


def test_kinetic_energy_and_angular_momentum_of_spin_are_those_of_a_rigid_turn() -> None:
    """Free and turned as one with w about its centre: T = 1/2 w . L, L = sum m x x v + sum I w."""
    simulation = scene(fixed=[], gravity=(0, 0, 0)).compile()
    spin = np.array([0.3, -0.2, 2.0])
    places = simulation.positions["shell"] - (0.2, 0.05, 0.0)
    simulation.velocities["shell"][:] = np.cross(spin, places)
    first, count = simulation._core.first_rotation("shell"), len(places)
    simulation._core.velocities[first : first + count] = spin
    totals = simulation._core.totals("shell")
    momentum = totals["angular_momentum"] - MASS * np.cross((0.2, 0.05, 0.0), np.zeros(3))
    kinetic = simulation.energy()["kinetic"]
    assert totals["kinetic"] == pytest.approx(kinetic, rel=ROUND_OFF)
    assert 0.5 * spin @ momentum == pytest.approx(kinetic, rel=1e-10)


def test_a_cut_on_edges_leaves_two_shells() -> None:
    """The held one, whose rotations are held too, bends as a shell that was built alone."""
    held = [ts.Fixed("shell", on=HELD, rotations="held")]
    whole = scene(step=EXACT.replace(newton=SOLVED), fixed=held).compile()
    report = whole.cut("shell", ts.Plane(point=(0.2, 0, 0), normal=(1, 0, 0)))
    assert report.faces_opened == 4
    apart = scene(shell((8, 4, 0), 0.2), step=EXACT.replace(newton=SOLVED), fixed=held).compile()
    for _ in range(30):
        whole.step()
        apart.step()
    (piece,) = [piece for piece in report.pieces if piece.held]
    mine, rest = nodes_of(whole, piece), whole.meshes["shell"].points
    mine = mine[np.lexsort(rest[mine].T.round(9))]
    other = np.lexsort(apart.meshes["shell"].points.T.round(9))
    assert len(mine) == len(other) == 45
    assert np.abs(apart.displacements("shell")).max() > 1e-3
    for now, then in (
        (whole.positions["shell"][mine], apart.positions["shell"][other]),
        (whole.rotations("shell")[mine], apart.rotations("shell")[other]),
    ):
        np.testing.assert_allclose(now, then, rtol=0, atol=1e-9)


def test_a_piece_that_nothing_holds_falls_freely() -> None:
    """Backward Euler from rest: after n steps it has fallen by g h^2 n (n + 1) / 2."""
    simulation = scene(step=EXACT).compile()
    report = simulation.cut("shell", SLANTED)
    (free,) = [piece for piece in report.pieces if not piece.held]
    for _ in range(20):
        simulation.step()
    fallen = simulation.displacements("shell")[nodes_of(simulation, free)]
    expected = [0.0, 0.0, -9.81 * 0.005**2 * 20 * 21 / 2]
    np.testing.assert_allclose(fallen, np.broadcast_to(expected, fallen.shape), rtol=0, atol=1e-8)


@pytest.mark.parametrize("method", [ts.BDF2, ts.Newmark, ts.ImplicitEuler])
def test_parts_of_a_shell_that_turns_turn_on(method: Any) -> None:
    """1 rad/s about the normal: what the method remembers of a node goes to its copies.

    Each part turns on about its own centre. Centrifugal forces strain the shell by
    rho w^2 L^2 / E = 3e-5, which the cut changes.
    """
    turned, newton = [], ts.Newton(iterations=20, tolerance=1e-10)
    for cut in (False, True):
        made = scene(fixed=[], gravity=(0, 0, 0), step=method(dt=0.01, solver=TIGHT, newton=newton))
        simulation = made.compile()
        places = simulation.positions["shell"] - (0.2, 0.05, 0.0)
        simulation.velocities["shell"][:] = np.cross((0, 0, 1.0), places)
        first, count = simulation._core.first_rotation("shell"), len(places)
        simulation._core.velocities[first : first + count] = (0, 0, 1.0)
        for step in range(40):
            if cut and step == 20:
                assert len(simulation.cut("shell", SLANTED).pieces) == 2
            simulation.step()
        turned.append(simulation)
    whole, parts = turned
    born = parts.born("shell")
    assert len(born) > 85
    assert np.abs(whole.rotations("shell")[:, 1, 0]).min() > 0.3  # 0.4 rad
    now, then = parts.rotations("shell"), whole.rotations("shell")[born]
    np.testing.assert_allclose(now, then, rtol=0, atol=2e-4)


def led(threads: int = 1) -> ts.Simulation:
    """A knife from outside along a shell that nothing holds, under BDF2."""
    knife = ts.Knife(
        edge=[(0, 0, -0.02), (0, 0, 0.02)],
        cuts=["shell"],
        path=ts.ToolPath(times=(0, 0.1), positions=[(0.1, -0.013, 0.0), (0.13, 0.063, 0.0)]),
    )
    simulation = scene(
        fixed=[],
        gravity=(0, 0, 0),
        step=ts.BDF2(dt=0.005, solver=TIGHT),
        threads=threads,
        instruments={"blade": knife},
    ).compile()
    simulation.velocities["shell"][:] = (0.3, 0, 0)
    simulation.velocities["shell"][:, 2] = 0.5 * simulation.positions["shell"][:, 0]
    return simulation


def test_bits_are_the_same_on_two_threads_after_a_rewind_and_from_a_checkpoint(
    tmp_path: Path,
) -> None:
    """All in the middle of an incision."""
    runs = [led(threads) for threads in (1, 2)]
    for simulation in runs:
        for _ in simulation.run(0.06):
            pass
    require_same_ends(runs, "shell", seconds(0.04), tmp_path)
    assert len(runs[0].positions["shell"]) > 85


def test_cells_go_and_their_nodes_stay_where_they_are() -> None:
    simulation = spun(scene().compile())
    report = simulation.ablate("shell", ts.Box(min=(0.2, -1, -1), max=(0.24, 1, 1)))
    assert report.cells_gone > 0
    assert report.mass_change == pytest.approx(
        sum(piece.mass for piece in report.pieces) - MASS, rel=1e-9
    )
    numbers = simulation.remaining_cells("shell")
    simulation.remove_cells(body="shell", cells=numbers[-9:])
    assert len(simulation.remaining_cells("shell")) == len(numbers) - 9
    used = np.unique(np.concatenate([b.nodes for b in simulation.meshes["shell"].body_blocks]))
    loose = np.setdiff1d(np.arange(len(simulation.positions["shell"])), used)
    assert len(loose) > 0
    before = simulation.positions["shell"][loose].copy(), simulation.rotations("shell")[loose]
    for _ in range(3):
        assert simulation.step().converged
    np.testing.assert_array_equal(simulation.positions["shell"][loose], before[0])
    np.testing.assert_array_equal(simulation.rotations("shell")[loose], before[1])


def test_a_moment_goes_to_the_material_that_it_loads() -> None:
    """On the nodes along a cut: each half has half of it; beside a cut, all is on one side."""
    for at, shares in ((0.2, (0.5, 0.5)), (0.2125, (1.0, 0.0))):
        load = ts.Moment("shell", on=ts.Plane((0.2, 0, 0), (1, 0, 0)), moment=(0, 0.01, 0))
        simulation = scene(loads=[load], fixed=[], gravity=(0, 0, 0)).compile()
        report = simulation.cut("shell", ts.Plane((at, 0, 0), (1, 0, 0)))
        moments = simulation.forces()[simulation.rows("shell", rotations=True)]
        pieces = sorted(report.pieces, key=lambda piece: piece.first_cell)
        for piece, share in zip(pieces, shares, strict=True):
            found = moments[nodes_of(simulation, piece)].sum(axis=0)
            np.testing.assert_allclose(found, (0, 0.01 * share, 0), rtol=0, atol=1e-14)


def test_a_piece_falls_on_a_table_and_weighs_what_it_weighs() -> None:
    body = shell(viscosity=ts.Rayleigh(mass=5, stiffness="5 ms"))
    simulation = scene(
        body,
        fixed=[ts.Fixed("shell", on=ts.Box(max=(0.18, None, None)))],
        obstacles={"table": ts.PlaneObstacle((0, 0, -0.03), (0, 0, 1))},
        contacts=[ts.Contact(("shell", "table"), friction=0.3)],
    ).compile()
    report = simulation.cut("shell", ts.Plane((0.187, 0, 0), (1, 0.02, 0)))
    (piece,) = [piece for piece in report.pieces if not piece.held]
    for _ in range(150):
        assert simulation.step().converged
    share = simulation.force_on("table").force[2] / (-9.81 * piece.mass)
    assert share == pytest.approx(1.0, rel=0.02)


def test_a_volume_beside_a_shell_is_cut_in_place_with_the_bits_of_one_laid_anew(
    tmp_path: Path,
) -> None:
    mesh = ts.bar_mesh(size=(0.2, 0.05, 0.05), cells=(8, 2, 2), cell="tetra")
    block = ts.Body(mesh=mesh, law=ts.StVK(young=1e5, poisson=0.3), density=1000.0)
    bodies = {"block": block, "shell": shell((8, 3, 0), 0.2)}
    held = [ts.Fixed(name, on=HELD) for name in bodies]
    made = scene(bodies=bodies, fixed=held)
    simulation = made.compile()
    simulation.step()
    assert not simulation.cut("block", ts.Plane((0.11, 0, 0), (1, 0.2, 0))).relaid
    assert simulation.cut("shell", ts.Plane((0.11, 0, 0), (1, 0.2, 0))).relaid
    assert not simulation.cut("block", ts.Plane((0.05, 0, 0), (1, 0.2, 0))).relaid
    simulation.mark()  # a mark lets the solver forget
    simulation.save_checkpoint(tmp_path / "cut.h5")
    loaded = ts.Scene.compile(made, checkpoint=tmp_path / "cut.h5")
    for one in (simulation, loaded):
        for _ in range(4):
            one.step()
    for name in bodies:
        np.testing.assert_array_equal(simulation.positions[name], loaded.positions[name])
    np.testing.assert_array_equal(simulation.rotations("shell"), loaded.rotations("shell"))


def test_a_grab_of_a_parted_node_is_let_go() -> None:
    simulation = scene(grabbing=True).compile()
    there = simulation.drag("shell", (0.2, 0.05, 0.0))
    report = simulation.cut("shell", ts.Plane((0.2, 0, 0), (1, 0, 0)))
    assert len(report.released) == 1
    with pytest.raises(ts.ParameterError, match="was let go"):
        there.force  # noqa: B018
