"""Stable neo-Hooke: finite at every F, inverted and flattened elements included.

Smith, de Goes, Kim, Stable Neo-Hookean Flesh Simulation, ACM Trans. Graph. 37(2), 2018, with
their map of Lamé's constants, so that the limit of small strain is Hooke's law, and the energy
shifted to vanish at rest. It holds volume less strictly than neo-Hooke in compression.
"""

from tissu.codegen.vocabulary import I_C, LAME, POISSON, YOUNG, J, ln, symbols_of

PARAMETERS = (YOUNG, POISSON)
mu_s, lam_s, alpha = symbols_of(("mu_s", "lambda_s", "alpha"))
CONSTANTS = {
    "mu_s": 4 * LAME["mu"] / 3,
    "lambda_s": LAME["lambda"] + 5 * LAME["mu"] / 6,
    "alpha": 1 + 3 * mu_s / (4 * lam_s),
}

ENERGY = mu_s / 2 * (I_C - 3 - ln((I_C + 1) / 4)) + lam_s / 2 * (
    (J - alpha) ** 2 - (1 - alpha) ** 2
)
SMALL_STRAIN = (lam_s - 5 * mu_s / 8, 3 * mu_s / 4)
