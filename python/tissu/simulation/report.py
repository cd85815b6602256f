"""What one step says of itself."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from tissu.counted import counted

if TYPE_CHECKING:
    from tissu import _core
    from tissu.cutting.report import CutReport


@dataclass(frozen=True, slots=True)
class StepReport:
    """One step.

    Attributes:
        number: of the step, from 1.
        time: at its end [s].
        newton_iterations: linearisations.
        solver_iterations: of the linear solver, over all linearisations.
        residual: of the linear system, over its right side; of Newton's equation when it is
            iterated, over the load that acts: external forces, reactions at prescribed nodes and,
            in time, changes of momentum.
        indefinite: systems whose matrix was not positive definite, and was made so.
        converged: every tolerance was met.
        contacts: number of contacts that press at the end of the step.
        held_back: nodes whose motion was cut short so that nothing passes through anything.
        least_gap: distance of the nearest pair that presses, as a share of that at which the
            surfaces rest; infinite where nothing does.
        substeps: parts in which the step was taken: more than one where contact made it too long,
            or nodes of shells and frames that turn far.
        milliseconds: wall time.
        message: why it did not converge; of a static step that converged, the cells that are inside
            out, and whether round-off left a residual above the tolerance.
        cuts: the reports of instruments and tears at its end, in the order of the scene.
    """

    number: int
    time: float
    newton_iterations: int
    solver_iterations: int
    residual: float
    indefinite: int
    converged: bool
    contacts: int
    held_back: int
    least_gap: float
    substeps: int
    milliseconds: float
    message: str
    cuts: tuple[CutReport, ...] = ()

    def __str__(self) -> str:
        """One line."""
        iterations = (
            f"{self.newton_iterations} Newton and {self.solver_iterations} solver iterations"
        )
        text = f"step {self.number}: t = {self.time:.6g} s, residual {self.residual:.1e}"
        text += f" after {iterations}, {self.milliseconds:.1f} ms"
        if self.contacts:
            text += f", {counted(self.contacts, 'contact')}"
        if self.substeps > 1:
            text += f", in {self.substeps} parts"
        if self.held_back:
            text += f", {counted(self.held_back, 'node')} held back"
        if self.cuts:
            text += f", {counted(len(self.cuts), 'cut')}"
        if self.converged:
            return f"{text}; {self.message}" if self.message else text
        return f"{text}; not converged: {self.message}"


def report_of(
    report: _core.StepReport, *, number: int, cuts: tuple[CutReport, ...] = ()
) -> StepReport:
    """The core's report of the step with this number, and what was cut at its end."""
    return StepReport(
        number=number,
        time=report.time,
        newton_iterations=report.newton_iterations,
        solver_iterations=report.solver_iterations,
        residual=report.residual,
        indefinite=report.indefinite,
        converged=report.converged,
        contacts=report.contacts,
        held_back=report.held_back,
        least_gap=report.least_gap,
        substeps=report.substeps,
        milliseconds=report.milliseconds,
        message=report.message,
        cuts=cuts,
    )
