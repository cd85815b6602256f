"""Manufactured solutions: a field u(X), and the body force that makes it an equilibrium.

Div P + b = 0, P from F = I + grad u. Everything is derived by SymPy from u and the energy.

Below three dimensions the field is u(X, Y, 0) or u(X, 0, 0) along the axes that are left. Across
them either nothing strains, or the strain is what takes the stress away.
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
AFFINE = (0.15 * x + 0.12 * y, 0.04 * x - 0.15 * y + 0.1 * z, 0.06 * y + 0.05 * z - 0.08 * x)
FIELDS = {"smooth": SMOOTH, "quadratic": QUADRATIC, "affine": AFFINE}
SETTINGS = {"solid": 3, "plane strain": 2, "plane stress": 2, "uniaxial stress": 1}  # dimensions


def strain_of(law, G):
    """Hooke: the small strain; StVK: Green-Lagrange's; G = grad u (..., 3, 3)."""
    Gt = np.swapaxes(G, -1, -2)
    return (G + Gt) / 2 if law == "hooke" else (G + Gt + Gt @ G) / 2


@cache
def field(name, law, setting="solid"):
    """Functions of points (n, 3): u (n, 3) [m], grad u (n, 3, 3), body force (n, 3) [N/m3].

    They are zero along the axes that the setting leaves out.
    """
    d = SETTINGS[setting]
    u = sympy.Matrix([*FIELDS[name][:d], *[0] * (3 - d)]).subs(dict.fromkeys(X[d:], 0))
    G = u.jacobian(X)
    identity = sympy.eye(3)
    if law == "hooke":
        strain, front = (G + G.T) / 2, identity
    else:
        strain, front = (G + G.T + G.T * G) / 2, identity + G
    if setting.endswith("stress"):
        strain = _without_stress_across(strain, d)
    P = front * (LAMBDA * strain.trace() * identity + 2 * MU * strain)
    b = sympy.Matrix([-sum(sympy.diff(P[i, j], X[j]) for j in range(3)) for i in range(3)])
    return tuple(_function(matrix) for matrix in (u, G, b))


def _without_stress_across(strain, d):
    """The strain with the diagonal terms behind the d-th that make those of the stress zero."""
    unknown = sympy.symbols("e1:4")[d:]
    whole = strain + sympy.diag(*[0] * d, *unknown)
    # Of the trace of the d first only: LAMBDA (trace + sum(unknown)) + 2 MU unknown_i = 0.
    trace = sympy.Symbol("trace")
    zero = [LAMBDA * (trace + sum(unknown)) + 2 * MU * e for e in unknown]
    found = sympy.solve(zero, unknown)
    return whole.subs({e: found[e].subs(trace, strain.trace()) for e in unknown})


def _function(matrix):
    shape = matrix.shape if matrix.shape[1] > 1 else matrix.shape[:1]
    compiled = sympy.lambdify(X, list(matrix), "numpy", cse=True)

    def at(points):
        values = compiled(*np.moveaxis(points, -1, 0))
        whole = [np.broadcast_to(v, points.shape[:-1]) for v in values]
        return np.stack(whole, axis=-1).reshape(*points.shape[:-1], *shape)

    return at
