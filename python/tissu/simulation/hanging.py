"""What hangs together in a scene, by cells that share a node or by tissue, and what holds it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.simulation.twist import joined

if TYPE_CHECKING:
    from tissu.simulation.severing import Severing
    from tissu.ties import Left, Weights

Ints = NDArray[np.int64]


def labels(simulation: Severing, instead: Mapping[str, Left]) -> Ints:
    """A number (n,) for each row of the unknowns, the same for rows that hang together.

    Args:
        simulation: as it is.
        instead: tissues whose points are to be others.
    """
    found = np.arange(simulation._core.world.blocks)
    for body in simulation._meshes:
        first, _ = simulation._core.body_range(body)
        mesh = simulation._meshes[body]
        parts, start = mesh.parts(), 0
        for block in mesh.body_blocks:
            of_nodes = np.repeat(parts[start : start + len(block)], block.nodes.shape[1])
            start += len(block)
            for part in np.unique(of_nodes):
                nodes = first + block.nodes.ravel()[of_nodes == part]
                joint = np.isin(found, found[nodes])
                found[joint] = found[nodes].min()
    for weights in _weights(simulation, instead):
        found = joined(weights, found)
    return found


def active(simulation: Severing, instead: Mapping[str, Left]) -> Ints:
    """The rows that a cell or a point uses."""
    rows = [
        simulation._core.body_range(body)[0] + np.unique(block.nodes)
        for body in simulation._meshes
        for block in simulation._meshes[body].body_blocks
    ]
    rows += [np.unique(weights.frames) for weights in _weights(simulation, instead)]
    return np.unique(np.concatenate(rows))


def held(simulation: Severing, labels: Ints) -> Ints:
    """The labels of what a support holds or leads, or a contact may hold: the step finds."""
    rows: list[Ints] = []
    for body in (*simulation._meshes, *simulation._links):
        first, count = simulation._core.body_range(body)
        if body in simulation.touching:
            rows.append(first + np.arange(count))
        eliminated, on_all_axes = simulation._core.unfree_nodes(body)
        rows.append(first + np.setdiff1d(on_all_axes, eliminated).astype(np.int64))
    return np.unique(labels[np.concatenate(rows)])


def _weights(simulation: Severing, instead: Mapping[str, Left]) -> Iterator[Weights]:
    """The weights of the points of each tissue, by numbers of rows."""
    for tissue in simulation._links:
        left = instead.get(tissue) or simulation._left(tissue)
        rows = simulation._rows(tissue, left)
        yield left.weights._replace(frames=rows[left.weights.frames])
