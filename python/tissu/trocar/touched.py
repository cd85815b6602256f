"""What of the tissue is under a tool: places, normals, forces, and how far they give way."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from tissu.simulation import Simulation
    from tissu.simulation.compliance import Compliance
    from tissu.trocar.kinematics import Array

APART = 2e-3
"""m: contacts nearer to each other than this become one."""
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
    places: Array | None = None
    for i in np.flatnonzero((found.pairs == number).any(axis=1)):
        first = found.pairs[i, 0] == number
        body = found.surfaces[found.pairs[i, 1 if first else 0]]
        if body not in simulation.positions:
            continue
        side = (found.weights[i] < 0.0) if first else (found.weights[i] > 0.0)
        side &= found.nodes[i] != -1
        points, shares = found.nodes[i][side], np.abs(found.weights[i][side])
        nodes, weights = simulation._spread_over_nodes(body, points, shares)
        sign = 1.0 if first else -1.0
        if not first and places is None:
            places = simulation.obstacle_surface(tool).points
        kept.append(
            Touched(
                body=body,
                nodes=nodes,
                weights=weights / weights.sum(),
                point=found.points[i]
                if places is None or first
                else facing(places, found.points[i]),
                normal=sign * found.normals[i],
                force=sign * found.forces[i],
                friction=friction_between(simulation, body, tool),
                gap=0.0,
            )
        )
    return kept


def facing(places: Array, point: Array) -> Array:
    """The one of the tool's places (n, 3) that is nearest to a point."""
    return np.asarray(places[np.argmin(((places - point) ** 2).sum(axis=1))])


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


def met_by(simulation: Simulation, tools: list[str]) -> list[str]:
    """Bodies of nodes that meet one of the tools."""
    return [
        name
        for name in simulation.touching
        if name in simulation.positions
        and any(friction_between(simulation, name, tool) >= 0.0 for tool in tools)
    ]


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


def compliance(found: Compliance, kept: list[Touched], directions: Array) -> Array:
    """W (3m, 3m) of the tissue's points along directions (m, 3, 3) of the scene [m/N]."""
    bodies = [one.body for one in kept]
    nodes, weights = [one.nodes for one in kept], [one.weights for one in kept]
    return found.of(bodies, nodes, weights, directions)
