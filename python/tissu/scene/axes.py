"""Axes of space by their letters, as supports name them."""

from __future__ import annotations

from typing import Annotated

from pydantic import BeforeValidator

from tissu.errors import ParameterError


def _letters(value: object) -> str | None:
    """Letters out of xyz, each once, in their order; None: the value is something else."""
    if not isinstance(value, str) or not value or set(value) - set("xyz"):
        return None
    return "".join(sorted(value)) if len(set(value)) == len(value) else None


def _axes(value: object) -> object:
    found = "free" if value == "free" else _letters(value)
    if found is None:
        accepted = "one or more of the letters x, y, z are accepted, each once, or free"
        raise ParameterError(f"found {value!r}; {accepted}")
    return found


def _rotations(value: object) -> object:
    if value is None or value in ("held", "free"):
        return value
    found = _letters(value)
    if found is None:
        accepted = "held, free, or letters out of x, y, z, each once, are accepted"
        raise ParameterError(f"found {value!r}; {accepted}")
    return "held" if found == "xyz" else found


def mask_of(letters: str) -> int:
    """Bit mask of axes: x = 1, y = 2, z = 4."""
    return sum(1 << "xyz".index(letter) for letter in letters)


Axes = Annotated[str, BeforeValidator(_axes)]
Rotations = Annotated[str | None, BeforeValidator(_rotations)]
