"""Checks C++ includes and Python imports against the table of allowed edges between rooms.

A room is a folder under cpp/include/tissu and cpp/src, and a module or sub-package of python/tissu.
"""

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# Room -> the rooms whose headers it may include. Its own are always allowed; what is not listed is
# not a room. The order is that of the data: an arrow points only upwards.
CPP: dict[str, set[str]] = {
    "base": set(),
    "element": {"base"},
    "mesh": {"base", "element"},
    "law": {"base"},
    "field": {"base", "element"},
    "state": {"base"},
    "assembly": {"base", "mesh", "state"},
    "solve": {"base", "assembly"},
    "force": {"base", "mesh", "element", "law", "assembly", "state"},
    "model": {"base", "mesh", "element", "law", "field", "assembly", "state", "solve", "force"},
    "viscosity": {"base", "mesh", "element", "law", "assembly", "state", "force", "model"},
    "world": {"base", "mesh", "element", "law", "force", "model", "viscosity", "assembly", "state"},
    "step": {"base", "assembly", "solve", "force", "model", "state", "world"},
    "edit": {"base", "mesh", "element", "law", "force", "model", "assembly", "state", "world"},
    "io": {"base", "mesh"},
    "picture": {"base"},
}
CPP["simulation"] = set(CPP)  # sees everything

# Module of python/tissu -> the modules it may import, at the top or inside a function. Imports for
# type checking only are free: they run nothing.
PYTHON: dict[str, set[str]] = {
    "errors": set(),
    "_core": set(),
    "counted": set(),
    "pareto": set(),
    "units": {"errors"},
    "codegen": {"errors"},
    "formula": {"errors", "codegen"},
    "mesh": {"errors", "counted", "units", "_core"},
    "sampling": {"errors", "counted", "mesh", "_core"},
    "yaml_io": {"errors", "units", "mesh", "scene", "user_law"},
    "selection": {"errors", "units", "mesh"},
    "scene": {"errors", "counted", "units", "mesh", "yaml_io", "selection", "compile"},
    "user_law": {"errors", "units", "codegen", "scene", "_core"},
    "effects": {"errors", "mesh", "scene"},
    "checkpoint": {"errors", "counted", "_core"},
    "simulation": {"errors", "counted", "units", "mesh", "effects", "checkpoint", "_core"},
    "compile": {
        "errors",
        "counted",
        "units",
        "mesh",
        "sampling",
        "selection",
        "scene",
        "effects",
        "checkpoint",
        "simulation",
        "_core",
    },
    "comparison": {"errors", "counted", "mesh", "scene", "simulation", "picture"},
    "accuracy": {"errors", "pareto", "scene", "yaml_io", "simulation", "picture"},
    "advice": {
        "errors",
        "counted",
        "pareto",
        "units",
        "mesh",
        "scene",
        "simulation",
        "picture",
    },
    "picture": {"errors", "mesh", "_core"},
    "output": {"errors", "counted", "mesh", "simulation", "picture", "_core"},
}
PYTHON["cli"] = set(PYTHON)
PYTHON["__init__"] = set(PYTHON)

REFUSED = {"util", "utils", "common", "misc", "helper", "helpers", "manager", "managers"}
NAMED_FOLDERS = ("cpp", "python", "tests", "bench", "examples", "third_party")

INCLUDE = re.compile(r'^\s*#\s*include\s+["<]([^">]+)[">]', re.MULTILINE)


def cpp_files() -> Iterator[tuple[str, Path]]:
    """Every C++ file of a room with the room's name."""
    for top in (ROOT / "cpp/include/tissu", ROOT / "cpp/src"):
        for path in sorted(top.rglob("*")):
            if path.suffix in {".h", ".cpp"}:
                parts = path.relative_to(top).parts
                yield (parts[0] if len(parts) > 1 else ""), path


def included_room(path: Path, included: str) -> str | None:
    """The room an include points into; None for outside libraries."""
    if included.startswith("tissu/"):
        return included.split("/")[1]
    target = (path.parent / included).resolve()
    for top in (ROOT / "cpp/include/tissu", ROOT / "cpp/src"):
        if target.is_relative_to(top) and target.exists():
            return target.relative_to(top).parts[0]
    first = included.split("/")[0]
    return first if "/" in included and (ROOT / "cpp/src" / included).exists() else None


def check_cpp() -> Iterator[str]:
    """One sentence for each C++ include that the table does not allow."""
    for room, path in cpp_files():
        shown = path.relative_to(ROOT)
        if room not in CPP:
            yield f"{shown}: '{room}' is not a room; rooms: {', '.join(CPP)}"
            continue
        text = path.read_text(encoding="utf-8")
        for match in INCLUDE.finditer(text):
            other = included_room(path, match[1])
            if other is not None and other != room and other not in CPP[room]:
                line = text.count("\n", 0, match.start(1)) + 1
                allowed = sorted(CPP[room])
                yield f"{shown}:{line}: {room} includes {match[1]}; allowed: {allowed}"


def type_checking_lines(tree: ast.Module) -> set[int]:
    """The lines inside `if TYPE_CHECKING:`."""
    lines: set[int] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.If) and ast.unparse(node.test).endswith("TYPE_CHECKING"):
            for inner in node.body:
                lines.update(range(inner.lineno, (inner.end_lineno or inner.lineno) + 1))
    return lines


def imported_modules(node: ast.stmt, package: list[str]) -> list[str]:
    """Full dotted names that an import statement inside `package` asks for."""
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    if not isinstance(node, ast.ImportFrom):
        return []
    base = package[: len(package) - node.level + 1] if node.level else []
    prefix = ".".join([*base, *([node.module] if node.module else [])])
    return [f"{prefix}.{alias.name}" for alias in node.names]


def check_python() -> Iterator[str]:
    """One sentence for each Python import that the table does not allow."""
    top = ROOT / "python/tissu"
    for path in sorted(top.rglob("*.py")):
        parts = path.relative_to(top).with_suffix("").parts
        module, shown = parts[0], path.relative_to(ROOT)
        if module not in PYTHON:
            yield f"{shown}: module '{module}' is not in the table of {Path(__file__).name}"
            continue
        tree = ast.parse(path.read_text(encoding="utf-8"))
        free = type_checking_lines(tree)
        for node in ast.walk(tree):
            if not isinstance(node, (ast.Import, ast.ImportFrom)) or node.lineno in free:
                continue
            for name in imported_modules(node, ["tissu", *parts[:-1]]):
                other = name.split(".")[1] if name.startswith("tissu.") else ""
                if other in PYTHON and other not in PYTHON[module] | {module}:
                    allowed = sorted(PYTHON[module])
                    yield f"{shown}:{node.lineno}: {module} imports {other}; allowed: {allowed}"


def check_names() -> Iterator[str]:
    """One sentence for each file or folder whose name says nothing."""
    for folder in NAMED_FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if REFUSED & set(re.split(r"[_.\-]", path.name.lower())):
                yield f"{path.relative_to(ROOT)}: name it after what it is about"


def main() -> int:
    """Prints every problem; 1 when there is one."""
    problems = list(dict.fromkeys([*check_cpp(), *check_python(), *check_names()]))
    print("\n".join(problems) or "arrows: all allowed")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
