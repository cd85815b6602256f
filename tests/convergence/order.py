"""Solve a manufactured problem on a mesh and measure how far the solution is from the field.

The loads are consistent, int N_a b dV, by shape functions and quadrature that are not the
library's; so are the integrals of the errors. The library gets nodes, cells, nodal forces and
prescribed boundary nodes, and gives positions back.
"""

from dataclasses import dataclass

import numpy as np

import manufactured
from shape_basis import ORDER, cubature, family, shapes
from tissu import _core

NEWTON = 1e-11  # relative residual: far below any error measured here


@dataclass(frozen=True)
class Errors:
    """L2 norms over the unit cube: displacement [m], strain [1]; nodes for the record."""

    displacement: float
    strain: float
    nodes: int


class Integrals:
    """Places, gradients and weights of the oracle's quadrature points of all cells."""

    def __init__(self, mesh, cell):
        (block,) = mesh.volume_blocks
        self.cells = block.nodes
        points, weights = cubature(family(cell), 3 + (ORDER[cell] > 1))
        self.N, dN = shapes(cell, points)
        corners = mesh.points[self.cells]
        J = np.einsum("eai,gaj->egij", corners, dN)
        self.w = weights * np.linalg.det(J)
        assert self.w.min() > 0
        self.grad = np.einsum("gaj,egji->egai", dN, np.linalg.inv(J))
        self.X = np.einsum("ga,eai->egi", self.N, corners)

    def loads(self, body_force, count):
        parts = np.einsum("eg,ga,egi->eai", self.w, self.N, body_force(self.X))
        loads = np.zeros((count, 3))
        np.add.at(loads, self.cells, parts)
        return loads

    def norm(self, values):
        squares = (values**2).sum(axis=tuple(range(2, values.ndim)))
        return float(np.sqrt((self.w * squares).sum()))


def cube(mesh, law, parameters, quadrature="full"):
    """A builder with the mesh as body "cube", of one law and 1 kg/m3."""
    builder = _core.WorldBuilder()
    builder.add_body(name="cube", positions=mesh.points)
    first = 0
    for block in mesh.volume_blocks:
        builder.add_elastic(
            body="cube",
            cell_type=block.type,
            cells=block.nodes,
            cell_numbers=np.arange(first, first + len(block), dtype=np.int32),
            law=law,
            parameters={name: np.array([value]) for name, value in parameters.items()},
            density=np.array([1.0]),
            quadrature=quadrature,
        )
        first += len(block)
    return builder


def lead(builder, nodes, displacements):
    """Each node goes to a displacement of its own in the first second."""
    still = {"angles": np.zeros(2), "center": np.zeros(3), "axis": np.array([0.0, 0.0, 1.0])}
    for node in nodes:
        builder.prescribe(
            body="cube",
            nodes=np.array([node], dtype=np.int32),
            axes=7,
            times=np.array([0.0, 1.0]),
            displacements=np.stack([np.zeros(3), displacements[node]]),
            **still,
        )


def rested(builder):
    """The simulation in static equilibrium after one second, by Newton and the direct solver."""
    static = _core.Static(newton_iterations=20, newton_tolerance=NEWTON, load_steps=1)
    world = builder.build()
    simulation = _core.Simulation(world=world, integrator=static, solver=_core.Cholesky())
    report = simulation.step(1.0)
    assert report.converged, report.message
    return simulation


def on_faces(mesh):
    """Numbers of the nodes on the faces of the unit cube."""
    return np.flatnonzero(((mesh.points < 1e-9) | (mesh.points > 1 - 1e-9)).any(axis=1))


def errors(mesh, cell, law, name="smooth", quadrature="full"):
    """Of the computed solution against the manufactured one."""
    u, grad_u, body_force = manufactured.field(name, law)
    integrals = Integrals(mesh, cell)
    builder = cube(mesh, law, manufactured.PARAMETERS, quadrature)
    builder.add_load(
        name="b",
        body="cube",
        nodes=np.arange(mesh.node_count, dtype=np.int32),
        forces=integrals.loads(body_force, mesh.node_count),
        times=np.array([0.0]),
        factors=np.array([1.0]),
    )
    lead(builder, on_faces(mesh), u(mesh.points))
    found = rested(builder).positions - mesh.points
    of_cells = found[integrals.cells]
    u_h = np.einsum("ga,eai->egi", integrals.N, of_cells)
    grad_h = np.einsum("eai,egaj->egij", of_cells, integrals.grad)
    strain = manufactured.strain_of(law, grad_h) - manufactured.strain_of(law, grad_u(integrals.X))
    return Errors(
        displacement=integrals.norm(u_h - u(integrals.X)),
        strain=integrals.norm(strain),
        nodes=mesh.node_count,
    )


def orders(counts, values):
    """Observed orders between neighbouring refinements: log(e0/e1) / log(n1/n0)."""
    return np.diff(-np.log(values)) / np.diff(np.log(counts))
