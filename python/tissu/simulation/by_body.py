"""Arrays of a simulation by the names of its bodies; another name gets those that there are."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from tissu.errors import ParameterError

Floats = NDArray[np.float64]


class UnknownBodyError(ParameterError, KeyError):
    """A name that no body has; a `KeyError` too, since mappings promise one."""

    __str__ = ParameterError.__str__


class ByBody(Mapping[str, Floats]):
    """Body -> array, read-only as a mapping; the arrays are views."""

    def __init__(self, arrays: Mapping[str, Floats]) -> None:
        self._arrays = dict(arrays)

    def __getitem__(self, name: str) -> Floats:
        """The array of a body.

        Raises:
            ParameterError: no body of that name; it is a KeyError too.
        """
        try:
            return self._arrays[name]
        except KeyError:
            known = ", ".join(self._arrays)
            raise UnknownBodyError(f"found body '{name}'; accepted: {known}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def __len__(self) -> int:
        return len(self._arrays)
