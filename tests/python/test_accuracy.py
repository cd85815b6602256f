"""Work and precision: cases, references, errors, fronts, and the command."""

import csv
import io
import json
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import tissu as ts
from tissu.accuracy import Run, cheapest, front, read_case, read_cases, study
from tissu.accuracy.change import changed
from tissu.accuracy.figure import draw
from tissu.accuracy.front import reached, sentence
from tissu.accuracy.measure import cubic
from tissu.accuracy.page import page
from tissu.accuracy.table import curves, printed, to_csv, to_parquet
from tissu.cli.app import app
from tissu.cli.bench import CASES
from tissu.errors import ParameterError, SceneError

OURS = Path(__file__).parents[2] / "bench" / "cases"
SCENE = """
bodies:
  bar:
    mesh: {type: bar, size: [4, 1, 1], cells: [4, 2, 2], cell: hexahedron, origin: [0, -0.5, -0.5]}
    law: {type: hooke, young: 1 MPa, poisson: 0}
    density: 1000
fixed:
  - {body: bar, on: {type: plane, point: [0, 0, 0], normal: [1, 0, 0]}}
loads:
  - type: traction
    body: bar
    on: {type: plane, point: [4, 0, 0], normal: [1, 0, 0]}
    traction: [10 kPa, 0, 0]
step: {type: static, solver: {type: cholesky}}
"""
# nu = 0 and pulled along x: u = (0.01 x, 0, 0), which every element holds exactly
AFFINE = "{type: affine, body: bar, gradient: [[0.01, 0, 0], [0, 0, 0], [0, 0, 0]]}"
STUDY = """
title: A bar that is pulled
reference: %s
choices:
  - name: "{cell}"
    vary:
      bodies.bar.mesh.cell: [hexahedron, tetra]
      bodies.bar.mesh.cells: [[4, 2, 2], [8, 2, 2]]
    small:
      bodies.bar.mesh.cells: [[4, 2, 2]]
  - {name: "young", vary: {bodies.bar.law.young: [1.1 MPa, 2 MPa]}}
  - {name: "only in full", full_only: true}
printed:
  - {where: table 1, what: softer, error: 0.002, run: young 1.1 MPa}
notes: [A note.]
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "bar.yaml").write_text(SCENE)
    (tmp_path / "bar.study.yaml").write_text(STUDY % AFFINE)
    return tmp_path


def written(folder, reference):
    (folder / "bar.study.yaml").write_text(STUDY % reference)
    return read_case(folder / "bar.yaml")


def test_a_study_finds_the_errors_of_the_closed_form(folder):
    found = study(read_case(folder / "bar.yaml"), "small")
    by_label = {run.label: run for run in found.runs}
    assert list(by_label) == ["hexahedron 4x2x2", "tetra 4x2x2", "young 1.1 MPa", "young 2 MPa"]
    assert found.size == pytest.approx(0.04)
    for label in ("hexahedron 4x2x2", "tetra 4x2x2"):
        assert by_label[label].largest < 1e-13
    # u is 1 / 1.1 of it, so the error is 1 - 1 / 1.1 of u: 0.04 m at the end, half in the mean
    stiff = by_label["young 1.1 MPa"]
    assert stiff.largest == pytest.approx(0.04 * (1 - 1 / 1.1), rel=1e-9)
    assert stiff.share == pytest.approx(0.5 * (1 - 1 / 1.1), rel=1e-9)
    assert stiff.outcome == "finished"
    assert stiff.steps == 1
    assert stiff.unknowns == 3 * 5 * 3 * 3
    assert stiff.seconds > 0
    assert stiff.megabytes > 0


def test_the_full_preset_runs_all(folder):
    case = read_case(folder / "bar.yaml")
    labels = [label for label, _, _ in case.variants("full")]
    assert labels[:4] == [f"{c} {n}x2x2" for c in ("hexahedron", "tetra") for n in (4, 8)]
    assert labels[-1] == "only in full"


def test_a_curve_goes_through_its_stations(folder):
    x = np.linspace(0, 4, 9)
    moved = np.stack([0.01 * x, 0 * x, 0 * x], axis=1)
    np.savez(folder / "line.npz", x=x, u=moved)
    case = written(folder, "{type: curve, body: bar, file: line.npz, displacements: u}")
    run = study(case, "small").runs[0]
    assert run.largest < 1e-13
    assert run.mean < 1e-13


def test_points_and_places(folder):
    points = [[4, 0.5, 0.5], [2, 0, 0], [1.234, 0, 0]]
    np.savez(
        folder / "p.npz", points=points, displacements=[[0.04, 0, 0], [0.02, 3e-3, 0], [9, 9, 9]]
    )
    case = written(folder, "{type: points, body: bar, file: p.npz}")
    run = study(case, "small").runs[0]
    assert run.largest == pytest.approx(3e-3, rel=1e-9)  # the third is no node
    assert run.mean == pytest.approx(1.5e-3, rel=1e-9)
    place = "{type: place, body: bar, rest: [4, 0, 0], position: [4.05, 0, 0]}"
    assert study(written(folder, place), "small").runs[0].mean == pytest.approx(0.01, rel=1e-9)


def test_some_components_are_compared(folder):
    np.savez(folder / "p.npz", points=[[4, 0.5, 0.5]], displacements=[[1.0, 4e-3, 3.0]])
    case = written(folder, "{type: points, body: bar, file: p.npz, axes: y}")
    run = study(case, "small").runs[0]
    assert run.mean == pytest.approx(4e-3, rel=1e-9)  # nu = 0: the bar does not move across
    assert run.share == pytest.approx(1.0, rel=1e-9)  # of 4 mm, not of the metres of x and z
    for wrong in ("xx", "yx", "w", "''"):
        with pytest.raises(ParameterError, match="axes"):
            written(folder, f"{{type: points, body: bar, file: p.npz, axes: {wrong}}}")


def test_what_the_paper_measured_against_stands_beside(folder):
    paper = "paper: {type: place, body: bar, rest: [4, 0, 0], position: [4.05, 0, 0]}\n"
    file = folder / "bar.study.yaml"
    file.write_text(file.read_text() + paper)
    found = study(read_case(folder / "bar.yaml"), "small")
    assert found.runs[0].mean < 1e-13
    assert found.runs[0].as_paper == pytest.approx(0.01, rel=1e-9)
    head, rows = printed(found)
    assert head[4:6] == ["as in the paper [mm]", "to the reference [mm]"]
    # 1 / 1.1 of 40 mm at the end, 50 mm wanted; half of 0.04 (1 - 1 / 1.1) in the mean
    assert rows[0][:6] == ["table 1: softer", "2", "-", "young 1.1 MPa", "13.6", "1.82"]
    file.write_text(file.read_text().replace(paper, ""))
    one = study(read_case(folder / "bar.yaml"), "small")
    assert one.runs[0].as_paper is None
    assert "as in the paper [mm]" not in printed(one)[0]


def test_cubics_are_met_between_stations():
    x = np.array([0.0, 0.3, 1.0, 1.2, 2.0, 3.5])
    f = np.stack([x**3 - x, 2 * x**2], axis=1)
    at = np.linspace(0, 3.5, 29)
    assert cubic(x, f, at) == pytest.approx(np.stack([at**3 - at, 2 * at**2], axis=1), abs=1e-13)


def test_fields_are_changed_by_their_paths(folder):
    file = folder / "bar.yaml"
    scene = changed(
        file, {"bodies.bar.law": {"type": "stvk", "young": 5, "poisson": 0.1}, "threads": 2}
    )
    assert scene.bodies["bar"].law == ts.StVK(young=5.0, poisson=0.1)
    assert scene.threads == 2
    assert changed(file, {"fixed.0.axes": "x"}).fixed[0].axes == "x"
    assert changed(file, {}) == ts.Scene.from_yaml(file)
    with pytest.raises(ParameterError, match=r"bodies\.rod\.law: the scene has no 'rod'"):
        changed(file, {"bodies.rod.law": 1})
    with pytest.raises(SceneError, match="unknown"):
        changed(file, {"bodies.bar.lawn": 1})


def test_a_variant_that_is_no_scene_is_a_row_that_says_why(folder):
    text = (folder / "bar.study.yaml").read_text().replace("[1.1 MPa, 2 MPa]", "[-1, 2 MPa]")
    (folder / "bar.study.yaml").write_text(text)
    refused, good = study(read_case(folder / "bar.yaml"), "small").runs[2:]
    assert refused.outcome == "refused"
    assert "young" in refused.why
    assert not refused.counts
    assert good.counts


def runs(*pairs):
    return [
        Run(f"r{n}", "c", {}, "finished", mean=e, largest=e, share=e, seconds=s)
        for n, (s, e) in enumerate(pairs)
    ]


def test_the_front_is_what_nothing_beats():
    some = runs((1, 0.5), (2, 0.5), (2, 0.1), (3, 0.2), (4, 0.05), (0.5, 0.9))
    some.append(Run("slow and wrong", "c", {}, "not converged", share=0.0, seconds=0.01))
    assert [run.label for run in front(some)] == ["r5", "r0", "r2", "r4"]
    for run in some:  # by the definition
        beaten = any(
            o.counts
            and o.seconds <= run.seconds
            and o.share <= run.share
            and o != run
            and (o.seconds < run.seconds or o.share < run.share)
            for o in some
        )
        assert (run in front(some)) == (run.counts and not beaten)
    assert cheapest(some, 0.1).label == "r2"
    assert cheapest(some, 0.01) is None


def test_the_time_to_an_error_lies_between_the_runs_of_a_curve():
    curve = runs((8, 1e-4), (1, 1e-1), (2, 1e-2))
    assert reached(curve, 1e-1) == 1
    assert reached(curve, 0.5) == 1  # the fastest is good enough
    assert reached(curve, 1e-2) == pytest.approx(2)
    # errors fall as t^-(1 / log10(2)) from 1 to 2, as t^-(2 / log10(4)) from 2 to 8
    assert reached(curve, 10**-1.5) == pytest.approx(2**0.5)
    assert reached(curve, 1e-3) == pytest.approx(4)
    assert reached(curve, 1e-5) is None
    assert reached(runs((1, 0.1), (3, 0.0)), 1e-3) == 3  # nothing to interpolate with
    assert reached([], 0.1) is None


def test_curves_are_set_beside_the_best(folder):
    text = (
        (folder / "bar.study.yaml").read_text().replace("choices:", "goals: [0.06, 1e-6]\nchoices:")
    )
    (folder / "bar.study.yaml").write_text(text)
    found = study(read_case(folder / "bar.yaml"), "small")
    head, rows = curves(found)
    assert head == ["to reach", "6 % [ms]", "times the best", "0.0001 % [ms]", "times the best"]
    by_name = {row[0]: row[1:] for row in rows}
    assert set(by_name) == {"hexahedron", "tetra", "young"}
    assert by_name["young"][2:] == ["-", "-"]  # 4.5 % off at best
    times = [float(row[3]) for row in rows if row[3] != "-"]
    ratios = [float(row[4]) for row in rows if row[4] != "-"]
    assert min(ratios) == 1
    assert max(ratios) == pytest.approx(max(times) / min(times), rel=2e-2)  # three digits each
    assert "<h3>What each choice takes</h3>" in page([found], "A machine.")


def test_the_sentence_names_the_cheapest_or_the_nearest(folder):
    text = sentence(study(read_case(folder / "bar.yaml"), "small"))
    assert text.startswith("Cheapest for 1 %")
    assert text.count("Cheapest for") == len(
        {part.split(": ")[1] for part in text.split("Cheapest for")[1:]}
    )
    case = written(
        folder, "{type: affine, body: bar, gradient: [[0.02, 0, 0], [0, 0, 0], [0, 0, 0]]}"
    )
    text = sentence(study(case, "small"))
    assert "No run reaches 1 %. Nearest: " in text
    assert "with 25 %" in text  # half of the mean of half


def test_the_page_and_the_table_hold_every_run(folder):
    found = study(read_case(folder / "bar.yaml"), "small")
    text = page([found], "A machine.")
    # heads of three tables; runs; three curves come to 1 % or to 0.1 %; one printed number
    assert len(curves(found)[1]) == 2
    assert text.count("<tr") == 3 + len(found.runs) + 2 + 1
    assert "http" not in text.replace("http://www.w3.org", "").replace(
        "http://purl.org", ""
    ).replace("http://creativecommons.org", "").replace(
        "https://matplotlib.org", ""
    )  # needs no other file
    assert "table 1: softer" in text
    assert "A note." in text
    rows = list(csv.DictReader(io.StringIO(to_csv([found]))))
    assert [row["label"] for row in rows] == [run.label for run in found.runs]
    assert json.loads(rows[2]["changes"]) == {"bodies.bar.law.young": "1.1 MPa"}
    assert sum(int(row["on_front"]) for row in rows) == len(front(found.runs))


def test_the_diagram_tells_what_missed_its_tolerance(folder):
    found = study(read_case(folder / "bar.yaml"), "small")
    labels = [text.get_text() for text in draw(found).legends[0].get_texts()]
    assert labels == ["hexahedron", "tetra", "young", "front"]
    *others, last = found.runs
    missed = replace(found, runs=(*others, replace(last, outcome="not converged")))
    labels = [text.get_text() for text in draw(missed).legends[0].get_texts()]
    assert labels == ["hexahedron", "tetra", "young", "tolerance not met", "front"]


def test_parquet_holds_what_the_csv_holds(folder, tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    found = study(read_case(folder / "bar.yaml"), "small")
    (tmp_path / "a.parquet").write_bytes(to_parquet([found]))
    table = parquet.read_table(tmp_path / "a.parquet")
    rows = list(csv.DictReader(io.StringIO(to_csv([found]))))
    assert table.column_names == list(rows[0])
    for row, other in zip(table.to_pylist(), rows, strict=True):
        written = {name: int(v) if isinstance(v, bool) else v for name, v in row.items()}
        assert {name: "" if v is None else str(v) for name, v in written.items()} == other
    assert str(table.schema.field("seconds").type) == "double"
    assert str(table.schema.field("steps").type) == "int64"


def test_the_command_writes_all(folder, tmp_path):
    out = tmp_path / "out"
    done = CliRunner().invoke(app, ["bench", "accuracy", "--cases", str(folder), "-o", str(out)])
    assert done.exit_code == 0, done.output
    assert "young 2 MPa: 25 %" in done.output
    assert {file.name for file in out.iterdir()} == {
        "accuracy.html",
        "accuracy.csv",
        "accuracy.json",
        "bar.png",
        *(["accuracy.parquet"] if find_spec("pyarrow") else []),
    }


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["nothing"], "no case 'nothing'"),
        (["--preset", "large"], "--preset: found 'large'; small or full is accepted"),
    ],
)
def test_wrong_words_are_told(folder, arguments, message):
    done = CliRunner().invoke(app, ["bench", "accuracy", "--cases", str(folder), *arguments])
    assert done.exit_code == 2
    assert message in done.output


def test_wrong_files_are_told(folder, tmp_path_factory):
    with pytest.raises(ParameterError, match="no case there"):
        read_cases(tmp_path_factory.mktemp("empty"))
    with pytest.raises(ParameterError, match="reference"):
        written(folder, "{type: guess}")
    with pytest.raises(ParameterError, match="not YAML"):
        written(folder, "{")
    (folder / "bar.study.yaml").unlink()
    with pytest.raises(ParameterError, match=r"no such file; a case is NAME\.yaml"):
        read_case(folder / "bar.yaml")
    case = written(folder, "{type: points, body: bar, file: none.npz}")
    with pytest.raises(ParameterError, match=r"none\.npz: no such file"):
        study(case, "small")


def test_every_case_of_tissu_is_a_scene_that_compiles():
    """The richest variants are left to the bench; that all are scenes is seen here."""
    cases = read_cases(OURS)
    assert len(cases) >= 10
    assert [case.name for case in read_cases(CASES)] == [case.name for case in cases]  # installed
    for case in cases:
        if case.needs:
            continue
        labels = set()
        for label, _, changes in case.variants("full"):
            assert label not in labels, f"{case.name}: {label} twice"
            labels.add(label)
            assert changed(case.scene, changes).check().problems == [], (case.name, label)
        for entry in case.printed:
            assert entry.run is None or entry.run in labels, (case.name, entry.run)


@pytest.mark.parametrize("dt", [0.002, 0.01])
def test_mujocos_elastic_body_swings_down(dt):
    """Its own engine loses it at 2 ms: here it stays near the reference and gains no energy."""
    case = read_case(OURS / "floppy.yaml")
    simulation = changed(case.scene, {"step.dt": dt}).compile()
    assert simulation.meshes["bar"].cell_count == 23 * 3 * 3 * 6
    for report in simulation.run():
        assert report.converged
    deviation = case.reference.deviation(simulation)
    # implicit Euler is of first order: 1.6 % at 10 ms and 0.32 % at 2 ms when this was written
    assert deviation.mean < 2.0 * dt * deviation.size
