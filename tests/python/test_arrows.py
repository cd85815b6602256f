"""The check of arrows between rooms: what it refuses, in trees and tables made for it."""

import importlib.util
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[2] / ".ci" / "check_arrows.py"


@pytest.fixture
def arrows():
    spec = importlib.util.spec_from_file_location("check_arrows", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_tables_are_rooms_that_are_there_without_a_circle(arrows):
    assert list(arrows.check_tables()) == []


def test_a_room_that_is_not_there_is_refused(arrows):
    table = {"mesh": {"base"}, "selection": set()}
    assert list(arrows.absent_rooms(table, {"mesh"}, "CPP")) == [
        "the table CPP names 'base', which is not there; take it out",
        "the table CPP names 'selection', which is not there; take it out",
    ]


def test_a_circle_is_refused_and_named(arrows):
    table = {"base": set(), "scene": {"base", "yaml_io"}, "yaml_io": {"scene"}, "cli": {"scene"}}
    (problem,) = arrows.cycles(table, "PYTHON")
    assert "circle: scene -> yaml_io -> scene;" in problem
    assert list(arrows.cycles({**table, "yaml_io": {"base"}}, "PYTHON")) == []


def test_an_import_upwards_is_refused_inside_functions_too(arrows, monkeypatch, tmp_path):
    for name, text in {
        "scene/part.py": "def f():\n    from tissu.compile import check_scene\n",
        "scene/typed.py": (
            "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import tissu.compile.world\n"
        ),
        "compile/world.py": "from tissu.scene.part import Part\n",
    }.items():
        path = tmp_path / "python" / "tissu" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    monkeypatch.setattr(arrows, "ROOT", tmp_path)
    (problem,) = arrows.check_python()
    assert problem.startswith("python/tissu/scene/part.py:2: scene imports compile; allowed: ")


def test_a_scene_is_data(arrows):
    assert not arrows.PYTHON["scene"] & {"yaml_io", "compile", "effects", "simulation", "front"}
