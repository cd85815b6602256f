"""The hand of the browser: where a page wants the tool, by sliders, a gizmo or a gamepad."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.trocar import kinematics

if TYPE_CHECKING:
    from tissu.scene.trocar.limits import TrocarLimits
    from tissu.trocar.kinematics import Array, Vector

SPEED = 0.06
"""m/s of the tip at full deflection of a stick, sideways and in depth."""
TURN = np.pi / 2
"""rad/s of the own rotation at full deflection."""
DEAD = 0.1
"""Deflection of a stick that counts as none."""
SILENT = 0.3
"""s of wall time without a word of the gamepad after which it stands still."""


class BrowserHand:
    """Where a page wants the tool of one trocar.

    Attributes:
        joints: (4,) pitch, roll, own rotation [rad] and depth [m] that are wanted.
    """

    def __init__(self, limits: TrocarLimits, joints: Vector) -> None:
        """Want the tool where it is."""
        self._limits = limits
        self._sticks = np.zeros(4)
        self._heard = -np.inf
        self.to(joints)

    def to(self, joints: Vector) -> None:
        """Want these joints (4,), within the limits of the trocar."""
        q, limits = np.array(joints, dtype=float), self._limits
        q[:2] = np.clip(q[:2], -limits.tilt, limits.tilt)
        q[3] = np.clip(q[3], limits.least_depth, limits.depth)
        self.joints = q

    def to_tip(self, tip: Vector, turn: Array | None = None) -> None:
        """Want the tip at a place of the port (3,) [m], and the tool turned about its axis.

        Args:
            tip: place in the port's axes.
            turn: (3, 3) rotation from the tool to the port, of which the turn about the axis
                counts; absent: as it is.
        """
        x, y, z = np.asarray(tip, dtype=float)
        z = max(z, 1e-3)  # a tool points into the body
        a, b, r = np.arctan2(-y, z), np.arctan2(x, z), float(np.linalg.norm([x, y, z]))
        psi = self.joints[2]
        if turn is not None:
            own = kinematics.rotation((a, b, 0.0, r)).T @ turn
            angle = float(np.arctan2(own[1, 0] - own[0, 1], own[0, 0] + own[1, 1]))
            psi = kinematics.unwrapped(angle, psi)
        self.to((a, b, psi, r))

    def hear(self, sticks: Vector, now: float) -> None:
        """What a gamepad says.

        Args:
            sticks: (4,) from -1 to 1: the tip along the port's e_X and e_Y, depth, own rotation.
            now: wall time [s].
        """
        s = np.clip(np.asarray(sticks, dtype=float), -1.0, 1.0)
        self._sticks = np.sign(s) * np.maximum(np.abs(s) - DEAD, 0.0) / (1.0 - DEAD)
        self._heard = now

    def pass_time(self, seconds: float, now: float) -> None:
        """Go on as the gamepad says, for a simulated time [s]; `now` is wall time [s]."""
        if now - self._heard > SILENT or not self._sticks.any():
            return
        side_x, side_y, depth, turn = self._sticks
        q = self.joints.copy()
        tip = kinematics.position(q) + SPEED * seconds * np.array([side_x, side_y, 0.0])
        self.to_tip(tip)
        self.to(self.joints + seconds * np.array([0.0, 0.0, TURN * turn, SPEED * depth]))
