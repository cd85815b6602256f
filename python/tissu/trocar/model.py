"""What the ticks know of the tissue until the next model comes: a few contacts, how far they give.

A contact is a point of the tool and the place where the tissue's point would be without any force;
under the forces lambda on the tool the tissue's points are at anchors - W lambda.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from tissu import units
from tissu.arrays import real_array
from tissu.errors import ParameterError
from tissu.reading import Number, written
from tissu.trocar import kinematics
from tissu.trocar.kinematics import AXES, Array, Vector

MOST_CONTACTS = 8


@dataclass(frozen=True, slots=True)
class Blade:
    """The resistance of a blade along its path: |force| <= limit.

    Attributes:
        point: (3,) of the tool, in its axes [m].
        way: (3,) unit vector of its motion, in the port.
        anchor: (3,) where the cut ends now, in the port [m].
        compliance: of the tissue along the way [m/N].
        limit: toughness times the width that it cuts [N].
    """

    point: Vector
    way: Vector
    anchor: Vector
    compliance: float
    limit: float


def _empty(*shape: int) -> Array:
    return np.zeros(shape)


@dataclass(frozen=True, slots=True)
class LocalModel:
    """Contacts of a tool, at most eight. Places and directions are in the port's axes.

    Attributes:
        joints: (4,) q of the tool at which the model was made: of the proxy, not of the device.
        points: (m, 3) points of the tool, in its axes, the tip at 0 [m].
        anchors: (m, 3) places of the tissue's points without any of the forces [m].
        normals: (m, 3) unit vectors out of the tissue.
        tangents: (m, 3) unit vectors across them; the third direction is normal x tangent.
        friction: (m,) Coulomb's coefficients.
        forces: (m, 3) of the slow step, along normal and tangents: where ticks begin [N].
        compliance: W (3m, 3m) [m/N], rows normal, tangent, normal x tangent of each contact.
        tag: of the tool; None: of the tool in the device.
        blade: the resistance of a blade, if there is one.
    """

    joints: Vector
    points: Array = field(default_factory=lambda: _empty(0, 3))
    anchors: Array = field(default_factory=lambda: _empty(0, 3))
    normals: Array = field(default_factory=lambda: _empty(0, 3))
    tangents: Array = field(default_factory=lambda: _empty(0, 3))
    friction: Array = field(default_factory=lambda: _empty(0))
    forces: Array = field(default_factory=lambda: _empty(0, 3))
    compliance: Array = field(default_factory=lambda: _empty(0, 0))
    tag: int | None = None
    blade: Blade | None = None

    @staticmethod
    def plane(
        joints: Vector,
        *,
        through: Vector,
        normal: Vector,
        stiffness: Number,
        friction: Number = 0.0,
        point: Vector = (0.0, 0.0, 0.0),
    ) -> LocalModel:
        """A plane that gives way like a spring in every direction, under one point of the tool.

        Args:
            joints: (4,) q of the tool now.
            through: (3,) a point of the plane, in the port [m].
            normal: (3,) out of the solid half, of any length but zero.
            stiffness: of the springs [N/m]; inf: the plane does not give way.
            friction: Coulomb's coefficient.
            point: (3,) of the tool that meets it, in the tool's axes [m]; absent: the tip.

        Raises:
            ParameterError: a normal without length, a stiffness that is not above 0, or a value
                that is not a number.
        """
        q = _finite(joints, AXES, "joints")
        n, on, own = (
            _finite(value, 3, what)
            for value, what in (
                (normal, "normal"),
                (through, "point of the plane"),
                (point, "point"),
            )
        )
        if not np.linalg.norm(n) > 0.0:
            text = "found a normal without length; a direction out of the solid half is accepted"
            raise ParameterError(text)
        stiff = stiffness if stiffness == np.inf else units.STIFFNESS(stiffness)
        if not stiff > 0.0:
            text = f"found a stiffness of {stiff:g} N/m; one above 0 is accepted"
            raise ParameterError(text)
        n = n / np.linalg.norm(n)
        at = kinematics.position(q, own)
        anchor = at - ((at - on) @ n) * n
        return LocalModel(
            joints=q,
            points=own[None],
            anchors=anchor[None],
            normals=n[None],
            tangents=across(n)[None],
            friction=np.array([units.NUMBER(friction)]),
            forces=np.zeros((1, 3)),
            compliance=np.eye(3) / stiff,
        )

    def rows(self) -> tuple[Array, Array]:
        """G (n, 4) of the contacts and the blade at the model's joints, and g0 (n,) [m]."""
        G, g0 = [], []
        for point, anchor, D in zip(self.points, self.anchors, self.directions(), strict=True):
            x = kinematics.position(self.joints, point)
            G.append(D @ kinematics.jacobian(self.joints, x))
            g0.append(D @ (x - anchor))
        if self.blade is not None:
            x = kinematics.position(self.joints, self.blade.point)
            way = np.asarray(self.blade.way, dtype=float)
            G.append((way @ kinematics.jacobian(self.joints, x))[None])
            g0.append(np.array([way @ (x - np.asarray(self.blade.anchor))]))
        return np.reshape(np.concatenate([_empty(0, AXES), *G]), (-1, AXES)), np.concatenate(
            [_empty(0), *g0]
        )

    def directions(self) -> Array:
        """(m, 3, 3): normal, tangent and normal x tangent of each contact, in rows."""
        n, t = np.reshape(self.normals, (-1, 3)), np.reshape(self.tangents, (-1, 3))
        return np.stack([n, t, np.cross(n, t)], axis=1)

    def settled(self) -> Array:
        """W, symmetric, with 1e-9 of its trace on the diagonal: definite despite round-off."""
        W = 0.5 * (self.compliance + self.compliance.T)
        return np.asarray(W + 1e-9 * np.trace(W) * np.eye(len(W)))


def _finite(values: Vector, count: int, what: str) -> Array:
    """So many finite numbers."""
    found = real_array(values, f"the {what}").astype(float)
    if found.shape != (count,) or not np.isfinite(found).all():
        text = f"found the {what} {written(values)}; {count} finite numbers are accepted"
        raise ParameterError(text)
    return found


def across(normal: Vector) -> Array:
    """A unit vector (3,) across a unit vector."""
    n = np.asarray(normal, dtype=float)
    other: Sequence[float] = (1.0, 0.0, 0.0) if abs(n[0]) < 0.9 else (0.0, 1.0, 0.0)
    t = np.cross(n, np.cross(other, n))
    return np.asarray(t / np.linalg.norm(t))
