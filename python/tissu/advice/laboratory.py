"""Where settings are run: each once, within what is left of the budget."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING

from tissu.advice.measure import Measured, Watch, measure
from tissu.advice.resolution import Resolutions
from tissu.advice.setting import Setting, scene_words
from tissu.errors import SceneError
from tissu.scene.step import Static

if TYPE_CHECKING:
    from tissu.front import Scene

_POWER = 1.3  # a step's time grows with this power of the unknowns, roughly
_STATIC_POWER = 2.0  # that of a static one, whose systems are factorised or ill-conditioned
_CERTAIN = 4.0  # how far off that may be before a run is not even tried


@dataclass(frozen=True, slots=True)
class Tried:
    """A setting with its scene, and what came of it.

    Attributes:
        setting: what was set.
        scene: that was run.
        measured: what the run left behind; None: it was refused, or not tried.
        why: of a run that was refused, not tried, or stopped.
        refused: whether the scene with this setting does not compile.
    """

    setting: Setting
    scene: Scene
    measured: Measured | None
    why: str = ""
    refused: bool = False

    @property
    def finished(self) -> bool:
        """Whether it came to its end."""
        return self.measured is not None and not self.measured.stopped

    def words(self) -> str:
        """What ran, and how long a step took."""
        name = ", ".join(scene_words(self.scene))
        if self.measured is None:
            return f"{name}: {self.why}"
        stopped = f"; {self.why}" if self.why else ""
        return f"{name}: {self.measured.ms_per_step:.3g} ms a step{stopped}"


@dataclass(slots=True)
class Laboratory:
    """Runs settings of one scene.

    Attributes:
        scene: as it was given.
        resolutions: its meshes.
        watched: what is compared.
        end: when the budget is spent, by the clock `time.perf_counter` [s].
        told: called after each run.
    """

    scene: Scene
    resolutions: Resolutions
    watched: Watch
    end: float
    told: Callable[[Tried], None] = lambda tried: None
    tried: dict[tuple[Fraction, int, str, str, str], Tried] = field(default_factory=dict)

    @property
    def left(self) -> float:
        """What is left of the budget [s]."""
        return self.end - time.perf_counter()

    def run(
        self,
        setting: Setting,
        *,
        allowance: float,
        too_slow: Callable[[float, float], bool] = lambda ms_per_step, dt: False,
    ) -> Tried | None:
        """Run a setting, if it was not run before; the arguments are those of `measure`.

        Returns:
            None where there is no mesh of it, or no time at all.
        """
        known = self.tried.get(setting.key())
        if known is not None and (known.finished or not _for_want_of_time(known, allowance)):
            return known
        scene = setting.scene(self.scene, self.resolutions)
        if scene is None or allowance <= 0.0:
            return known
        found = self._tried(setting, scene, allowance, too_slow)
        self.tried[setting.key()] = found
        if not found.refused:
            self.told(found)
        return found

    def _tried(
        self,
        setting: Setting,
        scene: Scene,
        allowance: float,
        too_slow: Callable[[float, float], bool],
    ) -> Tried:
        if self._surely_over(setting, allowance):
            return Tried(setting, scene, None, "it would take longer than what is left for it")
        try:
            measured = measure(scene, self.watched, allowance=allowance, too_slow=too_slow)
        except SceneError as error:
            return Tried(setting, scene, None, "; ".join(error.problems), refused=True)
        return Tried(setting, scene, measured, measured.stopped)

    def _surely_over(self, setting: Setting, allowance: float) -> bool:
        """Whether even one step of more cells, which cannot be stopped, would take too long."""
        coarser = [
            t.measured
            for t in self.tried.values()
            if t.measured is not None and t.setting.order == setting.order
        ] or [t.measured for t in self.tried.values() if t.measured is not None]
        if not coarser:
            return False
        known = max(coarser, key=lambda measured: measured.unknowns)
        own = next(t for t in self.tried.values() if t.measured is known)
        growth = float(setting.scale / own.setting.scale) ** 3
        growth *= 4.0 if setting.order > own.setting.order else 1.0
        static = isinstance(setting.step, Static)
        foreseen = 1e-3 * known.ms_per_step * float(growth ** (_STATIC_POWER if static else _POWER))
        return foreseen > (allowance if static else _CERTAIN * allowance)


def _for_want_of_time(known: Tried, allowance: float) -> bool:
    """Whether it was stopped for time, and would now be given more."""
    measured = known.measured
    return measured is not None and measured.foreseen > 0.0 and allowance > measured.foreseen
