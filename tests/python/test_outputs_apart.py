"""No command replaces a file that its scene is read from."""

import pytest
from typer.testing import CliRunner

import tissu as ts
from tissu.cli.app import app

SCENE = """\
name: bar
bodies:
  bar:
    mesh: MESH
    law: {type: stvk, young: 20 kPa, poisson: 0.4}
    density: 1000
obstacles:
  tool: {type: mesh, mesh: tool.vtu}
step: {type: implicit_euler, dt: 10 ms}
duration: 20 ms
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "out" / "frames").mkdir(parents=True)
    mesh = ts.bar_mesh(size=(0.2, 0.1, 0.1), cells=(2, 1, 1))
    for place in ("bar.vtu", "tool.vtu", "out/frames/bar_00000.vtu"):
        ts.write_mesh(mesh, tmp_path / place)
    (tmp_path / "scene.yaml").write_text(SCENE.replace("MESH", "bar.vtu"))
    (tmp_path / "again.yaml").write_text(SCENE.replace("MESH", "out/frames/bar_00000.vtu"))
    (tmp_path / "link.yaml").symlink_to("scene.yaml")
    return tmp_path


@pytest.mark.parametrize(
    ("words", "what", "file"),
    [
        ("run scene.yaml --checkpoint scene.yaml", "option --checkpoint", "scene.yaml"),
        ("run link.yaml --checkpoint scene.yaml", "option --checkpoint", "link.yaml"),
        ("run scene.yaml --checkpoint bar.vtu", "option --checkpoint", "bar.vtu"),
        ("run scene.yaml --checkpoint ./tool.vtu", "option --checkpoint", "tool.vtu"),
        ("run again.yaml -o out", "output folder out", "out/frames/bar_00000.vtu"),
        ("advise scene.yaml -o .", "output folder .", "scene.yaml"),
    ],
)
def test_what_a_scene_is_read_from_is_not_replaced(folder, words, what, file):
    before = {p: p.read_bytes() for p in folder.rglob("*") if p.is_file()}
    done = CliRunner().invoke(app, words.split())
    assert done.exit_code == 2
    assert f"{what}: found {file}, which the scene is read from and which" in done.output
    assert done.output.count("\n") == 1
    assert {p: p.read_bytes() for p in folder.rglob("*") if p.is_file()} == before


def test_results_beside_the_scene_are_written(folder):
    words = "run scene.yaml -o . --checkpoint c --no-picture -q"
    done = CliRunner().invoke(app, words.split())
    assert done.exit_code == 0, done.output
    assert (folder / "c").is_file()
    assert (folder / "bar.pvd").is_file()
