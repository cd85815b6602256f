"""Plain sentences for what pydantic found: what was found, and what is accepted."""

from __future__ import annotations

import ast
import inspect
import itertools
import textwrap
from collections.abc import Iterable, Iterator
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
}


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
    if text.startswith("Input should be "):
        return f"found {shown}; accepted: {text.removeprefix('Input should be ')}"
    return f"found {shown}; {text}"


def _meant(found: object, expected: str) -> str:
    """The nearest of the accepted words, as pydantic lists them; nothing when none is near."""
    words = [part for part in expected.split("'") if part.isidentifier() and part != "or"]
    close = nearest_word(found, words) if isinstance(found, str) else None
    return "" if close is None else f"; did you mean '{close}'?"


def meaning(cls: type, name: str) -> str:
    """What the text below a field says of it, after a colon; read only when a message needs it."""
    described = getattr(cls, "model_fields", {}).get(name)
    if described is not None and described.description:
        return f": {described.description}"
    for owner in cls.__mro__:
        if name not in inspect.get_annotations(owner):
            continue
        try:
            body = ast.parse(textwrap.dedent(inspect.getsource(owner))).body[0]
        except (OSError, SyntaxError):  # no source at hand
            return ""
        lines = body.body if isinstance(body, ast.ClassDef) else []
        for field, text in itertools.pairwise(lines):
            named = isinstance(field, ast.AnnAssign) and getattr(field.target, "id", "") == name
            if named and isinstance(text, ast.Expr) and isinstance(text.value, ast.Constant):
                return f": {text.value.value!s}"
    return ""
