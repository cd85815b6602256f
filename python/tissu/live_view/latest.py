"""The newest value from one thread to another; what is older is dropped, so nothing piles up."""

from __future__ import annotations

import threading
from typing import Generic, TypeVar

T = TypeVar("T")


class Latest(Generic[T]):
    """Room for one value. Putting never waits; taking waits for a value that was not taken yet."""

    def __init__(self) -> None:
        """Begin empty."""
        self._there = threading.Condition()
        self._value: T | None = None

    @property
    def waiting(self) -> bool:
        """Whether a value lies there that was not taken."""
        return self._value is not None

    def put(self, value: T) -> None:
        """Leave a value; the one before, if it still lies there, is dropped."""
        with self._there:
            self._value = value
            self._there.notify_all()

    def take(self, timeout: float) -> T | None:
        """The newest value, which is gone then; None: there was none within `timeout` [s]."""
        with self._there:
            self._there.wait_for(lambda: self._value is not None, timeout)
            value, self._value = self._value, None
            return value
