"""Manufactured solutions: a field u(X), and the body force that makes it an equilibrium.

Div P + b = 0, P from F = I + grad u. Everything is derived by SymPy from u and the energy.
"""

from functools import cache

import numpy as np
import sympy

X = sympy.symbols("X Y Z", real=True)
x, y, z = X
LAMBDA, MU = 1.2, 0.8  # Pa; E = 2.08 Pa, nu = 0.3
PARAMETERS = {
    "young": MU * (3 * LAMBDA + 2 * MU) / (LAMBDA + MU),
    "poisson": LAMBDA / (2 * (LAMBDA + MU)),
}

# No symmetry, no zero on the boundary, lengths of variation of the size of the box: strains of 0.2.
SMOOTH = (
    0.10 * sympy.sin(1.3 * x + 0.6 * y) + 0.06 * x * z,
    0.12 * sympy.cos(1.1 * y - 0.8 * z) * (0.5 + x),
    0.08 * sympy.exp(0.6 * z) * sympy.sin(x + 0.9 * y),
)
# Every quadratic term, each with a weight of its own.
QUADRATIC = (
    0.10 * x**2 - 0.07 * y * z + 0.05 * z**2 + 0.03 * x,
    0.08 * x * y + 0.06 * y**2 - 0.04 * z**2 + 0.02 * z,
    0.09 * z * x - 0.05 * x**2 + 0.07 * y * z + 0.03 * y**2,
)
FIELDS = {"smooth": SMOOTH, "quadratic": QUADRATIC}


def strain_of(law, G):
    """Hooke: the small strain; StVK: Green-Lagrange's; G = grad u (..., 3, 3)."""
    Gt = np.swapaxes(G, -1, -2)
    return (G + Gt) / 2 if law == "hooke" else (G + Gt + Gt @ G) / 2


@cache
def field(name, law):
    """Functions of points (n, 3): u (n, 3) [m], grad u (n, 3, 3), body force (n, 3) [N/m3]."""
    u = sympy.Matrix(FIELDS[name])
    G = u.jacobian(X)
    identity = sympy.eye(3)
    if law == "hooke":
        strain, front = (G + G.T) / 2, identity
    else:
        strain, front = (G + G.T + G.T * G) / 2, identity + G
    P = front * (LAMBDA * strain.trace() * identity + 2 * MU * strain)
    b = sympy.Matrix([-sum(sympy.diff(P[i, j], X[j]) for j in range(3)) for i in range(3)])
    return tuple(_function(matrix) for matrix in (u, G, b))


def _function(matrix):
    shape = matrix.shape if matrix.shape[1] > 1 else matrix.shape[:1]
    compiled = sympy.lambdify(X, list(matrix), "numpy", cse=True)

    def at(points):
        values = compiled(*np.moveaxis(points, -1, 0))
        whole = [np.broadcast_to(v, points.shape[:-1]) for v in values]
        return np.stack(whole, axis=-1).reshape(*points.shape[:-1], *shape)

    return at
