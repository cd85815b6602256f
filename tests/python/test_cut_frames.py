"""Bodies whose nodes are frames are cut by copies; rotations and spins go with the copies."""

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
SLANTED = ts.Plane(point=(0.213, 0.05, 0.0), normal=(1.0, 0.31, -0.27))
HELD = ts.Plane(point=(0, 0, 0), normal=(1, 0, 0))
TIGHT = ts.ConjugateGradient(tolerance=1e-12)
EXACT = ts.ImplicitEuler(dt=0.005, solver=TIGHT)
MEASURES: dict[int, dict[str, Any]] = {
    3: {},
    2: {"thickness": "4 mm"},
    1: {"section": ts.Rectangle(width="6 mm", height="3 mm", up=(0, 0, 1))},
}
AREAS = {3: 0.1 * 0.05, 2: 0.1 * 4e-3, 1: 6e-3 * 3e-3}
"""Of the section across x [m2]."""
CELLS = ("tetra", "hexahedron", "tetra10", "triangle", "quad", "quad9", "line", "line3")


def dimension(cell: str) -> int:
    return 1 if cell.startswith("line") else 2 if cell.startswith(("tri", "quad")) else 3


def frames(cell: str, cells: int = 8, length: float = 0.4, **body: Any) -> ts.Body:
    many, size = (cells, 2, 1), (length, 0.1, 0.05)
    m = dimension(cell)
    mesh = ts.bar_mesh(
        size=(*size[:m], *(3 - m) * (0.0,)), cells=(*many[:m], *(3 - m) * (0,)), cell=cell
    )
    law = ts.StVK(young=5e5, poisson=0.3)
    return ts.Body(
        **{"mesh": mesh, "law": law, "density": 1000.0, "model": "frames"} | MEASURES[m] | body
    )


def scene(body: ts.Body, **changes: Any) -> ts.Scene:
    return ts.Scene(
        **{
            "bodies": {"frames": body},
            "fixed": [ts.Fixed("frames", on=HELD, rotations="held")],
            "gravity": (0.0, 0.0, -9.81),
            "step": ts.ImplicitEuler(dt=0.005),
            "editing": ts.Editing(room="2000 %"),
        }
        | changes
    )


def mass_of(cell: str) -> float:
    return 1000.0 * 0.4 * AREAS[dimension(cell)]


def spun(simulation: ts.Simulation, seed: int = 1) -> ts.Simulation:
    """Bent and moving, with rotations of a step behind it and a spin of its own at each node."""
    shaken(simulation, seed)
    simulation.velocities["frames"][:] *= 0.2
    simulation.step()
    first, count = simulation._core.first_rotation("frames"), len(simulation.positions["frames"])
    spins = np.random.default_rng(seed).standard_normal((count, 3))
    simulation._core.velocities[first : first + count] = spins
    assert np.abs(simulation.rotations("frames") - np.eye(3)).max() > 1e-4
    return simulation


def nodes_of(simulation: ts.Simulation, piece: ts.Piece) -> np.ndarray[Any, Any]:
    (block,) = simulation.meshes["frames"].body_blocks
    return np.unique(block.nodes[np.isin(simulation.remaining_cells("frames"), piece.cells)])


def require_kept(report: ts.CutReport, before: Any, after: Any, mass: float) -> None:
    assert abs(report.mass_change) <= ROUND_OFF * mass
    assert np.abs(report.momentum_change).max() <= ROUND_OFF * mass * 3.0
    assert np.abs(report.angular_momentum_change).max() <= ROUND_OFF * mass
    for kind in ("kinetic", "elastic", "potential"):
        assert after[kind] == pytest.approx(before[kind], rel=ROUND_OFF)


@pytest.mark.parametrize("cell", CELLS)
@pytest.mark.parametrize("law", [ts.StVK, ts.Hooke])
def test_a_cut_keeps_mass_momenta_and_energies_spin_included(cell: str, law: Any) -> None:
    body = frames(cell, law=law(young=5e5, poisson=0.3))
    simulation = spun(scene(body, fixed=[]).compile())
    before = simulation.energy()
    report = simulation.cut("frames", SLANTED)
    assert len(report.pieces) == 2
    require_kept(report, before, simulation.energy(), mass_of(cell))
    total = sum(piece.mass for piece in report.pieces)
    assert total == pytest.approx(mass_of(cell), rel=1e-11)


@pytest.mark.parametrize(
    ("cell", "changes"),
    [
        ("tetra", {"model": ts.Frames(lever="half")}),
        ("hexahedron", {"model": ts.Frames(lever="half")}),
        ("quad", {"model": ts.Frames(section="middle")}),
        ("line", {"model": ts.Frames(section="middle"), "section": "20 mm^2"}),
    ],
)
def test_a_cut_keeps_everything_whatever_the_levers_and_points(
    cell: str, changes: dict[str, Any]
) -> None:
    simulation = spun(scene(frames(cell, **changes), fixed=[]).compile())
    before = simulation.energy()
    report = simulation.cut("frames", SLANTED)
    assert len(report.pieces) == 2
    require_kept(report, before, simulation.energy(), mass_of(cell))


@pytest.mark.parametrize("cell", ["tetra", "hexahedron", "quad", "line"])
@pytest.mark.parametrize("seed", range(3))
def test_random_cuts_keep_everything(cell: str, seed: int) -> None:
    """Eight blades one after the other."""
    random = np.random.default_rng(seed)
    simulation = spun(scene(frames(cell), fixed=[]).compile(), seed)
    for _ in range(8):
        center = random.uniform((0, 0, 0), (0.4, 0.1, 0.05)) * (1, *(dimension(cell) > 1,), 1)
        normal = random.standard_normal(3)
        blade: Any = ts.Plane(tuple(center), tuple(normal))
        if random.random() < 0.6:
            blade = ts.Disc(center, normal, random.uniform(0.02, 0.1))
        before = simulation.energy()
        report = simulation.cut("frames", blade)
        require_kept(report, before, simulation.energy(), mass_of(cell))
    turned, born = simulation.rotations("frames"), simulation.born("frames")
    for node in range(len(simulation._rest["frames"].points), len(born)):
        np.testing.assert_array_equal(turned[node], turned[born[node]])
    simulation.step()
    assert np.isfinite(simulation.positions["frames"]).all()


@pytest.mark.parametrize("cell", ["tetra", "hexahedron", "triangle", "quad", "line"])
def test_a_cut_on_faces_leaves_two_that_go_on_as_if_built_apart(cell: str) -> None:
    """The held part, whose rotations are held too, is compared with one that was built alone."""
    whole = scene(frames(cell), step=EXACT.replace(newton=SOLVED)).compile()
    report = whole.cut("frames", ts.Plane(point=(0.2, 0, 0), normal=(1, 0, 0)))
    apart = scene(frames(cell, 4, 0.2), step=EXACT.replace(newton=SOLVED)).compile()
    for _ in range(30):
        whole.step()
        apart.step()
    (held,) = [piece for piece in report.pieces if piece.held]
    mine, rest = nodes_of(whole, held), whole.meshes["frames"].points
    mine = mine[np.lexsort(rest[mine].T.round(9))]
    other = np.lexsort(apart.meshes["frames"].points.T.round(9))
    assert len(mine) == len(other)
    np.testing.assert_allclose(
        whole.positions["frames"][mine], apart.positions["frames"][other], rtol=0, atol=1e-9
    )
    np.testing.assert_allclose(
        whole.rotations("frames")[mine], apart.rotations("frames")[other], rtol=0, atol=1e-7
    )


@pytest.mark.parametrize("cell", ["tetra", "hexahedron", "quad", "line"])
def test_a_piece_that_nothing_holds_falls_without_turning(cell: str) -> None:
    """Backward Euler from rest: after n steps it has fallen by g h^2 n (n + 1) / 2."""
    simulation = scene(frames(cell), step=EXACT).compile()
    report = simulation.cut("frames", SLANTED)
    (free,) = [piece for piece in report.pieces if not piece.held]
    for _ in range(10):
        simulation.step()
    mine = nodes_of(simulation, free)
    expected = [0.0, 0.0, -9.81 * 0.005**2 * 10 * 11 / 2]
    fallen = simulation.displacements("frames")[mine]
    np.testing.assert_allclose(fallen, np.broadcast_to(expected, fallen.shape), rtol=0, atol=1e-8)
    turned = simulation.rotations("frames")[mine]
    np.testing.assert_allclose(turned, np.broadcast_to(np.eye(3), turned.shape), rtol=0, atol=1e-6)


def test_kinetic_energy_and_angular_momentum_of_a_piece_are_those_of_a_rigid_turn() -> None:
    """A free piece turned as one with w: T = 1/2 w . L about its centre of mass."""
    simulation = scene(frames("hexahedron"), fixed=[], gravity=(0, 0, 0)).compile()
    simulation.cut("frames", SLANTED)
    spin = np.array([0.3, -0.2, 2.0])
    places = np.array(simulation.positions["frames"])
    simulation.velocities["frames"][:] = np.cross(spin, places)
    first, count = simulation._core.first_rotation("frames"), len(places)
    simulation._core.velocities[first : first + count] = spin
    totals = simulation._core.totals("frames")
    assert totals["kinetic"] == pytest.approx(0.5 * spin @ totals["angular_momentum"], rel=1e-10)


@pytest.mark.parametrize("cell", ["hexahedron", "quad"])
def test_bits_are_the_same_on_two_threads_after_a_rewind_and_from_a_checkpoint(
    cell: str, tmp_path: Path
) -> None:
    """All in the middle of an incision that a knife makes."""
    runs = [led(cell, threads) for threads in (1, 2)]
    for simulation in runs:
        for _ in simulation.run(0.07):
            pass
    assert runs[0].is_cut("frames")
    require_same_ends(runs, "frames", seconds(0.03), tmp_path)


def led(cell: str, threads: int) -> ts.Simulation:
    """A knife from outside along a body that nothing holds; both drift together."""
    knife = ts.Knife(
        edge=[(0, 0, -0.02), (0, 0, 0.07)],
        cuts=["frames"],
        path=ts.ToolPath(times=(0.0, 0.1), positions=[(0.21, -0.013, 0.0), (0.24, 0.093, 0.0)]),
    )
    simulation = scene(
        frames(cell),
        fixed=[],
        gravity=(0, 0, 0),
        step=ts.ImplicitEuler(dt=0.005, solver=TIGHT),
        threads=threads,
        instruments={"blade": knife},
    ).compile()
    simulation.velocities["frames"][:] = (0.3, 0, 0)
    return simulation


def test_cells_go() -> None:
    simulation = scene(frames("hexahedron")).compile()
    report = simulation.ablate("frames", ts.Box(min=(0.2, -1, -1), max=(0.25, 1, 1)))
    assert report.cells_gone == 2
    assert report.mass_change == pytest.approx(-mass_of("hexahedron") / 8, rel=1e-9)
    assert len(report.pieces) == 2
    numbers = simulation.remaining_cells("frames")
    simulation.remove_cells(body="frames", cells=numbers[-1:])
    assert len(simulation.remaining_cells("frames")) == len(numbers) - 1
    assert simulation.step().converged


def test_a_piece_falls_on_a_table_and_weighs_what_it_weighs() -> None:
    body = frames("hexahedron", viscosity=ts.Rayleigh(mass=5, stiffness="5 ms"))
    simulation = scene(
        body,
        fixed=[ts.Fixed("frames", on=ts.Box(max=(0.22, None, None)), rotations="held")],
        obstacles={"table": ts.PlaneObstacle((0, 0, -0.01), (0, 0, 1))},
        contacts=[ts.Contact(("frames", "table"), friction=0.3)],
    ).compile()
    report = simulation.cut("frames", ts.Plane((0.237, 0, 0), (1, 0.02, 0)))
    (piece,) = [piece for piece in report.pieces if not piece.held]
    for _ in range(200):
        assert simulation.step().converged
    share = simulation.force_on("table").force[2] / (-9.81 * piece.mass)
    assert share == pytest.approx(1.0, rel=0.02)
