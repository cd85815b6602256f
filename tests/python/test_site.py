"""The site builds without a warning or a dead link, and fetches nothing from elsewhere."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import tissu

ROOT = Path(__file__).parents[2]
FETCHED = re.compile(r"<(?:script|img|iframe|link)\b[^>]*\b(?:src|href)=[\"']?(?:https?:)?//[^>]*>")


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The built site; a warning of MkDocs is an error."""
    folder = tmp_path_factory.mktemp("site")
    done = subprocess.run(
        [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(folder)],
        cwd=ROOT,
        env={**os.environ, "NO_MKDOCS_2_WARNING": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return folder


def test_nothing_is_fetched(site):
    for page in site.rglob("*.html"):
        if "recordings" in page.parts:
            continue  # test_view_film.py opens a recording without a network
        found = FETCHED.search(page.read_text(encoding="utf-8"))
        assert found is None, f"{page.relative_to(site)}: {found[0]}"


def test_the_recording_plays_where_the_page_says(site):
    page = site / "guide" / "live-view.html"
    frame = re.search(r'<iframe src="([^"]+)"', page.read_text(encoding="utf-8"))
    assert frame is not None
    assert (page.parent / frame[1]).is_file()


def test_what_pages_link_to_outside_docs_comes_along(site):
    assert (site / "source/examples/resection.py").is_file()
    assert (site / "source/CONTRIBUTING.html").is_file()


def test_every_public_name_is_on_a_page_of_the_api(site):
    pages = [path.read_text(encoding="utf-8") for path in (site / "reference/api").glob("*.html")]
    text = "\n".join(pages)
    for name in tissu.__all__:
        if name != "__version__":
            assert re.search(rf'id="tissu\.{name}"', text), name
