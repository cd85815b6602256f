"""Hooke's law of small strain.

For displacements small beside the body. Linear, so one tangent serves every state. Not invariant
to rotation: a body that turns by an angle a is seen as strained by 1 - cos a, and swells.
"""

from tissu.codegen.vocabulary import LAME, POISSON, YOUNG, eps, symbols_of, tr

PARAMETERS = (YOUNG, POISSON)
CONSTANTS = LAME
lam, mu = symbols_of(CONSTANTS)

ENERGY = lam / 2 * tr(eps) ** 2 + mu * tr(eps * eps)
SMALL_STRAIN = (lam, mu)
FRAME_INVARIANT = False
