"""What a user of an installed tissu finds: examples, completion, `python -m tissu`, errors."""

import os
import re
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import pytest

import tissu as ts

ROOT = Path(__file__).resolve().parents[2]


def command(*words, **options):
    line = [sys.executable, "-m", "tissu", *map(str, words)]
    return subprocess.run(line, capture_output=True, text=True, timeout=300, **options)


def test_python_m_tissu_is_the_command():
    assert command("--version").stdout == f"tissu {ts.__version__}\n"


def test_every_example_is_copied_and_compiles(tmp_path):
    names = command("example").stdout.split()
    assert names == sorted(p.stem for p in (ROOT / "examples").glob("*.yaml"))
    assert "organ" in names
    for name in names:
        ended = command("example", name, "-o", tmp_path / name)
        assert ended.returncode == 0, ended.stderr
        assert ts.Scene.from_yaml(tmp_path / name / f"{name}.yaml").check().ok
        again = command("example", name, "-o", tmp_path / name)
        assert again.returncode == 0
    assert sorted(p.name for p in (tmp_path / "organ").iterdir()) == ["organ.vtu", "organ.yaml"]
    (tmp_path / "organ" / "organ.yaml").write_text("mine")
    ended = command("example", "organ", "-o", tmp_path / "organ")
    assert ended.returncode == 2
    assert "organ.yaml: found another file" in ended.stderr
    assert (tmp_path / "organ" / "organ.yaml").read_text() == "mine"
    wrong = command("example", "liver")
    assert wrong.returncode == 2
    assert f"found example 'liver'; {', '.join(names)} are accepted" in wrong.stderr


def test_the_organ_is_a_scene():
    organ = ts.examples.organ()
    assert organ == ts.Scene.from_yaml(ts.examples.file("organ"))
    assert organ.check().ok


def test_examples_travel_in_the_wheel():
    """Of an installed tissu: the files that its record lists."""
    listed = {str(path) for path in metadata.files("tissu") or ()}
    wanted = {p.name for p in (ROOT / "examples").iterdir() if p.suffix in (".yaml", ".vtu")}
    assert {f"tissu/examples/{name}" for name in wanted} <= listed


def test_the_metadata_tells_the_licences_of_what_is_inside():
    told = metadata.metadata("tissu")
    assert told["License-Expression"] == "BSD-3-Clause AND MPL-2.0"
    notice = [path for path in metadata.files("tissu") or () if path.name == "NOTICE.md"]
    text = notice[0].read_text()
    libraries = re.findall(r"^\| ([A-Z]\w+|pybind11)", text, re.MULTILINE)
    assert libraries == ["Eigen", "pybind11", "CHOLMOD", "BLAS", "FCL"]
    assert "viz" not in (told.get_all("Provides-Extra") or [])
    assert not [need for need in metadata.requires("tissu") or () if "pyvista" in need]


@pytest.mark.parametrize(("typed", "offered"), [("exa", "example"), ("comp", "compare")])
def test_a_shell_completes_commands(typed, offered):
    asked = {"_TISSU_COMPLETE": "complete_bash", "COMP_WORDS": f"tissu {typed}", "COMP_CWORD": "1"}
    ended = subprocess.run(
        [sys.executable, "-m", "tissu"],
        env={**os.environ, **asked}, capture_output=True, text=True, timeout=300,
    )  # fmt: skip
    assert ended.stdout.split() == [offered]
    assert "--install-completion" in command("--help").stdout


MISSING = """
import sys
class Missing:
    def find_spec(self, name, path=None, target=None):
        if name == "tissu._core":
            raise ImportError("libcholmod.so.3: cannot open shared object file: No such file")
sys.meta_path.insert(0, Missing())
"""


def test_a_missing_system_library_is_a_sentence(tmp_path):
    for use in ("import tissu; tissu.bar_mesh", "from tissu import _core", "import tissu.mesh"):
        ended = subprocess.run(
            [sys.executable, "-c", MISSING + use], capture_output=True, text=True, timeout=300
        )
        assert ended.returncode == 1
        last = ended.stderr.strip().splitlines()[-1]
        assert last.startswith("ImportError: the compiled core of tissu cannot be loaded: libcholm")
        assert "sudo apt install libcholmod3" in last
    (tmp_path / "a.yaml").write_text("name: a")
    for words in (["info"], ["check", str(tmp_path / "a.yaml")]):
        line = f"{MISSING}sys.argv[1:] = {words!r}\nfrom tissu.cli import main\nmain()"
        ended = subprocess.run(
            [sys.executable, "-c", line], capture_output=True, text=True, timeout=300
        )
        assert ended.returncode == 2
        assert ended.stderr.startswith("tissu: the compiled core of tissu cannot be loaded")
        assert "Traceback" not in ended.stderr
