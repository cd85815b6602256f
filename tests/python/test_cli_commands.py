"""The commands as a user meets them: output, exit codes, no tracebacks."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest

import tissu

SCENE = """\
name: bar
bodies:
  bar:
    mesh: {{type: bar, size: [0.2, 0.05, 0.05], cells: [8, 2, 2]}}
    law: {{type: stvk, young: {young}, poisson: 0.4}}
    density: 1000
gravity: [0, 0, -9.81]
fixed:
  - {{body: bar, on: {{type: box, min: [null, null, null], max: [1 mm, null, null]}}}}
step: {{type: implicit_euler, dt: 10 ms}}
duration: {duration}
output: {{every: 20 ms}}
"""


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "bar.yaml"
    path.write_text(SCENE.format(young="20 kPa", duration="100 ms"))
    return path


def tissu_command(*words, cwd=None):
    command = [sys.executable, "-m", "tissu.cli", *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, cwd=cwd, timeout=120)


def summary(folder):
    return json.loads((folder / "summary.json").read_text())


def test_run_writes_series_summary_and_picture(scene, tmp_path):
    ended = tissu_command("run", scene, "--out", tmp_path / "out")
    assert ended.returncode == 0, ended.stderr
    assert ended.stderr == ""
    out = tmp_path / "out"
    assert sorted(p.name for p in out.iterdir()) == ["bar.png", "bar.pvd", "frames", "summary.json"]
    assert len(list((out / "frames").iterdir())) == 6
    told = summary(out)
    assert told["status"] == "finished"
    assert told["steps"]["steps"] == 10
    assert told["files"] == {"series": "bar.pvd", "picture": "bar.png"}
    assert set(told["wall_seconds"]) == {"compile", "steps", "output", "picture"}
    for words in ("ms", "share", "gravity", str(out / "bar.pvd"), str(out / "bar.png")):
        assert words in ended.stdout
    assert "viscosity" not in ended.stdout  # absent effects have no row
    assert "\x1b" not in ended.stdout  # no bar, no colour: not a terminal


def test_options_change_the_scene_and_results_have_a_place_of_their_own(scene, tmp_path):
    ended = tissu_command("run", scene, "--duration", "30 ms", "--threads", 2, "-q", cwd=tmp_path)
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "", "")
    told = summary(tmp_path / "results" / "bar")
    assert told["steps"]["steps"] == 3
    assert told["threads"] == 2
    frames = tmp_path / "results" / "bar" / "frames"
    assert len(list(frames.iterdir())) == 3  # 0, 20 and the last at 30 ms


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("density: 1000", "densty: 1000"), ["densty", "density", "bar.yaml:6"]),
        (("20 kPa", "20 kg"), ["young", "20 kg"]),
        (("duration: 100 ms", ""), ["duration", "--duration"]),
        (("max: [1 mm", "max: [-1 mm"), ["fixed[0]", "selects no node"]),
    ],
)
def test_bad_scenes_are_refused_in_words(scene, tmp_path, change, said):
    scene.write_text(scene.read_text().replace(*change))
    ended = tissu_command("run", scene, "--out", tmp_path / "out")
    assert ended.returncode == 2
    assert "Traceback" not in ended.stderr
    assert ended.stdout == ""
    for words in said:
        assert words in ended.stderr


def test_absent_files_and_folders_are_refused_in_words(scene, tmp_path):
    for words in (("run", "absent.yaml"), ("check", "absent.yaml"), ("mesh", "info", "absent.vtu")):
        ended = tissu_command(*words)
        assert ended.returncode == 2
        assert "absent." in ended.stderr
        assert "Traceback" not in ended.stderr
    ended = tissu_command("run", scene, "--out", scene)
    assert ended.returncode == 2
    assert "output folder" in ended.stderr
    shown = tissu_command("run", scene, "--out", scene, "--debug")
    assert shown.returncode == 1
    assert "Traceback" in shown.stderr


def test_check_says_what_is_on_and_why(scene):
    ended = tissu_command("check", scene)
    assert ended.returncode == 0, ended.stderr
    assert "gravity is (0, 0, -9.81)" in ended.stdout
    assert "elasticity of bar" in ended.stdout
    assert "viscosity" in ended.stdout.split("Absent")[1]
    scene.write_text(scene.read_text().replace("max: [1 mm", "max: [-1 mm"))
    refused = tissu_command("check", scene)
    assert refused.returncode == 2
    assert "selects no node" in refused.stderr


def test_info_names_version_and_libraries():
    ended = tissu_command("info")
    assert ended.returncode == 0
    for words in (tissu.__version__, "threads", "instruction set", "numpy", "Eigen"):
        assert words.lower() in ended.stdout.lower()
    assert tissu_command("--version").stdout.strip() == f"tissu {tissu.__version__}"


def test_a_bar_is_made_and_looked_at(tmp_path):
    words = ["mesh", "bar", "--size", 0.2, 0.1, 0.1, "--cells", 4, 2, 2, "-o", "bar.vtu"]
    made = tissu_command(*words, "--cell", "hexahedron", "--origin", -1, 0, 0, cwd=tmp_path)
    assert made.returncode == 0, made.stderr
    assert "45 nodes, 16 cells" in made.stdout
    ended = tissu_command("mesh", "info", "bar.vtu", cwd=tmp_path)
    assert ended.returncode == 0, ended.stderr
    assert "16" in ended.stdout
    assert "45" in ended.stdout
    wrong = tissu_command(*words, "--cell", "prism", cwd=tmp_path)
    assert wrong.returncode == 2
    assert "prism" in wrong.stderr


def test_divergence_keeps_what_was_computed(scene, tmp_path):
    text = (
        SCENE.format(young="1e-3", duration="5 s")
        + "loads:\n"
        + ("  - {type: nodal, body: bar, on: {type: nodes, ids: [26]}, force: [-1e9, 0, 0]}\n")
    )
    scene.write_text(text)
    ended = tissu_command("run", scene, "--out", tmp_path / "out")
    assert ended.returncode == 1, ended.stdout
    assert "Traceback" not in ended.stderr
    assert "bar" in ended.stderr
    told = summary(tmp_path / "out")
    assert told["status"] == "diverged"
    assert told["notes"]
    assert (tmp_path / "out" / "bar.png").exists()
    assert (tmp_path / "out" / "bar.pvd").exists()


def test_ctrl_c_leaves_complete_files(scene, tmp_path):
    import meshio

    scene.write_text(SCENE.format(young="20 kPa", duration="1000 s"))
    out = tmp_path / "out"
    command = [sys.executable, "-m", "tissu.cli", "run", str(scene), "--out", str(out)]
    child = subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    frames, limit = out / "frames", time.monotonic() + 60
    while time.monotonic() < limit and not (frames.exists() and len(list(frames.iterdir())) > 3):
        time.sleep(0.05)
    os.kill(child.pid, signal.SIGINT)
    _, said = child.communicate(timeout=60)
    assert child.returncode == 130
    assert "interrupted" in said
    assert "Traceback" not in said
    assert summary(out)["status"] == "interrupted"
    index = (out / "bar.pvd").read_text()
    written = sorted(p.name for p in frames.iterdir())
    assert len(written) == index.count("<DataSet")
    assert all(f"frames/{name}" in index for name in written)
    assert len(meshio.read(frames / written[-1]).points) == 81
