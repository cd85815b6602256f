"""The commands as a user meets them: output, exit codes, no tracebacks."""

import dataclasses
import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import tissu
from tissu.cli import info

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


def test_without_a_picture_none_is_drawn_and_none_is_named(scene, tmp_path):
    out = tmp_path / "out"
    ended = tissu_command("run", scene, "--out", out, "--no-picture")
    assert ended.returncode == 0, ended.stderr
    assert sorted(p.name for p in out.iterdir()) == ["bar.pvd", "frames", "summary.json"]
    assert summary(out)["files"] == {"series": "bar.pvd"}
    assert set(summary(out)["wall_seconds"]) == {"compile", "steps", "output"}
    assert ".png" not in ended.stdout


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


def test_lengths_of_a_bar_have_units(tmp_path):
    words = ["mesh", "bar", "--cells", 2, 1, 1, "-o", tmp_path / "bar.vtu", "--size"]
    made = tissu_command(*words, "10cm", "5 mm", 0.02, "--origin", "-1cm", 0, 0)
    assert made.returncode == 0, made.stderr
    low, high = tissu.read_mesh(tmp_path / "bar.vtu").bounds
    assert low == pytest.approx([-0.01, 0, 0])
    assert high == pytest.approx([0.09, 0.005, 0.02])
    wrong = tissu_command(*words, "10cm", "5 kPa", 1)
    assert wrong.returncode == 2
    assert "option --size: found '5 kPa', which is a pressure; a length is acc" in wrong.stderr


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--cell", "hexahedron", "--split", "five"], "only tetra and tetra10 are split"),
        (["--cell", "wedge", "--split", "six_mirrored"], "only tetra and tetra10 are split"),
        (["--segments", "hex8", "--split", "five"], "leave --split out"),
        (["--segments", "hex8", "--cell", "tetra"], "leave --cell out"),
    ],
)
def test_options_of_a_bar_that_would_do_nothing_are_refused(tmp_path, options, said):
    words = ["mesh", "bar", "--cells", 2, 1, 1, "--size", 1, 1, 1, "-o", tmp_path / "bar.vtu"]
    wrong = tissu_command(*words, *options)
    assert wrong.returncode == 2
    assert said in wrong.stderr
    assert not (tmp_path / "bar.vtu").exists()


def test_convert_leaves_unused_nodes_out(tmp_path):
    bar = tissu.bar_mesh(size=(1, 1, 1), cells=(1, 1, 1), cell="hexahedron")
    points = np.concatenate([bar.points, [[2.0, 2.0, 2.0]]])
    tissu.write_mesh(dataclasses.replace(bar, points=points), tmp_path / "a.vtu")
    words = ["mesh", "convert", tmp_path / "a.vtu", "-o", tmp_path / "b.msh", "--unit", "mm"]
    made = tissu_command(*words)
    assert made.returncode == 0, made.stderr
    assert "8 nodes, 1 cell\n" in made.stdout
    mesh = tissu.read_mesh(tmp_path / "b.msh")
    assert mesh.node_count == 8
    assert mesh.bounds[1] == pytest.approx([1e-3] * 3)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("abc", "option --duration: found 'abc', which does not begin with a number; a time is"),
        ("2 kg", "option --duration: found '2 kg', which is a mass"),
        ("-1 s", "option --duration: found '-1 s'; more than 0 s is accepted"),
    ],
)
def test_a_wrong_duration_is_the_options_fault(scene, tmp_path, text, said):
    ended = tissu_command("run", scene, "--out", tmp_path / "out", "--duration", text)
    assert ended.returncode == 2
    assert said in ended.stderr
    assert "scene" not in ended.stderr


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


@pytest.mark.parametrize(
    ("number", "code", "word"),
    [(signal.SIGINT, 130, "interrupted"), (signal.SIGTERM, 143, "terminated")],
)
def test_a_signal_leaves_complete_files(scene, tmp_path, number, code, word):
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
    os.kill(child.pid, number)
    _, said = child.communicate(timeout=60)
    assert child.returncode == code
    assert f"{word} at t = " in said
    assert "Traceback" not in said
    assert summary(out)["status"] == "interrupted"
    index = (out / "bar.pvd").read_text()
    written = sorted(p.name for p in frames.iterdir())
    assert len(written) == index.count("<DataSet")
    assert all(f"frames/{name}" in index for name in written)
    assert len(meshio.read(frames / written[-1]).points) == 81


def test_mesh_info_doubts_an_organ_of_many_metres(tmp_path):
    tissu.write_mesh(tissu.bar_mesh(size=(200, 60, 60), cells=(2, 1, 1)), tmp_path / "liver.vtu")
    metres = tissu_command("mesh", "info", "liver.vtu", cwd=tmp_path).stdout
    assert "200 m is more than any organ; in millimetres? --unit mm" in metres
    said = tissu_command("mesh", "info", "liver.vtu", "--unit", "mm", cwd=tmp_path).stdout
    assert "0.2 x 0.06 x 0.06 m" in said
    assert "any organ" not in said


def test_measured_pages_and_info_name_the_processor(tmp_path, monkeypatch):
    monkeypatch.setattr(info.platform, "machine", lambda: "riscv64")
    listed = tmp_path / "cpuinfo"
    listed.write_text(
        "processor\t: 0\nmodel\t\t: 106\nmodel name\t: A Chip (TM) @ 2 GHz \n\nprocessor\t: 1\n"
    )
    assert info.processor(listed) == "A Chip (TM) @ 2 GHz"
    listed.write_text("processor\t: 0\nmodel name\t:\nhart\t: 1\n")  # named by no text
    assert info.processor(listed) == "unnamed riscv64 processor"
    assert info.processor(tmp_path / "absent") == "unnamed riscv64 processor"
    assert info.machine_line().endswith(f" available, {info.processor()}.")
    assert f"processor          {info.processor()}" in info.info_text()
