"""The numbers of a scene that may change while it runs, as its parts name them."""

from __future__ import annotations

import difflib
from collections.abc import Iterator, Mapping, MutableMapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, get_args

from tissu.errors import ParameterError
from tissu.simulation.known_names import known_names_only
from tissu.units import unit_of

if TYPE_CHECKING:
    from tissu.reading import Number
    from tissu.scene.part import Part
    from tissu.simulation.entry import Entry
    from tissu.simulation.simulation import Simulation

_AXES = "xyz"


@dataclass(frozen=True, slots=True)
class Parameter:
    """A number that may change.

    Attributes:
        name: where it stands in the scene: "bodies.liver.law.young", "gravity.z".
        value: now [SI].
        unit: in which it is written; empty: a pure number.
        least: the smallest value that is accepted, or the bound that it must stay above.
        most: the largest, or the bound that it must stay below.
    """

    name: str
    value: float
    unit: str
    least: float = -float("inf")
    most: float = float("inf")


@known_names_only
class Parameters(MutableMapping[str, float]):
    """Names of numbers -> their values [SI]; an assigned value holds from the next step on.

    Texts with a unit are accepted. A name is the path of a field in the scene:
    `bodies.BODY.law.young`, `bodies.BODY.viscosity.eta`, `gravity.z`; of a load its own name, or
    its number: `loads.pull.force.x`, `loads.0.factor`. Numbers that the scene does not have, or
    that may not change, are not listed.
    """

    def __init__(self, simulation: Simulation, entry: Entry) -> None:
        """Take the simulation whose scene it is."""
        self._simulation, self._entry = simulation, entry

    def __repr__(self) -> str:
        """Every parameter with its value and unit."""
        found = (f"{p.name}: {p.value:g} {p.unit}".rstrip() for p in self.all())
        return f"Parameters({', '.join(found)})"

    def __getitem__(self, name: str) -> float:
        return self.about(name).value

    def __setitem__(self, name: str, value: Number) -> None:
        with self._entry.entered("parameters"):
            self.about(name)
            path = name.split(".")
            if path[0] == "loads":
                self._set_load(path[1:], value)
                return
            scene = self._simulation.scene
            self._simulation._become(_replaced(scene, _path(scene, name), value))
            self._simulation._core.forget_stable_step()

    def __delitem__(self, name: str) -> None:
        raise ParameterError(f"found the removal of {name}; another value is accepted")

    def __iter__(self) -> Iterator[str]:
        return iter([parameter.name for parameter in self.all()])

    def __len__(self) -> int:
        return len(self.all())

    def about(self, name: str) -> Parameter:
        """A parameter with its value, unit and bounds.

        Raises:
            ParameterError: nothing of that name may change.
        """
        found = {parameter.name: parameter for parameter in self.all()}
        if name not in found:
            near = difflib.get_close_matches(str(name), found, n=1, cutoff=0.5)
            meant = f"; did you mean '{near[0]}'?" if near else ";"
            raise ParameterError(
                f"found the parameter {name!r}{meant} accepted: " + (", ".join(found) or "none")
            )
        return found[name]

    def all(self) -> list[Parameter]:
        """Every parameter, in the order of the scene."""
        with self._entry.entered("parameters"):
            return [
                *(p for p, _ in _of_part(self._simulation.scene, (), ())),
                *self._of_loads(),
            ]

    def _of_loads(self) -> Iterator[Parameter]:
        for number, load in enumerate(self._simulation.scene.loads):
            live = self._simulation.load(number)
            name = f"loads.{load.name if load.name is not None else number}"
            metadata = _readers(type(load).model_fields[load.quantity])
            yield from _numbers(f"{name}.{load.quantity}", getattr(live, load.quantity), metadata)
            yield Parameter(f"{name}.factor", live.factor, "")

    def _set_load(self, path: list[str], value: Number) -> None:
        names = [load.name for load in self._simulation.scene.loads]
        live = self._simulation.load(path[0] if path[0] in names else int(path[0]))
        if len(path) == 2:
            setattr(live, path[1], value)
            return
        vector: list[Any] = list(getattr(live, path[1]))
        vector[_AXES.index(path[2])] = value
        setattr(live, path[1], vector)


Path = tuple[str | int, ...]


def _path(scene: Part, name: str) -> Path:
    return next(path for parameter, path in _of_part(scene, (), ()) if parameter.name == name)


def _of_part(value: object, names: tuple[str, ...], path: Path) -> Iterator[tuple[Parameter, Path]]:
    """The parameters of a part and of all parts within it, each with its path."""
    fields = getattr(type(value), "model_fields", None)
    if fields is not None:
        for name in value.live_fields():  # type: ignore[attr-defined]
            number = getattr(value, name)
            if number is None:
                continue
            words = ".".join((*names, name))
            for parameter in _numbers(words, number, _readers(fields[name])):
                axis = parameter.name.removeprefix(words).removeprefix(".")
                more: Path = (name, _AXES.index(axis)) if axis else (name,)
                yield parameter, (*path, *more)
        items: list[tuple[str | int, object]] = [(n, getattr(value, n)) for n in fields]
    elif isinstance(value, Mapping):
        items = list(value.items())
    elif isinstance(value, tuple):
        items = list(enumerate(value))
    else:
        return
    for key, item in items:
        if key != "loads" or path:
            yield from _of_part(item, (*names, str(key)), (*path, key))


def _readers(field: Any) -> list[Any]:
    """What reads and bounds a field, of one that may be absent too."""
    inner = (getattr(part, "__metadata__", ()) for part in get_args(field.annotation))
    return [*field.metadata, *(item for items in inner for item in items)]


def _numbers(name: str, value: Any, metadata: Any) -> Iterator[Parameter]:
    """A number, or the components of a vector."""
    if hasattr(value, "__len__"):
        unit = _unit_of_vector(metadata)
        yield from (
            Parameter(f"{name}.{axis}", float(one), unit)
            for axis, one in zip(_AXES, value, strict=True)
        )
        return
    least, most = -float("inf"), float("inf")
    for item in metadata:
        within = getattr(item, "func", item)
        for word in ("gt", "ge", "low"):
            least = max(least, float(getattr(within, word, least)))
        for word in ("lt", "le", "high"):
            most = min(most, float(getattr(within, word, most)))
    yield Parameter(name, float(value), unit_of(metadata), least, most)


def _unit_of_vector(metadata: Any) -> str:
    """SI unit of the components, as it is written; empty: pure numbers."""
    readers = [getattr(item, "func", item) for item in metadata]
    units = [reader.dimension.unit for reader in readers if hasattr(reader, "dimension")]
    return str(units[0]).replace("*", " ") if units else ""


def _replaced(value: Any, path: Path, number: object) -> Any:
    """The same with another number at a path."""
    if not path:
        return number
    key, rest = path[0], path[1:]
    if isinstance(value, Mapping):
        return {**value, key: _replaced(value[key], rest, number)}
    if isinstance(value, tuple):
        assert isinstance(key, int)
        return (*value[:key], _replaced(value[key], rest, number), *value[key + 1 :])
    return value.replace(**{str(key): _replaced(getattr(value, str(key)), rest, number)})
