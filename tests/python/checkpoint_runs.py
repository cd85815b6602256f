"""A run with everything in it that a checkpoint has to keep; also the second half, in a process.

python checkpoint_runs.py STEP SOLVER THREADS CHECKPOINT END goes on from a checkpoint, takes the
other twenty steps and writes where it ends.
"""

import sys
from pathlib import Path

import tissu as ts
from tissu.scene import solver as solvers
from tissu.scene import step as steps
from tissu.scene.part import type_name

HALF = 20


STEPS = {type_name(cls): cls for cls in steps.STEPS}
SOLVERS = {type_name(cls): cls for cls in solvers.SOLVERS}


def scene(step, solver, threads=1):
    """A bar that is pushed and led in time, with a memory where the step allows one."""
    cls = STEPS[step]
    known = cls.model_fields
    fields = {"dt": 1e-3} if "dt" in known and known["dt"].default != "auto" else {}
    if "solver" in known:
        fields["solver"] = SOLVERS[solver]()
    dt = 1e-3 if "dt" in known else 1.0
    body = ts.Body(
        mesh=ts.BarMesh(size=(0.4, 0.1, 0.1), cells=(8, 2, 2)),
        law=ts.StVK(young=4e3, poisson=0.3),
        density=1e3,
    )
    relaxing = ts.Prony(branches=[ts.PronyBranch(weight=0.5, time="10 ms")])
    left = ts.Box((None, None, None), (1e-6, None, None))
    right = ts.Box((0.4 - 1e-6, None, None), (None, None, None))
    top = ts.Box((0.15, None, 0.1 - 1e-6), (0.3, None, None))
    times = (0.0, 15 * dt, 30 * dt)
    push = ts.Traction("bar", on=top, traction=(0, 20.0, -20.0), times=times, factors=(0, 1, 0.2))
    led = ts.Prescribed(
        "bar", on=right, times=times, displacements=[(0, 0, 0), (0.004, 0, 0), (0.004, 0, 0.002)]
    )
    whole = ts.Scene(
        bodies={"bar": body.replace(viscosity=relaxing)},
        gravity=(0, 0, -9.81),
        fixed=[ts.Fixed("bar", on=left)],
        prescribed=[led],
        loads=[push],
        step=cls(**fields),
        threads=threads,
        editing=True,
    )
    if step == "energy_momentum" or whole.check().problems:  # a step that takes no memory
        return whole.replace(bodies={"bar": body})
    return whole


def first_half(simulation):
    """Twenty steps with two cuts, the second of which sets nodes loose."""
    for number in range(HALF):
        if number == 8:
            simulation.remove_cells(body="bar", cells=[60, 61, 62])
        if number == 14:
            points = simulation.meshes["bar"].points
            corner = int(((points - (0.2, 0.1, 0.1)) ** 2).sum(axis=1).argmin())
            cells = simulation.scene.compile().meshes["bar"].volume_blocks[0].nodes
            around = {int(cell) for cell in (cells == corner).any(axis=1).nonzero()[0]}
            simulation.remove_cells(body="bar", cells=sorted(around - {60, 61, 62}))
        simulation.step()


def second_half(simulation):
    """Twenty steps with another cut."""
    for number in range(HALF):
        if number == 5:
            simulation.remove_cells(body="bar", cells=[5])
        simulation.step()


if __name__ == "__main__":
    step, solver, threads, begin, end = sys.argv[1:]
    resumed = scene(step, solver, int(threads)).compile(checkpoint=begin)
    second_half(resumed)
    resumed.save_checkpoint(Path(end))
