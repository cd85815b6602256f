"""Field types that say what a field gives and what it may be written as.

`young: Read[float, float | str]` is a number where it is read, and a number or a text such as
"5 kPa" where the part is made. Type checkers take the arguments of a part's `__init__` from it
(PEP 681: a field whose type is a descriptor is written with what its `__set__` takes). When the
program runs, only what the field gives is left: `Read[float, float | str]` is `float`.
"""

from __future__ import annotations

import math
import reprlib
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Any, Generic, TypeVar, overload

import numpy as np
from pydantic import BeforeValidator
from typing_extensions import Self

from tissu.arrays import refuse_masked
from tissu.errors import ParameterError

Number = float | str
"""What a quantity may be written as in Python: a number in SI, or a text with its unit."""
VectorLike = Sequence[float | str] | np.ndarray[Any, Any]
"""What a vector may be written as: three numbers in SI or texts with units."""
Series = Sequence[Number] | np.ndarray[Any, Any]
"""What a list of quantities may be written as."""


_LONG_INTEGER = 200  # bits, above which a whole number is not written out


def listed(value: object) -> object:
    """A numpy array as nested lists; anything else unchanged.

    Raises:
        ParameterError: some of its entries are masked.
    """
    refuse_masked(value, "values")
    return value.tolist() if isinstance(value, np.ndarray) else value


def names_of(value: object, what: str, *, example: str = "liver") -> tuple[str, ...]:
    """The names of a list; a single text would be taken for a list of its letters.

    Raises:
        ParameterError: not a list of texts.
    """
    found = listed(value)
    if isinstance(found, (list, tuple)) and all(isinstance(name, str) for name in found):
        return tuple(found)
    shown = value if isinstance(value, str) else example
    raise ParameterError(
        f"found the {what} {written(value)}; a list of names is accepted, such as ['{shown}']"
    )


def written(value: object) -> str:
    """A value in a message, much shortened; what Python calls None is null, as in YAML."""
    if isinstance(value, (list, tuple)):
        few = [written(item) for item in value[:6]] + ["..."] * (len(value) > 6)
        return f"[{', '.join(few)}]"
    if type(value) is int and value.bit_length() > _LONG_INTEGER:
        return f"a whole number of about {int(value.bit_length() * math.log10(2)) + 1} digits"
    return "null" if value is None else reprlib.repr(value)


Out = TypeVar("Out")
In = TypeVar("In")
Q = TypeVar("Q")

if TYPE_CHECKING:

    class Read(Generic[Out, In]):
        """A field that gives Out and may be written as In."""

        @overload
        def __get__(self, part: None, owner: Any) -> Self: ...
        @overload
        def __get__(self, part: object, owner: Any) -> Out: ...
        def __get__(self, part: Any, owner: Any) -> Any: ...
        def __set__(self, part: object, value: In) -> None: ...

    class Maybe(Read[float | None, Number | None], Generic[Q]):
        """A quantity that may be absent."""

    class MaybeVector(Read[tuple[float, float, float] | None, VectorLike | None], Generic[Q]):
        """A vector that may be absent."""

    class Many(Read[tuple[float, ...], Series], Generic[Q]):
        """A list of quantities."""

    class MaybeMany(Read[tuple[float, ...] | None, Series | None], Generic[Q]):
        """A list of quantities that may be absent."""

    class MaybeVectors(
        Read[tuple[tuple[float, float, float], ...] | None, Sequence[VectorLike] | None], Generic[Q]
    ):
        """A list of vectors that may be absent."""

else:

    class Read:
        """What the field gives."""

        def __class_getitem__(cls, types: tuple[Any, Any]) -> Any:
            return types[0]

    class Maybe:
        """What stands in brackets, or None."""

        def __class_getitem__(cls, quantity: Any) -> Any:
            return quantity | None

    MaybeVector = MaybeMany = MaybeVectors = Maybe

    class Many:
        """A tuple of the quantity, of any length; an array is taken as a list."""

        def __class_getitem__(cls, quantity: Any) -> Any:
            return Annotated[tuple[quantity, ...], BeforeValidator(listed)]
