"""The commands and their options; the work is done in the modules beside this one."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from tissu.cli.mesh_commands import Debug, mesh_app
from tissu.cli.outcome import reported
from tissu.cli.trocar_commands import trocar_app

app = typer.Typer(
    help="Deforming soft tissue: a scene file goes in, a deforming organ comes out.",
    no_args_is_help=True,
    add_completion=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.add_typer(mesh_app, name="mesh")
app.add_typer(trocar_app, name="trocar")
bench_app = typer.Typer(help="Measure what accuracy and contact cost.", no_args_is_help=True)
app.add_typer(bench_app, name="bench")

SceneFile = Annotated[Path, typer.Argument(metavar="SCENE", help="A scene (YAML).")]
TrustPlugins = Annotated[
    bool,
    typer.Option(
        "--trust-plugins", help="Load plug-ins of trocars. They are programs: check them first."
    ),
]
TrustLaws = Annotated[
    bool,
    typer.Option(
        "--trust-laws",
        help="Run the scene's files of laws. They are programs: read them first.",
    ),
]
AcceptUnconverged = Annotated[
    bool,
    typer.Option(
        "--accept-unconverged", help="End with status 0 also where steps did not converge."
    ),
]


@app.command()
def run(
    scene: SceneFile,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out", "-o", metavar="PATH", help="Folder of the results; default: results/SCENE."
        ),
    ] = None,
    duration: Annotated[
        str | None,
        typer.Option(metavar="TIME", help="Simulated time, such as '2 s'; default: the scene's."),
    ] = None,
    threads: Annotated[
        int | None,
        typer.Option(min=1, metavar="N", help="Number of threads, from 1; default: the scene's."),
    ] = None,
    resume: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Go on from this checkpoint, with the same bits."),
    ] = None,
    checkpoint: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="Write a checkpoint there: at the end, also after Ctrl-C."
        ),
    ] = None,
    checkpoint_every: Annotated[
        str | None,
        typer.Option(
            metavar="TIME", help="Write it also each time that so much time has passed: '1 s'."
        ),
    ] = None,
    picture: Annotated[
        bool, typer.Option("--picture/--no-picture", help="Draw a picture at the end.")
    ] = True,
    realtime: Annotated[
        bool, typer.Option("--realtime", help="Let trocars and steps keep pace with the clock.")
    ] = False,
    trust_laws: TrustLaws = False,
    trust_plugins: TrustPlugins = False,
    accept_unconverged: AcceptUnconverged = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print errors only.")] = False,
    debug: Debug = False,
) -> None:
    """Run a scene; write a VTU series, a summary and a picture."""
    from tissu.cli.run import Job, run_scene

    with reported(debug=debug):
        more = (resume, checkpoint, checkpoint_every, trust_laws, accept_unconverged)
        folder = out or Path("results") / scene.stem
        job = Job(scene, folder, duration, threads, quiet, *more, picture, realtime, trust_plugins)
        raise typer.Exit(run_scene(job, debug=debug))


@app.command("view")
def view_command(
    scene: SceneFile,
    port: Annotated[
        int | None,
        typer.Option(min=1, max=65535, help="Port of the page; default: the first free from 8080."),
    ] = None,
    host: Annotated[
        str,
        typer.Option(help="Address to listen on; any but that of this machine requires a token."),
    ] = "127.0.0.1",
    token: Annotated[
        str | None, typer.Option(help="Token that a page must bring; default: a new one.")
    ] = None,
    browser: Annotated[
        bool, typer.Option("--browser/--no-browser", help="Whether the page is opened.")
    ] = True,
    beside: Annotated[
        str,
        typer.Option(metavar="MODEL|SCENE", help="The same with this model, or another scene."),
    ] = "",
    record: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Record to this file, a page (.html) or glTF (.glb)."),
    ] = None,
    shared: Annotated[
        bool, typer.Option("--shared", help="Every page may touch, not the first one only.")
    ] = False,
    speed: Annotated[
        float, typer.Option(help="Simulated seconds for each second; inf: as fast as it goes.")
    ] = 1.0,
    paused: Annotated[bool, typer.Option("--paused", help="Begin paused.")] = False,
    hand: Annotated[
        str, typer.Option(metavar="scene|browser", help="What holds simulated trocars at first.")
    ] = "scene",
    trust_laws: TrustLaws = False,
    trust_plugins: TrustPlugins = False,
    debug: Debug = False,
) -> None:
    """Run a scene live in the browser, to be seen and touched."""
    from tissu.cli.view import Job, view_scene

    with reported(debug=debug):
        more = (port, host, token, browser, beside, record, shared, speed, paused)
        view_scene(Job(scene, *more, hand, trust_laws, trust_plugins))


@app.command()
def schema() -> None:
    """Print the JSON schema of scene files, with which editors complete and check them."""
    import json

    from tissu.scene.schema import scene_schema

    typer.echo(json.dumps(scene_schema(), indent=2))


@app.command()
def check(scene: SceneFile, trust_laws: TrustLaws = False, debug: Debug = False) -> None:
    """Say which effects a scene switches on and why, or what is wrong with it."""
    with reported(debug=debug):
        from tissu.errors import SceneError
        from tissu.front import Scene

        found = Scene.from_yaml(scene, trust_laws=trust_laws).check()
        if found.problems:
            raise SceneError(found.problems)
        typer.echo(str(found))


@app.command()
def info(
    constants: Annotated[
        bool, typer.Option("--constants", help="What cells of each element and law keep.")
    ] = False,
    debug: Debug = False,
) -> None:
    """Version, threads, instruction set in use, libraries; or what cells keep."""
    with reported(debug=debug):
        if constants:
            from tissu.cli.constants import constants_text

            typer.echo(constants_text())
            return
        from tissu.cli.info import info_text

        typer.echo(info_text())


@app.command("compare")
def compare_command(
    scene: SceneFile,
    models: Annotated[
        str | None, typer.Option(help="Names with commas: mass_spring,mass_link,fem; default: all.")
    ] = None,
    reference: Annotated[
        str,
        typer.Option(
            help="What errors are measured against: finest (fem, second order), a model's name, "
            "or another scene file."
        ),
    ] = "finest",
    out: Annotated[
        Path | None,
        typer.Option("--out", "-o", help="Folder; default: results/SCENE-compare."),
    ] = None,
    trust_laws: TrustLaws = False,
    debug: Debug = False,
) -> None:
    """Run a scene with each of several models; write a table and a figure."""
    with reported(debug=debug):
        from tissu.cli.compare import compare_scene

        folder = out or Path("results") / f"{scene.stem}-compare"
        compare_scene(scene, models, reference, folder, trust_laws=trust_laws)


@bench_app.callback()
def bench_options() -> None:
    """Measure what accuracy and contact cost."""


@bench_app.command("accuracy")
def bench_accuracy_command(
    cases: Annotated[
        list[str] | None,
        typer.Argument(metavar="[CASE]...", help="Names of cases, as --list prints; default: all."),
    ] = None,
    preset: Annotated[
        str, typer.Option(help="small (about two minutes) or full (under an hour).")
    ] = "small",
    folder: Annotated[
        Path | None,
        typer.Option("--cases", metavar="FOLDER", help="Cases of your own instead of tissu's."),
    ] = None,
    meshes: Annotated[
        Path | None,
        typer.Option(metavar="FOLDER", help="Meshes of cases that do not come with tissu."),
    ] = None,
    listed: Annotated[bool, typer.Option("--list", help="Print the cases and leave.")] = False,
    out: Annotated[Path, typer.Option("--out", "-o", help="Folder of the results.")] = Path(
        "results/accuracy"
    ),
    trust_laws: TrustLaws = False,
    debug: Debug = False,
) -> None:
    """Run cases with every element, law, model, method and solver; write tables and diagrams."""
    with reported(debug=debug):
        from tissu.cli.bench import Job, bench_accuracy, list_cases

        if listed:
            list_cases(folder)
            return
        bench_accuracy(Job(cases or [], preset, folder, meshes, out, trust_laws))


@bench_app.command("contact")
def bench_contact_command(
    cases: Annotated[
        list[str] | None,
        typer.Argument(metavar="[CASE]...", help="Names of cases, as --list prints; default: all."),
    ] = None,
    listed: Annotated[bool, typer.Option("--list", help="Print the cases and leave.")] = False,
    debug: Debug = False,
) -> None:
    """Run bodies that touch: what a step costs, and how well the contacts hold."""
    with reported(debug=debug):
        from tissu.cli.bench_contact import bench_contact, list_contact_cases

        if listed:
            list_contact_cases()
            return
        bench_contact(cases or [])


@app.command("advise")
def advise_command(
    scene: SceneFile,
    error: Annotated[
        str,
        typer.Option(
            help="Mean error accepted: of the largest displacement (1%, 0.01) or a length "
            "('0.5 mm')."
        ),
    ] = "1%",
    rate: Annotated[
        float,
        typer.Option(
            help="Updates a second, each 1/rate seconds of simulated time further; of a static "
            "scene, solves a second."
        ),
    ] = 30.0,
    budget: Annotated[
        str, typer.Option(metavar="TIME", help="Wall time for all runs together.")
    ] = "60 s",
    models: Annotated[
        str,
        typer.Option(help="Models to try besides those that keep the scene's laws, with commas."),
    ] = "",
    out: Annotated[
        Path | None,
        typer.Option("--out", "-o", help="Folder; default: results/SCENE-advice."),
    ] = None,
    trust_laws: TrustLaws = False,
    debug: Debug = False,
) -> None:
    """Find the cheapest setting that meets an error and a rate; write its scene and a table."""
    with reported(debug=debug):
        from tissu.cli.advise import advise_scene

        folder = out or Path("results") / f"{scene.stem}-advice"
        goal = {"error": error, "budget": budget, "models": models}
        advise_scene(scene, **goal, rate=rate, out=folder, trust_laws=trust_laws)


@app.command("example")
def example_command(
    name: Annotated[
        str | None, typer.Argument(metavar="[NAME]", help="An example; absent: their names.")
    ] = None,
    out: Annotated[Path, typer.Option("--out", "-o", help="Folder of the copies.")] = Path(),
    debug: Debug = False,
) -> None:
    """Copy an example's scene and meshes here, or print the names of all examples."""
    with reported(debug=debug):
        from tissu import examples

        if name is None:
            typer.echo("\n".join(examples.names()))
            return
        for path in examples.copy(name, out):
            typer.echo(f"written: {path}")


def version(wanted: bool) -> None:
    """Prints the version and leaves."""
    if wanted:
        from tissu import __version__

        typer.echo(f"tissu {__version__}")
        raise typer.Exit


@app.callback()
def options(
    show: Annotated[
        bool, typer.Option("--version", callback=version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    """Deforming soft tissue: a scene file goes in, a deforming organ comes out."""
