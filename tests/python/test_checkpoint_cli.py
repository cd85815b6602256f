"""`tissu run` with checkpoints, as a user meets it: killed, stopped, gone on, refused."""

import hashlib
import json
import os
import signal
import subprocess
import sys
import time
from xml.etree import ElementTree

import pytest

from tissu.cli.run import Job, run_scene
from tissu.output import StepTally

SCENE = """\
name: bar
bodies:
  bar:
    mesh: {type: bar, size: [0.2, 0.05, 0.05], cells: [16, 4, 4]}
    law: {type: stvk, young: 20 kPa, poisson: 0.4}
    density: 1000
    viscosity: {type: prony, branches: [{weight: 0.5, time: 50 ms}]}
gravity: [0, 0, -9.81]
fixed:
  - {body: bar, on: {type: box, min: [null, null, null], max: [1 mm, null, null]}}
step: {type: implicit_euler, dt: 5 ms}
duration: 503 ms
output: {every: 30 ms}
"""


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "bar.yaml"
    path.write_text(SCENE)
    return path


def command(*words):
    return [sys.executable, "-m", "tissu.cli", "run", "--no-picture", *map(str, words)]


def run(*words):
    return subprocess.run(command(*words), capture_output=True, text=True, timeout=120)


def stopped(words, number, ready):
    """A run that gets a signal as soon as `ready()`; its exit code and what it said."""
    child = subprocess.Popen(
        command(*words),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    limit = time.monotonic() + 60
    while child.poll() is None and time.monotonic() < limit and not ready():
        time.sleep(1e-3)
    assert child.poll() is None, "the run ended before the signal"
    os.kill(child.pid, number)
    _, said = child.communicate(timeout=60)
    return child.returncode, said


def results(folder):
    """The digests of index and frames, by name."""
    files = [folder / "bar.pvd", *(folder / "frames").iterdir()]
    return {f.name: hashlib.sha256(f.read_bytes()).hexdigest() for f in files}


def summary(folder):
    return json.loads((folder / "summary.json").read_text())


def test_a_killed_run_goes_on_as_if_nothing_had_been(scene, tmp_path):
    """Killed twice, with frames behind the checkpoint; then the same files as a run at one go."""
    options = ["--checkpoint-every", "40 ms", "-q"]
    straight, killed = tmp_path / "straight", tmp_path / "killed"
    ended = run(scene, "-o", straight, "--checkpoint", straight / "c", *options)
    assert (ended.returncode, ended.stderr) == (0, "")
    assert summary(straight)["resumed_from"] is None
    words = [scene, "-o", killed, "--checkpoint", killed / "c", *options]
    frames = killed / "frames"

    def there(count):
        return lambda: (killed / "c").exists() and len(list(frames.glob("*.vtu"))) >= count

    assert stopped(words, signal.SIGKILL, there(4))[0] == -signal.SIGKILL
    again = [*words, "--resume", killed / "c"]
    assert stopped(again, signal.SIGKILL, there(9))[0] == -signal.SIGKILL
    ended = run(*again)
    assert (ended.returncode, ended.stderr) == (0, "")
    assert len(results(straight)) == 19  # 0, 30, ..., 480 and 503 ms, and the index
    assert results(killed) == results(straight)
    assert (killed / "c").read_bytes() == (straight / "c").read_bytes()
    told = summary(killed)
    begun = told["resumed_from"]
    assert begun["file"] == str(killed / "c")
    assert begun["time"] == pytest.approx(0.005 * begun["steps"])
    assert begun["steps"] + told["steps"]["steps"] == 101
    assert told["simulated_seconds"] == summary(straight)["simulated_seconds"]


@pytest.mark.parametrize(
    ("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)], ids=["int", "term"]
)
def test_a_stopped_run_leaves_its_checkpoint(scene, tmp_path, number, code):
    out, file = tmp_path / "out", tmp_path / "new" / "c"
    words = [scene, "-o", out, "--checkpoint", file, "--duration", "1000 s"]
    ended, said = stopped(words, number, lambda: len(list(out.glob("frames/*.vtu"))) > 1)
    assert ended == code
    assert "all files are complete" in said
    assert [p.name for p in file.parent.iterdir()] == ["c"]
    stood = summary(out)["simulated_seconds"]
    ended = run(
        scene, "-o", tmp_path / "other", "--resume", file, "--duration", f"{stood + 0.02} s"
    )
    assert ended.returncode == 0, ended.stderr
    assert f"went on from {file}, at t = {stood:.4g} s" in ended.stdout
    told = summary(tmp_path / "other")
    assert told["resumed_from"]["time"] == stood
    assert told["steps"]["steps"] == 4
    index = (tmp_path / "other" / "bar.pvd").read_text()
    assert f'timestep="{stood:.9g}"' in index  # another folder: the series begins there
    done = run(scene, "-o", tmp_path / "other", "--resume", file, "--duration", f"{stood} s")
    assert (done.returncode, summary(tmp_path / "other")["steps"]["steps"]) == (0, 0)


@pytest.fixture
def heard():
    """A shell lets what runs in the background ignore SIGINT."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("heard")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM], ids=["int", "term"])
def test_the_frame_of_a_stop_does_not_stay_in_the_series(tmp_path, monkeypatch, number):
    """Stopped twice, one step before a frame is due and two after one.

    A checkpoint does not change steps that are solved directly: the files agree to the bit.
    """
    file, text = tmp_path / "bar.yaml", SCENE.replace("503 ms", "113 ms")
    file.write_text(text.replace("dt: 5 ms}", "dt: 5 ms, solver: {type: cholesky}}"))
    words = {"duration": None, "threads": None, "quiet": True, "picture": False}
    straight, out = tmp_path / "straight", tmp_path / "out"
    assert run_scene(Job(scene=file, out=straight, **words)) == 0
    add, taken = StepTally.add, []

    def stop(tally, step):
        add(tally, step)
        taken.append(step)
        if len(taken) in (5, 14):
            signal.raise_signal(number)

    monkeypatch.setattr(StepTally, "add", stop)
    words |= {"checkpoint": tmp_path / "c"}
    code = 128 + number
    assert run_scene(Job(scene=file, out=out, **words)) == code
    assert [round(1e3 * time) for time in times_of(out)] == [0, 25]
    words |= {"resume": tmp_path / "c"}
    assert run_scene(Job(scene=file, out=out, **words)) == code
    assert [round(1e3 * time) for time in times_of(out)] == [0, 30, 60, 70]
    assert run_scene(Job(scene=file, out=out, **words)) == 0
    assert [round(1e3 * time) for time in times_of(out)] == [0, 30, 60, 90, 113]
    assert results(out) == results(straight)


def times_of(folder):
    """The times that the index lists."""
    entries = ElementTree.parse(folder / "bar.pvd").getroot().iter("DataSet")
    return [float(entry.get("timestep")) for entry in entries]


CUBE_ON_A_TABLE = """\
name: cube
bodies:
  cube:
    mesh: {type: bar, size: [0.1, 0.1, 0.1], cells: [1, 1, 1], origin: [0, 0, 0.01]}
    law: {type: stvk, young: 20 kPa, poisson: 0.4}
    density: 1000
obstacles:
  table: {type: plane, point: [0, 0, 0], normal: [0, 0, 1]}
contacts:
  - {between: [cube, table]}
step: {type: implicit_euler, dt: 10 ms}
duration: 50 ms
"""


@pytest.mark.parametrize("end", ["50 ms", "30 ms"])
def test_a_run_that_went_on_at_its_end_or_beyond_says_that_nothing_was_left(tmp_path, end):
    file = tmp_path / "cube.yaml"
    file.write_text(CUBE_ON_A_TABLE)
    words = [file, "-o", tmp_path / "out"]
    begun = run(*words, "--checkpoint", tmp_path / "c")
    assert begun.returncode == 0, begun.stderr
    assert "nothing touched anything" in begun.stdout
    done = run(*words, "--resume", tmp_path / "c", "--duration", end)
    assert done.returncode == 0
    assert (
        f"tissu: nothing was left to do: {tmp_path / 'c'} has the state at t = 0.05 s, and the run "
        f"ends at 0.0{end[0]} s; give a longer --duration to go on\n"
    ) in done.stderr
    assert "touched" not in done.stdout
    assert "0 steps" not in done.stdout


def test_threads_and_repeated_runs_write_the_same_files(scene, tmp_path):
    found = []
    for number, threads in enumerate((1, 1, 2, 3, 4)):
        out = tmp_path / str(number)
        ended = run(scene, "-o", out, "--threads", threads, "--duration", "100 ms", "-q")
        assert ended.returncode == 0, ended.stderr
        found.append(results(out))
    assert len(found[0]) == 6
    assert all(other == found[0] for other in found)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--checkpoint-every", "1 s"], "option --checkpoint-every: found without --checkpoint"),
        (
            ["--checkpoint", "c", "--checkpoint-every", "1 kg"],
            "option --checkpoint-every: found '1",
        ),
        (["--checkpoint", "c", "--checkpoint-every", "0 s"], "more than 0 s is accepted"),
        (["--checkpoint", "."], "found a folder; a new place or a regular file is accepted"),
        (["--checkpoint", "bar.yaml/c"], "cannot be written"),
        (["--resume", "absent"], "checkpoint absent: there is no such file"),
        (["--resume", "bar.yaml"], "checkpoint bar.yaml: its checksum does not match"),
    ],
)
def test_options_are_refused_in_words(scene, tmp_path, monkeypatch, words, said):
    monkeypatch.chdir(tmp_path)
    ended = run(scene.name, "-o", "out", *words)
    assert ended.returncode == 2
    assert said in ended.stderr
    assert "Traceback" not in ended.stderr
    assert ended.stdout == ""


def test_a_checkpoint_of_another_scene_is_refused(scene, tmp_path):
    file = tmp_path / "c"
    made = run(scene, "-o", tmp_path / "out", "--checkpoint", file, "--duration", "20 ms", "-q")
    assert made.returncode == 0, made.stderr
    scene.write_text(SCENE.replace("20 kPa", "30 kPa"))
    ended = run(scene, "-o", tmp_path / "out", "--resume", file)
    assert ended.returncode == 2
    assert "bodies.bar.law.young is 20000.0 there and 30000.0 here" in ended.stderr
    assert summary(tmp_path / "out")["steps"]["steps"] == 4  # what was there is left alone


def test_a_run_that_goes_on_from_unsolved_steps_is_unconverged_too(scene, tmp_path):
    """Its state follows from theirs, whether the steps after the checkpoint converge or not."""
    hard = "step: {type: implicit_euler, dt: 20 ms, newton: {iterations: 2, tolerance: 1e-12}}"
    text = scene.read_text().replace("step: {type: implicit_euler, dt: 5 ms}", hard)
    scene.write_text(text.replace("cells: [16, 4, 4]", "cells: [6, 2, 2]"))
    kept, out = tmp_path / "kept", tmp_path / "out"
    first = run(scene, "-o", out, "--checkpoint", kept, "--duration", "0.1 s")
    assert first.returncode == 3, first.stderr
    missed = summary(out)["steps"]
    assert missed["unconverged"] > 0
    again = run(scene, "-o", out, "--resume", kept, "--duration", "0.1 s")
    assert again.returncode == 3, again.stderr
    assert f"{missed['unconverged']} of 5 steps did not converge" in again.stderr
    found = summary(out)
    assert (found["status"], found["steps"]["steps"]) == ("unconverged", 0)
    before = found["resumed_from"]
    assert (before["steps"], before["unconverged"]) == (5, missed["unconverged"])
    assert before["first_unconverged"] == missed["first_unconverged"]
    accepted = run(
        scene, "-o", out, "--resume", kept, "--duration", "0.1 s", "--accept-unconverged"
    )
    assert accepted.returncode == 0, accepted.stderr
