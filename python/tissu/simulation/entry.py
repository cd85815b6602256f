"""One thread at a time in a simulation: a second one would read half a step, and is refused."""

from __future__ import annotations

import functools
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Protocol, TypeVar

from tissu.errors import BusyError

T = TypeVar("T")


class Entry:
    """The door of a simulation: open to the thread that is inside, closed to all others."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._lock = threading.RLock()
        self._inside: tuple[str, str] | None = None

    @property
    def inside(self) -> tuple[str, str] | None:
        """The thread that is inside and what it does there; None: no thread is."""
        return self._inside

    @contextmanager
    def entered(self, doing: str) -> Iterator[None]:
        """Keeps other threads out meanwhile; the same thread may enter again.

        Raises:
            BusyError: another thread is inside.
        """
        if not self._lock.acquire(blocking=False):
            raise BusyError(self._refusal(doing))
        outer = self._inside
        try:
            if outer is None:
                self._inside = (threading.current_thread().name, doing)
            yield
        finally:
            self._inside = outer
            self._lock.release()

    def _refusal(self, doing: str) -> str:
        inside = self._inside
        other = "another thread is in it"
        if inside is not None:
            other = f"thread '{inside[0]}' is in its `{inside[1]}`"
        return (
            f"found thread '{threading.current_thread().name}' at `{doing}` of simulation "
            f"'{self._name}' while {other}; one thread at a time is accepted: wait for that call, "
            "or give each thread a simulation of its own"
        )


class Entered(Protocol):
    """What has a door."""

    _entry: Entry


def one_thread_at_a_time(cls: type[T]) -> type[T]:
    """The class, with every public method and property behind the door `_entry` of its object.

    Those that it inherits are behind the door too.
    """
    members = {
        name: member for base in reversed(cls.__mro__) for name, member in vars(base).items()
    }
    for name, member in members.items():
        if name.startswith("_") or getattr(member, "_before_the_door", False):
            continue
        if isinstance(member, property):
            setattr(cls, name, _guarded_property(name, member))
        elif callable(member):
            setattr(cls, name, _guarded(name, member))
    return cls


def _guarded(name: str, method: Callable[..., Any]) -> Callable[..., Any]:
    @functools.wraps(method)
    def entering(self: Entered, *args: Any, **named: Any) -> Any:
        with self._entry.entered(name):
            return method(self, *args, **named)

    return entering


M = TypeVar("M", bound=Callable[..., Any])


def before_the_door(method: M) -> M:
    """A method that hands the simulation to another thread, so that it must not be inside."""
    method._before_the_door = True  # type: ignore[attr-defined]
    return method


def _guarded_property(name: str, of: property) -> property:
    reads = None if of.fget is None else _guarded(name, of.fget)
    writes = None if of.fset is None else _guarded(name, of.fset)
    return property(reads, writes, of.fdel, of.__doc__)
