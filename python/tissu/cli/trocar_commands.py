"""The commands `tissu trocar …` and their options."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from tissu.cli.mesh_commands import Debug
from tissu.cli.outcome import reported

trocar_app = typer.Typer(
    help="Trocars of a scene: their devices, friction, timing and recordings.",
    no_args_is_help=True,
)
SceneFile = Annotated[Path, typer.Argument(metavar="SCENE", help="A scene (YAML) with trocars.")]
Name = Annotated[
    str | None, typer.Option("--trocar", metavar="NAME", help="Which one; default: all, or it.")
]
TrustPlugins = Annotated[
    bool,
    typer.Option("--trust-plugins", help="Run the scene's plug-in of a device, a program."),
]
Seconds = Annotated[str, typer.Option(metavar="TIME", help="How long, such as '5 s'.")]


_TINY = 1e-9
_LONGEST = 86_400.0
"""s: a day of ticks"""


def number_of(
    option: str, read: Callable[[str], float], given: str, unit: str, least: float, most: float
) -> float:
    """A number of an option, with its unit.

    Raises:
        ParameterError: it cannot be read, is not a number, or is not between the two.
    """
    from tissu.errors import ParameterError

    try:
        value = read(given)
    except ParameterError as problem:
        raise ParameterError(f"{option}: {problem}") from None
    if not least <= value <= most:
        accepted = (
            f"at least {least:g} {unit}" if most == math.inf else f"{least:g} to {most:g} {unit}"
        )
        raise ParameterError(f"{option}: found {given!r}; {accepted} is accepted")
    return value


def seconds_of(option: str, given: str, least: float = 1e-3) -> float:
    """A time of an option [s]."""
    from tissu.units import TIME

    return number_of(option, TIME, given, "s", least, _LONGEST)


@trocar_app.command("check")
def check_command(
    scene: SceneFile, trocar: Name = None, trust_plugins: TrustPlugins = False, debug: Debug = False
) -> None:
    """Open the devices, and say what they are and what bounds their coupling."""
    from tissu.cli.trocar import check_trocars

    with reported(debug=debug):
        check_trocars(scene, trocar, trusted=trust_plugins)


@trocar_app.command("identify")
def identify_command(
    scene: SceneFile, trocar: Name = None, trust_plugins: TrustPlugins = False, debug: Debug = False
) -> None:
    """Drive each axis to and fro; find damping, friction and efficiency. Nothing may hold it."""
    from tissu.cli.trocar import identify_trocar

    with reported(debug=debug):
        identify_trocar(scene, trocar, trusted=trust_plugins)


@trocar_app.command("jitter")
def jitter_command(
    scene: SceneFile,
    trocar: Name = None,
    seconds: Seconds = "5 s",
    spin: Annotated[
        str, typer.Option(metavar="TIME", help="Last part of each wait that is spent awake.")
    ] = "0 s",
    trust_plugins: TrustPlugins = False,
    debug: Debug = False,
) -> None:
    """Tick in real time, and say how late ticks were and what the machine granted."""
    from tissu.cli.trocar import jitter_trocar

    with reported(debug=debug):
        lasts, awake = seconds_of("--seconds", seconds), seconds_of("--spin", spin, least=0.0)
        jitter_trocar(scene, trocar, lasts, awake, trusted=trust_plugins)


@trocar_app.command("record")
def record_command(
    scene: SceneFile,
    out: Annotated[Path, typer.Argument(metavar="FILE", help="The recording (.npz).")],
    trocar: Name = None,
    seconds: Seconds = "2 s",
    realtime: Annotated[
        bool, typer.Option("--realtime", help="By the thread; default: stepped.")
    ] = False,
    wall: Annotated[
        str | None,
        typer.Option(metavar="DEPTH", help="A wall that is felt in place of the tissue: '110 mm'."),
    ] = None,
    stiffness: Annotated[str | None, typer.Option(help="Of the wall; default: 500 N/m.")] = None,
    trust_plugins: TrustPlugins = False,
    debug: Debug = False,
) -> None:
    """Record all ticks: what the device gave, the models of the tissue, the torques."""
    from tissu.cli.trocar import Recorded, check_writable, record_trocar
    from tissu.errors import ParameterError
    from tissu.units import LENGTH, STIFFNESS

    with reported(debug=debug):
        check_writable(out)
        depth = None if wall is None else number_of("--wall", LENGTH, wall, "m", 0.0, 1.0)
        if stiffness is not None and wall is None:
            text = f"--stiffness: found {stiffness!r} without a wall; it is accepted with --wall"
            raise ParameterError(text)
        stiff = "500 N/m" if stiffness is None else stiffness
        felt = number_of("--stiffness", STIFFNESS, stiff, "N/m", _TINY, math.inf)
        numbers = (seconds_of("--seconds", seconds), realtime, depth, felt)
        job = Recorded(scene, trocar, out, *numbers, trust_plugins)
        record_trocar(job)


@trocar_app.command("replay")
def replay_command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="A recording.")],
    debug: Debug = False,
) -> None:
    """Take the ticks of a recording again, and compare every bit of the torques."""
    from tissu.cli.trocar import replay_recording

    with reported(debug=debug):
        raise typer.Exit(replay_recording(file))
