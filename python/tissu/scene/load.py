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
    """The common part of loads: where they act, and how they vary with time.

    Attributes:
        called: what it is called in words.
        on_surface: whether it acts on faces whose nodes are all selected.
        quantity: the field that says how large it is.
    """

    called: ClassVar[str]
    quantity: ClassVar[str]
    on_surface: ClassVar[bool] = False
    body: str = field(kw_only=False)
    """name of a body of the scene"""
    on: On
    """which nodes: a box, sphere, plane, nodes, surface or region"""
    times: MaybeMany[IncreasingTimes] = field(default=None)
    """strictly increasing times [s]; absent: the load is constant"""
    factors: MaybeMany[Many[units.Pure]] = field(default=None)
    """factor of the load at each time, linear between, held at the ends"""
    name: str | None = None
    """name by which a running simulation finds it, see `Simulation.load`"""

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
        """The effect that it switches on; `count` where it is known ("42 nodes")."""
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

    def made_of(self, where: Where) -> Floats:
        """What a run changes of it in the core: its value and, of dead loads, its nodal forces."""
        raise NotImplementedError

    def core_name(self, number: int) -> str:
        """Its name in the core, by its number in the scene."""
        return f"{self.called} on {self.body} (loads[{number}])"

    def _shared(self, number: int) -> dict[str, Any]:
        """What the core gets of every load: its name, and how it varies with time."""
        return {
            "name": self.core_name(number),
            "body": self.body,
            "times": np.array([0.0] if self.times is None else self.times),
            "factors": np.array([1.0] if self.factors is None else self.factors),
        }


class DeadLoad(Load):
    """What loads share whose forces on the nodes do not change as the body moves."""

    moments: ClassVar[bool] = False

    def nodal(self, where: Where) -> tuple[Ints, Floats]:
        """The nodes (k,) on which it acts, and the force [N] or moment [N m] on each (k, 3)."""
        raise NotImplementedError

    def add_to(self, builder: WorldBuilder, where: Where, *, number: int) -> None:
        """Put it on its body in the world."""
        nodes, forces = self.nodal(where)
        builder.add_load(
            nodes=nodes,
            forces=forces,
            moments=self.moments,
            faces=[(block.type, block.nodes) for block in where.faces] if self.on_surface else [],
            thickness=where.thickness,
            unit=self._unit(),
            along_normals=self.quantity == "pressure",
            **self._shared(number),
        )

    def _unit(self) -> Floats:
        """What multiplies the area of a face, or its normal (3,): edits take faces away."""
        value = getattr(self, self.quantity)
        return np.array(value if isinstance(value, tuple) else (-value, -value, -value))

    def made_of(self, where: Where) -> Floats:
        """What a run changes of it in the core: its value, as three numbers, and nodal forces."""
        return np.concatenate([_three(getattr(self, self.quantity)), self.nodal(where)[1].ravel()])


class NodalLoad(DeadLoad):
    """A total force shared equally by the selected nodes."""

    called: ClassVar[str] = "nodal load"
    quantity: ClassVar[str] = "force"
    type: Literal["nodal"] = "nodal"
    force: units.Force
    """total force [N]"""

    def nodal(self, where: Where) -> tuple[Ints, Floats]:
        """The nodes (k,) on which it acts, and the force on each (k, 3) [N]."""
        return where.nodes, _equal_shares(self.force, len(where.nodes))


class Moment(DeadLoad):
    """A total moment shared equally by the selected nodes, which are frames; it keeps its axis."""

    called: ClassVar[str] = "moment"
    quantity: ClassVar[str] = "moment"
    moments: ClassVar[bool] = True
    type: Literal["moment"] = "moment"
    moment: units.Moment
    """total moment [N m]"""

    def nodal(self, where: Where) -> tuple[Ints, Floats]:
        """The nodes (k,) on which it acts, and the moment on each (k, 3) [N m]."""
        return where.nodes, _equal_shares(self.moment, len(where.nodes))


class Traction(DeadLoad):
    """A force per rest area that keeps its direction, on faces whose nodes are all selected.

    Of a flat body (`plane`): on edges of its rim.
    """

    called: ClassVar[str] = "traction"
    quantity: ClassVar[str] = "traction"
    on_surface: ClassVar[bool] = True
    type: Literal["traction"] = "traction"
    traction: units.TractionVector
    """force per rest area [Pa]"""

    def nodal(self, where: Where) -> tuple[Ints, Floats]:
        """The nodes (k,) on which it acts, and the force on each (k, 3) [N]."""
        from tissu.mesh.whole_faces import nodal_areas

        shares = nodal_areas(where.mesh, where.faces, thickness=where.thickness)
        nodes = np.flatnonzero(shares).astype(np.int32)
        return nodes, shares[nodes, None] * np.array(self.traction)


class Pressure(DeadLoad):
    """A pressure that follows the surface, on faces whose nodes are all selected.

    Of a flat body (`plane`): on edges of its rim, per length along it and thickness at rest.
    """

    called: ClassVar[str] = "pressure"
    quantity: ClassVar[str] = "pressure"
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
        if not self.follows:
            super().add_to(builder, where, number=number)
            return
        builder.add_pressure(
            faces=[(block.type, block.nodes) for block in where.faces],
            pressure=self.pressure,
            thickness=where.thickness,
            **self._shared(number),
        )

    def nodal(self, where: Where) -> tuple[Ints, Floats]:
        """The nodes (k,) on which a dead pressure acts, and the force on each (k, 3) [N]."""
        from tissu.mesh.whole_faces import nodal_normals

        normals = nodal_normals(where.mesh, where.faces, thickness=where.thickness)
        nodes = np.flatnonzero(normals.any(axis=1)).astype(np.int32)
        return nodes, -self.pressure * normals[nodes]

    def made_of(self, where: Where) -> Floats:
        """What a run changes of it in the core: the pressure and, of a dead one, nodal forces."""
        return np.array([self.pressure]) if self.follows else super().made_of(where)


def _three(value: float | tuple[float, float, float]) -> Floats:
    """A value as three numbers, those that it does not have zero."""
    return np.array(value if isinstance(value, tuple) else (value, 0.0, 0.0))


def _equal_shares(total: tuple[float, float, float], count: int) -> Floats:
    """A total cut into `count` equal rows."""
    return np.tile(np.array(total) / count, (count, 1))


LOADS: tuple[type[Load], ...] = (NodalLoad, Moment, Traction, Pressure)
OneLoad = Annotated[Load, one_of(*LOADS)]
