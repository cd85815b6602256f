"""What `tissu info` says."""

from __future__ import annotations

import platform
import re
from collections.abc import Mapping
from importlib import metadata
from pathlib import Path
from typing import Any

from tissu.counted import counted

PYTHON_LIBRARIES = ("numpy", "pydantic", "meshio", "matplotlib", "typer", "rich", "PyYAML")


def info_text() -> str:
    """Version, threads, instruction set in use, linked libraries, as lines."""
    from tissu import _core

    return "\n".join(info_lines(_core.build_info()))


def processor(path: Path = Path("/proc/cpuinfo")) -> str:
    """The model name of the processor; of a system that does not give it, the machine's type."""
    text = path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""
    found = re.search(r"^model name\s*:[ \t]*(\S.*)$", text, re.MULTILINE)
    return found.group(1).strip() if found else f"unnamed {platform.machine()} processor"


def machine_line() -> str:
    """What times were measured on, in one sentence."""
    from tissu import _core

    build = _core.build_info()
    return (
        f"tissu {build['version']}, {build['compiler']}, {build['instruction_set']} kernels, "
        f"{counted(int(build['threads_available']), 'thread')} available, {processor()}."
    )


def info_lines(build: Mapping[str, Any]) -> list[str]:
    """The lines, from what the core says of itself."""
    shown = dict(build)
    libraries = dict(shown.pop("libraries", {}))
    lines = [f"{'tissu':<18} {shown.pop('version', '?')}"]
    names = {"threads_available": "threads", "instruction_set": "instruction set"}
    lines += [f"{names.get(key, key.replace('_', ' ')):<18} {shown[key]}" for key in shown]
    lines.append(f"{'processor':<18} {processor()}")
    lines.append(f"{'python':<18} {platform.python_version()}")
    lines += [f"  {name:<16} {number}" for name, number in libraries.items()]
    for name in PYTHON_LIBRARIES:
        try:
            lines.append(f"  {name:<16} {metadata.version(name)}")
        except metadata.PackageNotFoundError:
            lines.append(f"  {name:<16} absent")
    return lines
