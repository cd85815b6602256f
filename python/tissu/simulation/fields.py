"""Fields of a body at points, cells and nodes, from F, P and W at its integration points.

Cells: means over the points, weighted by their volume at rest; von Mises' stress and principal
values are those of the mean tensor. Nodes: in each cell the affine function nearest to its points
(least squares, weighted by volume; Hinton and Campbell, Int. J. Numer. Methods Eng. 8, 1974),
taken at its nodes, and the mean of that over the cells around a node, weighted by their volume.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tissu.errors import ParameterError
from tissu.simulation import tensors

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

_FLAT = 1e-9  # of the largest spread of a cell's points: less is none

_OF_POINTS: Mapping[str, Callable[[Mapping[str, Any]], Floats]] = {
    "deformation_gradient": lambda at: at["F"],
    "green_strain": lambda at: tensors.green_strain(at["F"]),
    "cauchy_stress": lambda at: tensors.cauchy_stress(at["F"], at["P"]),
    "first_piola_kirchhoff_stress": lambda at: at["P"],
    "second_piola_kirchhoff_stress": lambda at: tensors.second_stress(at["F"], at["P"]),
    "energy_density": lambda at: at["W"],
    "volume_ratio": lambda at: tensors.determinant(at["F"]),
}
_OF_TENSORS: Mapping[str, tuple[str, Callable[[Floats], Floats]]] = {
    "von_mises": ("cauchy_stress", tensors.von_mises),
    "principal_stresses": ("cauchy_stress", tensors.principal_values),
    "principal_strains": ("green_strain", tensors.principal_values),
}


@dataclass(frozen=True, slots=True)
class IntegrationPoints:
    """The integration points of a body, in the order of its fields at points.

    Attributes:
        cells: number (p,) int32 of the cell of each point in the body's mesh.
        positions: at rest (p, 3) [m].
        volumes: at rest (p,) [m^3]; their sum is that of the body's material.
    """

    cells: Ints
    positions: Floats
    volumes: Floats


class BodyFields:
    """What a body's models have at their points; computed once, for all fields asked of it."""

    def __init__(self, body: str, blocks: Sequence[Mapping[str, Any]]) -> None:
        """Take the blocks of the compiled core.

        Raises:
            ParameterError: a model of the body has no stress.
        """
        without = next((block["model"] for block in blocks if "F" not in block), None)
        if without is not None:
            model = without.replace("-", "_")  # as scenes spell it
            raise ParameterError(
                f"found the model {model} of body '{body}', which has neither strain nor stress "
                "at points; energy_density and volume_ratio at cells are accepted"
            )
        self._blocks = blocks

    def at_points(self, name: str) -> Floats:
        """A field (p, ...) at the points, cell after cell of the mesh."""
        values = [_at_points(block, name) for block in self._blocks]
        return np.asarray(self._ordered(values, per_point=True))

    def at_cells(self, name: str) -> Floats:
        """A field (e, ...) as means over the cells of the mesh."""
        values = [_at_cells(block, name) for block in self._blocks]
        return np.asarray(self._ordered(values, per_point=False))

    def at_nodes(self, name: str, rest: Floats) -> Floats:
        """A field (n, ...) at the nodes of rest positions (n, 3); nan where no cell is."""
        source, of_tensor = _OF_TENSORS.get(name, (name, None))
        parts = []
        for block in self._blocks:
            nodes, values = np.asarray(block["nodes"]), _fitted(block, source, rest)
            shape = values.shape[2:]
            volume = np.repeat(block["volumes"].sum(axis=1), nodes.shape[1])
            cells = np.repeat(block["cells"], nodes.shape[1])
            parts.append((cells, nodes.ravel(), volume, values.reshape(nodes.size, -1)))
        cells, node, volume, flat = (np.concatenate(part) for part in zip(*parts, strict=True))
        # Cell after cell: the sums do not depend on the order in which cuts left the blocks.
        order = np.argsort(cells, kind="stable")
        node, volume, flat = node[order], volume[order], flat[order]
        sums, volumes = np.zeros((len(rest), flat.shape[1])), np.zeros(len(rest))
        np.add.at(sums, node, volume[:, None] * flat)
        np.add.at(volumes, node, volume)
        with np.errstate(invalid="ignore"):
            means = (sums / volumes[:, None]).reshape(len(rest), *shape)
        return means if of_tensor is None else of_tensor(means)

    def points(self) -> IntegrationPoints:
        """The points themselves."""
        order = np.argsort(self._cells(), kind="stable")
        number = np.empty(len(order), dtype=np.int32)
        number[order] = np.arange(len(order), dtype=np.int32)
        parts = np.split(number, np.cumsum([len(block["cells"]) for block in self._blocks])[:-1])
        cells = [
            np.repeat(part[:, None], block["volumes"].shape[1], axis=1)
            for part, block in zip(parts, self._blocks, strict=True)
        ]
        return IntegrationPoints(
            cells=self._ordered(cells, per_point=True),
            positions=self._ordered([b["positions"] for b in self._blocks], per_point=True),
            volumes=self._ordered([b["volumes"] for b in self._blocks], per_point=True),
        )

    def _cells(self) -> Ints:
        return np.concatenate([np.asarray(block["cells"]) for block in self._blocks])

    def _ordered(self, values: Sequence[Any], *, per_point: bool) -> Any:
        """The values of all blocks in the order of the mesh's cells."""
        order = np.argsort(self._cells(), kind="stable")
        if not per_point:
            return np.concatenate(values)[order]
        if len({block.shape[1] for block in values}) == 1:
            ordered = np.concatenate(values)[order]
            return ordered.reshape(-1, *ordered.shape[2:])
        cells = [value for block in values for value in block]  # (q, ...) of each cell
        return np.concatenate([cells[cell] for cell in order])


def _at_points(block: Mapping[str, Any], name: str) -> Floats:
    """A field (e, q, ...) of a block."""
    source, of_tensor = _OF_TENSORS.get(name, (name, None))
    values = _OF_POINTS[source](block)
    return values if of_tensor is None else of_tensor(values)


def _mean(block: Mapping[str, Any], values: Floats) -> Floats:
    weights = block["volumes"] / block["volumes"].sum(axis=1, keepdims=True)
    return np.asarray(np.einsum("eq,eq...->e...", weights, values))


def _at_cells(block: Mapping[str, Any], name: str) -> Floats:
    """Means (e, ...); of points above each other the largest von Mises: a mean hides bending."""
    if name == "von_mises" and block["through_thickness"]:
        return np.asarray(_at_points(block, name).max(axis=1))
    if name == "energy_density" and "cell_W" in block:
        return np.asarray(block["cell_W"])
    source, of_tensor = _OF_TENSORS.get(name, (name, None))
    mean = _mean(block, _at_points(block, source))
    return mean if of_tensor is None else of_tensor(mean)


def _fitted(block: Mapping[str, Any], name: str, rest: Floats) -> Floats:
    """The affine function of each cell that is nearest to its points, at its nodes (e, k, ...)."""
    values, mean = _at_points(block, name), _at_cells(block, name)
    weights = block["volumes"] / block["volumes"].sum(axis=1, keepdims=True)
    centre = np.einsum("eq,eqi->ei", weights, block["positions"])
    off = block["positions"] - centre[:, None]
    spread = np.einsum("eq,eqi,eqj->eij", weights, off, off)
    moment = np.einsum("eq,eqi,eq...->ei...", weights, off, values)
    inverse = np.linalg.pinv(spread, rcond=_FLAT, hermitian=True)
    slope = np.einsum("eij,ej...->ei...", inverse, moment)
    away = rest[block["nodes"]] - centre[:, None]
    return np.asarray(mean[:, None] + np.einsum("eki,ei...->ek...", away, slope))
