"""St-Venant–Kirchhoff.

Right for large rotations at moderate strain. Under compression it loses strength at a stretch of
1/sqrt(3) = 0.577 and does not resist inversion: that is the law's own limit, not the mesh's.
"""

from tissu.codegen.vocabulary import LAME, POISSON, YOUNG, E, symbols_of, tr

CLASS = "StVK"
PARAMETERS = (YOUNG, POISSON)
CONSTANTS = LAME
lam, mu = symbols_of(CONSTANTS)

ENERGY = lam / 2 * tr(E) ** 2 + mu * tr(E * E)
SMALL_STRAIN = (lam, mu)
