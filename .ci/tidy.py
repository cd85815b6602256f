"""Runs clang-tidy on every source of the core, the binding and the benchmarks.

Most of its time goes into the headers, so neighbouring sources that are compiled alike, and whose
own names do not collide, are read together, as one file that includes them. A group with complaints
is split: a complaint counts only if a source alone has it too.

A source is checked again only when it, a header, the checks or the compile command changed since it
last passed: build/tidy holds a stamp for each.
"""

import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build/main"
STAMPS = ROOT / "build/tidy"
sys.path.insert(0, str(ROOT / "third_party"))
from unity_groups import own_names  # noqa: E402

FOLDERS = ("cpp/src", "python/bind", "bench")
MOST = 16
"""sources that are read together: more of them save little, and take more memory"""
EXTRA = [
    "-Wno-unknown-warning-option",
    # libstdc++ 12 uses its own deprecated get_temporary_buffer in std::stable_sort.
    "-Wno-deprecated-declarations",
]


def shared_key() -> bytes:
    """The checksum of what every source depends on: the headers and the list of checks."""
    total = hashlib.sha256((ROOT / ".clang-tidy").read_bytes())
    for header in sorted((ROOT / "cpp").rglob("*.h")):
        total.update(str(header.relative_to(ROOT)).encode() + header.read_bytes())
    return total.digest()


def without_precompiled(command: str) -> str:
    """The command without the header that GCC precompiled, which clang cannot read."""
    words = shlex.split(command)
    kept: list[str] = []
    for word in words:
        if word.endswith("cmake_pch.hxx") and kept[-1] == "-include":
            kept.pop()
        elif word not in ("-Winvalid-pch", "-fpch-preprocess"):
            kept.append(word)
    return shlex.join(kept)


def sources_of(file: str) -> list[str]:
    """The source itself, or those that the build compiles together in it."""
    if not Path(file).name.startswith("unity_"):
        return [file]
    return re.findall(r'#include "(.*)"', Path(file).read_text())


def commands() -> list[dict[str, str]]:
    """How each source is compiled; of a kernel compiled several times, the first (baseline) way."""
    own = tuple(str(ROOT / folder) + os.sep for folder in FOLDERS)
    first: dict[str, dict[str, str]] = {}
    for entry in json.loads((BUILD / "compile_commands.json").read_text()):
        for file in sources_of(entry["file"]):
            if file.startswith(own):
                command = without_precompiled(entry["command"].replace(entry["file"], file))
                first.setdefault(file, {"file": file, "command": command})
    return list(first.values())


@dataclass(frozen=True)
class Source:
    """A source, the flags it is compiled with, and the checksum of all that its check reads."""

    path: Path
    flags: tuple[str, ...]
    key: str

    @property
    def stamp(self) -> Path:
        """Holds the key of the last time it passed."""
        return STAMPS / f"{self.path.relative_to(ROOT).as_posix().replace('/', '_')}.ok"

    def passed(self) -> bool:
        """Whether nothing that its check reads has changed since then."""
        return self.stamp.exists() and self.stamp.read_text() == self.key


def flags_of(entry: dict[str, str]) -> tuple[str, ...]:
    """The compile command without the compiler, the source and what is written."""
    words = shlex.split(entry["command"])[1:]
    kept: list[str] = []
    skip = False
    for word in words:
        if skip or word in ("-c", "-o", entry["file"]):
            skip = not skip and word == "-o"
        else:
            kept.append(word)
    return tuple(kept)


def complaints_of(group: Sequence[Source]) -> str:
    """What clang-tidy says of the sources, read as one file; nothing when they pass."""
    read = group[0].path
    if len(group) > 1:
        name = hashlib.sha256("".join(str(source.path) for source in group).encode()).hexdigest()
        read = STAMPS / f"{name[:16]}.cpp"
        read.write_text("".join(f'#include "{source.path}"  // NOLINT\n' for source in group))
    command = ["clang-tidy", "--quiet", str(read)]
    command += [f"--extra-arg={flag}" for flag in EXTRA]
    command += ["--", *group[0].flags]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode == 0 and "warning:" not in done.stdout:
        return ""
    return done.stdout + ("" if done.stdout else done.stderr)


def check(group: Sequence[Source]) -> str:
    """Checks a group, complaints apart from the rest; returns those of single sources."""
    complaints = complaints_of(group)
    if not complaints:
        for source in group:
            source.stamp.write_text(source.key)
        return ""
    if len(group) == 1:
        return complaints
    apart = [source for source in group if f"{source.path}:" in complaints]
    rest = [source for source in group if source not in apart]
    if not (apart and rest):
        apart, rest = list(group[: len(group) // 2]), list(group[len(group) // 2 :])
    return check(apart) + check(rest)


def groups(sources: Iterable[Source]) -> list[list[Source]]:
    """Sources of the same flags, neighbours first, MOST at most together; the longest first."""
    found: list[tuple[tuple[str, ...], list[Source], set[str]]] = []
    for source in sorted(sources, key=lambda source: source.path):
        own = own_names(source.path.read_text())
        for other, group, names in found:
            if other == source.flags and len(group) < MOST and names.isdisjoint(own):
                group.append(source)
                names.update(own)
                break
        else:
            found.append((source.flags, [source], own))
    parts = [group for _, group, _ in found]
    return sorted(parts, key=lambda part: -sum(source.path.stat().st_size for source in part))


def main() -> int:
    """Prints every complaint; 1 when there is one."""
    STAMPS.mkdir(parents=True, exist_ok=True)
    shared = shared_key()
    sources = []
    for entry in commands():
        path = Path(entry["file"])
        key = hashlib.sha256(shared + path.read_bytes() + entry["command"].encode())
        sources.append(Source(path, flags_of(entry), key.hexdigest()))
    jobs = groups(source for source in sources if not source.passed())
    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        complaints = list(pool.map(check, jobs))
    print("".join(complaints) or f"clang-tidy: {len(sources)} sources are clean")
    return 1 if any(complaints) else 0


if __name__ == "__main__":
    sys.exit(main())
