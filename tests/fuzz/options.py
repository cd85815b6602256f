"""Command lines with odd words; whatever is written stays in the folder of the case."""

from __future__ import annotations

import contextlib
import io
import os
import random
import shutil
import sys
from pathlib import Path
from unittest import mock

import tissu as ts
from tissu.cli import _run

SCENE = """\
name: bar
bodies:
  bar:
    mesh: {type: bar, size: [0.2, 0.05, 0.05], cells: [2, 1, 1]}
    law: {type: stvk, young: 20 kPa, poisson: 0.4}
    density: 1000
fixed:
  - {body: bar, on: {type: box, max: [1 mm, null, null]}}
step: {type: implicit_euler, dt: 10 ms}
duration: 20 ms
"""
FILES = ("bar.yaml", "mesh.vtu", "pipe.vtu", "folder", "lost.vtu", "new.vtu", "new.msh", "new", "")
FILES += ("x" * 300, "a/b.vtu", "é.vtu", "bad.yaml")
WORDS = (
    "",
    "0",
    "-1",
    "1",
    "2",
    "nan",
    "inf",
    "1e400",
    "5 mm",
    "10 ms",
    "1 kPa",
    "99999999999999999999",
)
WORDS += ("x" * 300, "tetra", "hexahedron", "six", "finest", "fem", "mass-spring", "1%", "--", "µ")
OPTIONS = {
    "run": ("--out", "--duration", "--threads", "--resume", "--checkpoint", "--checkpoint-every",
            "--quiet", "--trust-laws", "--accept-unconverged"),
    "check": ("--trust-laws",),
    "info": (),
    "example": ("--out",),
    "mesh info": ("--unit", "--scale"),
    "mesh bar": ("--size", "--cells", "--output", "--cell", "--split", "--origin", "--segments"),
    "mesh convert": ("--output", "--unit", "--scale"),
    "": ("--version", "--help", "--nothing"),
}  # fmt: skip
ALONE = ("--quiet", "--trust-laws", "--accept-unconverged", "--version", "--help")
PLACES = ("--out", "--resume", "--checkpoint", "--output")
THREE = ("--size", "--cells", "--origin")


def words(dice: random.Random) -> list[str]:
    """A command line."""
    command = dice.choice(list(OPTIONS))
    line = command.split()
    if command in ("run", "check", "mesh info", "mesh convert", "example"):
        line += [dice.choice((*FILES, "bar.yaml", "bar.yaml", "mesh.vtu", "organ"))]
    for option in OPTIONS[command]:
        if dice.random() < 0.4:
            count = 0 if option in ALONE else 3 if option in THREE else 1
            pool = FILES if option in PLACES else WORDS
            line += [option, *(dice.choice(pool) for _ in range(count))]
    if dice.random() < 0.1:
        dice.shuffle(line)
    return line


def prepared(folder: Path) -> Path:
    """A folder with something of everything."""
    place = folder / "case"
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir()
    (place / "bar.yaml").write_text(SCENE)
    (place / "bad.yaml").write_text("name: [")
    (place / "folder").mkdir()
    os.mkfifo(place / "pipe.vtu")
    (place / "lost.vtu").symlink_to("absent")
    ts.write_mesh(ts.bar_mesh(size=(1, 1, 1), cells=(1, 1, 1)), place / "mesh.vtu")
    return place


def attempt(seed: int, folder: Path) -> str:
    """One command: its exit code, after looking at what it said and did."""
    line = words(random.Random(seed))
    place = prepared(folder)
    out, said = io.StringIO(), io.StringIO()
    argv = mock.patch.object(sys, "argv", ["tissu", *line])
    with (
        contextlib.chdir(place) if hasattr(contextlib, "chdir") else _within(place),
        argv,
        contextlib.redirect_stdout(out),
        contextlib.redirect_stderr(said),
    ):
        code = _run()
    assert code in (0, 1, 2, 3), (line, code)
    assert "Traceback" not in said.getvalue(), (line, said.getvalue())
    assert code == 0 or (said.getvalue() + out.getvalue()).strip(), (line, "failed without a word")
    assert (place / "pipe.vtu").is_fifo() and (place / "lost.vtu").is_symlink(), line
    assert sorted(p.name for p in folder.iterdir() if p.name == "absent") == []
    return f"ended with {code}"


@contextlib.contextmanager
def _within(place: Path):
    before = Path.cwd()
    os.chdir(place)
    try:
        yield
    finally:
        os.chdir(before)
