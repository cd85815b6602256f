"""One family of fibres, to be added to any base law: stiff when stretched, nothing when slack.

Holzapfel, Gasser, Ogden, J. Elasticity 61, 2000, one family, without dispersion. a is the direction
at rest, a unit vector. The tangent jumps where the fibre goes slack, and grows like exp(k2 x^2).
"""

from tissu.codegen.vocabulary import (
    Ibar4,
    Parameter,
    Requirement,
    exp,
    positive,
    sqrt,
    symbols_of,
)

ADDITION = True
PARAMETERS = (
    Parameter(name="k1", unit="Pa", meaning="stiffness of the fibres", typical=2000.0, above=0.0),
    Parameter(name="k2", unit="1", meaning="how fast they stiffen", typical=0.8, above=0.0),
    Parameter(name="direction_x", unit="1", meaning="direction at rest, x", typical=0.6),
    Parameter(name="direction_y", unit="1", meaning="direction at rest, y", typical=-0.48),
    Parameter(name="direction_z", unit="1", meaning="direction at rest, z", typical=0.64),
)
k1, k2, x, y, z = symbols_of(PARAMETERS)
length = sqrt(x**2 + y**2 + z**2)
CONSTANTS = {"k1": k1, "k2": k2, "a0": x / length, "a1": y / length, "a2": z / length}
REQUIREMENTS = (Requirement(length, "direction", "a vector that is not zero"),)

ENERGY = k1 / (2 * k2) * (exp(k2 * positive(Ibar4 - 1) ** 2) - 1)
