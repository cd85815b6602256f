"""A point of a body that is pulled to a target while a simulation runs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu import units
from tissu.errors import ParameterError
from tissu.simulation.entry import one_thread_at_a_time
from tissu.simulation.grab_point import GrabPoint
from tissu.simulation.known_names import known_names_only

if TYPE_CHECKING:
    from tissu import _core as core
    from tissu.reading import Number, VectorLike
    from tissu.simulation.entry import Entry

Floats = NDArray[np.float64]

MEMORY = "grabs"  # of the core, with the numbers of `Record` one after the other
_HEAD = 11
_POSITION = units.Triple(units.LENGTH)


def target_of(value: VectorLike) -> Floats:
    """A place in space (3,) [m]."""
    return np.array(_POSITION(value), dtype=float)


def stiffness_of(value: Number | str) -> float:
    """A stiffness [N/m].

    Raises:
        ParameterError: it is not positive.
    """
    stiffness = units.STIFFNESS(value)
    if not stiffness > 0.0:
        raise ParameterError(f"found a stiffness of {stiffness:g} N/m; a positive one is accepted")
    return stiffness


@dataclass(slots=True)
class Record:
    """A grab as the core keeps it in the memory of its state.

    Attributes:
        number: of the grab.
        stiffness: [N/m].
        target: (3,) [m].
        nodes: rows (k,) of the unknowns that carry the point, and
        weights: their weights (k,), which sum to one.
        frame: number of the frame that turns it, -1: none, and
        rotation: the row of its rotation.
        place: (3,) from the frame's origin, in its axes [m].
    """

    number: int
    stiffness: float
    target: Floats
    nodes: NDArray[np.int64]
    weights: Floats
    frame: int
    rotation: int
    place: Floats

    def numbers(self) -> Floats:
        """The numbers of the core."""
        head = [self.number, self.stiffness, *self.target, self.frame, self.rotation, *self.place]
        parts = np.column_stack([self.nodes, self.weights]).ravel()
        return np.concatenate([np.array([*head, len(self.nodes)], dtype=float), parts])


def records(simulation: core.Simulation, memory: str = MEMORY) -> dict[int, Record]:
    """The grabs of the present state by their numbers, in their order."""
    numbers, found = simulation.remembered(memory), {}
    while len(numbers):
        end = _HEAD + 2 * int(numbers[10])
        parts = numbers[_HEAD:end].reshape(-1, 2)
        found[int(numbers[0])] = Record(
            number=int(numbers[0]),
            stiffness=float(numbers[1]),
            target=numbers[2:5].copy(),
            nodes=parts[:, 0].astype(np.int64),
            weights=parts[:, 1].copy(),
            frame=int(numbers[5]),
            rotation=int(numbers[6]),
            place=numbers[7:10].copy(),
        )
        numbers = numbers[end:]
    return found


def keep(simulation: core.Simulation, grabs: dict[int, Record], memory: str = MEMORY) -> None:
    """Make these the grabs of the present state."""
    numbers = [np.empty(0), *(grab.numbers() for grab in grabs.values())]
    simulation.set_remembered(memory, np.concatenate(numbers))


@known_names_only
@one_thread_at_a_time
class Grab:
    """A spring of zero rest length from a point of a body to a target in space.

    It pulls with f = stiffness (target - position). It is made by `Simulation.grab`, and found
    again by `Simulation.grabs`, also in a simulation that continues from a checkpoint.
    """

    def __init__(
        self, *, simulation: core.Simulation, entry: Entry, number: int, body: str
    ) -> None:
        """Take the grab that the core has by this number."""
        self._core = simulation
        self._entry = entry
        self._number = number
        self._body = body

    def __repr__(self) -> str:
        """The body, and where it is pulled to."""
        record = records(self._core).get(self._number)
        if record is None:
            return f"Grab(of '{self._body}', let go)"
        x, y, z = record.target
        return f"Grab(of '{self._body}' to ({x:g}, {y:g}, {z:g}) m, {record.stiffness:g} N/m)"

    @property
    def number(self) -> int:
        """Number of the grab in its simulation, which `CutReport.released` lists; the first is 1.

        It stays when the grab is released, and no later grab of this simulation has it.
        """
        return self._number

    @property
    def body(self) -> str:
        """Name of the body."""
        return self._body

    @property
    def released(self) -> bool:
        """Whether it was released."""
        return self._number not in records(self._core)

    @property
    def target(self) -> Floats:
        """The place that the point is pulled to (3,) [m]; a copy: assign another one to move it."""
        return self._record().target

    @target.setter
    def target(self, value: VectorLike) -> None:
        self._change(target=target_of(value))

    @property
    def stiffness(self) -> float:
        """Stiffness of the spring [N/m]."""
        return self._record().stiffness

    @stiffness.setter
    def stiffness(self, value: Number | str) -> None:
        self._change(stiffness=stiffness_of(value))

    @property
    def position(self) -> Floats:
        """Present place of the point (3,) [m]."""
        record = self._record()
        self._core.settle()
        place = record.weights @ self._core.positions[record.nodes]
        if record.frame >= 0:
            first, _ = self._core.frames_of(self._body)
            place = place + self._core.rotations(self._body)[record.frame - first] @ record.place
        return np.asarray(place)

    @property
    def force(self) -> Floats:
        """Its present force on the body (3,), stiffness (target - position) [N]."""
        record = self._record()
        return np.asarray(record.stiffness * (record.target - self.position))

    @property
    def point(self) -> GrabPoint:
        """The nodes of the body that carry the point, and how."""
        record = self._record()
        first, _ = self._core.body_range(self._body)
        offset = record.place.copy() if record.frame >= 0 else None
        return GrabPoint(record.nodes - first, record.weights.copy(), offset)

    def release(self) -> None:
        """Release the point; a second call does nothing."""
        grabs = records(self._core)
        if grabs.pop(self._number, None) is not None:
            keep(self._core, grabs)

    def _record(self) -> Record:
        record = records(self._core).get(self._number)
        if record is None:
            raise ParameterError(
                f"found a grab of '{self._body}' that was let go; one that holds is accepted: "
                "take a new one by `grab`"
            )
        return record

    def _change(self, target: Floats | None = None, stiffness: float | None = None) -> None:
        self._record()
        grabs = records(self._core)
        record = grabs[self._number]
        record.target = record.target if target is None else target
        record.stiffness = record.stiffness if stiffness is None else stiffness
        keep(self._core, grabs)
