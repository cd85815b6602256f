"""What a checkpoint must hold: each entry with its type, numbers that are finite.

A digest says that a file is whole, not that tissu wrote it. Lengths that depend on the scene are
compared by the core, which refuses others.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from tissu.errors import CheckpointError

_HEADER: dict[str, type] = {
    "scene": str,
    "steps": int,
    "unconverged": int,
    "first_unconverged": str,
    "physics": dict,
    "snapshot": dict,
    "build": dict,
}
_TIMES = ("time", "time_before", "load_factor", "memory_time")
_OF_CUTS = (
    *("origins", "nodes", "copies_of", "bare", "rider_nodes", "material_hosts", "material_first"),
    *("material_vertices", "material_cut", "incisions", "first_of_incision", "on_incision"),
    "at_front",
)
"""Lists of a body that was cut, as the core names them."""
_NUMBERS = (
    "positions",
    "velocities",
    "velocities_before",
    "rotations",
    "memory",
    "energy_watch",
)
_MOST_STEPS = 2**53  # whole numbers that a double holds


def require_contents(path: Path, header: Mapping[str, Any], arrays: Mapping[str, Any]) -> None:
    """Refuses a checkpoint that lacks an entry or has one of another type.

    Raises:
        CheckpointError: which one.
    """
    for name, kind in _HEADER.items():
        if type(header.get(name)) is not kind:
            raise _wrong(path, name, f"a {kind.__name__}")
    snapshot = header["snapshot"]
    if not 0 <= header["steps"] <= _MOST_STEPS:
        raise _wrong(path, "steps", "a number of steps")
    missed, said = header["unconverged"], header["first_unconverged"]
    if not 0 <= missed <= header["steps"] or bool(missed) != bool(said):
        raise _wrong(path, "unconverged", "a number of steps, with what the first of them said")
    for name in _TIMES:
        value = snapshot.get(name)
        if type(value) not in (int, float) or not math.isfinite(value):
            raise _wrong(path, name, "a finite number")
    if not isinstance(snapshot.get("settled"), bool):
        raise _wrong(path, "settled", "true or false")
    for name in (*_NUMBERS, *(["straining"] if "straining" in arrays else [])):
        _require_finite(path, name, arrays)
    sizes = arrays.get("memory_sizes")
    if not isinstance(sizes, np.ndarray) or sizes.dtype != np.int32:
        raise _wrong(path, "memory_sizes", "an array of int32")
    integrator = arrays.get("integrator")  # a stable step may be infinite
    if not isinstance(integrator, np.ndarray) or integrator.dtype != np.float64:
        raise _wrong(path, "integrator", "an array of float64")
    for name in [name for name in arrays if name.startswith("severed_")]:
        if arrays[name].dtype != np.int32:
            raise _wrong(path, name, "an array of int32")
    for key, body in snapshot.items():
        if key.startswith("body_"):
            _require_body(path, key.removeprefix("body_"), body, arrays)


def _require_finite(path: Path, name: str, arrays: Mapping[str, Any]) -> None:
    values = arrays.get(name)
    if not isinstance(values, np.ndarray) or values.dtype != np.float64:
        raise _wrong(path, name, "an array of float64")
    if not np.isfinite(values).all():
        raise _wrong(path, name, "finite numbers")


def _require_body(path: Path, number: str, body: object, arrays: Mapping[str, Any]) -> None:
    if not isinstance(body, str):
        raise _wrong(path, f"body_{number}", "the name of a body")
    for name in (f"cells_{number}", f"loose_nodes_{number}"):
        values = arrays.get(name)
        if not isinstance(values, np.ndarray) or values.dtype != np.int32:
            raise _wrong(path, name, "an array of int32")
    _require_finite(path, f"places_{number}", arrays)
    if f"origins_{number}" in arrays:
        _require_cuts(path, number, arrays)


def _require_cuts(path: Path, number: str, arrays: Mapping[str, Any]) -> None:
    """What cuts made of a body: whole numbers, and two lists of finite ones."""
    for name in _OF_CUTS:
        values = arrays.get(f"{name}_{number}")
        if not isinstance(values, np.ndarray) or values.dtype != np.int32:
            raise _wrong(path, f"{name}_{number}", "an array of int32")
    for name in ("shares", "rider_weights"):
        _require_finite(path, f"{name}_{number}", arrays)
    if f"rest_{number}" in arrays:  # of all nodes, where cuts moved some
        _require_finite(path, f"rest_{number}", arrays)
    if f"point_nodes_{number}" in arrays:  # nodes on edges, where cuts divide cells
        if arrays[f"point_nodes_{number}"].dtype != np.int32:
            raise _wrong(path, f"point_nodes_{number}", "an array of int32")
        _require_finite(path, f"point_weights_{number}", arrays)


def _wrong(path: Path, name: str, accepted: str) -> CheckpointError:
    return CheckpointError(
        f"checkpoint {path}: its entry '{name}' is not {accepted}, so tissu did not write it; "
        "go on from another one, or start again"
    )
