"""tissu compare: what its rows say, against runs taken apart."""

import csv
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import tissu as ts
from beam import beam as swinging
from tissu.cli.app import app

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def beam(**changes):
    return swinging("50 kPa", **changes)


def final(scene):
    simulation = scene.compile()
    for _ in simulation.run():
        pass
    return simulation


def test_the_reference_itself_has_no_error():
    (row,) = ts.compare(beam(), models=["fem"], reference="fem").rows
    assert (row.mean_error, row.largest_error, row.outcome) == (0.0, 0.0, "finished")
    assert row.unconverged == 0
    assert row.inverted == 0


def test_errors_are_distances_from_the_quadratic_elements():
    static = beam(step=ts.Static(), duration=None)
    (row,) = ts.compare(static, models=["fem"]).rows
    coarse = final(static)
    fine = final(
        static.replace(
            bodies={
                "bar": static.bodies["bar"].replace(mesh=ts.into_quadratic(coarse.meshes["bar"]))
            }
        )
    )
    rich = fine.displacements("bar")[: coarse.meshes["bar"].node_count]
    apart = np.linalg.norm(coarse.displacements("bar") - rich, axis=1)
    assert row.mean_error == pytest.approx(apart.mean(), rel=1e-12)
    assert row.largest_error == pytest.approx(apart.max(), rel=1e-12)
    largest = np.linalg.norm(rich, axis=1).max()
    assert row.mean_percent == pytest.approx(100 * apart.mean() / largest, rel=1e-12)


def test_another_scene_may_be_the_reference():
    fine = beam(
        bodies={
            "bar": beam()
            .bodies["bar"]
            .replace(mesh=ts.BarMesh(size=(0.4, 0.1, 0.1), cells=(8, 2, 2), cell="hexahedron"))
        },
        name="fine",
    )
    comparison = ts.compare(beam(), models=["fem"], reference=fine)
    assert comparison.reference == "the scene fine"
    # 4 x 1 x 1 hexahedra are too stiff in bending; a tenth of a second shows the start of it.
    assert comparison.rows[0].mean_percent > 0.5
    with pytest.raises(ts.ParameterError, match="no node where"):
        ts.compare(fine, models=["fem"], reference=beam())
    with pytest.raises(ts.ParameterError, match="other times"):
        ts.compare(beam(), models=["fem"], reference=fine.replace(step=ts.ImplicitEuler("5 ms")))


def test_the_stable_step_is_that_of_the_largest_frequency():
    (row,) = ts.compare(beam(), models=["fem"], reference="fem").rows
    assert row.stable_step == pytest.approx(2 / beam().compile().largest_frequency())


def test_a_model_that_cannot_is_a_row_that_says_why():
    comparison = ts.compare(beam(), models=["fem", "mass-link"], reference="fem")
    row = comparison.rows[1]
    assert row.outcome == "refused"
    assert "found mass_link for 4 hexahedron cells; it takes tetra" in row.why
    assert "mass_link refused" in str(comparison)


def test_unknown_models_name_the_nearest():
    with pytest.raises(ts.ParameterError, match="did you mean 'mass_link'"):
        ts.compare(beam(), models=["mass-lnk"])
    with pytest.raises(ts.ParameterError, match="did you mean 'finest'"):
        ts.compare(beam(), reference="finst")


def test_the_command_writes_table_and_figure(tmp_path):
    file = tmp_path / "beam.yaml"
    beam(name="beam").save(file)
    result = CliRunner().invoke(
        app, ["compare", str(file), "--models", "fem,condensed", "-o", str(tmp_path / "out")]
    )
    assert result.exit_code == 0, result.output
    with (tmp_path / "out" / "compare.csv").open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert [row["model"] for row in rows] == ["fem", "condensed"]
    assert float(rows[0]["mean_error"]) > 0
    assert "| fem |" in (tmp_path / "out" / "compare.md").read_text(encoding="utf-8")
    assert (tmp_path / "out" / "compare.png").read_bytes().startswith(b"\x89PNG")


def test_the_command_tells_a_wrong_model(tmp_path):
    file = tmp_path / "beam.yaml"
    beam().save(file)
    result = CliRunner().invoke(app, ["compare", str(file), "--models", "femm"])
    assert result.exit_code != 0
    assert "unknown model 'femm'; did you mean 'fem'" in result.output


def refused(comparison):
    return {row.model: row.why for row in comparison.rows if row.outcome == "refused"}


def test_viscosity_that_a_model_does_not_take_is_a_row():
    bar = beam().bodies["bar"]
    relaxing = ts.Prony(branches=[ts.PronyBranch(weight=0.5, time=0.1)])
    scene = beam(bodies={"bar": bar.replace(viscosity=relaxing)}, duration=0.02)
    found = ts.compare(scene, models=["condensed", "fem"], reference="fem")
    assert "prony" in refused(found)["condensed"]
    assert list(refused(found)) == ["condensed"]


def test_a_load_that_a_model_does_not_take_is_a_row():
    scene = ts.Scene.from_yaml(EXAMPLES / "roll.yaml")
    mesh = ts.BarMesh(size=(0.2, 0.02, 0.0), cells=(4, 1, 0), cell="triangle")
    strip = scene.bodies["strip"].replace(mesh=mesh)
    scene = scene.replace(bodies={"strip": strip}, duration=0.1)
    found = ts.compare(scene)
    assert "no rotation" in refused(found)["fem"]
    (shell,) = [row for row in found.rows if row.model == "shell"]
    assert (shell.outcome, shell.mean_error) == ("finished", 0.0)
    assert found.reference.startswith("shell on the same mesh")
    with pytest.raises(ts.ParameterError, match=r"reference \(fem\) is refused, so name another"):
        ts.compare(scene, models=["shell"], reference="fem")


@pytest.mark.parametrize(
    ("models", "words"),
    [
        ("", "option --models: found no name; names with commas between them are accepted"),
        (" ", "option --models: found no name;"),
        ("fem,,mass_link", "option --models: found an empty name in 'fem,,mass_link'"),
        ("fem,fem", "found the model fem twice; each is accepted once"),
    ],
)
def test_models_that_are_empty_or_named_twice_are_refused(tmp_path, models, words):
    file = tmp_path / "beam.yaml"
    beam(duration=0.02).save(file)
    done = CliRunner().invoke(
        app, ["compare", str(file), "--models", models, "-o", str(tmp_path / "out")]
    )
    assert done.exit_code == 2
    assert words in done.output
    assert not (tmp_path / "out").exists()


def cut_from_above():
    """A bar of tetrahedra, which a knife cuts to two thirds in the first ten of twenty steps."""
    path = ts.ToolPath(times=(0, 0.1), positions=[(0.213, 0, 0.11), (0.221, 0, 0.04)])
    knife = ts.Knife([(0, -0.02, 0), (0, 0.12, 0)], cuts=["bar"], path=path)
    mesh = ts.bar_mesh(size=(0.4, 0.1, 0.1), cells=(12, 3, 3), cell="tetra")
    body = ts.Body(mesh=mesh, law=ts.StVK(young=5e4, poisson=0.3), density=1000)
    changes = {"bodies": {"bar": body}, "gravity": (0, 0, -1), "duration": 0.2}
    return beam(instruments={"knife": knife}, editing=True, **changes)


def kept_displacements(scene, count):
    """Displacements of the first nodes after each step, and how many nodes there are in the end."""
    simulation, found = scene.compile(), []
    for _ in simulation.run():
        found.append(simulation.displacements("bar")[:count])
    return np.array(found), simulation.meshes["bar"].node_count


def test_bodies_that_are_cut_are_compared_by_the_nodes_that_they_began_with():
    scene = cut_from_above()
    count = scene.compile().meshes["bar"].node_count
    fem, others = ts.compare(scene, models=["fem", "corotational"], reference="fem").rows
    assert (fem.mean_error, fem.outcome, others.outcome) == (0.0, "finished", "finished")
    rich, more = kept_displacements(scene, count)
    assert more > count
    body = scene.bodies["bar"].replace(model="corotational", law_for_model="nearest")
    found, _ = kept_displacements(scene.replace(bodies={"bar": body}), count)
    apart = np.linalg.norm(found - rich, axis=2)
    # The same runs, one thread: equal but for the order of the sum.
    assert others.mean_error == pytest.approx(apart.mean(), rel=1e-12)
    assert others.largest_error == pytest.approx(apart.max(), rel=1e-12)
    (against_finest,) = ts.compare(scene, models=["fem"]).rows
    assert against_finest.outcome == "finished"
    assert against_finest.mean_error > 0.0


@pytest.mark.parametrize(("name", "model"), [("tear", "fem"), ("flap", "shell")])
def test_the_command_compares_examples_that_are_cut(tmp_path, name, model):
    words = ["compare", str(EXAMPLES / f"{name}.yaml"), "--models", model, "--reference", model]
    ended = CliRunner().invoke(app, [*words, "-o", str(tmp_path)])
    assert ended.exit_code == 0, ended.output
    (row,) = csv.DictReader((tmp_path / "compare.csv").read_text().splitlines())
    assert (row["outcome"], float(row["mean_error"])) == ("finished", 0.0)
