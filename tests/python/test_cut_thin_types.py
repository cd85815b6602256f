"""Quads, and sheets and lines of second order, are cut as triangles and lines of two nodes are."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tissu as ts
from cut_states import SOLVED, shaken
from same_ends import require_same_ends, seconds
from tissu.output.series import write_material
from tissu.picture.draw import shape_of

ROUND_OFF = 1e-12
"""Of sums over some thousand numbers: a few hundred times the spacing of doubles."""
SHEETS = ("quad", "triangle6", "quad8", "quad9")
THIN = (*SHEETS, "line3")
SECTION = 2e-6
THICKNESS = 1e-3
SLANTED = ts.Plane(point=(0.213, 0.05, 0.0), normal=(1.0, 0.31, -0.27))
HELD = ts.Plane(point=(0, 0, 0), normal=(1, 0, 0))
EXACT = ts.ImplicitEuler(dt=0.005, solver=ts.ConjugateGradient(tolerance=1e-12))


def thin(cell: str, cells: int = 16, length: float = 0.4, **body: Any) -> ts.Body:
    """A sheet of 0.4 x 0.1 m, or a line of 0.4 m."""
    if cell.startswith("line"):
        mesh = ts.bar_mesh(size=(length, 0, 0), cells=(cells, 0, 0), cell=cell)
        measure: dict[str, Any] = {"section": SECTION}
    else:
        mesh = ts.bar_mesh(size=(length, 0.1, 0), cells=(cells, 4, 0), cell=cell)
        measure = {"thickness": THICKNESS}
    law = ts.StVK(young=5e5, poisson=0.3)
    return ts.Body(**{"mesh": mesh, "law": law, "density": 1000.0, **measure} | body)


def scene(body: ts.Body, **changes: Any) -> ts.Scene:
    return ts.Scene(
        **{
            "bodies": {"thin": body},
            "fixed": [ts.Fixed("thin", on=HELD)],
            "gravity": (0.0, 0.0, -9.81),
            "step": ts.ImplicitEuler(dt=0.005),
            "editing": ts.Editing(room="600 %"),
        }
        | changes
    )


def mass_of(cell: str) -> float:
    return 1000.0 * 0.4 * (SECTION if cell.startswith("line") else 0.1 * THICKNESS)


def nodes_of(simulation: ts.Simulation, piece: ts.Piece) -> np.ndarray[Any, Any]:
    """Nodes of the cells that hold a piece."""
    (block,) = simulation.meshes["thin"].body_blocks
    return np.unique(block.nodes[np.isin(simulation.remaining_cells("thin"), piece.cells)])


def require_kept(
    report: ts.CutReport, before: dict[str, float], after: dict[str, float], mass: float
) -> None:
    assert abs(report.mass_change) <= ROUND_OFF * mass
    assert np.abs(report.momentum_change).max() <= ROUND_OFF * mass * 4.0
    assert np.abs(report.angular_momentum_change).max() <= ROUND_OFF * mass
    for kind in ("kinetic", "elastic", "potential"):
        assert after[kind] == pytest.approx(before[kind], rel=ROUND_OFF)


def require_whole(simulation: ts.Simulation, cell: str) -> None:
    """The straight parts of the material have the area, or length, of the first day."""
    material, sum_of = simulation.material("thin"), 0.0
    for block in material.mesh.body_blocks:
        at = material.mesh.points[block.nodes]
        if cell == "line3":
            sum_of += np.linalg.norm(at[:, 1] - at[:, 0], axis=1).sum()
            continue
        halves = [(0, 1, 2), (0, 2, 3)] if block.type.startswith("quad") else [(0, 1, 2)]
        for a, b, c in halves:
            sides = np.cross(at[:, b] - at[:, a], at[:, c] - at[:, a])
            sum_of += 0.5 * np.linalg.norm(sides, axis=1).sum()
    assert sum_of == pytest.approx(0.4 if cell == "line3" else 0.04, rel=1e-11)
    assert sum(p.mass for p in simulation.pieces("thin")) == pytest.approx(mass_of(cell), rel=1e-11)
    core = simulation._core.body_cells("thin")
    origins, shares = (np.concatenate([run[k] for run in core]) for k in (2, 3))
    np.testing.assert_allclose(
        np.bincount(origins, shares)[np.unique(origins)], 1.0, rtol=0, atol=1e-13
    )


@pytest.mark.parametrize("cell", THIN)
@pytest.mark.parametrize("law", [ts.StVK, ts.Hooke])
def test_a_cut_keeps_mass_momenta_and_energies(cell: str, law: Any) -> None:
    body = thin(cell, law=law(young=5e5, poisson=0.3))
    simulation = shaken(scene(body).compile())
    before = simulation.energy()
    report = simulation.cut("thin", SLANTED)
    assert report.cells_cut > 0
    assert len(report.pieces) == 2
    require_kept(report, before, simulation.energy(), mass_of(cell))


@pytest.mark.parametrize("cell", THIN)
def test_the_pieces_and_the_cut_are_those_of_the_blade(cell: str) -> None:
    simulation = scene(thin(cell)).compile()
    report = simulation.cut("thin", ts.Plane(point=(0.137, 0, 0), normal=(1, 0, 0)))
    large, small = report.pieces
    assert large.mass == pytest.approx(mass_of(cell) * 0.263 / 0.4, rel=ROUND_OFF)
    assert small.mass == pytest.approx(mass_of(cell) * 0.137 / 0.4, rel=ROUND_OFF)
    assert (small.held, large.held) == (True, False)
    area = SECTION if cell == "line3" else 0.1 * THICKNESS
    assert report.area == pytest.approx(area, rel=ROUND_OFF)
    require_whole(simulation, cell)


@pytest.mark.parametrize("cell", THIN)
def test_a_cut_on_edges_leaves_two_that_go_on_as_if_built_apart(cell: str) -> None:
    """The held part is compared with one that was built alone, to the solver's tolerance."""
    pull = {"gravity": (9.81, 0, 0)} if cell == "line3" else {}
    whole = scene(thin(cell), step=EXACT.replace(newton=SOLVED), **pull).compile()
    report = whole.cut("thin", ts.Plane(point=(0.2, 0, 0), normal=(1, 0, 0)))
    assert report.faces_opened == (1 if cell == "line3" else 4)
    apart = scene(thin(cell, 8, 0.2), step=EXACT.replace(newton=SOLVED), **pull).compile()
    for _ in range(40):
        whole.step()
        apart.step()
    (held,) = [piece for piece in report.pieces if piece.held]
    mine, rest = nodes_of(whole, held), whole.meshes["thin"].points
    mine = mine[np.lexsort(rest[mine].T.round(9))]
    other = np.lexsort(apart.meshes["thin"].points.T.round(9))
    assert len(mine) == len(other)
    np.testing.assert_allclose(
        whole.positions["thin"][mine], apart.positions["thin"][other], rtol=0, atol=1e-10
    )


@pytest.mark.parametrize("cell", THIN)
def test_a_piece_that_nothing_holds_falls_freely(cell: str) -> None:
    """Backward Euler from rest: after n steps it has fallen by g h^2 n (n + 1) / 2."""
    simulation = scene(thin(cell), step=EXACT).compile()
    report = simulation.cut("thin", SLANTED)
    (free,) = [piece for piece in report.pieces if not piece.held]
    for _ in range(10):
        simulation.step()
    fallen = simulation.displacements("thin")[nodes_of(simulation, free)]
    expected = [0.0, 0.0, -9.81 * 0.005**2 * 10 * 11 / 2]
    np.testing.assert_allclose(fallen, np.broadcast_to(expected, fallen.shape), rtol=0, atol=1e-9)


@pytest.mark.parametrize("cell", THIN)
@pytest.mark.parametrize("seed", range(4))
def test_random_cuts_keep_everything(cell: str, seed: int) -> None:
    """Ten blades one after the other, through nodes and along edges too."""
    random = np.random.default_rng(seed)
    made = scene(thin(cell, 12), fixed=[], editing=ts.Editing(room="5000 %"))
    simulation = shaken(made.compile(), seed)
    if seed % 2:
        simulation.positions["thin"][:] = simulation.meshes["thin"].points
    cut = 0
    for _ in range(10):
        before = simulation.energy()
        report = simulation.cut("thin", random_blade(random, simulation, cell))
        cut += report.cells_cut > 0
        require_kept(report, before, simulation.energy(), mass_of(cell))
        require_whole(simulation, cell)
    assert cut >= 1
    simulation.positions["thin"][:] = simulation.meshes["thin"].points
    simulation.velocities["thin"][:] = 0.0
    assert simulation.step().converged
    assert np.isfinite(simulation.positions["thin"]).all()


def random_blade(random: np.random.Generator, simulation: ts.Simulation, cell: str) -> Any:
    width = 0.0 if cell == "line3" else 0.1
    center = random.uniform((0, 0, -0.002), (0.4, width, 0.002))
    if random.random() < 0.3 and cell != "line3":  # through a node
        center = simulation.positions["thin"][random.integers(65)]
    normal = np.append(random.standard_normal(2), 0.3 * random.standard_normal())
    if random.random() < 0.3:  # along a row of edges where the sheet is at rest
        normal = np.eye(3)[random.integers(2)]
    if random.random() < 0.5:
        return ts.Disc(center, normal, random.uniform(0.02, 0.08))
    return ts.Plane(tuple(center), tuple(normal))


@pytest.mark.parametrize("cell", ["quad", "quad9", "triangle6"])
def test_bits_are_the_same_on_two_threads_after_a_rewind_and_from_a_checkpoint(
    cell: str, tmp_path: Path
) -> None:
    """All in the middle of an incision that a knife makes."""
    runs = [led(cell, threads) for threads in (1, 2)]
    for simulation in runs:
        for _ in simulation.run(0.06):
            pass
    assert simulation.is_cut("thin")
    require_same_ends(runs, "thin", seconds(0.04), tmp_path)
    assert len(runs[0].pieces("thin")) == 1


def led(cell: str, threads: int) -> ts.Simulation:
    """A knife from outside along a sheet that nothing holds; both drift together."""
    way = [(0.1, -0.013, 0.0), (0.13, 0.063, 0.0)]
    knife = ts.Knife(
        edge=[(0, 0, -0.02), (0, 0, 0.02)],
        cuts=["thin"],
        path=ts.ToolPath(times=(0.0, 0.1), positions=way),
    )
    simulation = scene(
        thin(cell),
        fixed=[],
        gravity=(0, 0, 0),
        step=ts.ImplicitEuler(dt=0.005, solver=ts.ConjugateGradient(tolerance=1e-12)),
        threads=threads,
        instruments={"blade": knife},
    ).compile()
    simulation.velocities["thin"][:] = (0.3, 0, 0)
    return simulation


def test_a_pressed_sheet_of_quads_keeps_the_resultant() -> None:
    """Both parts of a flat sheet have the pressure on their own area: F = p A e_z.

    A step of 0.1 ms moves the sheet by 1e-8 of its length, and turns its faces by as little.
    """
    pressure = ts.Pressure("thin", on=ts.Box(), pressure=40.0)
    short = EXACT.replace(dt=1e-4)
    simulation = scene(thin("quad"), fixed=[], gravity=(0, 0, 0), loads=[pressure], step=short)
    made = simulation.compile()
    report = made.cut("thin", ts.Plane((0.137, 0, 0), (1, 0.2, 0)))
    made.step()
    rows, _, masses = made._core.mass_matrix()
    mass = np.bincount(rows, masses[:, 0, 0])[: len(made.positions["thin"])]
    momentum = mass[:, None] * made.velocities["thin"]
    np.testing.assert_allclose(
        np.abs(momentum.sum(axis=0)), (0, 0, 40.0 * 0.04 * 1e-4), rtol=0, atol=1e-11
    )
    for piece in report.pieces:
        found = np.abs(momentum[nodes_of(made, piece)].sum(axis=0))[2]
        assert found == pytest.approx(40.0 * piece.volume / THICKNESS * 1e-4, rel=1e-6)


def test_a_piece_of_quads_falls_on_a_table_and_weighs_what_it_weighs() -> None:
    body = thin("quad", viscosity=ts.Rayleigh(mass=5, stiffness="5 ms"))
    simulation = scene(
        body,
        fixed=[ts.Fixed("thin", on=ts.Box(max=(0.18, None, None)))],
        obstacles={"table": ts.PlaneObstacle((0, 0, -0.03), (0, 0, 1))},
        contacts=[ts.Contact(("thin", "table"), friction=0.3)],
    ).compile()
    report = simulation.cut("thin", ts.Plane((0.187, 0, 0), (1, 0.02, 0)))
    (piece,) = [piece for piece in report.pieces if not piece.held]
    for _ in range(300):
        assert simulation.step().converged
    share = simulation.force_on("table").force[2] / (-9.81 * piece.mass)
    assert share == pytest.approx(1.0, rel=0.02)


def test_quads_away_from_a_cut_meet_others_as_before() -> None:
    """A cut elsewhere leaves the halves of whole quads, at their shorter diagonal, unchanged.

    That is not the diagonal at which the material of a quad is cut.
    """
    sheet = thin("quad")
    square = ts.bar_mesh(size=(0.4, 0.1, 0), cells=(16, 4, 0), cell="quad")
    sheared = np.array(square.points)
    sheared[:, 0] += 0.5 * sheared[:, 1]
    simulation = scene(
        sheet.replace(mesh=ts.Mesh(points=sheared, cells=square.cells, thin=(2,))),
        obstacles={"table": ts.PlaneObstacle((0, 0, -0.03), (0, 0, 1))},
        contacts=[ts.Contact(("thin", "table"))],
    ).compile()
    before = {tuple(sorted(t)) for t in simulation._core.contact_surface("thin")[0].tolist()}
    assert len(before) == 2 * 16 * 4
    simulation.cut("thin", ts.Plane((0.387, 0, 0), (1, -0.5, 0)))
    after = {tuple(sorted(t)) for t in simulation._core.contact_surface("thin")[0].tolist()}
    assert len(before & after) == 2 * 15 * 4


@pytest.mark.parametrize("cell", ["quad9", "line3"])
def test_what_is_seen_and_written_is_the_material(cell: str, tmp_path: Path) -> None:
    meshio = pytest.importorskip("meshio")
    simulation = scene(thin(cell)).compile()
    simulation.cut("thin", ts.Plane((0.113, 0, 0), (1, 0.01, 0)))
    write_material(tmp_path / "cut.vtu", simulation, "thin")
    read = meshio.read(tmp_path / "cut.vtu")
    assert set(np.concatenate(read.cell_data["piece"])) == {0, 1}
    for field in ("displacement", "von_mises"):
        shape = shape_of(simulation, field)
        assert len(shape.triangles) > 0
        assert np.isfinite(shape.values).all()


def test_a_strip_of_quads_tears_across_the_pull() -> None:
    """Drawn out slowly, it tears where its stress is Young's modulus times the strain."""
    mesh = ts.bar_mesh(size=(0.12, 0.04, 0), cells=(24, 8, 0), cell="quad")
    body = thin("quad").replace(
        mesh=mesh,
        law=ts.StVK(young="100 kPa", poisson=0.0),
        viscosity=ts.Rayleigh(mass=5, stiffness="5 ms"),
    )
    end, out = ts.Plane((0.12, 0, 0), (1, 0, 0)), ((0, 0, 0), (0.03, 0, 0))
    simulation = scene(
        body,
        gravity=(0, 0, 0),
        prescribed=[ts.Prescribed("thin", on=end, times=(0.2, 1.2), displacements=out)],
        tear=[ts.Tear("thin", strength="12 kPa", length="6 mm")],
        step=ts.ImplicitEuler("20 ms"),
    ).compile()
    for report in simulation.run(1.2):
        if report.cuts:
            break
    # sigma = E (l^2 - 1) / 2 * l / 1 for a strip that cannot thin: 12 kPa at l = 1.10 or so.
    assert report.cuts
    assert all(cut.by == "tear" for cut in report.cuts)


def test_second_order_in_contact_or_under_pressure_is_refused_in_a_sentence() -> None:
    touching = scene(
        thin("quad9"),
        obstacles={"table": ts.PlaneObstacle((0, 0, -0.03), (0, 0, 1))},
        contacts=[ts.Contact(("thin", "table"))],
    ).compile()
    with pytest.raises(ts.ParameterError, match="in contact with cells of type quad9"):
        touching.cut("thin", SLANTED)
    pressed = scene(thin("quad9"), loads=[ts.Pressure("thin", on=ts.Box(), pressure=40.0)])
    with pytest.raises(ts.ParameterError, match="acts on faces of type quad9"):
        pressed.compile().cut("thin", SLANTED)


def test_a_cell_that_goes_takes_its_mass() -> None:
    simulation = scene(thin("quad9")).compile()
    report = simulation.ablate("thin", ts.Box(min=(0.2, -1, -1), max=(0.22, 1, 1)))
    assert report.cells_gone == 4
    assert report.mass_change == pytest.approx(-mass_of("quad9") / 16, rel=1e-9)
    assert len(report.pieces) == 2
