"""Scenes with contact from which cells are removed while they run."""

import numpy as np

import tissu as ts
from contact_audit import damped
from tissu.compile.contact_surface import body_surface, edges_of

SIDE = 0.09
"""of the block [m], of three cells of 3 cm along each axis"""
GAP = 6e-4
"""[m]"""
TIP = 0.02
"""width of the tool [m]: it fits into the hole that one cell leaves"""
DEPTH = 0.005
"""to which it presses within 50 ms [m]"""


def block(**fields):
    """A block of 27 hexahedra, or of other cells, held at its bottom."""
    mesh = fields.pop("mesh", None) or ts.BarMesh(
        size=(SIDE, SIDE, SIDE), cells=(3, 3, 3), cell=fields.pop("cell", "hexahedron")
    )
    law = fields.pop("law", None) or ts.StableNeoHooke(young=2e4, poisson=0.4)
    return ts.Body(mesh=mesh, law=law, density=1000.0, viscosity=damped(), **fields)


def tool(middle=(SIDE / 2, SIDE / 2)):
    """A box that comes down on a place of the top."""
    x, y = middle
    down = ts.Motion(times=(0, 0.05), displacements=((0, 0, 0), (0, 0, -DEPTH - 2 * GAP)))
    low, high = (x - TIP / 2, y - TIP / 2, SIDE + 2 * GAP), (x + TIP / 2, y + TIP / 2, 2 * SIDE)
    return ts.BoxObstacle(low, high, motion=down)


def pressed(step=None, *, body=None, **fields):
    """The tool presses on the middle of the block."""
    static = isinstance(step, ts.Static)
    one = body or block()
    given = {
        "bodies": {"block": one.replace(viscosity=None) if static else one},
        "obstacles": {"tool": tool()},
        "contacts": [ts.Contact(("block", "tool"), friction=0.3, gap=GAP)],
        "fixed": [ts.Fixed("block", on=ts.Plane(point=(0, 0, 0), normal=(0, 0, 1)))],
        "step": step or ts.ImplicitEuler("5 ms"),
        "editing": True,
    }
    return ts.Scene(**(given | fields))


def cells_at(simulation, low, high, body="block"):
    """Numbers of the cells of a body whose middle lies in a box, of those it was compiled with."""
    mesh = simulation.scene.bodies[body].mesh
    mesh = mesh.mesh() if hasattr(mesh, "mesh") else mesh
    middles = np.concatenate([mesh.points[b.nodes].mean(axis=1) for b in mesh.volume_blocks])
    inside = ((middles > low) & (middles < high)).all(axis=1)
    return np.flatnonzero(inside)


def top_middle(simulation):
    """The cells under the tool."""
    third = SIDE / 3
    return cells_at(simulation, (third, third, 2 * third), (2 * third, 2 * third, SIDE))


def is_there(simulation, body="block"):
    """Of each contact: whether what it has of a body is a part of the surface of its cells now."""
    surface = body_surface(simulation.meshes[body], simulation.scene.bodies[body])
    faces = {frozenset(t) for t in surface.triangles.tolist()}
    edges = {frozenset(e) for e in edges_of(surface.triangles).tolist()}
    nodes = {frozenset([n]) for n in surface.nodes.tolist()}
    parts = faces | edges | nodes
    found = simulation.contacts()
    number = found.surfaces.index(body)
    own = np.where(found.weights > 0.0, found.pairs[:, [0]], found.pairs[:, [1]]) == number
    own &= found.nodes >= 0
    return np.array(
        [frozenset(row[mine].tolist()) in parts for row, mine in zip(found.nodes, own, strict=True)]
    )
