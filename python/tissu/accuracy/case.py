"""A case of a study: a scene file, NAME.yaml, and beside it NAME.study.yaml with its reference."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal

import yaml
from pydantic import BaseModel, ConfigDict, Field, PrivateAttr, ValidationError

from tissu.accuracy.measure import Reference
from tissu.counted import counted
from tissu.errors import ParameterError

Preset = Literal["small", "full"]
_SUFFIX = ".study.yaml"


class _Strict(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", use_attribute_docstrings=True)


class Choices(_Strict):
    """Runs of the scene with fields changed: every combination of the values of `vary`."""

    name: str
    """what the runs have in common; {FIELD} stands for the value of a varied field, {FIELD:NOUN}
    for the number and its noun: "{threads:thread}" is "1 thread", "2 threads"
    """
    change: dict[str, Any] = {}
    """values by the path of a field: `bodies.bar.law.poisson: 0.3`"""
    vary: dict[str, list[Any]] = {}
    """lists of values by the path of a field"""
    along: str | None = None
    """the varied field that makes the points of one curve; absent: the last"""
    small: dict[str, list[Any]] | None = None
    """values that replace those of `vary` in the small preset"""
    full_only: bool = False
    """left out of the small preset"""


class Printed(_Strict):
    """A number of a paper, to stand beside ours."""

    where: str
    """table or figure"""
    what: str
    """which of its entries"""
    error: float | None = None
    """mean deviation [m]"""
    ms: float | None = None
    """time per step [ms]"""
    run: str | None = None
    """label of our run that it stands beside"""


class Case(_Strict):
    """One case.

    Attributes are the fields of NAME.study.yaml.
    """

    title: str
    """one line"""
    about: str = ""
    """what the case is and where its reference comes from"""
    reference: Annotated[Reference, Field(discriminator="type")]
    """what displacements are measured against"""
    paper: Annotated[Reference, Field(discriminator="type")] | None = None
    """what the printed numbers were measured against, where that is something else"""
    choices: list[Choices] = Field(min_length=1)
    """the runs"""
    printed: list[Printed] = []
    """numbers of papers"""
    notes: list[str] = []
    """what to know before comparing"""
    needs: str = ""
    """what the files are that do not come with tissu"""
    goals: list[float] = [0.01, 0.001]
    """errors, as shares of the largest displacement, that the cheapest run is named for"""

    _scene: Path = PrivateAttr()

    @property
    def name(self) -> str:
        """The name of the scene file without its ending."""
        return self._scene.stem

    @property
    def scene(self) -> Path:
        """The scene file."""
        return self._scene

    def variants(self, preset: Preset) -> Iterator[tuple[str, str, dict[str, Any]]]:
        """Label, name of the curve, and changed fields by path, of each run."""
        for choices in self.choices:
            if choices.full_only and preset == "small":
                continue
            vary = dict(choices.vary)
            if preset == "small":
                vary |= choices.small or {}
            along = choices.along or (list(vary)[-1] if vary else "")
            if along and _place(along).search(choices.name):  # a curve of its own for each value
                along = ""
            for values in _products(vary):
                curve = _filled(choices.name, {k: v for k, v in values.items() if k != along})
                point = f" {_word(values[along])}" if along else ""
                yield curve + point, curve, {**choices.change, **values}


def read_case(scene: str | os.PathLike[str]) -> Case:
    """Read the study of a scene file.

    Args:
        scene: NAME.yaml, with NAME.study.yaml beside it.

    Raises:
        ParameterError: a file is missing or not what is expected.
    """
    path = Path(scene)
    file = path.with_name(path.stem + _SUFFIX)
    for wanted in (path, file):
        if not wanted.is_file():
            raise ParameterError(f"{wanted}: no such file; a case is NAME.yaml and NAME{_SUFFIX}")
    try:
        data = yaml.safe_load(file.read_text(encoding="utf-8"))
        case = Case.model_validate(data)
    except yaml.YAMLError as error:
        raise ParameterError(f"{file}: not YAML: {' '.join(str(error).split())}") from None
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(map(str, first["loc"]))
        raise ParameterError(f"{file}: {where}: {first['msg']}") from None
    case._scene = path
    case.reference.at(path.parent)
    if case.paper is not None:
        case.paper.at(path.parent)
    return case


def read_cases(folder: str | os.PathLike[str], names: list[str] | None = None) -> list[Case]:
    """The cases of a folder, all or those named.

    Raises:
        ParameterError: no case there, or no such case.
    """
    found = sorted(Path(folder).glob("*" + _SUFFIX))
    known = [file.name.removesuffix(_SUFFIX) for file in found]
    if not known:
        raise ParameterError(f"{folder}: no case there; a case is NAME.yaml and NAME{_SUFFIX}")
    for name in names or []:
        if name not in known:
            raise ParameterError(f"no case '{name}' in {folder}; cases: {', '.join(known)}")
    return [read_case(Path(folder) / f"{name}.yaml") for name in names or known]


def _products(vary: dict[str, list[Any]]) -> Iterator[dict[str, Any]]:
    if not vary:
        yield {}
        return
    (field, values), *rest = vary.items()
    for value in values:
        for others in _products(dict(rest)):
            yield {field: value, **others}


def _filled(text: str, values: dict[str, Any]) -> str:
    """The text with {last part of a field's path} replaced by its value, counted with a noun."""
    for path, value in values.items():
        word = _word(value)

        def filled(place: re.Match[str], value: Any = value, word: str = word) -> str:
            return word if place[1] is None else counted(value, place[1])

        text = _place(path).sub(filled, text)
    return text


def _place(path: str) -> re.Pattern[str]:
    """Where a text has the value of a field, and the noun that it is counted with."""
    return re.compile(r"\{" + re.escape(path.rsplit(".", 1)[-1]) + r"(?::([^{}]+))?\}")


def _word(value: Any) -> str:
    """A value as part of a label."""
    if isinstance(value, dict):
        more = [_word(v) for k, v in value.items() if k != "type"]
        return " ".join([str(value.get("type", "")), *more]).strip()
    if isinstance(value, list):
        return "x".join(_word(v) for v in value)
    return f"{value:g}" if isinstance(value, float) else str(value)
