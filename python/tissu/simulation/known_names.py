"""Handles refuse attributes that they do not have: a misspelt one would be set without effect."""

from __future__ import annotations

from difflib import get_close_matches
from typing import TypeVar

from tissu.errors import ParameterError

T = TypeVar("T")


class UnknownAttributeError(ParameterError, AttributeError):
    """An attribute that a handle does not have; an `AttributeError` too, as Python has it."""


def known_names_only(cls: type[T]) -> type[T]:
    """The class, whose objects refuse public attributes that are not its own or are read-only."""
    annotated = {name for base in cls.__mro__ for name in getattr(base, "__annotations__", {})}
    settable = sorted(
        name
        for name in dir(cls)
        if isinstance(getattr(cls, name), property) and getattr(cls, name).fset is not None
    )

    read_only = {
        name
        for name in dir(cls)
        if isinstance(getattr(cls, name), property) and name not in settable
    }
    accepted = ", ".join(settable) or "none, it has methods only"

    def set_known(self: T, name: str, value: object) -> None:
        if not name.startswith("_") and name not in annotated and not hasattr(cls, name):
            near = get_close_matches(name, settable, 1)
            meant = f"; did you mean '{near[0]}'?" if near else ";"
            raise UnknownAttributeError(
                f"found the attribute '{name}' of a {cls.__name__}{meant} accepted: {accepted}"
            )
        if name in read_only:
            text = f"found a value for '{name}' of a {cls.__name__}, which is read-only"
            raise UnknownAttributeError(f"{text}; what may be set: {accepted}")
        object.__setattr__(self, name, value)

    cls.__setattr__ = set_known  # type: ignore[assignment,method-assign]
    return cls
