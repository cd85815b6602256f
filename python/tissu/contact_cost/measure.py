"""A case is run with contact and without it, step by step, each step audited."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tissu.contact_cost.scenes import GRAVITY, WINDOW, Case
from tissu.errors import TissuError
from tissu.front import Scene
from tissu.simulation import Simulation, StepReport

Floats = NDArray[np.float64]
IMPACT = 20  # steps from the first contact on that count as an impact
SETTLED = 5  # steps at the start that are not timed: lists and factors are made in them


@dataclass(frozen=True)
class Row:
    """What came of a case.

    Attributes:
        name: of the case.
        cells: how many.
        bare: CPU time of a step without contact [ms]: its median.
        steps: CPU times of the steps with a contact [ms]: p50, p95, p99.
        impact: the longest CPU time from the first contact on, for 20 steps [ms].
        deepest: how far inside their gap surfaces came, in edges: in the impact, and at the end.
        force_error: of what the floor carries, and of the worst joint, as a share; None: not asked.
        crossings: found by the exact audit, over all steps.
        held_back: steps in which a way was cut.
        unconverged: steps that say so.
        moved: creep or drift at the end [m/s]; None: not asked.
        slides: acceleration over that of Coulomb's law; None: not asked.
        ended: why it ended early; empty: it did not.
    """

    name: str
    cells: int
    bare: float
    steps: tuple[float, float, float]
    impact: float
    deepest: tuple[float, float]
    force_error: float | None
    crossings: int
    held_back: int
    unconverged: int
    moved: float | None
    slides: float | None
    ended: str = ""


def measure(case: Case, *, beside: bool = True) -> Row:
    """Runs it. A run that an error ends is a row that says why.

    Args:
        case: what is run.
        beside: whether the same bodies are timed without contact; else that time is nan.
    """
    bare = _times(case.without(), case.dt)[SETTLED:] if beside else [float("nan")]
    simulation = case.scene().compile()
    watch = _Watch(simulation, case)
    steps = _count(simulation.scene, case.dt)
    ended = ""
    for _ in range(steps):
        try:
            watch.step()
        except TissuError as error:
            ended = str(error).splitlines()[0]
            break
    return watch.row(float(np.median(bare)), ended)


def _count(scene: Scene, dt: float) -> int:
    return round((scene.duration or 0.0) / dt)


def _times(scene: Scene, dt: float) -> list[float]:
    simulation = scene.compile()
    return [_timed(simulation)[0] for _ in range(_count(scene, dt))]


def _timed(simulation: Simulation) -> tuple[float, StepReport]:
    begin = time.process_time()
    report = simulation.step()
    return 1e3 * (time.process_time() - begin), report


class _Watch:
    """What is noted at every step."""

    def __init__(self, simulation: Simulation, case: Case) -> None:
        self._simulation = simulation
        self._case = case
        self._edge = _mean_edge(simulation)
        self._mass = {
            name: (body.density or 0.0) * simulation.meshes[name].volume()
            for name, body in simulation.scene.bodies.items()
        }
        self._times: list[float] = []
        self._touched: list[bool] = []
        self._depths: list[float] = []
        self._places: list[Floats] = []
        self._forces: list[float] = []
        self._counts = np.zeros(3, dtype=int)  # crossings, held back, unconverged

    def step(self) -> None:
        simulation = self._simulation
        milliseconds, report = _timed(simulation)
        gaps = simulation.contacts().gaps
        self._times.append(milliseconds)
        self._touched.append(len(gaps) > 0)
        self._depths.append(max(0.0, -float(gaps.min(initial=0.0))) / self._edge)
        self._places.append(np.array([x.mean(axis=0) for x in simulation.positions.values()]))
        self._counts += [len(simulation.crossings()), report.held_back > 0, not report.converged]
        if self._case.force is not None:
            self._forces.append(self._force_error())

    def _force_error(self) -> float:
        expected = self._case.force or 1.0
        found = [abs(-self._simulation.force_on("floor").force[2] / expected - 1.0)]
        above = sum(self._mass.values())
        for lower, upper in zip(self._case.joints, self._case.joints[1:], strict=False):
            above -= self._mass[lower]
            found.append(abs(self._joint(lower, upper) / (above * GRAVITY) - 1.0))
        return float(max(found))

    def _joint(self, lower: str, upper: str) -> float:
        """What goes up through a joint [N]."""
        found = self._simulation.contacts()
        a, b = found.surfaces.index(lower), found.surfaces.index(upper)
        up = found.forces[:, 2]
        onto = (found.pairs == [b, a]).all(axis=1)
        back = (found.pairs == [a, b]).all(axis=1)
        return float(up[onto].sum() - up[back].sum())

    def row(self, bare: float, ended: str) -> Row:
        """All of it."""
        first = self._touched.index(True) if any(self._touched) else 0
        times = np.array(self._times)
        met = times[np.array(self._touched, dtype=bool)]
        impact = slice(first, first + IMPACT)
        spread = np.percentile(met, (50, 95, 99)) if len(met) else np.full(3, np.nan)
        dt = self._case.dt
        places = np.array(self._places)[-WINDOW:]
        moved, slides = self._motion(places, dt)
        crossings, held_back, unconverged = (int(n) for n in self._counts)
        return Row(
            name=self._case.name,
            cells=sum(mesh.cell_count for mesh in self._simulation.meshes.values()),
            bare=bare,
            steps=(float(spread[0]), float(spread[1]), float(spread[2])),
            impact=float(times[impact].max(initial=0.0)),
            deepest=(
                max(self._depths[impact], default=0.0),
                max(self._depths[-WINDOW:], default=0.0),
            ),
            force_error=max(self._forces[-WINDOW:], default=None),
            crossings=crossings,
            held_back=held_back,
            unconverged=unconverged,
            moved=moved,
            slides=slides,
            ended=ended,
        )

    def _motion(self, places: Floats, dt: float) -> tuple[float | None, float | None]:
        if len(places) < 3 or (self._case.slides is None and not self._case.joints):
            return None, None
        seconds = dt * (len(places) - 1)
        along = places[:, :, :2]
        if self._case.slides:
            speed = np.diff(along[:, 0, 0]) / dt
            return None, float(np.polyfit(dt * np.arange(len(speed)), speed, 1)[0]) / (
                self._case.slides
            )
        return float(np.linalg.norm(along[-1] - along[0], axis=1).max()) / seconds, None


def _mean_edge(simulation: Simulation) -> float:
    """Of the finest surface [m]."""
    means = []
    for mesh in simulation.meshes.values():
        corners = mesh.points[mesh.surface().triangles]
        means.append(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean())
    return float(min(means))
