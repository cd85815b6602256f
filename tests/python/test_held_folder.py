"""One run at a time writes into a folder of results; the next one finds nothing left of it."""

import errno
import fcntl
import gc
import subprocess
import sys
import time

import pytest

import tissu as ts
from tissu.errors import TissuError
from tissu.output import Series, folder_of_run

SCENE = """\
name: NAME
bodies:
  bar:
    mesh: {type: bar, size: [0.1, 0.05, 0.05], cells: [2, 1, 1]}
    law: {type: stvk, young: 20 kPa, poisson: 0.4}
    density: 1000
gravity: [0, 0, -9.81]
step: {type: implicit_euler, dt: 10 ms}
duration: TIME
"""
BUSY = "another run of tissu that writes there, one at a time is accepted; wait for its end"
HOLDER = "import sys, time\nfrom tissu.output.held import hold\nkept = hold(sys.argv[1])\n"


def scene(folder, name, duration="20 ms"):
    file = folder / f"{name}.yaml"
    file.write_text(SCENE.replace("NAME", name).replace("TIME", duration))
    return file


def command(*words):
    return [sys.executable, "-m", "tissu", "run", *map(str, words), "--no-picture", "--quiet"]


def run(*words):
    return subprocess.run(command(*words), capture_output=True, text=True, timeout=120)


@pytest.fixture
def holder(tmp_path):
    """A process that holds the folder `two`."""
    (tmp_path / "two").mkdir()
    code = f"{HOLDER}print('held', flush=True)\ntime.sleep(300)"
    words = [sys.executable, "-c", code, str(tmp_path / "two")]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "held\n"
        yield process
        process.kill()


def test_a_second_run_is_refused_until_the_first_is_gone(tmp_path):
    out = tmp_path / "two"
    long = scene(tmp_path, "long", "1000 s")
    with subprocess.Popen(command(long, "-o", out), stderr=subprocess.PIPE) as first:
        begin = time.monotonic()
        while not (out / "long.pvd").is_file() and time.monotonic() < begin + 120:
            time.sleep(0.05)
        second = run(scene(tmp_path, "short"), "-o", out)
        assert second.returncode == 2
        assert second.stderr.startswith(f"tissu: output folder {out}: found {BUSY}")
        assert second.stderr.count("\n") == 1
        assert not (out / "short.pvd").exists() and (out / "long.pvd").is_file()
        first.kill()
    third = run(scene(tmp_path, "short"), "-o", out)
    assert third.returncode == 0, third.stderr
    assert (out / "short.pvd").is_file()


def test_a_series_in_python_is_refused_as_well(tmp_path, holder):
    simulation = ts.Scene.from_yaml(scene(tmp_path, "bar")).compile()
    with pytest.raises(TissuError, match=BUSY):
        Series(simulation, tmp_path / "two")
    holder.kill()
    holder.wait()
    Series(simulation, tmp_path / "two").write()
    assert sorted(p.name for p in (tmp_path / "two").iterdir()) == ["bar.pvd", "frames"]


def test_one_process_may_make_several_series_and_lets_go_with_the_last(tmp_path):
    simulation = ts.Scene.from_yaml(scene(tmp_path, "bar")).compile()
    first = Series(simulation, tmp_path / "two")
    second = Series(simulation, tmp_path / "two")
    del first
    gc.collect()
    assert run(scene(tmp_path, "short"), "-o", tmp_path / "two").returncode == 2
    second.write()
    del second
    gc.collect()
    assert run(scene(tmp_path, "short"), "-o", tmp_path / "two").returncode == 0


def test_without_locks_a_run_goes_on(tmp_path, monkeypatch):
    def refused(*_):
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr(fcntl, "flock", refused)
    with folder_of_run(tmp_path / "out") as folder:
        assert folder.is_dir()


def test_a_refused_run_leaves_no_new_folder_and_holds_none(tmp_path):
    with pytest.raises(RuntimeError), folder_of_run(tmp_path / "out"):
        raise RuntimeError
    assert not (tmp_path / "out").exists()
    with folder_of_run(tmp_path / "out"):
        pass
