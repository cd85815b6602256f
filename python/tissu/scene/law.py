"""Laws of the material, as a scene names them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

from pydantic import Field, PlainValidator, TypeAdapter, ValidationInfo

from tissu import units
from tissu.errors import ParameterError
from tissu.scene.part import Part, chosen, keeps_problems
from tissu.scene.problem import Problem
from tissu.scene.unknown import Unread, rule

if TYPE_CHECKING:
    from tissu.user_law.made import MadeLaw

_Positive = Field(gt=0.0)


class Fibres(Part):
    """Fibres added to a law: stiff when stretched, nothing when slack (Holzapfel, one family).

    W = k1 / (2 k2) (exp(k2 <Ibar4 - 1>^2) - 1), Ibar4 the squared stretch along the fibre.
    """

    k1: Annotated[units.Pressure, _Positive]
    """stiffness [Pa]"""
    k2: Annotated[units.Pure, _Positive]
    """how fast they stiffen"""
    direction: units.Direction
    """direction at rest (3,), of any length but zero"""

    if TYPE_CHECKING:

        def __init__(
            self, *, k1: units.Number, k2: units.Number, direction: Sequence[float]
        ) -> None: ...

    @rule("direction")
    def _has_direction(self) -> Iterator[Problem]:
        if not any(self.direction):
            text = "found the direction (0, 0, 0); one that is not zero is accepted: [0, 0, 1]"
            yield Problem((), text)


class _Law(Part):
    """What all laws share.

    Attributes:
        made: what a law of one's own is made of: formula, C++, kernels; None: the library's law.
    """

    made: ClassVar[MadeLaw | None] = None
    fibres: Fibres | None = None
    """fibres added to the law; absent: none"""


class _Isotropic(_Law):
    """What laws with Young's modulus and Poisson's ratio share."""

    young: Annotated[units.Pressure, _Positive]
    """Young's modulus [Pa], such as '4 kPa'"""
    poisson: Annotated[
        units.Pure,
        units.within(-1.0, 0.5, hint="take 0.45 to 0.49 for tissue that hardly changes volume"),
    ]
    """Poisson's ratio, between -1 and 0.5, both excluded"""

    if TYPE_CHECKING:

        def __init__(
            self, *, young: units.Number, poisson: units.Number, fibres: Fibres | None = ...
        ) -> None: ...


class Hooke(_Isotropic):
    """Linear elasticity: small strains and small rotations only."""

    type: Literal["hooke"] = "hooke"


class StVK(_Isotropic):
    """St. Venant-Kirchhoff: any rotation, moderate strain; breaks down under strong compression."""

    type: Literal["stvk"] = "stvk"


class NeoHooke(_Isotropic):
    """Compressible neo-Hooke: large strain, a barrier against lost volume; no inverted cells."""

    type: Literal["neo_hooke"] = "neo_hooke"


class StableNeoHooke(_Isotropic):
    """Neo-Hooke of Smith, de Goes and Kim 2018: large strain, finite for inverted cells too."""

    type: Literal["stable_neo_hooke"] = "stable_neo_hooke"


class MooneyRivlin(_Law):
    """Mooney-Rivlin, nearly incompressible: c1 (Ibar1 - 3) + c2 (Ibar2 - 3) + kappa/2 (J - 1)^2."""

    type: Literal["mooney_rivlin"] = "mooney_rivlin"
    c1: units.Pressure
    """weight of Ibar1 - 3 [Pa]"""
    c2: units.Pressure
    """weight of Ibar2 - 3 [Pa]; c1 + c2 is half the shear modulus"""
    kappa: Annotated[units.Pressure, _Positive]
    """bulk modulus [Pa]"""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            c1: units.Number,
            c2: units.Number,
            kappa: units.Number,
            fibres: Fibres | None = ...,
        ) -> None: ...

    @rule("c1", "c2")
    def _stiff_at_rest(self) -> Iterator[Problem]:
        if not self.c1 + self.c2 > 0.0:
            found = f"found c1 + c2 = {self.c1 + self.c2:g} Pa, half the shear modulus"
            yield Problem((), f"{found}; a sum above 0 is accepted")


class Yeoh(_Law):
    """Yeoh, nearly incompressible: c1 x + c2 x^2 + c3 x^3 + kappa/2 (J - 1)^2, x = Ibar1 - 3."""

    type: Literal["yeoh"] = "yeoh"
    c1: Annotated[units.Pressure, _Positive]
    """half the shear modulus at rest [Pa]"""
    c2: units.Pressure = 0.0
    """weight of (Ibar1 - 3)^2 [Pa]"""
    c3: units.Pressure = 0.0
    """weight of (Ibar1 - 3)^3 [Pa]"""
    kappa: Annotated[units.Pressure, _Positive]
    """bulk modulus [Pa]"""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            c1: units.Number,
            c2: units.Number = ...,
            c3: units.Number = ...,
            kappa: units.Number,
            fibres: Fibres | None = ...,
        ) -> None: ...


class ArrudaBoyce(_Law):
    """Arruda-Boyce, nearly incompressible: chains that lock at the stretch lambda_m."""

    type: Literal["arruda_boyce"] = "arruda_boyce"
    mu: Annotated[units.Pressure, _Positive]
    """scale of the stress [Pa]"""
    lambda_m: Annotated[units.Pure, Field(gt=1.0)]
    """stretch at which the chains lock"""
    kappa: Annotated[units.Pressure, _Positive]
    """bulk modulus [Pa]"""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            mu: units.Number,
            lambda_m: units.Number,
            kappa: units.Number,
            fibres: Fibres | None = ...,
        ) -> None: ...


class UserLaw(_Law):
    """A law of one's own: `tissu.law` and `tissu.read_law` make its subclasses."""

    type: str

    if TYPE_CHECKING:

        def __init__(self, *, fibres: Fibres | None = ..., **parameters: units.Number) -> None: ...

    def __eq__(self, other: object) -> bool:
        """Whether formula, parameters and fibres are equal, wherever the law was defined."""
        if not isinstance(other, UserLaw):
            return NotImplemented
        return type(self).made == type(other).made and vars(self) == vars(other)

    __hash__ = None  # type: ignore[assignment]

    @rule()
    def _material(self) -> Iterator[Problem]:
        made = type(self).made
        if made is None:
            return
        try:
            made.check({name: getattr(self, name) for name in made.parameters})
        except ParameterError as error:
            yield Problem((), str(error))


LAWS: tuple[type[Part], ...] = (
    Hooke,
    StVK,
    NeoHooke,
    StableNeoHooke,
    MooneyRivlin,
    Yeoh,
    ArrudaBoyce,
)
Law = Hooke | StVK | NeoHooke | StableNeoHooke | MooneyRivlin | Yeoh | ArrudaBoyce | UserLaw


def built_in_names() -> list[str]:
    """The types of the library's own laws, and of what is added to them."""
    return [*(str(cls.model_fields["type"].default) for cls in LAWS), "fibre"]


def _one_law(value: Any, info: ValidationInfo) -> Any:
    """A law: in Python by class; in YAML by its `type`, one's own too where the scene has them."""
    if isinstance(value, UserLaw):
        return value
    context = info.context if isinstance(info.context, dict) else {}
    try:
        return chosen(value, (*LAWS, *context.get("laws", ())), info)
    except ParameterError as error:
        if not keeps_problems(info):
            raise
        if context.get("laws_refused") and isinstance(value, Mapping) and "type" in value:
            return Unread()  # it may be of a file that is told already
        return Unread((Problem((), str(error)),))


OneLaw = Annotated[Law, PlainValidator(_one_law)]


@lru_cache(maxsize=1)
def _region_laws() -> TypeAdapter[dict[str, Law]]:
    return TypeAdapter(dict[str, OneLaw])


def _law_or_map(value: Any, info: ValidationInfo) -> Any:
    """A law, or a map from the mesh's regions to laws."""
    if not isinstance(value, Mapping) or "type" in value:
        return _one_law(value, info)
    if not value or not all(isinstance(p, (Mapping, *LAWS, UserLaw)) for p in value.values()):
        return _one_law(value, info)  # says that `type` is missing
    laws = {str(name): law for name, law in value.items()}  # YAML reads a region 7 as a number
    return _region_laws().validate_python(laws, context=info.context)


LawOrMap = Annotated[Law | dict[str, Law], PlainValidator(_law_or_map)]
