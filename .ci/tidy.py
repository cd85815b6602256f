"""Runs clang-tidy on every source of the core, the binding and the benchmarks.

A source is checked again only when it, a header, the checks or the compile command changed since it
last passed: build/tidy holds a stamp for each.
"""

import hashlib
import json
import os
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build/main"
STAMPS = ROOT / "build/tidy"
FOLDERS = ("cpp/src", "python/bind", "bench")
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


def commands() -> list[dict[str, str]]:
    """How each source is compiled; of a kernel compiled several times, the first (baseline) way."""
    own = tuple(str(ROOT / folder) + os.sep for folder in FOLDERS)
    first: dict[str, dict[str, str]] = {}
    for entry in json.loads((BUILD / "compile_commands.json").read_text()):
        if entry["file"].startswith(own):
            entry["command"] = without_precompiled(entry["command"])
            first.setdefault(entry["file"], entry)
    return list(first.values())


def check(source: Path, key: str) -> str:
    """Checks one source; returns its complaints, nothing when there are none."""
    stamp = STAMPS / f"{source.relative_to(ROOT).as_posix().replace('/', '_')}.ok"
    if stamp.exists() and stamp.read_text() == key:
        return ""
    command = ["clang-tidy", "--quiet", "-p", str(STAMPS), str(source)]
    command += [f"--extra-arg={flag}" for flag in EXTRA]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode == 0 and "warning:" not in done.stdout:
        stamp.write_text(key)
        return ""
    return done.stdout + ("" if done.stdout else done.stderr)


def main() -> int:
    """Prints every complaint; 1 when there is one."""
    STAMPS.mkdir(parents=True, exist_ok=True)
    entries = commands()
    (STAMPS / "compile_commands.json").write_text(json.dumps(entries))
    shared = shared_key()
    jobs = []
    for entry in entries:
        source = Path(entry["file"])
        key = hashlib.sha256(shared + source.read_bytes() + entry["command"].encode())
        jobs.append((source, key.hexdigest()))
    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        complaints = list(pool.map(lambda job: check(*job), jobs))
    print("".join(complaints) or f"clang-tidy: {len(jobs)} sources are clean")
    return 1 if any(complaints) else 0


if __name__ == "__main__":
    sys.exit(main())
