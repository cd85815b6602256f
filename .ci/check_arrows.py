"""Checks C++ includes and Python imports against the table of allowed edges between rooms.

A room is a folder under cpp/include/tissu and cpp/src, or one inside that, and a module or
sub-package of python/tissu.
"""

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# Room -> the rooms whose headers it may include. Its own are always allowed; what is not listed is
# not a room. The order is that of the data: an arrow points only upwards. A room may be inside
# another ("model/fem"), or one pair of files ("model/models"); a name stands for itself alone:
# "model" is the face of the models. Folders kernels and generated belong to the room they are in.
MODEL = {"base", "mesh", "element", "law", "field", "assembly", "state", "force", "cell", "model"}
# What a model alone asks for: plain structs that the block of cells holds one of.
OPTIONS = {
    "model/fem/fem_options",
    "model/corotational/corotational_options",
    "model/edges/edge_options",
    "model/condensed/condensed_options",
    "model/dilatation/mean_dilatation_options",
    "model/frames/frames_options",
    "model/frames/frame_points",
    "model/shell/shell_options",
}
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
    "cell": {"base", "mesh", "element", "law"},
    **{options: {"base"} for options in OPTIONS},
    "model/frames/frames_options": {"model/frames/frame_points"},
    "model/options": {"base"} | OPTIONS,
    "model": MODEL | {"model/options"},
    "model/points": MODEL | {"model/frames/frame_points"},
    "model/fem": MODEL | {"model/points"},
    "model/corotational": MODEL | {"model/points"},
    "model/edges": MODEL | {"model/points", "model/fem"},  # the definite tangent of mass-tensor
    "model/dilatation": MODEL | {"model/points"},
    "model/frames": MODEL | {"model/points", "model/frames/frame_points"},
    "model/shell": MODEL,
    "model/condensed": MODEL | {"model/fem", "solve"},
    "viscosity": MODEL | {"model/edges"},  # dampers beside springs
    "contact": {"base", "mesh", "assembly", "state", "force"},
    "edit/cut": {"base", "mesh"},
    "edit/repair": {"base", "mesh", "edit/cut"},
    "edit": MODEL | {"world", "contact", "edit/cut", "edit/repair", "model/frames/frame_points"},
    "picture": {"base"},
}
CPP["model/models"] = MODEL | {room for room in CPP if room.startswith("model/")}
CPP["world"] = MODEL | {"model/models", "viscosity", "contact"}
CPP["step"] = {"base", "assembly", "solve", "force", "model", "state", "world", "contact"}
CPP["simulation"] = set(CPP)  # sees everything of the core
CPP["haptic"] = {"base"}  # a library of its own, which the core does not see

# Module of python/tissu -> the modules it may import, at the top or inside a function. Imports for
# type checking only are free: they run nothing.
PYTHON: dict[str, set[str]] = {
    "errors": set(),
    "_core": set(),
    "_haptic": set(),
    "counted": set(),
    "pareto": set(),
    "field_names": set(),
    "files": {"errors"},
    "arrays": {"errors"},
    "unit_table": set(),
    "reading": {"arrays", "errors"},
    "units": {"arrays", "errors", "reading", "unit_table"},
    "codegen": {"errors"},
    "formula": {"errors", "codegen"},
    "mesh": {"arrays", "errors", "counted", "files", "units", "_core"},
    "ties": {"errors", "mesh", "_core"},
    "sampling": {"errors", "counted", "mesh", "_core"},
    "scene": {"errors", "counted", "field_names", "reading", "units", "mesh", "_core"},
    "user_law": {"errors", "files", "units", "codegen", "scene", "_core"},
    "yaml_text": {"errors", "files", "scene"},
    "yaml_io": {"errors", "files", "mesh", "reading", "scene", "user_law", "yaml_text"},
    "effects": {"scene"},
    "checkpoint": {"errors", "counted", "files", "_core"},
    "picture": {"errors", "files", "mesh", "_core"},
    # What is run, seen and touched in the browser. A simulation opens its own view.
    "live_view": {"counted", "errors", "files", "mesh", "scene", "picture", "cutting", "trocar"},
    # What cuts, and what a cut leaves: blades, material, reports.
    "cutting": {"_core", "arrays", "counted", "errors", "mesh", "scene", "units"},
    "simulation": {
        "cutting",
        "arrays",
        "errors",
        "counted",
        "field_names",
        "units",
        "mesh",
        "reading",
        "checkpoint",
        "live_view",
        "ties",
        "_core",
    },
    "compile": {
        "errors",
        "counted",
        "mesh",
        "sampling",
        "scene",
        "effects",
        "checkpoint",
        "simulation",
        "ties",
        "_core",
    },
    "front": {"errors", "scene", "yaml_io", "compile"},
    "comparison": {"errors", "counted", "mesh", "reading", "scene", "picture"},
    "accuracy": {"errors", "counted", "pareto", "front", "yaml_io", "picture"},
    "contact_cost": {"errors", "mesh", "scene", "front", "simulation"},
    "advice": {"errors", "counted", "pareto", "reading", "units", "mesh", "scene", "picture"},
    "output": {"errors", "counted", "field_names", "files", "mesh", "_core"},
}
# The active trocar. A scene without one imports none of it.
PYTHON["trocar"] = {"arrays", "counted", "errors", "files", "reading", "scene", "units", "_haptic"}
PYTHON["examples"] = {"errors", "files", "front"}
PYTHON["cli"] = set(PYTHON)
PYTHON["__main__"] = {"cli"}
PYTHON["__init__"] = set(PYTHON)

REFUSED = {"util", "utils", "common", "misc", "helper", "helpers", "manager", "managers"}
NAMED_FOLDERS = ("cpp", "python", "tests", "bench", "examples", "third_party")

TOPS = (ROOT / "cpp/include/tissu", ROOT / "cpp/src")
INCLUDE = re.compile(r'^\s*#\s*include\s+["<]([^">]+)[">]', re.MULTILINE)


def room_of(path: Path) -> str:
    """The room of a file below the folder of all rooms; its own folder where that is not a room."""
    name, folder = path.with_suffix("").as_posix(), path.parent.as_posix()
    inner = folder.removesuffix("/kernels").removesuffix("/generated")
    return max((room for room in CPP if room in (name, inner)), key=len, default=folder)


def cpp_files() -> Iterator[tuple[str, Path]]:
    """Every C++ file of a room with the room's name."""
    for top in TOPS:
        for path in sorted(top.rglob("*")):
            if path.suffix in {".h", ".cpp"}:
                yield room_of(path.relative_to(top)), path


def included_path(path: Path, included: str) -> Path | None:
    """The file of a room that an include points to; None for outside libraries."""
    if included.startswith("tissu/"):
        return Path(included).relative_to("tissu")
    for candidate in (path.parent / included, ROOT / "cpp/src" / included):
        found = candidate.resolve()
        for top in TOPS:
            if found.exists() and found.is_relative_to(top):
                return found.relative_to(top)
    return None


def included_room(path: Path, included: str) -> str | None:
    """The room an include points into; None for outside libraries."""
    found = included_path(path, included)
    return None if found is None else room_of(found)


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


def absent_rooms(table: dict[str, set[str]], present: set[str], name: str) -> Iterator[str]:
    """One sentence for each room of a table that does not exist."""
    for room in sorted({*table, *set().union(*table.values())} - present):
        yield f"the table {name} names '{room}', which is not there; take it out"


def cycles(table: dict[str, set[str]], name: str) -> Iterator[str]:
    """One sentence when the arrows of a table lead round in a circle."""
    left = {room: others & set(table) - {room} for room, others in table.items()}
    while True:
        lowest = {room for room, others in left.items() if not others & set(left)}
        if not lowest:
            break
        left = {room: others for room, others in left.items() if room not in lowest}
    if left:
        way = [min(left)]
        while way[-1] not in way[:-1]:
            way.append(min(left[way[-1]] & set(left)))
        circle = " -> ".join(way[way.index(way[-1]) :])
        yield f"the table {name} has a circle: {circle}; an arrow points one way only"


def check_tables() -> Iterator[str]:
    """One sentence for each fault of the tables themselves."""
    there = {p.relative_to(top).with_suffix("").as_posix() for top in TOPS for p in top.rglob("*")}
    yield from absent_rooms(CPP, there, "CPP")
    modules = {path.name.split(".")[0] for path in (ROOT / "python/tissu").iterdir()}
    yield from absent_rooms(PYTHON, modules, "PYTHON")
    yield from cycles(CPP, "CPP")
    yield from cycles(PYTHON, "PYTHON")


def check_names() -> Iterator[str]:
    """One sentence for each file or folder whose name says nothing."""
    for folder in NAMED_FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if REFUSED & set(re.split(r"[_.\-]", path.name.lower())):
                yield f"{path.relative_to(ROOT)}: name it after what it is about"


def main() -> int:
    """Prints every problem; 1 when there is one."""
    problems = list(dict.fromkeys([*check_tables(), *check_cpp(), *check_python(), *check_names()]))
    print("\n".join(problems) or "arrows: all allowed")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
