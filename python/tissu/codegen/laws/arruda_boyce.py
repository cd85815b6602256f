"""Arruda–Boyce: eight chains of limited length in a cell, as a series of five terms.

Arruda, Boyce, J. Mech. Phys. Solids 41(2), 1993. The series follows the chain model to a stretch
of about 0.9 lambda_m; beyond it the real chain locks and the series does not. The shear modulus at
rest is mu (1 + 3/(5 lambda_m^2) + ...), above mu.
"""

from tissu.codegen.vocabulary import KAPPA, Ibar1, J, Parameter, Rational, symbols_of

PARAMETERS = (
    Parameter(name="mu", unit="Pa", meaning="scale of the stress", typical=900.0, above=0.0),
    Parameter(
        name="lambda_m", unit="1", meaning="stretch at which chains lock", typical=1.6, above=1.0
    ),
    KAPPA,
)
mu, lambda_m, kappa = symbols_of(PARAMETERS)
SERIES = [Rational(*c) for c in ((1, 2), (1, 20), (11, 1050), (19, 7000), (519, 673750))]
CONSTANTS = {f"b{i}": mu * c / lambda_m ** (2 * i - 2) for i, c in enumerate(SERIES, start=1)}
b = symbols_of(CONSTANTS)
CONSTANTS["kappa"] = kappa

ENERGY = sum(b[i - 1] * (Ibar1**i - 3**i) for i in range(1, 6)) + kappa / 2 * (J - 1) ** 2
shear = 2 * sum(i * 3 ** (i - 1) * b[i - 1] for i in range(1, 6))
SMALL_STRAIN = (kappa - 2 * shear / 3, shear)
