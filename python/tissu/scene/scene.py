"""The scene: everything a simulation is made from, and nothing that changes."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import AfterValidator, BeforeValidator, Field, PrivateAttr, ValidationInfo
from typing_extensions import Self

from tissu import units
from tissu.errors import SceneError
from tissu.scene.body import Body
from tissu.scene.bounds import name_problem, step_problems
from tissu.scene.load import Load, OneLoad
from tissu.scene.part import Part, problems_in
from tissu.scene.problem import Problem, Source, nearest, one_of_words
from tissu.scene.step import OneStep, Step
from tissu.scene.support import Fixed, Prescribed
from tissu.scene.tissue import Tissue, tissues_of
from tissu.scene.unknown import Unknown, below, rule

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tissu.compile import Check
    from tissu.simulation import Simulation
    from tissu.user_law.made import MadeLaw


def _from_base(file: Path, info: ValidationInfo) -> Path:
    base = info.context.get("base") if isinstance(info.context, dict) else None
    return Path(base) / file if base is not None else file


LawFile = Annotated[Path, AfterValidator(_from_base)]


class Output(Part):
    """What is written while the scene runs."""

    every: Annotated[units.Time, Field(gt=0.0)]
    """simulated time between two written results [s]"""

    if TYPE_CHECKING:

        def __init__(self, *, every: units.Number) -> None: ...


def _by_name(bodies: object) -> object:
    """Bodies by text: YAML reads the name 7 as a number."""
    if not isinstance(bodies, Mapping):
        return bodies
    return {str(n) if isinstance(n, int) else n: body for n, body in bodies.items()}


class Scene(Part):
    """Bodies, what holds and moves them, and how time is stepped; frozen and validated.

    An effect that is absent (no viscosity, no gravity, no loads) is absent from the simulation too.
    """

    name: str = "scene"
    """name of the scene, used for the files that are written"""
    bodies: Annotated[dict[str, Body], BeforeValidator(_by_name)] = Field(default_factory=dict)
    """bodies by name"""
    tissue: Annotated[dict[str, Tissue], BeforeValidator(_by_name)] = Field(default_factory=dict)
    """connective tissue by name: made of frames, inside a surface or between two bodies"""
    gravity: units.Acceleration | None = None
    """acceleration of gravity [m/s^2]; absent: none"""
    fixed: tuple[Fixed, ...] = ()
    """nodes held in place"""
    prescribed: tuple[Prescribed, ...] = ()
    """nodes moved along a given path"""
    loads: tuple[OneLoad, ...] = ()
    """forces, tractions and pressures"""
    step: OneStep
    """how time is stepped, such as {type: implicit_euler, dt: 10 ms}"""
    duration: Annotated[units.Time, Field(gt=0.0)] | None = None
    """simulated time of a run [s]"""
    threads: Annotated[int, Field(ge=1, le=1024)] = 1
    """number of threads"""
    editing: bool = False
    """whether cells may be removed while it runs"""
    output: Output | None = None
    """what is written while it runs"""
    laws: tuple[LawFile, ...] = ()
    """Python files with laws of one's own, in the scene's folder or below; they are programs and
    run only with `--trust-laws`, or `trust_laws=True`"""
    _source: Source | None = PrivateAttr(default=None)

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str = ...,
            bodies: Mapping[str, Body] = ...,
            tissue: Mapping[str, Tissue] = ...,
            gravity: units.VectorLike | None = ...,
            fixed: Sequence[Fixed] = ...,
            prescribed: Sequence[Prescribed] = ...,
            loads: Sequence[Load] = ...,
            step: Step,
            duration: units.Number | None = ...,
            threads: int = ...,
            editing: bool = ...,
            output: Output | None = ...,
            laws: Sequence[str | os.PathLike[str]] = ...,
        ) -> None: ...

    @rule()
    def _names_bodies(self) -> Iterator[Problem]:
        """Names that no body has; a body with problems is a body too."""
        bodies = {**self.bodies, **tissues_of(self)}
        for group in ("fixed", "prescribed", "loads"):
            for number, item in enumerate(getattr(self, group, ())):
                with contextlib.suppress(Unknown):
                    if item.body not in bodies:
                        text = f"no body is named '{item.body}'{nearest(item.body, bodies)} "
                        text += f"Bodies: {one_of_words(bodies)}"
                        yield Problem((group, number, "body"), text)

    @rule("bodies", "tissue")
    def _has_bodies(self) -> Iterator[Problem]:
        """Something to simulate, each by one name; tissue lies between bodies that there are."""
        if not self.bodies and not self.tissue:
            yield Problem(("bodies",), "found no body and no tissue; at least one is accepted")
        for name, tissue in self.tissue.items():
            if name in self.bodies:
                yield Problem(("tissue", name), f"found '{name}' as a body too; names are unique")
            with contextlib.suppress(Unknown):
                for end, body in enumerate(tissue.between or ()):
                    if body not in self.bodies:
                        text = f"no body is named '{body}'{nearest(body, self.bodies)} "
                        text += f"Bodies: {one_of_words(self.bodies)}"
                        yield Problem(("tissue", name, "between", end), text)

    @rule("duration")
    def _ends(self) -> Iterator[Problem]:
        """A number of steps that a run can take."""
        dt = getattr(self.step, "dt", None)
        if isinstance(dt, float) and self.duration is not None:
            yield from below("step", step_problems(self.duration, dt))

    @rule()
    def _has_names_to_write(self) -> Iterator[Problem]:
        """Names that can stand in files and messages."""
        named = [(("name",), getattr(self, "name", ""))]
        for group in ("bodies", "tissue"):
            named += [((group,), name) for name in getattr(self, group, {})]
        for path, name in named:
            text = name_problem(name)
            if text:
                yield Problem(path, text)

    def _refusal(self) -> list[str]:
        from tissu.compile import problems_of

        return problems_of(self)

    def __eq__(self, other: object) -> bool:
        """Whether all fields are equal; where the scenes and laws were written does not count."""
        if not isinstance(other, Scene):
            return NotImplemented
        apart = {"laws": ()}
        return self.__dict__ | apart == other.__dict__ | apart

    __hash__ = None  # type: ignore[assignment]

    @property
    def source(self) -> Source | None:
        """The file and lines the scene was read from; None for a scene made in Python."""
        return self._source

    def replace(self, **changes: Any) -> Self:
        """The same scene with some fields changed, validated again."""
        other = super().replace(**changes)
        other._source = self._source
        return other

    @classmethod
    def from_yaml(cls, path: str | os.PathLike[str], *, trust_laws: bool = False) -> Scene:
        """Read a scene; paths of meshes are relative to the file.

        Args:
            path: the file.
            trust_laws: run the files of `laws`, which are programs: only of scenes that you trust.

        Raises:
            SceneError: the file cannot be read or has wrong fields; with them everything that
                compile() would refuse, each problem with its line.
        """
        from tissu.yaml_io import read_scene

        return accepted(read_scene(Path(path), trust_laws=trust_laws))

    @classmethod
    def from_yaml_text(
        cls, text: str, *, base: str | os.PathLike[str] | None = None, trust_laws: bool = False
    ) -> Scene:
        """Read a scene from a text; paths of meshes are relative to the folder `base`.

        Args:
            text: the scene in YAML.
            base: the folder; absent: the present one.
            trust_laws: run the files of `laws` in that folder, which are programs.

        Raises:
            SceneError: the text has wrong fields; with them everything that compile() would
                refuse, each problem with its line.
        """
        from tissu.yaml_io import parse_scene

        folder = None if base is None else Path(base)
        return accepted(parse_scene(text, base=folder, trust_laws=trust_laws))

    def to_yaml(self) -> str:
        """The scene as YAML text that reads back as an equal scene.

        Raises:
            SceneError: a mesh was made in memory; `save` writes it to a file.
        """
        from tissu.yaml_io import scene_text

        return scene_text(self)

    def own_laws(self) -> list[MadeLaw]:
        """The laws of one's own that the bodies are made of, each once, in their order."""
        laws = [type(law).made for body in self.bodies.values() for law in body.laws().values()]
        return list(dict.fromkeys(made for made in laws if made is not None))

    def to_dict(self) -> dict[str, Any]:
        """What to_yaml() writes, as mappings, lists and numbers in SI.

        Raises:
            SceneError: a mesh was made in memory; `save` writes it to a file.
        """
        from tissu.yaml_io import scene_data

        return scene_data(self)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the scene to a YAML file, and beside it meshes made in memory as .vtu files.

        Files of laws that lie elsewhere than below the file's folder are copied there: a scene
        reads none from outside.

        Raises:
            SceneError: a file cannot be written.
        """
        from tissu.yaml_io import write_scene

        write_scene(self, Path(path))

    def compile(self, *, checkpoint: str | os.PathLike[str] | None = None) -> Simulation:
        """Turn the scene into a simulation.

        Args:
            checkpoint: a file of `Simulation.save_checkpoint`, from which it goes on with the same
                bits; absent: it begins at rest. Name, duration, threads and output of the scene
                may be others than those of the scene that was saved.

        Raises:
            SceneError: problems of the scene or its meshes; all of them.
            CheckpointError: the file is absent, damaged, or of another scene or version.
        """
        from tissu.compile import compile_scene

        return compile_scene(self, None if checkpoint is None else Path(checkpoint))

    def check(self) -> Check:
        """Everything that compile() would refuse, and in plain words what the scene switches on."""
        from tissu.compile import check_scene

        return check_scene(self)


def accepted(scene: Scene) -> Scene:
    """The scene, when its fields have no problem.

    Raises:
        SceneError: they have; with them everything that compile() would refuse.
    """
    if next(problems_in(scene), None) is not None:
        raise SceneError(scene._refusal())
    return scene
