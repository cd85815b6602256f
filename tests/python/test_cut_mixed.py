"""Volumes with sheets and lines that share their nodes are cut as one, and stay together."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tissu as ts
from cut_states import shaken
from same_ends import require_same_ends, seconds
from tissu.mesh.thin import with_thin
from tissu.output.series import write_material
from tissu.picture.draw import shape_of

ROUND_OFF = 1e-12
"""Of sums over some thousand numbers: a few hundred times the spacing of doubles."""
SLANTED = ts.Plane(point=(0.213, 0.05, 0.0), normal=(1.0, 0.31, -0.27))
HELD = ts.Plane(point=(0, 0, 0), normal=(1, 0, 0))
EXACT = ts.ImplicitEuler(dt=0.005, solver=ts.ConjugateGradient(tolerance=1e-13))
THICKNESS = 1e-3
SECTION = 2e-6


def organ_mesh(cell: str = "tetra", cells: int = 8, length: float = 0.4) -> ts.Mesh:
    """A bar of 0.1 x 0.1 m with a skin on its top and a thread along a lower edge."""
    bar = ts.bar_mesh(size=(length, 0.1, 0.1), cells=(cells, 2, 2), cell=cell)
    points, surface = np.asarray(bar.points), bar.surface()
    faces = surface.triangles if cell == "tetra" else surface.quads
    faces = np.asarray(faces)
    top = faces[(points[faces][:, :, 2] > 0.1 - 1e-9).all(axis=1)]
    edge = np.flatnonzero((points[:, 1] < 1e-9) & (points[:, 2] < 1e-9))
    edge = edge[np.argsort(points[edge, 0])]
    thread = np.stack([edge[:-1], edge[1:]], axis=1)
    (block,) = bar.cells
    return ts.Mesh(
        points=points,
        cells={
            cell: block.nodes,
            "triangle" if cell == "tetra" else "quad": top,
            "line": thread,
        },
        thin=(2, 1),
    )


def organ(mesh: ts.Mesh | None = None, **body: Any) -> ts.Body:
    return ts.Body(
        **{
            "mesh": organ_mesh() if mesh is None else mesh,
            "law": ts.StVK(young=5e4, poisson=0.3),
            "density": 1000.0,
            "thickness": THICKNESS,
            "section": SECTION,
        }
        | body
    )


def scene(body: ts.Body | None = None, **changes: Any) -> ts.Scene:
    return ts.Scene(
        **{
            "bodies": {"organ": organ() if body is None else body},
            "fixed": [ts.Fixed("organ", on=HELD)],
            "gravity": (0.0, 0.0, -9.81),
            "step": ts.ImplicitEuler(dt=0.005),
            "editing": ts.Editing(room="900 %"),
        }
        | changes
    )


MASS = 1000.0 * (0.4 * 0.1 * 0.1 + 0.4 * 0.1 * THICKNESS + 0.4 * SECTION)


def nodes_of(simulation: ts.Simulation, piece: ts.Piece) -> np.ndarray[Any, Any]:
    """Nodes of the cells that hold a piece."""
    found, first = [], 0
    numbers = simulation.remaining_cells("organ")
    for block in simulation.meshes["organ"].body_blocks:
        own = numbers[first : first + len(block)]
        found.append(block.nodes[np.isin(own, piece.cells)].ravel())
        first += len(block)
    return np.unique(np.concatenate(found))


def measures(simulation: ts.Simulation) -> tuple[float, float, float]:
    """Volume, area and length of the material at rest."""
    sums = [0.0, 0.0, 0.0]
    mesh = simulation.material("organ").mesh
    for block in mesh.body_blocks:
        at = mesh.points[block.nodes]
        sides = at[:, 1:] - at[:, :1]
        if block.type == "tetra":
            sums[0] += np.linalg.det(sides).sum() / 6.0
        elif block.type in ("triangle", "quad"):
            for k in range(1, len(at[0]) - 1):
                cross = np.cross(sides[:, k - 1], sides[:, k])
                sums[1] += 0.5 * np.linalg.norm(cross, axis=1).sum()
        elif block.type == "line":
            sums[2] += np.linalg.norm(sides[:, 0], axis=1).sum()
        else:  # a box
            sums[0] += np.prod(np.ptp(at, axis=1), axis=1).sum()
    return sums[0], sums[1], sums[2]


def require_kept(report: ts.CutReport, before: Any, after: Any, mass: float = MASS) -> None:
    assert abs(report.mass_change) <= ROUND_OFF * mass
    assert np.abs(report.momentum_change).max() <= ROUND_OFF * mass * 3.0
    assert np.abs(report.angular_momentum_change).max() <= ROUND_OFF * mass
    for kind in ("kinetic", "elastic", "potential"):
        assert after[kind] == pytest.approx(before[kind], rel=ROUND_OFF)


@pytest.mark.parametrize("cell", ["tetra", "hexahedron"])
def test_a_cut_keeps_mass_momenta_and_energies(cell: str) -> None:
    simulation = shaken(scene(organ(organ_mesh(cell))).compile())
    assert simulation._core.mass("organ") == pytest.approx(MASS, rel=ROUND_OFF)
    before = simulation.energy()
    report = simulation.cut("organ", SLANTED)
    assert len(report.pieces) == 2
    require_kept(report, before, simulation.energy())
    assert sum(piece.mass for piece in report.pieces) == pytest.approx(MASS, rel=1e-11)
    volume, area, length = measures(simulation)
    assert volume == pytest.approx(0.004, rel=1e-11)
    assert area == pytest.approx(0.04, rel=1e-11)
    assert length == pytest.approx(0.4, rel=1e-11)


@pytest.mark.parametrize(
    "models",
    [
        ("corotational", "fem", "fem"),
        ("frames", "frames", "frames"),
        ("frames", "shell", "frames"),
    ],
)
def test_a_model_for_each_kind_of_cells_is_kept_whole(models: tuple[str, ...]) -> None:
    """A shell on frames has their rotations, and both keep their spins."""
    kinds = dict(zip(("volumes", "sheets", "lines"), models, strict=True))
    mesh = with_thin(dataclasses.replace(organ_mesh(), thin=()), sheets=True, lines=True)
    body = organ(mesh, model=kinds, law=ts.Hooke(young=5e4, poisson=0.3))
    simulation = shaken(scene(body, fixed=[]).compile())
    simulation.velocities["organ"][:] *= 0.1
    simulation.step()
    before = simulation.energy()
    report = simulation.cut("organ", SLANTED)
    assert len(report.pieces) == 2
    require_kept(report, before, simulation.energy())
    assert simulation.step().converged


@pytest.mark.parametrize("cell", ["tetra", "hexahedron"])
def test_a_cut_on_faces_leaves_two_that_go_on_as_if_built_apart(cell: str) -> None:
    """The held part is compared with one that was built alone, to the solver's tolerance."""
    whole = scene(organ(organ_mesh(cell)), step=EXACT).compile()
    report = whole.cut("organ", ts.Plane(point=(0.2, 0, 0), normal=(1, 0, 0)))
    apart = scene(organ(organ_mesh(cell, 4, 0.2)), step=EXACT).compile()
    for _ in range(30):
        whole.step()
        apart.step()
    (held,) = [piece for piece in report.pieces if piece.held]
    mine, rest = nodes_of(whole, held), whole.meshes["organ"].points
    mine = mine[np.lexsort(rest[mine].T.round(9))]
    other = np.lexsort(apart.meshes["organ"].points.T.round(9))
    assert len(mine) == len(other)
    np.testing.assert_allclose(
        whole.positions["organ"][mine], apart.positions["organ"][other], rtol=0, atol=1e-10
    )
    assert held.mass == pytest.approx(0.5 * MASS, rel=ROUND_OFF)


def test_a_piece_that_nothing_holds_falls_freely_with_its_skin() -> None:
    """Backward Euler from rest: after n steps it has fallen by g h^2 n (n + 1) / 2."""
    simulation = scene(step=EXACT).compile()
    report = simulation.cut("organ", SLANTED)
    (free,) = [piece for piece in report.pieces if not piece.held]
    for _ in range(10):
        simulation.step()
    fallen = simulation.displacements("organ")[nodes_of(simulation, free)]
    expected = [0.0, 0.0, -9.81 * 0.005**2 * 10 * 11 / 2]
    np.testing.assert_allclose(fallen, np.broadcast_to(expected, fallen.shape), rtol=0, atol=1e-9)


def random_blade(random: np.random.Generator, points: Any) -> Any:
    center = random.uniform((0, 0, 0), (0.4, 0.1, 0.1))
    if random.random() < 0.3:  # through a node
        center = points[random.integers(len(points))]
    normal = random.standard_normal(3)
    if random.random() < 0.3:  # along faces where the body is at rest
        normal = np.eye(3)[random.integers(3)]
    if random.random() < 0.6:
        return ts.Disc(center, normal, random.uniform(0.03, 0.12))
    return ts.Plane(tuple(center), tuple(normal))


@pytest.mark.parametrize("cell", ["tetra", "hexahedron"])
@pytest.mark.parametrize("seed", range(12))
def test_random_cuts_part_the_skin_as_they_part_the_volume(cell: str, seed: int) -> None:
    """The pieces are those of the volume alone: its skin and its thread hold none together."""
    random = np.random.default_rng(seed)
    thin = {"thickness": 1e-9, "section": 1e-14}
    room = ts.Editing(room="5000 %")
    made = scene(organ(organ_mesh(cell), **thin), fixed=[], editing=room)
    alone = ts.bar_mesh(size=(0.4, 0.1, 0.1), cells=(8, 2, 2), cell=cell)
    plain = organ(alone).replace(thickness=None, section=None)
    pair = [shaken(one.compile(), seed) for one in (made, scene(plain, fixed=[], editing=room))]
    if seed % 2:
        for one in pair:
            one.positions["organ"][:] = one.meshes["organ"].points
    nodes = np.array(pair[0].positions["organ"])
    for _ in range(6):
        blade = random_blade(random, nodes)
        before = pair[0].energy()
        report, other = (one.cut("organ", blade) for one in pair)
        require_kept(report, before, pair[0].energy())
        np.testing.assert_allclose(
            [piece.volume for piece in report.pieces],
            [piece.volume for piece in other.pieces],
            rtol=0,
            atol=1e-9,
        )
        volume, area, length = measures(pair[0])
        assert (volume, area, length) == pytest.approx((0.004, 0.04, 0.4), rel=1e-10)
    pair[0].positions["organ"][:] = pair[0].meshes["organ"].points
    pair[0].velocities["organ"][:] = 0.0
    assert pair[0].step().converged


def with_ligament(insertion: int = 4, cells: int = 8) -> ts.Mesh:
    """A bar with a skin, and a ligament of three lines that stands on a node of its top."""
    mesh = organ_mesh("tetra", cells)
    points = np.asarray(mesh.points)
    at = np.array((0.4 * insertion / cells, 0.05, 0.1))
    foot = int(np.argmin(np.linalg.norm(points - at, axis=1)))
    up = at + np.outer((0.02, 0.04, 0.06), (0, 0, 1.0))
    count = len(points)
    nodes = [foot, count, count + 1, count + 2]
    blocks = {block.type: block.nodes for block in mesh.cells}
    blocks["line"] = np.concatenate([blocks["line"], np.stack([nodes[:-1], nodes[1:]], axis=1)])
    return ts.Mesh(points=np.concatenate([points, up]), cells=blocks, thin=(2, 1))


def mass_of_ligament() -> float:
    return 1000.0 * 0.06 * SECTION


def test_a_cut_beside_a_ligament_leaves_it_where_it_stands() -> None:
    """It stands on a node; the blade passes a quarter of a cell away, on either side."""
    for x in (0.1875, 0.2125):
        simulation = scene(organ(with_ligament())).compile()
        report = simulation.cut("organ", ts.Plane((x, 0, 0), (1, 0, 0)))
        assert len(report.pieces) == 2
        (held,) = [piece for piece in report.pieces if piece.held]
        ligament = mass_of_ligament() if x > 0.2 else 0.0
        assert held.mass == pytest.approx(x / 0.4 * MASS + ligament, rel=1e-9)


@pytest.mark.parametrize("tilt", [0.2, -0.2])
def test_a_cut_through_the_foot_of_a_ligament_leaves_it_on_its_own_side(tilt: float) -> None:
    """The blade leans over: it has the ligament before it or behind it."""
    simulation = scene(organ(with_ligament())).compile()
    blade = ts.Plane((0.2, 0.05, 0.1), (1, 0, tilt))
    report = simulation.cut("organ", blade)
    assert len(report.pieces) == 2
    (held,) = [piece for piece in report.pieces if piece.held]
    # Of the volume, skin and thread on the left of the plane x = 0.2 - tilt (z - 0.1).
    own = 1000.0 * (
        (0.2 + 0.05 * tilt) * 0.01 + 0.2 * 0.1 * THICKNESS + (0.2 + 0.1 * tilt) * SECTION
    )
    ligament = mass_of_ligament() if tilt < 0 else 0.0
    assert held.mass == pytest.approx(own + ligament, rel=1e-9)


def test_a_blade_across_a_ligament_parts_it_and_one_below_its_foot_too() -> None:
    across = scene(organ(with_ligament())).compile()
    report = across.cut("organ", ts.Plane((0, 0, 0.13), (0, 0, 1)))
    assert report.pieces[1].mass == pytest.approx(0.5 * mass_of_ligament(), rel=1e-8)
    foot = scene(organ(with_ligament())).compile()
    report = foot.cut("organ", ts.Plane((0, 0, 0.1), (0, 0, 1)))
    assert len(report.pieces) == 2
    assert report.pieces[1].mass == pytest.approx(mass_of_ligament(), rel=1e-8)
    assert report.pieces[0].mass == pytest.approx(MASS, rel=1e-9)


def with_fin_and_ligaments(cell: str) -> ts.Mesh:
    """A bar with a skin and a thread, a fin along its bottom, and four ligaments on its top."""
    mesh = organ_mesh(cell)
    points, blocks = np.asarray(mesh.points), {block.type: block.nodes for block in mesh.cells}
    count, beyond, lines, fin = len(points), list[tuple[float, float, float]](), [], []

    def node(*place: float) -> int:
        return int(np.argmin(np.linalg.norm(points - place, axis=1)))

    for x in (0.1, 0.2, 0.25, 0.4):
        first = count + len(beyond)
        beyond += [(x, 0.05, 0.12), (x, 0.05, 0.15)]
        lines += [(node(x, 0.05, 0.1), first), (first, first + 1)]
    along = np.linspace(0.05, 0.35, 7)
    low = count + len(beyond) + np.arange(7)
    beyond += [(x, 0.05, -0.05) for x in along]
    high = [node(x, 0.05, 0.0) for x in along]
    for k in range(6):
        fin.append((high[k], high[k + 1], low[k + 1], low[k]))
    if cell == "tetra":
        fin = [(q[0], *q[k : k + 2]) for q in fin for k in (1, 2)]
    kind = "triangle" if cell == "tetra" else "quad"
    blocks[kind] = np.concatenate([blocks[kind], np.array(fin)])
    blocks["line"] = np.concatenate([blocks["line"], np.array(lines)])
    return ts.Mesh(points=np.concatenate([points, beyond]), cells=blocks, thin=(2, 1))


def parts_of(simulation: ts.Simulation) -> int:
    """How many parts have no point of the material in common."""
    mesh = simulation.material("organ").mesh
    group = np.arange(len(mesh.points))
    while True:
        before = group.copy()
        for block in mesh.body_blocks:
            np.minimum.at(group, block.nodes, group[block.nodes].min(axis=1)[:, None])
        if (before == group).all():
            break
    used = np.concatenate([block.nodes.ravel() for block in mesh.body_blocks])
    return len(np.unique(group[used]))


@pytest.mark.parametrize("cell", ["tetra", "hexahedron"])
@pytest.mark.parametrize("seed", range(6))
def test_random_cuts_leave_the_pieces_that_points_of_the_material_join(
    cell: str, seed: int
) -> None:
    """Eight blades, and cells that go, in a body with parts that only end at its volume."""
    random = np.random.default_rng(seed)
    made = scene(organ(with_fin_and_ligaments(cell)), fixed=[], editing=ts.Editing(room="9000 %"))
    simulation = shaken(made.compile(), seed)
    if seed % 2:
        simulation.positions["organ"][:] = simulation.meshes["organ"].points
    nodes = np.array(simulation.positions["organ"])
    for _ in range(8):
        if random.random() < 0.15:
            place = random.uniform((0, 0, 0), (0.4, 0.1, 0.1))
            simulation.ablate("organ", ts.Sphere(place, 0.03))
        before, mass = simulation.energy(), simulation._core.mass("organ")
        report = simulation.cut("organ", random_blade(random, nodes))
        require_kept(report, before, simulation.energy(), mass)
        assert len(report.pieces) == parts_of(simulation)


def test_a_skin_between_two_volumes_stays_with_one_of_them() -> None:
    """A sheet on the faces along which a blade parts them is neither lost nor doubled."""
    bar = ts.bar_mesh(size=(0.4, 0.1, 0.1), cells=(8, 2, 2), cell="tetra")
    points = np.asarray(bar.points)
    (block,) = bar.cells
    cells = np.asarray(block.nodes)
    faces = np.sort(cells[:, [(1, 2, 3), (0, 2, 3), (0, 1, 3), (0, 1, 2)]].reshape(-1, 3), axis=1)
    middle = np.unique(faces[(np.abs(points[faces][:, :, 0] - 0.2) < 1e-9).all(axis=1)], axis=0)
    assert len(middle) == 8
    mesh = ts.Mesh(points=points, cells={"tetra": cells, "triangle": middle}, thin=(2,))
    simulation = shaken(scene(organ(mesh).replace(section=None)).compile())
    simulation.positions["organ"][:] = points
    before = simulation.energy()
    report = simulation.cut("organ", ts.Plane((0.2, 0, 0), (1, 0, 0)))
    require_kept(report, before, simulation.energy())
    assert len(report.pieces) == 2
    heavy, light = sorted((piece.mass for piece in report.pieces), reverse=True)
    assert light == pytest.approx(2.0, rel=ROUND_OFF)
    assert heavy - light == pytest.approx(1000.0 * 0.01 * THICKNESS, rel=1e-8)


def test_cells_under_a_skin_go_and_the_skin_stays_on_what_is_left() -> None:
    simulation = scene().compile()
    solid = len(simulation.meshes["organ"].volume_blocks[0])
    gone = simulation.ablate("organ", ts.Box(min=(0.31, -1, 0.06), max=(0.39, 1, 0.1 - 1e-6)))
    assert gone.cells_gone > 0
    simulation.cut("organ", ts.Plane((0.1, 0, 0), (1, 0.2, 0)))
    mesh, numbers = simulation.meshes["organ"], simulation.remaining_cells("organ")
    kinds = np.concatenate([[block.type] * len(block) for block in mesh.body_blocks])
    origins = simulation.origin("organ")
    assert len(kinds) == len(numbers) == len(origins)
    assert ((kinds == "tetra") == (origins < solid)).all()
    assert simulation.step().converged


def led(threads: int) -> ts.Simulation:
    knife = ts.Knife(
        edge=[(0, 0, 0.04), (0, 0, 0.13)],
        cuts=["organ"],
        path=ts.ToolPath(times=(0.0, 0.1), positions=[(0.21, -0.013, 0.0), (0.24, 0.063, 0.0)]),
    )
    simulation = scene(
        fixed=[],
        gravity=(0, 0, 0),
        step=ts.ImplicitEuler(dt=0.005, solver=ts.ConjugateGradient(tolerance=1e-12)),
        threads=threads,
        instruments={"blade": knife},
    ).compile()
    simulation.velocities["organ"][:] = (0.3, 0, 0)
    return simulation


def test_bits_are_the_same_on_two_threads_after_a_rewind_and_from_a_checkpoint(
    tmp_path: Path,
) -> None:
    """All in the middle of an incision."""
    runs = [led(threads) for threads in (1, 2)]
    for simulation in runs:
        for _ in simulation.run(0.06):
            pass
    assert runs[0].is_cut("organ")
    require_same_ends(runs, "organ", seconds(0.04), tmp_path)
    assert len(runs[0].pieces("organ")) == 1


def test_a_tough_knife_feels_the_volume_and_not_its_skin_from_outside() -> None:
    """Beside the body its edge passes by, skin or not; the area has that of skin and thread too."""
    bar = ts.bar_mesh(size=(0.4, 0.1, 0.1), cells=(8, 2, 2), cell="tetra")
    forces, areas = [], []
    for body in (organ(), organ(bar).replace(thickness=None, section=None)):
        way = [(0.21, -0.03, 0), (0.21, 0.14, 0)]
        knife = ts.Knife(
            edge=[(0, 0, -0.1), (0, 0, 0.2)],
            cuts=["organ"],
            toughness="100 J/m^2",
            path=ts.ToolPath(times=(0, 1), positions=way),
        )
        held = [
            ts.Fixed("organ", on=ts.Box(max=(0.15, None, None))),
            ts.Fixed("organ", on=ts.Box(min=(0.25, None, None))),
        ]
        simulation = scene(
            body,
            fixed=held,
            gravity=(0, 0, 0),
            instruments={"blade": knife},
            step=ts.ImplicitEuler("10 ms"),
        ).compile()
        cuts = [cut for report in simulation.run(1.1) for cut in report.cuts]
        assert len(simulation.pieces("organ")) == 2
        areas.append(sum(cut.rest_area for cut in cuts))
        forces.append(sum(cut.work for cut in cuts) / sum(cut.area for cut in cuts))
    assert areas[0] - areas[1] == pytest.approx(0.1 * THICKNESS + SECTION, rel=1e-2)
    assert forces == pytest.approx([100.0, 100.0], rel=ROUND_OFF)


@pytest.mark.parametrize("cell", ["tetra", "hexahedron"])
def test_a_pressed_face_under_a_skin_is_pressed_once(cell: str) -> None:
    """F = p A e_z before and after a cut, though skin and volume both have the face."""
    pressure = ts.Pressure("organ", on=ts.Plane((0, 0, 0.1), (0, 0, 1)), pressure=40.0)
    simulation = scene(
        organ(organ_mesh(cell)),
        fixed=[],
        gravity=(0, 0, 0),
        loads=[pressure],
        step=EXACT.replace(dt=1e-4),
    ).compile()
    report = simulation.cut("organ", ts.Plane((0.137, 0, 0), (1, 0.2, 0.1)))
    assert len(report.pieces) == 2
    simulation.step()
    rows, _, masses = simulation._core.mass_matrix()
    mass = np.bincount(rows, masses[:, 0, 0])[: len(simulation.positions["organ"])]
    momentum = (mass[:, None] * simulation.velocities["organ"]).sum(axis=0)
    np.testing.assert_allclose(momentum, (0, 0, -40.0 * 0.04 * 1e-4), rtol=0, atol=1e-11)


def test_what_is_seen_and_written_is_the_material(tmp_path: Path) -> None:
    meshio = pytest.importorskip("meshio")
    simulation = scene(organ(with_ligament())).compile()
    simulation.cut("organ", ts.Plane((0.113, 0, 0), (1, 0.01, 0)))
    surface, material = simulation.surface("organ"), simulation.material("organ")
    sides = np.sort(np.concatenate([surface.triangles[:, [k, (k + 1) % 3]] for k in range(3)]), 1)
    assert (np.unique(sides, axis=0, return_counts=True)[1] % 2 == 0).all()  # skin adds no triangle
    origin = dict(zip(simulation.remaining_cells("organ"), simulation.origin("organ"), strict=True))
    solid = len(simulation._rest["organ"].volume_blocks[0])
    first = 0
    for block in material.mesh.body_blocks:  # in the order of the numbers of its cells
        cells = [origin[number] for number in material.cell[first : first + len(block)]]
        assert (np.array(cells) < solid).all() == (block.type == "tetra")
        first += len(block)
    write_material(tmp_path / "cut.vtu", simulation, "organ")
    read = meshio.read(tmp_path / "cut.vtu")
    assert {block.type for block in read.cells} == {"tetra", "triangle", "line"}
    assert set(np.concatenate(read.cell_data["piece"])) == {0, 1}
    for field in ("displacement", "von_mises"):
        shape = shape_of(simulation, field)
        assert len(shape.triangles) > 0
        assert np.isfinite(shape.values).all()
    assert 0.0 < simulation.quality("organ", rest=True).shape.min() <= 1.0


TABLE = {
    "obstacles": {"table": ts.PlaneObstacle((0, 0, -0.03), (0, 0, 1))},
    "contacts": [ts.Contact(("organ", "table"), friction=0.3)],
}


def test_a_piece_falls_on_a_table_and_weighs_what_it_weighs() -> None:
    body = organ(viscosity=ts.Rayleigh(mass=5, stiffness="5 ms"))
    held = [ts.Fixed("organ", on=ts.Box(max=(0.22, None, None)))]
    simulation = scene(body, fixed=held, **TABLE).compile()
    report = simulation.cut("organ", ts.Plane((0.237, 0, 0), (1, 0.02, 0)))
    (piece,) = [piece for piece in report.pieces if not piece.held]
    for _ in range(200):
        assert simulation.step().converged
    share = simulation.force_on("table").force[2] / (-9.81 * piece.mass)
    assert share == pytest.approx(1.0, rel=0.02)


@pytest.mark.parametrize("cell", ["tetra", "hexahedron"])
def test_away_from_a_cut_the_surface_in_contact_stays_as_it_was(cell: str) -> None:
    mesh = with_ligament() if cell == "tetra" else organ_mesh(cell)
    simulation = scene(organ(mesh), **TABLE).compile()
    before = triangles_of(simulation)
    simulation.cut("organ", ts.Plane((0.387, 0, 0), (1, 0, 0)))
    after = triangles_of(simulation)
    places = np.asarray(mesh.points)
    away = {t for t in before if (places[list(t)][:, 0] < 0.351).all()}
    assert len(away) > 100
    nodes = {t for t in after if min(t) >= 0 and max(t) < len(places)}
    assert away == {t for t in nodes if (places[list(t)][:, 0] < 0.351).all()}


def triangles_of(simulation: ts.Simulation) -> set[tuple[int, ...]]:
    triangles = simulation._core.contact_surface("organ")[0]
    return {tuple(sorted(int(i) for i in t)) for t in triangles}


def test_a_skin_rests_half_its_thickness_above_a_table_after_a_cut() -> None:
    """The organ lies on its skin, and a part of it too, which a blade has cut off."""
    mesh = organ_mesh()
    points = np.asarray(mesh.points)[:, [1, 0, 2]] * (1, 1, -1)  # turned over
    blocks = {block.type: block.nodes for block in mesh.cells}
    turned = ts.Mesh(points=points, cells=blocks, thin=(2, 1))
    body = organ(turned, thickness="4 mm", viscosity=ts.Rayleigh(mass=5, stiffness="5 ms"))
    table = {"obstacles": {"table": ts.PlaneObstacle((0, 0, -0.11), (0, 0, 1))}}
    made = scene(body, fixed=[], **{**TABLE, **table})
    whole, cut = made.compile(), made.compile()
    cut.cut("organ", ts.Plane((0, 0.237, 0), (0.02, 1, 0)))
    for _ in range(200):
        assert whole.step().converged
        assert cut.step().converged
    height = whole.positions["organ"][:, 2].min() + 0.11
    assert 2e-3 < height < 4e-3  # and the gap
    for piece in cut.pieces("organ"):
        lowest = cut.positions["organ"][nodes_of(cut, piece)][:, 2].min()
        assert lowest + 0.11 == pytest.approx(height, abs=2e-4)


def test_a_sheet_with_a_hem_of_lines_is_cut_in_contact() -> None:
    """Sheets and lines without a volume: both parts weigh on the table what they weigh."""
    sheet = ts.bar_mesh(size=(0.4, 0.1, 0), cells=(16, 4, 0), cell="quad")
    points = np.asarray(sheet.points)
    hem = np.flatnonzero(points[:, 1] < 1e-9)
    hem = hem[np.argsort(points[hem, 0])]
    (block,) = sheet.cells
    lines = np.stack([hem[:-1], hem[1:]], axis=1)
    mesh = ts.Mesh(points=points, cells={"quad": block.nodes, "line": lines}, thin=(2, 1))
    body = organ(mesh, law=ts.StVK(young=5e5, poisson=0.3), viscosity=ts.Rayleigh(mass=5))
    simulation = scene(body, fixed=[], **TABLE).compile()
    report = simulation.cut("organ", ts.Plane((0.187, 0, 0), (1, 0.02, 0)))
    assert len(report.pieces) == 2
    for _ in range(300):
        assert simulation.step().converged
    share = simulation.force_on("table").force[2] / (
        -9.81 * sum(piece.mass for piece in report.pieces)
    )
    assert share == pytest.approx(1.0, rel=0.02)
