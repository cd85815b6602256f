"""`tissu view`: a scene runs live in the browser."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from tissu.cli.inputs import input_files, require_apart
from tissu.cli.interruption import interruption

if TYPE_CHECKING:
    from tissu.front import Scene


@dataclass(frozen=True, slots=True)
class Job:
    """What is asked for: the options of the command, as it describes them."""

    scene: Path
    port: int | None
    host: str
    token: str | None
    browser: bool
    beside: str
    record: Path | None
    shared: bool
    speed: float
    paused: bool
    hand: str
    trust_laws: bool
    trust_plugins: bool


def view_scene(job: Job) -> None:
    """Show it until Ctrl-C.

    Raises:
        SceneError: problems of a scene; all of them.
        ParameterError: an option that is not accepted.
        TissuError: viser is not installed, or the recording cannot be written.
    """
    from tissu.front import Scene
    from tissu.live_view import View

    scene = Scene.from_yaml(job.scene, trust_laws=job.trust_laws)
    if job.record is not None:
        require_apart("option --record", [job.record], input_files(job.scene, scene))
    beside = None if not job.beside else scene_beside(scene, job.beside, trust_laws=job.trust_laws)
    view_of = View(
        scene.compile(),
        beside=None if beside is None else beside.compile(),
        port=job.port,
        host=job.host,
        token=job.token,
        browser=job.browser,
        record=job.record,
        shared=job.shared,
        speed=job.speed,
        playing=not job.paused,
        hand=job.hand,
        trust_plugins=job.trust_plugins,
    )
    with view_of as view, interruption() as interrupted:
        typer.echo(f"the view is at {view.url} (Ctrl-C ends it)")
        while not interrupted.number:
            view.wait(0.2)
    if job.record is not None:
        typer.echo(f"written: {job.record}")


def scene_beside(scene: Scene, word: str, *, trust_laws: bool) -> Scene:
    """Another scene by its file, or the same one with a model by its name."""
    from tissu.comparison.reference import with_model
    from tissu.comparison.run import check_model
    from tissu.front import Scene
    from tissu.scene.part import spelled

    if Path(word).suffix in (".yaml", ".yml"):
        return Scene.from_yaml(word, trust_laws=trust_laws)
    check_model(spelled(word))
    return with_model(scene, spelled(word))
