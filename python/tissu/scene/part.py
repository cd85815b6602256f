"""Base of every part of a scene: frozen, no unknown keys, and errors in plain sentences."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar, get_args, get_origin

from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    PlainValidator,
    PrivateAttr,
    ValidationError,
    ValidationInfo,
    field_validator,
    model_validator,
)
from typing_extensions import Self, dataclass_transform

from tissu.errors import ParameterError, SceneError
from tissu.reading import written
from tissu.scene.bounds import boolean_problem, count_problem
from tissu.scene.explain import explained, failure, meaning
from tissu.scene.field import field
from tissu.scene.problem import Problem, nearest, nearest_word, one_of_words
from tissu.scene.unknown import Unknown, Unread, below, nested, rules_of, told

KEEP_PROBLEMS = "keep_problems"
"""Key of the validation context: a part with problems is kept for what is known of it."""


@dataclass_transform(kw_only_default=True, field_specifiers=(field, Field, PrivateAttr))
class Part(BaseModel):
    """A frozen, validated part of a scene.

    Attributes:
        of_scene: whether it has a meaning in scenes only, so that a refusal speaks of the scene.
    """

    of_scene: ClassVar[bool] = True
    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        arbitrary_types_allowed=True,
        protected_namespaces=(),
        defer_build=True,
    )
    _problems: tuple[Problem, ...] = PrivateAttr(default=())

    def __init__(self, /, *values: Any, **fields: Any) -> None:
        """Make the part from its fields.

        Raises:
            SceneError: one or more fields are not accepted; all of them are listed.
        """
        names = [n for n, info in type(self).model_fields.items() if info.kw_only is False]
        if len(values) > len(names):
            raise TypeError(self._too_many(names, values))
        for name, value in zip(names, values, strict=False):
            if name in fields:
                raise TypeError(f"{type(self).__name__} got {name} twice")
            fields[name] = value
        self.__pydantic_validator__.validate_python(
            fields, self_instance=self, context={KEEP_PROBLEMS: True}
        )
        if next(problems_in(self), None) is not None:
            found = [f"{type(self).__name__}: {text}" for text in self._refusal()]
            raise SceneError(found, where=" in the scene" if self.of_scene else "")

    # Pydantic then need not make a nested part through this __init__, so that the
    # problems of all parts are gathered.
    __init__.__pydantic_base_init__ = True  # type: ignore[attr-defined]

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            if name in type(self).model_fields:
                raise Unknown(name)
            return super().__getattr__(name)

    @classmethod
    def _too_many(cls, names: list[str], values: tuple[Any, ...]) -> str:
        """The refusal of more values without a name than there are fields that need none."""
        found = f"{len(values)} value{'s' * (len(values) > 1)}"
        text = f"{cls.__name__}: found {found} without a name"
        if not names:
            return f"{text}; all fields are given by their names"
        text = f"{text}; {', '.join(names)} may be given so, and all other fields by their names"
        if len(names) > 1:
            return text
        try:
            cls(values)  # the parts of one value
        except (SceneError, TypeError):
            return text
        return f"{text}; did you mean {cls.__name__}({values!r})?"

    def _refusal(self) -> list[str]:
        """Everything that is wrong with the part, one sentence each."""
        return [problem.sentence() for problem in problems_in(self)]

    @field_validator("*", mode="wrap")
    @classmethod
    def _read_field(cls, value: Any, handler: Callable[[Any], Any], info: ValidationInfo) -> Any:
        if isinstance(value, Unread):
            return value
        if isinstance(value, Part) and _is_list(cls, info.field_name):
            name = type(value).__name__  # whose fields would be read as entries
            return Unread((Problem((), f"found one {name}; a list is accepted: [{name}(...)]"),))
        try:
            read = handler(value)
        except ValidationError as error:
            return Unread(tuple(explained(error, value)))
        except OverflowError:
            return Unread((Problem((), f"found {written(value)}, which is too large"),))
        wrong = boolean_problem(value, read) or count_problem(read)
        return Unread((Problem((), wrong),)) if wrong else read

    @model_validator(mode="wrap")
    @classmethod
    def _read(cls, value: Any, handler: Callable[[Any], Self], info: ValidationInfo) -> Self:
        """Read all fields, then follow the rules between those that are known."""
        if isinstance(value, cls):
            return value
        fields, problems = _sorted_out(cls, value)
        part = handler(fields)
        part._settle(problems)
        found = list(problems_in(part))
        if found and not keeps_problems(info):
            raise failure(found, cls.__name__)
        return part

    def _settle(self, problems: list[Problem]) -> None:
        """Take unread fields out, and those that break a rule; keep what is wrong with them."""
        unread = [name for name, value in self.__dict__.items() if isinstance(value, Unread)]
        for name in unread:
            problems += self._forget(name)
        broken = [(told(check(self)), fields) for check, fields in rules_of(type(self)).values()]
        for found, fields in broken:
            problems += found
            for name in fields if found else ():
                problems += self._forget(name)
        self._problems = tuple(problems)

    def _forget(self, name: str) -> list[Problem]:
        return list(below(name, problems_in(self.__dict__.pop(name, None))))

    def live_fields(self) -> list[str]:
        """Fields with a number, or three, that may change while a simulation runs."""
        return []

    def replace(self, **changes: Any) -> Self:
        """The same part with some fields changed, validated again."""
        fields = {name: getattr(self, name) for name in self.model_fields_set}
        return type(self)(**{**fields, **changes})


def keeps_problems(info: ValidationInfo) -> bool:
    """Whether a part with problems is kept, with its problems, instead of refused."""
    return isinstance(info.context, dict) and bool(info.context.get(KEEP_PROBLEMS))


def problems_in(value: object) -> Iterator[Problem]:
    """The problems of a part and of all parts within it."""
    if isinstance(value, Unread):
        yield from value.problems
        return
    if isinstance(value, Part):
        yield from value._problems
        value = value.__dict__
    for place, item in nested(value):
        if isinstance(item, (Part, Unread, Mapping, list, tuple)):
            yield from below(place, problems_in(item))


def _sorted_out(cls: type[Part], value: object) -> tuple[dict[str, Any], list[Problem]]:
    """A value for each field that is written or needed, and what is wrong with the keys.

    A key that no field has stands for the field nearest to it, where that one is not given: the
    field is misspelt, not missing.
    """
    known = cls.model_fields
    if not isinstance(value, Mapping):
        text = f"found {written(value)}; a mapping is accepted, with the keys "
        return dict.fromkeys(known, Unread()), [Problem((), text + one_of_words(known))]
    fields = {name: item for name, item in value.items() if name in known}
    if True in value and "on" in known and "on" not in fields:  # `on:`, as YAML 1.1 reads it
        fields["on"] = value[True]
        value = {name: item for name, item in value.items() if name is not True}
    problems = []
    for key in (str(key) for key in value if key not in known):
        text = f"unknown key{nearest(key, known)} Accepted: {one_of_words(known)}"
        problems.append(Problem((key,), text))
        meant = nearest_word(key, known)
        if meant is not None:
            fields.setdefault(meant, Unread())
    for name, info in known.items():
        if info.is_required() and name not in fields:
            problems.append(Problem((name,), f"is missing{meaning(cls, name)}"))
            fields[name] = Unread()
    return fields, problems


def _is_list(cls: type[Part], name: str | None) -> bool:
    annotation = None if name is None else cls.model_fields[name].annotation
    return get_origin(annotation) is tuple and get_args(annotation)[-1:] == (...,)


def one_of(*classes: type[Part]) -> PlainValidator:
    """A field that holds one of several parts: in Python by class, in YAML by its `type`."""

    def choose(value: Any, info: ValidationInfo) -> Any:
        try:
            return chosen(value, classes, info)
        except ParameterError as error:
            if keeps_problems(info):
                return Unread((Problem((), str(error)),))
            raise

    return PlainValidator(choose)


def type_name(cls: type[Part]) -> str:
    """The type by which a class is chosen."""
    return str(cls.model_fields["type"].default)


def spelled(word: object) -> str:
    """A type as scenes spell it: mass_spring, which may be written mass-spring."""
    return str(word).replace("-", "_")


def chosen(value: Any, classes: Sequence[type[Part]], info: ValidationInfo) -> Any:
    """The part that `value` is, or that its `type` names.

    Raises:
        ParameterError: not a part of these classes, or an unknown `type`.
    """
    if isinstance(value, tuple(classes)):
        return value
    known = {type_name(cls): cls for cls in classes}
    accepted = f"accepted types: {one_of_words(known)}"
    if not isinstance(value, Mapping):
        raise ParameterError(
            f"found {written(value)}; a mapping with a `type` is accepted; {accepted}"
        )
    if "type" not in value:
        raise ParameterError(f"`type` is missing; {accepted}")
    word = spelled(value["type"])
    cls = known.get(word)
    if cls is None:
        raise ParameterError(
            f"unknown type {value['type']!r}{nearest(value['type'], known)} {accepted.capitalize()}"
        )
    return cls.model_validate({**value, "type": word}, context=info.context)
