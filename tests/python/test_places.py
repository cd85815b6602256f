"""Where files may be written: new places and regular files, whatever it is that is written.

Pipes in folders of the test stand for everything special. No device is ever opened: of those the
refusal alone is asked for.
"""

import os
import socket
import stat
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

import tissu as ts
from tissu.errors import CheckpointError, MeshError, SceneError, TissuError
from tissu.output import Series, StepTally, prepare_folder, summarise, write_summary

SCENE = """\
name: bar
bodies:
  bar:
    mesh: {type: bar, size: [0.2, 0.05, 0.05], cells: [2, 1, 1]}
    law: {type: stvk, young: 20 kPa, poisson: 0.4}
    density: 1000
fixed:
  - {body: bar, on: {type: box, min: [null, null, null], max: [1 mm, null, null]}}
step: {type: implicit_euler, dt: 10 ms}
duration: 20 ms
"""


def make():
    return ts.Scene.from_yaml_text(SCENE)


@pytest.fixture
def pipe(tmp_path):
    """A pipe that nobody reads, with an ending that all formats take."""

    def made(name="pipe.vtu"):
        os.mkfifo(tmp_path / name)
        return tmp_path / name

    return made


def assert_still_a_pipe(path):
    assert stat.S_ISFIFO(os.lstat(path).st_mode)


def test_devices_are_refused_by_name_alone():
    from tissu.files import require_file_place, require_folder_place

    for device in ("/dev/null", "/dev/full", "/dev/zero"):
        before = os.lstat(device)
        with pytest.raises(
            TissuError, match=rf"{device}: cannot be written: found a device; a new place or a reg"
        ):
            require_file_place(device)
        with pytest.raises(TissuError, match="found a device, a folder is accepted"):
            require_folder_place(device, "output folder")
        assert os.lstat(device).st_ino == before.st_ino


def test_each_kind_of_place_is_told(tmp_path, pipe):
    from tissu.files import require_file_place

    (tmp_path / "nothing").symlink_to(tmp_path / "absent")
    (tmp_path / "file").write_text("old")
    (tmp_path / "to-file").symlink_to(tmp_path / "file")
    listening = socket.socket(socket.AF_UNIX)
    listening.bind(os.path.relpath(tmp_path / "socket"))
    for name, said in {
        "nothing": "a link to nothing",
        "socket": "a socket",
        ".": "a folder",
        pipe().name: "a pipe",
    }.items():
        with pytest.raises(TissuError, match=f"found {said}; a new place or a regular file is"):
            require_file_place(tmp_path / name)
    for name in ("new", "file", "to-file"):
        assert require_file_place(tmp_path / name) == tmp_path / name
    for name in ("a\0b", "n" * 300, "\ud800"):
        with pytest.raises(TissuError, match="cannot be written"):
            require_file_place(tmp_path / name / "x" if name == "\ud800" else tmp_path / name)
    listening.close()


def write_mesh(place):
    ts.write_mesh(ts.bar_mesh(size=(1, 1, 1), cells=(1, 1, 1)), place)


def write_checkpoint(place):
    make().compile().save_checkpoint(place)


def write_scene(place):
    make().save(place)


def write_picture(place):
    ts.draw(make().compile(), place)


def write_a_summary(place):
    simulation = make().compile()
    told = summarise(simulation, tally=StepTally(), status="finished", wall_seconds={}, files={})
    write_summary(place, told)


@pytest.mark.parametrize(
    ("write", "error"),
    [
        (write_mesh, MeshError),
        (write_checkpoint, CheckpointError),
        (write_scene, SceneError),
        (write_picture, TissuError),
        (write_a_summary, TissuError),
    ],
)
def test_whatever_is_written_refuses_a_pipe(pipe, write, error):
    place = pipe("pipe.png" if write is write_picture else "pipe.vtu")
    said = []

    def attempt():
        try:
            write(place)
        except Exception as raised:
            said.append(raised)

    # A writer that opens the pipe waits for a reader: the test is one after a while, then fails.
    attempted = threading.Thread(target=attempt, daemon=True)
    attempted.start()
    attempted.join(timeout=60)
    if attempted.is_alive():
        os.close(os.open(place, os.O_RDONLY | os.O_NONBLOCK))
        attempted.join(timeout=60)
    assert len(said) == 1
    assert isinstance(said[0], error), said
    assert "found a pipe; a new place or a regular file is accepted" in str(said[0])
    assert_still_a_pipe(place)


@pytest.mark.parametrize(
    "words",
    [
        ("run", "bar.yaml", "--checkpoint", "pipe.vtu"),
        ("run", "bar.yaml", "--out", "pipe.vtu"),
        ("compare", "bar.yaml", "--out", "pipe.vtu"),
        ("advise", "bar.yaml", "--out", "pipe.vtu"),
        ("bench", "accuracy", "bar", "--out", "pipe.vtu"),
        ("mesh", "bar", "--size", 1, 1, 1, "--cells", 1, 1, 1, "-o", "pipe.vtu"),
        ("mesh", "convert", "mesh.vtu", "-o", "pipe.vtu"),
    ],
    ids=lambda words: " ".join(map(str, words[:2])),
)
def test_every_command_refuses_a_pipe_before_it_runs(tmp_path, pipe, words):
    place = pipe()
    (tmp_path / "bar.yaml").write_text(SCENE)
    ts.write_mesh(ts.bar_mesh(size=(1, 1, 1), cells=(1, 1, 1)), tmp_path / "mesh.vtu")
    command = [sys.executable, "-m", "tissu.cli", *map(str, words)]
    ended = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, timeout=120)
    assert ended.returncode == 2, ended.stderr
    assert "Traceback" not in ended.stderr
    assert "found a pipe" in ended.stderr
    assert_still_a_pipe(place)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["bar.yaml", "mesh.vtu", "pipe.vtu"]


def test_a_link_inside_a_folder_of_results_is_not_followed(tmp_path):
    out, elsewhere = tmp_path / "out", tmp_path / "elsewhere"
    out.mkdir()
    elsewhere.mkdir()
    (elsewhere / "bar_00000.vtu").write_text("another's")
    (out / "frames").symlink_to(elsewhere)
    (out / "bar.pvd").write_text('<DataSet file="frames/bar_00000.vtu"/>')
    with pytest.raises(TissuError, match=r"frames: found a link, a folder is accepted"):
        Series(make().compile(), out)
    assert (elsewhere / "bar_00000.vtu").read_text() == "another's"


def test_a_folder_named_by_a_link_is_the_folder(tmp_path):
    (tmp_path / "there").mkdir()
    (tmp_path / "out").symlink_to(tmp_path / "there")
    assert prepare_folder(tmp_path / "out").is_dir()
    (tmp_path / "lost").symlink_to(tmp_path / "absent")
    with pytest.raises(TissuError, match="found a link to nothing, a folder is accepted"):
        prepare_folder(tmp_path / "lost")
    assert not (tmp_path / "absent").exists()


def test_a_name_planted_beside_a_file_is_not_opened(tmp_path):
    """The names that files had while they were written: what lies there is another's."""
    other = tmp_path / "another's"
    other.write_text("kept")
    out = tmp_path / "out"
    out.mkdir()
    for name in ("a.vtu", "a.png"):
        (out / f".{name}.{os.getpid()}").symlink_to(other)
    (out / f".run.{os.getpid()}.partial").symlink_to(other)
    ts.write_mesh(ts.bar_mesh(size=(1, 1, 1), cells=(1, 1, 1)), out / "a.vtu")
    write_checkpoint(out / "run")
    write_picture(out / "a.png")
    assert other.read_text() == "kept"


@pytest.mark.parametrize(
    "names",
    [("a/b", "a:b"), ("b", "b "), ("a/b", "a_b", "a:b"), ("x" * 199, "x" * 200), ("…", "??")],
)
def test_two_bodies_never_share_a_file(tmp_path, names):
    one = make()
    bodies = {
        name: one.bodies["bar"].replace(
            mesh=ts.bar_mesh(size=(0.2, 0.1, 0.1 * (1 + k)), cells=(1, 1, 1))
        )
        for k, name in enumerate(names)
    }
    fixed = [ts.Fixed(name, on=ts.Plane(normal=(1, 0, 0), point=(0, 0, 0))) for name in names]
    scene = one.replace(bodies=bodies, fixed=fixed)
    series = Series(scene.compile(), tmp_path / "out")
    (tmp_path / "out").mkdir(exist_ok=True)
    series.write()
    files = list((tmp_path / "out" / "frames").iterdir())
    assert len(files) == len(names)
    volumes = sorted(round(ts.read_mesh(file).volume(), 6) for file in files)
    assert volumes == [round(0.02 * 0.1 * (1 + k), 6) for k in range(len(names))]
    scene.save(tmp_path / "scene.yaml")
    again = ts.Scene.from_yaml(tmp_path / "scene.yaml").compile()
    for k, name in enumerate(names):
        assert again.meshes[name].volume() == pytest.approx(0.002 * (1 + k))


def test_a_format_of_two_files_is_whole(tmp_path):
    mesh = ts.bar_mesh(size=(1, 1, 1), cells=(1, 1, 1))
    ts.write_mesh(mesh, tmp_path / "a.xdmf")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.h5", "a.xdmf"]
    np.testing.assert_allclose(ts.read_mesh(tmp_path / "a.xdmf").points, mesh.points)


def test_a_folder_that_is_taken_away_is_told(tmp_path):
    series = Series(make().compile(), prepare_folder(tmp_path / "out"))
    series.write()
    for path in sorted((tmp_path / "out").rglob("*"), reverse=True):
        path.rmdir() if path.is_dir() else path.unlink()
    (tmp_path / "out").rmdir()
    with pytest.raises(TissuError, match="out: it was taken away while the scene ran") as raised:
        series.write()
    assert "\n" not in str(raised.value)
    assert list(Path(tmp_path).iterdir()) == []
