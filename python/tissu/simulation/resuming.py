"""Severed links in a checkpoint."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tissu.errors import ParameterError

if TYPE_CHECKING:
    from tissu.simulation.severing import Severing
    from tissu.ties import Links

Pairs = NDArray[np.int32]


def severed_arrays(
    links: Mapping[str, Links], severed: Mapping[str, Pairs]
) -> dict[str, NDArray[np.int32]]:
    """The pairs of each tissue that has lost some, by the number of the tissue."""
    return {
        f"severed_{number}": severed[tissue].ravel()
        for number, tissue in enumerate(links)
        if tissue in severed
    }


def resume_severed(simulation: Severing, snapshot: Mapping[str, Any]) -> None:
    """Sever the links again that a checkpoint names; frames without points stay where they were.

    Raises:
        ParameterError: they are not links of the scene.
    """
    simulation._become_severed(_severed_of(simulation._links, snapshot))
    if not simulation._severed:
        return
    core, places = simulation._core, np.reshape(snapshot["positions"], (-1, 3))
    ranges = {tissue: core.body_range(tissue) for tissue in simulation._severed}
    held = {tissue: places[first : first + count] for tissue, (first, count) in ranges.items()}
    core.replace_world(world=simulation._as_severed(core.world, held))


def _severed_of(links: Mapping[str, Links], snapshot: Mapping[str, Any]) -> dict[str, Pairs]:
    """The pairs of each tissue.

    Raises:
        ParameterError: they are not pairs of the tissue, or leave no point of it.
    """
    found: dict[str, Pairs] = {}
    for number, (tissue, of) in enumerate(links.items()):
        values = snapshot.get(f"severed_{number}")
        if values is None:
            continue
        pairs = np.reshape(values, (-1, 2)) if np.size(values) % 2 == 0 else np.full((1, 2), -1)
        left = of.without(pairs)
        if len(left) + len(pairs) != len(of.all()) or not len(left) or not len(pairs):
            raise ParameterError(
                f"the severed links of tissue '{tissue}' do not fit; restore them in a simulation "
                "of the same scene"
            )
        found[tissue] = np.unique(pairs, axis=0).astype(np.int32)
    return found
