"""Base of every part of a scene: frozen, no unknown keys, and errors in plain sentences."""

from __future__ import annotations

import ast
import inspect
import itertools
import reprlib
import textwrap
from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar

from pydantic import (
    BaseModel,
    ConfigDict,
    PlainValidator,
    ValidationError,
    ValidationInfo,
    model_validator,
)
from pydantic_core import ErrorDetails, InitErrorDetails, PydanticCustomError
from typing_extensions import Self

from tissu.errors import ParameterError, SceneError
from tissu.scene.problem import Path, Problem, nearest, one_of_words

_EXPLAINED = "tissu"  # mark of an error whose text is already a plain sentence


class Part(BaseModel):
    """A frozen, validated part of a scene.

    Attributes:
        positional: names of the fields that may be given without a keyword, in order.
    """

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        arbitrary_types_allowed=True,
        protected_namespaces=(),
        defer_build=True,
        use_attribute_docstrings=True,
    )
    positional: ClassVar[tuple[str, ...]] = ()

    def __init__(self, *values: Any, **fields: Any) -> None:
        """Make the part from its fields.

        Raises:
            SceneError: one or more fields are not accepted; all of them are listed.
        """
        names = type(self).positional
        if len(values) > len(names):
            raise TypeError(
                f"{type(self).__name__} takes {len(names)} positional fields, {len(values)} given"
            )
        for name, value in zip(names, values, strict=False):
            if name in fields:
                raise TypeError(f"{type(self).__name__} got {name} twice")
            fields[name] = value
        try:
            super().__init__(**fields)
        except ValidationError as error:
            name = type(self).__name__
            raise SceneError(
                [f"{name}: {problem.sentence()}" for problem in problems_of(error)]
            ) from None

    # Tells pydantic that a nested part need not be made through this __init__, so that the
    # problems of all parts are gathered in one ValidationError.
    __init__.__pydantic_base_init__ = True  # type: ignore[attr-defined]

    @model_validator(mode="wrap")
    @classmethod
    def _explain(cls, value: Any, handler: Callable[[Any], Self]) -> Self:
        try:
            return handler(value)
        except ValidationError as error:
            raise explained(error, cls, value) from None

    def replace(self, **changes: Any) -> Self:
        """The same part with some fields changed, validated again."""
        fields = {name: getattr(self, name) for name in self.model_fields_set}
        return type(self)(**{**fields, **changes})


def problems_of(error: ValidationError) -> list[Problem]:
    """The problems that a validation found."""
    return [Problem(tuple(e["loc"]), _text(e)) for e in error.errors(include_url=False)]


def failure(problems: Sequence[tuple[Path, str]], title: str) -> ValidationError:
    """A validation error with these places and sentences."""
    return ValidationError.from_exception_data(
        title, [_line(path, text) for path, text in problems]
    )


def explained(error: ValidationError, cls: type[Part], value: object) -> ValidationError:
    """The same errors, each a plain sentence that knows the class and what was found."""
    lines = []
    for details in error.errors(include_url=False):
        text = (
            _text(details) if details["type"] == _EXPLAINED else _explanation(details, cls, value)
        )
        lines.append(_line(tuple(details["loc"]), text))
    return ValidationError.from_exception_data(cls.__name__, lines)


def _line(path: Path, text: str) -> InitErrorDetails:
    return InitErrorDetails(
        type=PydanticCustomError(_EXPLAINED, "{text}", {"text": text}), loc=path, input=None
    )


def _text(details: ErrorDetails) -> str:
    if details["type"] == "value_error" and "error" in details.get("ctx", {}):
        return str(details["ctx"]["error"])
    return details["msg"]


_BOUNDS = {
    "greater_than": "more than {gt:g}",
    "greater_than_equal": "at least {ge:g}",
    "less_than": "less than {lt:g}",
}


def _explanation(details: ErrorDetails, cls: type[Part], value: object) -> str:
    kind, path = details["type"], details["loc"]
    context: dict[str, Any] = details.get("ctx", {})
    found = details["input"]
    if len(path) == 1 and isinstance(value, Mapping):
        found = value.get(path[0], found)  # as written, before its unit was read
    shown = reprlib.repr(found)
    if kind == "value_error":
        return _text(details)
    if kind == "extra_forbidden":
        known = list(cls.model_fields)
        return f"unknown key{nearest(path[-1], known)} Accepted: {one_of_words(known)}"
    if kind == "missing":
        return f"is missing{_meaning(cls, path[-1])}"
    if kind in _BOUNDS:
        return f"found {shown}; {_BOUNDS[kind].format(**context)} is accepted"
    if kind == "literal_error":
        return f"found {shown}; accepted: {context['expected']}"
    if kind == "too_short":
        return f"found {shown}; at least {context['min_length']} entry is accepted"
    if kind in {"model_type", "model_attributes_type", "dict_type"}:
        return (
            f"found {shown}; a mapping is accepted, with the keys {one_of_words(cls.model_fields)}"
        )
    if kind == "none_required" or details["msg"].startswith("Input should be "):
        return f"found {shown}; accepted: {details['msg'].removeprefix('Input should be ')}"
    return f"found {shown}; {details['msg']}"


def _meaning(cls: type[Part], name: str | int) -> str:
    """What the text below a field says of it; read only when a message needs it."""
    described = cls.model_fields.get(str(name))
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


def one_of(*classes: type[Part]) -> PlainValidator:
    """A field that holds one of several parts: in Python by class, in YAML by its `type`."""

    def choose(value: Any, info: ValidationInfo) -> Any:
        return chosen(value, classes, info)

    return PlainValidator(choose)


def chosen(value: Any, classes: Sequence[type[Part]], info: ValidationInfo) -> Any:
    """The part that `value` is, or that its `type` names.

    Raises:
        ParameterError: not a part of these classes, or an unknown `type`.
    """
    if isinstance(value, tuple(classes)):
        return value
    known = {str(cls.model_fields["type"].default): cls for cls in classes}
    accepted = f"accepted types: {one_of_words(known)}"
    if not isinstance(value, Mapping):
        raise ParameterError(
            f"found {reprlib.repr(value)}; a mapping with a `type` is accepted; {accepted}"
        )
    if "type" not in value:
        raise ParameterError(f"`type` is missing; {accepted}")
    cls = known.get(str(value["type"]))
    if cls is None:
        raise ParameterError(
            f"unknown type {value['type']!r}{nearest(value['type'], known)} {accepted.capitalize()}"
        )
    return cls.model_validate(value, context=info.context)
