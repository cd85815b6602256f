"""Hooke's law of small strain.

For small displacements. The law is linear, so its tangent is constant. It is not invariant to
rotation: turning a body by an angle a gives a strain of 1 - cos a, so the body swells.
"""

from tissu.codegen.vocabulary import LAME, POISSON, YOUNG, eps, symbols_of, tr

PARAMETERS = (YOUNG, POISSON)
CONSTANTS = LAME
lam, mu = symbols_of(CONSTANTS)

ENERGY = lam / 2 * tr(eps) ** 2 + mu * tr(eps * eps)
SMALL_STRAIN = (lam, mu)
FRAME_INVARIANT = False
