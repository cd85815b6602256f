"""Pages run as they stand there: what a reader types, and what is printed then."""

import json
import re
import runpy
from pathlib import Path

import matplotlib
import pytest

from page_blocks import DOCS, has_python, run_page

ELSEWHERE = {
    "guide/advise.md": "test_advise.py",
    "guide/contact.md": "test_contact_run.py",
    "guide/fields.md": "test_fields.py",
    "guide/live-view.md": "view/test_view_verbs.py",
    "guide/own-laws.md": "test_docs_laws.py",
    "guide/while-it-runs.md": "test_while_it_runs.py",
}
"""Pages whose blocks need more than the page -> the test that runs them."""
FOLDERS = ("learn", "guide", "reference")
PAGES = sorted(
    path
    for path in [
        *DOCS.glob("*.md"),
        *(path for name in FOLDERS for path in (DOCS / name).rglob("*.md")),
    ]
    if has_python(path) and str(path.relative_to(DOCS)) not in ELSEWHERE
)


@pytest.mark.parametrize("page", PAGES, ids=lambda path: str(path.relative_to(DOCS)))
def test_the_page_runs(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    matplotlib.use("agg")
    run_page(page)


def test_pages_that_run_elsewhere_are_there():
    for page, test in ELSEWHERE.items():
        assert has_python(DOCS / page)
        assert (Path(__file__).parent / test).is_file()


@pytest.mark.parametrize("page", sorted((DOCS / "guide").glob("*.md")), ids=lambda path: path.stem)
def test_a_page_of_the_guide_has_its_limits(page):
    if page.stem != "index" and not page.stem.endswith("-methods"):
        assert "\n## Limits\n" in page.read_text(encoding="utf-8")


MADE = runpy.run_path(str(DOCS / "make_notebook.py"), run_name="docs")


@pytest.mark.parametrize("path", MADE["NOTEBOOKS"], ids=lambda path: path.stem)
def test_the_notebook_prints_what_it_holds(path):
    matplotlib.use("agg")
    names = {}
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] == "code":
            found, _ = MADE["run"]("".join(cell["source"]), names)
            held = [output.get("text", []) for output in cell["outputs"]]
            assert found == "".join(line for lines in held for line in lines)


def test_each_measured_page_says_when_and_by_what():
    rows = runpy.run_path(str(DOCS / "site_measured.py"), run_name="docs")["rows"]()
    pages = {path.name for path in (DOCS / "measured").glob("*.md")} - {"index.md"}
    assert set(rows) == pages
    for script, day, machine in rows.values():
        scripts = re.findall(r"`(?:bench/)?([\w.]+\.py)`", script)
        assert all((DOCS.parent / "bench" / name).is_file() for name in scripts)
        # "2026-11-22", or "2026-11-22; the default 2026-11-23" where one table is of another day
        assert all(re.fullmatch(r"([a-z ]+ )?20\d\d-\d\d-\d\d", of) for of in day.split("; "))
        assert machine
