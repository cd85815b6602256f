"""What a scene ends with on any number of threads, from a checkpoint, and after a rewind."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

import tissu as ts


def steps(count: int) -> Callable[[ts.Simulation], None]:
    """What takes steps that converge."""

    def go_on(simulation: ts.Simulation) -> None:
        for _ in range(count):
            assert simulation.step().converged

    return go_on


def seconds(span: float) -> Callable[[ts.Simulation], None]:
    """What runs for a time [s]."""

    def go_on(simulation: ts.Simulation) -> None:
        for _ in simulation.run(span):
            pass

    return go_on


def require_same_ends(
    runs: Sequence[ts.Simulation],
    body: str,
    go_on: Callable[[ts.Simulation], None],
    folder: Path,
    strayed: Callable[[ts.Simulation], Any] | None = None,
) -> None:
    """Require the same bits at the end of each way from here on.

    Args:
        runs: simulations in the same state, each with its number of threads.
        body: whose positions, and rotations if it has any, are compared.
        go_on: what each does from here on.
        folder: where the checkpoint of the first is written.
        strayed: what the first does before it is taken back; absent: nothing.
    """
    mark = runs[0].mark()
    for other in runs[1:]:
        other.mark()  # a mark lets the solver forget
    runs[0].save_checkpoint(folder / "middle.h5")
    loaded = ts.Scene.compile(runs[0].scene, checkpoint=folder / "middle.h5")
    for simulation in (*runs, loaded):
        go_on(simulation)
    ends = [_end(simulation, body) for simulation in (*runs, loaded)]
    if strayed is not None:
        strayed(runs[0])
    runs[0].rewind(mark)
    go_on(runs[0])
    ends.append(_end(runs[0], body))
    for end in ends[1:]:
        for first, value in zip(ends[0], end, strict=True):
            np.testing.assert_array_equal(first, value)


def _end(simulation: ts.Simulation, body: str) -> list[Any]:
    values = [np.array(simulation.positions[body]), np.array(simulation.velocities[body])]
    if simulation.scene.bodies[body].has_rotations:
        values.append(np.array(simulation.rotations(body)))
    return values
