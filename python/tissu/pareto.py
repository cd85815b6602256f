"""What nothing beats in both of two costs."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TypeVar

Item = TypeVar("Item")


def front(
    items: Iterable[Item], time: Callable[[Item], float], error: Callable[[Item], float]
) -> list[Item]:
    """Those than which none is both faster and more accurate (Pareto), fastest first."""
    found: list[Item] = []
    for item in sorted(items, key=lambda one: (time(one), error(one))):
        if not found or error(item) < error(found[-1]):
            found.append(item)
    return found
