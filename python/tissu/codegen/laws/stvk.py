"""St-Venant–Kirchhoff.

Valid for large rotations at moderate strain. In compression it loses stiffness at a stretch of
1/sqrt(3) = 0.577, and it does not resist inversion. This is a limit of the law, not of the mesh.
"""

from tissu.codegen.vocabulary import LAME, POISSON, YOUNG, E, symbols_of, tr

CLASS = "StVK"
PARAMETERS = (YOUNG, POISSON)
CONSTANTS = LAME
lam, mu = symbols_of(CONSTANTS)

ENERGY = lam / 2 * tr(E) ** 2 + mu * tr(E * E)
SMALL_STRAIN = (lam, mu)
