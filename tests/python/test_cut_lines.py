"""Lines are cut where a blade crosses them, and their parts go on as they would alone."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tissu as ts
from cut_states import shaken
from same_ends import require_same_ends, seconds
from tissu.live_view.surface import seen_of
from tissu.output.series import write_material
from tissu.picture.draw import shape_of

ROUND_OFF = 1e-12
"""Of sums over some hundred numbers: a few hundred times the spacing of doubles."""
SECTION = 2e-6
MASS = 0.4 * SECTION * 1000.0
HELD = ts.Plane(point=(0, 0, 0), normal=(1, 0, 0))
EXACT = ts.ImplicitEuler(dt=0.005, solver=ts.ConjugateGradient(tolerance=1e-12))
ACROSS = ts.Plane(point=(0.213, 0.0, 0.0), normal=(1.0, 0.31, -0.27))


def cable(cells: int = 16, length: float = 0.4, **body: Any) -> ts.Body:
    return ts.Body(
        mesh=ts.bar_mesh(size=(length, 0, 0), cells=(cells, 0, 0), cell="line"),
        **{"law": ts.StVK(young=5e6, poisson=0.3), "density": 1000.0, "section": SECTION} | body,
    )


def net(cells: int = 6, size: float = 0.3, **body: Any) -> ts.Body:
    """A square net: four lines meet at each inner node."""
    place = np.arange((cells + 1) ** 2).reshape(cells + 1, cells + 1)
    x, y = np.meshgrid(*2 * [np.linspace(0, size, cells + 1)], indexing="ij")
    points = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    along = np.stack([place[:-1].ravel(), place[1:].ravel()], axis=1)
    across = np.stack([place[:, :-1].ravel(), place[:, 1:].ravel()], axis=1)
    mesh = ts.Mesh(points=points, cells={"line": np.concatenate([along, across])}, thin=(1,))
    return cable(**body).replace(mesh=mesh)


def scene(body: ts.Body | None = None, **changes: Any) -> ts.Scene:
    return ts.Scene(
        **{
            "bodies": {"cable": cable() if body is None else body},
            "fixed": [ts.Fixed("cable", on=HELD)],
            "gravity": (0.0, 0.0, -9.81),
            "step": ts.ImplicitEuler(dt=0.005),
            "editing": ts.Editing(room="400 %"),
        }
        | changes
    )


def nodes_of(simulation: ts.Simulation, piece: ts.Piece) -> np.ndarray[Any, Any]:
    (block,) = simulation.meshes["cable"].body_blocks
    return np.unique(block.nodes[np.isin(simulation.remaining_cells("cable"), piece.cells)])


def require_sound(simulation: ts.Simulation, length: float) -> None:
    """The material has its length, and the pieces are what its points join."""
    material = simulation.material("cable")
    corners = np.concatenate([block.nodes for block in material.mesh.body_blocks])
    ends = material.mesh.points[corners]
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    assert (lengths > 0.0).all()
    assert lengths.sum() == pytest.approx(length, rel=ROUND_OFF)
    np.testing.assert_allclose(material.weights.sum(axis=1), 1.0, rtol=0, atol=1e-14)
    group = np.arange(len(material.points))
    while True:
        before = group.copy()
        least = group[corners].min(axis=1)
        np.minimum.at(group, corners, least[:, None])
        if (before == group).all():
            break
    found = group[corners[:, 0]]
    expected = sorted(lengths[found == g].sum() * SECTION for g in np.unique(found))
    volumes = sorted(piece.volume for piece in simulation.pieces("cable"))
    np.testing.assert_allclose(volumes, expected, rtol=1e-11)
    core = simulation._core.body_cells("cable")
    origins, shares = (np.concatenate([run[k] for run in core]) for k in (2, 3))
    np.testing.assert_allclose(
        np.bincount(origins, shares)[np.unique(origins)], 1.0, rtol=0, atol=1e-13
    )


@pytest.mark.parametrize("law", [ts.StVK, ts.Hooke])
def test_a_cut_keeps_mass_momenta_and_energies(law: Any) -> None:
    simulation = shaken(scene(cable(law=law(young=5e6, poisson=0.3))).compile())
    before = simulation.energy()
    report = simulation.cut("cable", ACROSS)
    after = simulation.energy()
    assert report.cells_cut == 1
    assert report.faces_opened == 1
    assert len(report.pieces) == 2
    assert abs(report.mass_change) <= ROUND_OFF * MASS
    assert np.abs(report.momentum_change).max() <= ROUND_OFF * MASS * 3.0
    assert np.abs(report.angular_momentum_change).max() <= ROUND_OFF * MASS
    for kind in ("kinetic", "elastic", "potential"):
        assert after[kind] == pytest.approx(before[kind], rel=ROUND_OFF)


@pytest.mark.parametrize("at", [0.137, 0.1251, 0.1249999])
def test_the_pieces_are_those_of_the_blade(at: float) -> None:
    """However near to a node it crosses; the node is at 0.125."""
    simulation = scene().compile()
    report = simulation.cut("cable", ts.Plane(point=(at, 0, 0), normal=(1, 0, 0)))
    large, small = report.pieces
    assert large.volume == pytest.approx((0.4 - at) * SECTION, rel=1e-11)
    assert small.volume == pytest.approx(at * SECTION, rel=1e-11)
    assert (small.held, large.held) == (True, False)
    assert report.area == report.rest_area == SECTION
    require_sound(simulation, 0.4)


def test_a_cut_on_a_node_leaves_two_cables() -> None:
    whole = swung(scene(step=EXACT, gravity=(9.81, 0, 0)))
    report = whole.cut("cable", ts.Plane(point=(0.2, 0, 0), normal=(1, 0, 0)))
    assert report.faces_opened == 1
    apart = swung(scene(cable(8, 0.2), step=EXACT, gravity=(9.81, 0, 0)))
    for _ in range(50):
        whole.step()
        apart.step()
    (held,) = [piece for piece in report.pieces if piece.held]
    mine, rest = nodes_of(whole, held), whole.meshes["cable"].points
    mine = mine[np.argsort(rest[mine, 0])]
    np.testing.assert_allclose(
        whole.positions["cable"][mine], apart.positions["cable"], rtol=0, atol=1e-10
    )


def swung(made: ts.Scene) -> ts.Simulation:
    """A cable that hangs along its axis, and turns about where it is held."""
    simulation = made.compile()
    simulation.velocities["cable"][:, 1] = simulation.positions["cable"][:, 0]
    return simulation


def test_a_piece_that_nothing_holds_falls_freely() -> None:
    """Backward Euler from rest: after n steps it has fallen by g h^2 n (n + 1) / 2."""
    simulation = scene(step=EXACT).compile()
    report = simulation.cut("cable", ACROSS)
    (free,) = [piece for piece in report.pieces if not piece.held]
    for _ in range(20):
        simulation.step()
    fallen = simulation.displacements("cable")[nodes_of(simulation, free)]
    expected = [0.0, 0.0, -9.81 * 0.005**2 * 20 * 21 / 2]
    np.testing.assert_allclose(fallen, np.broadcast_to(expected, fallen.shape), rtol=0, atol=1e-9)


def test_a_drawn_cable_that_is_cut_loses_its_stress() -> None:
    ends = [ts.Fixed("cable", on=ts.Plane((x, 0, 0), (1, 0, 0))) for x in (0, 0.4)]
    body = cable(viscosity=ts.Rayleigh(mass=40.0, stiffness="2 ms"))
    simulation = scene(body, fixed=ends, gravity=(0, 0, 0)).compile()
    inner = simulation.positions["cable"]
    inner[:, 0] += 5e-4 * np.sin(np.pi * inner[:, 0] / 0.4)
    before = simulation.energy()["elastic"]
    simulation.cut("cable", ts.Plane((0.183, 0, 0), (1, 0, 0)))
    assert simulation.energy()["elastic"] == pytest.approx(before, rel=ROUND_OFF)
    for _ in range(400):
        assert simulation.step().converged
    assert simulation.energy()["elastic"] < 1e-8 * before


@pytest.mark.parametrize("seed", range(12))
def test_random_cuts_of_a_net_keep_everything(seed: int) -> None:
    """20 blades one after the other; half of the nets are at rest, along whose lines blades lie."""
    random = np.random.default_rng(seed)
    body, room = net(), ts.Editing(room="5000 %")
    simulation = shaken(scene(body, fixed=[], editing=room).compile(), seed)
    if seed % 2:
        simulation.positions["cable"][:] = simulation.meshes["cable"].points
    mass, first, cut = simulation._core.mass("cable"), simulation.energy(), 0
    assert mass == pytest.approx(14 * 0.3 * SECTION * 1000.0, rel=ROUND_OFF)
    for _ in range(20):
        before = simulation.energy()
        report = simulation.cut("cable", random_blade(random))
        cut += report.cells_cut > 0
        assert abs(report.mass_change) <= ROUND_OFF * mass
        assert np.abs(report.momentum_change).max() <= ROUND_OFF * mass * 4.0
        assert np.abs(report.angular_momentum_change).max() <= ROUND_OFF * mass
        after = simulation.energy()
        for kind in ("kinetic", "elastic", "potential"):
            reference = max(abs(before[kind]), abs(first[kind]))
            assert abs(after[kind] - before[kind]) <= ROUND_OFF * reference + 1e-300
        require_sound(simulation, 14 * 0.3)
    assert cut >= 5
    simulation.positions["cable"][:] = simulation.meshes["cable"].points
    simulation.velocities["cable"][:] = 0.0
    assert simulation.step().converged
    assert np.isfinite(simulation.positions["cable"]).all()


def random_blade(random: np.random.Generator) -> Any:
    center = random.uniform((0, 0, -0.002), (0.3, 0.3, 0.002))
    normal = np.append(random.standard_normal(2), 0.3 * random.standard_normal())
    if random.random() < 0.2:  # across the lines of one direction of a net at rest
        normal = np.eye(3)[random.integers(2)]
    kind = random.integers(3)
    if kind == 0:
        return ts.Disc(center, normal, random.uniform(0.01, 0.08))
    if kind == 1:
        across = np.cross(normal / np.linalg.norm(normal), (0, 0, 1))
        along = [center + s * across + 0.2 * s * s * np.array(normal) for s in (-0.04, 0, 0.05)]
        up = np.array((0, 0, 0.03))
        return ts.Sweep([[p - up, p + up] for p in along])
    return ts.Plane(tuple(center), tuple(normal))


def led(threads: int = 1, drift: float = 0.3) -> ts.Simulation:
    """A knife across a net that nothing holds, which moves; both drift together."""
    way = [(0.112 + 0.0, -0.013, 0.0), (0.112 + 0.1 * drift, 0.283, 0.0)]
    knife = ts.Knife(
        edge=[(0, 0, -0.02), (0, 0, 0.02)],
        cuts=["cable"],
        path=ts.ToolPath(times=(0.0, 0.1), positions=way),
    )
    simulation = scene(
        net(),
        fixed=[],
        gravity=(0, 0, 0),
        step=ts.ImplicitEuler(dt=0.005, solver=ts.ConjugateGradient(tolerance=1e-12)),
        threads=threads,
        instruments={"blade": knife},
    ).compile()
    simulation.velocities["cable"][:] = (drift, 0, 0)
    return simulation


def test_a_knife_parts_each_line_that_it_passes_once() -> None:
    """It passes the six lines across its way at 0.05, ..., 0.25 and the border at 0; not 0.3."""
    simulation = led()
    cuts = [cut for report in simulation.run(0.1) for cut in report.cuts]
    assert sum(cut.faces_opened for cut in cuts) == 6
    assert sum(cut.rest_area for cut in cuts) == pytest.approx(6 * SECTION, rel=ROUND_OFF)
    assert len(simulation.pieces("cable")) == 1  # the last line across holds both sides together
    require_sound(simulation, 14 * 0.3)


def test_bits_are_the_same_on_two_threads_after_a_rewind_and_from_a_checkpoint(
    tmp_path: Path,
) -> None:
    """All in the middle of an incision."""
    runs = [led(threads) for threads in (1, 2)]
    for simulation in runs:
        for _ in simulation.run(0.06):
            pass
    require_same_ends(runs, "cable", seconds(0.04), tmp_path)
    assert len(runs[0].positions["cable"]) > 49


def test_a_cable_tears_at_its_strength() -> None:
    """Drawn slowly, F = 1 + e: under Hooke's law it tears in the step in which E e is reached."""
    end = ts.Plane((0.4, 0, 0), (1, 0, 0))
    out = ((0, 0, 0), (0.04, 0, 0))
    body = cable(law=ts.Hooke(young=5e6, poisson=0.0), viscosity=ts.Rayleigh(mass=200.0))
    simulation = scene(
        body,
        gravity=(0, 0, 0),
        prescribed=[ts.Prescribed("cable", on=end, times=(0, 10), displacements=out)],
        tear=[ts.Tear("cable", strength="200 kPa", length="30 mm", per_step=1)],
        step=ts.ImplicitEuler("50 ms"),
    ).compile()
    torn = None
    for report in simulation.run(6.0):
        if report.cuts:
            (torn,) = report.cuts
            break
    assert torn is not None
    assert torn.by == "tear"
    # strain 0.04 at 4 s; waves die out within some steps, and change it by a step at most
    assert report.time == pytest.approx(4.0, abs=0.11)
    assert torn.faces_opened == 1
    assert len(simulation.pieces("cable")) == 2


@pytest.mark.parametrize(("at", "shares"), [(0.2, (0.5, 0.5)), (0.2125, (1.0, 0.0))])
def test_a_load_goes_to_the_material_that_it_loads(at: float, shares: tuple[float, float]) -> None:
    """3 N at the node at 0.2 of a cable without supports: each part gains its share of momentum."""
    load = ts.NodalLoad("cable", on=ts.Plane((0.2, 0, 0), (1, 0, 0)), force=(0, 0, -3.0))
    simulation = scene(loads=[load], fixed=[], gravity=(0, 0, 0), step=EXACT).compile()
    report = simulation.cut("cable", ts.Plane((at, 0, 0), (1, 0, 0)))
    assert len(report.pieces) == 2
    for _ in range(4):
        simulation.step()
    rows, _, masses = simulation._core.mass_matrix()
    count = len(simulation.positions["cable"])
    mass = np.bincount(rows, masses[:, 0, 0])[:count]
    momentum = mass[:, None] * simulation.velocities["cable"]
    for piece, share in zip(
        sorted(report.pieces, key=lambda piece: piece.first_cell), shares, strict=True
    ):
        found = momentum[nodes_of(simulation, piece)].sum(axis=0)
        np.testing.assert_allclose(found, (0, 0, -3.0 * share * 0.02), rtol=0, atol=1e-9)


def test_cells_go() -> None:
    simulation = scene().compile()
    simulation.cut("cable", ts.Plane((0.2, 0, 0), (1, 0, 0)))
    gone = simulation.ablate("cable", ts.Box(min=(0.3, -1, -1), max=(0.32, 1, 1)))
    assert gone.cells_gone == 1
    assert gone.mass_change == pytest.approx(-MASS / 16, rel=1e-9)
    assert len(gone.pieces) == 3
    numbers = simulation.remaining_cells("cable")
    simulation.remove_cells(body="cable", cells=numbers[-1:])
    assert len(simulation.remaining_cells("cable")) == len(numbers) - 1
    assert simulation.step().converged


def test_a_piece_falls_on_a_table_and_weighs_what_it_weighs() -> None:
    body = cable(viscosity=ts.Rayleigh(mass=5, stiffness="5 ms"))
    simulation = scene(
        body,
        fixed=[ts.Fixed("cable", on=ts.Box(max=(0.18, None, None)))],
        obstacles={"table": ts.PlaneObstacle((0, 0, -0.03), (0, 0, 1))},
        contacts=[ts.Contact(("cable", "table"), friction=0.3)],
    ).compile()
    report = simulation.cut("cable", ts.Plane((0.187, 0, 0), (1, 0.02, 0)))
    (piece,) = [piece for piece in report.pieces if not piece.held]
    for _ in range(400):
        assert simulation.step().converged
    share = simulation.force_on("table").force[2] / (-9.81 * piece.mass)
    assert share == pytest.approx(1.0, rel=0.02)
    surface, radius = simulation.surface("cable"), np.sqrt(SECTION / np.pi)
    assert surface.points[:, 2].min() > -0.03 + 0.9 * radius


def test_what_is_seen_and_written_is_the_material(tmp_path: Path) -> None:
    meshio = pytest.importorskip("meshio")
    simulation = scene(net()).compile()
    simulation.cut("cable", ts.Plane((0.113, 0, 0), (1, 0.01, 0)))
    surface = simulation.surface("cable")
    assert len(surface.lines) == 84 + 7
    assert len(surface.triangles) == 0
    sides = surface.points[surface.lines]
    lengths = np.linalg.norm(sides[:, 1] - sides[:, 0], axis=1)
    assert lengths.sum() == pytest.approx(14 * 0.3, rel=ROUND_OFF)
    write_material(tmp_path / "cut.vtu", simulation, "cable")
    read = meshio.read(tmp_path / "cut.vtu")
    assert sum(len(block.data) for block in read.cells) == 84 + 7
    assert {block.type for block in read.cells} == {"line"}
    assert set(np.concatenate(read.cell_data["piece"])) == {0, 1}
    for field in ("displacement", "von_mises"):
        shape = shape_of(simulation, field)
        assert len(shape.triangles) > 0
        assert np.isfinite(shape.values).all()
    seen = seen_of(simulation, "cable")
    assert len(seen.lines) == len(seen.line_cells) == 84 + 7
    np.testing.assert_allclose(seen.at(simulation.positions["cable"]), surface.points, atol=1e-15)


def test_a_blade_through_a_node_of_three_lines_is_refused_and_one_beside_it_is_not() -> None:
    points = np.array([(0, 0, 0), (0.1, 0, 0), (-0.1, 0.1, 0), (-0.1, -0.1, 0)])
    mesh = ts.Mesh(points=points, cells={"line": [(0, 1), (0, 2), (0, 3)]}, thin=(1,))
    simulation = scene(cable().replace(mesh=mesh), fixed=[]).compile()
    before = simulation.energy()
    with pytest.raises(ts.ParameterError, match="a node that more than two lines share"):
        simulation.cut("cable", ts.Plane((0, 0, 0), (1, 0.1, 0)))
    assert len(simulation.pieces("cable")) == 1
    assert simulation.energy() == before
    report = simulation.cut("cable", ts.Plane((1e-5, 0, 0), (1, 0, 0)))
    assert len(report.pieces) == 2
    assert report.pieces[1].volume == pytest.approx((0.1 - 1e-5) * SECTION, rel=1e-9)


def test_what_cannot_be_cut_is_refused_in_a_sentence() -> None:
    tough = ts.Knife(edge=[(0, 0, -0.1), (0, 0, 0.1)], cuts=["cable"], toughness="100 J/m^2")
    with pytest.raises(ts.SceneError, match="toughness of a knife that cuts the lines") as refused:
        scene(instruments={"blade": tough}).compile()
    assert scene(instruments={"blade": tough}).check().problems == refused.value.problems
    with pytest.raises(ts.ParameterError, match="the lines 'cable'; the quality of"):
        scene().compile().quality("cable")


def test_the_direct_solver_names_the_node_of_a_slack_line_that_nothing_holds() -> None:
    """A line that is not stretched resists no motion across itself in a static step."""
    line = ts.Body(
        mesh=ts.bar_mesh(size=(0.1, 0, 0), cells=(4, 0, 0), cell="line"),
        law=ts.StVK(young=5e4, poisson=0.4),
        density=1000.0,
        section=1e-6,
    )
    simulation = ts.Scene(
        bodies={"thread": line},
        gravity=(0, 0, -9.81),
        fixed=[ts.Fixed("thread", on=ts.Nodes((0,)))],
        step=ts.Static(solver=ts.Cholesky()),
    ).compile()
    with pytest.raises(ts.TissuError) as caught:
        simulation.step()
    assert str(caught.value) == (
        "the direct solver found 0 on the diagonal of the matrix, at node 1 of body "
        '"thread" along y, where numbers above 0 are accepted: nothing resists a motion of the '
        "node, as across a line that is not stretched in a static step; stretch the line, hold "
        "the node, or take a step with inertia, such as implicit_euler."
    )
