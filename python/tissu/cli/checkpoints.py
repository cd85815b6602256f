"""Checkpoints of `tissu run`: when they are written, and where."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from tissu import units
from tissu.checkpoint import prepare_place
from tissu.cli.timetable import Timetable
from tissu.errors import ParameterError

if TYPE_CHECKING:
    from tissu.simulation import Simulation


@dataclass(slots=True)
class Checkpoints:
    """Writes one file again and again.

    Attributes:
        path: the file; None: none is written.
        times: when; None: at the end only.
        last_time: simulated time of the latest [s].
    """

    path: Path | None = None
    times: Timetable | None = None
    last_time: float = -1.0

    def begin(self, simulation: Simulation) -> None:
        """Counts from where the run begins; a checkpoint that it went on from is not due again."""
        if simulation.resumed_from is not None:
            self.last_time = simulation.time
        if self.times is not None:
            self.times.wait(simulation.time)

    def write_due(self, simulation: Simulation) -> None:
        """Writes it when its time has come.

        Raises:
            CheckpointError: it cannot be written.
        """
        if self.times is not None and self.times.is_due(simulation.time):
            self.write(simulation)
            self.times.wait(simulation.time)

    def write(self, simulation: Simulation) -> None:
        """Writes it, unless it stands at this time already.

        Raises:
            CheckpointError: it cannot be written.
        """
        if self.path is not None and simulation.time > self.last_time:
            simulation.save_checkpoint(self.path)
            self.last_time = simulation.time


def checkpoints_option(path: Path | None, every: str | None) -> Checkpoints:
    """What --checkpoint and --checkpoint-every ask for; the place is tried.

    Raises:
        ParameterError: a time without a file, or no positive time.
        CheckpointError: nothing can be written there.
    """
    if path is None and every is not None:
        raise ParameterError(
            "option --checkpoint-every: found without --checkpoint; name the file with it"
        )
    if path is not None:
        prepare_place(path)
    if every is None:
        return Checkpoints(path)
    return Checkpoints(path, Timetable(positive_time(every, "--checkpoint-every")))


def positive_time(text: str, option: str) -> float:
    """The time that an option gives [s].

    Raises:
        ParameterError: it is not a positive time.
    """
    try:
        time = units.TIME(text)
    except ParameterError as error:
        raise ParameterError(f"option {option}: {error}") from None
    if time <= 0.0:
        raise ParameterError(f"option {option}: found '{text}'; more than 0 s is accepted")
    return time
