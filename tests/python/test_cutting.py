"""A body that is cut keeps what it has, and goes on as its parts would have gone on alone."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tissu as ts
from cut_states import shaken

ROUND_OFF = 1e-12
"""Of sums over some thousand numbers: a few hundred times the spacing of doubles."""

CELLS = ("tetra", "hexahedron", "wedge", "pyramid", "tetra10", "hexahedron20")
MODELS = ("fem", "corotational", "mass-link", "mass-tensor", "mass-spring", "mean-dilatation")
SLANTED = ts.Plane(point=(0.213, 0.05, 0.05), normal=(1.0, 0.31, -0.27))


def bar(cell: str = "hexahedron", cells: tuple[int, int, int] = (8, 2, 2), **body: Any) -> ts.Body:
    return ts.Body(
        mesh=ts.bar_mesh(size=(0.4, 0.1, 0.1), cells=cells, cell=cell),
        **{"law": ts.StVK(young=5e4, poisson=0.3), "density": 1000.0} | body,
    )


def scene(body: ts.Body | None = None, **changes: Any) -> ts.Scene:
    return ts.Scene(
        **{
            "bodies": {"bar": bar() if body is None else body},
            "fixed": [ts.Fixed("bar", on=ts.Plane(point=(0, 0, 0), normal=(1, 0, 0)))],
            "gravity": (0.0, 0.0, -9.81),
            "step": ts.ImplicitEuler(dt=0.005),
            "editing": True,
        }
        | changes
    )


@pytest.mark.parametrize("cell", CELLS)
def test_a_cut_keeps_mass_momenta_and_energies(cell: str) -> None:
    simulation = shaken(scene(bar(cell, (4, 2, 2))).compile())
    before = simulation.energy()
    report = simulation.cut("bar", SLANTED)
    after = simulation.energy()
    assert report.cells_cut > 0
    assert len(report.pieces) == 2
    assert abs(report.mass_change) <= ROUND_OFF * 4.0  # 4 kg
    assert abs(report.volume_change) <= ROUND_OFF * 4e-3
    assert np.abs(report.momentum_change).max() <= ROUND_OFF * 4.0 * 3.0
    assert np.abs(report.angular_momentum_change).max() <= ROUND_OFF * 4.0
    for kind in ("kinetic", "elastic", "potential"):
        assert after[kind] == pytest.approx(before[kind], rel=ROUND_OFF)


@pytest.mark.parametrize("model", MODELS)
def test_a_cut_keeps_the_energy_of_every_model(model: str) -> None:
    cell = "hexahedron" if model == "mean-dilatation" else "tetra"
    linear = model in ("corotational", "mass-tensor", "mass-spring")
    law = (ts.Hooke if linear else ts.StVK)(young=5e4, poisson=0.3)
    body = bar(cell, (4, 2, 2), model=model.replace("-", "_"), law=law)
    simulation = shaken(scene(body).compile())
    before = simulation.energy()
    simulation.cut("bar", SLANTED)
    after = simulation.energy()
    for kind in ("kinetic", "elastic"):
        assert after[kind] == pytest.approx(before[kind], rel=ROUND_OFF)


def test_the_pieces_are_those_of_the_blade() -> None:
    simulation = scene(bar("tetra")).compile()
    report = simulation.cut("bar", ts.Plane(point=(0.137, 0, 0), normal=(1, 0, 0)))
    large, small = report.pieces
    assert large.volume == pytest.approx(0.263 * 0.01, rel=ROUND_OFF)
    assert small.volume == pytest.approx(0.137 * 0.01, rel=ROUND_OFF)
    assert small.held
    assert not large.held
    assert report.area == pytest.approx(0.01, rel=ROUND_OFF)
    assert report.rest_area == pytest.approx(0.01, rel=ROUND_OFF)


def nodes_of(simulation: ts.Simulation, piece: ts.Piece) -> np.ndarray[Any, Any]:
    """Nodes of the cells that hold a piece."""
    mesh, numbers = simulation.meshes["bar"], simulation.remaining_cells("bar")
    chosen, first, nodes = np.isin(numbers, piece.cells), 0, []
    for block in mesh.body_blocks:
        nodes.append(block.nodes[chosen[first : first + len(block)]].ravel())
        first += len(block)
    return np.unique(np.concatenate(nodes))


@pytest.mark.parametrize("cell", ["tetra", "hexahedron"])
def test_a_cut_on_faces_leaves_two_bars(cell: str) -> None:
    """The held one goes on as a bar that was built alone, to the tolerance of the solver."""
    step = ts.ImplicitEuler(dt=0.005, solver=ts.ConjugateGradient(tolerance=1e-12))
    whole = scene(bar(cell), step=step).compile()
    report = whole.cut("bar", ts.Plane(point=(0.2, 0, 0), normal=(1, 0, 0)))
    short = bar().replace(mesh=ts.bar_mesh(size=(0.2, 0.1, 0.1), cells=(4, 2, 2), cell=cell))
    apart = scene(short, step=step).compile()
    for _ in range(50):
        whole.step()
        apart.step()
    (held,) = [piece for piece in report.pieces if piece.held]
    mine, rest = nodes_of(whole, held), whole.meshes["bar"].points
    mine = mine[np.lexsort(rest[mine].T.round(9))]
    other = np.lexsort(apart.meshes["bar"].points.T.round(9))
    assert len(mine) == len(other) == 45
    np.testing.assert_allclose(
        whole.positions["bar"][mine], apart.positions["bar"][other], rtol=0, atol=1e-10 * 0.4
    )


def test_a_piece_that_nothing_holds_falls_freely() -> None:
    """Backward Euler from rest: after n steps it has fallen by g h^2 n (n + 1) / 2."""
    step = ts.ImplicitEuler(dt=0.005, solver=ts.ConjugateGradient(tolerance=1e-12))
    simulation = scene(bar("tetra"), step=step).compile()
    report = simulation.cut("bar", SLANTED)
    (free,) = [piece for piece in report.pieces if not piece.held]
    for _ in range(20):
        simulation.step()
    fallen = simulation.displacements("bar")[nodes_of(simulation, free)]
    expected = [0.0, 0.0, -9.81 * 0.005**2 * 20 * 21 / 2]
    np.testing.assert_allclose(fallen, np.broadcast_to(expected, fallen.shape), rtol=0, atol=1e-9)


def test_a_slit_opens_and_stays_one_piece() -> None:
    simulation = scene(bar("tetra", (12, 4, 4))).compile()
    blade = ts.Triangles(
        points=[(0.15, -0.1, 0.06), (0.15, 0.2, 0.06), (0.15, 0.2, 0.2), (0.15, -0.1, 0.2)],
        triangles=[(0, 1, 2), (0, 2, 3)],
    )
    report = simulation.cut("bar", blade)
    assert len(report.pieces) == 1
    assert report.area > 0.0
    for _ in range(40):
        assert simulation.step().converged
    surface = simulation.surface("bar")
    lips = surface.points[np.unique(surface.triangles[surface.cut])]
    top = lips[lips[:, 2] > lips[:, 2].max() - 0.02]
    assert np.ptp(top[:, 0]) > 1e-3  # the bar hangs, so that its upper side is in tension


def closed(triangles: np.ndarray[Any, Any]) -> bool:
    """Whether every side of a triangle is met as often one way as the other."""
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    ways: dict[tuple[int, int], int] = {}
    for a, b in sides.tolist():
        ways[min(a, b), max(a, b)] = ways.get((min(a, b), max(a, b)), 0) + (1 if a < b else -1)
    return not any(ways.values())


def test_surface_and_material_are_whole() -> None:
    simulation = shaken(scene(bar("hexahedron")).compile())
    simulation.cut("bar", SLANTED)
    surface = simulation.surface("bar")
    assert closed(surface.triangles)
    assert surface.cut.any()
    np.testing.assert_allclose(surface.weights.sum(axis=1), 1.0, rtol=0, atol=ROUND_OFF)
    material = simulation.material("bar")
    at_rest = sum(
        abs(np.linalg.det(material.mesh.points[row[1:]] - material.mesh.points[row[0]])) / 6
        for block in material.mesh.volume_blocks
        if block.type == "tetra"
        for row in block.nodes
    )
    uncut = sum(len(b.nodes) for b in material.mesh.volume_blocks if b.type == "hexahedron")
    assert at_rest + uncut * 0.05**3 == pytest.approx(4e-3, rel=ROUND_OFF)
    assert len(material.cell) == material.mesh.cell_count


def test_numbers_stay_and_new_ones_follow() -> None:
    simulation = scene().compile()
    rest = simulation.meshes["bar"]
    places = np.array(simulation.positions["bar"])
    simulation.cut("bar", SLANTED)
    mesh = simulation.meshes["bar"]
    np.testing.assert_array_equal(mesh.points[: rest.node_count], rest.points)
    np.testing.assert_array_equal(simulation.positions["bar"][: len(places)], places)
    numbers = simulation.remaining_cells("bar")
    old = numbers[numbers < rest.cell_count]
    assert len(old) < rest.cell_count
    assert (numbers[len(old) :] >= rest.cell_count).all()
    origin = simulation.origin("bar")
    np.testing.assert_array_equal(origin[: len(old)], old)
    assert set(origin.tolist()) == set(range(rest.cell_count))
    born = simulation.born("bar")
    np.testing.assert_array_equal(born[: rest.node_count], np.arange(rest.node_count))
    np.testing.assert_array_equal(mesh.points, rest.points[born])


def test_another_body_is_not_touched() -> None:
    bodies = {"bar": bar(), "other": bar("tetra", (4, 2, 2))}
    one, two = scene(bodies=bodies).compile(), scene(bodies=bodies).compile()
    view = one.positions["other"]
    one.cut("bar", SLANTED)
    assert np.shares_memory(view, one.positions["other"])
    np.testing.assert_array_equal(one.positions["other"], two.positions["other"])
    assert not one.cut("other", ts.Disc((5.0, 0, 0), (1, 0, 0), "1 cm")).cells_cut


def test_held_nodes_stay_held_and_loads_stay_whole() -> None:
    """A blade along the bar, through its held end and its loaded one."""
    load = ts.NodalLoad(
        "bar", on=ts.Plane(point=(0.4, 0, 0), normal=(1, 0, 0)), force=(0.0, 3.0, 0.0)
    )
    simulation = scene(gravity=None, loads=[load], step=ts.Static()).compile()
    report = simulation.cut("bar", ts.Plane(point=(0, 0, 0.037), normal=(0.0, 0.0, 1.0)))
    assert [piece.held for piece in report.pieces] == [True, True]
    forces = simulation.forces()[simulation.rows("bar")]
    np.testing.assert_allclose(forces.sum(axis=0), [0.0, 3.0, 0.0], rtol=0, atol=1e-12)
    assert simulation.step().converged
    held = simulation.reactions("bar").sum(axis=0)
    np.testing.assert_allclose(held, [0.0, -3.0, 0.0], rtol=0, atol=3e-5)  # of the solver


@pytest.mark.parametrize("threads", [2, 3])
def test_cuts_have_the_same_bits_on_any_number_of_threads(threads: int) -> None:
    one, more = scene().compile(), scene(threads=threads).compile()
    for simulation in (one, more):
        simulation.cut("bar", SLANTED)
        for _ in range(5):
            simulation.step()
        simulation.cut("bar", ts.Disc((0.1, 0.05, 0.05), (0, 1, 0.2), 0.04))
        for _ in range(5):
            simulation.step()
    np.testing.assert_array_equal(one.positions["bar"], more.positions["bar"])


def prony() -> ts.Body:
    branch = ts.Prony(branches=[ts.PronyBranch(weight=0.3, time=0.05)])
    return bar("tetra", (6, 2, 2), viscosity=branch)


STEPS = {
    "implicit_euler": ts.ImplicitEuler(dt=0.005),
    "bdf2": ts.BDF2(dt=0.005),
    "newmark": ts.Newmark(dt=0.005),
    "symplectic_euler": ts.SymplecticEuler(dt=0.0002),
}


@pytest.mark.parametrize("step", STEPS.values(), ids=STEPS)
@pytest.mark.parametrize("body", [bar(), prony()], ids=["elastic", "prony"])
def test_checkpoint_mark_and_parameters_go_on_with_the_same_bits(
    body: ts.Body, step: ts.Step, tmp_path: Path
) -> None:
    made = scene(body, step=step)
    simulation = made.compile()
    for _ in range(3):
        simulation.step()
    simulation.cut("bar", SLANTED)
    simulation.step()
    simulation.cut("bar", ts.Disc((0.1, 0.05, 0.05), (0.1, 1, 0.2), 0.04))
    simulation.step()
    simulation.remove_cells(body="bar", cells=simulation.remaining_cells("bar")[-2:])
    simulation.step()
    simulation.save_checkpoint(tmp_path / "cut.tissu")
    mark = simulation.mark()
    resumed = made.compile(checkpoint=tmp_path / "cut.tissu")
    ends = []
    for one in (simulation, resumed):
        for _ in range(3):
            one.step()
        ends.append((np.array(one.positions["bar"]), np.array(one.velocities["bar"])))
    simulation.cut("bar", ts.Plane(point=(0.3, 0, 0), normal=(1, 0, 0)))
    simulation.step()
    simulation.rewind(mark)
    for _ in range(3):
        simulation.step()
    ends.append((np.array(simulation.positions["bar"]), np.array(simulation.velocities["bar"])))
    for places, speeds in ends[1:]:
        np.testing.assert_array_equal(places, ends[0][0])
        np.testing.assert_array_equal(speeds, ends[0][1])
    assert resumed.meshes["bar"].node_count == simulation.meshes["bar"].node_count


@pytest.mark.parametrize("body", [bar("tetra", (6, 2, 2)), prony()], ids=["elastic", "prony"])
def test_a_parameter_changes_a_body_that_was_cut(body: ts.Body) -> None:
    """The same value written again changes nothing: cuts and what materials remember go along."""
    step = ts.ImplicitEuler(dt=0.005, solver=ts.ConjugateGradient(tolerance=1e-12))
    one, other = scene(body, step=step).compile(), scene(body, step=step).compile()
    for simulation in (one, other):
        for _ in range(3):
            simulation.step()
        simulation.cut("bar", SLANTED)
        simulation.step()
    one.parameters["gravity.z"] = -9.81
    for simulation in (one, other):
        for _ in range(3):
            simulation.step()
    np.testing.assert_allclose(
        one.positions["bar"], other.positions["bar"], rtol=0, atol=1e-9
    )  # the solver begins anew
    one.reset()
    assert one.meshes["bar"].node_count == 7 * 3 * 3
    assert not one.surface("bar").cut.any()


def test_a_grab_whose_point_parts_is_released() -> None:
    simulation = scene(grabbing=True).compile()
    near = simulation.grab("bar", 40, (0.0, 0.0, 0.0), 10.0)
    far = simulation.grab("bar", simulation.meshes["bar"].node_count - 1, (0.5, 0, 0), 10.0)
    node = int(np.argmin(np.abs(simulation.meshes["bar"].points[:, 0] - 0.2)))
    parted = simulation.grab("bar", node, (0.0, 0.0, 0.0), 10.0)
    report = simulation.cut("bar", ts.Plane(point=(0.21, 0, 0), normal=(1, 0, 0)))
    assert parted.released
    assert len(report.released) >= 1
    assert not far.released
    assert [near.number, far.number, parted.number] == [1, 2, 3]
    assert parted.number in report.released
    assert near.released == (near.number in report.released)
    assert [grab.number for grab in simulation.grabs] == [
        grab.number for grab in (near, far) if not grab.released
    ]


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda s: s.cut("bar", SLANTED, refine="no"), "refine='no' .* True and False"),
        (lambda s: s.cut(["bar"], SLANTED), r"found body \['bar'\]; accepted: bar"),
        (lambda s: s.pieces(None), "found body None; accepted: bar"),
        (lambda s: s.remove_cells(body="bar", cells=[[1, 2]]), r"shape \(1, 2\); .* one row"),
        (lambda s: s.remove_cells(body=["bar"], cells=[1]), "no body is named"),
    ],
)
def test_arguments_of_another_kind_are_refused(call: Any, words: str) -> None:
    simulation = scene().compile()
    with pytest.raises(ts.ParameterError, match=words):
        call(simulation)
    assert simulation.meshes["bar"].cell_count == scene().compile().meshes["bar"].cell_count


def test_what_cannot_be_cut_is_refused_and_stays() -> None:
    with pytest.raises(ts.ParameterError, match="compiled without editing"):
        scene(editing=False).compile().cut("bar", SLANTED)
    simulation = scene().compile()
    before = np.array(simulation.positions["bar"])
    for blade, words in (
        (ts.Disc((0, 0, 0), (0, 0, 0), 0.1), "normal"),
        (ts.Disc((0, 0, np.nan), (0, 0, 1), 0.1), "finite"),
        (ts.Triangles([(0, 0, 0), (1, 0, 0)], [(0, 1, 2)]), "0 to 1 are accepted"),
        (ts.Sweep([[(0, 0, 0)]]), "shape"),
        (ts.Disc((0, 0, 0), (1, 0, 0), 1e16), "1e\\+16 m; at most .* 1e12 times the size"),
        (ts.Plane((1e16, 0, 0), (0, 1, 1)), "1e12 times the size"),
        (ts.Sweep([[(0, -1, 0), (0, 1, 0)], [(0, -1, 1e20), (0, 1, 0)]]), "1e12 times the size"),
        ("knife", "as a blade"),
    ):
        with pytest.raises(ts.ParameterError, match=words):
            simulation.cut("bar", blade)  # type: ignore[arg-type]
    with pytest.raises(ts.ParameterError, match="accepted: bar"):
        simulation.cut("liver", SLANTED)
    np.testing.assert_array_equal(simulation.positions["bar"], before)
    tight = scene(editing=ts.Editing(room="1 %")).compile()
    with pytest.raises(ts.ParameterError, match="there is room for 1"):
        tight.cut("bar", SLANTED)
    assert tight.meshes["bar"].node_count == 81
    assert tight.step().converged


def test_a_static_body_keeps_its_pieces_held() -> None:
    stiff = bar(law=ts.StVK(young=5e6, poisson=0.3))
    simulation = scene(stiff, step=ts.Static()).compile()
    simulation.step()
    before = np.array(simulation.positions["bar"])
    with pytest.raises(ts.ParameterError, match="without support"):
        simulation.cut("bar", SLANTED)
    np.testing.assert_array_equal(simulation.positions["bar"], before)
    centres = simulation.meshes["bar"].points[simulation.meshes["bar"].cells[0].nodes].mean(axis=1)
    across = np.flatnonzero(np.abs(centres[:, 0] - 0.2) < 0.03)
    with pytest.raises(ts.ParameterError, match="1 of 2 pieces of body 'bar' without support"):
        simulation.remove_cells(body="bar", cells=across)
    assert simulation.meshes["bar"].cell_count == len(centres)
    corners = [(0.13, -1, 0.06), (0.13, 1, 0.06), (0.13, 1, 1), (0.13, -1, 1)]
    slit = ts.Triangles(corners, [(0, 1, 2), (0, 2, 3)])
    assert simulation.cut("bar", slit).cells_cut
    assert simulation.step().converged


def test_a_static_piece_may_be_held_by_different_nodes_on_each_axis() -> None:
    end = {"max": (0.0, None, None)}
    fixed = [
        ts.Fixed("bar", on=ts.Box(**end, min=(None, None, 0.06)), axes="x"),
        ts.Fixed("bar", on=ts.Box(max=(0.0, None, 0.01)), axes="yz"),
    ]
    stiff = bar(law=ts.StVK(young=5e6, poisson=0.3))
    simulation = scene(stiff, step=ts.Static(), fixed=fixed).compile()
    assert [piece.held for piece in simulation.pieces("bar")] == [True]
    corners = [(0.13, -1, 0.06), (0.13, 1, 0.06), (0.13, 1, 1), (0.13, -1, 1)]
    assert simulation.cut("bar", ts.Triangles(corners, [(0, 1, 2), (0, 2, 3)])).cells_cut


@pytest.mark.parametrize("cell", ["tetra", "hexahedron", "wedge"])
def test_cuts_after_removed_cells_keep_all_material(cell: str) -> None:
    """Cells that the removed ones left joined at an edge or a node alone come apart in a cut."""
    for seed in range(8):
        random = np.random.default_rng(seed)
        simulation = scene(bar(cell, (4, 2, 2)), editing=ts.Editing(room=20.0)).compile()
        count = simulation.meshes["bar"].cell_count
        gone = random.choice(count, size=random.integers(1, count // 4), replace=False)
        simulation.remove_cells(body="bar", cells=gone)
        before = simulation.meshes["bar"].volume()
        for _ in range(2):
            point = tuple(random.uniform(0.0, 1.0, 3) * (0.4, 0.1, 0.1))
            simulation.cut("bar", ts.Plane(point, tuple(random.normal(size=3))))
        pieces = simulation.pieces("bar")
        for volume in (
            sum(piece.volume for piece in pieces),
            sum(piece.mass for piece in pieces) / 1000.0,
            simulation.material("bar").mesh.volume(),
        ):
            assert volume == pytest.approx(before, rel=ROUND_OFF), seed
        simulation.surface("bar")
        simulation.quality("bar")


def test_a_way_back_of_a_blade_does_not_undo_the_way_in() -> None:
    edges = [[(0.213, y, -0.1), (0.213, y, 0.2)] for y in (-0.05, 0.06, -0.05)]
    reports = []
    for moments in (edges[:2], edges):
        simulation = scene(bar("tetra", (8, 4, 4))).compile()
        reports.append(simulation.cut("bar", ts.Sweep(moments)))
    assert reports[0].cells_cut > 0
    assert reports[1].area == pytest.approx(reports[0].area, rel=1e-12)
    assert reports[1].cells_cut == reports[0].cells_cut
    corners = [(0.213, -1, -1), (0.213, 3, -1), (0.213, -1, 3)]
    for times in (1, 2, 3):
        simulation = scene().compile()
        report = simulation.cut("bar", ts.Triangles(corners, [(0, 1, 2)] * times))
        assert len(report.pieces) == 2


def test_values_of_too_few_nodes_are_refused() -> None:
    simulation = scene().compile()
    simulation.cut("bar", SLANTED)
    for found in (simulation.material("bar"), simulation.surface("bar")):
        values = simulation.positions["bar"]
        assert found.carried(values) == pytest.approx(found.points, abs=1e-12)
        with pytest.raises(ts.ParameterError, match=r"shape \(3, 3\); a row for each node"):
            found.carried(values[:3])
        with pytest.raises(ts.ParameterError, match="real numbers"):
            found.carried("text")  # type: ignore[arg-type]


def test_ablation_takes_cells_by_their_material() -> None:
    simulation = scene().compile()
    report = simulation.ablate("bar", ts.Sphere((0.4, 0.1, 0.1), 0.06))
    assert report.cells_gone == 1
    assert report.volume_change == pytest.approx(-(0.05**3), rel=ROUND_OFF)
    assert report.mass_change == pytest.approx(-0.125, rel=ROUND_OFF)
    assert simulation.step().converged
    assert not simulation.ablate("bar", ts.Sphere((2, 2, 2), 0.1)).cells_gone
    with pytest.raises(ts.ParameterError, match="leave no cell"):
        simulation.ablate("bar", ts.Sphere((0, 0, 0), 5.0))


def test_live_supports_and_loads_keep_their_nodes_while_they_are_live() -> None:
    """A blade through nodes of both parts them; live numbers are one for each node."""
    root = ts.Fixed("bar", on=ts.Plane(point=(0, 0, 0), normal=(1, 0, 0)), name="root")
    end = ts.Plane(point=(0.4, 0, 0), normal=(1, 0, 0))
    pull = ts.NodalLoad("bar", on=end, force=(0.0, 1.0, 0.0), name="pull")
    through_nodes = ts.Plane(point=(0, 0, 0.05), normal=(0, 0, 1))
    made = scene(fixed=[root], loads=[pull], gravity=None)

    led = made.compile()
    led.lead("root").move((0, 0, 0.01))
    with pytest.raises(ts.ParameterError, match=r'support "root", which is led live'):
        led.cut("bar", through_nodes)
    assert led.step().converged
    assert led.meshes["bar"].node_count == 81

    loaded = made.compile()
    loaded.load("pull").force = (0.0, 5.0, 0.0)
    with pytest.raises(ts.ParameterError, match=r"loads\[0\]\), which was changed"):
        loaded.cut("bar", through_nodes)

    after = made.compile()
    assert len(after.cut("bar", through_nodes).pieces) == 2
    assert after.forces()[after.rows("bar")].sum(axis=0) == pytest.approx([0, 1, 0], abs=1e-12)
    with pytest.raises(ts.ParameterError, match="whose nodes a cut has parted"):
        after.load("pull").force = (0.0, 5.0, 0.0)
    after.lead("root").move((0, 0, 0.01))
    assert after.step().converged
    held = np.flatnonzero(np.abs(after.meshes["bar"].points[:, 0]) < 1e-9)
    np.testing.assert_allclose(after.displacements("bar")[held, 2], 0.01, rtol=0, atol=1e-12)


def test_rewind_brings_the_parameters_back() -> None:
    simulation = scene().compile()
    simulation.step()
    mark = simulation.mark()
    ends = []
    for young in (5e4, 9e4):
        simulation.parameters["bodies.bar.law.young"] = young
        simulation.step()
        simulation.rewind(mark)
        assert simulation.parameters["bodies.bar.law.young"] == 5e4
        simulation.step()
        ends.append(np.array(simulation.positions["bar"]))
        simulation.rewind(mark)
    np.testing.assert_array_equal(ends[0], ends[1])


@pytest.mark.parametrize(
    "body", [bar("tetra", (6, 2, 2)), bar(), prony()], ids=["tetra", "hexahedron", "prony"]
)
def test_forces_of_copies_add_up_to_those_of_their_nodes(body: ts.Body) -> None:
    """What a viscous material remembers is in them: it has been sheared for a while."""
    simulation = shaken(scene(body, step=ts.ImplicitEuler(dt=0.001)).compile())
    for _ in range(3):
        simulation.step()
    before = simulation.forces()[simulation.rows("bar")]
    simulation.cut("bar", SLANTED)
    after = np.zeros_like(before)
    np.add.at(after, simulation.born("bar"), simulation.forces()[simulation.rows("bar")])
    np.testing.assert_allclose(after, before, rtol=0, atol=1e-11 * np.abs(before).max())


@pytest.mark.parametrize("step", STEPS.values(), ids=STEPS)
def test_a_body_that_falls_goes_on_falling_as_it_is_cut(step: ts.Step) -> None:
    """Nothing strains it, so that its parts move as it would have: histories are carried too.

    BDF2 begins anew where a body comes apart, as from the start: a step of backward Euler is ahead
    by g h^2 / 2, and those after it by up to three halves of that.
    """
    if hasattr(step, "solver"):
        step = step.replace(solver=ts.ConjugateGradient(tolerance=1e-12))
    one, other = (scene(fixed=[], step=step).compile() for _ in range(2))
    for number in range(8):
        if number == 4:
            assert len(one.cut("bar", SLANTED).pieces) == 2
        one.step()
        other.step()
    expected = other.displacements("bar")[one.born("bar")]
    ahead = 0.75 * 9.81 * step.dt**2 if isinstance(step, ts.BDF2) else 0.0
    np.testing.assert_allclose(one.displacements("bar"), expected, rtol=0, atol=1e-12 + ahead)
    np.testing.assert_allclose(
        one.velocities["bar"], other.velocities["bar"][one.born("bar")], atol=1e-9
    )
    assert np.abs(expected).max() > 1e-6


@pytest.mark.parametrize("cell", ["tetra", "hexahedron"])
def test_the_energy_that_an_ablation_takes_is_reported_with_its_branches(cell: str) -> None:
    """Of a Prony series too, whose springs hold as much as the law at once: g = 1."""
    body = ts.Body(
        mesh=ts.BarMesh(size=(0.2, 0.05, 0.05), cells=(8, 2, 2), cell=cell),
        law=ts.StableNeoHooke(young=5e4, poisson=0.4),
        density=1000,
        viscosity=ts.Prony(branches=[ts.PronyBranch(weight=1.0, time="0.5 s")]),
    )
    simulation = ts.Scene(
        bodies={"bar": body},
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        gravity=(0, 0, -9.81),
        step=ts.ImplicitEuler("10 ms"),
        editing=True,
    ).compile()
    for _ in range(5):
        simulation.step()
    before = simulation.energy()["elastic"]
    report = simulation.ablate("bar", ts.Box((0.15, None, None), (0.18, None, None)))
    change = simulation.energy()["elastic"] - before
    assert change < 0.0
    assert report.elastic_energy_change == pytest.approx(change, rel=1e-9)
