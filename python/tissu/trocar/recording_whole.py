"""Whether the arrays of a recording are whole: each column, setting and model as ticks need it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from tissu import _haptic
from tissu.errors import ParameterError
from tissu.trocar.kinematics import Array
from tissu.trocar.settings import FIELDS, fields_of

COLUMNS: Mapping[str, tuple[str, int]] = {
    **{"number": ("i8", 0), "offered": ("u8", 0), "settings": ("u4", 0)},
    **{"read": ("u1", 0), "written": ("u1", 0), "counts": ("i4", 5), "time_ns": ("i8", 0)},
    **{"sequence": ("u4", 0), "flags": ("u2", 0), "tag": ("u8", 0)},
    **{"command": ("f8", 5), "enable": ("b1", 0), "q": ("f8", 4), "torque": ("f8", 4)},
    **{"force": ("f8", 3), "state": ("u1", 0), "reason": ("u1", 0), "stored": ("f8", 0)},
    **{"share": ("f8", 0), "tank": ("f8", 0), "given_out": ("f8", 0)},
}
"""Kind of the numbers of each column of ticks, and how many each tick has; 0: one."""


def require_columns(columns: Mapping[str, Array]) -> None:
    """Refuse columns that are missing, of another kind, or not as long as the others.

    Raises:
        ParameterError: the first that is not right.
    """
    for name, (kind, width) in COLUMNS.items():
        if name not in columns:
            raise _damaged(f"it has no column '{name}'")
        column = columns[name]
        accepted = (len(np.atleast_1d(columns["number"])), *([width] if width else []))
        if column.dtype != np.dtype(kind) or column.shape != accepted:
            text = f"its column '{name}' is {column.dtype} of shape {column.shape}; "
            raise _damaged(f"{text}{np.dtype(kind)} of shape {accepted} is accepted")
    number = columns["number"]
    if not len(number) or number[0] < 0 or (np.diff(number) < 1).any():
        raise _damaged("the numbers of its ticks do not grow")


def require_settings(settings: Mapping[int, Mapping[str, Array]]) -> None:
    """Refuse settings of which some are missing, unknown or of another kind.

    Raises:
        ParameterError: the first that are not right.
    """
    if sorted(settings) != list(range(len(settings))) or not settings:
        raise _damaged("some of its settings are missing")
    expected = {name: np.array(value) for name, value in fields_of(_haptic.Settings()).items()}
    for number, one in settings.items():
        for name in sorted({*FIELDS} ^ {*one}):
            what = "no" if name in FIELDS else "the unknown"
            raise _damaged(f"its settings {number} have {what} '{name}'")
        for name, value in one.items():
            wanted = expected[name]
            number_kind = value.dtype.kind in ("b" if wanted.dtype.kind == "b" else "iuf")
            if not number_kind or value.shape != wanted.shape:
                raise _damaged(f"its settings {number} have another kind of '{name}'")


def require_named(columns: Mapping[str, Array], settings: int, stamps: Iterable[int]) -> None:
    """Refuse ticks that name settings or models that are not there.

    Raises:
        ParameterError: the first that is not.
    """
    if int(columns["settings"].max()) >= settings:
        raise _damaged("a tick names settings that it does not have")
    missing = {*np.unique(columns["offered"]).tolist()} - {0, *stamps}
    if missing:
        raise _damaged(f"a tick names the model {min(missing)}, which it does not have")


def require_numbers(parts: Mapping[str, Any]) -> None:
    """Refuse parts of a model that are not arrays of numbers.

    Raises:
        ParameterError: the first that is not.
    """
    for name, part in parts.items():
        if np.asarray(part).dtype.kind not in "iuf":
            raise _damaged(f"'{name}' of one of its models is not of numbers")


def _damaged(why: str) -> ParameterError:
    return ParameterError(f"the recording is damaged: {why}; record again")
