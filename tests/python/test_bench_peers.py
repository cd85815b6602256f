"""bench/peers.py: the work that it gives, what it makes of the answers, and of no answer."""

import json
import sys
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import tissu as ts

sys.path.insert(0, str(Path(__file__).parents[2] / "bench"))
import peers
from peer_mujoco import model
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
    assert np.array_equal(np.array(flex.get("point").split(), dtype=float), work.points.ravel())
    assert np.array_equal(np.array(flex.get("element").split(), int), work.tetrahedra.ravel())
    assert np.array_equal(np.array(flex.find("pin").get("id").split(), int), work.held)


def test_errors_are_shares_of_the_largest_reference():
    reference = [[0.0, 0.0, -1.0], [0.0, 0.0, -2.0], [0.0, 0.0, -1.0]]
    taken = Taken(ms=[9.0, 1.0, 2.0], tips=[[0, 0, -1], [0, 0, -2], [0.3, 0.4, -1]])
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
    assert (len(tissu.ms), len(tissu.tips), tissu.unsolved, tissu.why) == (7, 7, 0, "")
    # Backward Euler falls by g h^2 n (n + 1) / 2; the hold is hardly felt at the far end yet.
    assert tissu.tips[2][2] == pytest.approx(-9.81 * 1e-4 * 6, rel=0.02)
    assert absent.why == "not installed (No module named 'peer_absent')"
    row = peers.implicit_row(subjects[0], tissu, tissu.tips)
    assert len(row) == len(peers.HEAD)
    assert row[-3:] == ["0 %", "0 %", "0"]


def test_a_program_that_fails_is_a_row_that_says_why(tmp_path):
    work = peers.bar((8, 2, 2), 0.01)
    Work(work.points, work.tetrahedra[:, [1, 0, 2, 3]], work.dt).write(tmp_path / "work.npz")
    subject = Subject("tissu", "all defaults")
    (taken,) = side_by_side([subject], {}, tmp_path / "work.npz", steps=2, turn=1).values()
    assert "Error" in taken.why
    assert peers.implicit_row(subject, taken, [])[1] == taken.why


def test_every_subject_has_its_facts():
    for subject in [*peers.IMPLICIT, *peers.EXPLICIT]:
        assert peers.facts(subject).law
        assert peers.facts(subject).step
    lacks = peers.listed([*peers.IMPLICIT, *peers.EXPLICIT], "lacks")
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
    here = Taken(version="1", ms=[2.0, 1.0], tips=[[0, 0, -1.0], [0, 0, -2.0]], unsolved=0)
    found = {"10,368 tetrahedra; implicit": dict.fromkeys(peers.IMPLICIT, here)}
    found["10,368 tetrahedra; explicit"] = dict.fromkeys(peers.EXPLICIT, here)
    gone = Taken(why="not installed (No module named 'mujoco')")
    found["10,368 tetrahedra; implicit"][Subject("mujoco", "discrete")] = gone
    text = peers.section(found, {"10,368 tetrahedra": here.tips}, 2)
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
