"""`tissu run` of scenes with trocars: stepped ticks, tables, the summary, and what is refused."""

from __future__ import annotations

import csv
import itertools
import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner, Result

from tissu.cli.app import app
from tissu.trocar.controller import Controller
from tissu.trocar.states import State

TEXT = (Path(__file__).parents[3] / "examples" / "trocar.yaml").read_text(encoding="utf-8")
DEEPER = TEXT.replace("0.118", "0.13").replace("duration: 0.1 s", "duration: 0.8 s")


def run(folder: Path, text: str, *options: str) -> Result:
    """The command in a folder."""
    (folder / "scene.yaml").write_text(text, encoding="utf-8")
    return CliRunner().invoke(
        app,
        ["run", str(folder / "scene.yaml"), "--out", str(folder / "out"), "--no-picture", *options],
    )


def table(folder: Path) -> list[dict[str, Any]]:
    """Lines of the trocar's table."""
    with (folder / "out" / "trocar-right.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_a_run_ticks_its_trocars(tmp_path: Path) -> None:
    """The table has every step; its forces are the summary's, and both sides feel the tissue."""
    found = run(tmp_path, DEEPER)
    assert found.exit_code == 0, found.output
    lines = table(tmp_path)
    assert len(lines) == 80
    assert lines[-1]["tool"] == "probe" and lines[-1]["state"] == "contact"
    step = [np.hypot.reduce([float(one[f"step F{a} [N]"]) for a in "xyz"]) for one in lines]
    tick = [np.hypot.reduce([float(one[f"tick F{a} [N]"]) for a in "xyz"]) for one in lines]
    assert step[-1] > 0.3
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))
    right = summary["trocars"]["right"]
    assert right["largest_force_of_steps"] == pytest.approx(max(step), rel=1e-8)
    assert right["largest_force_of_ticks"] == pytest.approx(max(tick), rel=1e-8)
    assert summary["files"]["trocar right"] == "trocar-right.csv"


def test_the_same_table_twice(tmp_path: Path) -> None:
    """Stepped: bit for bit."""
    texts = []
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        assert run(tmp_path / name, DEEPER, "--duration", "0.5 s").exit_code == 0
        texts.append((tmp_path / name / "out" / "trocar-right.csv").read_bytes())
    assert texts[0] == texts[1]


def test_a_run_in_real_time_takes_its_time(tmp_path: Path) -> None:
    """Ticks go on in a thread; whether they are late is for the machine to say."""
    found = run(tmp_path, DEEPER, "--realtime", "--duration", "0.2 s")
    assert found.exit_code == 0, found.output
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))
    right = summary["trocars"]["right"]
    assert right["missed_ticks"] >= 0
    assert len(table(tmp_path)) == 20
    line = next(one for one in found.output.splitlines() if one.startswith("trocar:"))
    assert f"right ended {right['state']} with {right['tool'] or 'no tool'}; " in line
    assert f"{right['late_steps']} late step" in line


def test_what_is_said_of_the_end_is_of_one_moment(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Ticks that go on after the last step change neither the summary nor the line."""
    states = itertools.cycle(State)
    report = Controller.report
    monkeypatch.setattr(
        Controller, "report", lambda self: replace(report(self), state=next(states))
    )
    found = run(tmp_path, TEXT, "--duration", "0.05 s")
    assert found.exit_code == 0, found.output
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))
    assert f"right ended {summary['trocars']['right']['state']} with " in found.output


def test_a_trocar_that_ends_held_is_said(tmp_path: Path) -> None:
    """A hand faster than the limit: the run has its results, and a sentence."""
    found = run(
        tmp_path,
        DEEPER.replace("speed: 2 m/s", "speed: 0.2 m/s").replace("0.7 s, 1.2", "0.22 s, 1.2"),
    )
    assert found.exit_code == 0
    assert "trocars.right ended held" in found.output
    assert len(table(tmp_path)) == 80


REFUSED = {
    "a device that is not simulated": (
        TEXT.replace(
            TEXT[TEXT.index("    device:") : TEXT.index("    tools:")],
            "    device: {type: udp, host: 127.0.0.1, port: 9, damping: [1, 1, 1, 1], "
            "friction: [1, 1, 1, 1]}\n",
        ),
        (),
        "run with --realtime",
    ),
    "real time of nothing": (
        TEXT[: TEXT.index("trocars:")] + TEXT[TEXT.index("step:") :],
        ("--realtime",),
        "no trocars in the scene",
    ),
    "a tool that meets nothing": (
        TEXT[: TEXT.index("contacts:")] + TEXT[TEXT.index("trocars:") :],
        (),
        "which no contact of the scene names",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_refused(case: str, tmp_path: Path) -> None:
    """In one sentence, with the exit code of bad input."""
    text, options, words = REFUSED[case]
    found = run(tmp_path, text, *options)
    assert found.exit_code == 2, found.output
    assert words in found.output.replace("\n", " ")
