"""Yeoh, nearly incompressible: a cubic in Ibar1 - 3.

Yeoh, Some forms of the strain energy function for rubber, Rubber Chem. Technol. 66(5), 1993.
The law stiffens at large stretch if c3 > 0. If c2 < 0, it may soften before it stiffens.
"""

from tissu.codegen.vocabulary import KAPPA, Ibar1, J, Parameter, symbols_of

PARAMETERS = (
    Parameter(
        name="c1", unit="Pa", meaning="half the shear modulus at rest", typical=500.0, above=0.0
    ),
    Parameter(name="c2", unit="Pa", meaning="weight of (Ibar1 - 3)^2", typical=120.0, default=0.0),
    Parameter(name="c3", unit="Pa", meaning="weight of (Ibar1 - 3)^3", typical=30.0, default=0.0),
    KAPPA,
)
c1, c2, c3, kappa = symbols_of(PARAMETERS)
CONSTANTS = {"c1": c1, "c2": c2, "c3": c3, "kappa": kappa}

ENERGY = c1 * (Ibar1 - 3) + c2 * (Ibar1 - 3) ** 2 + c3 * (Ibar1 - 3) ** 3 + kappa / 2 * (J - 1) ** 2
SMALL_STRAIN = (kappa - 4 * c1 / 3, 2 * c1)
