"""bench/peers.py: the work that it gives, what it makes of the answers, and of no answer."""

import json
import sys
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import tissu as ts

sys.path.insert(0, str(Path(__file__).parents[2] / "bench"))
import peer_rows
import peers
from peer_mujoco import cube_model, model
from peer_tissu import Bar
from peer_turns import Subject, Taken, side_by_side
from peer_work import Work


@pytest.fixture(scope="module")
def work():
    return peers.bar((8, 2, 2), 0.01)


def test_the_work_is_the_bar(work):
    assert len(work.tetrahedra) == 8 * 2 * 2 * 6
    assert work.volumes.min() > 0.0
    assert work.volumes.sum() == pytest.approx(8.0, rel=1e-14)
    assert work.masses.sum() == pytest.approx(8000.0, rel=1e-14)
    assert (len(work.held), len(work.end)) == (9, 9)
    assert work.tip(work.points + np.array([1.0, 2.0, 3.0])) == pytest.approx([1.0, 2.0, 3.0])


def test_the_work_goes_through_a_file(work, tmp_path):
    work.write(tmp_path / "work.npz")
    read = Work.read(tmp_path / "work.npz")
    assert np.array_equal(read.points, work.points)
    assert np.array_equal(read.tetrahedra, work.tetrahedra)
    assert read.dt == work.dt


def test_mujoco_is_given_the_whole_bar(work):
    flex = ElementTree.fromstring(model(work, "discrete")).find("worldbody/flexcomp")
    cube = peers.cube()
    for way, planes in (("dropped", 1), ("falling", 0)):
        world = ElementTree.fromstring(cube_model(cube, way)).find("worldbody")
        assert len(world.findall("geom")) == planes
    assert np.array_equal(np.array(flex.get("point").split(), dtype=float), work.points.ravel())
    assert np.array_equal(np.array(flex.get("element").split(), int), work.tetrahedra.ravel())
    assert np.array_equal(np.array(flex.find("pin").get("id").split(), int), work.held)


def test_errors_are_shares_of_the_largest_reference():
    reference = [[0.0, 0.0, -1.0], [0.0, 0.0, -2.0], [0.0, 0.0, -1.0]]
    taken = Taken(ms=[9.0, 1.0, 2.0], seen=[[0, 0, -1], [0, 0, -2], [0.3, 0.4, -1]])
    end, over = taken.errors(reference)
    assert end == pytest.approx(0.5 / 2.0)
    assert over == pytest.approx(0.5 / np.sqrt(3) / 2.0)
    assert (taken.first, taken.p(50)) == (9.0, 1.5)


def test_tissu_runs_and_who_is_not_there_is_named(work, tmp_path):
    """No package has the name; the other rows stand."""
    (tmp_path / "work.npz").write_bytes(b"")
    work.write(tmp_path / "work.npz")
    subjects = [Subject("tissu", "all defaults"), Subject("absent", "defaults")]
    found = side_by_side(subjects, {}, tmp_path / "work.npz", steps=7, turn=3)
    tissu, absent = found[subjects[0]], found[subjects[1]]
    assert (len(tissu.ms), len(tissu.seen), tissu.unsolved, tissu.why) == (7, 7, 0, "")
    # Backward Euler falls by g h^2 n (n + 1) / 2; the hold is hardly felt at the far end yet.
    assert tissu.seen[2][2] == pytest.approx(-9.81 * 1e-4 * 6, rel=0.02)
    assert absent.why == "not installed (No module named 'peer_absent')"
    row = peer_rows.implicit_row(subjects[0], tissu, tissu.seen)
    assert len(row) == len(peer_rows.IMPLICIT_HEAD)
    assert row[-3:] == ["0 %", "0 %", "0"]


def test_a_program_that_fails_is_a_row_that_says_why(tmp_path):
    work = peers.bar((8, 2, 2), 0.01)
    Work(work.points, work.tetrahedra[:, [1, 0, 2, 3]], work.dt).write(tmp_path / "work.npz")
    subject = Subject("tissu", "all defaults")
    (taken,) = side_by_side([subject], {}, tmp_path / "work.npz", steps=2, turn=1).values()
    assert "Error" in taken.why
    assert peer_rows.implicit_row(subject, taken, [])[1] == taken.why


def test_a_row_of_the_cube_is_its_steps_that_touch():
    bare = Taken(ms=[9.0, 1.0, 1.0])
    seen = [[0.0, 0.0], [0.0, 0.0], [1e-3, 4.0], *[[5e-4, 2.2]] * 60]
    taken = Taken(ms=[9.0, 9.0, *[3.0] * 61], seen=seen, unsolved=None)
    subject = Subject("tissu", "dropped")
    row = peer_rows.dropped_row(subject, taken, bare, 2.0)
    assert len(row) == len(peer_rows.DROPPED_HEAD)
    # An edge is 50 mm / 6: 1 mm is 12 % of it, 0.5 mm 6 %.
    assert row[2:] == ["1", "3", "3", "12 %", "6 %", "10 %", "does not say"]


def test_the_cube_of_tissu_rests_on_its_plane(tmp_path):
    peers.cube().write(tmp_path / "cube.npz")
    subject = Subject("tissu", "dropped")
    (taken,) = side_by_side([subject], {}, tmp_path / "cube.npz", steps=60, turn=60).values()
    depth, force = np.array(taken.seen).T
    assert taken.unsolved == 0
    # Backward Euler falls g h^2 n (n + 1) / 2: 1.5 cm in five steps, 2.1 cm in six.
    assert not force[:5].any()
    assert force[5:8].max() > 1.2
    # Damped by 5 ms, it has come to rest; the goal of docs/guide/contact.md is 0.1 % of the weight.
    assert force[-10:] == pytest.approx(1000.0 * 0.05**3 * 9.81, rel=1e-3)
    assert depth[-10:].max() < 0.003 * 0.05 / 6


def test_every_subject_has_its_facts():
    for subject in peers.EVERY:
        assert peer_rows.facts(subject).law
        assert peer_rows.facts(subject).step
    lacks = peer_rows.listed(peers.EVERY, "lacks")
    assert all(name in lacks for name in ("MuJoCo", "Rapier", "Taichi"))


def test_the_reference_is_that_of_the_sizes_by_another_method():
    """Two steps of 10 ms by the midpoint rule in steps of 0.5 ms, both of second order."""
    kept = json.loads(peers.REFERENCE.read_text(encoding="utf-8"))
    assert set(kept) == set(peers.SIZES)
    assert all(np.shape(tips) == (peers.STEPS, 3) for tips in kept.values())
    bar = Bar(peers.bar(peers.SIZES["10,368 tetrahedra"], 5e-4), "all defaults")
    newton = ts.Newton(iterations=20, tolerance=1e-8)
    scene = bar._simulation.scene.replace(step=ts.ImplicitMidpoint(5e-4, newton=newton))
    simulation = scene.compile()
    for tip in kept["10,368 tetrahedra"][:2]:
        for _ in range(20):
            simulation.step()
        # BDF2 starts with a step of backward Euler, which is off by g h^2 / 2, h = 1.25 ms.
        away = np.array(bar._work.tip(simulation.positions["bar"])) - tip
        assert np.abs(away).max() <= 2.0 * 9.81 * 1.25e-3 * 0.02


def test_the_section_names_who_is_missing_and_goes_between_its_markers():
    here = Taken(version="1", ms=[2.0, 1.0], seen=[[0, 0, -1.0], [0, 0, -2.0]], unsolved=0)
    found = {"10,368 tetrahedra; implicit": dict.fromkeys(peers.IMPLICIT, here)}
    found["10,368 tetrahedra; explicit"] = dict.fromkeys(peers.EXPLICIT, here)
    gone = Taken(why="not installed (No module named 'mujoco')")
    found["10,368 tetrahedra; implicit"][Subject("mujoco", "discrete")] = gone
    text = peers.section(found, {"10,368 tetrahedra": here.seen}, 2)
    assert "Not installed: MuJoCo." in text
    assert "| MuJoCo, discrete | not installed" in text
    page = peers.PAGE.read_text(encoding="utf-8")
    once = peers.put(page, text)
    assert peers.put(once, "b") == peers.put(page, "b")
    with pytest.raises(SystemExit, match="has no place"):
        peers.put("nothing", text)


def test_only_a_clean_commit_is_written(monkeypatch, capsys):
    monkeypatch.setattr(peers, "commit", lambda: "abc-dirty")
    monkeypatch.setattr(sys, "argv", ["peers.py", "--write"])
    assert peers.main() == 1
    assert "commit all changes first" in capsys.readouterr().err
