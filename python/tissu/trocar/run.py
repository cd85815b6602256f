"""The trocars of a scene while it runs: stepped with it, or in real time beside it."""

from __future__ import annotations

import csv
import time
from collections.abc import Iterator
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any

import numpy as np
from typing_extensions import Self

from tissu.counted import counted
from tissu.errors import ParameterError
from tissu.trocar.controller import Controller
from tissu.trocar.states import State
from tissu.trocar.touch import Felt, Touch

if TYPE_CHECKING:
    from pathlib import Path
    from types import TracebackType

    from tissu.simulation import Simulation, StepReport
    from tissu.trocar.report import Report

COLUMNS = (
    *("t [s]", "state", "tool", "pitch [rad]", "roll [rad]", "rotation [rad]", "depth [m]"),
    *("tip x [m]", "tip y [m]", "tip z [m]"),
    *("step Fx [N]", "step Fy [N]", "step Fz [N]", "tick Fx [N]", "tick Fy [N]", "tick Fz [N]"),
    "contacts",
)


class Trocars:
    """All trocars of a simulation's scene, from `with` to its end.

    Attributes:
        felt: what each trocar felt in each step, by its name.
    """

    def __init__(
        self, simulation: Simulation, *, realtime: bool = False, trust_plugins: bool = False
    ) -> None:
        """Take the trocars of its scene.

        Args:
            simulation: whose scene has trocars.
            realtime: whether ticks and steps keep pace with the clock; else both are stepped.
            trust_plugins: whether the plug-in of a device, which is a program, may run.

        Raises:
            ParameterError: a device that is not simulated, and not in real time; what `Touch`
                refuses.
        """
        self.simulation, self.realtime = simulation, realtime
        self._trust = trust_plugins
        self.felt: dict[str, list[Felt]] = {}
        self._touches: dict[str, Touch] = {}
        self._reports: dict[str, Report] = {}
        self._open = ExitStack()
        self._late = 0
        self._behind = 0.0
        if realtime:
            return
        for name, trocar in simulation.scene.trocars.items():
            if trocar.device.type != "simulated":
                text = f"found trocars.{name}.device of type {trocar.device.type}, which lives in "
                raise ParameterError(
                    f"{text}real time; run with --realtime, or take a simulated one"
                )

    def __enter__(self) -> Self:
        mode: Any = "threaded" if self.realtime else "stepped"
        for name, trocar in self.simulation.scene.trocars.items():
            controller = self._open.enter_context(
                Controller(trocar, mode=mode, trust_plugins=self._trust)
            )
            self._touches[name] = Touch(self.simulation, controller)
            self.felt[name] = []
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._open.close()

    def along(self, steps: Iterator[StepReport]) -> Iterator[StepReport]:
        """The steps, each with the tools where the hands have them, and felt by these after it.

        In real time a step that took longer than it lasts is late. What it lost is not caught up:
        the next one begins at once and has its whole time.
        """
        begin, first = time.monotonic(), self.simulation.time
        while True:
            for touch in self._touches.values():
                touch.lead()
            report = next(steps, None)
            if report is None:
                return
            for name, touch in self._touches.items():
                self.felt[name].append(touch.hand_on())
            self._reports.clear()
            if self.realtime:
                ahead = self.simulation.time - first - (time.monotonic() - begin)
                time.sleep(max(0.0, ahead))
                if ahead < 0.0:
                    self._late += 1
                    self._behind -= ahead
                    begin -= ahead
            yield report

    def _report(self, name: str) -> Report:
        """Of a trocar after the last step: one report for all that is said of that moment.

        In real time its ticks go on meanwhile, and a second report would be of another moment.
        """
        if name not in self._reports:
            self._reports[name] = self._touches[name].controller.report()
        return self._reports[name]

    def summary(self) -> dict[str, Any]:
        """Of each trocar: forces, energy, and in real time how late ticks and steps were."""
        found = {}
        for name, touch in self._touches.items():
            felt, report = self.felt[name], self._report(name)
            largest = {
                kind: max((float(np.linalg.norm(getattr(one, kind))) for one in felt), default=0.0)
                for kind in ("force", "fast")
            }
            found[name] = {
                "state": report.state.name,
                "tool": report.tool,
                "largest_force_of_steps": largest["force"],
                "largest_force_of_ticks": largest["fast"],
                "energy_given_out": report.given_out,
                "compliance": touch.compliance.by,
                "largest_error_of_compliance": None
                if touch.compliance.by == "warped"
                else touch.largest_error,
                "factors_of_compliance": touch.compliance.factors,
            }
            if self.realtime:
                timing = report.timing
                found[name] |= {
                    "late_steps": self._late,
                    "seconds_behind": self._behind,
                    "missed_ticks": timing.missed,
                    "lateness_p99": timing.lateness.p99,
                }
        return found

    def words(self) -> list[str]:
        """A line for each trocar: its state and tool, and in real time what was late."""
        found = []
        for name in self._touches:
            report = self._report(name)
            text = f"trocar:  {name} ended {report.state.name} with {report.tool or 'no tool'}"
            if self.realtime:
                text += f"; {counted(report.timing.missed, 'missed tick')}, "
                text += f"{counted(self._late, 'late step')}, {self._behind:.3g} s behind"
            found.append(text)
        return found

    def problems(self) -> list[str]:
        """What is to be done about trocars that give no force any more, a sentence for each."""
        found = []
        for name in self._touches:
            report = self._report(name)
            if report.state in (State.held, State.fault):
                why = report.problem or "its tissue is not felt"
                found.append(f"trocars.{name} ended {report.state.name}: {why}")
        return found

    def write(self, folder: Path) -> list[Path]:
        """A table for each trocar, `trocar-NAME.csv`, with a line for each step."""
        written = []
        for name, felt in self.felt.items():
            path = folder / f"trocar-{name}.csv"
            with path.open("w", newline="", encoding="utf-8") as file:
                table = csv.writer(file)
                table.writerow(COLUMNS)
                for one in felt:
                    numbers = (*one.joints, *one.tip, *one.force, *one.fast)
                    head = (f"{one.time:.9g}", one.state, one.tool or "")
                    table.writerow([*head, *(f"{number:.9g}" for number in numbers), one.contacts])
            written.append(path)
        return written
