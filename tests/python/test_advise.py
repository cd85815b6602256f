"""tissu advise: what its table says, against runs taken apart, and the scene it writes."""

import contextlib
import csv
import io
import re
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import tissu as ts
from beam import beam as swinging
from tissu.advice.rows import front
from tissu.cli.app import app
from tissu.mesh.places import places


def beam(**changes):
    return swinging("200 kPa", **changes)


def static():
    return beam(step=ts.Static(), duration=None)


@pytest.fixture(scope="module")
def moving():
    return ts.advise(beam(), "5%", 30, budget=5)


@pytest.fixture(scope="module")
def resting():
    return ts.advise(static(), "2%", 5, budget=5)


def samples(scene, points, times):
    """Displacements at `points` at rest, linear between the ends of the scene's steps."""
    simulation = scene.compile()
    at = places(points, simulation.meshes["bar"])
    ends, moved = [0.0], [np.zeros_like(points)]
    for _ in simulation.run():
        ends.append(simulation.time)
        moved.append(at.values(simulation.displacements("bar")))
    flat = np.reshape(moved, (len(ends), -1))
    found = [np.interp(times, ends, column) for column in flat.T]
    return np.transpose(found).reshape(len(times), *points.shape)


def reference_of(advice):
    (row,) = [row for row in advice.rows if row.is_reference]
    return row


def test_the_first_row_is_the_scene_itself(moving):
    assert moving.rows[0].scene == beam()
    assert moving.rows[0].outcome == "finished"
    assert (moving.rows[0].cells, moving.rows[0].unknowns) == (4, 60)


def test_distances_are_those_of_runs_taken_apart(moving):
    points = np.array(beam().compile().meshes["bar"].points)
    times = 0.01 * np.arange(1, 11)
    rich = samples(reference_of(moving).scene, points, times)
    assert moving.largest == pytest.approx(np.linalg.norm(rich, axis=2).max(), rel=1e-9)
    judged = [row for row in moving.rows if row.distance and row.error]
    assert len(judged) >= 5
    for row in (*judged[:3], *judged[-3:]):
        apart = np.linalg.norm(samples(row.scene, points, times) - rich, axis=2).mean()
        assert row.distance == pytest.approx(apart, rel=1e-6)
        own = moving.reference_error or 0.0
        assert row.error == pytest.approx(apart + own, rel=1e-6)
        assert row.error_percent == pytest.approx(100 * row.error / moving.largest, rel=1e-9)


def test_the_answer_is_the_cheapest_row_that_meets_both(moving):
    good = [
        row
        for row in moving.rows
        if row.error is not None and row.error <= 0.05 * moving.largest and row.rate >= 30
    ]
    assert good
    assert all(row.meets_error and row.meets_rate for row in good)
    assert moving.chosen is min(good, key=lambda row: row.ms_per_update)
    assert moving.answer.startswith(f"take {moving.chosen.name} (")
    assert "the cheapest that meets 5 % at 30 updates a second" in moving.answer


def test_ms_per_update_and_rate_follow_from_the_steps(moving):
    for row in moving.rows:
        if row.steps and row.outcome == "finished":
            dt = 0.1 / row.steps
            assert row.ms_per_update == pytest.approx(row.ms_per_step / 30 / dt, rel=1e-6)
            assert row.rate == pytest.approx(1e3 / row.ms_per_update, rel=1e-6)


def test_the_reference_is_richer_and_says_its_own_error(moving):
    row = reference_of(moving)
    assert row.unknowns > moving.rows[0].unknowns
    assert "hexahedron20" in row.mesh
    assert row.step in ("bdf2 2.5 ms", "symplectic_euler auto")  # whichever took less time
    if moving.reference_error is None:
        assert "its own error is not known" in moving.reference
        assert row.error is None
        assert not row.meets_error
    else:
        assert f"observed order {moving.space_order:.2f}" in moving.reference
        assert f"observed order {moving.time_order:.2f}" in moving.reference
        assert row.error == moving.reference_error


def test_a_static_scene_is_one_solve_an_update(resting):
    assert all(row.steps == 1 for row in resting.rows if row.outcome == "finished")
    assert all(row.ms_per_update == row.ms_per_step for row in resting.rows)
    assert resting.time_order is None


def test_the_written_scene_runs_and_shows_the_reported_displacements(resting, tmp_path):
    resting.scene.save(tmp_path / "scene.yaml")
    read = ts.Scene.from_yaml(tmp_path / "scene.yaml")
    assert read == resting.scene
    points, end = np.array(static().compile().meshes["bar"].points), np.array([1.0])
    rich = samples(reference_of(resting).scene, points, end)
    apart = np.linalg.norm(samples(read, points, end) - rich, axis=2).mean()
    assert resting.best.distance == pytest.approx(apart, rel=1e-6)


def test_an_error_that_cannot_be_met_is_told_with_its_factor():
    advice = ts.advise(static(), 1e-12, 1e-3, budget=2)
    assert advice.chosen is None
    least = min(row.error for row in advice.rows if row.error is not None)
    factor = least / (1e-12 * advice.largest)
    assert f"cannot be met: the least found is {100 * least / advice.largest:.3g} %, " in (
        advice.answer
    )
    if advice.reference_error is not None:
        assert f"{factor:.3g} times as much" in advice.answer
        assert "the rate of" not in advice.answer
    assert advice.best.error is not None


def test_a_rate_that_cannot_be_met_is_told_with_its_factor():
    advice = ts.advise(static(), 1.0, 1e9, budget=2)
    assert advice.chosen is None
    highest = max(row.rate for row in advice.rows if row.rate is not None)
    assert "the rate of 1e+09 updates a second cannot be met" in advice.answer
    assert f"the highest found is {highest:.3g}, {1e9 / highest:.3g} times too few" in advice.answer
    assert "the error of" not in advice.answer


def test_a_length_may_be_the_error(resting):
    advice = ts.advise(static(), "1 m", 1e-3, budget=2)
    assert advice.goal.is_length
    assert all(row.meets_error for row in advice.rows if row.error is not None)
    assert "meets 1 m at 0.001 updates" in advice.answer


def test_the_model_asked_for_is_tried_and_refusals_are_told():
    advice = ts.advise(static(), "2%", 5, budget=3, models=["corotational", "mass-link"])
    assert any(row.model == "corotational" and row.error for row in advice.rows)
    refused = [row for row in advice.rows if row.outcome == "refused"]
    assert {row.model for row in refused} == {"mass_link"}
    assert all("it takes tetra" in row.why for row in refused)


def test_a_mesh_in_a_file_is_refined_and_written_beside_the_scene(tmp_path):
    ts.write_mesh(ts.bar_mesh(size=(0.2, 0.1, 0.1), cells=(2, 1, 1)), tmp_path / "bar.vtu")
    body = static().bodies["bar"].replace(mesh=ts.MeshFile(tmp_path / "bar.vtu"))
    advice = ts.advise(static().replace(bodies={"bar": body}), "5%", 1, budget=4)
    words = {row.mesh for row in advice.rows}
    assert {"bar.vtu", "12 tetra10", "96 tetra10"} <= words
    made = next(row for row in advice.rows if row.mesh == "96 tetra10")
    made.scene.save(tmp_path / "made.yaml")
    assert (tmp_path / "made-bar.vtu").exists()
    mesh = ts.Scene.from_yaml(tmp_path / "made.yaml").compile().meshes["bar"]
    assert repr(mesh).startswith("Mesh(225 nodes, 96 tetra10")


def test_nodes_selected_by_number_keep_their_mesh():
    ends = ts.Fixed("bar", on=ts.Nodes([0, 5, 10, 15]))
    advice = ts.advise(static().replace(fixed=[ends]), "1%", 1, budget=2)
    assert {row.mesh for row in advice.rows} == {"4x1x1 hexahedron"}
    assert "note: 'bar' keeps its mesh: nodes of it are selected by their numbers" in str(advice)
    assert "the cells are as they are" in advice.reference


def test_an_explicit_scene_is_advised_too():
    advice = ts.advise(beam(step=ts.SymplecticEuler()), "10%", 30, budget=4)
    methods = {row.step.split()[0] for row in advice.rows}
    assert {"symplectic_euler", "bdf2"} <= methods
    assert advice.chosen is not None


def test_the_front_holds_what_is_not_beaten(moving):
    best = front(moving.rows)
    for row in moving.rows:
        if row.error is not None and row.ms_per_update is not None:
            assert any(b.error <= row.error and b.ms_per_update <= row.ms_per_update for b in best)
    assert sorted(best, key=lambda row: row.ms_per_update) == best


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"error": 0}, "error: found 0; more than 0 is accepted"),
        ({"error": "-1%"}, "error: found -1%; more than 0"),
        ({"error": "1 kPa"}, "which is a pressure"),
        ({"rate": 0}, "rate: found 0; more than 0 updates a second"),
        ({"budget": "0 s"}, "budget: found 0 s; a time of more than 0 s"),
        ({"models": ["femm"]}, "unknown model 'femm'; did you mean 'fem'"),
    ],
)
def test_wrong_goals_are_told(asked, said):
    with pytest.raises(ts.ParameterError, match=said) as told:
        ts.advise(beam(), **asked)
    assert "\n" not in str(told.value)


def test_scenes_that_cannot_be_advised_are_told():
    with pytest.raises(ts.ParameterError, match="the scene has no duration"):
        ts.advise(beam(duration=None))
    with pytest.raises(ts.ParameterError, match="one run of the scene takes about"):
        ts.advise(beam(duration=10_000), budget="1 ms")
    with pytest.raises(ts.ParameterError, match="in which nothing moves"):
        ts.advise(beam(gravity=None))
    with pytest.raises(ts.SceneError, match="selects no node"):
        ts.advise(beam(fixed=[ts.Fixed("bar", on=ts.Plane((9, 0, 0), (1, 0, 0)))]))


def test_the_command_writes_scene_table_and_figure(tmp_path):
    file, out = tmp_path / "beam.yaml", tmp_path / "out"
    beam(threads=1).save(file)
    words = ["advise", str(file), "--error", "2%", "--rate", "30", "--budget", "2 s"]
    result = CliRunner().invoke(app, [*words, "-o", str(out)])
    assert result.exit_code == 0, result.output
    assert sorted(p.name for p in out.iterdir()) == [
        *("advice.md", "advice.png", "scene.yaml", "table.csv")
    ]
    with (out / "table.csv").open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert rows[0]["mesh"] == "4x1x1 hexahedron"
    assert float(rows[0]["error"]) > 0
    assert (out / "advice.png").read_bytes().startswith(b"\x89PNG")
    assert "| ms/update |" in (out / "advice.md").read_text(encoding="utf-8")
    assert "scene.yaml (chosen: " in result.output
    ran = CliRunner().invoke(
        app, ["run", str(out / "scene.yaml"), "-q", "-o", str(tmp_path / "run")]
    )
    assert ran.exit_code == 0, ran.output
    assert (tmp_path / "run" / "summary.json").exists()


def test_the_command_tells_a_wrong_error(tmp_path):
    file = tmp_path / "beam.yaml"
    beam().save(file)
    result = CliRunner().invoke(app, ["advise", str(file), "--error", "0"])
    assert result.exit_code == 2
    assert "error: found 0; more than 0 is accepted" in result.output


def test_the_example_of_the_page_runs():
    page = (Path(__file__).parents[2] / "docs" / "guide" / "advise.md").read_text(encoding="utf-8")
    text = re.search(r"```python\n(.*?)```", page, re.DOTALL)[1]
    names = {}
    with contextlib.redirect_stdout(io.StringIO()) as out:
        exec(compile(text, "advise.md", "exec"), names)
    advice = names["advice"]
    assert f"{advice.chosen is not None} {advice.best.name} " in out.getvalue()
    assert names["simulation"].scene == advice.best.scene


def test_the_command_writes_the_nearest_scene_where_none_is_good_enough(tmp_path):
    file, out = tmp_path / "beam.yaml", tmp_path / "out"
    static().save(file)
    words = ["advise", str(file), "--error", "0.1 mm", "--rate", "1e9", "--budget", "1 s"]
    result = CliRunner().invoke(app, [*words, "-o", str(out)])
    assert result.exit_code == 0, result.output
    assert "cannot be met" in result.output
    assert "scene.yaml (nearest: " in result.output
    assert ts.Scene.from_yaml(out / "scene.yaml").check().ok
