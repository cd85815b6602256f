"""What stays unknown of a scene with problems, and how all its problems are found nevertheless.

A part is read field by field. A field that cannot be read leaves its problems behind and is absent
from the part: asking for it raises Unknown. So code that looks at such a part sees what is known,
and stops where nothing can be said, without a word of its own about problems that were reported.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from types import FunctionType
from typing import Any, TypeVar

from tissu.scene.problem import Problem

Check = Callable[[Any], Iterator[Problem]]
C = TypeVar("C", bound=Check)

_FIELDS = "_fields_of_rule"


class Unknown(AttributeError):  # noqa: N818 - not a fault of its own: the fault is reported already
    """A field was asked for that could not be read."""


@dataclass(frozen=True, slots=True)
class Unread:
    """Stands where something could not be read; whatever is asked of it is Unknown."""

    problems: tuple[Problem, ...] = ()

    def __getattr__(self, name: str) -> Any:
        raise Unknown(name)


def rule(*fields: str) -> Callable[[C], C]:
    """A method of a part that yields what is wrong between its fields.

    It is left out when a field it asks for is unknown; when it finds something, the fields it is
    about are unknown from then on.
    """

    def mark(check: C) -> C:
        setattr(check, _FIELDS, fields)
        return check

    return mark


@cache
def rules_of(cls: type) -> dict[str, tuple[Check, tuple[str, ...]]]:
    """The rules of a class by their names, those of its bases first, with their fields."""
    found: dict[str, tuple[Check, tuple[str, ...]]] = {}
    for owner in reversed(cls.__mro__):
        for name, check in vars(owner).items():
            if isinstance(check, FunctionType) and hasattr(check, _FIELDS):
                found[name] = (check, getattr(check, _FIELDS))
    return found


def told(problems: Iterator[Problem]) -> list[Problem]:
    """The problems, as far as they can be known: those found before an Unknown are kept."""
    found: list[Problem] = []
    with contextlib.suppress(Unknown):
        for problem in problems:
            found.append(problem)
    return found


def below(place: str | int, problems: Iterator[Problem]) -> Iterator[Problem]:
    """The problems of what stands at a place, with the place before their paths."""
    for problem in problems:
        yield Problem((place, *problem.path), problem.text)


def nested(value: object) -> Iterator[tuple[str | int, object]]:
    """What a mapping or list holds, with its place."""
    if isinstance(value, Mapping):
        yield from ((str(name), item) for name, item in value.items())
    elif isinstance(value, (list, tuple)):
        yield from enumerate(value)
