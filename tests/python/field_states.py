"""Homogeneous states for the tests of fields, and the stress that follows from their energy."""

import numpy as np

import tissu as ts

HEXAHEDRA = ("hexahedron", "hexahedron20", "hexahedron27")
VOLUMES = ("tetra", "tetra10", *HEXAHEDRA, "wedge", "wedge15", "pyramid", "pyramid13")
SHEETS = ("triangle", "triangle6", "quad", "quad8", "quad9")
LINES = ("line", "line3")
LAWS = {
    "hooke": ts.Hooke(young=3e4, poisson=0.3),
    "stvk": ts.StVK(young=3e4, poisson=0.3),
    "neo_hooke": ts.NeoHooke(young=3e4, poisson=0.3),
    "stable_neo_hooke": ts.StableNeoHooke(young=3e4, poisson=0.3),
    "mooney_rivlin": ts.MooneyRivlin(c1=4e3, c2=1e3, kappa=5e4),
    "yeoh": ts.Yeoh(c1=5e3, c2=200.0, c3=10.0, kappa=5e4),
    "arruda_boyce": ts.ArrudaBoyce(mu=9e3, lambda_m=1.8, kappa=5e4),
    # Stretched in every state below: where they go slack their stress has a kink.
    "fibres": ts.NeoHooke(
        young=3e4, poisson=0.3, fibres=ts.Fibres(k1=5e3, k2=0.5, direction=(0.8, 0.6, 0))
    ),
}
TURN = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
STATES = {
    "stretch": np.diag([1.1, 0.95, 1.02]),
    "shear": np.array([[1, 0.2, 0], [0, 1, 0], [0, 0, 1.0]]),
    "turned": TURN @ np.array([[1.1, 0.1, 0], [0.05, 0.97, 0.1], [0, -0.1, 1.03]]),
}
STEP = ts.ImplicitEuler("1 ms")


def body_of(cell, law, **fields):
    """A body of a few cells of 0.2 x 0.1 x 0.1 m, flat or on a line where the cell is."""
    size, cells = (0.2, 0.1, 0.1), (2, 1, 1)
    if cell in SHEETS:
        size, cells, fields = (0.2, 0.1, 0), (2, 1, 0), {"thickness": 0.01, **fields}
    if cell in LINES:
        size, cells, fields = (0.2, 0, 0), (2, 0, 0), {"section": 1e-4, **fields}
    mesh = ts.BarMesh(size=size, cells=cells, cell=cell)
    return ts.Body(mesh=mesh, law=law, density=1e3, **fields)


def simulation_of(body):
    """The body alone, free in space."""
    return ts.Scene(bodies={"b": body}, step=STEP).compile()


def put(simulation, F):
    """Every node of the body where F takes it; returns F for arrays of it."""
    simulation.positions["b"][:] = simulation.meshes["b"].points @ np.asarray(F).T
    return np.asarray(F)


def stress_of_energy(simulation, F, volume, h=1e-5):
    """P = dW/dF [Pa] by central differences of the energy of the whole body.

    Their error, h^2 of the third derivative and round-off over h, is below 1e-7 of P here.
    """
    P = np.zeros((3, 3))
    for i, j in np.ndindex(3, 3):
        for sign in (1, -1):
            near = np.array(F)
            near[i, j] += sign * h
            put(simulation, near)
            P[i, j] += sign * simulation.energy()["elastic"] / (2 * h * volume)
    put(simulation, F)
    return P


def von_mises(sigma):
    """By the six components, as textbooks have it."""
    a, b, c = sigma[..., 0, 0], sigma[..., 1, 1], sigma[..., 2, 2]
    shear = sigma[..., 0, 1] ** 2 + sigma[..., 1, 2] ** 2 + sigma[..., 2, 0] ** 2
    return np.sqrt(((a - b) ** 2 + (b - c) ** 2 + (c - a) ** 2) / 2 + 3 * shear)
