"""What may be cut or taken away while a scene runs."""

from __future__ import annotations

import math
from typing import Annotated

from pydantic import BeforeValidator

from tissu import units
from tissu.reading import Maybe, Read
from tissu.scene.effect import Effect
from tissu.scene.field import field
from tissu.scene.part import Part

__all__ = ["Editing"]


_SHARE = 0.25
_LEAST = 256


class Editing(Part):
    """Cells may be removed and bodies cut while the scene runs; `true` means all defaults."""

    room: Maybe[units.Pure] = field(default=None, ge=0.0, le=100.0)
    """number of nodes that cuts may add, as a share of the nodes of the body; absent: a quarter,
    and 256 more; a cut that needs more is refused
    """

    def nodes(self, count: int) -> int:
        """Number of nodes that cuts may make in a body of `count` nodes."""
        if self.room is None:
            return math.ceil(_SHARE * count) + _LEAST
        return math.ceil(self.room * count)

    def effect(self) -> Effect:
        """The effect that it switches on."""
        room = f"{_SHARE:.0%} of a body's nodes and {_LEAST} more"
        if self.room is not None:
            room = f"{self.room:.0%} of a body's nodes"
        return Effect("cutting", f"editing leaves room for {room}")


def _written(value: object) -> object:
    """`true` and `false`, as they may be written in place of the part."""
    if value is True:
        return Editing()
    return None if value is False else value


EditingField = Annotated[Read[Editing | None, Editing | bool | None], BeforeValidator(_written)]
