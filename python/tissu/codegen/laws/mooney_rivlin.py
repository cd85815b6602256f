"""Mooney–Rivlin, nearly incompressible.

Mooney 1940, Rivlin 1948; Holzapfel, Nonlinear Solid Mechanics, 2000, section 6.5. Valid up to a
strain of about 100 %. c2 < 0 is accepted, but stable only at small strains.
"""

from tissu.codegen.vocabulary import KAPPA, Ibar1, Ibar2, J, Parameter, Requirement, symbols_of

PARAMETERS = (
    Parameter(name="c1", unit="Pa", meaning="weight of Ibar1 - 3", typical=400.0),
    Parameter(name="c2", unit="Pa", meaning="weight of Ibar2 - 3", typical=100.0),
    KAPPA,
)
c1, c2, kappa = symbols_of(PARAMETERS)
CONSTANTS = {"c1": c1, "c2": c2, "kappa": kappa}
REQUIREMENTS = (Requirement(c1 + c2, "c1 + c2", "a sum above 0 (half the shear modulus)"),)

ENERGY = c1 * (Ibar1 - 3) + c2 * (Ibar2 - 3) + kappa / 2 * (J - 1) ** 2
SMALL_STRAIN = (kappa - 4 * (c1 + c2) / 3, 2 * (c1 + c2))
