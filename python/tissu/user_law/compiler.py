"""The C++ compiler of this machine: which one, with which flags, and what it said."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

from tissu.errors import LawError

NAMES = ("c++", "g++", "clang++")
_PACKAGE = Path(__file__).resolve().parents[1]


@dataclass(frozen=True, slots=True)
class Compiler:
    """A compiler.

    Attributes:
        command: the program, and arguments that $CXX has.
        version: the first line of what `--version` says.
    """

    command: tuple[str, ...]
    version: str


def find_compiler() -> Compiler:
    """$CXX, else the first of c++, g++ and clang++ on the path.

    Raises:
        LawError: there is none.
    """
    asked = shlex.split(os.environ.get("CXX", ""))
    for command in [asked] if asked else [[name] for name in NAMES]:
        program = shutil.which(command[0])
        if program is None:
            continue
        said = _version([program, *command[1:]])
        if said is not None:
            return Compiler((program, *command[1:]), said)
    looked = (
        f"CXX is '{' '.join(asked)}'" if asked else f"looked for {', '.join(NAMES)} on the PATH"
    )
    raise LawError(
        f"a user-defined law needs a C++ compiler, and none that runs was found ({looked}); "
        "install g++ 11 or newer (Debian: sudo apt install g++), or name a compiler in CXX."
    )


def _version(command: list[str]) -> str | None:
    """What a compiler says of itself; None when it does not run."""
    try:
        done = subprocess.run(
            [*command, "--version"], capture_output=True, text=True, check=True, timeout=60
        )
    except (OSError, subprocess.SubprocessError):
        return None
    return (done.stdout.splitlines() or [""])[0].strip()


def include_folders() -> list[Path]:
    """Where the headers of made code are: in the installed package, or in the checkout.

    Raises:
        LawError: in neither.
    """
    installed, checkout = _PACKAGE / "include", _PACKAGE.parents[1] / "cpp"
    if (installed / "law/kernels/point.h").exists():
        return [installed]
    if (checkout / "src/law/kernels/point.h").exists():
        return [checkout / "include", checkout / "src"]
    raise LawError(f"the headers of tissu are missing in {installed}; install tissu again.")


def header_files() -> list[Path]:
    """The headers that made code may read, in a fixed order."""
    folders = [f / "tissu" / room for f in include_folders() for room in ("base", "law")]
    folders += [f / "law/kernels" for f in include_folders()]
    return sorted(path for folder in folders for path in folder.glob("*.h"))


def flags_for(instruction_set: str) -> list[str]:
    """The flags of the core's own kernels, and those of a shared library."""
    from tissu._core import kernel_flags

    flags = ["-std=c++20", *kernel_flags(instruction_set=instruction_set).split()]
    return [*flags, f"-DTISSU_KERNELS={instruction_set}", "-shared", "-fPIC", "-fvisibility=hidden"]


def run_compiler(compiler: Compiler, flags: list[str], source: Path, library: Path) -> str:
    """Compiles `source` into `library`; returns what went wrong, nothing when all went well."""
    includes = [word for folder in include_folders() for word in ("-I", str(folder))]
    command = [*compiler.command, *flags, "-w", *includes, str(source), "-o", str(library)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError as error:
        return f"$ {shlex.join(command)}\n{error}\n"
    if done.returncode == 0:
        return ""
    end = f"exit status {done.returncode}"
    return f"$ {shlex.join(command)}\n{done.stdout}{done.stderr}{end}\n"
