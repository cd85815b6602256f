"""The JSON schema of scene files: it takes every scene of the tree and refuses misspelt ones."""

from __future__ import annotations

import copy
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import tissu.scene
from tissu.scene.part import Part
from tissu.scene.schema import scene_schema
from tissu.yaml_io import scene_mapping

ROOT = Path(__file__).resolve().parents[2]
SCENES = sorted(
    path
    for path in [*ROOT.glob("examples/*.yaml"), *ROOT.glob("bench/cases/*.yaml")]
    if "study" not in path.name and "bodies" in scene_mapping(path)
)
SCHEMA = scene_schema()
_TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "null": type(None)}


def _fits(value: Any, schema: dict[str, Any]) -> bool:
    """Whether a value fits a schema: the words of JSON Schema 2020-12 that ours uses."""
    unknown = set(schema) - {
        *("$schema", "$defs", "$ref", "title", "description", "default", "type", "const", "enum"),
        *("anyOf", "not", "properties", "additionalProperties", "required"),
        *("items", "prefixItems", "minItems", "maxItems"),
    }
    assert not unknown
    if "$ref" in schema:
        return _fits(value, SCHEMA["$defs"][schema["$ref"].removeprefix("#/$defs/")])
    checks = [
        "type" not in schema or _is_of(value, schema["type"]),
        "const" not in schema or value == schema["const"],
        "enum" not in schema or value in schema["enum"],
        "anyOf" not in schema or any(_fits(value, one) for one in schema["anyOf"]),
        "not" not in schema or not _fits(value, schema["not"]),
    ]
    if isinstance(value, dict):
        known, others = schema.get("properties", {}), schema.get("additionalProperties", {})
        checks += [key in value for key in schema.get("required", ())]
        checks += [_fits(item, known[key]) for key, item in value.items() if key in known]
        rest = [item for key, item in value.items() if key not in known]
        checks += [not rest] if others is False else [_fits(item, others) for item in rest]
    if isinstance(value, list):
        first = schema.get("prefixItems", [])
        checks += [_fits(v, one) for v, one in zip(value, first, strict=False)]
        checks += [_fits(v, schema.get("items", {})) for v in value[len(first) :]]
        checks += [schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value))]
    return all(checks)


def _is_of(value: Any, kind: str) -> bool:
    if kind in ("number", "integer"):
        return isinstance(value, int if kind == "integer" else (int, float))
    return isinstance(value, _TYPES[kind])


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_every_scene_of_the_tree_fits(path: Path) -> None:
    assert _fits(json.loads(json.dumps(scene_mapping(path))), SCHEMA)


@pytest.mark.parametrize(
    ("where", "key", "value"),
    [
        ((), "gravitation", [0, 0, 1]),
        (("step",), "type", "implicit"),
        (("step",), "dt", [1]),
        (("bodies", "organ"), "densty", 1000),
        (("bodies", "organ", "law"), "young", None),
        (("fixed", 0, "on"), "min", [0, 0]),
        (("fixed", 0), "axes", 3),
    ],
)
def test_what_a_scene_file_may_not_say_does_not_fit(
    where: tuple[Any, ...], key: str, value: object
) -> None:
    scene = copy.deepcopy(scene_mapping(ROOT / "examples/organ.yaml"))
    assert _fits(scene, SCHEMA)
    part: Any = scene
    for name in where:
        part = part[name]
    part[key] = value
    assert not _fits(scene, SCHEMA)


@pytest.mark.parametrize("step", ["auto", {"type": "auto"}, {"type": "rk4", "dt": "1 ms"}])
def test_words_that_stand_for_a_part_fit(step: object) -> None:
    scene = scene_mapping(ROOT / "examples/organ.yaml")
    assert _fits({**scene, "step": step}, SCHEMA)
    own = copy.deepcopy(scene)
    own["bodies"]["organ"]["law"] = {"type": "gent", "mu": "1 kPa"}  # of a file under laws:
    own["bodies"]["organ"]["model"] = "corotational"
    assert _fits(own, SCHEMA)


def test_every_class_of_a_scene_is_in_it() -> None:
    named = {
        name
        for name in tissu.scene.__all__
        if isinstance(part := getattr(tissu.scene, name), type) and issubclass(part, Part)
    }
    assert named - {"Scene", "UserLaw"} <= set(SCHEMA["$defs"])


def test_the_command_prints_it() -> None:
    command = [sys.executable, "-m", "tissu.cli", "schema"]
    ended = subprocess.run(command, capture_output=True, text=True, check=True)
    assert json.loads(ended.stdout) == SCHEMA
    assert json.loads(ended.stdout)["$schema"] == "https://json-schema.org/draft/2020-12/schema"
