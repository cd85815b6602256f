"""A checkpoint: what a simulation needs to go on, what wrote it, and for which scene."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from tissu import _core
from tissu.checkpoint.archive import DamagedError, pack, unpack
from tissu.checkpoint.contents import require_contents
from tissu.checkpoint.physics import differences
from tissu.checkpoint.whole import write_whole
from tissu.errors import CheckpointError
from tissu.files.place import kind_of_place, reason_of, shown_path

FORMAT = 5
_COLUMNS = {"positions": 3, "velocities": 3, "velocities_before": 3, "straining": 3, "rotations": 4}


@dataclass(frozen=True, slots=True)
class Resumed:
    """The checkpoint from which a simulation continued.

    Attributes:
        file: the checkpoint.
        time: simulated time at which it was taken [s].
        steps: number of steps taken until then.
        unconverged: number of those that did not converge.
        first_unconverged: message of the first of them; empty: all converged.
        note: why the bits may differ from those of the original run; empty: they do not.
    """

    file: str
    time: float
    steps: int
    unconverged: int
    first_unconverged: str
    note: str


@dataclass(frozen=True, slots=True)
class Checkpoint:
    """A moment of a simulation.

    Attributes:
        scene: name of the scene.
        physics: what its motion depends on; see `physics_of`.
        steps: that were taken.
        unconverged: how many of them did not converge, and what the first of those said.
        snapshot: numbers and arrays of the core, exact.
        build: version, compiler, instruction set and libraries of the tissu that took it.
        file: it was read from; None: it was taken here.
    """

    scene: str
    physics: Mapping[str, Any]
    steps: int
    unconverged: tuple[int, str]
    snapshot: Mapping[str, Any]
    build: Mapping[str, Any]
    file: Path | None = None

    def write(self, path: Path) -> None:
        """Write the file: whole at every moment, the one before or this one.

        Raises:
            CheckpointError: it cannot be written.
        """
        arrays = {k: v for k, v in self.snapshot.items() if isinstance(v, np.ndarray)}
        header = {
            "format": FORMAT,
            "tissu": self.build["version"],
            "build": self.build,
            "scene": self.scene,
            "steps": self.steps,
            "unconverged": self.unconverged[0],
            "first_unconverged": self.unconverged[1],
            "snapshot": {k: v for k, v in self.snapshot.items() if k not in arrays},
            "physics": self.physics,
        }
        shaped = {
            name: values.reshape(-1, _COLUMNS[name]) if name in _COLUMNS else values
            for name, values in arrays.items()
        }
        write_whole(path, pack(header, shaped))

    def require(self, physics: Mapping[str, Any]) -> None:
        """Refuse a scene that moves in another way.

        Raises:
            CheckpointError: it does, and where it differs.
        """
        found = differences(self.physics, physics)
        if found:
            raise CheckpointError(
                f"checkpoint {self.file}: it was written for another scene: {found}; go on with "
                "the scene that it was written for, or start again without it"
            )

    def resumed(self) -> Resumed:
        """What a simulation that went on from here records."""
        now, note = build(), ""
        other = [name for name in now if now[name] != self.build.get(name)]
        if other:
            told = ", ".join(f"{name} {_told(self.build.get(name))}" for name in other)
            note = (
                f"the checkpoint was written with {told}, and this runs with "
                f"{', '.join(_told(now[name]) for name in other)}: it goes on to round-off, not "
                "with the same bits"
            )
        return Resumed(
            str(self.file), float(self.snapshot["time"]), self.steps, *self.unconverged, note
        )


def read_checkpoint(path: Path) -> Checkpoint:
    """Read what `Checkpoint.write` wrote.

    Raises:
        CheckpointError: it is absent, damaged, or of another version.
    """
    header, arrays = _contents(path)
    version = _core.build_info()["version"]
    if header.get("format") != FORMAT or header.get("tissu") != version:
        raise CheckpointError(
            f"checkpoint {path}: it has format {header.get('format')} of tissu "
            f"{header.get('tissu')}; format {FORMAT} of tissu {version} is accepted: go on with "
            "the tissu that wrote it"
        )
    require_contents(path, header, arrays)
    return Checkpoint(
        scene=header["scene"],
        physics=header["physics"],
        steps=header["steps"],
        unconverged=(header["unconverged"], header["first_unconverged"]),
        snapshot={**header["snapshot"], **arrays},
        build=header["build"],
        file=path,
    )


def build() -> dict[str, Any]:
    """What the bits of a step depend on beside the scene: version, compiler, kernels, libraries."""
    told = _core.build_info()
    return {name: told[name] for name in ("version", "compiler", "instruction_set", "libraries")}


def _contents(path: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    try:
        kind = kind_of_place(path)
        if kind not in ("a file", "nothing"):
            raise CheckpointError(f"checkpoint {path}: found {kind}; a regular file is accepted")
        return unpack(path.read_bytes())
    except DamagedError:
        raise CheckpointError(
            f"checkpoint {path}: its checksum does not match its contents, so it is damaged, cut "
            "short, or no checkpoint of tissu; go on from another one, or start again"
        ) from None
    except FileNotFoundError:
        raise CheckpointError(
            f"checkpoint {path}: there is no such file; name one that save_checkpoint or "
            "tissu run --checkpoint wrote"
        ) from None
    except (OSError, ValueError) as error:
        why = reason_of(error)
        raise CheckpointError(f"checkpoint {shown_path(path)}: cannot be read ({why})") from None


def _told(value: object) -> str:
    if isinstance(value, Mapping):
        return ", ".join(f"{name} {item}" for name, item in value.items())
    return str(value)
