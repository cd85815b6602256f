"""Instruments of a simulation: what they do at the end of each step, and how they are moved."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.cutting.kinds import ablator_of, knife_of, tough_knife_of
from tissu.cutting.pose import Pose, pose_of
from tissu.cutting.way import pose_at, poses_on
from tissu.errors import ParameterError
from tissu.simulation import pressing
from tissu.simulation.ablating import ablate_with
from tissu.simulation.entry import one_thread_at_a_time
from tissu.simulation.known_names import known_names_only
from tissu.simulation.repairing import repair_ended, repairs
from tissu.simulation.slicing import cut_with, edge_of
from tissu.simulation.track import Track, anchored, anchored_in_tissue, keep, tracks

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from tissu.cutting.report import CutReport
    from tissu.reading import VectorLike
    from tissu.scene.instrument import Instrument
    from tissu.simulation.simulation import Simulation

Floats = NDArray[np.float64]

_FARTHEST = 1e3
"""m: an instrument is nearer to the origin of the scene"""


@known_names_only
@one_thread_at_a_time
class Tool:
    """An instrument of the scene by its name; made by `Simulation.instruments`.

    Its cuts are reported in `StepReport.cuts` of the following step.
    """

    def __init__(self, *, simulation: Simulation, name: str) -> None:
        """Take an instrument of the scene."""
        self._simulation = simulation
        self._entry = simulation._entry
        self._name = name

    def __repr__(self) -> str:
        """What it is called, and where it is."""
        x, y, z = self.position
        kind = self._simulation.scene.instruments[self._name].type
        return f"Tool('{self._name}', {kind} at ({x:g}, {y:g}, {z:g}) m)"

    @property
    def name(self) -> str:
        """Name of the instrument."""
        return self._name

    @property
    def position(self) -> Floats:
        """Place of its origin, or the place that it goes to in the next step (3,) [m]."""
        return np.array(self._pose().position)

    @property
    def rotation(self) -> Floats:
        """Its rotation, as a matrix (3, 3)."""
        return self._pose().matrix()

    @property
    def edge(self) -> Floats:
        """Places of the points of its edge, or of the ends of its axis (m, 3) [m]."""
        return self._pose().place(self._simulation.scene.instruments[self._name].points())

    @property
    def force(self) -> Floats:
        """Force of the tissue on it in the latest step (3,) [N].

        Raises:
            ParameterError: it is not a knife with a toughness.
        """
        if tough_knife_of(self._simulation.scene.instruments[self._name]) is None:
            raise ParameterError(
                f"found the force on '{self._name}', which cuts without one; a knife with a "
                "toughness has it"
            )
        return pressing.force_on(self._simulation, self._name)

    def move(self, position: VectorLike, rotation: VectorLike | ArrayLike | None = None) -> None:
        """Move it to a place, which it reaches at the end of the next step.

        Several moves before a step form one path with several corners.

        Args:
            position: of its origin (3,) [m].
            rotation: a vector along the axis, as long as the angle (3,) [rad], or a rotation matrix
                (3, 3); None: its present rotation.

        Raises:
            ParameterError: it follows a path; a value is not finite or of another quantity; a
                matrix that is not a rotation.
        """
        pose = self._moved_to(position, rotation)
        known = self._simulation._tracks()
        for number in _numbers(self._simulation, self._name):
            known[number] = known[number].moved([pose])
        keep(self._simulation._core, known)

    def place(self, position: VectorLike, rotation: VectorLike | ArrayLike | None = None) -> None:
        """Put it at a place at once, without cutting on the way; a new incision begins there.

        Raises:
            ParameterError: see `move`.
        """
        pose = self._moved_to(position, rotation)
        known = self._simulation._tracks()
        for number in _numbers(self._simulation, self._name):
            known[number] = _begun(self._simulation, number, pose)
        keep(self._simulation._core, known)
        pressing.let_go(self._simulation, self._name)

    def _pose(self) -> Pose:
        known = self._simulation._tracks()
        return known[_numbers(self._simulation, self._name)[0]].poses[-1]

    def _moved_to(self, position: VectorLike, rotation: VectorLike | ArrayLike | None) -> Pose:
        if self._simulation.scene.instruments[self._name].path is not None:
            raise ParameterError(
                f"found a move of '{self._name}', which its path leads; an instrument without a "
                "path is accepted"
            )
        pose = pose_of(position, rotation)
        if not np.abs(pose.position).max() <= _FARTHEST:
            raise ParameterError(
                f"found a place {np.abs(pose.position).max():g} m from the origin for "
                f"'{self._name}'; at most {_FARTHEST:g} m is accepted"
            )
        return pose if rotation is not None else Pose(pose.position, self._pose().turn)


class _ByName(dict[str, Tool]):
    """Instruments by name; another name is refused in a sentence."""

    def __missing__(self, name: str) -> Tool:
        known = ", ".join(self) or "none, since the scene has no instruments"
        raise ParameterError(f"found instrument {name!r}; accepted: {known}")


class Instrumented:
    """The part of a simulation that has instruments."""

    _late_cuts: tuple[CutReport, ...] = ()
    """of a step that raised because another cut of it was refused; the next step reports them"""

    @property
    def instruments(self: Simulation) -> Mapping[str, Tool]:  # type: ignore[misc]
        """The instruments of the scene by their names."""
        found = _ByName({name: Tool(simulation=self, name=name) for name in self.scene.instruments})
        return MappingProxyType(found)

    def _instrument_pairs(self: Simulation) -> list[tuple[str, str]]:  # type: ignore[misc]
        """Instrument and body of each track, in the order of their numbers."""
        tools = self.scene.instruments.items()
        return [(name, body) for name, tool in tools for body in tool.bodies]

    def _tracks(self: Simulation) -> dict[int, Track]:  # type: ignore[misc]
        """The tracks of the present state; before the first step those that it begins with."""
        known = tracks(self._core)
        if known:
            return known
        for number, (name, _) in enumerate(self._instrument_pairs()):
            known[number] = _begun(self, number, _first_pose(self.scene.instruments[name], self))
        keep(self._core, known)
        return known

    def _lead_instruments(self: Simulation, end: float) -> None:  # type: ignore[misc]
        """Before a step that ends at a time [s]: edges press towards where they will be."""
        known = self._tracks()
        pressing.press(self, known, end)

    def _use_instruments(self: Simulation, begin: float) -> tuple[CutReport, ...]:  # type: ignore[misc]
        """After a step that began at a time [s]: what they cut and take away.

        Raises:
            ParameterError: the step was taken, and a cut of it is refused. The other instruments
                have done their work, which the next step reports.
        """
        reports, refused = list(self._late_cuts), []
        self._late_cuts = ()
        for number, (name, body) in enumerate(self._instrument_pairs()):
            instrument = self.scene.instruments[name]
            track = self._tracks()[number]
            if instrument.path is not None:
                track = track.moved(poses_on(instrument.path, begin, self.time))
            try:
                report, track = _used(self, name, body, track)
            except ParameterError as error:
                refused.append(
                    f"instruments.{name}: step {self._steps} was taken, and what it would do at "
                    f"its end is refused: {error}"
                )
                continue
            goes_on = self._tracks()[number].incision >= 0
            keep(self._core, {**self._tracks(), number: track})
            reports += [] if report is None else [report]
            if goes_on and track.incision < 0 and repairs(self, body):
                repair = repair_ended(self, name, body)
                reports += [] if repair is None else [repair]
        if refused:
            self._late_cuts = tuple(reports)
            raise ParameterError("\n".join(refused))
        return tuple(reports)


def _used(
    simulation: Simulation, name: str, body: str, track: Track
) -> tuple[CutReport | None, Track]:
    instrument = simulation.scene.instruments[name]
    tip, knife = ablator_of(instrument), knife_of(instrument)
    if tip is not None:
        return ablate_with(simulation, name, tip, body, track)
    assert knife is not None
    use = cut_with if knife.toughness is None else pressing.cut_pressing
    return use(simulation, name, knife, body, track)


def _begun(simulation: Simulation, number: int, pose: Pose) -> Track:
    """A track of an instrument that begins where it is."""
    name, body = simulation._instrument_pairs()[number]
    knife = knife_of(simulation.scene.instruments[name])
    if knife is None:
        return Track(number=number, incision=-1, poses=(pose,), rows=())
    edge = edge_of(simulation, knife)
    places = pose.place(edge)
    if body in simulation._links:
        row = anchored_in_tissue(simulation, body, places)
    else:
        row = anchored(simulation._core, body, places)
    return Track(number=number, incision=-1, poses=(pose,), rows=(row,))


def _first_pose(instrument: Instrument, simulation: Simulation) -> Pose:
    if instrument.path is not None:
        return pose_at(instrument.path, simulation.time)
    return pose_of(instrument.position, instrument.rotation)


def _numbers(simulation: Simulation, name: str) -> list[int]:
    pairs = simulation._instrument_pairs()
    return [number for number, (tool, _) in enumerate(pairs) if tool == name]
