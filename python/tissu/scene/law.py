"""What all laws share, fibres, and laws of one's own; the library's laws are made from formulae."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, ClassVar

from tissu import units
from tissu.errors import ParameterError
from tissu.scene.effect import numbers_in_words
from tissu.scene.field import field
from tissu.scene.part import Part
from tissu.scene.problem import Problem
from tissu.scene.unknown import rule

if TYPE_CHECKING:
    from tissu.user_law.made import MadeLaw

__all__ = ["Fibres", "UserLaw"]


class Fibres(Part):
    """Fibres added to a law: stiff when stretched, stress-free when slack (Holzapfel, one family).

    W = k1 / (2 k2) (exp(k2 <Ibar4 - 1>^2) - 1), Ibar4 the squared stretch along the fibre.
    """

    k1: units.Pressure = field(gt=0.0)
    """stiffness [Pa]"""
    k2: units.Pure = field(gt=0.0)
    """how fast they stiffen"""
    direction: units.Direction
    """direction at rest (3,), of any length but zero"""

    def live_fields(self) -> list[str]:
        """Its stiffness may change; not where it points."""
        return ["k1", "k2"]

    @rule("direction")
    def _has_direction(self) -> Iterator[Problem]:
        if not any(self.direction):
            text = "found the direction (0, 0, 0); one that is not zero is accepted: [0, 0, 1]"
            yield Problem((), text)


class Law(Part):
    """The common part of all laws.

    Attributes:
        made: what a law of one's own is made of: formula, C++, kernels; None: the library's law.
    """

    made: ClassVar[MadeLaw | None] = None
    fibres: Fibres | None = None
    """fibres added to the law; absent: none"""

    if TYPE_CHECKING:
        type: str

    @classmethod
    def parameter_names(cls) -> list[str]:
        """Names of its parameters, in the order of the formula."""
        return [name for name in cls.model_fields if name not in ("type", "fibres")]

    def live_fields(self) -> list[str]:
        """All its parameters."""
        return self.parameter_names()

    def words(self) -> str:
        """Its type and parameters with the units of the formula, as `check` says them."""
        text = f"{self.type} with {numbers_in_words(self, *self.parameter_names())}"
        fibres = self.fibres
        return text if fibres is None else f"{text}, fibres {numbers_in_words(fibres, 'k1', 'k2')}"

    def small_strain(self) -> tuple[float, float]:
        """Lame's lambda and mu at rest [Pa]."""
        raise NotImplementedError

    def poisson_at_rest(self) -> float:
        """Poisson's ratio at rest; 0 for a law whose moduli nothing is known of."""
        if "poisson" in type(self).model_fields:
            return float(getattr(self, "poisson"))  # noqa: B009 - of some laws only
        lame, mu = self.small_strain()
        return lame / (2.0 * (lame + mu))


class UserLaw(Law):
    """A law of one's own: `tissu.law` and `tissu.read_law` make its subclasses."""

    type: str

    if TYPE_CHECKING:  # its fields are those of a formula

        def __init__(self, *, fibres: Fibres | None = ..., **parameters: units.Number) -> None: ...

    def __eq__(self, other: object) -> bool:
        """Whether formula, parameters and fibres are equal, wherever the law was defined."""
        if not isinstance(other, UserLaw):
            return NotImplemented
        return type(self).made == type(other).made and vars(self) == vars(other)

    __hash__ = None  # type: ignore[assignment]

    def small_strain(self) -> tuple[float, float]:
        """Nothing is known of it: a law that does not change its width."""
        return 0.0, 1.0

    @rule()
    def _material(self) -> Iterator[Problem]:
        made = type(self).made
        if made is None:
            return
        try:
            made.check({name: getattr(self, name) for name in made.parameters})
        except ParameterError as error:
            yield Problem((), str(error))
