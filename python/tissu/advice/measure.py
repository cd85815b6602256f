"""Running a scene with one setting: where the watched points go, and what a step costs."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.errors import TissuError
from tissu.mesh.places import Places, places

if TYPE_CHECKING:
    from tissu.front import Scene
    from tissu.mesh import Mesh
    from tissu.simulation import Simulation

Floats = NDArray[np.float64]

_SAMPLES = 20  # times at which displacements are kept, at most
_POINTS = 4000  # nodes of a body whose displacements are kept, at most
_HOW_LATE = (4.0, 2.0, 1.1)  # over the time allowed: foreseen after 1, 2, and more steps
_SEEN = 0.03  # of the time allowed that steps must have taken before anything is foreseen
_TIMED_FROM = 6  # steps after which one is known to be slow


@dataclass(frozen=True, slots=True)
class Watch:
    """What is watched: the same points at the same times with every setting.

    Attributes:
        points: body -> (n, 3) nodes of the scene's own mesh at rest [m].
        nodes: body -> (k,) numbers of those that are watched.
        times: (t,) increasing [s]; the last is the end of the run.
    """

    points: Mapping[str, Floats]
    nodes: Mapping[str, NDArray[np.int64]]
    times: Floats

    def places(self, name: str, mesh: Mesh) -> Places:
        """Where the watched points of a body stand in one of its meshes.

        Raises:
            ParameterError: a point is in no cell.
        """
        points, nodes = self.points[name], self.nodes[name]
        if np.array_equal(points, mesh.points[: len(points)]):  # the same nodes, and maybe more
            return Places(nodes[:, None], np.ones((len(nodes), 1)))
        return places(points[nodes], mesh)


@dataclass(frozen=True, slots=True)
class Measured:
    """What a run leaves behind.

    Attributes:
        moved: (t, p, 3) displacements of the watched points of all bodies [m]; fewer times when
            it stopped.
        cells: of all bodies.
        unknowns: numbers that a step solves for.
        steps: how many were taken.
        unconverged: how many of them did not converge.
        dt: mean length of a step [s].
        ms_per_step: median wall time of a step.
        megabytes: models, matrix and linear solver.
        seconds: wall time of all of it, compilation included.
        stopped: why it ended early; empty: it did not.
        foreseen: what the whole run would have taken, where it was stopped for want of time [s];
            0: it was not.
    """

    moved: Floats
    cells: int
    unknowns: int
    steps: int
    unconverged: int
    dt: float
    ms_per_step: float
    megabytes: float
    seconds: float
    stopped: str = ""
    foreseen: float = 0.0


def watch(simulation: Simulation) -> Watch:
    """The nodes of a simulation's meshes, of large ones every so many, at up to 20 times.

    The times are ends of its steps; where there are enough of them, also of steps twice as long.
    """
    points = {name: np.array(mesh.points) for name, mesh in simulation.meshes.items()}
    span, dt = _span(simulation), simulation.dt
    steps = max(1, int(span / dt * (1.0 + 1e-12) + 1e-6))
    every = max(1, -(-steps // _SAMPLES))
    if every > 1 or steps >= _SAMPLES:
        every += every % 2
    times: Floats = np.asarray(dt * np.arange(every, steps + 1, every), dtype=np.float64)
    if not len(times) or times[-1] < span * (1.0 - 1e-9):
        times = np.append(times, span)
    nodes = {name: np.arange(0, len(at), -(-len(at) // _POINTS)) for name, at in points.items()}
    return Watch(points, nodes, times)


def measure(
    scene: Scene,
    watched: Watch,
    *,
    allowance: float,
    too_slow: Callable[[float, float], bool] = lambda ms_per_step, dt: False,
) -> Measured:
    """Run a scene for its duration, or until it is clear that it takes longer than allowed.

    Displacements between two steps are interpolated linearly.

    Args:
        scene: with a duration, or static.
        watched: points and times.
        allowance: wall time [s], for compilation and steps.
        too_slow: whether steps of so many ms and of a length [s] are of no use.

    Raises:
        SceneError: the scene does not compile.
        ParameterError: a watched point is in no cell.
    """
    begin = time.perf_counter()
    simulation = scene.compile()
    samples = Samples(
        watched,
        {name: watched.places(name, simulation.meshes[name]) for name in watched.points},
    )
    samples.keep(simulation)
    unconverged, stopped, over = 0, "", 0.0
    compiled = time.perf_counter()
    span = _span(simulation)
    first: tuple[float, float] | None = None  # end of the first step: wall and simulated time
    try:
        for report in simulation.run():
            unconverged += not report.converged
            samples.keep(simulation)
            now = time.perf_counter()
            if simulation.time >= span * (1.0 - 1e-9):
                continue
            first = first or (now, simulation.time)
            foreseen = now - begin + _rest(first, (now, simulation.time), compiled, span)
            late = foreseen > _HOW_LATE[min(report.number, 3) - 1] * allowance
            late = late and now - compiled > _SEEN * allowance
            if late or now - begin > allowance:
                stopped = f"it would take about {foreseen:.2g} s; {allowance:.2g} s are left for it"
                over = foreseen
                break
            if report.number == _TIMED_FROM and too_slow(
                simulation.profile().p50_ms, simulation.time / report.number
            ):
                stopped = "it is clearly slower than what is needed"
                break
    except TissuError as error:
        stopped = str(error)
    profile = simulation.profile()
    matrix = simulation.plan().matrix_bytes
    solver = simulation.solver_bytes()
    return Measured(
        moved=samples.stacked(),
        cells=sum(mesh.cell_count for mesh in simulation.meshes.values()),
        unknowns=simulation.plan().unknowns,
        steps=profile.steps,
        unconverged=unconverged,
        dt=simulation.time / max(1, profile.steps),
        ms_per_step=profile.p50_ms,
        megabytes=(simulation.model_bytes() + matrix + solver) / 1e6,
        seconds=time.perf_counter() - begin,
        stopped=stopped,
        foreseen=over,
    )


def _rest(
    first: tuple[float, float], last: tuple[float, float], compiled: float, span: float
) -> float:
    """Wall time that the rest of a run will take [s]; its first step counts only if alone."""
    wall, moved = last[0] - first[0], last[1] - first[1]
    if not moved > 0.0:
        wall, moved = first[0] - compiled, first[1]
    return wall / moved * (span - last[1])


@dataclass(slots=True)
class Samples:
    """Displacements of the watched points at the watched times."""

    watched: Watch
    at: Mapping[str, Places]
    _kept: list[Floats] = field(default_factory=list)
    _before: tuple[float, Floats] | None = None
    _time: float = 0.0

    def keep(self, simulation: Simulation) -> None:
        """Take the samples that are due after a step."""
        now = simulation.time
        step, self._time = now - self._time, now
        if len(self._kept) == len(self.watched.times):
            return
        if self.watched.times[len(self._kept)] > now + 2.0 * step > 0.0:
            return  # not even the next step reaches it
        moved = np.concatenate(
            [at.values(simulation.displacements(name)) for name, at in self.at.items()]
        )
        slack = 1e-9 * self.watched.times[-1]
        while len(self._kept) < len(self.watched.times):
            due = float(self.watched.times[len(self._kept)])
            if due > now + slack:
                break
            if self._before is None or due >= now - slack:
                self._kept.append(moved)
            else:
                then, earlier = self._before
                share = (due - then) / (now - then)
                self._kept.append((1.0 - share) * earlier + share * moved)
        self._before = (now, moved)

    def stacked(self) -> Floats:
        """(t, p, 3), of the times that were reached."""
        points = sum(len(nodes) for nodes in self.watched.nodes.values())
        return np.array(self._kept).reshape(-1, points, 3)


def mean_distance(one: Floats, other: Floats) -> float:
    """Mean distance of points over all times [m]."""
    return float(np.linalg.norm(one - other, axis=-1).mean())


def _span(simulation: Simulation) -> float:
    """Simulated time of the run [s]."""
    duration = simulation.scene.duration
    return simulation.dt if duration is None else float(duration)
