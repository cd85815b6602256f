"""How `tissu run` ends: its exit status, what it says, and what it leaves behind."""

import json
import os
import re
import signal
import subprocess
import sys
import time

import pytest

SCENE = """\
name: bar
bodies:
  bar:
    mesh: {type: bar, size: [0.2, 0.05, 0.05], cells: [8, 2, 2]}
    law: {type: stvk, young: 20 kPa, poisson: 0.4}
    density: 1000
gravity: [0, 0, -9.81]
fixed:
  - {body: bar, on: {type: box, min: [null, null, null], max: [1 mm, null, null]}}
step: {type: implicit_euler, dt: 10 ms}
duration: 50 ms
"""
CAPPED = "dt: 10 ms, solver: {type: conjugate_gradient, iterations: 2, tolerance: 1e-12}}"
# No tolerance that a double reaches, and more iterations than a test has time for: a step that ends
# only when it is asked to.
ENDLESS = (
    "{type: static, newton: {iterations: 2000000000, tolerance: 1e-300}, "
    "solver: {type: conjugate_gradient, iterations: 2000000000, tolerance: 1e-300}}"
)


@pytest.fixture
def scene(tmp_path):
    def written(*changes):
        text = SCENE
        for old, new in changes:
            assert old in text
            text = text.replace(old, new)
        (tmp_path / "bar.yaml").write_text(text)
        return tmp_path / "bar.yaml"

    return written


def command(*words):
    return [sys.executable, "-m", "tissu", *map(str, words)]


def run(*words, **options):
    options = {"capture_output": True, "text": True, "timeout": 300} | options
    return subprocess.run(command("run", "--no-picture", *words), **options)


def summary(folder):
    return json.loads((folder / "summary.json").read_text())


def test_steps_that_did_not_converge_end_with_three(scene, tmp_path):
    file, out = scene(("dt: 10 ms}", CAPPED)), tmp_path / "out"
    ended = run(file, "-o", out, "--quiet")
    assert ended.returncode == 3
    assert ended.stdout == ""
    (line,) = ended.stderr.splitlines()
    assert line.startswith("tissu: 5 of 5 steps did not converge, the first: step 1")
    assert "the linear solver stopped before its tolerance" in line
    assert "--accept-unconverged" in line
    told = summary(out)
    assert told["status"] == "unconverged"
    assert told["why"] == line.removeprefix("tissu: ")
    assert told["steps"]["unconverged"] == 5
    loud = run(file, "-o", out)
    assert loud.returncode == 3
    assert "5 of 5 steps did not converge" in loud.stdout
    taken = run(file, "-o", out, "-q", "--accept-unconverged")
    assert taken.returncode == 0
    assert "5 of 5 steps did not converge" in taken.stderr
    assert summary(out)["status"] == "finished"
    assert "5 of 5 steps" in summary(out)["why"]


def test_a_static_run_that_found_nothing_ends_with_three(scene, tmp_path):
    step = "{type: static, newton: {iterations: 1, tolerance: 1e-12}}"
    file = scene(("{type: implicit_euler, dt: 10 ms}", step), ("duration: 50 ms\n", ""))
    ended = run(file, "-o", tmp_path / "out", "-q")
    assert ended.returncode == 3
    assert ended.stderr.startswith("tissu: 1 of 1 step did not converge")
    assert summary(tmp_path / "out")["status"] == "unconverged"


def test_a_run_that_converged_says_nothing(scene, tmp_path):
    ended = run(scene(), "-o", tmp_path / "out", "-q")
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "", "")
    assert summary(tmp_path / "out")["why"] == ""


def test_notes_of_check_are_told_once(scene, tmp_path):
    file = scene(("young: 20 kPa", "young: 20 Pa"))
    ended = run(file, "-o", tmp_path / "out")
    assert ended.returncode == 0
    (line,) = ended.stderr.splitlines()
    assert line.startswith("tissu: note: bodies.bar.law: Young's modulus at rest is 20 Pa, outside")
    assert line.removeprefix("tissu: note: ") in summary(tmp_path / "out")["notes"]
    assert run(file, "-o", tmp_path / "out", "-q").stderr == ""


def left(folder):
    return sorted(path.name for path in folder.iterdir())


def stopped(words, number, ready, **options):
    """A run that gets a signal as soon as `ready()`: its exit code, and what it said."""
    child = subprocess.Popen(
        command("run", *words), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        preexec_fn=lambda: signal.signal(number, options.get("handler", signal.SIG_DFL)),
    )  # fmt: skip
    limit = time.monotonic() + 120
    while child.poll() is None and time.monotonic() < limit and not ready():
        time.sleep(1e-2)
    assert child.poll() is None, child.communicate()
    time.sleep(options.get("wait", 0.0))
    os.kill(child.pid, number)
    try:
        _, said = child.communicate(timeout=120)
    finally:
        child.kill()
    return child.returncode, said


@pytest.mark.parametrize(
    ("number", "code"),
    [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)],
    ids=["int", "term", "hup"],
)
def test_a_step_without_an_end_is_stopped_between_its_iterations(scene, tmp_path, number, code):
    file = scene(("{type: implicit_euler, dt: 10 ms}", ENDLESS))
    out, kept = tmp_path / "out", tmp_path / "kept"
    ready = lambda: (out / "frames" / "bar_00000.vtu").is_file()  # noqa: E731
    words = [file, "-o", out, "--checkpoint", kept, "-q"]
    ended, said = stopped(words, number, ready, wait=0.5)
    assert ended == code, said
    assert "at t = 0 s; all files are complete" in said
    assert summary(out)["status"] == "interrupted"
    assert summary(out)["simulated_seconds"] == 0.0
    assert kept.is_file()
    assert not [name for name in left(out) if name.startswith(".")]


def test_sighup_leaves_a_checkpoint_and_nohup_ignores_it(scene, tmp_path):
    file = scene(("duration: 50 ms", "duration: 1000 s\noutput: {every: 1 s}"))
    out, kept = tmp_path / "out", tmp_path / "kept"
    ready = lambda: len(list(out.glob("frames/*.vtu"))) > 1  # noqa: E731
    ended, said = stopped([file, "-o", out, "--checkpoint", kept], signal.SIGHUP, ready)
    assert ended == 129
    assert "left by its terminal at t = " in said
    assert kept.is_file()
    short = scene(("duration: 50 ms", "duration: 2 s"))
    other = tmp_path / "other"
    ready = lambda: len(list(other.glob("frames/*.vtu"))) > 1  # noqa: E731
    words = [short, "-o", other, "-q"]
    ended, said = stopped(words, signal.SIGHUP, ready, handler=signal.SIG_IGN)
    assert (ended, said) == (0, "")


@pytest.mark.parametrize(
    ("number", "handler", "code", "said"),
    [
        (signal.SIGHUP, signal.SIG_DFL, 129, "tissu: left by its terminal, nothing was written\n"),
        (signal.SIGTERM, signal.SIG_DFL, 143, "tissu: terminated, nothing was written\n"),
        (signal.SIGHUP, signal.SIG_IGN, 0, ""),
    ],
    ids=["hup", "term", "nohup"],
)
def test_a_command_that_runs_no_scene_ends_with_a_sentence(number, handler, code, said):
    """The signal comes while a command is at work, in the place of whatever it does."""
    program = f"""
import os
from tissu import cli
cli._run = lambda: os.kill(os.getpid(), {int(number)}) or 0
cli.main()
"""
    ended = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=300,
        preexec_fn=lambda: signal.signal(number, handler),
    )  # fmt: skip
    assert (ended.returncode, ended.stderr) == (code, said)


def test_python_gets_keyboard_interrupt_and_the_last_good_step(scene, tmp_path):
    program = f"""
import os, signal, sys, threading, time
import numpy as np, tissu as ts
signal.signal(signal.SIGINT, signal.default_int_handler)
simulation = ts.Scene.from_yaml({str(scene())!r}).replace(
    step=ts.Static(
        newton=ts.Newton(iterations=2_000_000_000, tolerance=1e-300),
        solver=ts.ConjugateGradient(iterations=2_000_000_000, tolerance=1e-300),
    )
).compile()
state = simulation.positions["bar"].copy()
def interrupt():
    time.sleep(0.5)
    os.kill(os.getpid(), signal.SIGINT)
threading.Thread(target=interrupt).start()
try:
    simulation.step()
except KeyboardInterrupt:
    assert simulation.time == 0.0
    assert (simulation.positions["bar"] == state).all()
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    sys.exit(42)
"""
    ended = subprocess.run([sys.executable, "-c", program], timeout=300, capture_output=True)
    assert ended.returncode == 42, ended.stderr


def test_a_full_or_closed_output_is_a_sentence(scene, tmp_path):
    """The device `full` stands for a full disk; a pipe without a reader, for `head`."""
    file = scene()
    with open("/dev/full", "w") as full:
        for words in (["run", file, "-o", tmp_path / "a"], ["check", file], ["info"]):
            ended = subprocess.run(
                command(*words), stdout=full, stderr=subprocess.PIPE, text=True, timeout=300
            )
            assert ended.returncode == 2
            assert ended.stderr == "tissu: the output cannot be written: No space left on device\n"
    assert summary(tmp_path / "a")["status"] == "finished"
    reader, writer = os.pipe()
    os.close(reader)
    ended = run(
        file, "-o", tmp_path / "b", stdout=writer, stderr=subprocess.PIPE, capture_output=False
    )
    os.close(writer)
    assert (ended.returncode, ended.stderr) == (0, "")
    assert summary(tmp_path / "b")["status"] == "finished"
    line = " ".join(command("run", file, "-o", tmp_path / "c"))
    closed = subprocess.run(f"{line} >&- 2>&-", shell=True, timeout=300, check=False)
    assert closed.returncode == 0
    assert summary(tmp_path / "c")["status"] == "finished"


def test_names_that_a_terminal_cannot_show_are_escaped(scene, tmp_path):
    file = scene(("law: {type: stvk", "law: {type: stµk"))
    ascii_only = {**os.environ, "LC_ALL": "C", "PYTHONIOENCODING": "ascii:strict"}
    ended = run(file, "-o", tmp_path / "out", env=ascii_only)
    assert ended.returncode == 2
    assert r"unknown type 'st\xb5k'" in ended.stderr


def test_an_output_folder_taken_away_ends_in_a_sentence(scene, tmp_path):
    file = scene(("duration: 50 ms", "duration: 1000 s\noutput: {every: 1 s}"))
    out, kept = tmp_path / "out", tmp_path / "kept"
    words = [file, "-o", out, "--checkpoint", kept]
    child = subprocess.Popen(
        command("run", *words), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    limit = time.monotonic() + 120
    while time.monotonic() < limit and len(list(out.glob("frames/*.vtu"))) < 2:
        time.sleep(1e-2)
    os.rename(out, tmp_path / "moved")
    try:
        _, said = child.communicate(timeout=120)
    finally:
        child.kill()
    assert child.returncode == 2
    assert "Traceback" not in said
    assert re.fullmatch(r"tissu: .*(out: it was taken away|cannot be written).*\n", said), said
    assert kept.is_file()
    assert not out.exists()


def test_a_pipe_as_a_scene_is_refused(tmp_path):
    os.mkfifo(tmp_path / "scene.yaml")
    ended = run(tmp_path / "scene.yaml")
    assert ended.returncode == 2
    assert "scene.yaml: found a pipe; a YAML file is accepted" in ended.stderr
    os.mkfifo(tmp_path / "kept")
    (tmp_path / "bar.yaml").write_text(SCENE)
    ended = run(tmp_path / "bar.yaml", "--resume", tmp_path / "kept", "-o", tmp_path / "out")
    assert ended.returncode == 2
    assert "kept: found a pipe; a regular file is accepted" in ended.stderr


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ("young: 20 kPa", "young: -1 Pa", "young"),
        ("fixed:\n", "fixed:\n  - {body: liver, on: all}\n", "liver"),
        ("max: [1 mm, null, null]", "max: [-1 m, null, null]", "no node"),
    ],
)
def test_a_run_that_is_refused_leaves_no_folder(scene, tmp_path, old, new, why):
    """Found by the schema or only when the scene is compiled; folders that were there stay."""
    written = scene((old, new))
    out = tmp_path / "a" / "b"
    done = run(written, "--out", out)
    assert done.returncode == 2 and why in done.stderr
    assert not (tmp_path / "a").exists()
    out.mkdir(parents=True)
    assert run(written, "--out", out).returncode == 2
    assert out.is_dir()
