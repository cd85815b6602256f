"""Scenes as YAML: read with the line of every field, written so that they read back equal.

The words are those of YAML 1.2's core: `on`, `yes`, `off` are texts, and 1e-6 is a number (YAML 1.1
says otherwise).
"""

from __future__ import annotations

import contextlib
import os
import re
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from tissu.errors import SceneError
from tissu.scene.body import Body, MeshFile
from tissu.scene.part import KEEP_PROBLEMS, Part
from tissu.scene.problem import Path as FieldPath
from tissu.scene.problem import Problem, Source
from tissu.scene.scene import SceneData
from tissu.scene.unknown import Unknown

if TYPE_CHECKING:
    import yaml

    from tissu.scene.law import UserLaw

_WORDS = {
    "tag:yaml.org,2002:bool": (r"true|True|TRUE|false|False|FALSE", "tTfF"),
    "tag:yaml.org,2002:float": (
        r"[-+]?(?:\d+\.\d*|\.\d+|\d+)(?:[eE][-+]?\d+)?|[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)",
        "-+.0123456789",
    ),
    "tag:yaml.org,2002:int": (r"[-+]?\d+", "-+0123456789"),
    "tag:yaml.org,2002:null": (r"~|null|Null|NULL|", "~nN\0"),
    "tag:yaml.org,2002:merge": (r"<<", "<"),
}


S = TypeVar("S", bound=SceneData)


def read_scene(path: Path, cls: type[S], *, to_run: bool = False) -> S:
    """Read a scene file; paths of meshes are relative to its folder.

    Args:
        path: the file.
        cls: the class of the scene.
        to_run: whether a duration that is absent but needed is a problem.

    Returns:
        The scene with what could be read of it, and with the problems of its fields.

    Raises:
        SceneError: the file cannot be read, or is not YAML.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise SceneError([f"{path}: the scene file cannot be read: {error.strerror}"]) from None
    except UnicodeDecodeError:
        raise SceneError([f"{path}: not a text in UTF-8; a YAML scene is accepted"]) from None
    scene = parse_scene(text, cls, base=path.parent, name=str(path))
    if to_run:
        with contextlib.suppress(Unknown):
            if scene.duration is None and scene.step.type != "static":
                missing = Problem(("duration",), "is missing; give it here or by --duration")
                scene._problems += (missing,)
    return scene


def parse_scene(text: str, cls: type[S], *, base: Path | None = None, name: str = "text") -> S:
    """Read a scene from YAML text.

    Returns:
        The scene with what could be read of it, and with the problems of its fields.

    Raises:
        SceneError: not YAML, or no mapping.
    """
    data, source, problems = _load(text, name)
    if not isinstance(data, dict):
        found = "nothing" if data is None else repr(data)[:40]
        raise SceneError(
            [
                f"{name}:1: found {found}; a mapping with the keys "
                f"{', '.join(cls.model_fields)} is accepted"
            ]
        )
    laws: list[type[UserLaw]] = []
    refused: list[Problem] = []
    if data.get("laws"):
        from tissu.user_law.of_scene import laws_of_scene

        laws, refused = laws_of_scene(data["laws"], base)
    problems += refused
    context = {"base": base, "laws": laws, "laws_refused": bool(refused), KEEP_PROBLEMS: True}
    scene = cls.model_validate(data, context=context)
    scene._source = source
    scene._problems += tuple(problems)
    return scene


def scene_mapping(path: Path) -> dict[str, Any]:
    """What a scene file says, as it stands there: words, numbers, lists and mappings.

    Raises:
        SceneError: the file cannot be read, or is not YAML.
    """
    try:
        data, _, _ = _load(path.read_text(encoding="utf-8"), str(path))
    except OSError as error:
        raise SceneError([f"{path}: the scene file cannot be read: {error.strerror}"]) from None
    if not isinstance(data, dict):
        raise SceneError([f"{path}: a mapping with the keys of a scene is accepted"])
    return data


def scene_data(scene: SceneData, *, folder: Path | None = None) -> dict[str, Any]:
    """The scene as mappings, lists and numbers; with `folder`, paths of meshes relative to it.

    Raises:
        SceneError: a mesh or a law that came from no file.
    """
    problems = [
        f"bodies.{name}.mesh: made in memory, so it has no file to name; "
        "scene.save(path) writes it beside the scene"
        for name, body in scene.bodies.items()
        if not isinstance(body.mesh, Part) and body.mesh.source is None
    ]
    problems += [
        f"the law {law.name} was made in memory, so it has no file to name; write its formula to a "
        "file and take tissu.read_law(file)"
        for law in scene.own_laws()
        if law.file is None
    ]
    if problems:
        raise SceneError(problems)
    files = dict.fromkeys([*scene.laws, *(law.file for law in scene.own_laws())])
    data: dict[str, Any] = _plain(scene, folder)
    if files:
        rest = {key: value for key, value in data.items() if key != "laws"}
        data = {"laws": _plain(list(files), folder), **rest}
    return data


def scene_text(scene: SceneData, *, folder: Path | None = None) -> str:
    """The scene as YAML; with `folder`, paths of meshes are written relative to it.

    Raises:
        SceneError: a mesh that came from no file.
    """
    import yaml

    data = scene_data(scene, folder=folder)
    return str(yaml.dump(data, Dumper=_dumper(), sort_keys=False, width=100, allow_unicode=True))


def write_scene(scene: SceneData, path: Path) -> None:
    """Write the scene, and each mesh made in memory beside it as .vtu.

    Raises:
        SceneError: the file or a mesh cannot be written.
    """
    bodies: dict[str, Body] = {}
    try:
        for name, body in scene.bodies.items():
            if isinstance(body.mesh, Part) or body.mesh.source is not None:
                bodies[name] = body
                continue
            from tissu.mesh import write_mesh

            file = path.with_name(f"{path.stem}-{re.sub(r'[^A-Za-z0-9_.-]', '_', name)}.vtu")
            write_mesh(body.mesh, file)
            bodies[name] = body.replace(mesh=MeshFile(file))
        text = scene_text(scene.replace(bodies=bodies), folder=path.parent)
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise SceneError([f"{path}: the scene cannot be written: {error.strerror}"]) from None


def _load(text: str, name: str) -> tuple[Any, Source, list[Problem]]:
    """Data, lines of all fields, and keys that are written twice."""
    import yaml

    loader = _loader()(text)
    try:
        node = loader.get_single_node()
        if node is None:
            return None, Source(name), []
        lines: dict[FieldPath, int] = {}
        problems: list[Problem] = []
        _walk(node, (), lines, problems, ())
        return loader.construct_document(node), Source(name, lines), problems
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line = mark.line + 1 if mark is not None else 1
        raise SceneError(
            [f"{name}:{line}: not valid YAML: {error.problem or error.context}"]
        ) from None
    except (yaml.YAMLError, ValueError, TypeError) as error:
        raise SceneError([f"{name}:1: not valid YAML: {error}"]) from None
    finally:
        loader.dispose()


def _walk(
    node: yaml.Node,
    path: FieldPath,
    lines: dict[FieldPath, int],
    problems: list[Problem],
    above: tuple[int, ...],
) -> None:
    """Note the line of each field below a node, and keys given twice."""
    import yaml

    if id(node) in above:
        raise yaml.constructor.ConstructorError(
            None, None, "an alias that contains itself", node.start_mark
        )
    above = (*above, id(node))
    lines.setdefault(path, node.start_mark.line + 1)
    if isinstance(node, yaml.SequenceNode):
        for number, item in enumerate(node.value):
            _walk(item, (*path, number), lines, problems, above)
    elif isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            inner = (*path, str(key.value))
            if inner in lines:
                problems.append(
                    Problem(inner, f"written twice, first in line {lines[inner]}; keep one of them")
                )
            lines[inner] = key.start_mark.line + 1
            _walk(value, inner, lines, problems, above)


def _plain(value: Any, folder: Path | None) -> Any:
    """A part as mappings, lists and numbers: its type and the fields that were given."""
    if isinstance(value, Part):
        fields = {name: getattr(value, name) for name in type(value).model_fields}
        given = value.model_fields_set | {"type"}
        return {
            name: _plain(field, folder)
            for name, field in fields.items()
            if name in given and field is not None
        }
    if isinstance(value, Mapping):
        return {name: _plain(item, folder) for name, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item, folder) for item in value]
    if isinstance(value, Path):
        return (value if folder is None else _seen_from(folder, value)).as_posix()
    if hasattr(value, "source"):  # a mesh in memory that came from a file
        return _plain(MeshFile(value.source, unit=value.unit, scale=value.scale), folder)
    return value


def _seen_from(folder: Path, file: Path) -> Path:
    """The path of a file from a folder, which leads there through links to folders too."""
    place = file.parent.resolve() / file.name
    try:
        return Path(os.path.relpath(place, folder.resolve()))
    except ValueError:  # on another drive
        return place


@lru_cache(maxsize=1)
def _loader() -> type[yaml.SafeLoader]:
    import yaml

    class Loader(yaml.SafeLoader):
        """SafeLoader with the words of YAML 1.2."""

    Loader.yaml_implicit_resolvers = {}
    _add_words(Loader)
    return Loader


@lru_cache(maxsize=1)
def _dumper() -> type[yaml.SafeDumper]:
    import yaml

    class Dumper(yaml.SafeDumper):
        """SafeDumper with the words of YAML 1.2; lists of numbers on one line."""

        def ignore_aliases(self, data: Any) -> bool:
            return True

    def sequence(dumper: yaml.SafeDumper, data: list[Any]) -> yaml.Node:
        flat = not any(isinstance(item, dict) for item in data)
        return dumper.represent_sequence("tag:yaml.org,2002:seq", data, flow_style=flat)

    Dumper.yaml_implicit_resolvers = {}
    _add_words(Dumper)
    Dumper.add_representer(list, sequence)
    return Dumper


def _add_words(cls: Any) -> None:
    for tag, (pattern, first) in reversed(_WORDS.items()):
        cls.add_implicit_resolver(
            tag, re.compile(f"^(?:{pattern})$"), ["" if c == "\0" else c for c in first]
        )
