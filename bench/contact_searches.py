"""The rows of tissu-bench on searches and pairs, as tables of docs/measured/contact.md."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path
from typing import Any

from kernels import digits, table

ROOT = Path(__file__).resolve().parents[1]
PROGRAM = Path(os.environ.get("TISSU_BENCH", ROOT / "build/main/bench/tissu-bench"))
OTHERS = {"fcl"}
"""Broad phases whose own memory tissu does not see."""


def rows(named: str) -> list[dict[str, Any]]:
    """Those whose names begin so."""
    command = [str(PROGRAM), f"--benchmark_filter=^{named}", "--benchmark_format=json"]
    command.append("--benchmark_min_time=0.05")
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return list(json.loads(done.stdout)["benchmarks"])


def broad_text() -> str:
    """The table of broad phases: a line for each, a column for each number of triangles."""
    times: dict[str, dict[int, dict[str, Any]]] = {}
    for entry in rows("broad phase/"):
        _, name, triangles = entry["name"].split("/")[:3]
        times.setdefault(name, {})[int(triangles)] = entry
    anew: dict[str, list[str]] = {}
    for entry in rows("broad phase anew/"):
        anew.setdefault(entry["name"].split("/")[1], []).append(digits(float(entry["cpu_time"])))
    sizes = sorted({size for of in times.values() for size in of})
    lines = []
    for name, of in times.items():
        largest = of[max(of)]
        cells = [digits(float(of[size]["cpu_time"])) if size in of else "" for size in sizes]
        growth = f"n^{largest['growth']:.2f}" if "growth" in largest else ""
        memory = "" if name in OTHERS else digits(float(largest["bytes/triangle"]))
        lines.append([f"`{name}`", *cells, growth, memory, *anew[name]])
    head = ["ms", *(f"{size:,} triangles" for size in sizes), "growth", "bytes a triangle"]
    return table([*head, "anew, near", "anew, far apart"], lines)


def pairs_text() -> str:
    """What one pair costs, of each kind."""
    lines: dict[str, list[str]] = {}
    for entry in rows("pair/"):
        _, what, _ = entry["name"].split("/")[:3]
        worst = f"; worst {digits(float(entry['worst us']))} us" if "worst us" in entry else ""
        lines.setdefault(what, []).append(f"{digits(float(entry['ns/pair']))}{worst}")
    return table(["ns a pair", "vertex-face", "edge-edge"], [[k, *v] for k, v in lines.items()])
