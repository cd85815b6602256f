"""What is taken for an array of numbers: neither masked nor complex entries, nor ragged rows."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tissu.errors import ParameterError, TissuError


def real_array(
    values: ArrayLike, what: str, *, error: Callable[[str], TissuError] = ParameterError
) -> NDArray[Any]:
    """The values as an array of real numbers.

    NumPy would drop masks and imaginary parts without a word that a caller sees.

    Args:
        values: a list, an array, …
        what: what they are, for the message: "points".
        error: what makes the error of its sentence.

    Raises:
        TissuError: entries that are masked, complex or no numbers, or rows of different lengths.
    """
    accepted = "real numbers are accepted"
    refuse_masked(values, what, error=error)
    try:
        array = np.asarray(values)
    except (ValueError, TypeError):  # ragged rows
        raise error(
            f"found {what} in rows of different lengths; {accepted}, in equal rows"
        ) from None
    if array.dtype.kind == "c":
        raise error(f"found complex {what}; {accepted}: take the real part")
    if array.size and array.dtype.kind not in "biuf":
        raise error(f"found {what} of type {array.dtype}; {accepted}")
    return array


def refuse_masked(
    values: object, what: str, *, error: Callable[[str], TissuError] = ParameterError
) -> None:
    """Refuses an array some of whose entries are masked.

    Raises:
        TissuError: there are such entries.
    """
    if isinstance(values, np.ma.MaskedArray) and np.ma.is_masked(values):
        count = int(np.ma.getmaskarray(values).sum())
        raise error(
            f"found masked {what}, {count} of {values.size} without a value; real numbers are "
            "accepted: fill them in or leave them out"
        )
