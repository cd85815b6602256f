"""Scenes as YAML: read with the line of every field, written so that they read back equal."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from tissu.errors import SceneError
from tissu.files import distinct_names, require_file_place, whole_file
from tissu.reading import written
from tissu.scene.body import MeshFile
from tissu.scene.part import KEEP_PROBLEMS, Part
from tissu.scene.problem import Problem, Source
from tissu.scene.scene import SceneData
from tissu.scene.unknown import Unknown
from tissu.yaml_text import add_words, load, scene_file_text

if TYPE_CHECKING:
    import yaml

    from tissu.scene.law import UserLaw


S = TypeVar("S", bound=SceneData)


def read_scene(path: Path, cls: type[S], *, to_run: bool = False, trust_laws: bool = False) -> S:
    """Read a scene file; paths of meshes are relative to its folder.

    Args:
        path: the file.
        cls: the class of the scene.
        to_run: whether a duration that is absent but needed is a problem.
        trust_laws: whether the files of `laws`, which are programs, may run.

    Returns:
        The scene with what could be read of it, and with the problems of its fields.

    Raises:
        SceneError: the file cannot be read, or is not YAML.
    """
    text = scene_file_text(path)
    return parse_scene(
        text, cls, base=path.parent, name=str(path), to_run=to_run, trust_laws=trust_laws
    )


def parse_scene(
    text: str,
    cls: type[S],
    *,
    base: Path | None = None,
    name: str = "text",
    to_run: bool = False,
    trust_laws: bool = False,
) -> S:
    """Read a scene from YAML text.

    The files of `laws` run only where they are trusted, and only when nothing else is wrong with
    the scene.

    Returns:
        The scene with what could be read of it, and with the problems of its fields.

    Raises:
        SceneError: not YAML, or no mapping; or laws are trusted and something else is wrong.
    """
    data, source, problems = load(text, name)
    if not isinstance(data, dict):
        found = "nothing" if data is None else written(data)
        accepted = f"a mapping with the keys {', '.join(cls.model_fields)} is accepted"
        raise SceneError([f"{name}:1: found {found}; {accepted}"])
    if data.get("laws"):
        return _with_laws(cls, data, base, source, problems, to_run=to_run, trusted=trust_laws)
    return _to_run(_validated(cls, data, base, source, problems), to_run)


def _with_laws(
    cls: type[S],
    data: dict[str, Any],
    base: Path | None,
    source: Source,
    problems: list[Problem],
    *,
    to_run: bool,
    trusted: bool,
) -> S:
    """The scene of a text that names files of laws."""
    from tissu.user_law.of_scene import laws_of_scene, untrusted

    refused = [] if trusted else untrusted(data["laws"])
    scene = _validated(cls, data, base, source, [*problems, *refused], laws_refused=True)
    scene = _to_run(scene, to_run)
    if refused:
        return scene
    others = scene._refusal()
    if others:
        raise SceneError(others)
    laws, refused = laws_of_scene(data["laws"], base)
    problems = [*problems, *refused]
    return _validated(cls, data, base, source, problems, laws=laws, laws_refused=bool(refused))


def _validated(
    cls: type[S],
    data: dict[str, Any],
    base: Path | None,
    source: Source,
    problems: list[Problem],
    *,
    laws: Sequence[type[UserLaw]] = (),
    laws_refused: bool = False,
) -> S:
    """The scene of what a text says; `laws_refused`: laws that are not known may be of a file."""
    context = {"base": base, "laws": laws, "laws_refused": laws_refused, KEEP_PROBLEMS: True}
    scene = cls.model_validate(data, context=context)
    scene._source = source
    scene._problems += tuple(problems)
    return scene


def _to_run(scene: S, wanted: bool) -> S:
    """The scene, with a problem where it is to run and has no duration that it needs."""
    with contextlib.suppress(Unknown):
        if wanted and scene.duration is None and scene.step.type != "static":
            missing = Problem(("duration",), "is missing; give it here or by --duration")
            scene._problems += (missing,)
    return scene


def scene_mapping(path: Path) -> dict[str, Any]:
    """What a scene file says, as it stands there: words, numbers, lists and mappings.

    Raises:
        SceneError: the file cannot be read, or is not YAML.
    """
    data, _, _ = load(scene_file_text(path), str(path))
    if not isinstance(data, dict):
        raise SceneError([f"{path}: a mapping with the keys of a scene is accepted"])
    return data


def scene_data(
    scene: SceneData, *, folder: Path | None = None, moved: Mapping[Path, Path] | None = None
) -> dict[str, Any]:
    """The scene as mappings, lists and numbers; with `folder`, paths of meshes relative to it.

    moved: the places of files of laws that were copied.

    Raises:
        SceneError: a mesh or a law that came from no file.
    """
    problems = [
        f"{group}.{name}.mesh: made in memory, so it has no file to name; "
        "scene.save(path) writes it beside the scene"
        for group in ("bodies", "obstacles")
        for name in _made_in_memory(getattr(scene, group))
    ]
    problems += [
        f"contact.surface_of.{name}: made in memory, so it has no file to name; "
        "scene.save(path) writes it beside the scene"
        for name in _unwritten(_own_surfaces(scene))
    ]
    problems += [
        f"the law {law.name} was made in memory, so it has no file to name; write its formula to a "
        "file and take tissu.read_law(file)"
        for law in scene.own_laws()
        if law.file is None
    ]
    if problems:
        raise SceneError(problems)
    files = dict.fromkeys((moved or {}).get(file, file) for file in law_files(scene))
    data: dict[str, Any] = _plain(scene, folder)
    if files:
        rest = {key: value for key, value in data.items() if key != "laws"}
        data = {"laws": _plain(list(files), folder), **rest}
    return data


def _made_in_memory(parts: Mapping[str, Part]) -> list[str]:
    """The names of the bodies, or obstacles, whose mesh came from no file."""
    return _unwritten({name: getattr(part, "mesh", None) or part for name, part in parts.items()})


def _unwritten(meshes: Mapping[str, Any]) -> list[str]:
    """The names of the meshes that came from no file."""
    return [n for n, m in meshes.items() if not isinstance(m, Part) and m.source is None]


def _own_surfaces(scene: SceneData) -> dict[str, Any]:
    """Body -> mesh of `surface_of`."""
    return {} if scene.contact is None else dict(scene.contact.surface_of)


def scene_text(
    scene: SceneData, *, folder: Path | None = None, moved: Mapping[Path, Path] | None = None
) -> str:
    """The scene as YAML; with `folder`, paths of meshes are written relative to it.

    Raises:
        SceneError: a mesh that came from no file.
    """
    import yaml

    data = scene_data(scene, folder=folder, moved=moved)
    return str(yaml.dump(data, Dumper=_dumper(), sort_keys=False, width=100, allow_unicode=True))


def write_scene(scene: SceneData, path: Path) -> None:
    """Write the scene, each mesh made in memory beside it as .vtu, and laws from elsewhere.

    Raises:
        SceneError: the file or a mesh cannot be written.
    """
    require_file_place(path, "scene", error=_scene_error)
    changes: dict[str, Any] = {}
    files = distinct_names([*scene.bodies, *scene.obstacles])
    for group in ("bodies", "obstacles"):
        parts = dict(getattr(scene, group))
        for name in _made_in_memory(parts):
            from tissu.mesh import write_mesh

            file = path.with_name(f"{path.stem}-{files[name]}.vtu")
            write_mesh(parts[name].mesh, file)
            parts[name] = parts[name].replace(mesh=MeshFile(file))
            changes[group] = parts
    surfaces = _own_surfaces(scene)
    for name in _unwritten(surfaces):
        from tissu.mesh import write_mesh

        file = path.with_name(f"{path.stem}-{files[name]}-surface.vtu")
        write_mesh(surfaces[name], file)
        surfaces[name] = MeshFile(file)
    if scene.contact is not None:
        changes["contact"] = scene.contact.replace(surface_of=surfaces)
    moved = laws_beside(scene, path.parent)
    text = scene_text(scene.replace(**changes), folder=path.parent, moved=moved)
    with whole_file(path, error=_scene_error) as partial:
        partial.write_text(text, encoding="utf-8")


def law_files(scene: SceneData) -> list[Path]:
    """The files of the laws of a scene, those that it names and those of its bodies, each once."""
    own = (law.file for law in scene.own_laws() if law.file is not None)
    return list(dict.fromkeys([*scene.laws, *own]))


def laws_beside(scene: SceneData, folder: Path) -> dict[Path, Path]:
    """Copies files of laws from elsewhere into a folder: a scene's laws are in its folder or below.

    Raises:
        SceneError: one cannot be read or written, or another file has its name there.
    """
    moved: dict[Path, Path] = {}
    for file in law_files(scene):
        if file.resolve().is_relative_to(folder.resolve()):
            continue
        copied = folder / file.name
        try:
            content = file.read_bytes()
            if copied.exists() and copied.read_bytes() != content:
                text = (
                    f"{copied}: found another file in the place of the law {file}; move one of them"
                )
                raise SceneError([text])
        except OSError as error:
            raise SceneError([f"{file}: cannot be copied to {folder} ({error.strerror})"]) from None
        with whole_file(copied, error=_scene_error) as partial:
            partial.write_bytes(content)
        moved[file] = copied
    return moved


def _scene_error(text: str) -> SceneError:
    return SceneError([text])


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
    add_words(Dumper)
    Dumper.add_representer(list, sequence)
    return Dumper
