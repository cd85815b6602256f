"""What `tissu info` says."""

from __future__ import annotations

import platform
from collections.abc import Mapping
from importlib import metadata
from typing import Any

PYTHON_LIBRARIES = ("numpy", "pydantic", "meshio", "matplotlib", "typer", "rich", "pint", "PyYAML")


# Date of a specification, which compilers tell -> its version (openmp.org, Specifications).
OPENMP = {
    "200505": "2.5",
    "200805": "3.0",
    "201107": "3.1",
    "201307": "4.0",
    "201511": "4.5",
    "201811": "5.0",
    "202011": "5.1",
    "202111": "5.2",
    "202411": "6.0",
}


def openmp_version(date: str) -> str:
    """The version of OpenMP that a compiler's date stands for; an unknown date as it is."""
    return OPENMP.get(date, date)


def info_text() -> str:
    """Version, threads, instruction set in use, linked libraries, as lines."""
    from tissu import _core

    return "\n".join(info_lines(_core.build_info()))


def machine_line() -> str:
    """What times were measured on, in one sentence."""
    from tissu import _core

    build = _core.build_info()
    return (
        f"tissu {build['version']}, {build['compiler']}, {build['instruction_set']} kernels, "
        f"{build['threads_available']} threads available, {platform.machine()}."
    )


def info_lines(build: Mapping[str, Any]) -> list[str]:
    """The lines, from what the core says of itself."""
    shown = dict(build)
    libraries = dict(shown.pop("libraries", {}))
    if "OpenMP" in libraries:
        libraries["OpenMP"] = openmp_version(str(libraries["OpenMP"]))
    lines = [f"{'tissu':<18} {shown.pop('version', '?')}"]
    names = {"threads_available": "threads", "instruction_set": "instruction set"}
    lines += [f"{names.get(key, key.replace('_', ' ')):<18} {shown[key]}" for key in shown]
    lines.append(f"{'python':<18} {platform.python_version()}")
    lines += [f"  {name:<16} {number}" for name, number in libraries.items()]
    for name in PYTHON_LIBRARIES:
        try:
            lines.append(f"  {name:<16} {metadata.version(name)}")
        except metadata.PackageNotFoundError:
            lines.append(f"  {name:<16} absent")
    return lines
