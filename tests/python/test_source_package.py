"""The source package (sdist) holds what its Makefile runs and what its pages link to."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PROJECT = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
LINE = re.search(r"^sdist\.exclude = \[(.*)\]$", PROJECT, re.MULTILINE)[1]
EXCLUDED = re.findall(r'"([^"]+)"', LINE)


def scripts_of_the_makefile():
    return set(re.findall(r"\.ci/[\w.]+", (ROOT / "Makefile").read_text(encoding="utf-8")))


def files_that_pages_link_to():
    pages = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")]
    for page in pages:
        for target in re.findall(r"\]\(([^)#:]+)[)#]", page.read_text(encoding="utf-8")):
            yield str((page.parent / target).resolve().relative_to(ROOT))


@pytest.mark.parametrize("named", [scripts_of_the_makefile, files_that_pages_link_to])
def test_nothing_that_is_named_is_left_out(named):
    found = set(named())
    assert len(found) > 5
    for path in found:
        left_out = [name for name in EXCLUDED if path == name or path.startswith(f"{name}/")]
        assert not left_out, f"{path} is named, and sdist.exclude has {left_out}"
