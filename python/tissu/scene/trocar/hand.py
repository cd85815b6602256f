"""The hand of a simulated device: a mass on a spring that follows a path."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

from pydantic import AfterValidator, ValidationInfo

from tissu import units
from tissu.reading import Many, Maybe, MaybeVectors, Read
from tissu.scene.body import PathLike
from tissu.scene.field import field
from tissu.scene.part import Part
from tissu.scene.problem import Problem
from tissu.scene.support import IncreasingTimes, same_length
from tissu.scene.trocar.axes import OneDamping, OneStiffness
from tissu.scene.unknown import rule

__all__ = ["Hand"]


def _from_base(file: Path | None, info: ValidationInfo) -> Path | None:
    base = info.context.get("base") if isinstance(info.context, dict) else None
    return Path(base) / file if base is not None and file is not None else file


class Hand(Part):
    """The hand on a simulated device: a path of the tip in the port's axes, or a recorded one."""

    times: IncreasingTimes = field(default=())
    """strictly increasing times of the path [s]; before the first and after the last it rests"""
    points: MaybeVectors[Many[units.Position]] = field(default=None)
    """place of the tip in the port's axes at each time [m]; (0, 0, 10 cm) is 10 cm deep"""
    path: Annotated[Read[Path | None, PathLike | None], AfterValidator(_from_base)] = field(
        default=None
    )
    """a CSV file instead of `times` and `points`: a line `t, x, y, z` [s, m] for each time"""
    mass: units.Mass = field(default=0.3, gt=0.0)
    """mass that moves with the tip [kg]"""
    stiffness: OneStiffness = field(default=400.0, gt=0.0)
    """stiffness of the spring to the path [N/m]"""
    damping: OneDamping = field(default=6.0, ge=0.0)
    """damping of the damper to the path [N s/m]"""
    tremor: units.Length = field(default=0.0, ge=0.0)
    """amplitude of a tremor of 8 to 12 Hz about the path [m]; 0.1 mm is usual"""
    lets_go: Maybe[units.Time] = field(default=None, ge=0.0)
    """time at which it lets go [s]; absent: never"""

    @rule("times", "points", "path")
    def _has_one_path(self) -> Iterator[Problem]:
        if (self.path is None) == (self.points is None):
            text = "found neither points nor a path" if self.path is None else "found both"
            text += "; `times` with `points`, or the `path` of a CSV file, is accepted"
            yield Problem((), text)
        elif self.points is not None:
            yield from same_length("point", self.points, self.times)
        elif self.times:
            text = "found times with a path, whose file has them; leave them out"
            yield Problem(("times",), text)

    def words(self) -> str:
        """What it follows."""
        where = f"{len(self.times)} points" if self.path is None else str(self.path)
        return f"a hand along {where}"
