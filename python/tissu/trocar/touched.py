"""What of the tissue is under a tool: places, normals, forces, and how far they give way."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from tissu.simulation import Simulation
    from tissu.simulation.compliance import Compliance
    from tissu.trocar.kinematics import Array

APART = 2e-3
"""m: contacts nearer to each other than this become one, if they press the same way."""
TURNED = 0.35
"""rad between the normals of contacts that press the same way, as a chord: 20 degrees"""
_PLACES = 8
"""times as many places as are kept, of which the most alike become one"""
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
    """At most so many places, which bear the same force together.

    Contacts become one where they are near each other and press the same way. Contacts that press
    from different sides stay apart however near they are: of two walls of a pit neither bears what
    the other does. Where too many are left, the two that are most alike become one, and so on.
    """
    kept: list[Touched] = []
    for one in sorted(touched, key=lambda place: -float(np.linalg.norm(place.force))):
        unlike = _unlike(one, kept)
        if kept and (unlike.min() < 1.0 or len(kept) == _PLACES * most):
            heir = int(np.argmin(unlike))
            kept[heir] = _joined(kept[heir], one)
        else:
            kept.append(one)
    if len(kept) <= most:
        return kept
    unlike = np.array([_unlike(one, kept) for one in kept])
    np.fill_diagonal(unlike, np.inf)
    while len(kept) > most:
        first, second = sorted(int(k) for k in np.unravel_index(unlike.argmin(), unlike.shape))
        kept[first] = _joined(kept[first], kept.pop(second))
        unlike = np.delete(np.delete(unlike, second, axis=0), second, axis=1)
        unlike[first] = unlike[:, first] = _unlike(kept[first], kept)
        unlike[first, first] = np.inf
    return kept


def _unlike(one: Touched, others: list[Touched]) -> Array:
    """How far each of the others (n,) is from being the same contact, for which it is below 1."""
    apart = np.array([other.point - one.point for other in others]).reshape(-1, 3)
    turned = np.array([other.normal - one.normal for other in others]).reshape(-1, 3)
    ways = np.linalg.norm(apart, axis=1) / APART, np.linalg.norm(turned, axis=1) / TURNED
    return np.asarray(np.maximum(*ways))


def _joined(one: Touched, other: Touched) -> Touched:
    """One place of two: the means of places and normals have the weights of what each bears."""
    bears = np.array([max(0.0, float(each.force @ each.normal)) for each in (one, other)])
    share = float(bears[0] / bears.sum()) if bears.sum() > 0.0 else 0.5
    normal = share * one.normal + (1.0 - share) * other.normal
    length = float(np.linalg.norm(normal))
    force = one.force + other.force
    if one.body != other.body or length < 0.1:
        # Neither a place between two bodies nor a way out between two walls: the stronger stays.
        return replace(one, force=force)
    nodes, at = np.unique(np.concatenate([one.nodes, other.nodes]), return_inverse=True)
    weights = np.concatenate([share * one.weights, (1.0 - share) * other.weights])
    return Touched(
        body=one.body,
        nodes=nodes,
        weights=np.asarray(np.bincount(at, weights, len(nodes)), dtype=float),
        point=share * one.point + (1.0 - share) * other.point,
        normal=normal / length,
        force=force,
        friction=one.friction,
        gap=share * one.gap + (1.0 - share) * other.gap,
    )


def compliance(found: Compliance, kept: list[Touched], directions: Array) -> Array:
    """W (3m, 3m) of the tissue's points along directions (m, 3, 3) of the scene [m/N]."""
    bodies = [one.body for one in kept]
    nodes, weights = [one.nodes for one in kept], [one.weights for one in kept]
    return found.of(bodies, nodes, weights, directions)
