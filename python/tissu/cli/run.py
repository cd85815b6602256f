"""`tissu run`: from a scene file to a folder of results."""

from __future__ import annotations

import contextlib
import signal
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, TypeVar

from tissu.cli.outcome import DIVERGED, FINISHED, INTERRUPTED, complain
from tissu.cli.progress import RunProgress
from tissu.errors import Diverged, SceneError
from tissu.output import Series, StepTally, prepare_folder, summarise, write_summary

if TYPE_CHECKING:
    from tissu.scene import Scene
    from tissu.simulation import Simulation

T = TypeVar("T")

CODES = {"finished": FINISHED, "diverged": DIVERGED, "interrupted": INTERRUPTED}


@dataclass(frozen=True, slots=True)
class Job:
    """What the command line asks for; None: what the scene says."""

    scene: Path
    out: Path
    duration: str | None
    threads: int | None
    quiet: bool


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
        status: "finished", "interrupted" or "diverged".
        message: why it is not finished.
        error: what stopped it.
    """

    status: str
    message: str = ""
    error: Diverged | None = None


def run_scene(job: Job, *, debug: bool = False) -> int:
    """Runs a scene and writes its results; returns the exit code.

    Raises:
        SceneError: problems of the scene; all of them.
        TissuError: the output folder cannot be written.
    """
    clock, tally = Clock(), StepTally()
    with clock.stage("compile"):
        scene = load(job)
        folder = prepare_folder(job.out)
        simulation = scene.compile()
    with interruption() as interrupted:
        series = Series(simulation, folder)
        ending = advance(simulation, series, tally, clock, interrupted, quiet=job.quiet)
        picture = conclude(simulation, series, tally, clock, ending)
    if not job.quiet:
        report(simulation, series, tally, clock, picture)
    if ending.error is not None and debug:
        raise ending.error
    if ending.message:
        complain(ending.message)
    return CODES[ending.status]


def load(job: Job) -> Scene:
    """The scene with what the command line changes."""
    from tissu.scene import Scene

    scene = Scene.from_yaml(job.scene)
    asked = {"duration": job.duration, "threads": job.threads}
    changes = {name: value for name, value in asked.items() if value is not None}
    if changes:
        scene = scene.replace(**changes)
    if scene.duration is None and scene.step.type != "static":
        raise SceneError([f"{job.scene}: duration: is missing; give it here or by --duration"])
    return scene


def advance(
    simulation: Simulation,
    series: Series,
    tally: StepTally,
    clock: Clock,
    interrupted: threading.Event,
    *,
    quiet: bool,
) -> Ending:
    """Steps to the end and writes results on the way."""
    duration, every = span(simulation.scene)
    ending, due = Ending("finished"), every
    with clock.stage("output"):
        series.write()
    with RunProgress(duration, quiet=quiet) as progress:
        steps = iter(simulation.run(duration))
        try:
            while (step := clock.timed("steps", steps)) is not None:
                tally.add(step)
                progress.advance(simulation.time)
                if simulation.time > due - 1e-6 * every:
                    with clock.stage("output"):
                        series.write()
                    due = every * (int(simulation.time / every + 1e-6) + 1)
                if interrupted.is_set():
                    when = f"interrupted at t = {simulation.time:.4g} s; all files are complete"
                    ending = Ending("interrupted", when)
                    break
        except Diverged as error:
            ending = Ending("diverged", str(error), error)
    if simulation.time > series.last_time:
        with clock.stage("output"):
            series.write()
    return ending


def span(scene: Scene) -> tuple[float, float]:
    """Simulated time of the run, and between two written results [s]."""
    duration = scene.duration or 1.0
    return duration, scene.output.every if scene.output is not None else duration / 50


def conclude(
    simulation: Simulation, series: Series, tally: StepTally, clock: Clock, ending: Ending
) -> Path:
    """Writes the picture and the summary; returns where the picture is."""
    from tissu.picture import draw

    picture = series.index.with_suffix(".png")
    with clock.stage("picture"):
        draw(simulation, picture)
    summary = summarise(
        simulation,
        tally=tally,
        status=ending.status,
        wall_seconds=clock.seconds,
        files={"series": series.index.name, "picture": picture.name},
        notes=[ending.message] if ending.message else [],
    )
    write_summary(series.index.with_name("summary.json"), summary)
    return picture


@contextlib.contextmanager
def interruption() -> Iterator[threading.Event]:
    """An event that Ctrl-C sets, so that a step and its files are completed first.

    A second Ctrl-C stops at once.
    """
    event = threading.Event()
    if threading.current_thread() is not threading.main_thread():
        yield event
        return

    def stop(number: int, frame: FrameType | None) -> None:
        event.set()
        signal.signal(signal.SIGINT, signal.default_int_handler)

    before = signal.signal(signal.SIGINT, stop)
    try:
        yield event
    finally:
        signal.signal(signal.SIGINT, before)


def report(
    simulation: Simulation, series: Series, tally: StepTally, clock: Clock, picture: Path
) -> None:
    """Prints what the steps cost and where the results are."""
    print(simulation.profile())
    spent = ", ".join(f"{name} {seconds:.2f} s" for name, seconds in clock.seconds.items())
    print(f"\n{tally.steps} steps to t = {simulation.time:.4g} s; {spent}")
    if tally.unconverged:
        share = f"{tally.unconverged} of {tally.steps} steps"
        print(f"{share} did not converge, the first: {tally.first_unconverged}")
    print(f"result:  {series.index} ({series.count} times)")
    print(f"summary: {series.index.with_name('summary.json')}")
    print(f"picture: {picture}")
