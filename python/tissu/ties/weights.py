"""How points listen to frames."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Ints = NDArray[np.int32]
Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


class Weights(NamedTuple):
    """How points listen to frames.

    Attributes:
        frames: numbers (p, k).
        weights: (p, k).
        gradients: (p, k, 3) at rest [1/m].
    """

    frames: Ints
    weights: Floats
    gradients: Floats

    def listed(self) -> Bools:
        """Which entries (p, k) are more than the filling of a row."""
        return np.asarray((self.weights != 0.0) | (self.gradients != 0.0).any(axis=2))

    def shares(self) -> Floats:
        """Which shares (p, k) of the mass of a point its frames get, as the core lumps it.

        They are the weights, or, where one is below zero, their squares over the sum of these
        (Hinton, Rock and Zienkiewicz 1976).
        """
        negative = self.weights.min(axis=1, keepdims=True) < 0.0
        found = np.where(negative, np.square(self.weights), self.weights)
        return np.asarray(found / found.sum(axis=1, keepdims=True))

    def steepness(self) -> Floats:
        """The sum (p,) of the lengths of the gradients of the weights of each point [1/m]."""
        return np.asarray(np.linalg.norm(self.gradients, axis=2).sum(axis=1))

    def of(self, points: NDArray[np.int64]) -> Weights:
        """Those of some points."""
        return Weights(self.frames[points], self.weights[points], self.gradients[points])
