"""Supports: nodes held in place, or moved along a given path."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from pydantic import AfterValidator, BeforeValidator

from tissu import units
from tissu.counted import counted
from tissu.errors import ParameterError
from tissu.reading import Many, MaybeVectors, Read, VectorLike, listed
from tissu.scene.axes import Axes, Rotations, mask_of
from tissu.scene.direction import scaled
from tissu.scene.effect import Effect
from tissu.scene.field import field
from tissu.scene.part import Part
from tissu.scene.problem import Problem
from tissu.scene.selection import Floats, Ints, On
from tissu.scene.unknown import rule

if TYPE_CHECKING:
    from tissu._core import WorldBuilder

__all__ = ["Fixed", "Prescribed", "Rotation"]


def increasing(times: tuple[float, ...]) -> tuple[float, ...]:
    """The times, when there is at least one and they increase.

    Raises:
        ParameterError: no time, or one that does not follow the one before.
    """
    if not times:
        raise ParameterError("found no time; at least one is accepted")
    for before, after in itertools.pairwise(times):
        if after <= before:
            raise ParameterError(
                f"found {after:g} s after {before:g} s; strictly increasing times are accepted"
            )
    return times


def same_length(name: str, values: Sequence[object], times: Sequence[float]) -> Iterator[Problem]:
    """A problem when a list has not one value for each time."""
    if len(values) != len(times):
        found = f"found {counted(len(values), name)} for {counted(len(times), 'time')}"
        yield Problem((), f"{found}; one for each time is accepted")


_POSITION = units.Triple(units.LENGTH)


def _rows(value: object) -> object:
    """Displacements [m] of each node at each time."""
    value = listed(value)
    return None if value is None else tuple(_row(row) for row in _list(value, "time"))


def _row(value: object) -> tuple[tuple[float | None, ...], ...]:
    return tuple(_POSITION(place) for place in _list(listed(value), "node"))


def _list(value: object, of: str) -> Sequence[object]:
    if isinstance(value, (list, tuple)):
        return value
    raise ParameterError(f"found {value!r}; a list with an entry for each {of} is accepted")


IncreasingTimes = Annotated[Many[units.Time], AfterValidator(increasing)]


_Rows = tuple[tuple[tuple[float, float, float], ...], ...]
_OfNodes = Annotated[
    Read[_Rows | None, Sequence[Sequence[VectorLike]] | np.ndarray[Any, Any] | None],
    BeforeValidator(_rows),
]


class Support(Part):
    """The common part of supports: the nodes of a body that they give a motion."""

    body: str = field(kw_only=False)
    """name of a body of the scene"""
    on: On
    """which nodes: a box, sphere, plane, nodes, surface or region"""
    name: str | None = None
    """name by which a running simulation moves it, see `Simulation.lead`"""

    if TYPE_CHECKING:
        axes: Axes
        rotations: Rotations

    @rule("axes", "rotations")
    def _gives_something(self) -> Iterator[Problem]:
        if self.axes == "free" and self.rotations in (None, "free"):
            text = "found axes free, so that nothing is held; letters out of xyz are accepted, "
            yield Problem((), text + "or rotations: held beside it")

    @property
    def axes_mask(self) -> int:
        """Bit mask of the axes: x = 1, y = 2, z = 4."""
        return 0 if self.axes == "free" else mask_of(self.axes)

    @property
    def rotations_mask(self) -> int:
        """Bit mask of the axes about which it gives the rotation of nodes that are frames."""
        given = self.rotations or ("held" if self.axes == "xyz" else "free")
        return {"held": 7, "free": 0}[given] if given in ("held", "free") else mask_of(given)

    @property
    def needs_rotations(self) -> str | None:
        """What of it only nodes that are frames have, in words; None: nothing."""
        if self.rotations in (None, "free"):
            return None
        return f"rotations {self.rotations}"

    @property
    def on_words(self) -> str:
        """The axes on which it holds nodes, in words."""
        words = "" if self.axes == "free" else f" on {self.axes}"
        if self.needs_rotations is None:
            return words
        about = "" if self.rotations == "held" else f" about {self.rotations}"
        return f"{words}{' and' if words else ''} in rotation{about}"

    def effect(self, path: str, count: str | None) -> Effect:
        """The effect that it switches on; `count` where it is known ("42 nodes")."""
        raise NotImplementedError

    def misfit(self, nodes: Ints) -> str | None:
        """What of it does not fit the selected nodes; None: nothing."""
        return None

    def add_to(self, builder: WorldBuilder, nodes: Ints, *, frames: bool) -> None:
        """Give the nodes of its body their motion in the world; `frames`: they have a rotation."""
        raise NotImplementedError


class Fixed(Support):
    """Nodes that stay where they are at rest, on some or all axes."""

    axes: Axes = "xyz"
    """axes held: letters out of xyz, or free: only the rotation is held"""
    rotations: Rotations = None
    """of nodes that are frames: held, free, or letters out of xyz, the axes of space about which
    they do not turn (yz on a plane of symmetry across x); absent: held where all axes are
    """

    def effect(self, path: str, count: str | None) -> Effect:
        """The effect that it switches on; `count` where it is known ("42 nodes")."""
        why = f"{path} holds {self.on.words(count)}{self.on_words}"
        return Effect(f"fixed nodes of {self.body}", why)

    def add_to(self, builder: WorldBuilder, nodes: Ints, *, frames: bool) -> None:
        """Hold the nodes of its body in the world; `frames`: they have a rotation."""
        rotations = self.rotations_mask if frames else 0
        builder.fix(
            body=self.body,
            nodes=nodes,
            axes=self.axes_mask,
            rotations=rotations,
            name=self.name or "",
        )


class Rotation(Part):
    """A rotation about a fixed axis, by an angle that changes with time."""

    axis: units.Direction
    """direction of the axis, of any length but zero"""
    center: units.Position = field(default=(0.0, 0.0, 0.0))
    """a point of the axis [m]"""
    angles: Many[units.Angle]
    """angle at each time [rad]"""

    @rule("axis")
    def _has_axis(self) -> Iterator[Problem]:
        if not any(self.axis):
            text = "found the axis (0, 0, 0); a direction is accepted, such as [0, 0, 1]"
            yield Problem((), text)


class Prescribed(Support):
    """Nodes moved along a path: a rotation, then a displacement, both linear between the times."""

    axes: Axes = "xyz"
    """axes moved: letters out of xyz, or free: the rotation turns the nodes and leaves their places
    free
    """
    rotations: Rotations = None
    """of nodes that are frames: held (given by `rotation`, or none), free, or without `rotation`
    letters out of xyz, the axes of space about which they do not turn; absent: held where all axes
    are moved
    """
    times: IncreasingTimes
    """strictly increasing times [s]"""
    displacements: MaybeVectors[Many[units.Position]] = field(default=None)
    """displacement from rest at each time [m]; absent: none"""
    node_displacements: _OfNodes = field(default=None)
    """displacement from rest of each node at each time [m], in addition to those of all nodes;
    nodes are in the order of the `ids` of `on`, otherwise by increasing number
    """
    rotation: Rotation | None = None
    """rotation from rest; absent: none"""

    @rule("displacements", "rotation", "node_displacements")
    def _moves(self) -> Iterator[Problem]:
        moves = (self.displacements, self.rotation, self.node_displacements)
        if all(move is None for move in moves):
            text = "found neither displacements nor rotation; at least one is needed"
            yield Problem((), text)

    @rule("axes", "displacements", "node_displacements")
    def _moves_on_axes(self) -> Iterator[Problem]:
        if self.axes == "free" and (self.displacements or self.node_displacements):
            text = "found displacements with axes free, which leaves places free; "
            yield Problem((), text + "letters out of xyz are accepted with them")

    @rule("rotations", "rotation")
    def _turns_about_all_axes(self) -> Iterator[Problem]:
        if self.rotation is not None and self.rotations not in (None, "held", "free"):
            text = f"found rotations {self.rotations} beside a rotation, which is one about all "
            yield Problem((), text + "axes; held and free are accepted")

    @rule("displacements", "times")
    def _displaced_at_each_time(self) -> Iterator[Problem]:
        if self.displacements is not None:
            yield from same_length("displacement", self.displacements, self.times)

    @rule("node_displacements", "times")
    def _every_node_at_each_time(self) -> Iterator[Problem]:
        rows = self.node_displacements
        if rows is not None:
            yield from same_length("list of node displacement", rows, self.times)
            if len({len(row) for row in rows}) > 1:
                yield Problem((), "found lists of several lengths; one for each node is accepted")

    @rule("rotation", "times")
    def _turned_at_each_time(self) -> Iterator[Problem]:
        if self.rotation is not None:
            yield from same_length("rotation angle", self.rotation.angles, self.times)

    def effect(self, path: str, count: str | None) -> Effect:
        """The effect that it switches on; `count` where it is known ("42 nodes")."""
        end = f"until {self.times[-1]:g} s"
        why = f"{path} moves {self.on.words(count)}{self.on_words} {end}"
        return Effect(f"prescribed motion of {self.body}", why)

    def misfit(self, nodes: Ints) -> str | None:
        """What of it does not fit the selected nodes; None: nothing."""
        if self.node_displacements is None:
            return None
        given = len(self.node_displacements[0])
        named = getattr(self.on, "ids", nodes)
        if given == len(named) == len(nodes):
            return None
        if len(named) != len(nodes):
            return "found a node twice among `ids`; each once is accepted"
        found = f"found node displacements of {counted(given, 'node')} for {len(nodes)} selected"
        return f"{found}; one for each of them is accepted"

    def start_velocities(self, nodes: Ints, rest: Floats) -> tuple[Floats, Floats]:
        """Velocities [m/s] (k, 3) of `nodes`, and their spin [rad/s] (3,), right after t = 0.

        Args:
            nodes: those that it leads, (k,).
            rest: their rest positions [m] (k, 3).
        """
        after = int(np.searchsorted(self.times, 0.0, side="right"))
        if after in (0, len(self.times)):  # before its first time and after its last, nothing moves
            return np.zeros_like(rest), np.zeros(3)
        before, length = after - 1, self.times[after] - self.times[after - 1]
        velocities, spin = np.zeros_like(rest), np.zeros(3)
        if (shared := self.displacements) is not None:
            velocities += np.subtract(shared[after], shared[before]) / length
        if self.node_displacements is not None:
            own = np.subtract(self.node_displacements[after], self.node_displacements[before])
            order = np.asarray(getattr(self.on, "ids", nodes), dtype=np.int32)
            places = np.argsort(order)[np.searchsorted(np.sort(order), nodes)]
            velocities += own[places] / length
        if self.rotation is not None:
            axis, angles = np.array(scaled(self.rotation.axis)), self.rotation.angles
            spin = (angles[after] - angles[before]) / length * axis
            angle = float(np.interp(0.0, self.times, angles))
            arms = rest - np.array(self.rotation.center)
            along = np.outer(arms @ axis, axis)
            turned = along + np.cos(angle) * (arms - along) + np.sin(angle) * np.cross(axis, arms)
            velocities += np.cross(spin, turned)
        return velocities, spin

    def add_to(self, builder: WorldBuilder, nodes: Ints, *, frames: bool) -> None:
        """Lead the nodes of its body in the world; `frames`: they have a rotation."""
        moves = self.displacements
        shared = np.zeros((len(self.times), 3)) if moves is None else np.array(moves)
        if self.node_displacements is not None:
            own = np.array(self.node_displacements)
            nodes = np.asarray(getattr(self.on, "ids", nodes), dtype=np.int32)
            parts = [(nodes[k : k + 1], shared + own[:, k]) for k in range(len(nodes))]
        else:
            parts = [(nodes, shared)]
        for some, displacements in parts:
            self._lead(builder, some, displacements, frames=frames)

    def _lead(
        self, builder: WorldBuilder, nodes: Ints, displacements: Floats, *, frames: bool
    ) -> None:
        """Lead nodes that have one displacement (t, 3) [m]."""
        turn, still = self.rotation, np.zeros(len(self.times))
        builder.prescribe(
            body=self.body,
            nodes=nodes,
            axes=self.axes_mask,
            rotations=self.rotations_mask if frames else 0,
            times=np.array(self.times),
            displacements=displacements,
            angles=still if turn is None else np.array(turn.angles),
            center=np.zeros(3) if turn is None else np.array(turn.center),
            axis=scaled((0.0, 0.0, 1.0) if turn is None else turn.axis),
            name=self.name or "",
        )
