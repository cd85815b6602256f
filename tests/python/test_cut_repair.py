"""Bad cells that cuts leave are repaired: what stays, what rises, and what is refused."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

import tissu as ts
from divided import (
    DENSITY,
    EXACT,
    SIZE,
    Array,
    bar,
    fault_of_mesh,
    jittered,
    pieces_by_faces,
    qualities,
    scene,
    tetrahedra,
    volumes,
)
from tissu.output.summary import cut_record

ROUND_OFF = 1e-12
"""Of sums over some thousand numbers: a few hundred times the spacing of doubles."""
MASS = DENSITY * SIZE[0] * SIZE[1] * SIZE[2]
BLADES = (
    ts.Plane(point=(0.2, 0.05, 0.05), normal=(1.0, 0.4, -0.2)),
    ts.Plane(point=(0.205, 0.05, 0.05), normal=(1.0, -0.3, 0.25)),
    ts.Plane(point=(0.2, 0.05, 0.045), normal=(0.2, 0.1, 1.0)),
)
"""Three cuts through each other leave short edges and flat cells."""


def repairing(
    body: ts.Body | None = None, *, method: str = "subdivide", repair: Any = True, **changes: Any
) -> ts.Scene:
    """A scene whose cuts are repaired; `repair`: the part, or whether there is one."""
    part = (ts.Repair() if repair else None) if isinstance(repair, bool) else repair
    editing = ts.Editing(method=method, room="900 %", repair=part)
    own = bar(mesh=jittered((8, 3, 3), 3)) if body is None else body
    return scene(own, **{"editing": editing} | changes)


def free(body: ts.Body | None = None, **changes: Any) -> ts.Simulation:
    return repairing(body, **{"fixed": [], "gravity": None} | changes).compile()


def bent(simulation: ts.Simulation, curve: float = 0.1) -> ts.Simulation:
    """The bar is drawn and a little bent, and its ends are faster than its middle."""
    x, v = simulation.positions["bar"], simulation.velocities["bar"]
    rest = np.array(x)
    x[:, 0] *= 1.2
    x[:, 1] += curve * rest[:, 0] ** 2
    x[:, 0] -= 2 * curve * rest[:, 0] * (rest[:, 1] - 0.05)
    v[:] = np.cross((0.3, -1.0, 2.0), x) + 4.0 * rest[:, :1] ** 2 * (0.0, 1.0, -1.0)
    return simulation


def bits(simulation: ts.Simulation) -> tuple[bytes, ...]:
    return (
        simulation.positions["bar"].tobytes(),
        simulation.velocities["bar"].tobytes(),
        tetrahedra(simulation).tobytes(),
        np.asarray(simulation.meshes["bar"].points).tobytes(),
    )


def made(report: ts.CutReport) -> ts.Repairs:
    assert report.repairs is not None
    return report.repairs


@pytest.mark.parametrize("method", ["subdivide", "snap"])
@pytest.mark.parametrize("seed", range(3))
def test_repairs_keep_what_they_must(method: str, seed: int) -> None:
    """Beside the same cuts without repair; the jump may be large so that much is done.

    Momenta are compared with those without repair, of which divided cells keep angular momentum
    only nearly.
    """
    random = np.random.default_rng(seed)
    body, done = bar(mesh=jittered((8, 3, 3), seed)), 0
    for _ in range(3):
        blade = ts.Plane(random.uniform(0.3, 0.8, 3) * SIZE, random.standard_normal(3))
        both = [
            bent(free(body, method=method, repair=part))
            for part in (ts.Repair(below=0.2, jump=0.2), False)
        ]
        reports = [[one.cut("bar", each) for each in (*BLADES[:2], blade)] for one in both]
        done += sum(made(report).operations for report in reports[0])
        assert all(report.repairs is None for report in reports[1])
        assert fault_of_mesh(both[0]) == ""
        assert len(reports[0][-1].pieces) == pieces_by_faces(both[0])
        for report in reports[0]:
            repairs = made(report)
            assert repairs.least_quality_after >= repairs.least_quality_before
            assert repairs.bad_after <= repairs.bad_before
        first, second = (one._core.totals("bar") for one in both)
        assert first["volume"] == pytest.approx(4e-3, rel=1e-13)
        assert first["mass"] == pytest.approx(MASS, rel=1e-13)
        np.testing.assert_allclose(
            first["momentum"], second["momentum"], rtol=0, atol=ROUND_OFF * MASS
        )
    assert done > 10


def test_a_repair_gives_the_momenta_back() -> None:
    """One cut, so that the state before the repair is the same with and without it."""
    both = [bent(free(repair=part)) for part in (ts.Repair(below=0.3, jump=1.0), False)]
    reports = [one.cut("bar", BLADES[0]) for one in both]
    assert made(reports[0]).operations > 3
    first, second = (one._core.totals("bar") for one in both)
    for name in ("momentum", "angular_momentum"):
        np.testing.assert_allclose(first[name], second[name], rtol=0, atol=ROUND_OFF * MASS)
    jump = first["elastic"] - second["elastic"]
    assert made(reports[0]).elastic_energy_change == pytest.approx(jump, rel=1e-9)
    change = reports[0].elastic_energy_change
    assert change == pytest.approx(reports[1].elastic_energy_change + jump, rel=1e-9)


def test_a_linear_field_stays() -> None:
    """x = A X is read without an error anywhere, so that no energy and no momentum changes."""
    A = np.array([[1.1, 0.05, 0.0], [-0.02, 0.95, 0.04], [0.03, 0.0, 1.02]])
    simulation = free(repair=ts.Repair(below=0.3))
    rest = np.array(simulation.positions["bar"])
    simulation.positions["bar"][:] = rest @ A.T
    elastic = simulation.energy()["elastic"]
    kinds = np.zeros(3)
    for blade in BLADES:
        repairs = made(simulation.cut("bar", blade))
        kinds += (repairs.collapses, repairs.flips, repairs.moves)
    assert (kinds > 0).all()
    X = simulation.meshes["bar"].points
    np.testing.assert_allclose(simulation.positions["bar"], X @ A.T, rtol=0, atol=1e-14)
    assert simulation.energy()["elastic"] == pytest.approx(elastic, rel=1e-10)


def test_the_energy_jumps_by_no_more_than_is_allowed() -> None:
    """The bound is one of each operation; together they change the body by less than that share."""
    done, curve = [], 0.3
    for jump in (0.0, 0.001, 0.01, 1.0):
        simulation = bent(free(repair=ts.Repair(below=0.3, jump=jump)), curve)
        elastic = simulation.energy()["elastic"]
        repairs = made(simulation.cut("bar", BLADES[0]))
        done.append(repairs.operations)
        assert abs(repairs.elastic_energy_change) <= jump * elastic + 1e-9 * elastic
    assert done[0] < min(done[1:])


@pytest.mark.parametrize("step", [ts.ImplicitEuler(dt=0.005), ts.BDF2(dt=0.005)])
def test_steps_after_a_repair_converge(step: ts.Step) -> None:
    simulation = repairing(step=step).compile()
    for blade in BLADES:
        assert made(simulation.cut("bar", blade)).bad_before
        for _ in range(3):
            assert simulation.step().converged


@pytest.mark.parametrize("seed", [2, 6, 9])
def test_explicit_steps_are_longer_after_a_repair(seed: int) -> None:
    """The stable step is measured after each of three cuts, with and without repair.

    It is longer by a half; of ten such bodies it is so in four, and about the same in the others,
    where a cell that nothing repairs has the highest frequency.
    """
    random, longest = np.random.default_rng(seed), []
    blades = [
        ts.Plane(random.uniform(0.3, 0.7, 3) * SIZE, random.standard_normal(3)) for _ in range(3)
    ]
    for repair in (True, False):
        body = bar(mesh=jittered((8, 4, 4), seed))
        simulation = free(body, repair=repair, step=ts.SymplecticEuler())
        reports = [simulation.cut("bar", blade) for blade in blades]
        longest.append(reports[-1].stable_step)
    assert longest[0] > 1.4 * longest[1]


def test_without_bad_cells_nothing_changes() -> None:
    """The same bits as without repair."""
    ended = []
    for part in (ts.Repair(below=1e-6), False):
        simulation = repairing(repair=part).compile()
        simulation.step()
        for blade in BLADES:
            report = simulation.cut("bar", blade)
            simulation.step()
        ended.append(bits(simulation))
        assert report.repairs is None or report.repairs.operations == 0
    assert ended[0] == ended[1]


def run(simulation: ts.Simulation, blades: Any) -> list[ts.CutReport]:
    reports = []
    for blade in blades:
        reports.append(simulation.cut("bar", blade))
        simulation.step()
    return reports


def test_the_same_bits_for_any_number_of_threads() -> None:
    ended = []
    for threads in (1, 2, 4):
        simulation = repairing(threads=threads).compile()
        assert sum(made(report).operations for report in run(simulation, BLADES)) > 5
        ended.append(bits(simulation))
    assert ended[0] == ended[1] == ended[2]


@pytest.mark.parametrize("method", ["subdivide", "snap"])
def test_checkpoints_and_rewind_give_the_same_bits(method: str, tmp_path: Any) -> None:
    """Two repaired cuts; from there a third one and its repair."""
    made_of = repairing(method=method, repair=ts.Repair(below=0.25, jump=0.1))
    simulation = made_of.compile()
    assert sum(made(report).operations for report in run(simulation, BLADES[:2])) > 2
    mark, now = simulation.mark(), bits(simulation)
    simulation.save_checkpoint(tmp_path / "repaired.tissu")
    run(simulation, BLADES[2:])
    expected = bits(simulation)
    resumed = made_of.compile(checkpoint=tmp_path / "repaired.tissu")
    assert bits(resumed) == now
    run(resumed, BLADES[2:])
    assert bits(resumed) == expected
    simulation.save_checkpoint(tmp_path / "last.tissu")
    assert bits(made_of.compile(checkpoint=tmp_path / "last.tissu")) == expected
    simulation.rewind(mark)
    assert bits(simulation) == now
    run(simulation, BLADES[2:])
    assert bits(simulation) == expected


def test_new_nodes_on_repaired_edges_may_have_no_place_of_the_first_day(tmp_path: Any) -> None:
    """Between five nodes of the first day and more; files keep them."""
    random = np.random.default_rng(9)
    made_of = repairing(
        bar(mesh=jittered((4, 3, 3), 9)), fixed=[], gravity=None, repair=ts.Repair(below=0.3)
    )
    simulation = made_of.compile()
    for _ in range(3):
        point = random.uniform(0.4, 0.6, 3) * SIZE
        simulation.cut("bar", ts.Plane(point, random.standard_normal(3)))
    nodes, weights = simulation.made_of("bar")
    unknown = (nodes < 0).all(axis=1)
    assert unknown.any()
    assert (weights[unknown] == 0.0).all()
    assert (simulation.born("bar")[unknown] == -1).all()
    X = simulation.meshes["bar"].points
    assert fault_of_mesh(simulation) == ""
    assert volumes(X, tetrahedra(simulation)).sum() == pytest.approx(4e-3, rel=1e-13)
    simulation.step()
    simulation.save_checkpoint(tmp_path / "unknown.tissu")
    resumed = made_of.compile(checkpoint=tmp_path / "unknown.tissu")
    assert bits(resumed) == bits(simulation)
    simulation.cut("bar", BLADES[0])
    resumed.cut("bar", BLADES[0])
    assert bits(resumed) == bits(simulation)


def test_numbers_live_for_ever() -> None:
    """A cell that goes takes its number along, and a node without cells stays in its place."""
    simulation = free()
    run(simulation, BLADES[:1])
    known = dict(zip(simulation.remaining_cells("bar"), simulation.origin("bar"), strict=True))
    places = np.array(simulation.meshes["bar"].points)
    report = simulation.cut("bar", BLADES[1])
    assert made(report).collapses
    left = simulation.remaining_cells("bar")
    assert (np.diff(left) > 0).all()
    for cell, origin in zip(left, simulation.origin("bar"), strict=True):
        assert known.get(cell, origin) == origin
    assert len(simulation.meshes["bar"].points) >= len(places)
    unused = np.setdiff1d(np.arange(len(simulation.positions["bar"])), tetrahedra(simulation))
    assert len(unused) >= made(report).collapses
    held = np.array(simulation.positions["bar"])[unused]
    simulation.step()
    np.testing.assert_array_equal(simulation.positions["bar"][unused], held)


def test_held_and_loaded_nodes_stay() -> None:
    """Of a bar of which the whole middle is held or loaded; others move."""
    box = ts.Box((0.15, -1, -1), (0.27, 1, 1))
    load = ts.NodalLoad("bar", on=box, force=(0, 0, 1))
    for acting in ({"fixed": [ts.Fixed("bar", on=box)]}, {"fixed": [], "loads": [load]}):
        simulation = repairing(gravity=None, **acting).compile()
        x = simulation.meshes["bar"].points[:, 0]
        chosen = np.flatnonzero((x > 0.15) & (x < 0.27))
        before = np.array(simulation.meshes["bar"].points)[chosen]
        for blade in BLADES:
            simulation.cut("bar", blade)
        np.testing.assert_array_equal(simulation.meshes["bar"].points[chosen], before)
        assert np.isin(chosen, tetrahedra(simulation)).all()


def test_regions_and_laws_do_not_mix() -> None:
    """Two halves of a bar, one of them stiffer; each keeps its volume."""
    mesh = jittered((8, 3, 3), 3)
    left = mesh.points[mesh.cells[0].nodes].mean(axis=1)[:, 0] < 0.2
    halves = {"left": left, "right": ~left}
    regions = {name: np.flatnonzero(inside).astype(np.int32) for name, inside in halves.items()}
    soft, hard = ts.StVK(young=5e4, poisson=0.3), ts.StVK(young=9e4, poisson=0.3)
    for law in (soft, {"left": soft, "right": hard}):
        both = ts.Mesh(points=mesh.points, cells=mesh.cells, regions=regions)
        simulation = free(bar(mesh=both, law=law), repair=ts.Repair(below=0.2))
        expected = volumes(mesh.points, mesh.cells[0].nodes)[left].sum()
        assert sum(made(simulation.cut("bar", blade)).operations for blade in BLADES) > 5
        cells = tetrahedra(simulation)
        of_left = np.isin(simulation.origin("bar"), regions["left"])
        found = volumes(simulation.meshes["bar"].points, cells)[of_left].sum()
        assert found == pytest.approx(expected, rel=1e-13)


def triangles_of(simulation: ts.Simulation) -> set[frozenset[int]]:
    surface = simulation.surface("bar")
    return {frozenset(nodes) for nodes in surface.nodes[:, 0][surface.triangles].tolist()}


@pytest.mark.parametrize("what", ["contact", "pressure"])
def test_the_surface_stays_in_contact_and_under_pressure(what: str) -> None:
    changes: dict[str, Any] = {"fixed": [], "gravity": None}
    if what == "contact":
        changes["obstacles"] = {"table": ts.PlaneObstacle((0, 0, -0.01), (0, 0, 1))}
        changes["contacts"] = [ts.Contact(("bar", "table")), ts.SelfContact("bar")]
    else:
        top = ts.Plane((0, 0, SIZE[2]), (0, 0, 1))
        changes["loads"] = [ts.Pressure("bar", on=top, pressure=500.0)]
    both = [repairing(repair=part, **changes).compile() for part in (ts.Repair(below=0.3), False)]
    done = 0
    for one in both:
        for blade in BLADES[:1]:
            report = one.cut("bar", blade)
            done += report.repairs.operations if report.repairs else 0
    assert done
    assert triangles_of(both[0]) == triangles_of(both[1])
    if what == "pressure":
        total = both[0].forces()[both[0].rows("bar")].sum(axis=0)
        assert total == pytest.approx([0.0, 0.0, -20.0], abs=1e-11)
    for blade in BLADES[1:]:
        both[0].cut("bar", blade)
        assert both[0].step().converged


def test_a_knife_is_repaired_after_its_incision() -> None:
    """Not while it goes on: its front needs the vertices that it has met."""
    path = ts.ToolPath(times=[0, 0.05], positions=[(0.208, 0.05, 0.14), (0.213, 0.05, -0.04)])
    knife = ts.Knife(edge=[(0, -0.1, 0), (0, 0.1, 0)], path=path, cuts=["bar"])
    simulation = free(
        bar(mesh=jittered((8, 3, 3), 3)),
        repair=ts.Repair(below=0.2, most=1000),
        instruments={"scalpel": knife},
    )
    reports = [report for _ in range(14) for report in simulation.step().cuts]
    assert all(report.repairs is None for report in reports[:-1])
    assert made(reports[-1]).operations > 5
    assert reports[-1].cells_cut == 0
    assert len(simulation.pieces("bar")) == 2
    assert fault_of_mesh(simulation) == ""


def test_knives_in_the_material_stay_where_they_are() -> None:
    """An edge that rode on nodes of repaired cells rides on those of the new ones."""
    half = ts.ToolPath(times=[0, 0.02], positions=[(0.213, 0.05, 0.14), (0.213, 0.05, 0.05)])
    knife = ts.Knife(edge=[(0, -0.1, 0), (0, 0.1, 0)], path=half, cuts=["bar"])
    simulation = free(repair=ts.Repair(below=0.3), instruments={"scalpel": knife})
    for _ in range(4):
        simulation.step()

    def edge() -> Array:
        (track,) = simulation._tracks().values()
        return np.asarray(track.rows[-1].places(simulation._core.positions))

    before = edge()
    assert made(
        simulation.cut("bar", ts.Plane(point=(0.2, 0, 0.04), normal=(0.2, 0.1, 1)))
    ).operations
    np.testing.assert_allclose(edge(), before, rtol=0, atol=1e-9)
    run(simulation, BLADES[1:2])
    assert fault_of_mesh(simulation) == ""


def test_parameters_keep_the_repair_and_reset_undoes_it() -> None:
    simulation = repairing().compile()
    first = np.array(simulation.meshes["bar"].points)
    assert made(run(simulation, BLADES[:2])[-1]).operations
    before = tetrahedra(simulation), np.array(simulation.meshes["bar"].points)
    simulation.parameters["bodies.bar.law.young"] = "60 kPa"
    np.testing.assert_array_equal(tetrahedra(simulation), before[0])
    np.testing.assert_array_equal(simulation.meshes["bar"].points, before[1])
    simulation.reset()
    np.testing.assert_array_equal(simulation.meshes["bar"].points, first)


MODELS = {
    "fem": ts.StableNeoHooke(young=5e4, poisson=0.4),
    "corotational": ts.Hooke(young=5e4, poisson=0.3),
    "mass_link": ts.StVK(young=5e4, poisson=0.3),
    "mass_tensor": ts.Hooke(young=5e4, poisson=0.3),
}


@pytest.mark.parametrize(("model", "law"), MODELS.items())
def test_each_model_goes_on_with_the_repaired_mesh(model: str, law: ts.Law) -> None:
    """A stretched bar has the same energy on any mesh, if its model was made anew with it."""
    mesh = jittered((8, 3, 3), 3)
    simulation = free(bar(mesh=mesh, law=law, model=model), repair=ts.Repair(below=0.2))
    simulation.positions["bar"][:, 0] *= 1.05
    elastic = simulation.energy()["elastic"]
    assert sum(made(simulation.cut("bar", blade)).operations for blade in BLADES) > 5
    assert simulation.energy()["elastic"] == pytest.approx(elastic, rel=1e-11)


def test_nodes_of_a_grab_stay() -> None:
    """Of two such bodies one is grabbed at a node that the repair of the other changes."""
    first, second = (free(grabbing=True, repair=ts.Repair(below=0.3)) for _ in range(2))
    for simulation in (first, second):
        simulation.cut("bar", BLADES[0])
    places = np.array(first.meshes["bar"].points)
    blade = ts.Plane((0.23, 0.05, 0.05), (1, 0.2, 0.1))
    assert made(first.cut("bar", blade)).operations
    after = first.meshes["bar"].points[: len(places)]
    is_gone = ~np.isin(np.arange(len(places)), tetrahedra(first))
    was_used = np.isin(np.arange(len(places)), tetrahedra(second))
    node = int(np.flatnonzero(was_used & (is_gone | (after != places).any(axis=1)))[0])
    second.grab("bar", node, target=tuple(places[node]), stiffness=10.0)
    assert made(second.cut("bar", blade)).operations
    np.testing.assert_array_equal(second.meshes["bar"].points[node], places[node])
    assert node in tetrahedra(second)


def test_a_body_in_the_exact_balance_of_its_weight_stays_there() -> None:
    """A hanging bar at rest; the repair changes x of nodes that are not on a line of its field."""
    simulation = repairing(step=EXACT, repair=ts.Repair(below=0.2, jump=0.01)).compile()
    for _ in range(3):
        simulation.step()
    quality = qualities(simulation.meshes["bar"].points, tetrahedra(simulation)).min()
    for blade in BLADES[:2]:
        report = simulation.cut("bar", blade)
    assert made(report).least_quality_after <= quality
    assert simulation.step().converged


def test_where_nothing_can_be_repaired_the_scene_is_refused() -> None:
    with pytest.raises(ts.SceneError, match="virtual cuts have nothing to repair"):
        repairing(method="virtual")
    relaxing = ts.Prony(branches=[ts.PronyBranch(weight=0.5, time=0.05)])
    with pytest.raises(ts.SceneError, match=r"found repair .* a viscosity with a memory"):
        repairing(bar(viscosity=relaxing)).compile()
    sheet = ts.bar_mesh(size=(0.4, 0.1, 0), cells=(8, 2, 0), cell="triangle")
    flat = bar(mesh=sheet, law=ts.StVK(young=5e4, poisson=0.3), thickness=1e-3)
    with pytest.raises(ts.SceneError, match=r"found repair .* cells of type triangle"):
        repairing(flat, fixed=[]).compile()
    for wrong in ({"below": 0.6}, {"below": 0}, {"most": 0}, {"jump": -1}):
        with pytest.raises(ts.SceneError):
            ts.Repair(**wrong)


def test_reports_and_summaries_have_the_repairs() -> None:
    report = free().cut("bar", BLADES[0])
    assert f"; {made(report).operations} repair" in str(report)
    record = cut_record(0.0, report)["repairs"]
    assert record["flips"] == made(report).flips
    assert json.loads(json.dumps(record)) == record
    assert cut_record(0.0, free(repair=False).cut("bar", BLADES[0]))["repairs"] is None
