"""Repairs of cells: which nodes stay, how loads, knives and files go on, and what is refused."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

import tissu as ts
from divided import (
    EXACT,
    SIZE,
    Array,
    bar,
    fault_of_mesh,
    jittered,
    qualities,
    tetrahedra,
    volumes,
)
from repaired import BLADES, free, made, repairing, run
from tissu.output.summary import cut_record


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
