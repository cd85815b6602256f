"""Tools of a trocar: which of them a tag stands for."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated

from pydantic import BeforeValidator

from tissu.errors import ParameterError
from tissu.reading import Read, written

__all__: list[str] = []

_LARGEST_TAG = 2**64 - 1


def tag_of(value: object) -> int:
    """A tag that is written as a number or a text such as "0x51A0".

    Raises:
        ParameterError: not a whole number of 1 to 2^64 - 1.
    """
    number = value
    if isinstance(value, str):
        try:
            number = int(value, 16) if value.lower().startswith("0x") else int(value)
        except ValueError:
            number = None
    if type(number) is not int or not 1 <= number <= _LARGEST_TAG:
        text = "the number of a tag is accepted, such as 0x51A0 (1 to 2^64 - 1)"
        raise ParameterError(f"found the tag {written(value)}; {text}")
    return number


def tag_text(tag: int) -> str:
    """A tag as it is written."""
    return f"0x{tag:X}"


def _tools(value: object) -> object:
    """Tags, each written once, with the names of their tools."""
    if not isinstance(value, Mapping):
        return value
    tools: dict[str, object] = {}
    for key, name in value.items():
        text = tag_text(tag_of(key))
        if text in tools:
            raise ParameterError(f"found the tag {text} twice; each tag once is accepted")
        tools[text] = name
    return tools


Tools = Annotated[
    Read[dict[str, str], Mapping[int, str] | Mapping[str, str]], BeforeValidator(_tools)
]
"""Tag -> name of an obstacle or instrument of the scene."""
