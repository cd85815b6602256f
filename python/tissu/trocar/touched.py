"""What of the tissue is under a tool: places, normals, forces, and how far they give way."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.sparse import csc_array
from scipy.sparse.linalg import splu

if TYPE_CHECKING:
    from tissu.simulation import Simulation
    from tissu.trocar.kinematics import Array

APART = 2e-3
"""m: contacts nearer to each other than this become one."""
ENOUGH, REFINED = 1e-3, 4
"""relative residual of a compliance, and refinements before a factor is made anew"""
REACH = 10e-3
"""m before the tool in which tissue that is not touched yet is handed to the ticks."""


@dataclass(slots=True)
class Touched:
    """A place of the tissue under the tool; in the scene's axes."""

    body: str
    nodes: Array
    weights: Array
    point: Array
    normal: Array
    force: Array
    friction: float
    gap: float


def pressing(simulation: Simulation, tool: str) -> list[Touched]:
    """What presses on the tool."""
    found = simulation.contacts()
    number = found.surfaces.index(tool)
    kept = []
    for i in np.flatnonzero((found.pairs == number).any(axis=1)):
        first = found.pairs[i, 0] == number
        body = found.surfaces[found.pairs[i, 1 if first else 0]]
        if body not in simulation.positions:
            continue
        side = (found.weights[i] < 0.0) if first else (found.weights[i] > 0.0)
        side &= found.nodes[i] >= 0
        nodes, weights = found.nodes[i][side], np.abs(found.weights[i][side])
        sign = 1.0 if first else -1.0
        kept.append(
            Touched(
                body=body,
                nodes=nodes,
                weights=weights / weights.sum(),
                point=found.points[i] if first else facing(simulation, tool, found.points[i]),
                normal=sign * found.normals[i],
                force=sign * found.forces[i],
                friction=friction_between(simulation, body, tool),
                gap=0.0,
            )
        )
    return kept


def facing(simulation: Simulation, tool: str, point: Array) -> Array:
    """The point of the tool's surface that is nearest to a place."""
    surface = simulation.obstacle_surface(tool).points
    return np.asarray(surface[np.argmin(((surface - point) ** 2).sum(axis=1))])


def nearest(simulation: Simulation, tool: str) -> list[Touched]:
    """The node that is nearest to the tool's surface, where nothing presses yet."""
    best: Touched | None = None
    surface = simulation.obstacle_surface(tool).points
    for name in simulation.touching:
        if name not in simulation.positions or friction_between(simulation, name, tool) < 0.0:
            continue
        places = simulation.positions[name]
        middle = surface.mean(axis=0)
        close = np.argsort(((places - middle) ** 2).sum(axis=1))[:64]
        apart = places[close][:, None] - surface[None]
        square = (apart**2).sum(axis=2)
        i, k = np.unravel_index(np.argmin(square), square.shape)
        gap = float(np.sqrt(square[i, k]))
        if not 0.0 < gap < REACH or (best is not None and best.gap <= gap):
            continue
        best = Touched(
            body=name,
            nodes=np.array([close[i]]),
            weights=np.ones(1),
            point=surface[k],
            normal=-apart[i, k] / gap,
            force=np.zeros(3),
            friction=friction_between(simulation, name, tool),
            gap=gap,
        )
    return [] if best is None else [best]


def friction_between(simulation: Simulation, body: str, tool: str) -> float:
    """Of the contact between them; below 0: they do not meet."""
    named, every = None, None
    for contact in simulation.scene.contacts:
        if getattr(contact, "between", None) == "all":
            every = contact.friction
        elif hasattr(contact, "pairs"):
            for _, one, _, other in contact.pairs():
                if {one, other} == {body, tool}:
                    named = contact.friction
    return named if named is not None else every if every is not None else -1.0


def merged(touched: list[Touched], most: int) -> list[Touched]:
    """At most so many places; what is near another one, or one too many, adds its force to it."""
    kept: list[Touched] = []
    for one in sorted(touched, key=lambda place: -float(np.linalg.norm(place.force))):
        ways = [float(np.linalg.norm(other.point - one.point)) for other in kept]
        if kept and (min(ways) < APART or len(kept) == most):
            heir = kept[int(np.argmin(ways))]
            heir.force = heir.force + one.force
        else:
            kept.append(one)
    return kept


class Factor:
    """Of the matrix of a step, kept while it serves.

    Solves with an earlier matrix's factor are corrected by the residual (iterative refinement).
    Where corrections do not shrink soon, the matrix is factored anew.
    """

    def __init__(self) -> None:
        """None yet."""
        self._kept: Any = None
        self.made = 0

    def solve(self, A: Any, B: Array) -> Array:
        """A^-1 B, to a relative residual of a thousandth in every column at most."""
        if self._kept is not None and self._kept.shape == A.shape:
            X = self._kept.solve(B)
            for _ in range(REFINED):
                left = B - A @ X
                if (np.linalg.norm(left, axis=0) <= ENOUGH * np.linalg.norm(B, axis=0)).all():
                    return np.asarray(X)
                X = X + self._kept.solve(left)
        self._kept = splu(
            csc_array(A),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
        self.made += 1
        return np.asarray(self._kept.solve(B))


def compliance(
    simulation: Simulation, kept: list[Touched], directions: Array, factor: Factor
) -> Array:
    """W (3m, 3m) of the tissue's points along directions (m, 3, 3) of the scene [m/N]."""
    h = simulation.dt
    matrix = simulation.mass_matrix() + h * simulation.damping() + h**2 * simulation.stiffness()
    free = np.flatnonzero(simulation.free_axes())
    H = np.zeros((3 * len(kept), matrix.shape[0]))
    for i, one in enumerate(kept):
        first = simulation.rows(one.body).start
        for node, weight in zip(one.nodes, one.weights, strict=True):
            column = 3 * (first + int(node))
            H[3 * i : 3 * i + 3, column : column + 3] += weight * directions[i]
    H = H[:, free]
    W = h**2 * H @ factor.solve(csc_array(matrix)[free][:, free], np.ascontiguousarray(H.T))
    return np.asarray(0.5 * (W + W.T))
