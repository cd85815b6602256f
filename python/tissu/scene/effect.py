"""What a part of a scene switches on, in words."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from tissu.units import unit_of

if TYPE_CHECKING:
    from tissu.scene.part import Part


@dataclass(frozen=True, slots=True)
class Effect:
    """An effect that the scene switches on.

    Attributes:
        name: the effect and where it acts ("viscosity of organ").
        why: the field of the scene that asks for it, and its value.
    """

    name: str
    why: str

    def __str__(self) -> str:
        return f"{self.name}: {self.why}"


def numbers_in_words(part: Part, *names: str) -> str:
    """Fields with their values and the units that they declare: "young 3000 Pa, poisson 0.45"."""
    fields = type(part).model_fields
    return ", ".join(
        f"{name} {getattr(part, name):g} {unit_of(fields[name].metadata)}".rstrip()
        for name in names
    )


def vector_in_words(vector: tuple[float, float, float]) -> str:
    """A vector as it is read: (0, 0, -9.81)."""
    return "(" + ", ".join(f"{component:g}" for component in vector) + ")"
