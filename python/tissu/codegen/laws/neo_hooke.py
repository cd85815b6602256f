"""Compressible neo-Hooke with a barrier against lost volume.

Bonet, Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed. 2008, eq. 6.28.
Valid up to about 50 % of strain. J must stay positive, or the energy is undefined.
"""

from tissu.codegen.vocabulary import I_C, LAME, POISSON, YOUNG, J, ln, symbols_of

PARAMETERS = (YOUNG, POISSON)
CONSTANTS = LAME
lam, mu = symbols_of(CONSTANTS)

ENERGY = mu / 2 * (I_C - 3) - mu * ln(J) + lam / 2 * ln(J) ** 2
SMALL_STRAIN = (lam, mu)
