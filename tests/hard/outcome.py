"""What comes of a hard case with a method: steady, bounded, or refused, with numbers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import tissu as ts
from tissu.scene.step import STEPS

CASES = Path(__file__).with_name("cases")
CONTACT = Path(__file__).with_name("contact")
MOST_STEPS = 20_000
EXPLICIT = ("explicit_euler", "symplectic_euler", "rk2", "rk4")
STEADY = 1e-3
"""of the body's size: what a node moves in the last tenth of the run of a steady outcome"""


@dataclass(frozen=True)
class Outcome:
    """What came of a run.

    Attributes:
        kind: "steady", "bounded" or "refused".
        bound: largest distance of a node from rest at any time, in sizes of the body.
        late: largest such movement in the last tenth of the run, in sizes.
        inverted: cells inside out at the end.
        unconverged: steps that did not meet their tolerances.
        steps: how many were taken.
        message: why it was refused; empty.
        held: steps in which ways were cut so that nothing passes through anything.
        crossings: the most that the exact audit found after a step.
    """

    kind: str
    bound: float = 0.0
    late: float = 0.0
    inverted: int = 0
    unconverged: int = 0
    steps: int = 0
    message: str = ""
    held: int = 0
    crossings: int = 0

    def __str__(self) -> str:
        if self.kind == "refused":
            return f"refused: {self.message}"
        text = f"{self.kind}, within {self.bound:.3g}"
        if self.inverted:
            text += f", {self.inverted} cells inside out"
        if self.unconverged:
            text += f", {self.unconverged} of {self.steps} steps unconverged"
        if self.held:
            text += f", {self.held} steps held back"
        if self.crossings:
            text += f", {self.crossings} crossings"
        return text


def case(name: str, folder: Path = CASES) -> ts.Scene:
    """The scene of a case, as its file has it."""
    return ts.Scene.from_yaml(folder / f"{name}.yaml")


def names(folder: Path = CASES) -> list[str]:
    """All cases of a folder: CASES, or CONTACT for those with contact."""
    return sorted(path.stem for path in folder.glob("*.yaml"))


def methods() -> list[str]:
    """Words of all steps of a scene."""
    return [str(step.model_fields["type"].default) for step in STEPS]


def with_method(scene: ts.Scene, method: str) -> ts.Scene:
    """The case with another method: implicit ones with its step, solver and Newton's settings.

    Explicit ones take their stable step, and the fixed point nine tenths of what contracts.
    """
    cls = next(step for step in STEPS if step.model_fields["type"].default == method)
    own = scene.step
    if method == own.type:
        return scene
    if method == "static":
        step = ts.Static(newton=ts.Newton(iterations=50), solver=ts.Cholesky())
        return scene.replace(step=step, duration=None)
    if own.type == "static":
        scene = scene.replace(duration="1 s", step=ts.ImplicitEuler("10 ms"))
        own = scene.step
    if method in EXPLICIT:
        return scene.replace(step=cls())
    if method == "bdf2_fixed_point":
        # h^2 omega^2 + h c < 1 contracts: half the stable step of symplectic Euler.
        stable = scene.replace(step=ts.SymplecticEuler()).compile().stable_step
        return scene.replace(step=cls(dt=min(own.dt, 0.45 * stable)))
    shared = [name for name in ("newton", "solver") if name in cls.model_fields]
    kept = {name: getattr(own, name) for name in shared if hasattr(own, name)}
    return scene.replace(step=cls(dt=own.dt, **kept))


Watch = Callable[[ts.Simulation, ts.StepReport], None]


def outcome(
    scene: ts.Scene, *, keep: list[ts.Simulation] | None = None, watch: Watch | None = None
) -> Outcome:
    """Run a scene and say what came of it; `keep` gets its simulation, `watch` sees each step.

    Scenes with contacts are audited after every step.
    """
    try:
        simulation = scene.compile()
        if keep is not None:
            keep.append(simulation)
    except ts.TissuError as error:
        return Outcome("refused", message=_first_line(error))
    steps = 1 if scene.step.type == "static" else scene.duration / simulation.dt
    if steps > MOST_STEPS:
        text = f"stable up to {simulation.dt / 0.9:.2g} s, {steps:.1g} steps: not run"
        return Outcome("refused", message=text)
    sizes = {
        name: float(np.ptp(mesh.points, axis=0).max()) for name, mesh in simulation.meshes.items()
    }
    bound, unconverged, count, held, crossings = 0.0, 0, 0, 0, 0
    late: dict[str, tuple[np.ndarray, np.ndarray]] = {}
    try:
        for report in simulation.run():
            count, unconverged = count + 1, unconverged + (not report.converged)
            if count > MOST_STEPS:
                text = f"its stable step fell to {simulation.dt / 0.9:.2g} s: not run to the end"
                return Outcome("refused", bound=bound, steps=count, message=text)
            held += report.held_back > 0
            if scene.contacts:
                crossings = max(crossings, len(simulation.crossings()))
            if watch is not None:
                watch(simulation, report)
            for name, size in sizes.items():
                moved = simulation.displacements(name)
                bound = max(bound, float(np.abs(moved).max()) / size)
                if report.number > 0.9 * steps:
                    low, high = late.get(name, (moved, moved))
                    late[name] = (np.minimum(low, moved), np.maximum(high, moved))
    except ts.TissuError as error:
        return Outcome(
            "refused", bound, steps=count, message=_first_line(error), crossings=crossings
        )
    swing = max(
        (float((high - low).max()) / sizes[n] for n, (low, high) in late.items()), default=0.0
    )
    inverted = sum(len(simulation.inverted_cells(name)) for name in simulation.bodies)
    kind = "steady" if swing < STEADY else "bounded"
    return Outcome(kind, bound, swing, inverted, unconverged, count, "", held, crossings)


def _size(mesh: ts.Mesh) -> float:
    return float(np.ptp(mesh.points, axis=0).max())


def _first_line(error: Exception) -> str:
    lines = [line.strip(" -") for line in str(error).splitlines() if line.strip()]
    return lines[-1] if len(lines) == 2 else lines[0]
