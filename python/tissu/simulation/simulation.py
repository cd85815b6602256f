"""The simulation: a constant world, a mutable state, and steps."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NoReturn, SupportsIndex

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tissu import _core, units
from tissu.counted import counted
from tissu.errors import CheckpointError, ParameterError, TissuError
from tissu.simulation.by_body import ByBody
from tissu.simulation.changed import Changed
from tissu.simulation.cutting import Cutting, cut_mesh
from tissu.simulation.entry import Entry, before_the_door, one_thread_at_a_time
from tissu.simulation.following import follow, grabs_of
from tissu.simulation.handled import Handled
from tissu.simulation.inspected import Inspected
from tissu.simulation.instruments import Instrumented
from tissu.simulation.known_names import known_names_only
from tissu.simulation.meshes import Meshes
from tissu.simulation.plan import Plan
from tissu.simulation.profile import Profile, profile_of
from tissu.simulation.remaining import keep_cells, removed_cells
from tissu.simulation.report import StepReport, report_of
from tissu.simulation.resuming import resume_severed, severed_arrays
from tissu.simulation.schedule import stable_steps, steps_of, steps_until
from tissu.simulation.tearing import tear_after_step
from tissu.simulation.touched import Touched

if TYPE_CHECKING:
    from tissu.checkpoint import Checkpoint, Resumed
    from tissu.compile import Check
    from tissu.front import Scene
    from tissu.live_view import View
    from tissu.mesh import Mesh
    from tissu.scene.load import Load, Where
    from tissu.ties import Links

Floats = NDArray[np.float64]

_SHARE_OF_STABLE = 0.8
"""of the stable step, for the step auto: room for what the body stiffens in between"""
_SHARE_WITH_COPIES = 0.5
"""the same after cuts by copies: a light copy beside heavy ones swings far, and stiffens"""


@known_names_only
@one_thread_at_a_time
class Simulation(Inspected, Handled, Touched, Changed, Cutting, Instrumented):
    """A compiled scene that can be stepped; made by `Scene.compile()`.

    Only one thread at a time may call it: while one is in a method, another one gets a `BusyError`.

    Attributes:
        scene: the scene from which it was compiled.
        meshes: body -> mesh at rest; follows the removal of cells.
        resumed_from: the checkpoint from which it was resumed; None: it began at rest.
    """

    resumed_from: Resumed | None

    def __init__(
        self,
        *,
        scene: Scene,
        world: _core.World,
        meshes: Mapping[str, Mesh],
        tissue: Mapping[str, Mesh] | None = None,
        links: Mapping[str, Links] | None = None,
        integrator: _core.Integrator,
        solver: _core.LinearSolver | None,
        check: Check,
        loads: Sequence[tuple[Load, Where]] = (),
        checkpoint: Checkpoint | None = None,
    ) -> None:
        self.scene = scene
        self._entry = Entry(scene.name)
        self._check = check
        self._loads = tuple(loads)
        self._last_grab = 0
        self._observers: tuple[Callable[[StepReport], object], ...] = ()
        self._world = world
        self._core = _core.Simulation(world=world, integrator=integrator, solver=solver)
        if scene.editing:
            self._core.prepare_edits()
        self._meshes = Meshes(meshes, self._mesh_now)
        self._rest = {name: mesh for name, mesh in meshes.items()}
        self._steps = 0
        self._unconverged = (0, "")
        self._simulated = 0.0
        self._physics_known: dict[str, Any] | None = None
        self._cell_sizes: dict[str, float] = {}
        self._tissue = dict(tissue or {})
        self._links = dict(links or {})
        self._severed: dict[str, NDArray[np.int32]] = {}
        self._lefts: dict[str, Any] = {}
        self._rest_points = {name: self._core.points(name) for name in [*meshes, *self._tissue]}
        self._lay_views()
        self.resumed_from = None
        if checkpoint is not None:
            self._go_on_from(checkpoint)

    def __repr__(self) -> str:
        """Name, time, steps, and the size of each body."""
        steps = counted(self._steps, "step")
        bodies = ", ".join(
            f"{name}: {counted(mesh.node_count, 'node')}, {counted(mesh.cell_count, 'cell')}"
            for name, mesh in self._meshes.items()
        )
        step = self.scene.step
        dt = getattr(step, "dt", None)
        how = step.type + ("" if dt is None else f" dt {dt}" if dt == "auto" else f" dt {dt:g} s")
        when = f"t = {self._core.time:.6g} s after {steps}"
        return f"Simulation('{self.scene.name}', {when}; {bodies}; {how})"

    def __reduce_ex__(self, protocol: SupportsIndex) -> NoReturn:
        """Refused: a copy would step the same state. `copy.copy`, `deepcopy` and `pickle` ask here.

        Raises:
            TissuError: always.
        """
        raise TissuError(
            "a simulation cannot be copied or pickled; compile its scene again, from a file of "
            "save_checkpoint to go on where it stands"
        )

    @property
    def meshes(self) -> Mapping[str, Mesh]:
        """Body -> mesh at rest, without the cells that were removed."""
        return MappingProxyType(self._meshes)

    @property
    def tissue(self) -> Mapping[str, Mesh]:
        """Connective tissue -> its own frames at rest, as nodes that no cell joins."""
        return MappingProxyType(self._tissue)

    def points(self, name: str, *, rest: bool = False) -> Floats:
        """Integration points (p, 3) of a body or tissue of frames, now or at rest [m].

        Raises:
            ParameterError: it is not made of frames.
        """
        found = self._rest_points.get(name) if rest else self._core.points(name)
        if found is None or not len(found):
            raise ParameterError(f"found '{name}', which is not made of frames and has no points")
        return found

    @property
    def positions(self) -> Mapping[str, Floats]:
        """Body -> (n, 3) view of the present positions [m]; no copy, writable.

        A view follows every step. Only the eliminated nodes of condensed regions are updated when
        this property is read.
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
        """Time step of the scene [s]; if it is auto, four fifths of the present stable step.

        Half of it in scenes with a body that was cut by copies of whole cells. 1 for a static
        scene, whose time only distinguishes loads.
        """
        dt = getattr(self.scene.step, "dt", 1.0)
        if dt != "auto":
            return float(dt)
        share = _SHARE_WITH_COPIES if self._has_copies() else _SHARE_OF_STABLE
        return share * self.stable_step

    def _has_copies(self) -> bool:
        """Whether a body has copies of cells, which may hold as little material as one likes."""
        return any(
            self._core.body_range(body)[1] > rest.node_count and not self._divides(body)
            for body, rest in self._rest.items()
        )

    @property
    def stable_step(self) -> float:
        """The largest stable step of an explicit method at the present state [s]; else infinite.

        It follows from the largest eigenfrequency and the damping, which are computed again when
        the cells have deformed.
        """
        return float(self._core.stable_step())

    def _prepare_first_step(self) -> None:
        """Make what the first step asks for: orderings, aggregates, a preconditioner.

        `compile` and `reset` do it, so that the first step takes about as long as the others. Steps
        give the same bits without it. Steps of another length, and those after a change of the
        state, make their own. It does nothing for static and explicit steps.
        """
        dt = getattr(self.scene.step, "dt", None)
        if getattr(self.scene.step, "solver", None) is not None and isinstance(dt, (int, float)):
            self._core.prepare_ahead(float(dt))

    def step(self, dt: units.Number | None = None) -> StepReport:
        """Take one step.

        Args:
            dt: another time step than the scene's [s], or text such as "5 ms".

        Raises:
            ParameterError: dt is not positive and finite; or the step was taken, but a cut or a
                tear at its end was refused.
            Diverged: the step gave a value that is not finite; the state is that before it.
        """
        h = self.dt if dt is None else units.TIME(dt)
        begin, works = self._core.time, bool(self.scene.instruments)
        if works:
            self._lead_instruments(begin + h)
        report = self._core.step(h)
        self._steps += 1
        self._simulated += h
        cuts = self._use_instruments(begin) if works else ()
        if self.scene.tear:
            cuts += tear_after_step(self)
        told = report_of(report, number=self._steps, cuts=cuts)
        if not told.converged:
            count, first = self._unconverged
            self._unconverged = (count + 1, first or str(told))
        for observer in self._observers:
            observer(told)
        return told

    def on_step(self, observer: Callable[[StepReport], object]) -> Callable[[], None]:
        """Call a function with the report of every step from now on, in the thread that steps.

        Returns:
            A function that ends it.
        """
        self._observers = (*self._observers, observer)

        def end() -> None:
            self._observers = tuple(one for one in self._observers if one is not observer)

        return end

    def run(
        self, duration: units.Number | None = None, *, until: units.Number | None = None
    ) -> Iterator[StepReport]:
        """Step until `duration` has passed, and yield each report.

        Args:
            duration: simulated time [s], or text such as "2 s"; the scene's when it is not given.
                A static scene without one takes a single step.
            until: instead of a duration, the time at which the run ends [s]. It takes the remaining
                steps of a run from time zero to then, so a resumed simulation takes the same steps
                as one that never stopped.

        Raises:
            ParameterError: no duration is given, both are given, or it is negative.
            Diverged: see `step`.
        """
        if duration is not None and until is not None:
            raise ParameterError("found duration and until; one of them is accepted")
        given = duration if until is None else until
        span = self._duration() if given is None else units.TIME(given)
        if not span >= 0.0:
            raise ParameterError(f"the duration is {span:g} s; it must not be negative")
        if getattr(self.scene.step, "dt", None) == "auto":
            steps = stable_steps(self, self.time + span if until is None else span)
        elif until is None:
            steps = steps_of(span, self.dt)
        else:
            steps = steps_until(span, self.dt, time=self.time, taken=self._steps)
        for dt in steps:
            yield self.step(dt)

    def save_checkpoint(self, path: str | os.PathLike[str]) -> None:
        """Write a file from which `scene.compile(checkpoint=path)` continues with the same bits.

        The file is replaced atomically: a process that is killed meanwhile leaves either the old or
        the new file, complete. The linear solver drops its memory of earlier steps, such as a
        factor, so that the running simulation and the one that is resumed from the file take the
        same steps.

        Raises:
            CheckpointError: it cannot be written; an old file is then kept.
        """
        from tissu.checkpoint import checkpoint

        checkpoint.Checkpoint(
            scene=self.scene.name,
            physics=self._physics(),
            steps=self._steps,
            unconverged=self._unconverged,
            snapshot={**self._core.snapshot(), **severed_arrays(self._links, self._severed)},
            build=checkpoint.build(),
        ).write(Path(path))

    @before_the_door
    def view(self, **options: Any) -> View:
        """Show the simulation in the browser, where it runs live; see `tissu.view`.

        Raises:
            ParameterError: an option that is not accepted.
            TissuError: viser is not installed.
        """
        from tissu.live_view import View

        return View(self, **options)

    def displacements(self, body: str) -> Floats:
        """Displacements (n, 3) of the nodes of a body from rest [m].

        Raises:
            ParameterError: no body of that name.
        """
        self._require_body(body)
        return self.positions[body] - {**self._meshes, **self._tissue}[body].points

    def rotations(self, body: str) -> Floats:
        """Rotation matrices (n, 3, 3) of the nodes of a body from rest.

        Raises:
            ParameterError: no body of that name, or its nodes are not frames.
        """
        self._require_body(body)
        found = self._core.rotations(body)
        if not len(found):
            text = f"found body '{body}', whose nodes have no rotation; those of frames have one"
            raise ParameterError(text)
        return found

    def energy(self) -> dict[str, float]:
        """Kinetic, elastic and potential energy, and their total [J]."""
        return self._core.energy()

    def largest_frequency(self) -> float:
        """The largest eigenfrequency omega of the free nodes at the present state [rad/s].

        It is found by Lanczos' method on M^-1/2 K M^-1/2. An explicit step without damping is
        stable below 2 / omega. It is 0 if nothing is stiff.
        """
        return float(self._core.largest_frequency())

    def model_bytes(self) -> int:
        """Bytes that the models of all bodies keep of their cells, with places in the matrix."""
        return sum(int(block[4]) for block in self._world.elastic_blocks)

    def solver_bytes(self) -> int:
        """Bytes of the linear solver: vectors, preconditioners, factors; not the matrix."""
        return int(self._core.solver_bytes())

    def profile(self) -> Profile:
        """Times by stage; see `Profile`. `clear_profile` deletes them."""
        return profile_of(self._core, self._simulated)

    def clear_profile(self) -> None:
        """Delete the times so far, for instance after the first steps, before a measurement."""
        self._core.profile_clear()
        self._simulated = 0.0

    def plan(self) -> Plan:
        """The effects that will run, with their reasons, and those that are absent."""
        return Plan(
            effects=tuple(self._check.effects),
            absent=tuple(self._check.absent),
            notes=(*self._check.notes, *self._chosen()),
            unknowns=3 * (self._world.blocks - self._spare_rows()),
            matrix_blocks=self._world.matrix_blocks,
            integrator=self._core.integrator_name,
            solver=self._core.solver_name or "no linear system",
            stable_step=self.stable_step,
            threads=self._world.threads,
            instruction_set=self._world.instruction_set,
        )

    def _spare_rows(self) -> int:
        """Rows that are reserved for nodes which cuts may make: up to the rows of the next body."""
        if self.scene.editing is None:
            return 0
        ranges = {name: self._core.body_range(name) for name in (*self.meshes, *self.tissue)}
        firsts = sorted(first for first, _ in ranges.values())
        spare = 0
        for first, count in (ranges[name] for name in self.meshes):
            after = next((other for other in firsts if other > first), self._world.blocks)
            spare += after - first - count
        return spare

    def _chosen(self) -> list[str]:
        """What the solver `auto` chose so far, as a note."""
        account = self._core.solver_account()
        return [f"step.solver: auto took {account}"] if account else []

    def remove_cells(self, *, body: str, cells: ArrayLike) -> None:
        """Remove cells of a body between two steps.

        Nodes that no cell uses any more stay where they are, and grabs of cells that are gone are
        released. Masses, matrix, surface and outputs follow.

        Args:
            body: its name.
            cells: numbers across the volume cells of the mesh that the scene was compiled from.

        Raises:
            ParameterError: the scene was compiled without `editing: true`, or has no such cell; in
                a static scene, pieces would be left that neither a support nor a contact holds.
                Then nothing has changed.
        """
        counts = {name: self._core.cell_count(name) for name in self._meshes}
        numbers = removed_cells(counts, body, cells)
        way_back = self._way_back()
        self._core.remove_cells(body=body, cells=numbers)
        self._follow_cells(body)
        self._refuse_free_pieces(body, self.pieces(body) if way_back is not None else (), way_back)
        if self.scene.grabbing and grabs_of(self._core, body):
            follow(self._core, body, self._meshes[body])

    def remaining_cells(self, body: str) -> NDArray[np.int32]:
        """Numbers (e,) in the mesh of the scene of the cells that `meshes[body]` has now.

        Raises:
            ParameterError: no body of that name.
        """
        self._require_body(body)
        return np.sort(self._core.remaining_cells(body))

    def _lay_views(self) -> None:
        ranges = {name: self._core.body_range(name) for name in [*self._meshes, *self._tissue]}
        self._positions = ByBody(_views(self._core.positions, ranges))
        self._velocities = ByBody(_views(self._core.velocities, ranges))

    def _follow_cells(self, body: str) -> None:
        """Makes the mesh and the views of a body those of its present cells and nodes."""
        self._meshes.follow(body)
        if self._core.body_range(body)[1] != len(self._positions[body]):
            self._lay_views()

    def _mesh_now(self, body: str) -> Mesh:
        """The mesh of the present cells of a body."""
        rest = self._rest[body]
        core = self._core
        moved = core.moved(body)
        if moved or core.body_range(body)[1] > rest.node_count:
            places = core.made_of(body)[0]
            return cut_mesh(rest, core.body_cells(body), core.roots(body), places, moved=moved)
        if self._core.cell_count(body) == rest.cell_count:
            return rest
        return keep_cells(rest, self.remaining_cells(body))

    def _go_on_from(self, checkpoint: Checkpoint) -> None:
        checkpoint.require(self._physics())
        try:
            resume_severed(self, checkpoint.snapshot)
            self._core.restore(dict(checkpoint.snapshot))
        except TissuError as error:  # of a forged file: another scene is refused above
            raise CheckpointError(f"checkpoint {checkpoint.file}: {error}") from None
        self._steps = checkpoint.steps
        self._unconverged = checkpoint.unconverged
        for body in self._rest:
            self._follow_cells(body)
        self.resumed_from = checkpoint.resumed()

    def _physics(self) -> dict[str, Any]:
        from tissu.checkpoint import physics_of

        if self._physics_known is None:
            self._physics_known = physics_of(self.scene, self._rest)
        return self._physics_known

    def _duration(self) -> float:
        if self.scene.duration is not None:
            return float(self.scene.duration)
        if self.scene.step.type == "static":
            return self.dt
        raise ParameterError("the scene has no duration; give one to run()")


def _views(values: Floats, ranges: Mapping[str, tuple[int, int]]) -> dict[str, Floats]:
    return {name: values[first : first + count] for name, (first, count) in ranges.items()}
