"""Laws of one's own are compiled once, on this machine's compiler, and found again from files."""

import hashlib
import json
import subprocess
import sys
from pathlib import Path

import pytest

import tissu as ts
from tissu import _core

pytest.importorskip("sympy")

import sympy

from tissu.formula import I_C, J, ln
from tissu.user_law import compiler, law_from_record

mu, kappa = sympy.symbols("mu kappa")

SOFT = '''"""Soft: neo-Hooke with a bulk modulus. A test's own."""

from tissu.formula import I_C, J, Parameter, ln, symbols_of

PARAMETERS = (
    Parameter(name="mu", unit="Pa", meaning="shear modulus", typical=1e3, above=0.0),
    Parameter(name="kappa", unit="Pa", meaning="bulk modulus", typical=2e4, above=0.0),
)
mu, kappa = symbols_of(PARAMETERS)
CONSTANTS = {"mu": mu, "kappa": kappa}
ENERGY = mu / 2 * (I_C - 3 - 2 * ln(J)) + kappa / 2 * (J - 1) ** 2
'''

SCENE = """
name: bar
laws: [soft.py]
bodies:
  bar:
    mesh: {type: bar, size: [4 cm, 1 cm, 1 cm], cells: [4, 1, 1], cell: hexahedron}
    law: {type: soft, mu: 2 kPa, kappa: 20 kPa, fibres: {k1: 1 kPa, k2: 0.5, direction: [1, 0, 0]}}
    density: 1000
fixed:
  - {body: bar, on: {type: box, max: [1 mm, null, null]}}
gravity: [0, 0, -9.81]
step: {type: implicit_euler, dt: 10 ms}
duration: 50 ms
"""


def define():
    return ts.law(
        "soft_tissue",
        energy=mu / 2 * (I_C - 3 - 2 * ln(J)) + kappa / 2 * (J - 1) ** 2,
        parameters={"mu": "Pa", "kappa": "Pa"},
    )


@pytest.fixture
def cache(tmp_path, monkeypatch):
    """An empty folder of compiled laws."""
    monkeypatch.setenv("TISSU_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache" / "laws"


@pytest.fixture
def scene_file(tmp_path):
    (tmp_path / "soft.py").write_text(SOFT, encoding="utf-8")
    path = tmp_path / "bar.yaml"
    path.write_text(SCENE, encoding="utf-8")
    return path


def libraries(folder):
    return {path.name: path.stat().st_mtime_ns for path in folder.glob("*.so")}


def test_a_law_is_compiled_once(cache, monkeypatch):
    first = define()
    before = libraries(cache)
    assert len(before) == 1
    assert sorted(path.suffix for path in cache.iterdir()) == [".cpp", ".json", ".so"]

    def refuse(*_):
        raise AssertionError("it compiles again")

    monkeypatch.setattr("tissu.user_law.cache.run_compiler", refuse)
    again = define()
    assert libraries(cache) == before
    assert again(mu=1e3, kappa=1e4) == first(mu=1e3, kappa=1e4)


def test_a_folder_of_the_user_is_the_default(tmp_path, monkeypatch):
    monkeypatch.delenv("TISSU_CACHE")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    define()
    assert len(libraries(tmp_path / "tissu" / "laws")) == 1


def test_other_flags_are_another_library(cache, monkeypatch):
    monkeypatch.setenv("TISSU_ISA", "baseline")
    law = define()
    assert law.made.build().loaded.instruction_set == "baseline"
    monkeypatch.delenv("TISSU_ISA")
    best = _core.build_info()["instruction_set"]
    # The same class serves both: what a world runs with is asked when it is made.
    assert law.made.build().loaded.instruction_set == best
    assert len(libraries(cache)) == len({"baseline", best})


def processes(count):
    """What as many other processes print, all of which define the law at once."""
    code = Path(__file__).read_text(encoding="utf-8")
    code = code[code.index("def define():") : code.index("@pytest.fixture")]
    code = (
        "import sympy, tissu as ts\nfrom tissu.formula import I_C, J, ln\n"
        'mu, kappa = sympy.symbols("mu kappa")\n'
        f"{code}\nprint(define()(mu=1e3, kappa=1e4).made.digest)"
    )
    command = [sys.executable, "-c", code]
    runs = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(count)]
    said = [run.communicate()[0] for run in runs]
    assert [run.returncode for run in runs] == [0] * count
    return said


def test_a_library_that_was_cut_off_is_made_again(cache):
    processes(1)  # another one: a library that is open here stays the same whatever its file is
    (path,) = cache.glob("*.so")
    path.write_bytes(b"\x7fELF")
    law = define()
    assert path.stat().st_size > 1000
    assert law(mu=1e3, kappa=1e4).mu == 1e3


def test_two_processes_make_one_law_at_once(cache):
    said = processes(2)
    assert said[0] == said[1] != ""
    assert sorted(path.suffix for path in cache.iterdir()) == [".cpp", ".json", ".so"]


def test_no_compiler_says_what_to_install(cache, monkeypatch, tmp_path):
    monkeypatch.delenv("CXX", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(
        ts.LawError, match=r"looked for c\+\+, g\+\+, clang\+\+ .* install g\+\+ 11"
    ):
        define()
    monkeypatch.setenv("CXX", "/there/is/no/c++ -m64")
    with pytest.raises(ts.LawError, match=r"CXX is '/there/is/no/c\+\+ -m64'"):
        define()
    assert not libraries(cache)


def test_what_the_compiler_says_is_kept(cache, monkeypatch, tmp_path):
    script = tmp_path / "broken-c++"
    script.write_text(
        '#!/bin/sh\n[ "$1" = --version ] && echo broken 1.0 && exit 0\n'
        'echo "no such luck" >&2\nexit 3\n'
    )
    script.chmod(0o755)
    monkeypatch.setenv("CXX", str(script))
    with pytest.raises(ts.LawError, match="its messages are in") as caught:
        define()
    (log,) = cache.glob("*.log")
    assert str(log) in str(caught.value)
    assert "no such luck" in log.read_text()
    assert "exit status 3" in log.read_text()
    assert not libraries(cache)


def test_a_cache_that_cannot_be_written_is_named(monkeypatch, tmp_path):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("TISSU_CACHE", str(tmp_path / "file"))
    with pytest.raises(ts.LawError, match="name a folder that can be written in TISSU_CACHE"):
        define()


def test_headers_of_made_code_are_there():
    names = {path.name for path in compiler.header_files()}
    assert {"batch.h", "tensor.h", "law_library.h", "point.h"} <= names


def test_a_scene_file_names_files_with_laws(scene_file, tmp_path):
    out = tmp_path / "out"
    command = [sys.executable, "-m", "tissu.cli", "run", str(scene_file)]
    command += ["--out", str(out), "--trust-laws"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    (file,) = out.rglob("summary.json")
    summary = json.loads(file.read_text())
    assert summary["status"] == "finished"
    (record,) = summary["laws"]
    assert record["name"] == "soft"
    assert record["file"] == str(tmp_path / "soft.py")
    assert summary["scene"]["bodies"]["bar"]["law"]["mu"] == 2000.0
    # The law is made again from the summary alone: its C++ is the same, letter for letter.
    again = law_from_record(record)
    assert f"sha256:{again.made.digest}" == record["digest"]
    assert hashlib.sha256(again.made.source.encode()).hexdigest() == again.made.digest


def test_the_summary_of_a_law_in_memory_makes_it_again():
    record = json.loads(json.dumps(define().made.record()))
    assert f"sha256:{law_from_record(record).made.digest}" == record["digest"]


def test_a_scene_with_laws_is_written_and_read(scene_file, tmp_path):
    scene = ts.Scene.from_yaml(scene_file, trust_laws=True)
    copy = tmp_path / "elsewhere"
    copy.mkdir()
    scene.save(copy / "bar.yaml")
    assert "laws: [soft.py]" in (copy / "bar.yaml").read_text()
    assert (copy / "soft.py").read_text() == (tmp_path / "soft.py").read_text()
    assert ts.Scene.from_yaml(copy / "bar.yaml", trust_laws=True) == scene
    soft = ts.read_law(tmp_path / "soft.py")
    body = scene.bodies["bar"].replace(law=soft(mu=3e3, kappa=2e4))
    in_python = scene.replace(laws=(), bodies={"bar": body})
    in_python.save(copy / "other.yaml")
    assert ts.Scene.from_yaml(copy / "other.yaml", trust_laws=True) == in_python != scene


def test_a_scene_with_a_law_in_memory_is_not_written(scene_file):
    scene = ts.Scene.from_yaml(scene_file, trust_laws=True)
    body = scene.bodies["bar"].replace(law=define()(mu=3e3, kappa=2e4))
    with pytest.raises(ts.SceneError, match="the law soft_tissue was made in memory"):
        scene.replace(bodies={"bar": body}).to_yaml()


PROBLEMS = {
    "no file": (("laws: [soft.py]", "laws: [sort.py]"), r":3: laws\[0\]: .*sort.py: no such file"),
    "not named": (("laws: [soft.py]\n", ""), r"unknown type 'soft'"),
    "misspelt": (("type: soft", "type: sotf"), r"unknown type 'sotf'; did you mean 'soft'\?"),
    "wrong field": (
        ("mu: 2 kPa", "mu: 2 mm"),
        r"bodies.bar.law.mu: found '2 mm', which is a length",
    ),
}


@pytest.mark.parametrize("case", PROBLEMS)
def test_problems_with_laws_of_a_scene_file_have_lines(case, scene_file):
    (good, bad), reason = PROBLEMS[case]
    assert good in SCENE
    scene_file.write_text(SCENE.replace(good, bad), encoding="utf-8")
    with pytest.raises(ts.SceneError, match=reason):
        ts.Scene.from_yaml(scene_file, trust_laws=True)


FILES = {
    "a program that fails": ("ENERGY = ", "ENERGY = 1 / 0 #", "ZeroDivisionError"),
    "no energy": ("ENERGY = ", "ENERGIE = ", "the file has no ENERGY"),
    "stress at rest": ("(J - 1) ** 2", "((J - 1) ** 2 + J - 1)", "stress at rest"),
    "an addition": ("ENERGY = ", "ADDITION = True\nENERGY = ", "a law that stands alone"),
}


@pytest.mark.parametrize("case", FILES)
def test_wrong_files_are_refused_with_the_reason(case, tmp_path):
    good, bad, reason = FILES[case]
    assert good in SOFT
    (tmp_path / "soft.py").write_text(SOFT.replace(good, bad), encoding="utf-8")
    with pytest.raises(ts.LawError, match=reason):
        ts.read_law(tmp_path / "soft.py")


def test_a_record_of_lame_s_constants_is_read(tmp_path):
    """`lambda` is a word of Python, and a constant of most laws."""
    from tissu.codegen.definition import LAWS

    (tmp_path / "mine.py").write_text((LAWS / "neo_hooke.py").read_text())
    record = ts.read_law(tmp_path / "mine.py").made.record()
    assert "lambda" in record["formula"]
    assert f"sha256:{law_from_record(record).made.digest}" == record["digest"]


@pytest.mark.parametrize("text", ["__import__('os').getcwd()", "mu * secret", "[mu]", "mu *"])
def test_a_record_is_arithmetic_or_refused(tmp_path, text):
    from tissu.codegen.definition import LAWS

    (tmp_path / "mine.py").write_text((LAWS / "neo_hooke.py").read_text())
    record = ts.read_law(tmp_path / "mine.py").made.record()
    with pytest.raises(ts.LawError, match="of a record"):
        law_from_record({**record, "formula": text})
