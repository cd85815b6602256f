"""Every public name, once, and the files that are made from the list.

`python -m tissu.codegen.names --update` writes tissu/__init__.py and its stub and
tissu/scene/__init__.py; docs/make_scene.py prints the fields of the parts below the same headings.
The parts of a scene are named by the `__all__` of their modules, everything else here.
"""

from __future__ import annotations

import argparse
import ast
import sys
from collections.abc import Sequence
from pathlib import Path

TISSU = Path(__file__).resolve().parents[1]

NAMES: dict[str, tuple[str, ...]] = {
    "errors": (
        "TissuError",
        "MeshError",
        "ParameterError",
        "LawError",
        "SceneError",
        "BusyError",
        "CheckpointError",
        "Diverged",
    ),
    "front": ("Scene",),
    "mesh": (
        "Mesh",
        "CellBlock",
        "Surface",
        "QualityReport",
        "read_mesh",
        "write_mesh",
        "bar_mesh",
        "into_quadratic",
        "into_tetrahedra",
        "mixed_bar_mesh",
        "refined",
    ),
    "user_law": ("law", "read_law"),
    "field_names": ("FIELD_NAMES",),
    "simulation": (
        "Compliance",
        "Contacts",
        "Crossing",
        "IntegrationPoints",
        "Mark",
        "Overlap",
        "Plan",
        "Profile",
        "Simulation",
        "StepReport",
        "Tool",
        "Wrench",
    ),
    "cutting": (
        "Capsule",
        "CutReport",
        "Disc",
        "Material",
        "MaterialSurface",
        "Piece",
        "Quality",
        "Repairs",
        "Sweep",
        "Triangles",
    ),
    "comparison": ("Comparison", "compare"),
    "advice": ("Advice", "advise"),
    "picture": ("draw", "draw_overlay"),
    "output": ("Series",),
    "live_view": ("View", "view"),
}
"""Room -> its public names, beside those of the parts of a scene."""
MODULES = ("examples", "formula", "sampling")
"""Public modules."""
HEADINGS: dict[str, tuple[str, ...]] = {
    "The scene": ("scene",),
    "Bodies and meshes": ("body", "section", "start", "bar"),
    "Connective tissue": ("tissue",),
    "Laws and viscosity": ("generated.laws", "law", "viscosity"),
    "Models": ("model",),
    "Selections: which nodes": ("selection",),
    "Supports and motion": ("support",),
    "Loads": ("load",),
    "Obstacles and contacts": ("motion", "obstacle", "convex_obstacle", "contact"),
    "Trocars": (
        "trocar.trocar",
        "trocar.port",
        "trocar.device",
        "trocar.hand",
        "trocar.changes",
        "trocar.limits",
        "trocar.compensation",
        "trocar.mechanism",
    ),
    "Editing and instruments": ("editing", "instrument", "tear"),
    "Steps": ("step",),
    "Linear solvers": ("solver",),
}
"""Heading of docs/reference/scene.md -> the modules of tissu.scene whose parts stand below it."""


def part_names(module: str, root: Path = TISSU) -> list[str]:
    """The `__all__` of a module of tissu.scene, read without importing it."""
    path = root / "scene" / f"{module.replace('.', '/')}.py"
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
            return [str(name) for name in ast.literal_eval(node.value)]
    return []


def scene_names(root: Path = TISSU) -> dict[str, list[str]]:
    """Module of tissu.scene -> its public names."""
    modules = [module for some in HEADINGS.values() for module in some]
    return {module: part_names(module, root) for module in modules}


def homes(root: Path = TISSU) -> dict[str, list[str]]:
    """Room -> all its public names."""
    parts = [name for names in scene_names(root).values() for name in names]
    return {**{room: list(names) for room, names in NAMES.items()}, "scene": parts}


_MADE = "Made from the list in tissu/codegen/names.py by `make codegen`; never edited."

_PACKAGE = '''\
"""tissu: real-time soft tissue for surgery.

A scene goes in, a deforming organ comes out:

    import tissu as ts

    scene = ts.Scene.from_yaml("organ.yaml")
    simulation = scene.compile()
    for report in simulation.run():
        print(report)

Everything is in SI units and float64; arrays are (n, 3); nodes of cells are in VTK's order.

{made}
"""

from __future__ import annotations

import importlib
from typing import Any

_HOMES = {{
{homes}}}
_MODULES = ({modules})
_HOME_OF = {{name: home for home, names in _HOMES.items() for name in names}}

__all__ = sorted([*_HOME_OF, *_MODULES, "__version__"])


def __getattr__(name: str) -> Any:
    """Load a name from its room when it is first asked for, so that the import stays short."""
    if name == "__version__":
        from tissu import _core

        return _core.build_info()["version"]
    if name == "_core":
        return _load_core()
    if name in _MODULES:
        return importlib.import_module(f"tissu.{{name}}")
    home = _HOME_OF.get(name)
    if home is None:
        raise AttributeError(f"module 'tissu' has no attribute '{{name}}'")
    value = getattr(importlib.import_module(home), name)
    globals()[name] = value
    return value


def _load_core() -> Any:
    """The compiled core.

    Raises:
        ImportError: a library that it needs is missing, or it was made for another Python.
    """
    try:
        return importlib.import_module("tissu._core")
    except ModuleNotFoundError:
        raise ImportError(
            "the compiled core of tissu is missing for this Python; install tissu with it: "
            "python -m pip install tissu"
        ) from None
    except ImportError as error:
        raise ImportError(
            f"the compiled core of tissu cannot be loaded: {{error}}; install the library that it "
            "names (Debian: sudo apt install libcholmod3 for libcholmod), or build tissu again"
        ) from error


def __dir__() -> list[str]:
    return __all__
'''


def package(root: Path = TISSU) -> str:
    """tissu/__init__.py."""
    rows = [
        f'    "tissu.{room}": (\n' + "".join(f'        "{name}",\n' for name in names) + "    ),\n"
        for room, names in homes(root).items()
    ]
    modules = ", ".join(f'"{module}"' for module in MODULES)
    return _PACKAGE.format(made=_MADE, homes="".join(rows), modules=modules)


def stub(root: Path = TISSU) -> str:
    """tissu/__init__.pyi."""
    lines = ['"""Types of the names that the package loads when they are asked for.', "", _MADE]
    lines += ['"""', ""]
    lines += [f"from tissu import {module} as {module}" for module in MODULES]
    for room, names in homes(root).items():
        lines += [f"from tissu.{room} import {name} as {name}" for name in names]
    return "\n".join([*lines, "", "__version__: str", ""])


def scene_package(root: Path = TISSU) -> str:
    """tissu/scene/__init__.py."""
    lines = ['"""The parts of a scene, as frozen and validated data.', "", _MADE, '"""', ""]
    for module, names in scene_names(root).items():
        lines += [f"from tissu.scene.{module} import ("]
        lines += [*(f"    {name}," for name in names), ")"]
    listed = [f'    "{name}",' for names in scene_names(root).values() for name in names]
    return "\n".join([*lines, "", "__all__ = [", *listed, "]", ""])


def made_files(root: Path = TISSU) -> dict[Path, str]:
    """Every file with its text."""
    return {
        root / "__init__.py": package(root),
        root / "__init__.pyi": stub(root),
        root / "scene" / "__init__.py": scene_package(root),
    }


def main(arguments: Sequence[str] | None = None) -> int:
    """0, or 1 where a file is not what the list gives."""
    parser = argparse.ArgumentParser(prog="python -m tissu.codegen.names", description=__doc__)
    job = parser.add_mutually_exclusive_group(required=True)
    job.add_argument("--check", action="store_true", help="1 when a file is not what it gives")
    job.add_argument("--update", action="store_true", help="write the files")
    given = parser.parse_args(arguments)
    stale = [p for p, text in made_files().items() if p.read_text(encoding="utf-8") != text]
    for path in stale:
        shown = path.relative_to(TISSU.parent)
        if given.update:
            path.write_text(made_files()[path], encoding="utf-8")
            print(f"wrote {shown}")
        else:
            print(f"{shown} is not what tissu/codegen/names.py gives; run: make codegen")
    return 1 if stale and given.check else 0


if __name__ == "__main__":
    sys.exit(main())
