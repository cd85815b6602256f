"""What may be cut or taken away while a scene runs."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Annotated, Literal

from pydantic import BeforeValidator, TypeAdapter, ValidatorFunctionWrapHandler, WrapValidator

from tissu import units
from tissu.errors import ParameterError
from tissu.reading import Maybe, Read, written
from tissu.scene.effect import Effect
from tissu.scene.field import field
from tissu.scene.part import Part
from tissu.scene.problem import Problem, nearest, one_of_words

__all__ = ["Editing", "Repair"]


_SHARE = 0.25
_LEAST = 256

Method = Literal["auto", "virtual", "subdivide", "snap"]
_ONE, _EACH = TypeAdapter(Method), TypeAdapter(dict[str, Method])


def _method_or_map(value: object, _: ValidatorFunctionWrapHandler) -> str | dict[str, Method]:
    """Only what is meant is tried: a union would tell of both."""
    return (_EACH if isinstance(value, Mapping) else _ONE).validate_python(value)


_Methods = Read[Method | dict[str, Method], Method | Mapping[str, Method]]


class Repair(Part):
    """Bad cells that cuts leave are repaired: by collapsed edges, flips and moved nodes."""

    below: units.Pure = field(default=0.1, gt=0.0, le=0.5)
    """a cell is bad if its 6 sqrt 2 V / l_rms^3 or its 3 rho_in / rho_out is below this, or its
    shortest edge below twice this share of its longest
    """

    most: int = field(default=64, ge=1)
    """largest number of operations after a cut, worst cells first"""

    jump: units.Pure = field(default=0.001, ge=0.0, le=1.0)
    """share by which an operation may change the elastic energy of the cells that it changes"""


class Editing(Part):
    """Cells may be removed and bodies cut while the scene runs; `true` means all defaults."""

    room: Maybe[units.Pure] = field(default=None, ge=0.0, le=100.0)
    """number of nodes that cuts may add, as a share of the nodes of the body; absent: a quarter,
    and 256 more; a cut that needs more is refused
    """

    method: Annotated[_Methods, WrapValidator(_method_or_map)] = field(default="auto")
    """how a cut parts cells: virtual (copies of whole cells), subdivide (the cells are divided
    along the cut; tetrahedra and triangles of first order only), or snap (nodes move onto the cut
    where they may, and cells are divided elsewhere; tetrahedra of first order only); auto is
    virtual; or a map from bodies to methods
    """

    depth: bool = field(default=False)
    """of snap: a node inside below each edge that a cut opens on the surface moves onto the blade's
    plane too, so that shallow cuts open to that depth
    """

    repair: Repair | None = field(default=None)
    """repair of bad cells in the bodies whose cells cuts divide or whose nodes they move, after
    each cut; absent: none
    """

    def method_of(self, body: str) -> str:
        """How a cut parts the cells of a body."""
        return self.method.get(body, "auto") if isinstance(self.method, dict) else self.method

    def divides(self, body: str) -> bool:
        """Whether a cut divides the cells of a body where it does not move nodes."""
        return self.method_of(body) in ("subdivide", "snap")

    def snaps(self, body: str) -> bool:
        """Whether a cut moves nodes of a body."""
        return self.method_of(body) == "snap"

    def repairs(self, body: str) -> bool:
        """Whether bad cells of a body are repaired after a cut."""
        return self.repair is not None and self.divides(body)

    def unknown_bodies(self, bodies: Mapping[str, object]) -> Iterator[Problem]:
        """Methods of bodies that the scene does not have, and depth or repair without theirs."""
        for body in self.method if isinstance(self.method, dict) else ():
            if body not in bodies:
                text = f"no body is named '{body}'{nearest(body, bodies)} "
                text += f"Bodies: {one_of_words(bodies)}"
                yield Problem(("editing", "method", body), text)
        if self.depth and not any(self.snaps(body) for body in bodies):
            text = "found depth: true and no body with method: snap, which alone reads it; "
            yield Problem(("editing", "depth"), text + "take method: snap, or leave depth out")
        if self.repair is not None and not any(self.divides(body) for body in bodies):
            text = "found repair and no body with method: subdivide or snap; copies of whole cells "
            text += "keep their shape, so that virtual cuts have nothing to repair; "
            yield Problem(("editing", "repair"), text + "take one of these, or leave repair out")

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
        why = f"editing leaves room for {room}"
        if isinstance(self.method, dict):
            divided = [body for body in self.method if self.divides(body)]
            snapped = [body for body in self.method if self.snaps(body)]
            why += f"; cuts divide the cells of {', '.join(divided)}" if divided else ""
            why += f"; cuts move nodes of {', '.join(snapped)}" if snapped else ""
        elif self.method == "subdivide":
            why += "; cuts divide cells"
        elif self.method == "snap":
            why += "; cuts move nodes, and divide cells elsewhere"
        why += "; bad cells are repaired" if self.repair is not None else ""
        return Effect("cutting", why)


def _written(value: object) -> object:
    """`true` and `false`, as they may be written in place of the part."""
    if value is True:
        return Editing()
    if isinstance(value, (str, int)) and not isinstance(value, bool):
        keys = ", ".join(Editing.model_fields)
        text = f"found {written(value)}; true, false or a mapping with the keys {keys} is accepted"
        raise ParameterError(text)
    return None if value is False else value


EditingField = Annotated[Read[Editing | None, Editing | bool | None], BeforeValidator(_written)]
