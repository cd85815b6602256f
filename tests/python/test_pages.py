"""Pages run as they stand there: what a reader types, and what is printed then."""

from pathlib import Path

import matplotlib
import pytest

from page_blocks import DOCS, blocks_of, has_python, run_page
from tissu import Scene

ELSEWHERE = {
    "guide/advise.md": "test_advise.py",
    "guide/checkpoint.md": "test_pages.py",
    "guide/contact.md": "test_contact_run.py",
    "guide/cutting.md": "test_cutting.py",
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


SCENES = [
    (page, block.title)
    for page in DOCS.rglob("*.md")
    for block in blocks_of(page)
    if block.kind == "yaml" and block.title
]


@pytest.mark.parametrize(("page", "title"), SCENES, ids=lambda value: str(value).split("/")[-1])
def test_the_scene_of_the_page_has_no_problem(page, title, tmp_path):
    from tissu import examples

    examples.copy("organ", tmp_path)
    text = next(block.text for block in blocks_of(page) if block.title == title)
    (tmp_path / title).write_text(text, encoding="utf-8")
    assert Scene.from_yaml(tmp_path / title).check().problems == ()


def test_pages_that_run_elsewhere_are_there():
    for page, test in ELSEWHERE.items():
        assert has_python(DOCS / page)
        assert (Path(__file__).parent / test).is_file()
