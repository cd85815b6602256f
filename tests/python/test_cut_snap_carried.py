"""Where a cut moves nodes: which stay, and how models, loads, knives and files go on."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tissu as ts
from divided import (
    SIZE,
    Array,
    bar,
    fault_of_mesh,
    jittered,
    tetrahedra,
    volumes,
)
from snapped import BESIDE, free, snapping
from tissu.simulation import snapping as moving


def still(simulation: ts.Simulation, nodes: Array, blade: Any) -> ts.CutReport:
    """Cuts, and requires that these nodes stay at rest."""
    before = np.array(simulation.meshes["bar"].points)[nodes]
    report = simulation.cut("bar", blade)
    assert report.nodes_moved
    np.testing.assert_array_equal(simulation.meshes["bar"].points[nodes], before)
    return report


def test_held_and_loaded_nodes_stay() -> None:
    """A plane 13 mm from a layer of nodes that is held, and the same of a layer that is loaded."""
    mesh = ts.bar_mesh(size=SIZE, cells=(8, 4, 4), cell="tetra")
    layer = np.flatnonzero(np.abs(mesh.points[:, 1] - 0.05) < 1e-9)
    blade = ts.Plane(point=(0.2, 0.058, 0.05), normal=(0.05, 1.0, 0.0))
    all_free = free(bar(mesh=mesh))
    all_free.cut("bar", blade)
    assert np.abs(all_free.meshes["bar"].points[layer] - mesh.points[layer]).max() > 1e-3
    low = ts.Box((0.1, 0.04, -1), (0.3, 0.06, 1))
    chosen = layer[(mesh.points[layer, 0] > 0.1 - 1e-9) & (mesh.points[layer, 0] < 0.3 + 1e-9)]
    still(free(bar(mesh=mesh), fixed=[ts.Fixed("bar", on=low)]), chosen, blade)
    load = ts.NodalLoad("bar", on=low, force=(0, 0, 1))
    still(free(bar(mesh=mesh), loads=[load]), chosen, blade)


def test_borders_of_laws_and_regions_stay(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two halves of a bar, one of them stiffer; the border lies beside the blade."""
    mesh = ts.bar_mesh(size=SIZE, cells=(8, 3, 3), cell="tetra")
    nodes = mesh.cells[0].nodes
    left = np.flatnonzero(mesh.points[nodes].mean(axis=1)[:, 0] < 0.2).astype(np.int32)
    parted = ts.Mesh(points=mesh.points, cells=mesh.cells, regions={"left": left})
    border = np.flatnonzero(np.abs(mesh.points[:, 0] - 0.2) < 1e-9)
    soft, hard = ts.StVK(young=5e4, poisson=0.3), ts.StVK(young=9e4, poisson=0.3)
    right = np.setdiff1d(np.arange(len(nodes)), left).astype(np.int32)
    both = ts.Mesh(points=mesh.points, cells=mesh.cells, regions={"left": left, "right": right})
    blade = ts.Plane(point=(0.21, 0.05, 0.05), normal=(1.0, 0.45, 0.3))
    for body in (bar(mesh=parted), bar(mesh=both, law={"left": soft, "right": hard})):
        if body.mesh is both:  # the core keeps the borders of laws by itself
            monkeypatch.setattr(moving, "still_nodes", lambda *_: np.zeros(0, dtype=np.int32))
        simulation = free(body)
        still(simulation, border, blade)
        X, cells = simulation.meshes["bar"].points, tetrahedra(simulation)
        of_left = np.isin(simulation.origin("bar"), left)
        assert volumes(X, cells)[of_left].sum() == pytest.approx(2e-3, rel=1e-13)


def test_nodes_of_a_grab_stay() -> None:
    simulation = free(bar((8, 4, 4)), grabbing=True)
    mesh = simulation.meshes["bar"]
    node = int(np.argmin(np.linalg.norm(mesh.points - (0.2, 0.05, 0.05), axis=1)))
    simulation.grab("bar", node, target=tuple(mesh.points[node]), stiffness=10.0)
    still(simulation, np.array([node]), ts.Plane(point=(0.21, 0, 0), normal=(1, 0, 0)))


MODELS = {
    "fem": ts.StableNeoHooke(young=5e4, poisson=0.4),
    "corotational": ts.Hooke(young=5e4, poisson=0.3),
    "mass_link": ts.StVK(young=5e4, poisson=0.3),
    "mass_tensor": ts.Hooke(young=5e4, poisson=0.3),
}


@pytest.mark.parametrize(("model", "law"), MODELS.items())
def test_each_model_goes_on_with_the_moved_mesh(model: str, law: ts.Law) -> None:
    """A stretched bar has the same energy on any mesh, if its model was made anew with it."""
    simulation = free(bar((8, 3, 3), law=law, model=model))
    simulation.positions["bar"][:, 0] *= 1.05
    elastic = simulation.energy()["elastic"]
    report = simulation.cut("bar", ts.Plane(point=(0.222, 0.05, 0.05), normal=(1, 0, 0)))
    assert report.nodes_moved == 16
    assert simulation.energy()["elastic"] == pytest.approx(elastic, rel=1e-11)


def test_a_pressure_keeps_its_resultant() -> None:
    """500 Pa on 0.4 x 0.1 m, whose nodes stay; nodes inside move."""
    mesh = ts.bar_mesh(size=SIZE, cells=(8, 4, 4), cell="tetra")
    top = np.flatnonzero(mesh.points[:, 2] > SIZE[2] - 1e-9)
    pressed = ts.Pressure("bar", on=ts.Plane((0, 0, SIZE[2]), (0, 0, 1)), pressure=500.0)
    simulation = free(bar(mesh=mesh), loads=[pressed])
    still(simulation, top, BESIDE)
    total = simulation.forces()[simulation.rows("bar")].sum(axis=0)
    assert total == pytest.approx([0.0, 0.0, -20.0], abs=1e-11)


def test_cells_are_removed_in_place_afterwards(tmp_path: Path) -> None:
    """With the bits of a simulation that is laid anew from a checkpoint."""
    simulation = snapping(bar(mesh=jittered((8, 3, 3), 2))).compile()
    assert simulation.cut("bar", BESIDE).nodes_moved
    simulation.remove_cells(body="bar", cells=simulation.remaining_cells("bar")[[3, 50]])
    report = simulation.ablate("bar", ts.Sphere((0.3, 0.05, 0.05), 0.03))
    assert report.cells_gone
    assert not report.relaid
    simulation.save_checkpoint(tmp_path / "removed.tissu")
    expected = stepped(simulation)
    resumed = simulation.scene.compile(checkpoint=tmp_path / "removed.tissu")
    np.testing.assert_array_equal(stepped(resumed), expected)


def test_a_snapshot_with_other_places_is_refused() -> None:
    simulation = snapping().compile()
    assert simulation.cut("bar", ts.Plane(point=(0.213, 0, 0), normal=(1, 0, 0))).nodes_moved
    taken = simulation._core.snapshot()
    taken["rest_0"] = taken["rest_0"][:-3]
    with pytest.raises(ts.ParameterError, match="places at rest of another number of nodes"):
        snapping().compile()._core.restore(taken)


def stepped(simulation: ts.Simulation, count: int = 5) -> Array:
    for _ in range(count):
        simulation.step()
    return np.concatenate([simulation.positions["bar"], simulation.velocities["bar"]])


def cut_twice(threads: int = 1) -> ts.Simulation:
    made = snapping(bar(mesh=jittered((8, 3, 3), 2)), threads=threads).compile()
    for _ in range(3):
        made.step()
    made.cut("bar", BESIDE)
    made.step()
    report = made.cut("bar", ts.Plane(point=(0.2, 0.06, 0.05), normal=(0.1, 1.0, 0.2)))
    assert report.nodes_moved
    return made


def test_threads_checkpoints_and_rewind_give_the_same_bits(tmp_path: Path) -> None:
    simulation = cut_twice()
    mark = simulation.mark()
    file = tmp_path / "cut.tissu"
    simulation.save_checkpoint(file)
    expected, rest = stepped(simulation), np.array(simulation.meshes["bar"].points)
    np.testing.assert_array_equal(stepped(cut_twice(threads=2)), expected)
    resumed = simulation.scene.compile(checkpoint=file)
    np.testing.assert_array_equal(resumed.meshes["bar"].points, rest)
    np.testing.assert_array_equal(stepped(resumed), expected)
    simulation.rewind(mark)
    np.testing.assert_array_equal(simulation.meshes["bar"].points, rest)
    np.testing.assert_array_equal(stepped(simulation), expected)


def test_parameters_keep_the_cut_and_reset_undoes_it() -> None:
    simulation = snapping(bar(mesh=jittered((8, 3, 3), 2))).compile()
    first = np.array(simulation.meshes["bar"].points)
    simulation.cut("bar", BESIDE)
    assert simulation.is_cut("bar")
    rest = np.array(simulation.meshes["bar"].points)
    assert not np.array_equal(rest[: len(first)], first)
    simulation.parameters["bodies.bar.law.young"] = "60 kPa"
    np.testing.assert_array_equal(simulation.meshes["bar"].points, rest)
    np.testing.assert_array_equal(simulation._core.made_of("bar")[0], rest)
    simulation.reset()
    np.testing.assert_array_equal(simulation.meshes["bar"].points, first)


def test_a_knife_cuts_through_by_moving_nodes() -> None:
    """Ten sweeps, each along the way since the last one, through the whole bar."""
    path = ts.ToolPath(times=[0, 0.05], positions=[(0.213, 0.05, 0.14), (0.213, 0.05, -0.04)])
    knife = ts.Knife(edge=[(0, -0.1, 0), (0, 0.1, 0)], path=path, cuts=["bar"])
    simulation = snapping(
        bar((8, 3, 3)), fixed=[], gravity=None, instruments={"scalpel": knife}
    ).compile()
    reports = [report for _ in range(12) for report in simulation.step().cuts]
    assert len(simulation.pieces("bar")) == 2
    assert sum(report.nodes_moved for report in reports) >= 12
    assert fault_of_mesh(simulation) == ""
    assert simulation._core.totals("bar")["volume"] == pytest.approx(4e-3, rel=1e-13)


def test_knives_in_the_material_stay_where_they_are() -> None:
    """Nodes move onto a blade, and with them the material's coordinates of another knife's edge."""
    half = ts.ToolPath(times=[0, 0.02], positions=[(0.213, 0.05, 0.14), (0.213, 0.05, 0.05)])
    knife = ts.Knife(edge=[(0, -0.1, 0), (0, 0.1, 0)], path=half, cuts=["bar"])
    simulation = snapping(
        bar((8, 3, 3)), fixed=[], gravity=None, instruments={"scalpel": knife}
    ).compile()
    moved = sum(cut.nodes_moved for _ in range(4) for cut in simulation.step().cuts)
    assert moved > 4

    def edge() -> Array:
        (track,) = simulation._tracks().values()
        return np.asarray(track.rows[-1].places(simulation._core.positions))

    np.testing.assert_allclose(edge()[:, [0, 2]], [(0.213, 0.05)] * len(edge()), atol=1e-9)
    report = simulation.cut("bar", ts.Plane(point=(0, 0, 0.04), normal=(0, 0, 1)))
    assert report.nodes_moved
    np.testing.assert_allclose(edge()[:, [0, 2]], [(0.213, 0.05)] * len(edge()), atol=1e-9)
