"""The page on laws of one's own shows what runs, and names every word there is."""

import contextlib
import io
import re
from pathlib import Path

import pytest

pytest.importorskip("sympy")

from tissu import formula

PAGE = (Path(__file__).parents[2] / "docs" / "guide" / "own-laws.md").read_text(encoding="utf-8")


def test_the_example_runs():
    text, comparison = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    names = {}
    with contextlib.redirect_stdout(io.StringIO()) as out:
        exec(compile(text, "laws.md", "exec"), names)
    assert abs(names["simulation"].time - 0.1) < 1e-12
    assert -0.1 < float(out.getvalue()) < -0.001  # it hangs, by millimetres to centimetres
    assert names["Gent"].__doc__.startswith("Gent 1996")
    with contextlib.redirect_stdout(io.StringIO()) as out:
        exec(compile(comparison, "laws.md", "exec"), names)
    assert out.getvalue() in PAGE
    # What is left is the compressibility, of the order of mu / kappa = 1e-4.
    assert names["found"] == pytest.approx(names["closed"], rel=2e-4)


def test_the_file_of_the_page_makes_the_same_law(tmp_path):
    import tissu as ts
    from tissu.user_law import law_from_record

    text = re.search(r"```python gent.py\n(.*?)```", PAGE, re.DOTALL)[1]
    (tmp_path / "gent.py").write_text(text, encoding="utf-8")
    law = ts.read_law(tmp_path / "gent.py")
    assert law(mu=3e3, jm=2.0, kappa=6e4).type == "gent"
    assert law_from_record(law.made.record()).made.digest == law.made.digest


@pytest.mark.parametrize("word", formula.__all__)
def test_every_word_of_the_vocabulary_is_there(word):
    assert getattr(formula, word) is not None
    assert word in (formula.__doc__ or "")


def test_an_unknown_word_is_an_attribute_error():
    with pytest.raises(AttributeError, match="no word 'Ibar3'"):
        formula.Ibar3  # noqa: B018
