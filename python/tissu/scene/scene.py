"""The fields of a scene: everything a simulation is made from, and nothing that changes."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import AfterValidator, BeforeValidator, Field, PrivateAttr, ValidationInfo
from typing_extensions import Self

from tissu import units
from tissu.errors import ParameterError
from tissu.field_names import FIELD_NAMES, WRITTEN_BESIDE
from tissu.reading import Maybe, MaybeVector, Read, written
from tissu.scene.body import Body, PathLike
from tissu.scene.bounds import name_problem, step_problems
from tissu.scene.contact import Contacts, ContactSettings
from tissu.scene.contact_rules import contact_problems, has_free
from tissu.scene.editing import EditingField
from tissu.scene.field import field
from tissu.scene.instrument import AllInstruments
from tissu.scene.instrument_rules import instrument_problems
from tissu.scene.load import Load, OneLoad
from tissu.scene.obstacle import Obstacles
from tissu.scene.part import Part, problems_in
from tissu.scene.problem import Problem, Source, nearest, one_of_words
from tissu.scene.step import OneStep
from tissu.scene.support import Fixed, Prescribed
from tissu.scene.tear import Tear
from tissu.scene.tissue import Tissue, tissues_of
from tissu.scene.trocar.trocar import Trocars, trocar_problems
from tissu.scene.unknown import Unknown, below, rule

if TYPE_CHECKING:
    from tissu.user_law.made import MadeLaw

__all__ = ["Output"]


def _from_base(file: Path, info: ValidationInfo) -> Path:
    base = info.context.get("base") if isinstance(info.context, dict) else None
    return Path(base) / file if base is not None else file


LawFile = Annotated[Path, AfterValidator(_from_base)]


class Output(Part):
    """Results that are written while the scene runs."""

    every: units.Time = field(gt=0.0)
    """simulated time between two written results [s]"""
    fields: Read[tuple[str, ...] | None, Sequence[str] | None] = field(default=None)
    """fields of `Simulation.field` at cells, such as cauchy_stress; `regions`: the cells of each
    region; `reactions`: forces, and moments, of the supports on the nodes; absent: von_mises, and
    energy_density by the name strain_energy_density
    """
    node_fields: Read[tuple[str, ...], Sequence[str]] = field(default=())
    """fields of `Simulation.field` at nodes"""

    @rule("fields")
    def _fields_are_known(self) -> Iterator[Problem]:
        yield from _unknown_fields("fields", self.fields or (), (*FIELD_NAMES, *WRITTEN_BESIDE))

    @rule("node_fields")
    def _node_fields_are_known(self) -> Iterator[Problem]:
        yield from _unknown_fields("node_fields", self.node_fields, FIELD_NAMES)


def _unknown_fields(place: str, given: Sequence[str], known: Sequence[str]) -> Iterator[Problem]:
    for number, name in enumerate(given):
        if name not in known:
            text = f"no field is named '{name}'{nearest(name, known)} Fields: {one_of_words(known)}"
            yield Problem((place, number), text)


def _by_name(bodies: object) -> object:
    """Bodies by text: YAML reads the name 7 as a number."""
    if not isinstance(bodies, Mapping):
        return bodies
    return {str(n) if isinstance(n, int) else n: body for n, body in bodies.items()}


_Bodies = Read[dict[str, Body], Mapping[str, Body]]
_Tissue = Read[dict[str, Tissue], Mapping[str, Tissue]]


class SceneData(Part):
    """Bodies, supports, loads, contacts and a method in time; frozen and validated.

    An effect that is absent (no viscosity, no gravity, no loads) is absent from the simulation too.
    """

    name: str = "scene"
    """name of the scene, used for the files that are written"""
    bodies: Annotated[_Bodies, BeforeValidator(_by_name)] = field(default_factory=dict)
    """bodies by name"""
    tissue: Annotated[_Tissue, BeforeValidator(_by_name)] = field(default_factory=dict)
    """connective tissue by name: made of frames, inside a surface or between two bodies"""
    gravity: MaybeVector[units.Acceleration] = field(default=None)
    """acceleration of gravity [m/s^2]; absent: none"""
    fixed: Read[tuple[Fixed, ...], Sequence[Fixed]] = field(default=())
    """nodes held in place"""
    prescribed: Read[tuple[Prescribed, ...], Sequence[Prescribed]] = field(default=())
    """nodes moved along a given path"""
    loads: Read[tuple[OneLoad, ...], Sequence[Load]] = field(default=())
    """forces, tractions and pressures"""
    obstacles: Annotated[Obstacles, BeforeValidator(_by_name)] = field(default_factory=dict)
    """rigid objects by name, which bodies touch if a contact lists them"""
    contacts: Contacts = field(default=())
    """pairs of bodies and obstacles that may touch; absent: bodies pass through each other"""
    contact: ContactSettings | None = None
    """settings that all contacts share"""
    trocars: Annotated[Trocars, BeforeValidator(_by_name)] = field(default_factory=dict)
    """driven ports by name, through which a hand feels the tissue"""
    step: OneStep
    """how time is stepped, such as {type: implicit_euler, dt: 10 ms}"""
    duration: Maybe[units.Time] = field(default=None, gt=0.0)
    """simulated time of a run [s]"""
    threads: Annotated[int, Field(ge=1, le=1024)] = 1
    """number of threads"""
    editing: EditingField = field(default=None)
    """whether cells may be removed, and bodies cut, while the scene runs"""
    instruments: Annotated[AllInstruments, BeforeValidator(_by_name)] = field(default_factory=dict)
    """knives and ablators by name, which work at the end of each step; need `editing`"""
    tear: Read[tuple[Tear, ...], Sequence[Tear]] = field(default=())
    """which bodies tear, and at what stress; needs `editing`"""
    grabbing: bool = False
    """whether points may be grabbed while the scene runs"""
    output: Output | None = None
    """results that are written while the scene runs"""
    laws: Read[tuple[LawFile, ...], Sequence[PathLike]] = field(default=())
    """Python files with user-defined laws, in the scene's folder or below; they are programs and
    run only with `--trust-laws`, or `trust_laws=True`
    """
    _source: Source | None = PrivateAttr(default=None)

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
        if not self.bodies and not self.tissue and not has_free(self):
            text = "found no body, no tissue and no obstacle with a mass; at least one is accepted"
            yield Problem(("bodies",), text)
        for name, tissue in self.tissue.items():
            if name in self.bodies:
                yield Problem(("tissue", name), f"found '{name}' as a body too; names are unique")
            with contextlib.suppress(Unknown):
                for end, body in enumerate(tissue.between or ()):
                    if body not in self.bodies:
                        text = f"no body is named '{body}'{nearest(body, self.bodies)} "
                        text += f"Bodies: {one_of_words(self.bodies)}"
                        yield Problem(("tissue", name, "between", end), text)

    @rule("obstacles")
    def _names_obstacles_once(self) -> Iterator[Problem]:
        """A name finds one body, tissue or obstacle."""
        bodies, tissue = getattr(self, "bodies", {}), tissues_of(self)
        for name in self.obstacles:
            if name in bodies or name in tissue:
                kind = "body" if name in bodies else "tissue"
                yield Problem(
                    ("obstacles", name), f"found '{name}' as a {kind} too; names are unique"
                )

    @rule()
    def _contacts_can_be(self) -> Iterator[Problem]:
        """Contacts of what there is, with a method that the step has."""
        yield from contact_problems(self)

    @rule()
    def _instruments_can_be(self) -> Iterator[Problem]:
        """Instruments and tears of bodies that there are, in a scene that may be edited."""
        yield from instrument_problems(self)

    @rule()
    def _trocars_can_be(self) -> Iterator[Problem]:
        """Trocars with tools that there are, each with its own port and device."""
        yield from trocar_problems(self)

    @rule("loads")
    def _names_loads_once(self) -> Iterator[Problem]:
        """A name finds one load."""
        names: list[str] = []
        for number, load in enumerate(self.loads):
            with contextlib.suppress(Unknown):
                if load.name is not None and load.name in names:
                    text = f"found '{load.name}' twice; each name once is accepted"
                    yield Problem(("loads", number, "name"), text)
                names += [load.name] if load.name is not None else []

    @rule("fixed", "prescribed")
    def _names_supports_once(self) -> Iterator[Problem]:
        """A name finds one support or motion."""
        names: list[str] = []
        for group in ("fixed", "prescribed"):
            for number, support in enumerate(getattr(self, group)):
                with contextlib.suppress(Unknown):
                    if support.name is None:
                        continue
                    if support.name in names:
                        text = f"found '{support.name}' twice among fixed and prescribed; each name"
                        yield Problem((group, number, "name"), f"{text} once is accepted")
                    if not support.name:
                        text = "found an empty name; one of at least one letter is accepted"
                        yield Problem((group, number, "name"), text)
                    names.append(support.name)

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
        for group in ("bodies", "tissue", "obstacles", "instruments", "trocars"):
            named += [((group,), name) for name in getattr(self, group, {})]
        for path, name in named:
            text = name_problem(name)
            if text:
                yield Problem(path, text)

    def _refusal(self) -> list[str]:
        """Everything that is wrong with it, as far as its fields say."""
        return [str(problem) for problem in problems_in(self)]

    def __eq__(self, other: object) -> bool:
        """Whether all fields are equal; where the scenes and laws were written does not count."""
        if not isinstance(other, SceneData):
            return NotImplemented
        apart = {"laws": ()}
        return self.__dict__ | apart == other.__dict__ | apart

    __hash__ = None  # type: ignore[assignment]

    @property
    def source(self) -> Source | None:
        """The file and lines the scene was read from; None for a scene made in Python."""
        return self._source

    def live_fields(self) -> list[str]:
        """Gravity, where the scene has it."""
        return ["gravity"]

    def replace(self, **changes: Any) -> Self:
        """The same scene with some fields changed, validated again."""
        other = super().replace(**changes)
        other._source = self._source
        return other

    def own_laws(self) -> list[MadeLaw]:
        """The user-defined laws of the bodies, each once, in their order."""
        laws = [type(law).made for body in self.bodies.values() for law in body.laws().values()]
        return list(dict.fromkeys(made for made in laws if made is not None))


def require_scene(value: object, verb: str) -> None:
    """Refuse what is not a scene, for instance the path of its file.

    Raises:
        ParameterError: it is not one.
    """
    if not isinstance(value, SceneData):
        text = f"{verb}: found {written(value)}; a Scene is accepted, such as "
        raise ParameterError(f"{text}Scene.from_yaml('scene.yaml')")
