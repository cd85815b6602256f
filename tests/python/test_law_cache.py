"""The cache of compiled laws: what is loaded is what this user's tissu made, to the byte."""

import os
import stat
import subprocess
import sys

import pytest

import tissu as ts

pytest.importorskip("sympy")

from tissu.user_law import compiler
from tissu.user_law.private import private_folder

DEFINE = """
import sympy, tissu as ts
from tissu.formula import I_C, J, ln
mu, kappa = sympy.symbols("mu kappa")
law = ts.law(
    "cached",
    energy=mu / 2 * (I_C - 3 - 2 * ln(J)) + kappa / 2 * (J - 1) ** 2,
    parameters={"mu": "Pa", "kappa": "Pa"},
)
print(law(mu=1e3, kappa=1e4).made.digest)
"""
EVIL = """
#include <cstdio>
__attribute__((constructor)) static void loaded() { std::fclose(std::fopen("PLACE", "w")); }
"""


def define(cache):
    """Another process, since a library that is open here stays open."""
    return subprocess.run(
        [sys.executable, "-c", DEFINE],
        env={**os.environ, "TISSU_CACHE": str(cache)},
        capture_output=True,
        text=True,
        timeout=600,
    )


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A cache with one law in it."""
    cache = tmp_path_factory.mktemp("cache") / "tissu"
    ended = define(cache)
    assert ended.returncode == 0, ended.stderr
    return cache


def files(cache, ending):
    (found,) = (cache / "laws").glob(f"*{ending}")
    return found


def test_the_folder_and_its_files_are_the_user_s_alone(made):
    assert stat.S_IMODE((made / "laws").stat().st_mode) == 0o700
    for ending in (".so", ".json"):
        assert stat.S_IMODE(files(made, ending).stat().st_mode) == 0o600


def test_a_folder_that_others_may_read_is_closed_to_them(tmp_path):
    folder = tmp_path / "laws"
    folder.mkdir()
    folder.chmod(0o755)
    private_folder(folder)
    assert stat.S_IMODE(folder.stat().st_mode) == 0o700


def evil_library(folder):
    (folder / "evil.cpp").write_text(EVIL.replace("PLACE", str(folder / "loaded")))
    command = [*compiler.find_compiler().command, "-shared", "-fPIC", "evil.cpp", "-o", "evil.so"]
    subprocess.run(command, cwd=folder, check=True, timeout=300)
    return folder / "evil.so"


def test_a_library_that_tissu_did_not_make_is_not_loaded(made, tmp_path):
    evil = evil_library(tmp_path).read_bytes()
    good = files(made, ".so").read_bytes()
    files(made, ".so").write_bytes(evil)
    ended = define(made)
    assert ended.returncode == 0, ended.stderr
    assert not (tmp_path / "loaded").exists()
    assert files(made, ".so").read_bytes() != evil
    assert len(files(made, ".so").read_bytes()) == len(good)
    # The same by a link, and with a library that others may write.
    library = files(made, ".so")
    os.replace(library, tmp_path / "kept.so")
    library.symlink_to(evil_library(tmp_path))
    assert define(made).returncode == 0
    assert not (tmp_path / "loaded").exists()
    assert not files(made, ".so").is_symlink()


def test_a_folder_of_others_is_refused(made, tmp_path):
    cache = tmp_path / "tissu"
    (cache / "laws").mkdir(parents=True)
    (cache / "laws").chmod(0o777)
    ended = define(cache)
    assert ended.returncode == 1
    assert "laws: other users may write in it; empty it and close it with chmod 700" in ended.stderr
    assert list((cache / "laws").iterdir()) == []
    (cache / "laws").rmdir()
    (cache / "laws").symlink_to(made / "laws")
    ended = define(cache)
    assert ended.returncode == 1
    assert "it is a link or a file" in ended.stderr


def test_a_folder_of_another_user_is_refused(tmp_path, monkeypatch):
    from tissu.user_law.private import private_folder

    folder = private_folder(tmp_path / "mine")
    monkeypatch.setattr(os, "geteuid", lambda: folder.stat().st_uid + 1)
    with pytest.raises(ts.LawError, match="it belongs to the user"):
        private_folder(folder)


def test_what_was_checked_is_what_is_loaded(tmp_path):
    """The loader reads the bytes that were compared, whatever comes into the folder since."""
    from tissu.user_law.library_image import library_image

    image = library_image("one", b"first")
    other = library_image("two", b"second")
    assert image != other
    with open(image, "rb") as file:
        assert file.read() == b"first"
    with open(other, "rb") as file:
        assert file.read() == b"second"
