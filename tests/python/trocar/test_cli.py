"""tissu trocar check, identify, jitter, record and replay, as a user types them."""

import subprocess
import sys
from pathlib import Path

import pytest
import yaml
from typer.testing import CliRunner

from tissu.cli.app import app

ROOT = Path(__file__).resolve().parents[3]
SCENE = ROOT / "examples" / "trocar.yaml"


def tissu(*arguments, code=0):
    command = [sys.executable, "-m", "tissu", "trocar", *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == code, done.stderr
    return done.stdout + done.stderr


def test_check_says_what_is_there_and_what_bounds_it():
    said = tissu("check", SCENE)
    assert "trocar right: a simulated device" in said
    assert "free, probe" in said
    assert "depth: coupling 1600 N/m, passive up to 2000 N/m" in said


def test_a_recording_replays_with_the_same_bits(tmp_path):
    file = tmp_path / "palpation.npz"
    said = tissu("record", SCENE, file, "--wall", "110 mm", "--seconds", "1.21 s")
    assert "1211 ticks, 31 models" in said  # a model each 40 ms, and one for the rest
    assert "the same bits" in tissu("replay", file)
    assert "no recording" in tissu("replay", SCENE, code=2).replace("not a", "no")
    assert "found no file" in tissu("replay", tmp_path / "none.npz", code=2)


def test_a_recording_feels_the_tissue_of_the_scene(tmp_path):
    """A model each step of 10 ms; the hand has touched the tissue before 0.6 s."""
    file = tmp_path / "touch.npz"
    said = tissu("record", SCENE, file, "--seconds", "0.605 s")
    assert "606 ticks, 60 models" in said
    assert "contact, probe" in said
    assert "the same bits" in tissu("replay", file)
    # The wall takes the place of the tissue, and is not reached.
    said = tissu("record", SCENE, file, "--wall", "290 mm", "--seconds", "0.6 s")
    assert "free, probe" in said
    assert "20 models" in tissu("record", SCENE, file, "--realtime", "--seconds", "0.2 s")
    assert "the same bits" in tissu("replay", file)


def test_a_recording_does_not_replace_its_scene(tmp_path):
    scene = tmp_path / "palpation.yaml"
    scene.write_bytes(SCENE.read_bytes())
    said = tissu("record", scene, scene, "--seconds", "0.01 s", code=2)
    assert f"found {scene}, which the scene is read from and which would be replaced" in said
    assert scene.read_bytes() == SCENE.read_bytes()


def test_identify_prints_what_a_scene_takes():
    said = tissu("identify", SCENE)
    names = ("  damping", "  friction", "  efficiency")
    damping, friction, efficiency = (line for line in said.splitlines() if line.startswith(names))
    assert yaml.safe_load(efficiency)["efficiency"] == pytest.approx([1.0] * 4, abs=0.01)
    assert len(yaml.safe_load(damping)["damping"]) == 4
    assert yaml.safe_load(friction)["friction"][3] == pytest.approx(0.3, rel=0.1)


def test_jitter_says_how_late_and_what_was_granted():
    said = tissu("jitter", SCENE, "--seconds", "0.3 s")
    assert "ticks, " in said
    assert "lateness: p50 " in said
    for asked in ("SCHED_FIFO 60", "locked memory", "core "):
        line = next(line for line in said.splitlines() if line.strip().startswith(asked))
        assert "granted" in line or "refused (errno" in line


def test_what_is_asked_in_vain_is_refused():
    assert "no trocar is named 'rigth'; did you mean 'right'?" in tissu(
        "check", SCENE, "--trocar", "rigth", code=2
    )
    beam = ROOT / "examples" / "beam.yaml"
    assert "found no trocars" in tissu("jitter", beam, code=2)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("jitter", SCENE, "--seconds", "-1 s"), "--seconds: found '-1 s'; 0.001 to 86400 s is"),
        (("jitter", SCENE, "--seconds", "0"), "--seconds: found '0'; 0.001 to 86400 s is accepted"),
        (("jitter", SCENE, "--seconds", "nan"), "--seconds: found 'nan'"),
        (("record", SCENE, "out.npz", "--wall", "nan"), "--wall: found 'nan'"),
        (("record", SCENE, "out.npz", "--wall", "1kg"), "--wall: "),
        (
            ("record", SCENE, "out.npz", "--wall", "1 cm", "--stiffness", "inf"),
            "--stiffness: found 'inf'",
        ),
        (
            ("record", SCENE, "out.npz", "--stiffness", "300"),
            "--stiffness: found '300' without a wall; it is accepted with --wall",
        ),
        (("jitter", SCENE, "--spin", "-1 ms"), "--spin: found '-1 ms'; 0 to 86400 s is accepted"),
        (("record", SCENE, "out.npz", "--seconds", "inf"), "not finite"),
        (("record", SCENE, "out.npz", "--wall", "-5 mm"), "--wall: found '-5 mm'; 0 to 1 m is"),
        (
            ("record", SCENE, "out.npz", "--wall", "1 cm", "--stiffness", "0 N/m"),
            "--stiffness: found '0 N/m'; at least",
        ),
        (
            ("record", SCENE, "out.npz", "--wall", "1 cm", "--stiffness", "-3"),
            "--stiffness: found '-3'; at least",
        ),
        (("record", SCENE, "."), "found the folder .; a file is accepted"),
        (("record", SCENE, "none/out.npz"), "one that is there is accepted: make it first"),
        (("record", "none.yaml", "out.npz"), "none.yaml"),
        (("check", "none.yaml"), "none.yaml"),
        (("check", "."), "."),
        (("identify", "."), "."),
        (("replay", "."), "found the folder .; a file of `tissu trocar record` is accepted"),
    ],
)
def test_odd_input_is_refused_in_one_sentence(arguments, said, tmp_path, monkeypatch, capsys):
    """In this process, since each would load the package anew."""
    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(app, ["trocar", *map(str, arguments)])
    assert result.exit_code == 2, result.output
    told = capsys.readouterr().err or result.stderr
    assert said in told
    assert "Traceback" not in told
    assert len(told.replace("1 problem in the scene:\n- ", "").strip().splitlines()) == 1
    assert not list(tmp_path.iterdir())


def test_a_value_that_was_not_found_is_not_pasted(capsys):
    """A damping of -4.4 N s/m was pasted as 0, an unknown efficiency as 1."""
    from tissu.cli.trocar import _print_field, _values
    from tissu.trocar.identify import Axis

    axis = Axis("depth", -0.007, -4.43, 2.0, None, float("inf"), 0.01, (0.1, 5.0, 0.1))
    said = _values(axis)
    assert said.startswith("inertia not found, damping not found, friction 2 +- 0.1")
    assert "too weak against its friction, raise the torque limit" in said
    _print_field("damping", [0.1, None])
    _print_field("friction", [0.1, 2.0])
    assert capsys.readouterr().out == (
        "  no line for damping: a value of it was not found\n  friction: [0.1, 2]\n"
    )
