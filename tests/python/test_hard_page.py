"""The page of hard cases has the text of the script that prints it; its tables are not run here."""

import runpy
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_the_page_has_the_text_of_its_script(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "tests" / "hard"))
    made = runpy.run_path(str(ROOT / "bench" / "hard.py"), run_name="bench")
    text = made["PAGE"].read_text(encoding="utf-8")
    before, _, after = text.partition(f"{made['BEGIN']}\n")
    contact, _, end = after.partition(f"{made['END']}\n")
    assert before.startswith(made["HEAD"])
    assert contact.startswith(f"\n{made['CONTACT_HEAD']}")
    assert end == f"\n{made['TAIL']}"
