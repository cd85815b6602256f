"""Loads: forces on nodes, tractions and pressures on the surface."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from tissu import units
from tissu.scene.part import Part, one_of
from tissu.scene.problem import Problem
from tissu.scene.selection import On, Selection
from tissu.scene.support import IncreasingTimes, same_length
from tissu.scene.unknown import rule

if TYPE_CHECKING:
    from collections.abc import Sequence

    Series = Sequence[units.Number] | units.VectorLike


class _Load(Part):
    """What loads share: where they act and how they vary with time."""

    positional: ClassVar[tuple[str, ...]] = ("body",)
    body: str
    """name of a body of the scene"""
    on: On
    """which nodes: a box, sphere, plane, nodes, surface or region"""
    times: IncreasingTimes | None = None
    """strictly increasing times [s]; absent: the load is constant"""
    factors: units.Factors | None = None
    """factor of the load at each time, linear between, held at the ends"""

    @rule("times", "factors")
    def _series(self) -> Iterator[Problem]:
        if (self.times is None) != (self.factors is None):
            given, absent = ("times", "factors") if self.factors is None else ("factors", "times")
            text = f"found {given} without {absent}; both or neither are accepted"
            yield Problem((), text)
        elif self.times is not None and self.factors is not None:
            yield from same_length("factor", self.factors, self.times)


class NodalLoad(_Load):
    """A total force shared equally by the selected nodes."""

    type: Literal["nodal"] = "nodal"
    force: units.Force
    """total force [N]"""

    if TYPE_CHECKING:

        def __init__(
            self,
            body: str,
            *,
            on: Selection,
            force: units.VectorLike,
            times: Series | None = ...,
            factors: Series | None = ...,
        ) -> None: ...


class Moment(_Load):
    """A total moment shared equally by the selected nodes, which are frames; it keeps its axis."""

    type: Literal["moment"] = "moment"
    moment: units.Moment
    """total moment [N m]"""

    if TYPE_CHECKING:

        def __init__(
            self,
            body: str,
            *,
            on: Selection,
            moment: units.VectorLike,
            times: Series | None = ...,
            factors: Series | None = ...,
        ) -> None: ...


class Traction(_Load):
    """A force per rest area that keeps its direction, on faces whose nodes are all selected.

    Of a flat body (`plane`): on edges of its rim.
    """

    type: Literal["traction"] = "traction"
    traction: units.TractionVector
    """force per rest area [Pa]"""

    if TYPE_CHECKING:

        def __init__(
            self,
            body: str,
            *,
            on: Selection,
            traction: units.VectorLike,
            times: Series | None = ...,
            factors: Series | None = ...,
        ) -> None: ...


class Pressure(_Load):
    """A pressure that follows the surface, on faces whose nodes are all selected.

    Of a flat body (`plane`): on edges of its rim, per length along it and thickness at rest.
    """

    type: Literal["pressure"] = "pressure"
    pressure: units.Pressure
    """pressure [Pa], positive inwards"""
    follows: bool = True
    """whether it stays normal to the surface as it moves; false: a dead pressure, along the normal
    and over the area at rest
    """

    if TYPE_CHECKING:

        def __init__(
            self,
            body: str,
            *,
            on: Selection,
            pressure: units.Number,
            follows: bool = ...,
            times: Series | None = ...,
            factors: Series | None = ...,
        ) -> None: ...


Load = NodalLoad | Moment | Traction | Pressure
OneLoad = Annotated[Load, one_of(NodalLoad, Moment, Traction, Pressure)]
