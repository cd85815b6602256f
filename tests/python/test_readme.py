"""What the README shows runs, and the page of scene files is the classes' own."""

import contextlib
import io
import re
import runpy
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]


def test_the_example_of_the_readme_runs(monkeypatch):
    monkeypatch.chdir(ROOT)
    text = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)[0]
    names = {}
    with contextlib.redirect_stdout(io.StringIO()) as out:
        exec(compile(text, "README.md", "exec"), names)
    simulation = names["simulation"]
    assert abs(simulation.time - 0.5) < 1e-12
    assert out.getvalue().count("step ") >= 50
    assert "not converged" not in out.getvalue()
    moved = np.linalg.norm(simulation.displacements("liver"), axis=1).max()
    assert 0.005 < moved < 0.08  # centimetres: it hangs, and has not run away


def test_the_example_of_contact_runs(monkeypatch):
    """With the organ of the first example; it audits each of its steps."""
    monkeypatch.chdir(ROOT)
    first, contact = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)
    names = {}
    with contextlib.redirect_stdout(io.StringIO()):
        exec(compile(first.partition("simulation =")[0], "README.md", "exec"), names)
        exec(compile(contact, "README.md", "exec"), names)
    assert names["report"].converged
    force = names["simulation"].force_on("probe").force
    assert 0.3 < force[2] < 20.0  # newtons: it presses the probe up


def test_the_page_of_scene_files_is_current():
    made = runpy.run_path(str(ROOT / "docs" / "make_scene.py"), run_name="docs")
    assert (ROOT / "docs" / "reference" / "scene.md").read_text(encoding="utf-8") == made["page"]()


def test_links_of_the_documents_lead_somewhere():
    for page in [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")]:
        for target in re.findall(r"\]\(([^)#:]+)\)", page.read_text(encoding="utf-8")):
            assert (page.parent / target).exists(), f"{page.name}: {target}"


def test_the_page_of_models_is_current():
    made = runpy.run_path(str(ROOT / "bench" / "model_abilities.py"), run_name="docs")
    page = (ROOT / "docs" / "measured" / "models.md").read_text(encoding="utf-8")
    for name in made["models"]():
        assert made["words"](name) in page


@pytest.mark.parametrize("name", ["make_command_line", "make_units"])
def test_the_made_page_is_current(name):
    made = runpy.run_path(str(ROOT / "docs" / f"{name}.py"), run_name="docs")
    assert made["PAGE"].read_text(encoding="utf-8") == made["page"]()


def test_the_pages_of_the_api_are_current():
    made = runpy.run_path(str(ROOT / "docs" / "make_api.py"), run_name="docs")
    for path, text in made["pages"]().items():
        assert path.read_text(encoding="utf-8") == text, path.name
    assert set(made["FOLDER"].glob("*.md")) == set(made["pages"]())
