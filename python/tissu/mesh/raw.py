"""What a file holds, before it is brought into order."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(slots=True)
class RawMesh:
    """A file's content as its reader found it.

    Attributes:
        points: (n, 2) or (n, 3), in the file's unit.
        blocks: (cell type, node numbers (e, k)), like types not yet together.
        regions: name -> for each block, which of its cells (e,) bool are in the region.
        notes: what the reader did.
    """

    points: NDArray[Any]
    blocks: list[tuple[str, NDArray[Any]]]
    regions: dict[str, list[NDArray[np.bool_]]] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)


def tagged_regions(
    tags: list[NDArray[Any]], names: dict[int, str], *, ignore_zero: bool
) -> dict[str, list[NDArray[np.bool_]]]:
    """Regions from one whole number per cell; a tag without a name is called by its number."""
    values = np.unique(np.concatenate(tags)) if tags else np.empty(0)
    return {
        names.get(int(value), str(int(value))): [tag == value for tag in tags]
        for value in values
        if value != 0 or not ignore_zero
    }
