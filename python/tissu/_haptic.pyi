"""Types of the compiled haptic library. Every argument is in SI units; arrays are copied in and out.

q is (4,): pitch a, roll b, own rotation psi [rad], depth r [m]. The port's frame has its origin in the
pivot and its third axis into the body. A test holds this file against the module.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

def rotation(q: ArrayLike) -> Floats:
    """R (3, 3), which turns the tool's axes into the port's."""

def point(q: ArrayLike, l: ArrayLike) -> Floats:
    """Where the tool's point l (3,) [m] is, (3,) [m]."""

def jacobian(q: ArrayLike, l: ArrayLike) -> Floats:
    """J (3, 4) with v = J dq/dt for the tool's point l; the torques of a force f there are J^T f."""

def turns(q: ArrayLike) -> Floats:
    """Omega (3, 3): the tool's angular velocity is Omega (da/dt, db/dt, dpsi/dt)."""

def joints_of(*, R: ArrayLike, x: ArrayLike, l: ArrayLike) -> Floats:
    """q at which the tool's axes are those of R (3, 3) and its point l is at x."""

def axis_torques(q: ArrayLike, f: ArrayLike) -> Floats:
    """Torques (4,) of a force f (3,) [N] on the tool's axis at depth r, in closed form."""

def unwrapped(psi: float, before: float) -> float:
    """psi and whole turns, within half a turn of `before` [rad]."""

class Fulcrum:
    """An arm that measures and pushes a point in three directions, as a trocar without own rotation."""

    def __init__(self, least_depth: float = 0.02) -> None: ...
    def joints(self, p: ArrayLike) -> Floats:
        """q of a tip at p (3,) [m], with psi = 0."""

    def force(self, q: ArrayLike, tau: ArrayLike) -> Floats:
        """J^-T tau, the force (3,) [N] that the arm gives; 0 nearer to the pivot than the least depth."""
