"""`tissu bench accuracy`: what each choice costs and buys, for the cases that come with tissu."""

from __future__ import annotations

import json
import time
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

import typer

from tissu.accuracy import Case, Run, Study, read_cases, study
from tissu.accuracy.case import Preset
from tissu.accuracy.figure import draw
from tissu.accuracy.front import sentence
from tissu.accuracy.page import page
from tissu.accuracy.table import to_csv, to_parquet
from tissu.cli.info import machine_line
from tissu.errors import ParameterError
from tissu.files import whole_file
from tissu.output import folder_of_run

CASES = Path(__file__).resolve().parents[1] / "accuracy" / "cases"


@dataclass(frozen=True, slots=True)
class Job:
    """What is asked for.

    Attributes:
        names: cases; none: all.
        preset: "small" or "full".
        cases: folder of cases; None: those that come with tissu.
        meshes: folder of mesh files that do not.
        out: folder of the results.
        trust_laws: whether the files of laws of one's own cases may run.
    """

    names: list[str]
    preset: str
    cases: Path | None
    meshes: Path | None
    out: Path
    trust_laws: bool = False


def list_cases(folder: Path | None) -> None:
    """Prints names and titles."""
    for case in read_cases(folder or CASES):
        typer.echo(f"{case.name:<12} {case.title}")


def bench_accuracy(job: Job) -> None:
    """Runs the cases; writes accuracy.csv, accuracy.html and a PNG for each case.

    With pyarrow on the machine, accuracy.parquet too.

    Raises:
        ParameterError: no such case, or a reference is missing.
    """
    preset = _preset(job.preset)
    found = read_cases(job.cases or CASES, job.names)
    with folder_of_run(job.out) as folder:
        begin = time.perf_counter()
        studies: list[Study] = []
        for case in found:
            why = missing(case, job.meshes)
            if why and not job.names:
                typer.echo(f"{case.name}: left out, since it {why}\n")
                continue
            if why:
                raise ParameterError(f"case {case.name} {why}")
            typer.echo(f"{case.name}: {case.title}")
            one = study(case, preset, meshes=job.meshes, trust_laws=job.trust_laws, told=_told)
            typer.echo(f"  {sentence(one)}\n")
            studies.append(one)
            _write(studies, folder)
        seconds = time.perf_counter() - begin
        tables = [
            "accuracy.csv",
            *(["accuracy.parquet"] if find_spec("pyarrow") is not None else []),
        ]
        names = ", ".join(["accuracy.html", *tables, *(f"{s.case.name}.png" for s in studies)])
        typer.echo(f"{seconds:.0f} s; written: {folder}/{names}")


def _preset(word: str) -> Preset:
    known: dict[str, Preset] = {"small": "small", "full": "full"}
    if word not in known:
        raise ParameterError(f"--preset: found '{word}'; small or full is accepted")
    return known[word]


def missing(case: Case, meshes: Path | None) -> str:
    """Why a case cannot run here; empty: it can."""
    if not case.needs:
        return ""
    from tissu.yaml_io import scene_mapping

    for body in scene_mapping(case.scene)["bodies"].values():
        file = body["mesh"].get("file") if isinstance(body["mesh"], dict) else None
        places = [case.scene.parent, *([meshes] if meshes else [])]
        if file is not None and not any((place / file).is_file() for place in places):
            return f"needs {case.needs}"
    return ""


def _told(run: Run) -> None:
    if run.share is None:
        typer.echo(f"  {run.label}: {run.outcome}: {run.why}")
        return
    mark = "" if run.outcome == "finished" else f", {run.outcome}"
    ms = 1e3 * (run.seconds or 0.0)
    typer.echo(f"  {run.label}: {100.0 * run.share:.3g} %, {ms:.3g} ms{mark}")


def _write(studies: list[Study], folder: Path) -> None:
    """All that is known so far, so that a run that is stopped leaves it."""
    texts = {"accuracy.csv": to_csv(studies), "accuracy.html": page(studies, machine_line())}
    for name, text in texts.items():
        with whole_file(folder / name) as target:
            target.write_text(text, encoding="utf-8")
    if find_spec("pyarrow") is not None:
        with whole_file(folder / "accuracy.parquet") as target:
            target.write_bytes(to_parquet(studies))
    last = studies[-1]
    figure = draw(last)
    if figure is not None:
        with whole_file(folder / f"{last.case.name}.png") as target:
            figure.savefig(target, dpi=110, format="png")
    answers = {one.case.name: sentence(one) for one in studies}
    with whole_file(folder / "accuracy.json") as target:
        target.write_text(json.dumps(answers, indent=2), encoding="utf-8")
