"""Kinematics of the active trocar, in the frame of its port.

O is the pivot, e_Z points into the body, and q = (a, b, psi, r): pitch, roll, own rotation [rad]
and depth [m]. The tool's axis d, its tip p and the place x of a point l of the tool are

    s = (tan b, -tan a, 1)   n = |s|   d = s / n   p = r d
    R = R_Y(b) R_X(a') R_Z(psi),  tan a' = tan a cos b   x = R (l + r e_z)

and x. = J(x) q., with the axes that the three rotations turn about in the columns of Omega. The
torques of the motors that hold forces f at points x are tau = sum J(x)^T f.

This is the readable statement; `tissu._haptic` computes the same in C++.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from tissu.errors import ParameterError

AXES = 4
"""Pitch, roll, own rotation, depth. The grip is apart."""
NAMES = ("pitch", "roll", "rotation", "depth")
TILT_LIMIT = np.radians(75.0)
"""Largest pitch and roll that a scene may ask for [rad]; at 90 degrees the trocar is singular."""

Array = np.ndarray[tuple[int, ...], np.dtype[np.float64]]
Vector = Sequence[float] | Array


def _turn_x(angle: float) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def _turn_y(angle: float) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])


def _turn_z(angle: float) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def _cross(u: Vector, v: Vector) -> Array:
    return np.array(
        [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    )


def axis(q: Vector) -> Array:
    """Unit vector (3,) along the tool, from the pivot into the body."""
    s = np.array([np.tan(q[1]), -np.tan(q[0]), 1.0])
    return np.asarray(s / np.linalg.norm(s))


def rotation(q: Vector) -> Array:
    """Rotation (3, 3) from the tool to the port; its third column is axis(q)."""
    inner = np.arctan(np.tan(q[0]) * np.cos(q[1]))
    return np.asarray(_turn_y(q[1]) @ _turn_x(inner) @ _turn_z(q[2]))


def position(q: Vector, point: Vector = (0.0, 0.0, 0.0)) -> Array:
    """Place (3,) [m] in the port of a point of the tool; absent: the tip."""
    return np.asarray(rotation(q) @ (point[0], point[1], point[2] + q[3]))


def turning(q: Vector) -> Array:
    """Omega (3, 3): the angular velocity of the tool is Omega (a., b., psi.)."""
    tan_a, sin_b, cos_b = np.tan(q[0]), np.sin(q[1]), np.cos(q[1])
    D = 1.0 + (tan_a * cos_b) ** 2
    A, B = cos_b * (1.0 + tan_a**2) / D, -tan_a * sin_b / D
    e = np.array([cos_b, 0.0, -sin_b])  # R_Y(b) e_X, about which the inner angle turns
    return np.column_stack([A * e, np.array([0.0, 1.0, 0.0]) + B * e, axis(q)])


def jacobian(q: Vector, x: Vector) -> Array:
    """J (3, 4) at the place x (3,) [m] of a point of the tool, both in the port: x. = J q. ."""
    omega = turning(q)
    turns = [_cross(omega[:, k], x) for k in range(3)]
    return np.column_stack([*turns, omega[:, 2]])


def torques(q: Vector, points: Array, forces: Array) -> Array:
    """What the motors hold forces (n, 3) [N] at points (n, 3) [m] by: (4,) [N m, N m, N m, N]."""
    tau = np.zeros(AXES)
    for x, f in zip(np.reshape(points, (-1, 3)), np.reshape(forces, (-1, 3)), strict=True):
        tau += jacobian(q, x).T @ f
    return tau


def inverse(place: Vector, turn: Array, point: Vector = (0.0, 0.0, 0.0)) -> Array:
    """The q (4,) at which the tool has a rotation (3, 3) and a point of its axis a place (3,) [m].

    The point lies on the tool's axis: (0, 0, l_z).

    Raises:
        ParameterError: the tool does not point into the body, or a point beside the axis.
    """
    d = np.asarray(turn)[:, 2]
    if point[0] or point[1]:
        raise ParameterError(
            f"found the point ({point[0]:g}, {point[1]:g}, {point[2]:g}) off the tool's axis; "
            "a point of the axis is accepted, such as (0, 0, 0)"
        )
    if d[2] <= 0.0:
        raise ParameterError(
            f"found a tool along ({d[0]:g}, {d[1]:g}, {d[2]:g}), which does not point into the "
            "body; a direction with a positive component along the port's axis is accepted"
        )
    a, b = np.arctan2(-d[1], d[2]), np.arctan2(d[0], d[2])
    own = _turn_x(np.arctan(np.tan(a) * np.cos(b))).T @ _turn_y(b).T @ turn
    return np.array([a, b, np.arctan2(own[1, 0], own[0, 0]), d @ np.asarray(place) - point[2]])


def unwrapped(angle: float, before: float) -> float:
    """The own rotation [rad] nearest to the one before, of all that turn the tool alike."""
    return float(angle + 2.0 * np.pi * np.round((before - angle) / (2.0 * np.pi)))


def printed_torques(q: Vector, force: Vector) -> Array:
    """Pitch, roll and own torque of a force at the tip, as the thesis prints them: wrong.

    They (5.6, 5.10) are the components of the moment on the oblique basis (e_X, e_Y, e_r), not
    J^T f. Kept to show by how much.
    """
    d = axis(q)
    M = _cross(position(q), force)
    along = M[2] / d[2]
    return np.array([M[0] - along * d[0], M[1] - along * d[1], along])
