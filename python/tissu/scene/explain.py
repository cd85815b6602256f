"""Plain sentences for what pydantic found: what was found, and what is accepted."""

from __future__ import annotations

import ast
import functools
import inspect
import itertools
import textwrap
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails, InitErrorDetails, PydanticCustomError

from tissu.reading import written
from tissu.scene.problem import Problem, nearest_word

_EXPLAINED = "tissu"  # mark of an error whose text is already a plain sentence

_BOUNDS = {
    "greater_than": "more than {gt:g}",
    "greater_than_equal": "at least {ge:g}",
    "less_than": "less than {lt:g}",
    "less_than_equal": "at most {le:g}",
}

_ACCEPTED = {
    "finite_number": "a finite number",
    "int_parsing_size": "a smaller whole number",
    "path_type": "the path of a file",
    "string_type": "a text",
}

_CELLS = {
    **dict.fromkeys(("tetrahedron", "tetrahedra", "tet", "tet4", "c3d4"), "tetra"),
    **dict.fromkeys(("tetrahedron10", "tet10", "c3d10"), "tetra10"),
    **dict.fromkeys(("hex", "hexa", "hex8", "brick", "c3d8"), "hexahedron"),
    **dict.fromkeys(("hex20", "c3d20"), "hexahedron20"),
    "hex27": "hexahedron27",
    **dict.fromkeys(("prism", "penta", "penta6", "c3d6"), "wedge"),
    **dict.fromkeys(("penta15", "c3d15"), "wedge15"),
    **dict.fromkeys(("tri", "tri3"), "triangle"),
    "tri6": "triangle6",
    **dict.fromkeys(("quadrilateral", "quad4"), "quad"),
    **dict.fromkeys(("edge", "beam", "segment"), "line"),
}
"""Other programs' names of cells, and those of tissu."""


def explained(error: ValidationError, raw: object) -> Iterator[Problem]:
    """The problems of a field.

    Args:
        error: what the field's validation raised.
        raw: the field as it was written, before its unit was read.
    """
    for details in error.errors(include_url=False):
        path = tuple(details["loc"])
        yield Problem(path, _sentence(details, details["input"] if path else raw))


def failure(problems: Iterable[Problem], title: str) -> ValidationError:
    """A validation error with these problems."""
    return ValidationError.from_exception_data(
        title,
        [
            InitErrorDetails(
                type=PydanticCustomError(_EXPLAINED, "{text}", {"text": problem.text}),
                loc=problem.path,
                input=None,
            )
            for problem in problems
        ],
    )


def _sentence(details: ErrorDetails, found: object) -> str:
    kind, text = details["type"], details["msg"]
    context: dict[str, Any] = details.get("ctx", {})
    shown = written(found)
    if kind == _EXPLAINED:
        return text
    if kind == "value_error":
        return str(context["error"]) if "error" in context else text
    if kind in _BOUNDS:
        return f"found {shown}; {_BOUNDS[kind].format(**context)} is accepted"
    if kind == "literal_error":
        return f"found {shown}; accepted: {context['expected']}{_meant(found, context['expected'])}"
    if kind == "too_short":
        return f"found {shown}; at least {context['min_length']} entry is accepted"
    if kind == "dict_type":
        return f"found {shown}; a mapping is accepted"
    if kind in ("tuple_type", "list_type"):
        return f"found {shown}; a list is accepted{_as_a_list(found)}"
    if kind == "missing":
        return f"found {shown}, which has too few entries; one more is accepted"
    accepted = _accepted(kind, context) or text.removeprefix("Input should be ")
    return f"found {shown}; {accepted} is accepted"


def _accepted(kind: str, context: Mapping[str, Any]) -> str:
    """What a kind of field accepts, in words; empty: nothing is known of that kind."""
    if kind in _ACCEPTED:
        return _ACCEPTED[kind]
    words = {"int": "a whole number", "float": "a number", "bool": "true or false"}
    words |= {"string": "a text", "path": "the path of a file", "too": "a list of fewer entries"}
    if "max_length" in context:
        return f"at most {context['max_length']}"
    return words.get(kind.split("_")[0], "")


def _as_a_list(found: object) -> str:
    """How a single part becomes a list of one."""
    if isinstance(found, Mapping):
        return ": write a dash before its keys, or brackets around it, as in [{...}]"
    return "" if found is None else f", such as [{written(found)}]"


def _meant(found: object, expected: str) -> str:
    """The nearest of the accepted words, as pydantic lists them; nothing when none is near."""
    words = [part for part in expected.split("'") if part.isidentifier() and part != "or"]
    if not isinstance(found, str):
        return ""
    close = _CELLS.get(found.lower())
    close = close if close in words else nearest_word(found, words)
    return "" if close is None else f"; did you mean '{close}'?"


def meaning(cls: type, name: str) -> str:
    """What the text below a field says of it, after a colon."""
    text = described(cls, name)
    return f": {text}" if text else ""


def described(cls: type, name: str) -> str:
    """The text below a field of a class or of its nearest base that has one; else empty.

    It is read from the source where it is asked for: pydantic would read all sources at each
    import, which takes nearly half of the time of that.
    """
    info = getattr(cls, "model_fields", {}).get(name)
    if info is not None and info.description:
        return str(info.description)
    return next((texts[name] for owner in cls.__mro__ if name in (texts := _texts(owner))), "")


@functools.cache
def _texts(owner: type) -> Mapping[str, str]:
    """The texts below the fields that a class itself has."""
    if not inspect.get_annotations(owner):
        return {}
    try:
        body = ast.parse(textwrap.dedent(inspect.getsource(owner))).body[0]
    except (OSError, TypeError, SyntaxError):  # no source at hand
        return {}
    lines = body.body if isinstance(body, ast.ClassDef) else []
    return {
        field.target.id: inspect.cleandoc(text.value.value)
        for field, text in itertools.pairwise(lines)
        if isinstance(field, ast.AnnAssign)
        and isinstance(field.target, ast.Name)
        and isinstance(text, ast.Expr)
        and isinstance(text.value, ast.Constant)
        and isinstance(text.value.value, str)
    }
