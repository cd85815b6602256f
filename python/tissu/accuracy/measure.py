"""How far displacements are from a reference: on a line, at points, everywhere, or at one place."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field, PrivateAttr

from tissu.errors import ParameterError

if TYPE_CHECKING:
    from tissu.simulation import Simulation

Floats = NDArray[np.float64]
Triple = tuple[float, float, float]
_SAME = 1e-7
"""share of a body's size within which two places are the same"""


@dataclass(frozen=True, slots=True)
class Deviation:
    """Of displacements from a reference.

    Attributes:
        mean: over the places that are compared [m].
        largest: over them [m].
        size: the largest displacement of the reference [m].
        places: how many are compared.
    """

    mean: float
    largest: float
    size: float
    places: int


class _Reference(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", use_attribute_docstrings=True)
    body: str
    """the body that is measured"""
    axes: str = Field(default="xyz", pattern="^x?y?z?$", min_length=1)
    """components of the displacement that are compared: "y" is a deflection"""
    _folder: Path = PrivateAttr(default=Path())

    def at(self, folder: Path) -> None:
        """Files are relative to this folder."""
        self._folder = folder

    def wanted(self, points: Floats) -> tuple[NDArray[np.intp], Floats, Floats]:
        """Numbers of the compared nodes, what the reference says of them, and all that it says."""
        raise NotImplementedError

    def deviation(self, simulation: Simulation) -> Deviation:
        """Of a simulation as it stands.

        Raises:
            ParameterError: no node of it is where the reference knows a displacement.
        """
        if self.body not in simulation.bodies:
            raise ParameterError(f"the reference is of a body '{self.body}', which there is not")
        points = np.asarray(simulation.meshes[self.body].points)
        nodes, wanted, known = self.wanted(points)
        if not len(nodes):
            raise ParameterError("no node is where the reference knows a displacement")
        compared = ["xyz".index(axis) for axis in self.axes]
        off = np.linalg.norm((self.found(simulation, nodes) - wanted)[:, compared], axis=1)
        sizes = np.linalg.norm(known[:, compared], axis=1)
        return Deviation(float(off.mean()), float(off.max()), float(sizes.max()), len(off))

    def found(self, simulation: Simulation, nodes: NDArray[np.intp]) -> Floats:
        """(k, 3) displacements of the compared places."""
        return np.asarray(simulation.displacements(self.body))[nodes]

    def arrays(self, file: str) -> dict[str, Floats]:
        """The arrays of a file beside the case."""
        path = self._folder / file
        if not path.is_file():
            raise ParameterError(f"{path}: no such file, and the reference is in it")
        with np.load(path) as data:
            return {name: np.asarray(data[name], dtype=np.float64) for name in data.files}


class CurveReference(_Reference):
    """Displacements along a line at rest, between whose stations a cubic goes."""

    type: Literal["curve"]
    file: str
    """.npz"""
    stations: str = "x"
    """array of distances from `start` [m], increasing"""
    displacements: str
    """array (n, 3) [m]"""
    start: Triple = (0.0, 0.0, 0.0)
    """where the line begins [m]"""
    direction: Triple = (1.0, 0.0, 0.0)
    """along it, of length one"""
    between: bool = True
    """whether nodes between stations are compared as well"""

    def wanted(self, points: Floats) -> tuple[NDArray[np.intp], Floats, Floats]:
        """Nodes on the line."""
        data = self.arrays(self.file)
        along = (points - np.array(self.start)) @ np.array(self.direction)
        off = points - np.array(self.start) - along[:, None] * np.array(self.direction)
        extent = float(np.ptp(points, axis=0).max())
        nodes = np.flatnonzero(np.linalg.norm(off, axis=1) < _SAME * extent)
        if not self.between:
            near = np.abs(along[nodes][:, None] - data[self.stations]).min(axis=1)
            nodes = nodes[near < _SAME * extent]
        values = cubic(data[self.stations], data[self.displacements], along[nodes])
        return nodes, values, data[self.displacements]


class PointsReference(_Reference):
    """Displacements at places at rest; nodes that are elsewhere are not compared."""

    type: Literal["points"]
    file: str
    """.npz"""
    points: str = "points"
    """array (n, 3) of places at rest [m]"""
    displacements: str = "displacements"
    """array (n, 3) [m]"""

    def wanted(self, points: Floats) -> tuple[NDArray[np.intp], Floats, Floats]:
        """Nodes that stand where the reference has a point."""
        data = self.arrays(self.file)
        places = data[self.points]
        step = _SAME * float(np.ptp(points, axis=0).max())
        known = {
            tuple(key): i for i, key in enumerate(np.rint(places / step / 64).astype(np.int64))
        }
        keys = np.rint(points / step / 64).astype(np.int64)
        pairs = [(n, known[tuple(key)]) for n, key in enumerate(keys) if tuple(key) in known]
        nodes = np.array([n for n, _ in pairs], dtype=np.intp)
        values = data[self.displacements]
        return nodes, values[[i for _, i in pairs]], values


class AffineReference(_Reference):
    """u = G (X - origin) everywhere."""

    type: Literal["affine"]
    gradient: tuple[Triple, Triple, Triple]
    """G, by rows"""
    origin: Triple = (0.0, 0.0, 0.0)
    """the place that does not move [m]"""

    def wanted(self, points: Floats) -> tuple[NDArray[np.intp], Floats, Floats]:
        """Every node."""
        values = (points - np.array(self.origin)) @ np.array(self.gradient).T
        return np.arange(len(points)), values, values


class PlaceReference(_Reference):
    """Where one place of the body goes: the mean of the nodes nearest to it at rest."""

    type: Literal["place"]
    rest: Triple
    """at rest [m]"""
    position: Triple
    """in the reference [m]"""

    def wanted(self, points: Floats) -> tuple[NDArray[np.intp], Floats, Floats]:
        """One displacement."""
        value = np.array([self.position]) - np.array([self.rest])
        return self._nearest(points)[:1], value, value

    def found(self, simulation: Simulation, nodes: NDArray[np.intp]) -> Floats:
        """Where those nodes went, in the mean, less the place at rest."""
        points = np.asarray(simulation.meshes[self.body].points)
        near = self._nearest(points)
        positions = np.asarray(simulation.positions[self.body])[near]
        there: Floats = positions.mean(axis=0, keepdims=True) - np.array([self.rest])
        return there

    def _nearest(self, points: Floats) -> NDArray[np.intp]:
        off = np.linalg.norm(points - np.array(self.rest), axis=1)
        extent = float(np.ptp(points, axis=0).max())
        return np.flatnonzero(off <= off.min() + _SAME * extent)


Reference = CurveReference | PointsReference | AffineReference | PlaceReference


def cubic(x: Floats, y: Floats, at: Floats) -> Floats:
    """Values between stations: the cubic through the four nearest (Lagrange).

    Args:
        x: (n,) stations, increasing; at least four.
        y: (n, k) values there.
        at: (m,) where.

    Returns:
        (m, k) values; exact for cubics, error of fourth order else.
    """
    first = np.clip(np.searchsorted(x, at) - 2, 0, len(x) - 4)
    result = np.zeros((len(at), y.shape[1]))
    for i in range(4):
        weight = np.ones(len(at))
        for j in range(4):
            if j != i:
                weight *= (at - x[first + j]) / (x[first + i] - x[first + j])
        result += weight[:, None] * y[first + i]
    return result
