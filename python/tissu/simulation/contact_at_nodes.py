"""Pressure and gap of contacts at the nodes of a body, and at the vertices of its surface."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from tissu.simulation.touched import Contacts

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

FAR = 1e30
"""m: the gap of a node that no contact has."""


class ContactAtNodes(NamedTuple):
    """Pressure and gap of the contacts at the nodes of a body.

    Attributes:
        pressure: normal force on the node over its area of the surface at rest (n,) [Pa]; 0 where
            nothing presses, and at nodes that have no area, such as those of lines.
        gap: the least gap of the contacts that the node is a part of (n,) [m]; 1e30 for a node
            without contact.
    """

    pressure: Floats
    gap: Floats


class Riders(NamedTuple):
    """Points of a surface that nodes carry.

    Attributes:
        numbers: as contacts have them (p,), ascending.
        begin: first of each in the lists (p + 1,).
        nodes: that carry it.
        weights: of these, which sum to one for each point.
    """

    numbers: Ints
    begin: Ints
    nodes: Ints
    weights: Floats

    def shared(self, points: Ints, shares: Floats) -> tuple[Ints, Ints, Floats]:
        """The place of each share, its node, and its part: of points (k,) with shares (k,)."""
        place = np.searchsorted(self.numbers, points)
        rides = place < len(self.numbers)
        rides[rides] = self.numbers[place[rides]] == points[rides]
        own = np.flatnonzero(~rides).astype(np.int32)
        counts = np.diff(self.begin)[place[rides]]
        of = np.repeat(np.flatnonzero(rides), counts).astype(np.int32)
        first = np.repeat(self.begin[place[rides]] - np.cumsum(counts) + counts, counts)
        item = first + np.arange(len(of))
        return (
            np.concatenate([own, of]),
            np.concatenate([points[own], self.nodes[item]]),
            np.concatenate([shares[own], self.weights[item] * shares[of]]),
        )


def contact_at_nodes(
    contacts: Contacts, body: str, areas: Floats, riders: Riders
) -> ContactAtNodes:
    """Shares of all contacts with a body at its nodes.

    A contact gives each of its nodes the share |weight| of its normal force. A point that nodes
    carry gives them its share by the sizes of their weights, as it gives them its area.

    Args:
        contacts: as `Simulation.contacts` gives them.
        body: name of the body.
        areas: of the surface at rest, at each node (n,) [m2].
        riders: points of the surface that nodes carry.
    """
    row, points, shares = _shares(contacts, body)
    sizes = riders._replace(weights=np.abs(riders.weights))
    of, nodes, shares = sizes.shared(points, shares)
    return _summed(contacts, areas, row[of], nodes, shares)


def contact_at_vertices(
    contacts: Contacts, body: str, vertices: Ints, areas: Floats
) -> ContactAtNodes:
    """Shares of all contacts with a body at the vertices of its surface, whatever carries them.

    Args:
        contacts: as `Simulation.contacts` gives them.
        body: name of the body.
        vertices: of its surface (n,), ascending, by the numbers that contacts have.
        areas: at each vertex at rest (n,) [m2].
    """
    row, points, shares = _shares(contacts, body)
    places = np.searchsorted(vertices, points).astype(np.int32)
    return _summed(contacts, areas, row, places, shares)


def vertex_areas(triangles: Ints, rest: Floats) -> Floats:
    """A third of the area of the triangles (t, 3) around each vertex, at rest (n, 3) [m2]."""
    a, b, c = (rest[triangles[:, k]] for k in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 6.0
    found = np.bincount(triangles.ravel(), np.repeat(areas, 3), minlength=len(rest))
    return np.asarray(found, dtype=np.float64)


def _shares(contacts: Contacts, body: str) -> tuple[Ints, Ints, Floats]:
    """Contact, vertex of the body and share |weight| of each part of a body in a contact."""
    number = contacts.surfaces.index(body)
    # Nodes of a positive weight belong to the first of the pair, others to the other one.
    of_first = contacts.pairs[:, [0]] == number
    of_other = contacts.pairs[:, [1]] == number
    mine = np.where(contacts.weights > 0.0, of_first, of_other) & (contacts.nodes != -1)
    mine &= contacts.weights != 0.0
    row, _ = np.nonzero(mine)
    return row.astype(np.int32), contacts.nodes[mine], np.abs(contacts.weights[mine])


def _summed(
    contacts: Contacts, areas: Floats, row: Ints, places: Ints, shares: Floats
) -> ContactAtNodes:
    force, gap = np.zeros(len(areas)), np.full(len(areas), FAR)
    normal = np.einsum("ij,ij->i", contacts.forces, contacts.normals)
    np.add.at(force, places, shares * normal[row])
    np.minimum.at(gap, places, contacts.gaps[row])
    pressure = np.zeros(len(areas))
    np.divide(force, areas, out=pressure, where=areas > 0.0)
    return ContactAtNodes(pressure, gap)
