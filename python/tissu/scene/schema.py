"""The JSON schema of a scene file, made from the classes: what an editor completes and checks.

It says which keys and types there are. What needs the whole scene or its meshes, such as fields
that contradict each other and selections that select nothing, is for `tissu check`.
"""

from __future__ import annotations

import types
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic.fields import FieldInfo

from tissu.scene.bar import BarMesh
from tissu.scene.body import Body, MeshFile
from tissu.scene.contact import ContactSettings
from tissu.scene.convex_obstacle import ConvexObstacle
from tissu.scene.editing import Editing
from tissu.scene.explain import described
from tissu.scene.generated.laws import LAWS
from tissu.scene.instrument import INSTRUMENTS, Instrument
from tissu.scene.law import Law
from tissu.scene.load import LOADS, Load
from tissu.scene.model import MODELS, Model
from tissu.scene.obstacle import OBSTACLES, MeshObstacle
from tissu.scene.obstacle_part import Obstacle
from tissu.scene.part import Part, type_name
from tissu.scene.scene import SceneData
from tissu.scene.section import SECTIONS, Section
from tissu.scene.selection import SELECTIONS, Region, Selection
from tissu.scene.solver import SOLVERS, Solver
from tissu.scene.step import STEPS, Step
from tissu.scene.tissue import Tissue
from tissu.scene.trocar.device import DEVICES, TrocarDevice
from tissu.scene.trocar.trocar import Coupling, Trocar
from tissu.scene.viscosity import VISCOSITIES, Viscosity

Schema = dict[str, Any]

_NUMBER = [{"type": "number"}, {"type": "string"}]  # a text carries a unit, such as "4 kPa"
_MESH = MeshFile | BarMesh | Path
_FAMILIES: dict[Any, tuple[type[Part], ...]] = {
    Instrument: INSTRUMENTS,
    Law: LAWS,
    Load: LOADS,
    Model: MODELS,
    Obstacle: OBSTACLES,
    Section: SECTIONS,
    Selection: SELECTIONS,
    Solver: SOLVERS,
    Step: STEPS,
    TrocarDevice: DEVICES,
    Viscosity: VISCOSITIES,
}
_READ_AS: dict[tuple[type[Part], str], Any] = {  # fields that read more than they keep
    (Body, "mesh"): _MESH,
    (ContactSettings, "surface_of"): dict[str, _MESH],
    (ConvexObstacle, "mesh"): _MESH | None,
    (MeshObstacle, "mesh"): _MESH,
    (SceneData, "editing"): Editing | bool | None,
    (Tissue, "inside"): _MESH | None,
    (Trocar, "coupling"): Coupling | Literal["automatic"],
    (Region, "name"): str | int,  # YAML reads the name 7 as a number
}
_DIALECT = "https://json-schema.org/draft/2020-12/schema"


def scene_schema() -> Schema:
    """The schema of a scene file as mappings and lists, of JSON Schema 2020-12."""
    found: dict[str, Schema] = {}
    _define(SceneData, found)
    whole = found.pop("SceneData")
    return {
        "$schema": _DIALECT,
        "title": "tissu scene",
        **whole,
        "$defs": dict(sorted(found.items())),
    }


def _define(part: type[Part], found: dict[str, Schema]) -> Schema:
    """The definition of a part, under its name; a reference to it."""
    name = part.__name__
    if name not in found:
        found[name] = {}  # so that a part within itself ends
        fields = part.model_fields
        required = [key for key, field in fields.items() if field.is_required()]
        if "type" in fields:
            required = ["type", *required]
        found[name] = {
            "description": " ".join((part.__doc__ or "").split()),
            "type": "object",
            "additionalProperties": False,
            "required": required,
            "properties": {key: _field(part, key, f, found) for key, f in fields.items()},
        }
    return {"$ref": f"#/$defs/{name}"}


def _field(part: type[Part], key: str, field: FieldInfo, found: dict[str, Schema]) -> Schema:
    kind = _READ_AS.get((part, key), field.annotation)
    kinds = [{"enum": _spellings(part)}] if key == "type" else [*_kinds(kind, found), *_words(kind)]
    schema = dict(_any_of(kinds))
    if text := described(part, key):
        schema["description"] = " ".join(text.split())
    if not field.is_required() and isinstance(field.default, (str, int, float, bool)):
        schema["default"] = field.default
    return schema


def _words(kind: Any) -> Iterator[Schema]:
    """What may stand in place of a mapping: the word auto, names alone, laws of one's own."""
    families = set(get_args(kind)) | {kind}
    if Step in families:
        yield {"const": "auto"}
        yield _named("auto", "stable explicit steps")
    for family in (Model, Solver):
        if family in families:
            yield {"enum": [word for part in _FAMILIES[family] for word in _spellings(part)]}
    if Law in families:
        known = {"enum": [word for law in LAWS for word in _spellings(law)]}
        own = {"type": "string", "not": known}
        yield {"type": "object", "required": ["type"], "properties": {"type": own}}


def _spellings(part: type[Part]) -> list[str]:
    """The type of a part, with underscores and, as is accepted too, with hyphens."""
    word = type_name(part)
    return list(dict.fromkeys([word, word.replace("_", "-")]))


def _named(word: str, meaning: str) -> Schema:
    return {
        "description": meaning,
        "type": "object",
        "required": ["type"],
        "properties": {"type": {"const": word}},
    }


def _kinds(kind: Any, found: dict[str, Schema]) -> Iterator[Schema]:
    """Schemas of what a field of this annotation accepts, one of which has to fit."""
    origin, members = get_origin(kind), get_args(kind)
    if origin is Annotated:
        yield from _kinds(members[0], found)
    elif origin in (Union, types.UnionType):
        for member in members:
            yield from _kinds(member, found)
    elif origin is Literal:
        yield {"enum": list(members)}
    elif origin is tuple:
        yield from _tuple(members, found)
    elif origin in (dict, Mapping):
        of = _any_of([*_kinds(members[1], found), *_words(members[1])])
        yield {"type": "object", "additionalProperties": of}
    elif kind in _FAMILIES:
        for part in _FAMILIES[kind]:
            yield _define(part, found)
    elif isinstance(kind, type) and issubclass(kind, Part):
        yield _define(kind, found)
    else:
        yield from _PLAIN[kind]


_PLAIN: dict[Any, list[Schema]] = {
    float: _NUMBER,
    int: [{"type": "integer"}],
    bool: [{"type": "boolean"}],
    str: [{"type": "string"}],
    Path: [{"type": "string"}],
    type(None): [{"type": "null"}],
}


def _tuple(members: tuple[Any, ...], found: dict[str, Schema]) -> Iterator[Schema]:
    if members[-1] is Ellipsis:
        yield {"type": "array", "items": _any_of(_kinds(members[0], found))}
        return
    items = [_any_of(_kinds(member, found)) for member in members]
    yield {"type": "array", "prefixItems": items, "minItems": len(items), "maxItems": len(items)}


def _any_of(kinds: Iterable[Schema]) -> Schema:
    every: list[Schema] = []
    for kind in kinds:
        if kind not in every:
            every.append(kind)
    return every[0] if len(every) == 1 else {"anyOf": every}
