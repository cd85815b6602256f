"""What a trocar did, tick by tick: saved, read, and replayed with the same bits.

A recording holds what came into each tick (what the device gave, the settings, the models) and what
came out of it. A tick is a function of that alone, so that a replay gives the same torques to the
last bit, whether the recording was made stepped or in real time.
"""

from __future__ import annotations

import os
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from tissu import _haptic
from tissu.errors import ParameterError
from tissu.files import whole_file
from tissu.files.place import path_of
from tissu.trocar.kinematics import Array
from tissu.trocar.model import Blade, LocalModel
from tissu.trocar.recording_whole import (
    require_columns,
    require_named,
    require_numbers,
    require_settings,
)
from tissu.trocar.settings import fields_of, settings_from

_VERSION = 1
_BLADE = tuple(field.name for field in fields(Blade))
_MODEL = tuple(f.name for f in fields(LocalModel) if f.name not in ("tag", "blade"))
_NOT_ONE = (
    *(OSError, ValueError, KeyError, TypeError, IndexError, EOFError, NotImplementedError),
    *(RuntimeError, zipfile.BadZipFile, zlib.error),
)
"""What reading a file raises that is none, or was damaged."""
_COMPARED = (
    *("command", "enable", "q", "torque", "force", "state", "reason"),
    *("stored", "share", "tank", "given_out"),
)
"""Columns that a replay has to give again."""


@dataclass(frozen=True, slots=True)
class Published:
    """A model that was handed to the ticks.

    Attributes:
        model: as it was given.
        tag: of its tool.
        stamp: its number.
        time_ns: when it was published, by the clock of the ticks [ns].
    """

    model: LocalModel
    tag: int
    stamp: int
    time_ns: int


@dataclass(frozen=True, slots=True)
class Recording:
    """What a trocar did.

    Attributes:
        columns: an array for each field of a tick.
        settings: each change of settings, the first at the start.
        models: that were published.
    """

    columns: dict[str, Array]
    settings: list[dict[str, Any]]
    models: list[Published]

    @property
    def ticks(self) -> int:
        """How many."""
        return len(self.columns["number"])

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write it.

        Raises:
            ParameterError: the file cannot be written.
        """
        arrays: dict[str, Any] = {"version": np.array(_VERSION)}
        arrays |= {f"tick/{name}": column for name, column in self.columns.items()}
        for k, one in enumerate(self.settings):
            arrays |= {f"settings/{k}/{name}": np.array(value) for name, value in one.items()}
        for published in self.models:
            arrays |= _arrays_of(published)
        place = path_of(path, "the path of a recording", error=ParameterError)
        with whole_file(place, error=ParameterError) as partial, partial.open("wb") as file:
            np.savez_compressed(file, **arrays)

    @staticmethod
    def read(path: str | os.PathLike[str]) -> Recording:
        """Read one.

        Raises:
            ParameterError: the file cannot be read, or is not a recording of this version.
        """
        try:
            with zipfile.ZipFile(path) as file:
                if file.testzip() is not None:  # before NumPy reads a header that is not one
                    raise zipfile.BadZipFile
            with np.load(path, allow_pickle=False) as file:
                arrays = {name: file[name] for name in file.files}
            version = int(arrays.pop("version"))
            if version != _VERSION:
                text = f"the recording has version {version}; {_VERSION} is accepted"
                raise ParameterError(f"{text}: record again")
            return _recording_of(arrays)
        except ParameterError as error:
            raise ParameterError(f"{path}: {error}") from None
        except _NOT_ONE as error:
            text = f"{path} is not a recording of a trocar ({type(error).__name__}); "
            raise ParameterError(f"{text}a file of `tissu trocar record` is accepted") from None

    def replay(self) -> dict[str, Array]:
        """The columns that the same ticks give now, one by one.

        Raises:
            ParameterError: settings or models are not accepted by this version.
        """
        device = _haptic.replayed(self.columns)
        run = _haptic.Run(device, settings_from(self.settings[0]), room=max(1, self.ticks))
        models = {published.stamp: published for published in self.models}
        change, offered, number = 0, 0, -1
        for k in range(self.ticks):
            if self.columns["settings"][k] != change:
                change = int(self.columns["settings"][k])
                run.set_numbered(settings_from(self.settings[change]), change)
            if self.columns["offered"][k] != offered:
                offered = int(self.columns["offered"][k])
                run.offer(_in_core(models[offered]))
            at = int(self.columns["number"][k])
            run.step(1, late=at - number - 1)
            number = at
        return run.records()

    def difference(self, replayed: Mapping[str, Array]) -> str:
        """Where a replay is not the recording, to the bit: one sentence; empty: nowhere."""
        for k in range(self.ticks):
            for name in _COMPARED:
                ours, theirs = self.columns[name][k], replayed[name][k]
                if np.asarray(ours).tobytes() != np.asarray(theirs).tobytes():
                    text = f"tick {int(self.columns['number'][k])} has another {name}: "
                    return f"{text}recorded {ours}, replayed {theirs}"
        return ""


def _arrays_of(published: Published) -> dict[str, Any]:
    model, at = published.model, f"model/{published.stamp}"
    arrays = {f"{at}/{name}": np.asarray(getattr(model, name)) for name in _MODEL}
    arrays[f"{at}/told"] = np.array([published.tag, published.time_ns], dtype=np.uint64)
    if model.blade is not None:
        arrays |= {f"{at}/blade/{name}": np.asarray(getattr(model.blade, name)) for name in _BLADE}
    return arrays


def _recording_of(arrays: Mapping[str, Array]) -> Recording:
    grouped: dict[str, dict[str, dict[str, Array]]] = {"settings": {}, "model": {}}
    columns: dict[str, Array] = {}
    for name, array in arrays.items():
        group, *rest = name.split("/", 2)
        if group == "tick":
            columns[rest[0]] = array
        else:
            grouped[group].setdefault(rest[0], {})[rest[1]] = array
    changes = {int(number): one for number, one in grouped["settings"].items()}
    require_columns(columns)
    require_settings(changes)
    settings = [
        {name: value.item() if value.ndim == 0 else value for name, value in changes[k].items()}
        for k in range(len(changes))
    ]
    models = [_published(int(stamp), one) for stamp, one in grouped["model"].items()]
    require_named(columns, len(settings), [published.stamp for published in models])
    return Recording(columns, settings, models)


def _published(stamp: int, arrays: Mapping[str, Array]) -> Published:
    require_numbers(arrays)
    blade = None
    if "blade/way" in arrays:
        parts: dict[str, Any] = {name: arrays[f"blade/{name}"] for name in _BLADE}
        blade = Blade(**parts)
    given: dict[str, Any] = {name: arrays[name] for name in _MODEL}
    model = LocalModel(**given, blade=blade)
    tag, time_ns = (int(number) for number in arrays["told"])
    return Published(model, tag, stamp, time_ns)


def _in_core(published: Published) -> _haptic.LocalModel:
    from tissu.trocar.ticking import in_core

    made = in_core(published.model, published.tag)
    made.stamp, made.time_ns = published.stamp, published.time_ns
    return made


class Recorder:
    """Gathers what a run does, from its start."""

    def __init__(self, run: _haptic.Run, settings: _haptic.Settings) -> None:
        """Begin with the settings that the run has."""
        self._run = run
        self._settings, self._models = [fields_of(settings)], list[Published]()
        self._parts: list[dict[str, Array]] = []

    def changed(self, settings: _haptic.Settings) -> None:
        """New settings."""
        self._settings.append(fields_of(settings))

    def published(self, model: LocalModel, made: _haptic.LocalModel) -> None:
        """A model that was handed over."""
        self._models.append(Published(model, made.tag, made.stamp, made.time_ns))

    def gather(self) -> None:
        """Take the ticks since the last call, before their room is used again."""
        part = self._run.records()
        if len(part["number"]):
            self._parts.append(part)

    def recording(self) -> Recording:
        """Everything so far.

        Raises:
            ParameterError: ticks were lost, since nothing gathered them for seconds.
        """
        self.gather()
        if self._run.lost_records():
            lost = self._run.lost_records()
            text = f"{lost} ticks were not recorded, since nothing took them in time; ask for a "
            raise ParameterError(f"{text}report more often while it records")
        names = self._parts[0] if self._parts else {}
        columns = {name: np.concatenate([part[name] for part in self._parts]) for name in names}
        return Recording(columns, self._settings, self._models)
