"""Loads: forces on nodes, tractions and pressures on the surface."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, NamedTuple

import numpy as np

from tissu import units
from tissu.reading import Many, MaybeMany
from tissu.scene.effect import Effect
from tissu.scene.field import field
from tissu.scene.part import Part, one_of
from tissu.scene.problem import Problem
from tissu.scene.selection import Floats, Ints, On
from tissu.scene.support import IncreasingTimes, same_length
from tissu.scene.unknown import rule

if TYPE_CHECKING:
    from tissu._core import WorldBuilder
    from tissu.mesh import CellBlock, Mesh

__all__ = ["NodalLoad", "Moment", "Traction", "Pressure"]


class Where(NamedTuple):
    """Where a load acts.

    Attributes:
        mesh: of the body.
        nodes: the selected ones (k,).
        faces: of a load on the surface, whole and outward; of a flat body the edges of its rim.
        thickness: of those edges [m]; 0 of faces.
    """

    mesh: Mesh
    nodes: Ints
    faces: tuple[CellBlock, ...]
    thickness: float = 0.0


class Load(Part):
    """What loads share: where they act and how they vary with time.

    Attributes:
        called: what it is called in words.
        on_surface: whether it acts on faces whose nodes are all selected.
    """

    called: ClassVar[str]
    on_surface: ClassVar[bool] = False
    body: str = field(kw_only=False)
    """name of a body of the scene"""
    on: On
    """which nodes: a box, sphere, plane, nodes, surface or region"""
    times: MaybeMany[IncreasingTimes] = field(default=None)
    """strictly increasing times [s]; absent: the load is constant"""
    factors: MaybeMany[Many[units.Pure]] = field(default=None)
    """factor of the load at each time, linear between, held at the ends"""

    if TYPE_CHECKING:
        type: str

    @rule("times", "factors")
    def _series(self) -> Iterator[Problem]:
        if (self.times is None) != (self.factors is None):
            given, absent = ("times", "factors") if self.factors is None else ("factors", "times")
            text = f"found {given} without {absent}; both or neither are accepted"
            yield Problem((), text)
        elif self.times is not None and self.factors is not None:
            yield from same_length("factor", self.factors, self.times)

    def effect(self, path: str, count: str | None) -> Effect:
        """What it switches on; `count` where it is known ("42 nodes")."""
        why = f"{path} acts on {self.on.words(count)}"
        return Effect(f"{self.called} on {self.body}", why)

    def add_to(self, builder: WorldBuilder, where: Where, *, number: int) -> None:
        """Put it on its body in the world.

        Args:
            builder: of the world.
            where: it acts.
            number: of the load in the scene.
        """
        raise NotImplementedError

    def _shared(self, number: int) -> dict[str, Any]:
        """What the core is told of every load: its name, and how it varies with time."""
        return {
            "name": f"{self.called} on {self.body} (loads[{number}])",
            "body": self.body,
            "times": np.array([0.0] if self.times is None else self.times),
            "factors": np.array([1.0] if self.factors is None else self.factors),
        }


class NodalLoad(Load):
    """A total force shared equally by the selected nodes."""

    called: ClassVar[str] = "nodal load"
    type: Literal["nodal"] = "nodal"
    force: units.Force
    """total force [N]"""

    def add_to(self, builder: WorldBuilder, where: Where, *, number: int) -> None:
        """Put it on its body in the world."""
        forces = _equal_shares(self.force, len(where.nodes))
        builder.add_load(nodes=where.nodes, forces=forces, moments=False, **self._shared(number))


class Moment(Load):
    """A total moment shared equally by the selected nodes, which are frames; it keeps its axis."""

    called: ClassVar[str] = "moment"
    type: Literal["moment"] = "moment"
    moment: units.Moment
    """total moment [N m]"""

    def add_to(self, builder: WorldBuilder, where: Where, *, number: int) -> None:
        """Put it on its body in the world."""
        moments = _equal_shares(self.moment, len(where.nodes))
        builder.add_load(nodes=where.nodes, forces=moments, moments=True, **self._shared(number))


class Traction(Load):
    """A force per rest area that keeps its direction, on faces whose nodes are all selected.

    Of a flat body (`plane`): on edges of its rim.
    """

    called: ClassVar[str] = "traction"
    on_surface: ClassVar[bool] = True
    type: Literal["traction"] = "traction"
    traction: units.TractionVector
    """force per rest area [Pa]"""

    def add_to(self, builder: WorldBuilder, where: Where, *, number: int) -> None:
        """Put it on its body in the world."""
        from tissu.mesh.whole_faces import nodal_areas

        shares = nodal_areas(where.mesh, where.faces, thickness=where.thickness)
        nodes = np.flatnonzero(shares).astype(np.int32)
        forces = shares[nodes, None] * np.array(self.traction)
        builder.add_load(nodes=nodes, forces=forces, moments=False, **self._shared(number))


class Pressure(Load):
    """A pressure that follows the surface, on faces whose nodes are all selected.

    Of a flat body (`plane`): on edges of its rim, per length along it and thickness at rest.
    """

    called: ClassVar[str] = "pressure"
    on_surface: ClassVar[bool] = True
    type: Literal["pressure"] = "pressure"
    pressure: units.Pressure
    """pressure [Pa], positive inwards"""
    follows: bool = True
    """whether it stays normal to the surface as it moves; false: a dead pressure, along the normal
    and over the area at rest
    """

    def add_to(self, builder: WorldBuilder, where: Where, *, number: int) -> None:
        """Put it on its body in the world."""
        from tissu.mesh.whole_faces import nodal_normals

        if self.follows:
            blocks = [(block.type, block.nodes) for block in where.faces]
            builder.add_pressure(
                faces=blocks,
                pressure=self.pressure,
                thickness=where.thickness,
                **self._shared(number),
            )
            return
        normals = nodal_normals(where.mesh, where.faces, thickness=where.thickness)
        nodes = np.flatnonzero(normals.any(axis=1)).astype(np.int32)
        forces = -self.pressure * normals[nodes]
        builder.add_load(nodes=nodes, forces=forces, moments=False, **self._shared(number))


def _equal_shares(total: tuple[float, float, float], count: int) -> Floats:
    """A total cut into `count` equal rows."""
    return np.tile(np.array(total) / count, (count, 1))


LOADS: tuple[type[Load], ...] = (NodalLoad, Moment, Traction, Pressure)
OneLoad = Annotated[Load, one_of(*LOADS)]
