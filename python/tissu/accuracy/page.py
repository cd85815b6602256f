"""A study as one HTML page that needs no other file."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from tissu.accuracy.figure import as_svg, draw
from tissu.accuracy.front import front, sentence
from tissu.accuracy.study import Study
from tissu.accuracy.table import COLUMNS, cells, curves, printed

_STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; max-width: 72rem; margin: 2rem auto; padding: 0 1rem;
       color: #1b1f24; background: #fff; }
h1, h2 { line-height: 1.2; } h2 { margin-top: 3rem; }
table { border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums; }
th, td { padding: .2rem .6rem; border-bottom: 1px solid #d8dee4; text-align: right; }
th:first-child, td:first-child { text-align: left; }
tr.front td { background: #fff4d6; }
svg { max-width: 100%; height: auto; } .wide { overflow-x: auto; } .answer { font-weight: 600; }
"""


def page(studies: Sequence[Study], machine: str) -> str:
    """The page.

    Args:
        studies: one for each case.
        machine: a sentence on what the times were measured on.
    """
    parts = [
        "<!doctype html>\n<html lang='en'><head><meta charset='utf-8'>",
        "<meta name='viewport' content='width=device-width, initial-scale=1'>",
        f"<title>What accuracy costs in time</title><style>{_STYLE}</style></head><body>",
        "<h1>What accuracy costs in time</h1>",
        "<p>Errors are distances from the reference of each case, their mean over its places, as a",
        "share of its largest displacement. Times are wall time from the scene to the result, the",
        "fastest of three runs where they are short. Marked rows are the front: no other run is ",
        f"both faster and nearer. {escape(machine)}</p>",
        "<ul>",
        *(
            f"<li><a href='#{escape(s.case.name)}'>{escape(s.case.title)}</a>: "
            f"{escape(sentence(s))}</li>"
            for s in studies
        ),
        "</ul>",
        *(_section(study) for study in studies),
        "</body></html>\n",
    ]
    return "\n".join(parts)


def _section(study: Study) -> str:
    case = study.case
    figure = draw(study)
    best = {run.label for run in front(study.runs)}
    head = "".join(f"<th>{escape(name)}</th>" for name in ["run", *COLUMNS])
    rows = [
        f"<tr{' class=front' if run.label in best else ''}>"
        + "".join(f"<td>{escape(cell)}</td>" for cell in row)
        + "</tr>"
        for run, row in zip(study.runs, cells(study), strict=True)
    ]
    parts = [
        f"<h2 id='{escape(case.name)}'>{escape(case.title)}</h2>",
        f"<p>{escape(case.about)}</p>",
        f"<p class='answer'>{escape(sentence(study))}</p>",
        as_svg(figure) if figure is not None else "",
        f"<div class='wide'><table><tr>{head}</tr>{''.join(rows)}</table></div>",
        _table("What each choice takes", *curves(study)),
        _table("Beside the paper", *printed(study)),
    ]
    if case.notes:
        parts.append("<ul>" + "".join(f"<li>{escape(note)}</li>" for note in case.notes) + "</ul>")
    return "\n".join(parts)


def _table(title: str, head: list[str], rows: list[list[str]]) -> str:
    """A table under a title; nothing where there are no rows."""
    if not rows:
        return ""
    names = "".join(f"<th>{escape(name)}</th>" for name in head)
    text = "".join(
        "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows
    )
    return f"<h3>{title}</h3><div class='wide'><table><tr>{names}</tr>{text}</table></div>"
