"""The pages of the Python API have every class that a public call returns."""

from __future__ import annotations

import ast
import functools
import importlib
import inspect
import re
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

API = Path(__file__).parents[2] / "docs" / "reference" / "api"
BLOCK = re.compile(r"^::: (tissu[\w.]*)$", re.MULTILINE)
IMPORT = re.compile(r"^from (tissu\.[\w.]+) import (.+)$", re.MULTILINE)
NOT_SHOWN = ("tissu.reading", "tissu._core", "tissu._haptic")
"""The types of fields, which say how a field may be written, and the compiled modules."""


def shown() -> dict[str, Any]:
    """Every object that a page of the API names."""
    text = "\n".join(path.read_text(encoding="utf-8") for path in sorted(API.glob("*.md")))
    return {name: found(name) for name in BLOCK.findall(text)}


def found(name: str) -> Any:
    """A module, or an object of a module, by its dotted name."""
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError:
        module, _, attribute = name.rpartition(".")
        return getattr(importlib.import_module(module), attribute)


@functools.cache
def imports(module: str) -> dict[str, tuple[str, str]]:
    """Names that a module of tissu imports, for its types too -> their module and name there."""
    tree = ast.parse(inspect.getsource(sys.modules[module]))
    return {
        alias.asname or alias.name: (node.module, alias.name)
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and node.module and node.module.startswith("tissu")
        for alias in node.names
    }


def named(word: str, module: str) -> Any:
    """What a word of an annotation means in its module."""
    if word in vars(sys.modules[module]):
        return vars(sys.modules[module])[word]
    if word not in imports(module):
        return None
    home, name = imports(module)[word]
    return getattr(importlib.import_module(home), name, None)


def classes_of(annotation: str, module: str) -> set[type]:
    """Classes of tissu's Python that an annotation names."""
    words = {node.id for node in ast.walk(ast.parse(annotation)) if isinstance(node, ast.Name)}
    objects = {named(word, module) for word in words}
    return {one for one in objects if inspect.isclass(one) and _is_ours(one)}


def _is_ours(kind: type) -> bool:
    """Whether a class is tissu's, and neither compiled nor one of the types of fields."""
    return kind.__module__.startswith("tissu.") and kind.__module__ not in NOT_SHOWN


def returned_by(function: Any) -> set[type]:
    """Classes that a function returns."""
    function = inspect.unwrap(function)
    annotation = getattr(function, "__annotations__", {}).get("return")
    return classes_of(annotation, function.__module__) if isinstance(annotation, str) else set()


def functions_of(kind: type) -> list[Any]:
    """Public methods, and properties by their getters; `with` enters by a method too."""
    made = []
    for name in dir(kind):
        value = inspect.getattr_static(kind, name)
        value = getattr(value, "fget", None) or getattr(value, "func", value)
        value = getattr(value, "__func__", value)
        if inspect.isfunction(value) and (not name.startswith("_") or name == "__enter__"):
            made.append(value)
    return made


def fields_of(kind: type) -> set[type]:
    """Classes of the public fields of a class."""
    found = set()
    for base in kind.__mro__:
        notes = vars(base).get("__annotations__", {}) if "tissu" in base.__module__ else {}
        for name, annotation in notes.items():
            if isinstance(annotation, str) and not name.startswith("_"):
                found |= classes_of(annotation, base.__module__)
    return found


def given_by(thing: Any) -> dict[type, str]:
    """Classes that a function, a class or a module gives -> where."""
    if isinstance(thing, ModuleType):
        members = [getattr(thing, name) for name in getattr(thing, "__all__", ())]
        return {kind: where for member in members for kind, where in given_by(member).items()}
    if inspect.isfunction(thing):
        return dict.fromkeys(returned_by(thing), thing.__name__)
    if not inspect.isclass(thing):
        return {}
    given = dict.fromkeys(fields_of(thing), f"a field of {thing.__name__}")
    for function in functions_of(thing):
        given |= dict.fromkeys(returned_by(function), f"{thing.__name__}.{function.__name__}")
    return given


def members(thing: Any) -> list[Any]:
    """What a block of a page shows: the object, or all public names of a module."""
    if isinstance(thing, ModuleType):
        return [getattr(thing, name) for name in getattr(thing, "__all__", ())]
    return [thing]


def imported() -> dict[str, str]:
    """Classes that pages import from modules of tissu -> the page."""
    found_there = {}
    for page in sorted(API.parents[1].rglob("*.md")):
        for module, names in IMPORT.findall(page.read_text(encoding="utf-8")):
            for name in names.split(", "):
                if inspect.isclass(found(f"{module}.{name}")):
                    found_there[f"{module}.{name}"] = page.name
    return found_there


def missing() -> dict[str, str]:
    """Classes that a public call gives, and no page shows -> the call."""
    things = shown()
    classes = {id(one) for thing in things.values() for one in members(thing)}
    return {
        f"{kind.__module__}.{kind.__qualname__}": where
        for thing in things.values()
        for kind, where in given_by(thing).items()
        if id(kind) not in classes and not kind.__name__.startswith("_")
    }


def test_every_class_that_a_public_call_returns_is_on_a_page() -> None:
    assert not missing()


def test_every_class_that_a_page_imports_is_on_a_page() -> None:
    classes = {id(one) for thing in shown().values() for one in members(thing)}
    for name, page in imported().items():
        assert id(found(name)) in classes, f"{page} imports {name}"


def test_the_walk_sees_methods_properties_and_fields() -> None:
    given = {kind.__name__ for kind in given_by(found("tissu.Simulation"))}
    assert {"Grab", "BodySurface", "Tool", "StepReport"} <= given  # by methods and properties
    assert "Goal" in {kind.__name__ for kind in given_by(found("tissu.Advice"))}  # in a field
