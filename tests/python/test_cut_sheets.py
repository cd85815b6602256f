"""Sheets of triangles are cut as volumes are, and their parts go on as they would alone."""

from __future__ import annotations

import itertools
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tissu as ts
from cut_states import SOLVED, shaken
from same_ends import require_same_ends, seconds

ROUND_OFF = 1e-12
"""Of sums over some thousand numbers: a few hundred times the spacing of doubles."""
MASS = 0.4 * 0.1 * 1e-3 * 1000.0
SLANTED = ts.Plane(point=(0.213, 0.05, 0.0), normal=(1.0, 0.31, -0.27))
HELD = ts.Plane(point=(0, 0, 0), normal=(1, 0, 0))
EXACT = ts.ImplicitEuler(dt=0.005, solver=ts.ConjugateGradient(tolerance=1e-12))


def sheet(cells: tuple[int, int, int] = (16, 4, 0), length: float = 0.4, **body: Any) -> ts.Body:
    return ts.Body(
        mesh=ts.bar_mesh(size=(length, 0.1, 0), cells=cells, cell="triangle"),
        **{"law": ts.StVK(young=5e5, poisson=0.3), "density": 1000.0, "thickness": 1e-3} | body,
    )


def scene(body: ts.Body | None = None, **changes: Any) -> ts.Scene:
    return ts.Scene(
        **{
            "bodies": {"sheet": sheet() if body is None else body},
            "fixed": [ts.Fixed("sheet", on=HELD)],
            "gravity": (0.0, 0.0, -9.81),
            "step": ts.ImplicitEuler(dt=0.005),
            "editing": ts.Editing(room="400 %"),
        }
        | changes
    )


def nodes_of(simulation: ts.Simulation, piece: ts.Piece) -> np.ndarray[Any, Any]:
    """Nodes of the cells that hold a piece."""
    (block,) = simulation.meshes["sheet"].body_blocks
    return np.unique(block.nodes[np.isin(simulation.remaining_cells("sheet"), piece.cells)])


def require_sound(simulation: ts.Simulation, area: float) -> None:
    """The material is what it was, conforming, and in the pieces that its edges join."""
    material = simulation.material("sheet")
    (corners,) = [
        np.concatenate([block.nodes for block in material.mesh.body_blocks]),
    ]
    points = material.mesh.points[corners]
    areas = 0.5 * np.linalg.norm(
        np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]), axis=1
    )
    assert (areas > 0.0).all()
    assert areas.sum() == pytest.approx(area, rel=ROUND_OFF)
    np.testing.assert_allclose(material.weights.sum(axis=1), 1.0, rtol=0, atol=1e-14)
    sides = np.sort(np.concatenate([corners[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    found, counts = np.unique(sides, axis=0, return_counts=True)
    assert counts.max() <= 2  # no third triangle at an edge
    # No vertex hangs on an edge: the border closes, with as many edges as vertices in and out.
    ends = np.bincount(found[counts == 1].ravel(), minlength=len(material.points))
    assert (ends % 2 == 0).all()
    # Pieces are what edges join.
    parent = np.arange(len(corners))

    def first(i: int) -> int:
        while parent[i] != i:
            i = parent[i]
        return int(i)

    of = np.tile(np.arange(len(corners)), 3)
    order = np.lexsort((sides[:, 1], sides[:, 0]))
    for a, b in itertools.pairwise(order):
        if (sides[a] == sides[b]).all():
            parent[first(of[a])] = first(of[b])
    groups = np.array([first(i) for i in range(len(corners))])
    expected = sorted(areas[groups == g].sum() * 1e-3 for g in np.unique(groups))
    volumes = sorted(piece.volume for piece in simulation.pieces("sheet"))
    np.testing.assert_allclose(volumes, expected, rtol=1e-11)
    # Shares of a first-day cell sum to one.
    core = simulation._core.body_cells("sheet")
    origins, shares = (np.concatenate([run[k] for run in core]) for k in (2, 3))
    np.testing.assert_allclose(
        np.bincount(origins, shares)[np.unique(origins)], 1.0, rtol=0, atol=1e-13
    )


@pytest.mark.parametrize("law", [ts.StVK, ts.Hooke])
def test_a_cut_keeps_mass_momenta_and_energies(law: Any) -> None:
    simulation = shaken(scene(sheet(law=law(young=5e5, poisson=0.3))).compile())
    before = simulation.energy()
    report = simulation.cut("sheet", SLANTED)
    after = simulation.energy()
    assert report.cells_cut > 0
    assert len(report.pieces) == 2
    assert abs(report.mass_change) <= ROUND_OFF * MASS
    assert abs(report.volume_change) <= ROUND_OFF * MASS / 1000.0
    assert np.abs(report.momentum_change).max() <= ROUND_OFF * MASS * 3.0
    assert np.abs(report.angular_momentum_change).max() <= ROUND_OFF * MASS
    for kind in ("kinetic", "elastic", "potential"):
        assert after[kind] == pytest.approx(before[kind], rel=ROUND_OFF)


def test_the_pieces_and_the_cut_are_those_of_the_blade() -> None:
    simulation = scene().compile()
    report = simulation.cut("sheet", ts.Plane(point=(0.137, 0, 0), normal=(1, 0, 0)))
    large, small = report.pieces
    assert large.volume == pytest.approx(0.263 * 1e-4, rel=ROUND_OFF)
    assert small.volume == pytest.approx(0.137 * 1e-4, rel=ROUND_OFF)
    assert small.held
    assert not large.held
    assert report.area == pytest.approx(1e-4, rel=ROUND_OFF)  # 10 cm of 1 mm
    assert report.rest_area == pytest.approx(1e-4, rel=ROUND_OFF)
    require_sound(simulation, 0.04)
    surface = simulation.surface("sheet")
    assert not surface.cut.any()
    assert len(surface.triangles) == len(simulation.material("sheet").cell)


def test_a_cut_on_edges_leaves_two_sheets() -> None:
    """The held one goes on as a sheet that was built alone, to the tolerance of the solver."""
    whole = scene(step=EXACT.replace(newton=SOLVED)).compile()
    report = whole.cut("sheet", ts.Plane(point=(0.2, 0, 0), normal=(1, 0, 0)))
    assert report.faces_opened == 4
    apart = scene(sheet((8, 4, 0), 0.2), step=EXACT.replace(newton=SOLVED)).compile()
    for _ in range(50):
        whole.step()
        apart.step()
    (held,) = [piece for piece in report.pieces if piece.held]
    mine, rest = nodes_of(whole, held), whole.meshes["sheet"].points
    mine = mine[np.lexsort(rest[mine].T.round(9))]
    other = np.lexsort(apart.meshes["sheet"].points.T.round(9))
    assert len(mine) == len(other) == 45
    np.testing.assert_allclose(
        whole.positions["sheet"][mine], apart.positions["sheet"][other], rtol=0, atol=1e-10
    )


def test_a_piece_that_nothing_holds_falls_freely() -> None:
    """Backward Euler from rest: after n steps it has fallen by g h^2 n (n + 1) / 2."""
    simulation = scene(step=EXACT).compile()
    report = simulation.cut("sheet", SLANTED)
    (free,) = [piece for piece in report.pieces if not piece.held]
    for _ in range(20):
        simulation.step()
    fallen = simulation.displacements("sheet")[nodes_of(simulation, free)]
    expected = [0.0, 0.0, -9.81 * 0.005**2 * 20 * 21 / 2]
    np.testing.assert_allclose(fallen, np.broadcast_to(expected, fallen.shape), rtol=0, atol=1e-9)


def test_a_drawn_sheet_that_is_cut_through_loses_its_stress() -> None:
    """Both parts are free on one side and come to rest without energy, each at its own end."""
    ends = [ts.Fixed("sheet", on=ts.Plane((x, 0, 0), (1, 0, 0))) for x in (0, 0.4)]
    body = sheet(viscosity=ts.Rayleigh(mass=40.0, stiffness="2 ms"))
    simulation = scene(body, fixed=ends, gravity=(0, 0, 0)).compile()
    simulation.positions["sheet"][:, 0] *= 1.1
    for node in (simulation.meshes["sheet"].points[:, 0] == 0.4).nonzero()[0]:
        simulation.positions["sheet"][node, 0] = 0.4
    inner = simulation.positions["sheet"]
    inner[:, 0] = simulation.meshes["sheet"].points[:, 0]
    inner[:, 0] += 0.02 * np.sin(np.pi * inner[:, 0] / 0.4)
    before = simulation.energy()["elastic"]
    simulation.cut("sheet", ts.Plane((0.183, 0, 0), (1, 0, 0)))
    assert simulation.energy()["elastic"] == pytest.approx(before, rel=ROUND_OFF)
    for _ in range(400):
        assert simulation.step().converged
    assert simulation.energy()["elastic"] < 1e-8 * before


@pytest.mark.parametrize("seed", range(25))
def test_random_cuts_keep_everything(seed: int) -> None:
    """20 blades one after the other, through nodes and along edges too: 500 cuts in all."""
    print(f"seed {seed}")
    random = np.random.default_rng(seed)
    body, room = sheet((12, 4, 0)), ts.Editing(room="5000 %")
    simulation = shaken(scene(body, fixed=[], editing=room).compile(), seed)
    if seed % 2:
        simulation.positions["sheet"][:] = simulation.meshes["sheet"].points
    first = simulation.energy()
    cut = 0
    for _ in range(20):
        blade = random_blade(random, simulation)
        before = simulation.energy()
        report = simulation.cut("sheet", blade)
        cut += report.cells_cut > 0
        assert abs(report.mass_change) <= ROUND_OFF * MASS
        assert np.abs(report.momentum_change).max() <= ROUND_OFF * MASS * 4.0
        assert np.abs(report.angular_momentum_change).max() <= ROUND_OFF * MASS
        assert sum(piece.mass for piece in report.pieces) == pytest.approx(MASS, rel=1e-11)
        after = simulation.energy()
        for kind in ("kinetic", "elastic", "potential"):
            reference = max(abs(before[kind]), abs(first[kind]))
            assert abs(after[kind] - before[kind]) <= ROUND_OFF * reference + 1e-300
        require_sound(simulation, 0.04)
    assert cut >= 5
    simulation.positions["sheet"][:] = simulation.meshes["sheet"].points
    simulation.velocities["sheet"][:] = 0.0
    assert simulation.step().converged
    assert np.isfinite(simulation.positions["sheet"]).all()


def random_blade(random: np.random.Generator, simulation: ts.Simulation) -> Any:
    points = simulation.positions["sheet"][:65]
    center = random.uniform((0, 0, -0.002), (0.4, 0.1, 0.002))
    if random.random() < 0.4:  # through a node
        center = points[random.integers(len(points))]
    normal = np.append(random.standard_normal(2), 0.3 * random.standard_normal())
    if random.random() < 0.3:  # along a row of edges where the sheet is at rest
        normal = np.eye(3)[random.integers(2)]
    kind = random.integers(3)
    if kind == 0:
        return ts.Disc(center, normal, random.uniform(0.01, 0.08))
    if kind == 1:
        across = np.cross(normal / np.linalg.norm(normal), (0, 0, 1))
        along = [center + s * across + 0.2 * s * s * np.array(normal) for s in (-0.04, 0, 0.05)]
        up = np.array((0, 0, 0.03))
        return ts.Sweep([[p - up, p + up] for p in along])
    if random.random() < 0.7:
        return ts.Disc(center, normal, 0.05)
    return ts.Plane(tuple(center), tuple(normal))


def knife(times: tuple[float, ...], places: Any, **more: Any) -> ts.Knife:
    return ts.Knife(
        edge=[(0, 0, -0.02), (0, 0, 0.02)],
        cuts=["sheet"],
        path=ts.ToolPath(times=times, positions=places),
        **more,
    )


def led(steps: int, drift: float = 0.0, threads: int = 1) -> ts.Simulation:
    """A knife from outside along a sheet that nothing holds; sheet and knife drift together."""
    way = [(0.1, -0.013, 0.0), (0.1, 0.063, 0.0)]
    moved = [(x + drift * t, y, z) for (x, y, z), t in zip(way, (0, 0.1), strict=True)]
    simulation = scene(
        fixed=[],
        gravity=(0, 0, 0),
        step=ts.ImplicitEuler(dt=0.1 / steps, solver=ts.ConjugateGradient(tolerance=1e-12)),
        threads=threads,
        instruments={"blade": knife((0.0, 0.1), moved)},
    ).compile()
    simulation.velocities["sheet"][:] = (drift, 0, 0)
    return simulation


@pytest.mark.parametrize("steps", [1, 10, 50])
@pytest.mark.parametrize("drift", [0.0, 0.3])
def test_a_knife_leaves_one_slit(steps: int, drift: float) -> None:
    simulation = led(steps, drift)
    reports = [cut for report in simulation.run(0.1) for cut in report.cuts]
    assert not any(report.unresolved for report in reports[:-1])
    assert len(simulation.pieces("sheet")) == 1
    require_sound(simulation, 0.04)
    # From the border at y = 0 to a cell (25 mm) or less behind the tip at 63 mm.
    length = sum(report.rest_area for report in reports) / 1e-3
    assert 0.063 - 0.025 <= length <= 0.063 + 1e-9


def test_a_knife_that_goes_through_parts_the_sheet() -> None:
    way = [(0.1, -0.01, 0.0), (0.117, 0.05, 0.0), (0.1, 0.12, 0.0)]
    instruments = {"blade": knife((0, 0.1, 0.2), way)}
    simulation = scene(gravity=(0, 0, 0), instruments=instruments).compile()
    for report in simulation.run(0.2):
        assert report.converged
    assert len(simulation.pieces("sheet")) == 2


def test_bits_are_the_same_on_two_threads_after_a_rewind_and_from_a_checkpoint(
    tmp_path: Path,
) -> None:
    """All in the middle of an incision."""
    runs = [led(20, 0.3, threads) for threads in (1, 2)]
    for simulation in runs:
        for _ in simulation.run(0.06):
            pass
    require_same_ends(runs, "sheet", seconds(0.04), tmp_path)
    assert len(runs[0].positions["sheet"]) > 85


TOUGHNESS = 200.0


def drawn(way: Any, duration: float, **more: Any) -> ts.Scene:
    """A knife with a toughness through a sheet that is held but where it is cut."""
    held = [
        ts.Fixed("sheet", on=ts.Box(max=(0.18, None, None))),
        ts.Fixed("sheet", on=ts.Box(min=(0.23, None, None))),
    ]
    return scene(
        gravity=(0, 0, 0),
        fixed=held,
        step=ts.ImplicitEuler("10 ms"),
        instruments={"blade": knife((0, duration), way, toughness=TOUGHNESS)},
        **more,
    )


def test_a_tough_blade_takes_its_work_and_has_the_force_of_the_thickness() -> None:
    """Work = J_c x length x thickness; in steady cutting the force is J_c x thickness."""
    simulation = drawn([(0.207, -0.02, 0), (0.207, 0.14, 0)], 1.0).compile()
    reports, forces, at = [], [], []
    for _ in range(100):
        step = simulation.step()
        assert step.converged
        reports += step.cuts
        forces.append(simulation.instruments["blade"].force)
        at.append(-0.02 + 0.16 * step.time)
    assert len(simulation.pieces("sheet")) == 2
    area = sum(report.area for report in reports)
    assert area == pytest.approx(0.1 * 1e-3, rel=0.02)  # the sheet gives way a little
    for report in reports:
        assert report.work == pytest.approx(TOUGHNESS * report.area, rel=ROUND_OFF)
    found, place = np.array(forces), np.array(at)
    steady = found[(place > 0.03) & (place < 0.09)]
    # Its points give way once they are behind by a fifth of a cell: until then they have the force.
    np.testing.assert_allclose(np.linalg.norm(steady, axis=1), TOUGHNESS * 1e-3, rtol=0.02)
    assert (steady[:, 1] < 0.0).all()  # against its way
    np.testing.assert_array_equal(found[place > 0.135], 0.0)


def test_a_blade_that_is_not_pushed_hard_enough_does_not_cut() -> None:
    way = [(0.207, -0.02, 0), (0.207, 0.0012, 0)]  # a tenth of a cell is 2.5 mm
    simulation = drawn(way, 0.5).compile()
    reports = [cut for report in simulation.run(0.5) for cut in report.cuts]
    assert not reports
    force = simulation.instruments["blade"].force[1]
    assert -TOUGHNESS * 1e-3 < force < 0.0


@pytest.mark.parametrize("cells", [(24, 8, 0), (36, 12, 0)])
def test_a_notched_strip_tears_through_in_a_line(cells: tuple[int, int, int]) -> None:
    """Drawn out, it tears from the notch straight across, on both meshes in the same step or so."""
    mesh = ts.bar_mesh(size=(0.12, 0.04, 0), cells=cells, cell="triangle")
    soft = ts.StVK(young="100 kPa", poisson=0.3)
    damped = ts.Rayleigh(mass=5, stiffness="5 ms")
    way = [(0.06, -0.02, 0), (0.06, 0.0155, 0), (0.06, -0.02, 0)]
    end, out = ts.Plane((0.12, 0, 0), (1, 0, 0)), ((0, 0, 0), (0.03, 0, 0))
    simulation = scene(
        sheet().replace(mesh=mesh, law=soft, viscosity=damped),
        gravity=(0, 0, 0),
        prescribed=[ts.Prescribed("sheet", on=end, times=(0.2, 1.2), displacements=out)],
        instruments={"blade": knife((0, 0.1, 0.2), way)},
        tear=[ts.Tear("sheet", strength="12 kPa", length="6 mm")],
        step=ts.ImplicitEuler("20 ms"),
    ).compile()
    begun = None
    for report in simulation.run(1.2):
        assert report.converged
        torn = [cut for cut in report.cuts if cut.by == "tear"]
        begun = report.time if torn and begun is None else begun
        assert len(torn) <= 1  # from the front of the notch alone
        if len(simulation.pieces("sheet")) == 2:
            break
    assert begun == pytest.approx(0.47, abs=0.021)
    one, other = simulation.pieces("sheet")
    assert one.volume == pytest.approx(0.5 * 0.12 * 0.04 * 1e-3, rel=0.02)
    assert one.volume + other.volume == pytest.approx(0.12 * 0.04 * 1e-3, rel=ROUND_OFF)


def test_cells_go_and_what_hangs_by_a_node_parts() -> None:
    simulation = scene().compile()
    report = simulation.ablate("sheet", ts.Box(min=(0.2, -1, -1), max=(0.22, 1, 1)))
    assert report.cells_gone > 0
    assert report.mass_change < 0.0
    assert report.mass_change == pytest.approx(
        sum(piece.mass for piece in report.pieces) - MASS, rel=1e-9
    )
    simulation.cut("sheet", ts.Plane((0.1, 0, 0), (1, 0.2, 0)))
    numbers = simulation.remaining_cells("sheet")
    simulation.remove_cells(body="sheet", cells=numbers[-3:])
    assert len(simulation.remaining_cells("sheet")) == len(numbers) - 3
    assert simulation.step().converged


def test_a_load_on_edges_of_the_cut_goes_to_both_parts() -> None:
    """4 N at the nodes at 0.2 of a sheet without supports: each half gains half the momentum."""
    load = ts.NodalLoad("sheet", on=ts.Plane((0.2, 0, 0), (1, 0, 0)), force=(0, 0, -4.0))
    simulation = scene(loads=[load], fixed=[], gravity=(0, 0, 0), step=EXACT).compile()
    report = simulation.cut("sheet", ts.Plane((0.2, 0, 0), (1, 0, 0)))
    for _ in range(4):
        simulation.step()
    rows, _, masses = simulation._core.mass_matrix()
    count = len(simulation.positions["sheet"])
    momentum = np.bincount(rows, masses[:, 0, 0])[:count, None] * simulation.velocities["sheet"]
    for piece in report.pieces:
        found = momentum[nodes_of(simulation, piece)].sum(axis=0)
        np.testing.assert_allclose(found, (0, 0, -2.0 * 0.02), rtol=0, atol=1e-9)


def test_a_piece_falls_on_a_table_and_weighs_what_it_weighs() -> None:
    body = sheet(viscosity=ts.Rayleigh(mass=5, stiffness="5 ms"))
    simulation = scene(
        body,
        fixed=[ts.Fixed("sheet", on=ts.Box(max=(0.18, None, None)))],
        obstacles={"table": ts.PlaneObstacle((0, 0, -0.03), (0, 0, 1))},
        contacts=[ts.Contact(("sheet", "table"), friction=0.3)],
    ).compile()
    report = simulation.cut("sheet", ts.Plane((0.187, 0, 0), (1, 0.02, 0)))
    (piece,) = [piece for piece in report.pieces if not piece.held]
    for _ in range(300):
        assert simulation.step().converged
    share = simulation.force_on("table").force[2] / (-9.81 * piece.mass)
    assert share == pytest.approx(1.0, rel=0.02)
    # It rests half its thickness above the table, cut edge included.
    surface = simulation.surface("sheet")
    assert surface.points[:, 2].min() > -0.03 + 0.9 * 0.5e-3


def test_what_cannot_be_cut_is_refused_in_a_sentence() -> None:
    with pytest.raises(ts.ParameterError, match="the sheet 'sheet'; the quality of"):
        scene().compile().quality("sheet")


def test_a_blade_along_an_edge_of_three_triangles_is_refused() -> None:
    points = [(0, 0, 0), (0.1, 0, 0), (0.05, 0.1, 0), (0.05, -0.1, 0), (0.05, 0, 0.1)]
    mesh = ts.Mesh(
        points=np.array(points), cells={"triangle": [(0, 1, 2), (0, 1, 3), (0, 1, 4)]}, thin=(2,)
    )
    simulation = scene(sheet().replace(mesh=mesh), fixed=[]).compile()
    with pytest.raises(ts.ParameterError, match="an edge that more than two triangles share"):
        simulation.cut("sheet", ts.Plane((0, 0, 0), (0, 1, 0.1)))
    assert len(simulation.pieces("sheet")) == 1
    # Across the edge all three are parted, and what is left of each stays with the others.
    report = simulation.cut("sheet", ts.Plane((0.05, 0, 0), (1, 0.03, 0.02)))
    assert len(report.pieces) == 2
