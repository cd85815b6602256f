"""`tissu bench contact`: its rows say what the scenes do, and the page has a place for them."""

import runpy
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from tissu.cli.app import app
from tissu.cli.bench_contact import HEAD, cells_of
from tissu.contact_cost import CASES, RESPONSES, by_response, measure
from tissu.errors import Diverged
from tissu.simulation import Simulation

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def stick():
    return measure(CASES["stick"]())


def test_a_block_below_the_angle_of_friction_stays(stick):
    """The goals of the page: creep below 1e-6 mm/s, forces within 0.1 %, no crossing."""
    assert stick.ended == ""
    assert stick.moved < 1e-9
    assert stick.force_error < 1e-3
    assert stick.deepest[1] < 3e-3
    assert (stick.crossings, stick.unconverged) == (0, 0)
    assert len(cells_of(stick)) == len(HEAD)


@pytest.mark.parametrize("label", ["penalty, bdf2", "augmented, bdf2"])
def test_every_response_runs_the_same_scene(label):
    """Coulomb's acceleration within 0.5 %, the floor's force within 1 %; nothing crosses."""
    case = by_response(CASES["slide"](), RESPONSES[label])
    assert case.scene().contact.method == RESPONSES[label].method
    assert case.without().contact is None
    row = measure(case)
    assert (row.crossings, row.unconverged, row.ended) == (0, 0, "")
    assert row.slides == pytest.approx(1.0, abs=5e-3)
    assert row.force_error < 1e-2


def test_responses_in_explicit_steps_take_the_stable_one():
    case = by_response(CASES["stick"](), RESPONSES["geometric, symplectic_euler"])
    assert 0.0 < case.dt == case.scene().step.dt < 1e-3


def test_a_row_says_why_it_ended(monkeypatch):
    def fails(_):
        raise Diverged("it went astray.\nMore of it.")

    monkeypatch.setattr(Simulation, "crossings", fails)
    assert measure(CASES["stick"]()).ended == "it went astray."


def test_the_command_names_cases_and_refuses_others():
    listed = CliRunner().invoke(app, ["bench", "contact", "--list"])
    assert [line.split()[0] for line in listed.output.splitlines()] == list(CASES)
    wrong = CliRunner().invoke(app, ["bench", "contact", "stak"])
    assert wrong.exit_code == 2
    assert "found case 'stak'" in wrong.output
    assert "did you mean 'stack'?" in wrong.output


def test_the_tables_go_between_their_markers(monkeypatch):
    monkeypatch.setattr(sys, "path", [str(ROOT / "bench"), *sys.path])
    made = runpy.run_path(str(ROOT / "bench" / "contact.py"), run_name="bench")
    page = (ROOT / "docs" / "measured" / "contact.md").read_text(encoding="utf-8")
    for part in ("steps", "responses", "broad phases"):
        once = made["put"](page, part, "| a |")
        assert "\n\n| a |\n\n" in once
        assert made["put"](once, part, "| b |") == made["put"](page, part, "| b |")
    with pytest.raises(RuntimeError, match="has no place"):
        made["put"]("nothing", "steps", "")
