"""`tissu run`: from a scene file to a folder of results."""

from __future__ import annotations

import contextlib
import math
import time
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from tissu.cli.checkpoints import Checkpoints, checkpoints_option, positive_time
from tissu.cli.inputs import input_files, require_apart
from tissu.cli.interruption import Interruption, interruption
from tissu.cli.outcome import BAD_INPUT, DIVERGED, FINISHED, UNCONVERGED, complain
from tissu.cli.progress import RunProgress
from tissu.cli.timetable import Timetable
from tissu.cli.touches import contact_line, cut_lines
from tissu.counted import counted
from tissu.errors import CheckpointError, Diverged, ParameterError, TissuError
from tissu.files import file_name
from tissu.output import (
    ContactTally,
    Series,
    StepTally,
    folder_of_run,
    summarise,
    write_summary,
)
from tissu.output.series import FRAMES

if TYPE_CHECKING:
    from tissu.checkpoint import Resumed
    from tissu.front import Scene
    from tissu.simulation import Simulation
    from tissu.trocar.run import Trocars

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
    trust_laws: bool = False
    accept_unconverged: bool = False
    picture: bool = True
    realtime: bool = False
    trust_plugins: bool = False


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
        status: "finished", "unconverged": some steps did not converge, "interrupted", "diverged",
            or "stopped": a step was refused, or results could not be written.
        code: exit code of the command.
        message: why it is not finished, or what is wrong with its steps.
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
    clock = Clock()
    with clock.stage("compile"):
        scene = load(job)
        checkpoints = checkpoints_option(job.checkpoint, job.checkpoint_every)
        require_outputs_apart(job, scene)
    with folder_of_run(job.out) as folder:
        return run_into(folder, job, scene, checkpoints, clock, debug=debug)


def run_into(
    folder: Path, job: Job, scene: Scene, checkpoints: Checkpoints, clock: Clock, *, debug: bool
) -> int:
    """Runs a scene into its folder; returns the exit code."""
    tally = StepTally()
    with clock.stage("compile"):
        simulation = scene.compile(checkpoint=job.resume)
    if not job.quiet:
        for note in worth_knowing(simulation):
            complain(f"note: {note}")
    with interruption() as interrupted, beside(simulation, job) as trocars:
        series, contacts = Series(simulation, folder), ContactTally(simulation)
        files = Files(series, checkpoints, Timetable(span(scene)[1]), clock)
        ending = advance(simulation, files, tally, interrupted, trocars, quiet=job.quiet)
        ending = judged(simulation, ending, tally, accepted=job.accept_unconverged)
        ending = with_note(ending, nothing_left(simulation, ending, tally))
        picture = None
        if not files.lost:
            picture = drawn(simulation, series, clock) if job.picture else None
            conclude(simulation, series, tally, clock, ending, picture, contacts, trocars)
        for text in trocars.problems() if trocars is not None else ():
            complain(text)
        ends = trocars.words() if trocars is not None else []
    if not job.quiet and not files.lost:
        with contextlib.suppress(BrokenPipeError):  # its reader has left; the run ends as it did
            report(simulation, series, tally, clock, picture, contacts)
            for text in ends:
                print(text)
    if ending.error is not None and debug:
        raise ending.error
    if ending.message:
        complain(ending.message)
    return ending.code


def require_outputs_apart(job: Job, scene: Scene) -> None:
    """Refuse results in the place of what the scene is read from.

    Raises:
        ParameterError: the option, and the file.
    """
    inputs = input_files(job.scene, scene)
    if job.checkpoint is not None:
        require_apart("option --checkpoint", [job.checkpoint], inputs)
    name = file_name(scene.name)
    written = [job.out / last for last in (FRAMES, f"{name}.pvd", f"{name}.png", "summary.json")]
    require_apart(f"output folder {job.out}", written, inputs)


@contextlib.contextmanager
def beside(simulation: Simulation, job: Job) -> Iterator[Trocars | None]:
    """The trocars of the scene while it runs; None, with nothing loaded, where it has none.

    Raises:
        TissuError: a device that is not there, or a tool that cannot be led.
    """
    if not simulation.scene.trocars:
        if job.realtime:
            text = "found --realtime and no trocars in the scene; without them a run is as fast as "
            raise ParameterError(f"{text}it can, leave it out")
        yield None
        return
    from tissu.trocar.run import Trocars

    trusted = job.trust_plugins
    with Trocars(simulation, realtime=job.realtime, trust_plugins=trusted) as trocars:
        yield trocars


def worth_knowing(simulation: Simulation) -> list[str]:
    """What `tissu check` notes of the scene; which solver `auto` chose is not a doubt about it."""
    chosen = "step.solver: auto took "
    return [note for note in simulation.plan().notes if not note.startswith(chosen)]


def load(job: Job) -> Scene:
    """The scene with what the command line changes.

    Raises:
        ParameterError: an option is not accepted.
        SceneError: problems of the scene; all of them.
    """
    from tissu.front import Scene, accepted
    from tissu.yaml_io import read_scene

    duration = None if job.duration is None else positive_time(job.duration, "--duration")
    to_run = duration is None
    scene = accepted(read_scene(job.scene, Scene, to_run=to_run, trust_laws=job.trust_laws))
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
    lost: TissuError | None = None

    def begin(self, simulation: Simulation) -> None:
        """Writes what a series begins with."""
        self.times.wait(simulation.time)
        self.checkpoints.begin(simulation)
        if self.series.count == 0:
            self._write(simulation)

    def write_due(self, simulation: Simulation) -> None:
        """Writes what is due after a step.

        Raises:
            TissuError: it cannot be written; `lost` keeps why.
        """
        try:
            if self.times.is_due(simulation.time):
                self._write(simulation)
                self.times.wait(simulation.time)
            with self.clock.stage("output"):
                self.checkpoints.write_due(simulation)
        except TissuError as error:
            self.lost = error
            raise

    def end(self, simulation: Simulation, ending: Ending) -> Ending:
        """Writes the last results, and the checkpoint of a run that can go on; how it ends then."""
        try:
            if self.lost is None:
                self._write(simulation, ended_early=ending.status != "finished")
        except TissuError as error:
            self.lost = error
            ending = Ending("stopped", BAD_INPUT, str(error), error)
        good = ending.error is None or ending.error is self.lost
        if good and not isinstance(self.lost, CheckpointError):
            with self.clock.stage("output"):
                self.checkpoints.write(simulation)
        return ending

    def _write(self, simulation: Simulation, *, ended_early: bool = False) -> None:
        if simulation.time > self.series.last_time:
            with self.clock.stage("output"):
                self.series.write(ended_early=ended_early)


def advance(
    simulation: Simulation,
    files: Files,
    tally: StepTally,
    interrupted: Interruption,
    trocars: Trocars | None = None,
    *,
    quiet: bool,
) -> Ending:
    """Steps to the end and writes results on the way."""
    duration, _ = span(simulation.scene)
    ending = Ending("finished", FINISHED)
    files.begin(simulation)
    with RunProgress(duration, quiet=quiet, start=simulation.time) as progress:
        steps = iter(simulation.run(until=duration))
        if trocars is not None:
            steps = trocars.along(steps)
        try:
            while (step := files.clock.timed("steps", steps)) is not None:
                tally.add(step)
                progress.advance(simulation.time)
                files.write_due(simulation)
                if interrupted.number:
                    break
        except KeyboardInterrupt:  # between two iterations: the state is that of the step before
            if not interrupted.number:
                raise
        except TissuError as error:
            status = "diverged" if isinstance(error, Diverged) else "stopped"
            code = DIVERGED if files.lost is None else BAD_INPUT
            ending = Ending(status, code, str(error), error)
    if interrupted.number and ending.error is None:
        when = f"{interrupted.word} at t = {simulation.time:.4g} s"
        ending = Ending("interrupted", interrupted.code, f"{when}; all files are complete")
    return files.end(simulation, ending)


def judged(simulation: Simulation, ending: Ending, tally: StepTally, *, accepted: bool) -> Ending:
    """The ending of a run that took all its steps, some of which did not converge.

    Those before the checkpoint from which it went on count too: its state follows from them.
    """
    before = simulation.resumed_from
    missed, taken, first = tally.unconverged, tally.steps, tally.first_unconverged
    if before is not None:
        missed, taken = missed + before.unconverged, taken + before.steps
        first = before.first_unconverged or first
    if ending.status != "finished" or not missed:
        return ending
    share = f"{missed} of {counted(taken, 'step')} did not converge"
    text = f"{share}, the first: {first}"
    if accepted:
        return Ending("finished", FINISHED, f"{text}; accepted with --accept-unconverged")
    text += "; the results are written and are not a solution: give the solver more iterations or "
    text += "smaller steps, or accept them with --accept-unconverged"
    return Ending("unconverged", UNCONVERGED, text)


def nothing_left(simulation: Simulation, ending: Ending, tally: StepTally) -> str:
    """A sentence on a run whose checkpoint stands at its end or beyond; empty: it took steps."""
    before = simulation.resumed_from
    if before is None or tally.steps or ending.status not in ("finished", "unconverged"):
        return ""
    end = span(simulation.scene)[0]
    text = f"nothing was left to do: {before.file} has the state at t = {before.time:.4g} s"
    return f"{text}, and the run ends at {end:.4g} s; give a longer --duration to go on"


def with_note(ending: Ending, note: str) -> Ending:
    """The ending with a sentence in front of its own."""
    if not note:
        return ending
    return replace(ending, message="; ".join(filter(None, (note, ending.message))))


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
    contacts: ContactTally,
    trocars: Trocars | None,
) -> None:
    """Writes the summary."""
    files = {"series": series.index.name}
    if trocars is not None:
        written = trocars.write(series.index.parent)
        files |= {
            f"trocar {name}": path.name for name, path in zip(trocars.felt, written, strict=True)
        }
    if picture is not None:
        files["picture"] = picture.name
    summary = summarise(
        simulation,
        tally=tally,
        status=ending.status,
        wall_seconds=clock.seconds,
        files=files,
        why=ending.message,
        notes=[*worth_knowing(simulation), *filter(None, (ending.message, series.inverted))],
        contacts=contacts,
    )
    if trocars is not None:
        summary = {**summary, "trocars": trocars.summary()}
    write_summary(series.index.with_name("summary.json"), summary)


def report(
    simulation: Simulation,
    series: Series,
    tally: StepTally,
    clock: Clock,
    picture: Path | None,
    contacts: ContactTally,
) -> None:
    """Prints what the steps cost, what was cut and touched, and where the results are.

    Of a run that took no step there is nothing to say of steps and contacts.
    """
    if tally.steps:
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
    touched = contact_line(contacts.record()) if tally.steps else []
    for text in (*cut_lines(simulation, tally.cuts), *touched):
        print(text)
    print(f"result:  {series.index} ({counted(series.count, 'time')})")
    print(f"summary: {series.index.with_name('summary.json')}")
    if picture is not None:
        print(f"picture: {picture}")


def resumed_words(resumed: Resumed) -> str:
    """From where a run went on, and what is to be known of it."""
    taken = counted(resumed.steps, "step")
    text = f"went on from {resumed.file}, at t = {resumed.time:.4g} s after {taken}"
    return f"{text}; {resumed.note}" if resumed.note else text
