"""How much a scene may ask for: names that can be written, steps that end."""

from __future__ import annotations

import math
import unicodedata
from collections.abc import Iterable, Iterator

import numpy as np

from tissu.scene.problem import Problem

MOST_STEPS = 1_000_000_000
"""Steps of a run; at a microsecond each, what the smallest scene takes, a quarter of an hour."""
_LONGEST_NAME = 200
_LARGEST_COUNT = 2**31 - 1


def name_problem(name: str) -> str:
    """What is wrong with the name of a scene or body; empty: nothing."""
    if len(name) > _LONGEST_NAME:
        return f"found a name of {len(name)} characters; at most {_LONGEST_NAME} are accepted"
    if not name.strip():
        return "found an empty name; one of at least one letter is accepted"
    odd = next((c for c in name if unicodedata.category(c) in ("Cc", "Cs")), "")
    if odd:
        return f"found a name with the character U+{ord(odd):04X}; take it out"
    return ""


def step_problems(duration: float, dt: float) -> Iterator[Problem]:
    """A run whose steps do not end in a lifetime."""
    steps = duration / dt if dt > 0.0 else math.inf
    if steps > MOST_STEPS:
        text = f"found {dt:g} s for a duration of {duration:g} s, which is {steps:.2g} steps; "
        yield Problem(("dt",), f"{text}at most {MOST_STEPS:.0e} are accepted: take a larger dt")


def boolean_problem(written_as: object, read: object) -> str:
    """What is wrong with a value that was read as numbers, alone or in a list; empty: nothing.

    Python counts True as 1, and a list of True and False may be meant as one of yes and no.
    """
    if isinstance(read, (list, tuple)):
        items = written_as.tolist() if isinstance(written_as, np.ndarray) else written_as
        if not isinstance(items, (list, tuple)) or len(items) != len(read):
            return ""
        return next(filter(None, map(boolean_problem, items, read)), "")
    if type(read) not in (int, float) or not isinstance(written_as, (bool, np.bool_)):
        return ""
    return f"found {written_as}; a {'whole ' if type(read) is int else ''}number is accepted"


def count_problem(value: object) -> str:
    """What is wrong with whole numbers that were read, alone or in a list; empty: nothing."""
    counts: Iterable[object] = value if isinstance(value, (list, tuple)) else (value,)
    large = [n for n in counts if type(n) is int and abs(n) > _LARGEST_COUNT]
    if not large:
        return ""
    digits = int(large[0].bit_length() * math.log10(2)) + 1
    shown = str(large[0]) if digits <= 30 else f"a whole number of about {digits} digits"
    return f"found {shown}; whole numbers up to {_LARGEST_COUNT} are accepted"
