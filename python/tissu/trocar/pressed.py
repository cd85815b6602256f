"""How far a tool goes that a hand pushes harder than the device may push back."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu.trocar import kinematics
from tissu.trocar.patch import Block, Patch

if TYPE_CHECKING:
    from tissu.scene.trocar.limits import TrocarLimits
    from tissu.trocar.kinematics import Array
    from tissu.trocar.model import LocalModel

_SWEEPS = 30
_HALVINGS = 10
_BLIND = 5e-3
"""m of the tip in a step where no tissue is near"""


class Pressing:
    """The tissue under a tool, as its model has it: forces at any joints of the tool."""

    def __init__(self, model: LocalModel, stiffness: Array, limits: TrocarLimits) -> None:
        """Of a model; K_c (4,) of the coupling."""
        count = len(model.friction)
        G, g0 = model.rows()
        self._G, self._g0, self._W = G[: 3 * count], g0[: 3 * count], model.settled()
        self._cones = [Block("cone", 3 * k, float(model.friction[k])) for k in range(count)]
        self._model, self._stiffness, self._limits = model, stiffness, limits

    def held(self, before: Array, wanted: Array) -> Array:
        """Joints (4,) between those of the last step and those wanted, within the limits.

        They are the last on the way at which the tissue pushes no harder than the limits allow.
        Where it does so at once, the tool goes back: along u = K_c^-1 tau a way of t u takes the
        share t (tau . u) / (lambda . W lambda) off the forces.
        """
        if not self._cones:
            way = kinematics.position(wanted) - kinematics.position(before)
            return before + min(1.0, _BLIND / max(float(np.linalg.norm(way)), _BLIND)) * (
                wanted - before
            )
        if self._over(wanted) <= 1.0:
            return wanted
        over = self._over(before)
        if over > 1.0:
            return self._back(before, over)
        low, high = 0.0, 1.0
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            if self._over(before + middle * (wanted - before)) <= 1.0:
                low = middle
            else:
                high = middle
        return before + low * (wanted - before)

    def _back(self, before: Array, over: float) -> Array:
        forces = self._forces(before)
        torque = self._G.T @ forces
        u = torque / self._stiffness
        share = (1.0 - 1.0 / over) * float(forces @ self._W @ forces) / float(torque @ u)
        return np.asarray(before + share * u)

    def _forces(self, q: Array) -> Array:
        """Of the tissue on a tool at these joints, whatever holds it."""
        gaps = self._g0 + self._G @ (q - self._model.joints)
        patch = Patch(gaps, self._W, self._cones)
        return patch.solve(np.ravel(self._model.forces), sweeps=_SWEEPS, tolerance=1e-4)[0]

    def _over(self, q: Array) -> float:
        """The torques of the tissue over what all limits allow."""
        torque = self._G.T @ self._forces(q)
        J = kinematics.jacobian(q, kinematics.position(q))
        force = float(np.linalg.norm(np.linalg.lstsq(J.T, torque, rcond=None)[0]))
        shares = np.abs(torque) / self._limits.torques()
        return max(float(shares.max()), force / self._limits.force)
