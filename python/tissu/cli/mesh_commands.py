"""The commands `tissu mesh …` and their options; the work is done in `mesh`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from tissu.cli.outcome import reported

mesh_app = typer.Typer(help="Look at meshes and make them.", no_args_is_help=True)

Debug = Annotated[bool, typer.Option("--debug", help="Show tracebacks.")]
Lengths = tuple[str, str, str]


@mesh_app.command("info")
def mesh_info(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="A mesh of any known format.")],
    unit: Annotated[str, typer.Option(help="Unit of length of the file.")] = "m",
    scale: Annotated[float, typer.Option(help="Factor on all lengths.")] = 1.0,
    debug: Debug = False,
) -> None:
    """Counts, size, quality and faults of a mesh."""
    with reported(debug=debug):
        from tissu.cli.mesh import described
        from tissu.mesh import read_mesh

        in_metres = unit == "m" and scale == 1.0
        typer.echo(described(read_mesh(file, unit=unit, scale=scale), in_metres=in_metres))


@mesh_app.command("bar")
def mesh_bar(
    size: Annotated[
        Lengths, typer.Option(metavar="X Y Z", help="Lengths in m, or with a unit: 10cm 5cm 5cm.")
    ],
    cells: Annotated[tuple[int, int, int], typer.Option(metavar="X Y Z", help="Grid cells.")],
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FILE", help="The mesh.")],
    cell: Annotated[
        str | None,
        typer.Option(help="tetra (the default), hexahedron, wedge, pyramid, hexahedron20, ..."),
    ] = None,
    split: Annotated[
        str | None, typer.Option(help="six (the default), five or six_mirrored; of tetra.")
    ] = None,
    origin: Annotated[
        Lengths, typer.Option(metavar="X Y Z", help="Smallest corner in m, or with a unit.")
    ] = ("0", "0", "0"),
    segments: Annotated[
        str | None,
        typer.Option(
            help="Equal pieces along x instead of --cell, each with its cells and a label that "
            "names its region: 'wedge6:stvk, pyramid5:stvk, hex8:stvk, tet4:hooke'."
        ),
    ] = None,
    debug: Debug = False,
) -> None:
    """Make a bar of like cells, or of segments of different ones whose faces match."""
    with reported(debug=debug):
        from tissu.cli.mesh import Bar, lengths, made_bar, written

        bar = Bar(lengths("--size", size), cells, lengths("--origin", origin))
        written(made_bar(bar, cell=cell, split=split, segments=segments), output)


@mesh_app.command("convert")
def mesh_convert(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="A mesh of any known format.")],
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FILE", help="The mesh.")],
    unit: Annotated[str, typer.Option(help="Unit of length of the file.")] = "m",
    scale: Annotated[float, typer.Option(help="Factor on all lengths.")] = 1.0,
    debug: Debug = False,
) -> None:
    """Write a mesh in another format, in metres and without the nodes that no cell uses."""
    with reported(debug=debug):
        from tissu.cli.mesh import written
        from tissu.mesh import read_mesh

        written(read_mesh(file, unit=unit, scale=scale).without_unused_nodes(), output)
