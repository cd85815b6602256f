"""Files of laws are programs: they run where they are trusted, from the scene's folder."""

import json
import subprocess
import sys
import textwrap

import pytest

import tissu as ts

pytest.importorskip("sympy")

SOFT = '''"""Soft: neo-Hooke with a bulk modulus. A test's own."""

from pathlib import Path

from tissu.formula import I_C, J, Parameter, ln, symbols_of

Path(__file__).resolve().with_name("ran").touch()
PARAMETERS = (
    Parameter(name="mu", unit="Pa", meaning="shear modulus", typical=1e3, above=0.0),
    Parameter(name="kappa", unit="Pa", meaning="bulk modulus", typical=2e4, above=0.0),
)
mu, kappa = symbols_of(PARAMETERS)
CONSTANTS = {"mu": mu, "kappa": kappa}
ENERGY = mu / 2 * (I_C - 3 - 2 * ln(J)) + kappa / 2 * (J - 1) ** 2
'''

SCENE = """\
name: bar
laws: [soft.py]
bodies:
  bar:
    mesh: {type: bar, size: [4 cm, 1 cm, 1 cm], cells: [2, 1, 1]}
    law: {type: soft, mu: 2 kPa, kappa: 20 kPa}
    density: 1000
fixed:
  - {body: bar, on: {type: box, max: [1 mm, null, null]}}
step: {type: implicit_euler, dt: 10 ms}
duration: 20 ms
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "scene").mkdir()
    (tmp_path / "scene" / "soft.py").write_text(SOFT)
    (tmp_path / "scene" / "bar.yaml").write_text(SCENE)
    return tmp_path / "scene"


def ran(folder):
    return [path for path in folder.parent.rglob("ran")]


def refused(folder, text=None, **options):
    """The problems of a scene whose laws must not have been run."""
    (folder / "bar.yaml").write_text(SCENE if text is None else text)
    with pytest.raises(ts.SceneError) as raised:
        ts.Scene.from_yaml(folder / "bar.yaml", **options)
    return raised.value.problems


def test_a_law_runs_only_where_it_is_trusted(folder):
    (problem,) = refused(folder)
    assert "bar.yaml:2: laws: found files with laws, which are programs" in problem
    assert "--trust-laws" in problem
    assert "trust_laws=True" in problem
    assert not ran(folder)
    with pytest.raises(ts.SceneError, match="which are programs"):
        ts.Scene.from_yaml_text(SCENE, base=folder)
    assert not ran(folder)
    ts.Scene.from_yaml(folder / "bar.yaml", trust_laws=True)
    assert ran(folder) == [folder / "ran"]


@pytest.mark.parametrize(
    "words",
    [
        ("run", "bar.yaml"),
        ("check", "bar.yaml"),
        ("compare", "bar.yaml"),
        ("advise", "bar.yaml"),
        ("bench", "accuracy", "bar", "--cases", "."),
    ],
    ids=lambda words: words[0],
)
def test_no_command_runs_a_law_unasked(folder, words):
    study = {"title": "t", "reference": {"file": "x.npz", "body": "bar"}, "small": [], "full": []}
    (folder / "bar.study.yaml").write_text(json.dumps(study))
    command = [sys.executable, "-m", "tissu.cli", *words]
    ended = subprocess.run(command, capture_output=True, text=True, cwd=folder, timeout=120)
    assert ended.returncode == 2, ended.stdout + ended.stderr
    assert "Traceback" not in ended.stderr
    assert not ran(folder)


def test_check_with_trust_reads_the_law(folder):
    command = [sys.executable, "-m", "tissu.cli", "check", "bar.yaml", "--trust-laws"]
    ended = subprocess.run(command, capture_output=True, text=True, cwd=folder, timeout=120)
    assert ended.returncode == 0, ended.stderr
    assert "soft with mu 2000" in ended.stdout
    assert ran(folder)


@pytest.mark.parametrize(
    ("good", "bad", "said"),
    [
        ("density: 1000", "densty: 1000", "densty"),
        ("dt: 10 ms", "dt: -1 s", "dt"),
        ("max: [1 mm", "max: [-1 mm", "selects no node"),
        ("laws: [soft.py]", "laws: [soft.py]\ngravty: 3", "gravty"),
    ],
)
def test_a_law_of_a_scene_with_other_problems_is_not_run(folder, good, bad, said):
    problems = refused(folder, SCENE.replace(good, bad), trust_laws=True)
    assert any(said in problem for problem in problems)
    assert not any("soft" in problem for problem in problems)
    assert not ran(folder)


def test_laws_are_read_from_the_scene_s_folder_only(folder):
    outside = folder.parent / "outside"
    outside.mkdir()
    (outside / "soft.py").write_text(SOFT)
    (folder / "soft.py").unlink()
    (folder / "soft.py").symlink_to(outside / "soft.py")
    (folder / "linked").symlink_to(outside)
    for name in (str(outside / "soft.py"), "../outside/soft.py", "soft.py", "linked/soft.py"):
        (problem,) = refused(folder, SCENE.replace("[soft.py]", f"[{name}]"), trust_laws=True)
        assert f"is {outside / 'soft.py'}, outside the scene's folder {folder}" in problem
    assert not ran(folder)
    (folder / "laws").mkdir()
    (folder / "laws" / "soft.py").write_text(SOFT)
    for name in ("laws/soft.py", str(folder / "laws" / "soft.py"), "laws/../laws/soft.py"):
        (folder / "bar.yaml").write_text(SCENE.replace("[soft.py]", f"[{name}]"))
        assert ts.Scene.from_yaml(folder / "bar.yaml", trust_laws=True).bodies["bar"].law.mu == 2e3


ENDINGS = {
    "sys.exit": ("import sys; sys.exit(0)", "SystemExit: 0"),
    "exit": ("raise SystemExit", "SystemExit"),
    "ctrl-c": ("raise KeyboardInterrupt", "KeyboardInterrupt"),
    "generator": ("raise GeneratorExit('x')", "GeneratorExit: x"),
    "base": ("raise BaseException('two\\nlines')", "BaseException: two lines"),
    "recursion": ("def f(): f()\nf()", "RecursionError"),
    "syntax": ("def", "SyntaxError"),
    "nul": ("\0", "SyntaxError"),
    "memory": ("raise MemoryError", "MemoryError"),
    "warning": ("raise UserWarning('w')", "UserWarning: w"),
    "message": (
        "class Odd(Exception):\n    def __str__(self): raise SystemExit(0)\nraise Odd",
        "Odd: its message raises SystemExit",
    ),
    "energy": (
        SOFT + "\nclass E:\n    def __getattr__(self, n): raise SystemExit(0)\nENERGY = E()",
        "SystemExit: 0",
    ),
}


@pytest.mark.parametrize("case", ENDINGS)
def test_however_a_law_ends_it_is_a_sentence(folder, case):
    program, said = ENDINGS[case]
    (folder / "soft.py").write_text(program)
    (problem,) = refused(folder, trust_laws=True)
    assert said in problem
    assert problem.startswith(f"{folder / 'bar.yaml'}:2: laws[0]: {folder / 'soft.py'}")
    assert "\n" not in problem
    with pytest.raises(ts.LawError):
        ts.read_law(folder / "soft.py")


def test_a_law_that_exits_does_not_end_check(folder):
    (folder / "soft.py").write_text("import sys; sys.exit(0)")
    command = [sys.executable, "-m", "tissu.cli", "check", "bar.yaml", "--trust-laws"]
    ended = subprocess.run(command, capture_output=True, text=True, cwd=folder, timeout=120)
    assert ended.returncode == 2
    assert "soft.py: SystemExit: 0" in ended.stderr


def test_ctrl_c_while_a_law_is_read_stays_ctrl_c(folder):
    program = "import os, signal, time\nos.kill(os.getpid(), signal.SIGINT)\ntime.sleep(60)"
    (folder / "soft.py").write_text(program)
    script = textwrap.dedent(
        """
        import signal, sys, tissu as ts
        signal.signal(signal.SIGINT, signal.default_int_handler)
        try:
            ts.read_law("soft.py")
        except KeyboardInterrupt:
            sys.exit(42)
        """
    )
    ended = subprocess.run([sys.executable, "-c", script], cwd=folder, timeout=120, check=False)
    assert ended.returncode == 42
