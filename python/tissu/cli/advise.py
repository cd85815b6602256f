"""`tissu advise`: the cheapest setting of a scene that is good enough, and its scene file."""

from __future__ import annotations

import sys
from pathlib import Path

import typer

from tissu.cli.inputs import input_files, require_apart
from tissu.output import folder_of_run


def advise_scene(
    file: Path,
    *,
    error: str,
    rate: float,
    budget: str,
    models: str,
    out: Path,
    trust_laws: bool = False,
) -> None:
    """Tries the settings and writes scene.yaml, table.csv, advice.md and advice.png.

    Raises:
        SceneError: the scene does not compile.
        ParameterError: an option that is not accepted, or a budget too small for one run.
        TissuError: the folder cannot be written.
    """
    from tissu.advice import advise
    from tissu.advice.figure import draw
    from tissu.files import whole_file
    from tissu.front import Scene

    asked = [name.strip() for name in models.split(",") if name.strip()]
    scene = Scene.from_yaml(file, trust_laws=trust_laws)
    written = [out / name for name in ("scene.yaml", "table.csv", "advice.md", "advice.png")]
    require_apart(f"output folder {out}", written, input_files(file, scene))
    with folder_of_run(out) as folder:
        told = _tell if sys.stderr.isatty() else None
        found = advise(scene, error, rate, budget=budget, models=asked, told=told)
        for name, text in (("table.csv", found.to_csv()), ("advice.md", found.to_markdown())):
            with whole_file(folder / name) as target:
                target.write_text(text, encoding="utf-8")
        found.scene.save(folder / "scene.yaml")
        with whole_file(folder / "advice.png") as target:
            drawn = draw(found, target)
        typer.echo(str(found))
        kind = "chosen" if found.chosen is not None else "nearest"
        files = "table.csv, advice.md" + (", advice.png" if drawn else "")
        typer.echo(f"written: {folder}/scene.yaml ({kind}: {found.best.name}), {files}")


def _tell(text: str) -> None:
    print(text, file=sys.stderr)
