"""Severed tissue across marks, checkpoints, parameters and instruments; what is refused."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tissu as ts
from severing_scenes import ACROSS, HALF, MIDDLE, G, around, flying, hanging, same, simulated, steps
from tissu.cli.run import Job, run_scene
from tissu.cli.touches import cut_lines
from tissu.output.summary import cut_record
from tissu.simulation.lumped import momenta_of

EXAMPLES = Path(__file__).parents[2] / "examples"


def test_a_blade_that_misses_changes_no_bit() -> None:
    simulation, other = simulated(), simulated(1)
    for one in (simulation, other):
        steps(one, 3)
    report = simulation.cut("fascia", ts.Disc((0.5, 0.5, 0.5), (0, 0, 1), 0.1))
    assert report.met_nothing
    assert str(report) == "cut of 'fascia': the blade met nothing"
    report = simulation.cut("fascia", ts.Plane((0, 0, 0.2), (0, 0, 1)))
    assert report.links_severed == 0
    for one in (simulation, other):
        steps(one, 3)
    assert same(simulation, other)


def test_a_cut_is_for_ever_and_in_any_order_thesame() -> None:
    """A second cut along the first severs nothing; two cuts in turn leave what both at once do."""
    first, second = simulated(), simulated(1)
    across = ACROSS
    assert first.cut("fascia", MIDDLE).links_severed > 0
    assert first.cut("fascia", MIDDLE).links_severed == 0
    first.cut("fascia", across)
    second.cut("fascia", across)
    second.cut("fascia", MIDDLE)
    assert np.array_equal(first._severed["fascia"], second._severed["fascia"])
    for one in (first, second):
        steps(one, 3)
    assert same(first, second)


def test_marks_checkpoints_and_threads_have_the_same_bits(tmp_path: Path) -> None:
    """A run on two threads with a mark, one that is resumed, and one on one thread."""
    scene = hanging(threads=2)
    simulation, other = scene.compile(), simulated()
    for one in (simulation, other):
        steps(one, 3)
    mark = simulation.mark()
    other.mark()
    first = simulation.cut("fascia", HALF)
    assert other.cut("fascia", HALF).links_severed == first.links_severed
    simulation.cut("upper", ts.Sweep([[(0.06, y, 0.0885), (0.06, y, 0.12)] for y in (-0.01, 0.11)]))
    other.cut("upper", ts.Sweep([[(0.06, y, 0.0885), (0.06, y, 0.12)] for y in (-0.01, 0.11)]))
    for one in (simulation, other):
        steps(one, 2)
    simulation.save_checkpoint(tmp_path / "cut.tissu")
    resumed = scene.compile(checkpoint=tmp_path / "cut.tissu")
    assert np.array_equal(resumed._severed["fascia"], simulation._severed["fascia"])
    for one in (simulation, resumed):
        assert one.cut("fascia", MIDDLE).links_severed > 0
        steps(one, 3)
    other.mark()
    other.cut("fascia", MIDDLE)
    steps(other, 3)
    assert same(simulation, resumed)
    assert same(simulation, other)
    assert np.array_equal(simulation.points("fascia"), resumed.points("fascia"))
    simulation.rewind(mark)
    assert simulation._severed == {}
    again = simulation.cut("fascia", HALF)
    assert again.links_severed == first.links_severed
    assert again.elastic_energy_change == first.elastic_energy_change


def test_parameters_keep_the_cut_and_reset_undoes_it() -> None:
    simulation, other = simulated(), simulated(1)
    severed = simulation.cut("fascia", around("lower")).links_severed
    simulation.parameters["tissue.fascia.law.young"] = 7e3
    assert simulation.cut("fascia", around("lower")).links_severed == 0
    steps(simulation, 4)
    fallen = simulation.displacements("lower")[:, 2]
    assert fallen == pytest.approx(-G * 25e-6 * 10, abs=1e-9)
    simulation.reset()
    simulation.parameters["tissue.fascia.law.young"] = 6e3
    for one in (simulation, other):
        steps(one, 3)
    assert same(simulation, other)
    assert simulation.cut("fascia", around("lower")).links_severed > severed / 2


def test_a_tied_organ_is_cut_where_the_tissue_was_severed_from_it() -> None:
    simulation = simulated()
    blade = ts.Plane((0.05, 0.05, 0), (1, 0.1, 0))
    with pytest.raises(ts.ParameterError, match="tied"):
        simulation.cut("lower", blade)
    simulation.cut("fascia", around("lower"))
    assert len(simulation.cut("lower", blade).pieces) == 2
    steps(simulation, 2)
    mark = simulation.mark()
    steps(simulation, 2)
    there = simulation.positions["lower"].copy()
    simulation.rewind(mark)
    steps(simulation, 2)
    assert np.array_equal(simulation.positions["lower"], there)


def test_cuts_of_organs_and_of_tissue_in_turn_have_the_same_bits(tmp_path: Path) -> None:
    """Organs that no tissue ties any more are cut in place, between cuts of the tissue."""
    simulation = simulated()
    for body in ("lower", "upper"):
        simulation.cut("fascia", around(body))
    blades = [ts.Plane((x, 0.05, 0), (1, 0.1, 0)) for x in (0.03, 0.05, 0.06)]
    assert not simulation.cut("lower", blades[1]).relaid
    steps(simulation, 2)
    mark, ends = simulation.mark(), []
    for _ in range(2):
        simulation.rewind(mark)
        for cut, blade in (("upper", blades[0]), ("fascia", ACROSS), ("upper", blades[2])):
            simulation.cut(cut, blade)
            steps(simulation, 1)
        simulation.save_checkpoint(tmp_path / "both.tissu")
        steps(simulation, 2)
        ends.append({body: simulation.positions[body].copy() for body in simulation.bodies})
    resumed = hanging().compile(checkpoint=tmp_path / "both.tissu")
    steps(resumed, 2)
    assert same(simulation, resumed)
    assert all(np.array_equal(ends[0][body], ends[1][body]) for body in simulation.bodies)
    assert len(simulation.pieces("upper")) == 3


def test_points_without_a_link_go_and_are_reported() -> None:
    simulation = simulated()
    points = simulation.points("fascia")
    mass = float(simulation._core.lumped_masses()[0].sum())
    report = simulation.ablate("fascia", ts.Sphere((0.05, 0.05, 0.055), "15 mm"))
    inside = np.linalg.norm(points - (0.05, 0.05, 0.055), axis=1) <= 0.015
    assert report.points_gone == tuple(np.flatnonzero(inside))
    assert report.mass_change == pytest.approx(-simulation._links["fascia"].masses[inside].sum())
    assert simulation._core.lumped_masses()[0].sum() == pytest.approx(
        mass + report.mass_change, rel=1e-12
    )
    assert simulation.points("fascia") == pytest.approx(points[~inside], abs=1e-15)
    assert simulation.points("fascia", rest=True) == pytest.approx(points[~inside], abs=1e-15)
    steps(simulation, 2)
    assert len(simulation.cell_fields("fascia")["volume_ratio"]) == (~inside).sum()


def test_tissue_is_cut_to_pieces(tmp_path: Path) -> None:
    """What lost points had is gone, all else is kept; frames without a point stay, resumed too."""
    scene, random = flying(), np.random.default_rng(5)
    simulation = scene.compile()
    steps(simulation, 4)
    masses = simulation._links["fascia"].masses
    mass, lost = float(simulation._core.lumped_masses()[0].sum()), 0
    for _ in range(12):
        point = random.uniform([0.02, 0.02, 0.045], [0.08, 0.08, 0.065])
        left = simulation._left("fascia")
        had = momenta_of(simulation, "fascia", left, left.kept)
        report = simulation.cut("fascia", ts.Plane(tuple(point), tuple(random.normal(size=3))))
        gone = np.isin(left.kept, report.points_gone)
        change = np.concatenate([report.momentum_change, report.angular_momentum_change])
        assert change == pytest.approx(-had[gone].sum(axis=0), abs=1e-15)
        mass -= masses[list(report.points_gone)].sum()
        lost += len(report.points_gone)
        steps(simulation, 2)
    assert lost > 20
    assert simulation._core.lumped_masses()[0].sum() == pytest.approx(mass, rel=1e-12)
    assert len(simulation.pieces("fascia")) > 3
    assert np.abs(simulation._core.velocities[:, :3]).max() < 10  # 3.6 rad/s before
    simulation.save_checkpoint(tmp_path / "pieces.tissu")
    resumed = scene.compile(checkpoint=tmp_path / "pieces.tissu")
    idle = np.setdiff1d(np.arange(22), simulation._left("fascia").weights.frames)
    places = simulation.positions["fascia"][idle].copy()
    for one in (simulation, resumed):
        steps(one, 3)
    assert same(simulation, resumed)
    assert len(idle) > 2
    assert simulation.positions["fascia"][idle] == pytest.approx(places, abs=1e-15)


@pytest.mark.parametrize("kind", ["knife", "ablator"])
def test_instruments_sever_tissue_at_the_end_of_a_step(kind: str) -> None:
    ways = {"times": (0, 0.05), "positions": [(0, -0.02, 0.055), (0, 0.12, 0.055)]}
    path = ts.ToolPath(**ways)
    tool: Any = ts.Knife(edge=[(-0.02, 0, 0), (0.12, 0, 0)], cuts=["fascia"], path=path)
    if kind == "ablator":
        ends = [(-0.02, 0, 0), (0.12, 0, 0)]
        tool = ts.Ablator(radius=0.004, ends=ends, removes=["fascia"], path=path)
    simulation = hanging(gravity=None, instruments={"tool": tool}).compile()
    reports = [cut for _ in range(11) for cut in simulation.step().cuts]
    assert {report.by for report in reports} == {"tool"}
    if kind == "knife":
        at_once = hanging(gravity=None).compile()
        at_once.cut("fascia", MIDDLE)
        assert np.array_equal(simulation._severed["fascia"], at_once._severed["fascia"])
    else:
        gone = sorted(p for report in reports for p in report.points_gone)
        heights = np.abs(simulation._links["fascia"].points[:, 2] - 0.055)
        assert gone == np.flatnonzero(heights <= 0.004).tolist()
    named = "ablation" if kind == "ablator" else "cut"
    assert all(str(report).startswith(f"{named} of 'fascia' by tool: ") for report in reports)
    lines = cut_lines(simulation, [cut_record(0.05, report) for report in reports])
    done = {"knife": "cut", "ablator": "ablated"}[kind]
    assert lines[0].startswith(f"fascia was {done} by tool at 0.05 s: ")


def test_the_example_comes_apart(tmp_path: Path) -> None:
    """The scalpel parts the tissue in two, and the lower block falls freely from then on."""
    job = Job(EXAMPLES / "severed.yaml", tmp_path, None, None, quiet=True, picture=False)
    assert run_scene(job) == 0
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    cuts = summary["cuts"]
    assert {cut["by"] for cut in cuts} == {"scalpel"}
    assert sum(cut["links_severed"] for cut in cuts) > 200
    assert [piece["held"] for piece in cuts[-1]["pieces"][:2]].count(True) == 1
    gone = [point for cut in cuts for point in cut["points_gone"]]
    mass = sum(cut["mass_change"] for cut in cuts)
    assert (mass < 0.0) == bool(gone)
    last = ts.read_mesh(max(tmp_path.rglob("fascia_*.vtu")))
    assert len(last.points) == sum(piece["cells"] for piece in cuts[-1]["pieces"])
    fallen = np.ptp(last.points[:, 2])
    parted = cuts[-1]["time"]
    assert fallen > 0.05 + 0.8 * G * (summary["simulated_seconds"] - parted) ** 2 / 2


@pytest.mark.parametrize(
    ("scene", "call", "words"),
    [
        ({"editing": None}, lambda s: s.cut("fascia", MIDDLE), "without editing"),
        ({}, lambda s: s.cut("fascia", "here"), "as a blade"),
        ({}, lambda s: s.cut("fasci", MIDDLE), "found body 'fasci'"),
        ({}, lambda s: s.ablate("fascia", ts.Sphere((0, 0, 0), 1)), "no point of tissue"),
        ({}, lambda s: s.ablate("fascia", MIDDLE), "to ablate"),
        ({}, lambda s: s.remove_cells(body="fascia", cells=[0]), "fascia"),
    ],
)  # fmt: skip
def test_wrong_uses_are_refused_in_one_sentence(
    scene: dict[str, Any], call: Any, words: str
) -> None:
    simulation = hanging(**scene).compile() if scene else simulated()
    with pytest.raises(ts.ParameterError, match=words) as refused:
        call(simulation)
    assert "\n" not in str(refused.value)


def test_scenes_that_tear_tissue_or_press_it_are_refused() -> None:
    knife = ts.Knife(edge=[(0, 0, 0), (0, 0, 0.01)], cuts=["fascia"], toughness=100)
    with pytest.raises(ts.SceneError, match="toughness of a knife that cuts the tissue 'fascia'"):
        hanging(instruments={"scalpel": knife}).compile()
    tear = ts.Tear("fascia", strength=1e4, length=0.02)
    with pytest.raises(ts.SceneError, match="tear of tissue 'fascia'"):
        hanging(tear=[tear]).compile()


def test_a_cut_after_which_an_explicit_step_is_unstable_is_refused() -> None:
    """Lighter frames are faster: a step between the stable ones before and after is refused."""
    simulation = hanging(step=ts.SymplecticEuler("0.4 ms"), gravity=None).compile()
    simulation.cut("fascia", MIDDLE)
    before = simulation.stable_step
    simulation.cut("fascia", ACROSS)
    after = simulation.stable_step
    assert 0.9 * before < after < before
    step = ts.SymplecticEuler(0.5 * (before + after))
    simulation = hanging(step=step, gravity=None).compile()
    first = simulation.cut("fascia", MIDDLE).links_severed
    with pytest.raises(ts.ParameterError, match="above the stable one"):
        simulation.cut("fascia", ACROSS)
    assert len(simulation._severed["fascia"]) == first
    assert simulation.stable_step == before
    steps(simulation, 2)
