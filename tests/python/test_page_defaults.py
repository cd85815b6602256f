"""The defaults that pages state are those of the code: columns named `default`, and prose."""

import re
from pathlib import Path

import pytest

import tissu as ts
from tissu.scene.trocar.trocar import Trocar

DOCS = Path(__file__).resolve().parents[2] / "docs"
TABLES = {
    ("guide/statics.md", "load_steps"): ts.Static,
    ("guide/solvers.md", "tolerance"): ts.ConjugateGradient,
    ("guide/contact.md", "between"): ts.Contact,
    ("guide/contact.md", "method"): ts.ContactSettings,
}
"""Page and first field of a table -> the class whose fields it lists."""
IN_WORDS = {
    ("statics.md", "newton"): ts.Newton(iterations=25, tolerance=1e-6),
    ("statics.md", "solver"): ts.Auto(),
    ("contact.md", "surface_of"): {},
}
"""What a page says in words of its own, beside which the text is compared below."""


def tables(page: str) -> dict[str, dict[str, str]]:
    """First field -> field -> default, of each table with a column `default`."""
    found: dict[str, dict[str, str]] = {}
    rows: dict[str, str] | None = None
    for line in (DOCS / page).read_text(encoding="utf-8").splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if not line.startswith("|"):
            rows = None
        elif cells[:2] == ["field", "default"]:
            rows = {}
        elif rows is not None and cells[0].startswith("`"):
            rows[cells[0].strip("`")] = cells[1]
            found[next(iter(rows))] = rows
    return found


def rows() -> list[tuple[str, str, str]]:
    """Page, first field of the table and field of every row."""
    return [(page, first, field) for page, first in TABLES for field in tables(page)[first]]


def test_each_table_of_defaults_is_compared() -> None:
    pages = [path.relative_to(DOCS).as_posix() for path in (DOCS / "guide").glob("*.md")]
    assert {(page, first) for page in pages for first in tables(page)} == set(TABLES)


@pytest.mark.parametrize(("page", "first", "field"), rows())
def test_a_default_of_a_table(page: str, first: str, field: str) -> None:
    said, cls = tables(page)[first][field], TABLES[page, first]
    if field == "self":  # a contact of a body with itself is a class of its own
        assert "self" not in cls.model_fields
        return
    info = cls.model_fields[field]
    known = None if info.is_required() else info.get_default(call_default_factory=True)
    key = (Path(page).name, field)
    if key in IN_WORDS:
        assert known == IN_WORDS[key]
    elif isinstance(known, bool):
        assert said == str(known).lower()
    elif isinstance(known, (int, float)):
        assert float(said.split()[0]) == known or f"else {known:.0e}".replace("e-0", "e-") in said
    elif isinstance(known, str):
        assert said == f"`{known}`"
    else:  # required, or computed from the scene: the page has words and no number alone
        assert known is None
        assert not re.fullmatch(r"[-\d.e]+", said)


def test_lists_without_entries_are_not_absent() -> None:
    """They are not null, which a scene refuses for them."""
    page = (DOCS / "reference" / "scene.md").read_text(encoding="utf-8")
    of_scene = page[page.index("### Scene\n") : page.index("### Output\n")]
    said = dict(re.findall(r"^\| `(\w+)` \| (\S+) \|", of_scene, re.MULTILINE))
    lists = [name for name, info in ts.Scene.model_fields.items() if info.default == ()]
    assert {"fixed", "loads", "tear"} <= set(lists)
    assert {said[name] for name in lists} == {"none"}
    assert said["gravity"] == "absent"


PROSE = {
    ("guide/statics.md", "25 iterations, 1e-6"): [ts.Static().newton.iterations == 25],
    ("guide/solvers.md", "1e-5 with `auto`, else 1e-6"): [
        ts.Auto().tolerance == 1e-5,
        ts.ConjugateGradient().tolerance == 1e-6,
    ],
    ("learn/accuracy.md", "The default tolerance is a relative residual of 1e-5"): [
        ts.Auto().tolerance == 1e-5,
        isinstance(ts.ImplicitEuler("1 ms").solver, ts.Auto),
    ],
    ("guide/trocar.md", "| `factor` (default) |"): [
        Trocar.model_fields["compliance"].default == "factor"
    ],
    ("guide/integrators.md", "The default linearises once"): [
        ts.ImplicitEuler("1 ms").newton is None
    ],
}


@pytest.mark.parametrize(("page", "words"), PROSE)
def test_a_default_in_prose(page: str, words: str) -> None:
    assert words in (DOCS / page).read_text(encoding="utf-8")
    assert all(PROSE[page, words])
