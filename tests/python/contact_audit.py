"""Runs with contact in which the exact audit is asked at every step."""

import numpy as np

import tissu as ts

GRAVITY = 9.81
"""[m/s2]"""


def audited(simulation, steps):
    """Take so many steps; none may leave a crossing, and all converge. The latest report."""
    for _ in range(steps):
        report = simulation.step()
        assert simulation.crossings() == [], report
        assert report.converged, report
    return report


def block(origin=(0, 0, 0), *, size=(0.1, 0.1, 0.1), cells=(2, 2, 2), young=1e5, **fields):
    """A body of 1 t/m3, hexahedra of StVK with nu = 0.3."""
    mesh = fields.pop("mesh", None) or ts.BarMesh(
        size=size, cells=cells, cell=fields.pop("cell", "hexahedron"), origin=origin
    )
    law = fields.pop("law", None) or ts.StVK(young=young, poisson=0.3)
    return ts.Body(mesh=mesh, law=law, density=1000.0, **fields)


def damped(mass=5.0, stiffness=0.01):
    """What takes the swing after an impact."""
    return ts.Rayleigh(mass=mass, stiffness=stiffness)


def weight(size=(0.1, 0.1, 0.1)):
    """Of a block [N]."""
    return 1000.0 * GRAVITY * float(np.prod(size))


def between(simulation, first, second):
    """Sum of the contact forces (3,) on the first of two surfaces [N]."""
    found = simulation.contacts()
    a, b = found.surfaces.index(first), found.surfaces.index(second)
    straight = (found.pairs == [a, b]).all(axis=1)
    turned = (found.pairs == [b, a]).all(axis=1)
    return found.forces[straight].sum(axis=0) - found.forces[turned].sum(axis=0)
