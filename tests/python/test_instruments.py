"""Knives and ablators work at the end of each step, along their way through the material."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tissu as ts

SIZE = (0.4, 0.1, 0.1)
CELL = 0.1 / 3
EDGE = [(0.0, -0.02, 0.0), (0.0, 0.12, 0.0)]
"""An edge across the whole width of the bar."""


def bar(**body: Any) -> ts.Body:
    mesh = ts.bar_mesh(size=SIZE, cells=(12, 3, 3), cell="tetra")
    return ts.Body(**{"mesh": mesh, "law": ts.StVK(young=5e4, poisson=0.3), "density": 1e3} | body)


def scene(knife: ts.Knife | ts.Ablator, **changes: Any) -> ts.Scene:
    """At rest without gravity, so that nothing but the instrument moves."""
    return ts.Scene(
        **{
            "bodies": {"bar": bar()},
            "fixed": [ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
            "step": ts.ImplicitEuler(dt=0.01),
            "editing": True,
            "instruments": {"scalpel": knife},
        }
        | changes
    )


def down(steps: int, depth: float = 0.07) -> ts.Knife:
    """A knife that goes down at x = 0.213, a little to the side, within 0.01 s a step."""
    path = ts.ToolPath(
        times=(0.0, 0.01 * steps), positions=[(0.213, 0, 0.11), (0.221, 0, 0.11 - depth)]
    )
    return ts.Knife(EDGE, cuts=["bar"], path=path)


def cut_area(simulation: ts.Simulation) -> float:
    """Area of one side of all cut faces at rest [m2]."""
    surface = simulation.surface("bar")
    points = surface.carried(simulation.meshes["bar"].points)[surface.triangles[surface.cut]]
    cross = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    return float(0.25 * np.linalg.norm(cross, axis=1).sum())


def run(made: ts.Scene, steps: int) -> tuple[ts.Simulation, list[ts.CutReport]]:
    simulation = made.compile()
    reports = [cut for _ in range(steps) for cut in simulation.step().cuts]
    return simulation, reports


def test_a_knife_on_a_path_cuts_along_it() -> None:
    simulation, reports = run(scene(down(10)), 12)
    assert reports
    assert {report.by for report in reports} == {"scalpel"}
    depth = 0.1 - 0.04  # the edge ends at z = 0.04
    assert cut_area(simulation) == pytest.approx(0.1 * depth, abs=0.1 * CELL)  # front behind it
    assert sum(report.area for report in reports) == pytest.approx(cut_area(simulation), rel=1e-9)
    assert len(reports[-1].pieces) == 1
    assert abs(sum(report.mass_change for report in reports)) <= 1e-12 * 4.0


def test_the_number_of_steps_does_not_matter() -> None:
    """In 1, 10 and 100 parts the same cells part, but for one cell of difference at the front."""
    found = [run(scene(down(parts)), parts)[0] for parts in (1, 10, 100)]
    areas = [cut_area(simulation) for simulation in found]
    assert areas[0] == pytest.approx(0.1 * 0.06, abs=0.1 * CELL)
    for other in areas[1:]:
        assert other == pytest.approx(areas[0], abs=CELL * CELL)


def test_a_knife_along_faces_opens_them_however_short_its_steps_are() -> None:
    """It crosses no edge: a face opens when the last of its nodes is met."""
    areas = []
    for parts in (1, 10, 100):
        path = ts.ToolPath(times=(0, 0.01 * parts), positions=[(0.2, 0, 0.11), (0.2, 0, 0.03)])
        areas.append(cut_area(run(scene(ts.Knife(EDGE, cuts=["bar"], path=path)), parts)[0]))
    np.testing.assert_allclose(areas, 0.1 * 2 * CELL, rtol=1e-9)  # two rows of cells deep


def led(organ: bool, turn: float, way: tuple[float, float, float], steps: int) -> ts.Simulation:
    """A way of a knife in a rigid organ, made by the knife or, the other way round, by the organ.

    Turned about an axis through (0.2, 0.05, 0.5) along y.
    """
    center, times = np.array((0.2, 0.05, 0.5)), (0.0, 0.01 * steps)
    start = np.array((0.213, 0.0, 0.11))
    everything = ts.Box()
    if organ:
        motion = ts.Prescribed(
            "bar",
            on=everything,
            times=times,
            displacements=[(0, 0, 0), tuple(-np.array(way))],
            rotation=ts.Rotation(axis=(0, 1, 0), center=tuple(center), angles=(0.0, -turn)),
        )
        knife = ts.Knife(EDGE, cuts=["bar"], position=tuple(start))
        simulation, _ = run(scene(knife, fixed=[], prescribed=[motion]), steps)
        return simulation
    # x = R^T (X - c + way ...): the inverse motion at each of many times.
    poses = np.linspace(0.0, 1.0, steps + 1)
    places, turns = [], []
    for share in poses:
        c, s = np.cos(share * turn), np.sin(share * turn)
        back = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
        places.append(tuple(back @ (start + share * np.array(way) - center) + center))
        turns.append((0.0, share * turn, 0.0))
    path = ts.ToolPath(times=0.01 * np.arange(steps + 1), positions=places, rotations=turns)
    knife = ts.Knife(EDGE, cuts=["bar"], path=path)
    held = ts.Fixed("bar", on=everything)
    simulation, _ = run(scene(knife, fixed=[held]), steps)
    return simulation


@pytest.mark.parametrize("turn", [0.0, 0.05])
def test_a_moving_organ_and_a_still_knife_are_the_opposite(turn: float) -> None:
    """The same cells are cut where nothing turns; else chords of arcs differ by r a^2 / 8."""
    way = (0.008, 0.0, -0.07)
    moved, still = (led(organ, turn, way, 10) for organ in (True, False))
    assert cut_area(still) == pytest.approx(0.1 * 0.06, abs=0.1 * CELL)
    assert cut_area(moved) == pytest.approx(cut_area(still), abs=CELL * CELL)
    if turn == 0.0:
        np.testing.assert_array_equal(moved.origin("bar"), still.origin("bar"))
        np.testing.assert_array_equal(moved.born("bar"), still.born("bar"))


def test_a_knife_that_misses_cuts_nothing() -> None:
    path = ts.ToolPath(times=(0, 0.1), positions=[(0.2, 0, 0.15), (0.3, 0, 0.101)])
    simulation, reports = run(scene(ts.Knife(EDGE, cuts=["bar"], path=path)), 10)
    assert reports == []
    assert simulation.meshes["bar"].node_count == 13 * 4 * 4
    assert simulation.surface("bar").cut.sum() == 0


def test_a_knife_that_stands_still_in_tissue_cuts_nothing() -> None:
    """And one that goes along its own edge sweeps no area."""
    knife = ts.Knife(EDGE, cuts=["bar"], position=(0.21, 0, 0.05))
    simulation = scene(knife).compile()
    assert not simulation.step().cuts
    simulation.instruments["scalpel"].move((0.21, 0.01, 0.05))
    assert not simulation.step().cuts


def test_moves_before_a_step_are_a_way_with_corners() -> None:
    """A knife at 1 kHz beside steps of 10 ms: down, and along, and the corner is cut as well."""
    knife = ts.Knife(EDGE, cuts=["bar"], position=(0.1, 0, 0.12))
    simulation = scene(knife).compile()
    tool = simulation.instruments["scalpel"]
    for z in np.linspace(0.12, 0.055, 10):
        tool.move((0.1, 0, z))
    for x in np.linspace(0.1, 0.21, 10):
        tool.move((x, 0, 0.055))
    np.testing.assert_allclose(tool.position, (0.21, 0, 0.055))
    np.testing.assert_allclose(tool.edge, [(0.21, -0.02, 0.055), (0.21, 0.12, 0.055)])
    (report,) = simulation.step().cuts
    assert report.area == pytest.approx(0.1 * (0.045 + 0.11), abs=0.1 * CELL)
    tool.place((0.3, 0, 0.055))  # at once: without a way
    assert not simulation.step().cuts
    tool.move((0.3, 0, 0.02), (0, 0, "10 deg"))
    assert simulation.step().cuts
    np.testing.assert_allclose(tool.rotation[0, 0], np.cos(np.radians(10)))


def still_bits(made: ts.Scene, folder: Path) -> list[np.ndarray[Any, Any]]:
    """Ends of a run, of one from a checkpoint in its middle, and of one after a rewind."""
    simulation = made.compile()
    for _ in range(5):
        simulation.step()
    simulation.save_checkpoint(folder / "middle.tissu")
    mark = simulation.mark()
    resumed = made.compile(checkpoint=folder / "middle.tissu")
    ends = []
    for one in (simulation, resumed):
        for _ in range(5):
            one.step()
        ends.append(np.array(one.positions["bar"]))
    simulation.rewind(mark)
    for _ in range(5):
        simulation.step()
    return [*ends, np.array(simulation.positions["bar"])]


def hanging(toughness: float | None = None, **changes: Any) -> ts.Scene:
    """Held at both ends under gravity, so that it moves and opens while it is cut."""
    ends = [ts.Fixed("bar", on=ts.Plane((x, 0, 0), (1, 0, 0))) for x in (0, 0.4)]
    knife = down(10).replace(toughness=toughness)
    bodies = {"bar": bar(law=ts.StVK(young=3e5, poisson=0.3))}
    return scene(knife, bodies=bodies, gravity=(0, 0, -9.81), fixed=ends, **changes)


@pytest.mark.parametrize("toughness", [None, 20.0])
def test_an_incision_goes_on_with_the_same_bits(tmp_path: Path, toughness: float | None) -> None:
    first, *others = still_bits(hanging(toughness), tmp_path)
    assert len(first) > 13 * 4 * 4
    for other in others:
        np.testing.assert_array_equal(other, first)


@pytest.mark.parametrize("threads", [2, 4])
def test_an_incision_has_the_same_bits_on_any_number_of_threads(threads: int) -> None:
    (one, reports), (more, _) = run(hanging(), 10), run(hanging(threads=threads), 10)
    assert len(reports) > 3
    np.testing.assert_array_equal(one.positions["bar"], more.positions["bar"])


TOUGHNESS = 20.0


def firm(knife: ts.Knife) -> ts.Scene:
    """A bar that is held all around but where it is cut, and hardly gives way."""
    return scene(
        knife,
        bodies={"bar": bar(law=ts.StVK(young=5e6, poisson=0.3))},
        fixed=[
            ts.Fixed("bar", on=ts.Box(max=(0.15, None, None))),
            ts.Fixed("bar", on=ts.Box(min=(0.28, None, None))),
        ],
    )


def test_a_tough_blade_takes_its_work() -> None:
    """Work = J_c x area, and in steady cutting the force is J_c for each metre of the edge."""
    steps = 60
    simulation = firm(down(steps).replace(toughness=TOUGHNESS)).compile()
    reports, forces = [], []
    for _ in range(steps):
        reports += simulation.step().cuts
        forces.append(simulation.instruments["scalpel"].force)
    assert reports
    area = sum(report.area for report in reports)
    assert area == pytest.approx(0.1 * 0.06, abs=0.1 * CELL)
    for report in reports:
        assert report.work == pytest.approx(TOUGHNESS * report.area, rel=1e-12)
    late = np.array(forces[steps // 2 :])
    # The edge stands for its points in the material: their lengths miss half a spacing at each end.
    np.testing.assert_allclose(
        np.linalg.norm(late, axis=1), TOUGHNESS * 0.1, rtol=0.5 * CELL / 0.1 + 0.02
    )
    assert (late[:, 2] > 0.0).all()  # against its way


def test_a_tough_blade_presses_before_it_cuts() -> None:
    knife = ts.Knife(EDGE, cuts=["bar"], position=(0.21, 0, 0.11), toughness=TOUGHNESS)
    simulation = firm(knife).compile()
    tool = simulation.instruments["scalpel"]
    np.testing.assert_array_equal(tool.force, np.zeros(3))
    tool.move((0.21, 0, 0.0985))
    simulation.step()  # it enters, and stands at the surface
    for way in (0.0, 0.001):
        tool.move((0.21, 0, 0.0985 - way))
        assert not simulation.step().cuts
    assert 0.0 < tool.force[2] < TOUGHNESS * 0.1
    cut = []
    for z in np.linspace(0.097, 0.08, 20):
        tool.move((0.21, 0, z))
        cut += simulation.step().cuts
    assert cut
    tool.move((0.21, 0, 0.2))  # it leaves: nothing pulls it back
    simulation.step()
    np.testing.assert_array_equal(tool.force, np.zeros(3))


def test_an_ablator_takes_the_cells_on_its_way() -> None:
    path = ts.ToolPath(times=(0, 0.05), positions=[(0.1, 0.05, 0.1), (0.3, 0.05, 0.1)])
    tip = ts.Ablator(0.03, removes=["bar"], path=path)
    mesh = bar().mesh
    assert isinstance(mesh, ts.Mesh)
    corners = mesh.points[mesh.volume_blocks[0].nodes]
    centres = corners.mean(axis=1)
    on_axis = np.clip(centres[:, 0], 0.1, 0.3)
    nearest = np.stack([on_axis, np.full(len(centres), 0.05), np.full(len(centres), 0.1)], axis=1)
    inside = np.linalg.norm(centres - nearest, axis=1) <= 0.03
    volumes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 6
    simulation, reports = run(scene(tip), 5)
    gone = np.setdiff1d(np.arange(len(centres)), simulation.remaining_cells("bar"))
    np.testing.assert_array_equal(gone, np.flatnonzero(inside))
    assert sum(report.mass_change for report in reports) == pytest.approx(
        -1e3 * volumes[inside].sum(), rel=1e-12
    )
    assert simulation.step().converged


def test_a_capsule_is_a_ball_that_is_swept() -> None:
    one, other = scene(down(1)).compile(), scene(down(1)).compile()
    far = ts.Capsule([(0.4, 0.1, 0.1), (0.4, 0.1, 0.1)], "5 cm")
    one.ablate("bar", far)
    other.ablate("bar", ts.Sphere((0.4, 0.1, 0.1), "5 cm"))
    np.testing.assert_array_equal(one.remaining_cells("bar"), other.remaining_cells("bar"))
    with pytest.raises(ts.ParameterError, match="radius 0 m"):
        one.ablate("bar", ts.Capsule([(0, 0, 0), (1, 0, 0)], 0.0))


@pytest.mark.parametrize("seed", [0, 5, 10])
def test_a_slow_knife_leaves_no_bridge(seed: int) -> None:
    """Through a soft bar that sags, on a tilted way, by a thirtieth of a cell in each step.

    With a least way of 0.02 cells, seeds 5 and 10 left the halves joined.
    """
    random = np.random.default_rng(seed)
    mesh = ts.bar_mesh(size=(0.2, 0.1, 0.1), cells=(6, 3, 3), cell="tetra")
    points = mesh.points.copy()
    inner = ((points > 1e-6) & (points < np.array((0.2, 0.1, 0.1)) - 1e-6)).all(axis=1)
    points[inner] += random.uniform(-4e-3, 4e-3, (int(inner.sum()), 3))
    x, way, tilt, yaw = random.uniform(-1, 1, 4) * (0.03, 0.03, 0.06, 0.3)
    knife = ts.Knife(
        [(0, -0.03, 0), (0, 0.13, 0)],
        cuts=["bar"],
        path=ts.ToolPath(
            times=(0, 1.5),
            positions=[(0.1 + x, 0, 0.115), (0.1 + x + way, 0, -0.05)],
            rotations=[(tilt, 0, yaw), (-tilt, 0, yaw)],
        ),
    )
    ends = [ts.Fixed("bar", on=ts.Plane((x, 0, 0), (1, 0, 0))) for x in (0, 0.2)]
    made = scene(
        knife,
        bodies={"bar": bar(mesh=dataclasses.replace(mesh, points=points))},
        fixed=ends,
        gravity=(0, 0, -9.81),
    )
    simulation, reports = run(made, 150)
    assert len(simulation.pieces("bar")) == 2
    assert not any(report.unresolved for report in reports)


def test_parameters_and_reset_in_the_middle_of_an_incision() -> None:
    """A value written again changes nothing; a reset begins again, with the same bits."""
    step = ts.ImplicitEuler(dt=0.01, solver=ts.ConjugateGradient(tolerance=1e-12))
    one, other = hanging(step=step).compile(), hanging(step=step).compile()
    for simulation in (one, other):
        for _ in range(5):
            simulation.step()
    one.parameters["gravity.z"] = -9.81
    for simulation in (one, other):
        for _ in range(5):
            simulation.step()
    np.testing.assert_allclose(
        one.positions["bar"], other.positions["bar"], rtol=0, atol=1e-9
    )  # the solver begins anew
    end = np.array(other.positions["bar"])
    other.reset()
    assert not other.surface("bar").cut.any()
    for _ in range(10):
        other.step()
    np.testing.assert_array_equal(other.positions["bar"], end)


def test_what_instruments_remember_is_refused_where_it_cannot_be_read() -> None:
    simulation = scene(down(10)).compile()
    while len(simulation._tracks()[0].rows) < 2 or len(simulation._tracks()[0].poses) > 1:
        simulation.step()  # until it has cut, and waits for nothing
    known = simulation._core.remembered("instruments")
    for place, value in ((1, 7.0), (4, 0.5), (6 + 3, 2.0), (6 + 7 + 1, 1e9), (0, -1.0)):
        broken = known.copy()
        broken[place] = value
        with pytest.raises(ts.ParameterError, match="the track of an instrument"):
            simulation._core.set_remembered("instruments", broken)
    with pytest.raises(ts.ParameterError, match="another length"):
        simulation._core.set_remembered("instruments", known[:-1])
    np.testing.assert_array_equal(simulation._core.remembered("instruments"), known)


def refused(make: Callable[[], object], words: str) -> None:
    with pytest.raises(ts.SceneError, match=words):
        make()


def test_what_cannot_be_is_refused_when_the_scene_is_read() -> None:
    knife = ts.Knife(EDGE, cuts=["bar"])
    refused(lambda: scene(knife, editing=None), "write editing: true")
    refused(lambda: scene(ts.Knife(EDGE, cuts=["liver"])), "no body is named 'liver'")
    refused(lambda: ts.Knife([(0, 0, 0)], cuts=["bar"]), "two or more")
    refused(lambda: ts.Knife(EDGE, cuts=["bar"], toughness="3 kPa"), "a toughness is accepted")
    refused(
        lambda: scene(knife.replace(toughness=20), step=ts.SymplecticEuler(dt=1e-5)),
        "an implicit method is accepted",
    )
    refused(lambda: ts.Ablator(0.1, removes=["bar"], least_force=0.3), "leave least_force out")
    turns = [(0, 0, 0), (0, 0, "200 deg")]
    places = [(0, 0, 0), (0, 0, 0)]
    refused(
        lambda: ts.ToolPath(times=(0, 1), positions=places, rotations=turns), "turn of 200 degrees"
    )
    refused(lambda: ts.ToolPath(times=(0, 1), positions=[(0, 0, 0)]), "one for each time")
    path = ts.ToolPath(times=(0, 1), positions=places)
    refused(lambda: knife.replace(path=path, position=(1, 0, 0)), "with a path")
    refused(lambda: ts.Knife(EDGE, cuts=["bar", "bar"]), r"cuts\[1\]: found 'bar' twice")
    refused(lambda: ts.Ablator(0.1, removes=["bar", "bar"]), r"removes\[1\]: found 'bar' twice")
    refused(lambda: scene(knife, instruments={"bar": knife}), "names are unique")
    refused(lambda: ts.Knife([(0, 0, 0), (0, 0, 1e300)], cuts=["bar"]), "at most 1 m is accepted")
    tear = ts.Tear("bar", strength=1e4, length=0.02)
    refused(lambda: scene(knife, tear=[tear, tear]), "found a second tear of 'bar'")
    condensed = ts.Body(
        mesh=ts.bar_mesh(size=(0.2, 0.1, 0.1), cells=(4, 2, 2), cell="tetra"),
        law=ts.Hooke(young=1e5, poisson=0.3),
        density=1000.0,
        model="condensed",
    )
    refused(
        lambda: scene(knife, bodies={"bar": condensed}).compile(),
        "cells are condensed, and a model that keeps each cell is accepted, such as fem",
    )


def test_what_cannot_be_is_refused_while_it_runs() -> None:
    simulation = scene(down(10)).compile()
    tool = simulation.instruments["scalpel"]
    with pytest.raises(ts.ParameterError, match="which its path leads"):
        tool.move((0, 0, 0))
    with pytest.raises(ts.ParameterError, match="which cuts without one"):
        tool.force  # noqa: B018
    free = scene(ts.Knife(EDGE, cuts=["bar"])).compile()
    with pytest.raises(ts.ParameterError, match="not a rotation"):
        free.instruments["scalpel"].move((0, 0, 0), 2.0 * np.eye(3))
    with pytest.raises(ts.ParameterError, match="accepted: scalpel"):
        free.instruments["saw"]
    with pytest.raises(ts.ParameterError, match="at most 1000 m is accepted"):
        free.instruments["scalpel"].move((1e300, 0, 0))
    for turn in (1e7, 1e155, 1e300):
        with pytest.raises(ts.ParameterError, match=r"at most 1e\+06 rad is accepted"):
            free.instruments["scalpel"].move((0, 0, 0), (turn, 0, 0))


def test_the_others_work_where_the_cut_of_one_is_refused() -> None:
    path = ts.ToolPath(
        times=(0.0, 0.01, 0.02), positions=[(0.3, 0.05, z) for z in (0.2, 0.05, 0.2)]
    )
    hook = ts.Ablator("2 cm", removes=["bar"], path=path)
    alone = scene(hook).compile()
    (expected,) = alone.step().cuts
    tools = {"scalpel": ts.Knife(EDGE, cuts=["bar"], position=(0.213, 0, 0.11)), "hook": hook}
    simulation = scene(hook, instruments=tools, editing=ts.Editing(room="1 %")).compile()
    mark = simulation.mark()
    for _ in range(2):
        simulation.rewind(mark)
        simulation.instruments["scalpel"].move((0.213, 0, -0.02))
        with pytest.raises(ts.ParameterError, match=r"scalpel: step 1 was taken.*there is room"):
            simulation.step()
        left = simulation.remaining_cells("bar")
        np.testing.assert_array_equal(left, alone.remaining_cells("bar"))
    simulation.instruments["scalpel"].place((0.213, 0, 0.11))
    (late,) = simulation.step().cuts
    assert (late.by, late.cells_gone) == ("hook", expected.cells_gone)
    assert simulation.step().cuts == ()


def test_a_scene_file_has_instruments(tmp_path: Path) -> None:
    made = scene(
        ts.Knife(EDGE, cuts=["bar"], toughness="150 J/m^2", position=("2 cm", 0, 0)),
    )
    mesh = ts.BarMesh(size=SIZE, cells=(12, 3, 3), cell="tetra")
    made = made.replace(bodies={"bar": bar(mesh=mesh)})
    assert ts.Scene.from_yaml_text(made.to_yaml()) == made
    plan = str(made.compile().plan())
    assert "instrument scalpel: instruments.scalpel is a knife of 0.14 m of toughness 150" in plan
