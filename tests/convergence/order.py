"""Solve a manufactured problem on a mesh and measure how far the solution is from the field.

The loads are consistent, int N_a b dV, by shape functions and quadrature that are not the
library's; so are the integrals of the errors. The library gets nodes, cells, nodal forces and
prescribed boundary nodes, and gives positions back.
"""

from dataclasses import dataclass

import numpy as np

import manufactured
from shape_basis import DIMENSION, ORDER, cubature, family, shapes
from tissu import _core

NEWTON = 1e-11  # relative residual: far below any error measured here
# Thickness [m] of surfaces, section [m2] of lines: not 1, so that it counts.
CROSS_SECTION = {"solid": 1.0, "plane strain": 0.3, "plane stress": 0.3, "uniaxial stress": 0.07}


@dataclass(frozen=True)
class Errors:
    """L2 norms over the unit cube, square or line: displacement [m], strain [1]; and the nodes."""

    displacement: float
    strain: float
    nodes: int


class Integrals:
    """Places, gradients and weights of the oracle's quadrature points of all cells."""

    def __init__(self, mesh, cell):
        (block,) = mesh.cells
        self.cells, d = block.nodes, DIMENSION[family(cell)]
        points, weights = cubature(family(cell), 3 + (ORDER[cell] > 1))
        self.N, dN = shapes(cell, points)
        corners = mesh.points[self.cells]
        J = np.einsum("eai,gaj->egij", corners[..., :d], dN[..., :d])
        self.w = weights * np.linalg.det(J)
        assert self.w.min() > 0
        self.grad = np.zeros((*self.w.shape, dN.shape[1], 3))
        self.grad[..., :d] = np.einsum("gaj,egji->egai", dN[..., :d], np.linalg.inv(J))
        self.X = np.einsum("ga,eai->egi", self.N, corners)

    def loads(self, body_force, count):
        parts = np.einsum("eg,ga,egi->eai", self.w, self.N, body_force(self.X))
        loads = np.zeros((count, 3))
        np.add.at(loads, self.cells, parts)
        return loads

    def norm(self, values):
        squares = (values**2).sum(axis=tuple(range(2, values.ndim)))
        return float(np.sqrt((self.w * squares).sum()))


def cube(mesh, law, parameters, quadrature="full", setting="solid"):
    """A builder with the mesh as body "cube", of one law and 1 kg/m3, held in line or plane."""
    builder = _core.WorldBuilder(threads=1, editable=False, grabbing=False, consistent_weight=False)
    builder.add_body(name="cube", positions=mesh.points, frames=False)
    first = 0
    for block in mesh.cells:
        builder.add_elastic(
            body="cube",
            cell_type=block.type,
            cells=block.nodes,
            cell_numbers=np.arange(first, first + len(block), dtype=np.int32),
            law=law,
            parameters={name: np.array([value]) for name, value in parameters.items()},
            density=np.array([1.0]),
            quadrature=quadrature,
            reinforcements=[],
            loaded=None,
            cross_section=np.array([CROSS_SECTION[setting]]),
            section=("round", [0.0] * 5, [0.0] * 3),
            plane=_core.Plane.strain if setting == "plane strain" else _core.Plane.stress,
            model=_core.FEM(),
        )
        first += len(block)
    across = 7 - _along(setting)
    if across:
        every = np.arange(mesh.node_count, dtype=np.int32)
        builder.fix(body="cube", nodes=every, axes=across, rotations=False, name="")
    return builder


def _along(setting):
    """Mask of the axes that a setting has: x is 1, y 2, z 4."""
    return 2 ** manufactured.SETTINGS[setting] - 1


def lead(builder, nodes, displacements, setting="solid"):
    """Each node goes to a displacement of its own in the first second."""
    still = {"angles": np.zeros(2), "center": np.zeros(3), "axis": np.array([0.0, 0.0, 1.0])}
    for node in nodes:
        builder.prescribe(
            body="cube",
            nodes=np.array([node], dtype=np.int32),
            axes=_along(setting),
            rotations=False,
            times=np.array([0.0, 1.0]),
            displacements=np.stack([np.zeros(3), displacements[node]]),
            name="",
            **still,
        )


def rested(builder):
    """The simulation in static equilibrium after one second, by Newton and the direct solver."""
    static = _core.Static(
        newton_iterations=20,
        newton_tolerance=NEWTON,
        load_steps=1,
        total_iterations=0,
        arc_length=False,
    )
    world = builder.build()
    simulation = _core.Simulation(world=world, integrator=static, solver=_core.Cholesky())
    report = simulation.step(1.0)
    assert report.converged, report.message
    return simulation


def on_faces(mesh, dimension=3):
    """Numbers of the nodes on the faces of the unit cube, edges of the square, ends of the line."""
    points = mesh.points[:, :dimension]
    return np.flatnonzero(((points < 1e-9) | (points > 1 - 1e-9)).any(axis=1))


def errors(mesh, cell, law, name="smooth", quadrature="full", setting="solid"):
    """Of the computed solution against the manufactured one."""
    u, grad_u, body_force = manufactured.field(name, law, setting)
    integrals = Integrals(mesh, cell)
    builder = cube(mesh, law, manufactured.PARAMETERS, quadrature, setting)
    builder.add_load(
        name="b",
        body="cube",
        nodes=np.arange(mesh.node_count, dtype=np.int32),
        forces=CROSS_SECTION[setting] * integrals.loads(body_force, mesh.node_count),
        times=np.array([0.0]),
        factors=np.array([1.0]),
        moments=False,
        faces=[],
        thickness=1.0,
        unit=np.zeros(3),
        along_normals=False,
    )
    boundary = on_faces(mesh, manufactured.SETTINGS[setting])
    lead(builder, boundary, u(mesh.points), setting)
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
