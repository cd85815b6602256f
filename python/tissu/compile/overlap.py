"""Bodies whose boxes overlap at rest."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tissu.compile.prepared import Floats


def boxes_that_overlap(bounds: Mapping[str, Floats]) -> list[tuple[str, str]]:
    """Pairs of names whose boxes (2, 3), lowest and highest corner, touch or overlap."""
    return [
        (a, b)
        for a, b in itertools.combinations(bounds, 2)
        if (bounds[a][0] <= bounds[b][1]).all() and (bounds[b][0] <= bounds[a][1]).all()
    ]
