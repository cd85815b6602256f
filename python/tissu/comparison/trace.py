"""Running a scene, and what is kept of it: displacements at a few times, and what a step costs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.errors import TissuError

if TYPE_CHECKING:
    from tissu.front import Scene
    from tissu.simulation import Simulation

Floats = NDArray[np.float64]

_SAMPLES = 20  # times at which displacements are kept, at most


@dataclass(frozen=True, slots=True)
class Trace:
    """What a run leaves behind.

    Attributes:
        times: (t,) times of the samples [s].
        displacements: body -> (t, n, 3) of the nodes that it began with [m]. Those that cuts add
            have larger numbers, and are left out.
        rest: body -> (n, 3) positions at rest of these nodes, at the start [m].
        steps: how many were taken.
        unconverged: how many of them did not converge.
        ms_per_step: median wall time of a step.
        iterations_per_step: of the linear solver, mean.
        model_bytes: what the models keep of their cells.
        matrix_bytes: what the matrix takes.
        cells: of all bodies.
        inverted: cells that are inside out at the end.
        frequency: the largest eigenfrequency at rest [rad/s].
        stopped: why it ended early; empty: it did not.
    """

    times: Floats
    displacements: dict[str, Floats]
    rest: dict[str, Floats]
    steps: int
    unconverged: int
    ms_per_step: float
    iterations_per_step: float
    model_bytes: int
    matrix_bytes: int
    cells: int
    inverted: int
    frequency: float
    stopped: str


def trace(scene: Scene) -> Trace:
    """Run a scene for its duration.

    Raises:
        SceneError: the scene does not compile.
        ParameterError: it has no duration.
    """
    simulation = scene.compile()
    frequency = simulation.largest_frequency()
    span = scene.duration if scene.duration is not None else simulation.dt
    every = max(1, round(span / simulation.dt / _SAMPLES))
    rest = {name: np.array(mesh.points) for name, mesh in simulation.meshes.items()}
    times, samples, stopped = [], [], ""
    unconverged = iterations = 0
    try:
        for report in simulation.run():
            unconverged += not report.converged
            iterations += report.solver_iterations
            if report.number % every == 0:
                times.append(simulation.time)
                samples.append(_displacements(simulation, rest))
    except TissuError as error:
        stopped = str(error)
    if not stopped and (not times or times[-1] != simulation.time):
        times.append(simulation.time)
        samples.append(_displacements(simulation, rest))
    profile = simulation.profile()
    return Trace(
        times=np.array(times),
        displacements={
            name: np.array([sample[name] for sample in samples]) for name in simulation.bodies
        },
        rest=rest,
        steps=profile.steps,
        unconverged=unconverged,
        ms_per_step=profile.p50_ms,
        iterations_per_step=iterations / max(1, profile.steps),
        model_bytes=simulation.model_bytes(),
        matrix_bytes=simulation.plan().matrix_bytes,
        cells=sum(mesh.cell_count for mesh in simulation.meshes.values()),
        inverted=sum(len(simulation.inverted_cells(name)) for name in simulation.bodies),
        frequency=frequency,
        stopped=stopped,
    )


def _displacements(simulation: Simulation, rest: dict[str, Floats]) -> dict[str, Floats]:
    return {name: simulation.displacements(name)[: len(nodes)] for name, nodes in rest.items()}
