"""A field of a part: its default, its bounds, and whether it is given without its name."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from pydantic import Field


def field(
    *,
    default: Any = ...,
    default_factory: Callable[[], Any] | None = None,
    kw_only: bool = True,
    **bounds: float,
) -> Any:
    """The field of a part, for the right side of its declaration.

    Args:
        default: its value where it is absent; without one the field is required.
        default_factory: makes that value.
        kw_only: False for a field that may be given without a keyword, in the order of the fields.
        bounds: gt, ge, lt or le of a number; min_length, max_length of a list.
    """
    given: dict[str, Any] = {"kw_only": kw_only, **bounds}
    if default_factory is not None:
        return Field(default_factory=default_factory, **given)
    return Field(default, **given)
