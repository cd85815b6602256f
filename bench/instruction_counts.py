"""Instructions of the steps of scenes, by function: runs tissu-effects under valgrind's callgrind.

Only what runs inside the function `tissu_effects_steps` is counted, scene after scene in one
process. Counts do not depend on the machine's load, and come out the same in every run.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = Path(os.environ.get("TISSU_EFFECTS", ROOT / "build/main/tests/tissu-effects"))
COUNTED = "tissu_effects_steps"


class Function(NamedTuple):
    """A function of the program or of a library."""

    object_file: str  # name of the file it comes from
    name: str


@dataclass(frozen=True)
class Counts:
    """What the steps of one scene took.

    Attributes:
        scene: what the program says of it: scene, isa, nodes, cells, solves, checksum.
        steps: how many were counted.
        own: instructions of each function itself, without those that it calls; all steps together.
    """

    scene: dict[str, Any]
    steps: int
    own: dict[Function, int]

    @property
    def total(self) -> int:
        """Instructions of all steps."""
        return sum(self.own.values())

    @property
    def per_step(self) -> int:
        """Instructions of one step, rounded."""
        return round(self.total / self.steps)


def missing() -> str | None:
    """Why instructions cannot be counted here; None where they can."""
    if shutil.which("valgrind") is None:
        return "there is no valgrind (Debian: valgrind)"
    if not PROGRAM.exists():
        return f"{PROGRAM} is not built (cmake --build build/main --target tissu-effects)"
    return None


def count(scenes: Sequence[str], *, size: int, steps: int) -> list[Counts]:
    """Runs the scenes one after the other in one process and counts each.

    Args:
        scenes: their names; the same one may stand several times.
        size: of the bar, which has 4 n x 2 n x 2 n boxes.
        steps: how many are counted, after two that are not.
    """
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        valgrind = [
            *("valgrind", "--tool=callgrind", f"--callgrind-out-file={out}"),
            *(f"--toggle-collect={COUNTED}", f"--dump-after={COUNTED}"),
            *("--compress-strings=no", "--compress-pos=no"),
        ]
        command = [*valgrind, str(PROGRAM), "count", str(size), str(steps), *scenes]
        done = subprocess.run(
            command, capture_output=True, text=True, env=surroundings(), check=False
        )
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(command)} failed:\n{done.stderr[-3000:]}")
        described = [json.loads(line) for line in done.stdout.splitlines()]
        dumps = [out.with_name(f"out.{number + 1}") for number in range(len(scenes))]
        return [
            Counts(
                scene=scene, steps=steps, own=own_instructions(dump.read_text("utf-8").splitlines())
            )
            for scene, dump in zip(described, dumps, strict=True)
        ]


def surroundings() -> dict[str, str]:
    """The environment in which scenes run: nothing that chooses kernels or spins."""
    ours = {"OPENBLAS_NUM_THREADS": "1", "OMP_WAIT_POLICY": "passive", "LD_BIND_NOW": "1"}
    return {**os.environ, **ours, "TISSU_ISA": ""}


def own_instructions(lines: Iterable[str]) -> dict[Function, int]:
    """Reads a profile of callgrind written without compression: own instructions by function.

    A line of a position and a cost belongs to the function named last, but the one after `calls=`
    gives what the called function took in all, which is counted where that function stands.
    """
    own: dict[Function, int] = {}
    object_file, function, total = "", None, None
    of_call = False
    for line in lines:
        key, separator, value = line.partition("=")
        if separator and key == "ob":
            object_file = Path(value).name
        elif separator and key == "fn":
            function = Function(object_file, value)
        elif separator and key == "calls":
            of_call = True
        elif line.startswith("totals:"):
            total = int(line.split()[1])
        elif line[:1] in "0123456789+-*" and function is not None and line:
            if not of_call:
                own[function] = own.get(function, 0) + int(line.split()[1])
            of_call = False
    if total is not None and total != sum(own.values()):
        raise RuntimeError(f"the profile says {total} instructions, its lines {sum(own.values())}")
    return own


def seconds(scenes: Sequence[str], *, size: int, steps: int, rounds: int) -> list[dict[str, Any]]:
    """Runs the scenes in turn without valgrind; what the program says, `seconds` of each round."""
    command = [str(PROGRAM), "time", *map(str, (size, steps, rounds)), *scenes]
    done = subprocess.run(command, capture_output=True, text=True, env=surroundings(), check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]
