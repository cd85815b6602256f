"""`tissu run`: from a scene file to a folder of results."""

from __future__ import annotations

import contextlib
import math
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from tissu.cli.checkpoints import Checkpoints, checkpoints_option, positive_time
from tissu.cli.interruption import Interruption, interruption
from tissu.cli.outcome import DIVERGED, FINISHED, complain
from tissu.cli.progress import RunProgress
from tissu.cli.timetable import Timetable
from tissu.counted import counted
from tissu.errors import Diverged, TissuError
from tissu.output import Series, StepTally, prepare_folder, summarise, write_summary

if TYPE_CHECKING:
    from tissu.checkpoint import Resumed
    from tissu.front import Scene
    from tissu.simulation import Simulation

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Job:
    """What the command line asks for; None: what the scene says."""

    scene: Path
    out: Path
    duration: str | None
    threads: int | None
    quiet: bool
    resume: Path | None = None
    checkpoint: Path | None = None
    checkpoint_every: str | None = None
    picture: bool = True


@dataclass(slots=True)
class Clock:
    """Wall time by stage [s]."""

    seconds: dict[str, float] = field(default_factory=dict)

    @contextlib.contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Adds the time spent inside to a stage."""
        begin = time.perf_counter()
        try:
            yield
        finally:
            self.seconds[name] = self.seconds.get(name, 0.0) + time.perf_counter() - begin

    def timed(self, name: str, items: Iterator[T]) -> T | None:
        """The next item, None at the end; the time it takes is added to a stage."""
        with self.stage(name):
            return next(items, None)


@dataclass(frozen=True, slots=True)
class Ending:
    """How a run ended.

    Attributes:
        status: "finished", "interrupted", "diverged", or "stopped": a step was refused.
        code: exit code of the command.
        message: why it is not finished.
        error: what stopped it.
    """

    status: str
    code: int
    message: str = ""
    error: TissuError | None = None


def run_scene(job: Job, *, debug: bool = False) -> int:
    """Runs a scene and writes its results; returns the exit code.

    Raises:
        SceneError: problems of the scene; all of them.
        CheckpointError: it cannot go on from the checkpoint, or write one.
        TissuError: the output folder cannot be written.
    """
    clock, tally = Clock(), StepTally()
    with clock.stage("compile"):
        scene = load(job)
        folder = prepare_folder(job.out)
        checkpoints = checkpoints_option(job.checkpoint, job.checkpoint_every)
        simulation = scene.compile(checkpoint=job.resume)
    with interruption() as interrupted:
        series = Series(simulation, folder)
        files = Files(series, checkpoints, Timetable(span(scene)[1]), clock)
        ending = advance(simulation, files, tally, interrupted, quiet=job.quiet)
        picture = drawn(simulation, series, clock) if job.picture else None
        conclude(simulation, series, tally, clock, ending, picture)
    if not job.quiet:
        report(simulation, series, tally, clock, picture)
    if ending.error is not None and debug:
        raise ending.error
    if ending.message:
        complain(ending.message)
    return ending.code


def load(job: Job) -> Scene:
    """The scene with what the command line changes.

    Raises:
        ParameterError: an option is not accepted.
        SceneError: problems of the scene; all of them.
    """
    from tissu.front import Scene, accepted
    from tissu.yaml_io import read_scene

    duration = None if job.duration is None else positive_time(job.duration, "--duration")
    scene = accepted(read_scene(job.scene, Scene, to_run=duration is None))
    asked = {"duration": duration, "threads": job.threads}
    changes = {name: value for name, value in asked.items() if value is not None}
    return scene.replace(**changes) if changes else scene


@dataclass(slots=True)
class Files:
    """What is written while the scene runs, at the times when it is due."""

    series: Series
    checkpoints: Checkpoints
    times: Timetable
    clock: Clock

    def begin(self, simulation: Simulation) -> None:
        """Writes what a series begins with."""
        self.times.wait(simulation.time)
        self.checkpoints.begin(simulation)
        if self.series.count == 0:
            self._write(simulation)

    def write_due(self, simulation: Simulation) -> None:
        """Writes what is due after a step."""
        if self.times.is_due(simulation.time):
            self._write(simulation)
            self.times.wait(simulation.time)
        with self.clock.stage("output"):
            self.checkpoints.write_due(simulation)

    def end(self, simulation: Simulation, ending: Ending) -> None:
        """Writes the last results, and the checkpoint of a run that can go on."""
        self._write(simulation)
        if ending.error is None:
            with self.clock.stage("output"):
                self.checkpoints.write(simulation)

    def _write(self, simulation: Simulation) -> None:
        if simulation.time > self.series.last_time:
            with self.clock.stage("output"):
                self.series.write()


def advance(
    simulation: Simulation,
    files: Files,
    tally: StepTally,
    interrupted: Interruption,
    *,
    quiet: bool,
) -> Ending:
    """Steps to the end and writes results on the way."""
    duration, _ = span(simulation.scene)
    ending = Ending("finished", FINISHED)
    files.begin(simulation)
    with RunProgress(duration, quiet=quiet, start=simulation.time) as progress:
        steps = iter(simulation.run(until=duration))
        try:
            while (step := files.clock.timed("steps", steps)) is not None:
                tally.add(step)
                progress.advance(simulation.time)
                files.write_due(simulation)
                if interrupted.number:
                    when = f"{interrupted.word} at t = {simulation.time:.4g} s"
                    text = f"{when}; all files are complete"
                    ending = Ending("interrupted", interrupted.code, text)
                    break
        except TissuError as error:
            status = "diverged" if isinstance(error, Diverged) else "stopped"
            ending = Ending(status, DIVERGED, str(error), error)
    files.end(simulation, ending)
    return ending


def span(scene: Scene) -> tuple[float, float]:
    """Simulated time of the run, and between two written results [s]."""
    duration = scene.duration or 1.0
    return duration, scene.output.every if scene.output is not None else duration / 50


def drawn(simulation: Simulation, series: Series, clock: Clock) -> Path:
    """Draws the picture; returns where it is."""
    picture = series.index.with_suffix(".png")
    with clock.stage("picture"):
        from tissu.picture import draw

        draw(simulation, picture)
    return picture


def conclude(
    simulation: Simulation,
    series: Series,
    tally: StepTally,
    clock: Clock,
    ending: Ending,
    picture: Path | None,
) -> None:
    """Writes the summary."""
    files = {"series": series.index.name}
    if picture is not None:
        files["picture"] = picture.name
    summary = summarise(
        simulation,
        tally=tally,
        status=ending.status,
        wall_seconds=clock.seconds,
        files=files,
        notes=[note for note in (ending.message, series.inverted) if note],
    )
    write_summary(series.index.with_name("summary.json"), summary)


def report(
    simulation: Simulation, series: Series, tally: StepTally, clock: Clock, picture: Path | None
) -> None:
    """Prints what the steps cost and where the results are."""
    print(simulation.profile())
    spent = ", ".join(f"{name} {seconds:.2f} s" for name, seconds in clock.seconds.items())
    print(f"\n{counted(tally.steps, 'step')} to t = {simulation.time:.4g} s; {spent}")
    if tally.unconverged:
        share = f"{tally.unconverged} of {counted(tally.steps, 'step')}"
        print(f"{share} did not converge, the first: {tally.first_unconverged}")
    if tally.indefinite:
        print(f"{counted(tally.indefinite, 'system')} not positive definite, and made so")
    if math.isfinite(simulation.stable_step):
        print(f"stable up to {simulation.stable_step:.4g} s a step at the end")
    if simulation.resumed_from is not None:
        print(resumed_words(simulation.resumed_from))
    if series.inverted:
        print(series.inverted)
    print(f"result:  {series.index} ({counted(series.count, 'time')})")
    print(f"summary: {series.index.with_name('summary.json')}")
    if picture is not None:
        print(f"picture: {picture}")


def resumed_words(resumed: Resumed) -> str:
    """From where a run went on, and what is to be known of it."""
    taken = counted(resumed.steps, "step")
    text = f"went on from {resumed.file}, at t = {resumed.time:.4g} s after {taken}"
    return f"{text}; {resumed.note}" if resumed.note else text
