"""`tissu compare`: one scene with several models, as a table and a figure."""

from __future__ import annotations

from pathlib import Path

import typer

from tissu.errors import ParameterError
from tissu.output import prepare_folder


def compare_scene(
    file: Path, models: str | None, reference: str, out: Path, *, trust_laws: bool = False
) -> None:
    """Runs the comparison and writes compare.csv, compare.md and compare.png.

    Raises:
        SceneError: the scene does not compile.
        ParameterError: an unknown model, or a reference that does not fit.
    """
    from tissu.comparison import compare
    from tissu.comparison.figure import draw
    from tissu.files import require_folder_place, whole_file
    from tissu.front import Scene

    asked = [] if models is None else names_option(models)
    scene = Scene.from_yaml(file, trust_laws=trust_laws)
    against: Scene | str = reference
    if Path(reference).suffix in (".yaml", ".yml"):
        against = Scene.from_yaml(reference, trust_laws=trust_laws)
    require_folder_place(out, "output folder")
    found = compare(scene, models=asked, reference=against)
    folder = prepare_folder(out)
    for name, text in (("compare.csv", found.to_csv()), ("compare.md", found.to_markdown())):
        with whole_file(folder / name) as target:
            target.write_text(text, encoding="utf-8")
    with whole_file(folder / "compare.png") as target:
        drawn = draw(found, target)
    typer.echo(str(found))
    typer.echo(f"written: {folder}/compare.csv, compare.md" + (", compare.png" if drawn else ""))


def names_option(models: str) -> list[str]:
    """The names of --models.

    Raises:
        ParameterError: one of them is empty.
    """
    names = [name.strip() for name in models.split(",")]
    if not all(names):
        found = f"an empty name in '{models}'" if models.strip() else "no name"
        raise ParameterError(
            f"option --models: found {found}; names with commas between them are accepted, such as "
            "fem,mass_spring; leave the option out for all models"
        )
    return names
