"""Where a tool is and how it is turned."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tissu import units
from tissu.arrays import real_array
from tissu.errors import ParameterError

if TYPE_CHECKING:
    from tissu.reading import VectorLike

Floats = NDArray[np.float64]

_POSITION = units.Triple(units.LENGTH)
_VECTOR = units.Triple(units.ANGLE)
_ORTHOGONAL = 1e-6
_LARGEST_TURN = 1e6
"""rad: above it the round-off of an angle is a turn that can be seen"""


@dataclass(frozen=True, slots=True, eq=False)
class Pose:
    """A place and a turn.

    Attributes:
        position: of the tool's origin (3,) [m].
        turn: unit quaternion w x y z (4,).
    """

    position: Floats
    turn: Floats

    def numbers(self) -> Floats:
        """Place and turn (7,)."""
        return np.concatenate([self.position, self.turn])

    def place(self, points: Floats) -> Floats:
        """Where points of the tool (m, 3) are in space [m]."""
        return np.asarray(points @ self.matrix().T + self.position)

    def matrix(self) -> Floats:
        """The turn as a rotation matrix (3, 3)."""
        w, x, y, z = self.turn
        return np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
            ]
        )

    def angle_to(self, other: Pose) -> float:
        """The angle of the turn between the two [rad], 0 to pi."""
        return 2.0 * math.acos(min(1.0, abs(float(self.turn @ other.turn))))

    def between(self, other: Pose, share: float) -> Pose:
        """A share of the way to another pose: straight, and turned evenly the shorter way."""
        if share == 1.0:
            return other
        end = other.turn if self.turn @ other.turn >= 0.0 else -other.turn
        half = math.acos(min(1.0, float(self.turn @ end)))
        turn = (1.0 - share) * self.turn + share * end
        if half > 1e-8:
            turn = math.sin((1.0 - share) * half) * self.turn + math.sin(share * half) * end
        position = (1.0 - share) * self.position + share * other.position
        return Pose(position, turn / np.linalg.norm(turn))


def pose_of(position: VectorLike, rotation: VectorLike | ArrayLike | None = None) -> Pose:
    """A pose from a place [m], and a rotation vector (3,) [rad] or a rotation matrix (3, 3).

    Raises:
        ParameterError: a value is not finite or of another quantity; a turn above 1e6 rad; a
            matrix that is not a rotation.
    """
    place = np.array(_POSITION(position), dtype=float)
    if rotation is None:
        return Pose(place, np.array([1.0, 0.0, 0.0, 0.0]))
    if isinstance(rotation, np.ndarray) and rotation.shape == (3, 3):
        return Pose(place, turn_of_matrix(real_array(rotation, "a rotation")))
    vector = np.array(_VECTOR(rotation), dtype=float)
    if not np.abs(vector).max() <= _LARGEST_TURN:
        raise ParameterError(
            f"found a rotation of {np.abs(vector).max():g} rad about an axis; at most "
            f"{_LARGEST_TURN:g} rad is accepted"
        )
    return Pose(place, turn_of_vector(vector))


def turn_of_vector(vector: Floats) -> Floats:
    """The unit quaternion (4,) of a rotation vector (3,) [rad]."""
    angle = float(np.linalg.norm(vector))
    share = 0.5 if angle == 0.0 else math.sin(0.5 * angle) / angle
    return np.array([math.cos(0.5 * angle), *(share * vector)])


def turn_of_matrix(matrix: Floats) -> Floats:
    """The unit quaternion (4,) with w >= 0 of a rotation matrix (3, 3).

    Raises:
        ParameterError: it is not a rotation.
    """
    turned = np.asarray(matrix, dtype=float)
    if not np.abs(turned @ turned.T - np.eye(3)).max() < _ORTHOGONAL or np.linalg.det(turned) < 0.0:
        raise ParameterError(
            "found a matrix that is not a rotation; one with R R^T = 1 and det R = 1 is accepted, "
            "or a rotation vector"
        )
    squares = np.array(
        [
            1 + turned[0, 0] + turned[1, 1] + turned[2, 2],
            1 + turned[0, 0] - turned[1, 1] - turned[2, 2],
            1 - turned[0, 0] + turned[1, 1] - turned[2, 2],
            1 - turned[0, 0] - turned[1, 1] + turned[2, 2],
        ]
    )
    largest = int(np.argmax(squares))
    twice = math.sqrt(squares[largest])
    a, b, c = (
        turned[2, 1] - turned[1, 2],
        turned[0, 2] - turned[2, 0],
        turned[1, 0] - turned[0, 1],
    )
    d, e, f = (
        turned[0, 1] + turned[1, 0],
        turned[0, 2] + turned[2, 0],
        turned[1, 2] + turned[2, 1],
    )
    rows = (
        (twice * twice, a, b, c),
        (a, twice * twice, d, e),
        (b, d, twice * twice, f),
        (c, e, f, twice * twice),
    )
    turn = np.array(rows[largest]) / (2.0 * twice)
    turn = turn if turn[0] >= 0.0 else -turn
    return np.asarray(turn / np.linalg.norm(turn))
