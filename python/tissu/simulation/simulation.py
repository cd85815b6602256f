"""The simulation: a constant world, a mutable state, and steps."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tissu import _core, units
from tissu.counted import counted
from tissu.errors import ParameterError
from tissu.simulation.plan import Plan
from tissu.simulation.profile import Profile, ProfileRow, Solves
from tissu.simulation.report import StepReport

if TYPE_CHECKING:
    from tissu.compile import Check
    from tissu.mesh import Mesh
    from tissu.scene import Scene

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]


class Simulation:
    """A compiled scene that can be stepped; made by `Scene.compile()`.

    Attributes:
        scene: what it was compiled from.
        meshes: body -> mesh at rest; follows the removal of cells.
    """

    def __init__(
        self,
        *,
        scene: Scene,
        world: _core.World,
        meshes: Mapping[str, Mesh],
        integrator: _core.Integrator,
        solver: _core.LinearSolver,
        check: Check,
    ) -> None:
        self.scene = scene
        self._check = check
        self._world = world
        self._core = _core.Simulation(world=world, integrator=integrator, solver=solver)
        self._meshes = dict(meshes)
        self._rest = {name: mesh for name, mesh in meshes.items()}
        self._steps = 0
        self._simulated = 0.0
        ranges = {name: self._core.body_range(name) for name in meshes}
        self._positions = MappingProxyType(_views(self._core.positions, ranges))
        self._velocities = MappingProxyType(_views(self._core.velocities, ranges))

    def __repr__(self) -> str:
        """Name, time, steps, and the size of each body."""
        steps = counted(self._steps, "step")
        bodies = ", ".join(
            f"{name}: {counted(mesh.node_count, 'node')}, {counted(mesh.cell_count, 'cell')}"
            for name, mesh in self._meshes.items()
        )
        step = self.scene.step
        how = step.type if step.type == "static" else f"{step.type} dt {self.dt:g} s"
        when = f"t = {self.time:.6g} s after {steps}"
        return f"Simulation('{self.scene.name}', {when}; {bodies}; {how})"

    @property
    def meshes(self) -> Mapping[str, Mesh]:
        """Body -> mesh at rest, without the cells that were removed."""
        return MappingProxyType(self._meshes)

    @property
    def positions(self) -> Mapping[str, Floats]:
        """Body -> (n, 3) view of the present positions [m]; no copy, writable.

        A view that is kept follows every step, but for the eliminated nodes of condensed regions:
        they are put in their places when this is asked for.
        """
        self._core.settle()
        return self._positions

    @property
    def velocities(self) -> Mapping[str, Floats]:
        """Body -> (n, 3) view of the velocities [m/s]; no copy, writable; see `positions`."""
        self._core.settle()
        return self._velocities

    @property
    def bodies(self) -> tuple[str, ...]:
        """Names of the bodies."""
        return tuple(self._meshes)

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self._core.time

    @property
    def state(self) -> Mapping[str, Any]:
        """Time [s], and positions [m] and velocities [m/s] of all nodes as (n, 3) views."""
        self._core.settle()
        return {
            "time": self.time,
            "positions": self._core.positions,
            "velocities": self._core.velocities,
        }

    @property
    def dt(self) -> float:
        """Time step of the scene [s]; 1 for a static scene, whose time only tells loads apart."""
        return float(getattr(self.scene.step, "dt", 1.0))

    def step(self, dt: units.Number | None = None) -> StepReport:
        """Take one step.

        Args:
            dt: another time step than the scene's [s], or text such as "5 ms".

        Raises:
            ParameterError: dt is not positive and finite.
            Diverged: the step gave a value that is not finite; the state is that before it.
        """
        h = self.dt if dt is None else units.TIME(dt)
        report = self._core.step(h)
        self._steps += 1
        self._simulated += h
        return StepReport(
            number=self._steps,
            time=report.time,
            newton_iterations=report.newton_iterations,
            solver_iterations=report.solver_iterations,
            residual=report.residual,
            converged=report.converged,
            milliseconds=report.milliseconds,
            message=report.message,
        )

    def run(self, duration: units.Number | None = None) -> Iterator[StepReport]:
        """Step until `duration` has passed, and yield each report.

        Args:
            duration: simulated time [s], or text such as "2 s"; the scene's when it is not given.
                A static scene without one takes a single step.

        Raises:
            ParameterError: neither gives a duration, or it is negative.
            Diverged: see `step`.
        """
        span = self._duration() if duration is None else units.TIME(duration)
        if not span >= 0.0:
            raise ParameterError(f"the duration is {span:g} s; it must not be negative")
        # Whole steps; a remainder of more than a millionth of a step is a shorter last step.
        whole = int(span / self.dt * (1.0 + 1e-12) + 1e-6)
        for _ in range(whole):
            yield self.step()
        rest = span - whole * self.dt
        if rest > 1e-6 * self.dt:
            yield self.step(rest)

    def displacements(self, body: str) -> Floats:
        """Displacements (n, 3) of the nodes of a body from rest [m]."""
        return self.positions[body] - self._meshes[body].points

    def reactions(self, body: str) -> Floats:
        """Forces (n, 3) that supports and led nodes give to a body [N]; zero where nothing is held.

        M dv/dt - f, with the change of velocity of the latest step; in equilibrium minus the sum of
        the elastic and external forces.
        """
        first, count = self._core.body_range(body)
        return self._core.reactions()[first : first + count]

    def energy(self) -> dict[str, float]:
        """Kinetic, elastic and potential energy, and their total [J]."""
        return self._core.energy()

    def cell_fields(self, body: str) -> dict[str, Floats]:
        """Mean values over each cell of a body, in the order of its mesh's volume cells.

        Returns:
            von_mises: of the Cauchy stress (e,) [Pa], absent where the model has none, and not a
            number in regions whose model has none; energy_density: per rest volume (e,) [J/m^3];
            volume_ratio: det F (e,).
        """
        self._core.settle()
        fields = self._core.cell_fields(body)
        order = np.argsort(self._core.remaining_cells(body), kind="stable")
        return {name: values[order] for name, values in fields.items()}

    def inverted_cells(self, body: str) -> Ints:
        """Numbers (k,) of the cells of a body that are inside out: their mean det F is not above 0.

        Looked for only when asked: a step does not pay for it.
        """
        return np.flatnonzero(self.cell_fields(body)["volume_ratio"] <= 0.0).astype(np.int32)

    def largest_frequency(self) -> float:
        """The largest eigenfrequency omega of the free nodes at the present state [rad/s].

        By Lanczos' method on M^-1/2 K M^-1/2. An explicit step without damping is stable below
        2 / omega; 0 where nothing is stiff.
        """
        return float(self._core.largest_frequency())

    def model_bytes(self) -> int:
        """What the models of all bodies keep of their cells, places in the matrix included."""
        return sum(int(block[4]) for block in self._world.elastic_blocks)

    def profile(self) -> Profile:
        """Times by stage; see `Profile`. `clear_profile` starts anew."""
        seconds = self._core.profile_step_seconds()
        steps = self._core.profile_steps()
        rows = [row for row in self._core.profile_rows() if row[2] > 0]
        total = float(seconds.mean()) * steps if steps else 0.0
        p50, p95 = np.percentile(seconds, [50, 95]) if steps else (0.0, 0.0)
        return Profile(
            rows=tuple(
                ProfileRow(effect, stage, calls, 1e3 * spent / max(steps, 1), spent / total)
                for effect, stage, calls, spent in rows
                if total
            ),
            steps=steps,
            p50_ms=1e3 * float(p50),
            p95_ms=1e3 * float(p95),
            max_ms=1e3 * float(seconds.max()) if steps else 0.0,
            real_time_factor=self._simulated / total if total else 0.0,
            solves=Solves(*self._core.profile_solves()),
        )

    def clear_profile(self) -> None:
        """Forget the times so far, to warm up before measuring."""
        self._core.profile_clear()
        self._simulated = 0.0

    def plan(self) -> Plan:
        """What will run and why, and what is absent."""
        return Plan(
            effects=tuple(self._check.effects),
            absent=tuple(self._check.absent),
            notes=tuple(self._check.notes),
            unknowns=3 * self._world.blocks,
            matrix_blocks=self._world.matrix_blocks,
            integrator=self._core.integrator_name,
            solver=self._core.solver_name,
            threads=self._world.threads,
            instruction_set=self._world.instruction_set,
        )

    def remove_cells(self, *, body: str, cells: ArrayLike) -> None:
        """Take cells out of a body between two steps.

        Nodes that no cell uses any more stay where they are. Masses, matrix, surface and outputs
        follow.

        Args:
            body: its name.
            cells: numbers across the volume cells of the mesh that the scene was compiled from.

        Raises:
            ParameterError: the scene was compiled without `editing: true`, or has no such cell.
        """
        given = np.atleast_1d(np.asarray(cells))
        if given.size and not np.issubdtype(given.dtype, np.integer):
            raise ParameterError(f"found cells of type {given.dtype}; whole numbers are accepted")
        if body not in self._meshes:
            raise ParameterError(f"no body is named '{body}'; there are {', '.join(self._meshes)}")
        beyond = given[(given < 0) | (given > np.iinfo(np.int32).max)]
        if beyond.size:
            raise ParameterError(f"body '{body}' has no cell {beyond.flat[0]}")
        numbers = np.unique(given).astype(np.int32)
        if len(numbers) >= self._meshes[body].cell_count:
            raise ParameterError(f"that would leave no cell of body '{body}'; keep at least one")
        self._core.remove_cells(body=body, cells=numbers)
        remaining = np.sort(self._core.remaining_cells(body))
        self._meshes[body] = keep_cells(self._rest[body], remaining)

    def _duration(self) -> float:
        if self.scene.duration is not None:
            return float(self.scene.duration)
        if self.scene.step.type == "static":
            return self.dt
        raise ParameterError("the scene has no duration; give one to run()")


def keep_cells(mesh: Mesh, cells: NDArray[np.int32]) -> Mesh:
    """A mesh with some of its volume cells only, by their increasing numbers; all nodes stay."""
    keep = np.zeros(mesh.cell_count, dtype=bool)
    keep[cells] = True
    number = np.cumsum(keep, dtype=np.int32) - 1
    blocks, first = [], 0
    for block in mesh.body_blocks:
        rows = keep[first : first + len(block.nodes)]
        blocks.append(dataclasses.replace(block, nodes=block.nodes[rows]))
        first += len(block.nodes)
    regions = {name: number[of[keep[of]]] for name, of in mesh.regions.items()}
    return dataclasses.replace(mesh, cells=tuple(blocks), regions=regions, border_regions={})


def _views(values: Floats, ranges: Mapping[str, tuple[int, int]]) -> dict[str, Floats]:
    return {name: values[first : first + count] for name, (first, count) in ranges.items()}
