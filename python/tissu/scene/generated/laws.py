"""The library's laws, as a scene names them.

Made from the formulae of python/tissu/codegen/laws by `make codegen`; never edited.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from tissu import units
from tissu.scene.field import field
from tissu.scene.law import Law
from tissu.scene.problem import Problem
from tissu.scene.unknown import rule

__all__ = [
    "Hooke",
    "StVK",
    "NeoHooke",
    "StableNeoHooke",
    "MooneyRivlin",
    "Yeoh",
    "ArrudaBoyce",
]


class Hooke(Law):
    """Hooke's law of small strain.

    For small displacements. The law is linear, so its tangent is constant. It is not invariant to
    rotation: turning a body by an angle a gives a strain of 1 - cos a, so the body swells.
    """

    type: Literal["hooke"] = "hooke"
    young: units.Pressure = field(gt=0.0)
    """Young's modulus at small strain [Pa], such as '4 kPa'"""
    poisson: Annotated[units.Pure, units.within(-1.0, 0.5, hint="take 0.45 to 0.49 for tissue that hardly changes volume")]
    """Poisson's ratio at small strain, above -1 and below 0.5"""

    def small_strain(self) -> tuple[float, float]:
        """Lame's lambda and mu at rest [Pa]."""
        lame = -self.poisson*self.young/((self.poisson + 1)*(2*self.poisson - 1))
        mu = (1/2)*self.young/(self.poisson + 1)
        return lame, mu


class StVK(Law):
    """St-Venant–Kirchhoff.

    Valid for large rotations at moderate strain. In compression it loses stiffness at a stretch of
    1/sqrt(3) = 0.577, and it does not resist inversion. This is a limit of the law, not of the mesh.
    """

    type: Literal["stvk"] = "stvk"
    young: units.Pressure = field(gt=0.0)
    """Young's modulus at small strain [Pa], such as '4 kPa'"""
    poisson: Annotated[units.Pure, units.within(-1.0, 0.5, hint="take 0.45 to 0.49 for tissue that hardly changes volume")]
    """Poisson's ratio at small strain, above -1 and below 0.5"""

    def small_strain(self) -> tuple[float, float]:
        """Lame's lambda and mu at rest [Pa]."""
        lame = -self.poisson*self.young/((self.poisson + 1)*(2*self.poisson - 1))
        mu = (1/2)*self.young/(self.poisson + 1)
        return lame, mu


class NeoHooke(Law):
    """Compressible neo-Hooke with a barrier against lost volume.

    Bonet, Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed. 2008, eq. 6.28.
    Valid up to about 50 % of strain. J must stay positive, or the energy is undefined.
    """

    type: Literal["neo_hooke"] = "neo_hooke"
    young: units.Pressure = field(gt=0.0)
    """Young's modulus at small strain [Pa], such as '4 kPa'"""
    poisson: Annotated[units.Pure, units.within(-1.0, 0.5, hint="take 0.45 to 0.49 for tissue that hardly changes volume")]
    """Poisson's ratio at small strain, above -1 and below 0.5"""

    def small_strain(self) -> tuple[float, float]:
        """Lame's lambda and mu at rest [Pa]."""
        lame = -self.poisson*self.young/((self.poisson + 1)*(2*self.poisson - 1))
        mu = (1/2)*self.young/(self.poisson + 1)
        return lame, mu


class StableNeoHooke(Law):
    """Stable neo-Hooke: finite at every F, inverted and flattened elements included.

    Smith, de Goes, Kim, Stable Neo-Hookean Flesh Simulation, ACM Trans. Graph. 37(2), 2018, with
    their map of Lamé's constants, so that the limit of small strain is Hooke's law, and the energy
    shifted to vanish at rest. It holds volume less strictly than neo-Hooke in compression.
    """

    type: Literal["stable_neo_hooke"] = "stable_neo_hooke"
    young: units.Pressure = field(gt=0.0)
    """Young's modulus at small strain [Pa], such as '4 kPa'"""
    poisson: Annotated[units.Pure, units.within(-1.0, 0.5, hint="take 0.45 to 0.49 for tissue that hardly changes volume")]
    """Poisson's ratio at small strain, above -1 and below 0.5"""

    def small_strain(self) -> tuple[float, float]:
        """Lame's lambda and mu at rest [Pa]."""
        lame = -self.poisson*self.young/((self.poisson + 1)*(2*self.poisson - 1))
        mu = (1/2)*self.young/(self.poisson + 1)
        return lame, mu


class MooneyRivlin(Law):
    """Mooney–Rivlin, nearly incompressible.

    Mooney 1940, Rivlin 1948; Holzapfel, Nonlinear Solid Mechanics, 2000, section 6.5. Valid up to a
    strain of about 100 %. c2 < 0 is accepted, but stable only at small strains.
    """

    type: Literal["mooney_rivlin"] = "mooney_rivlin"
    c1: units.Pressure
    """weight of Ibar1 - 3 [Pa]"""
    c2: units.Pressure
    """weight of Ibar2 - 3 [Pa]"""
    kappa: units.Pressure = field(gt=0.0)
    """bulk modulus [Pa]"""

    @rule("c1", "c2")
    def _requirement_0(self) -> Iterator[Problem]:
        value = self.c1 + self.c2
        if not value > 0.0:
            yield Problem((), f"found c1 + c2 = {value:g}; a sum above 0 (half the shear modulus) is accepted")

    def small_strain(self) -> tuple[float, float]:
        """Lame's lambda and mu at rest [Pa]."""
        lame = -4/3*self.c1 - 4/3*self.c2 + self.kappa
        mu = 2*self.c1 + 2*self.c2
        return lame, mu


class Yeoh(Law):
    """Yeoh, nearly incompressible: a cubic in Ibar1 - 3.

    Yeoh, Some forms of the strain energy function for rubber, Rubber Chem. Technol. 66(5), 1993.
    The law stiffens at large stretch if c3 > 0. If c2 < 0, it may soften before it stiffens.
    """

    type: Literal["yeoh"] = "yeoh"
    c1: units.Pressure = field(gt=0.0)
    """half the shear modulus at rest [Pa]"""
    c2: units.Pressure = field(default=0.0)
    """weight of (Ibar1 - 3)^2 [Pa]"""
    c3: units.Pressure = field(default=0.0)
    """weight of (Ibar1 - 3)^3 [Pa]"""
    kappa: units.Pressure = field(gt=0.0)
    """bulk modulus [Pa]"""

    def small_strain(self) -> tuple[float, float]:
        """Lame's lambda and mu at rest [Pa]."""
        lame = -4/3*self.c1 + self.kappa
        mu = 2*self.c1
        return lame, mu


class ArrudaBoyce(Law):
    """Arruda–Boyce: eight chains of limited length in a cell, as a series of five terms.

    Arruda, Boyce, J. Mech. Phys. Solids 41(2), 1993. The series follows the chain model to a stretch
    of about 0.9 lambda_m; beyond it the real chain locks and the series does not. The shear modulus at
    rest is mu (1 + 3/(5 lambda_m^2) + ...), above mu.
    """

    type: Literal["arruda_boyce"] = "arruda_boyce"
    mu: units.Pressure = field(gt=0.0)
    """scale of the stress [Pa]"""
    lambda_m: units.Pure = field(gt=1.0)
    """stretch at which chains lock"""
    kappa: units.Pressure = field(gt=0.0)
    """bulk modulus [Pa]"""

    def small_strain(self) -> tuple[float, float]:
        """Lame's lambda and mu at rest [Pa]."""
        lame = (1/202125)*(67375*self.lambda_m**8*(3*self.kappa - 2*self.mu) - 80850*self.lambda_m**6*self.mu - 76230*self.lambda_m**4*self.mu - 79002*self.lambda_m**2*self.mu - 84078*self.mu)/self.lambda_m**8
        mu = (1/67375)*self.mu*(67375*self.lambda_m**8 + 40425*self.lambda_m**6 + 38115*self.lambda_m**4 + 39501*self.lambda_m**2 + 42039)/self.lambda_m**8
        return lame, mu


LAWS: tuple[type[Law], ...] = (
    Hooke,
    StVK,
    NeoHooke,
    StableNeoHooke,
    MooneyRivlin,
    Yeoh,
    ArrudaBoyce,
)
