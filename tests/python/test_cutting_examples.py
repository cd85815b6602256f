"""The examples with instruments: what they cut, and what the summary of a run says of it."""

from __future__ import annotations

import json
import runpy
from pathlib import Path

import numpy as np
import pytest

import tissu as ts
from tissu.cli.run import Job, run_scene

EXAMPLES = Path(__file__).parents[2] / "examples"


def test_the_scalpel_leaves_one_incision(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    job = Job(EXAMPLES / "scalpel.yaml", tmp_path, None, None, quiet=False, picture=False)
    assert run_scene(job) == 0
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    cuts = summary["cuts"]
    assert {cut["by"] for cut in cuts} == {"scalpel"}
    assert all(0.3 < cut["time"] <= 1.0 + 1e-9 for cut in cuts)
    assert len(cuts[-1]["pieces"]) == 1
    # 3.7 cm along and 1.4 cm deep, in material that is drawn out across: front a cell behind.
    area = sum(cut["area"] for cut in cuts)
    assert area == pytest.approx(0.037 * 0.014, rel=0.25)
    (line,) = (line for line in capsys.readouterr().out.splitlines() if "was cut" in line)
    first, last = cuts[0]["time"], cuts[-1]["time"]
    opened = f"{1e4 * area:.3g} cm2 opened, 1 piece, 0 of them not held on all axes"
    said = f"tissue was cut by scalpel from {first:.4g} s to {last:.4g} s: {opened}; "
    assert line.startswith(f"{said}{len(cuts)} edits took ")
    assert abs(sum(cut["mass_change"] for cut in cuts)) < 1e-12


def test_the_capsule_opens(tmp_path: Path) -> None:
    job = Job(EXAMPLES / "capsule.yaml", tmp_path, None, None, quiet=True, picture=True)
    assert run_scene(job) == 0
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    cuts = summary["cuts"]
    assert {cut["by"] for cut in cuts} == {"scalpel"}
    assert len(cuts[-1]["pieces"]) == 1
    assert abs(sum(cut["mass_change"] for cut in cuts)) < 1e-12
    # Two legs of 22.4 mm; a front lies less than a cell of 3.3 mm behind each end.
    length = sum(cut["area"] for cut in cuts) / 1e-3
    assert 0.0447 - 2 * 0.0034 < length < 0.0447
    # The last frame has the material, whose points move with it.
    frames = sorted(tmp_path.rglob("*.vtu"))
    assert len(frames) == 10
    frame = ts.read_mesh(frames[-1])
    assert len(frame.points) > 37 * 25 + 20


def test_the_incision_opens_in_a_folder_that_is_not_there_yet(tmp_path: Path) -> None:
    program = runpy.run_path(str(EXAMPLES / "incision.py"))
    simulation = program["main"](tmp_path / "results")
    assert (tmp_path / "results" / "incision.pvd").is_file()
    assert (tmp_path / "results" / "incision.png").is_file()
    (piece,) = simulation.pieces("tissue")
    assert piece.volume == pytest.approx(0.12 * 0.06 * 0.024, rel=1e-12)
    # 13 mm deep along a bow over 36 mm that is 6 mm high, so 38.5 mm long; its front a cell behind.
    surface = simulation.surface("tissue")
    a, b, c = surface.points[surface.triangles[surface.cut]].swapaxes(0, 1)
    walls = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    assert walls == pytest.approx(2 * 0.013 * 0.0385, rel=0.25)
    # The walls part, by less than the 24 mm by which the block was drawn out.
    positions = simulation.positions["tissue"]
    parted = np.linalg.norm(positions - positions[simulation.born("tissue")], axis=1)
    assert 3e-3 < parted.max() < 24e-3


def test_the_strip_tears_from_its_notch() -> None:
    simulation = ts.Scene.from_yaml(EXAMPLES / "tear.yaml").compile()
    cuts: list[tuple[float, ts.CutReport]] = []
    for report in simulation.run():
        assert report.converged
        cuts += [(report.time, cut) for cut in report.cuts]
        if len(simulation.pieces("strip")) > 1:
            break
    assert {cut.by for time, cut in cuts if time < 0.2} == {"blade"}
    assert {cut.by for time, cut in cuts if time > 0.2} == {"tear"}
    pieces = simulation.pieces("strip")
    assert [piece.held for piece in pieces] == [True, True]
    for piece in pieces:
        assert piece.volume == pytest.approx(24e-6, rel=0.1)
