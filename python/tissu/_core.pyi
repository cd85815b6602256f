"""Types of the compiled core. Arrays are copied in unless said otherwise; every argument is in SI units.

A test holds this file against the module: names, arguments, nothing missing and nothing too much.
"""

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]
Blocks = Sequence[tuple[str, Ints]]

class Split:
    """How the box generator cuts a hexahedron."""

    none: ClassVar[Split]
    six: ClassVar[Split]
    five: ClassVar[Split]
    six_mirrored: ClassVar[Split]

def build_info() -> dict[str, Any]: ...
def cell_types() -> list[tuple[str, int, int, int, int]]: ...
def elements() -> list[tuple[str, int, int, int]]: ...
def cell_measures(*, positions: Floats, cell_type: str, nodes: Ints) -> Floats: ...
def zero_energy_modes(*, cell_type: str, quadrature: str) -> int: ...
def cell_edges(*, cell_type: str) -> list[list[int]]: ...
def cell_faces(*, cell_type: str) -> list[tuple[int, list[int]]]: ...
def box_mesh(
    *, origin: Sequence[float], size: Sequence[float], cells: Sequence[int], split: Split
) -> tuple[Floats, list[tuple[str, Ints]]]: ...
def shape_functions() -> list[tuple[str, int, str, str]]: ...
def shape_weights(
    *, name: str, neighbours: int = 0, frames: Floats, points: Floats, body: str = ""
) -> tuple[Ints, Floats, Floats]: ...
def mean_gradients(*, cell_type: str, positions: Floats, cells: Ints) -> Floats: ...
def boundary_surface(*, positions: Floats, blocks: Blocks) -> tuple[Ints, Ints, Ints, Ints]: ...
def boundary_faces(
    *, positions: Floats, blocks: list[tuple[str, Ints]]
) -> list[tuple[str, Ints, Ints]]: ...
def face_areas(*, type: str, positions: Floats, faces: Ints) -> Floats: ...
def turn_reversed_cells(
    *, positions: Floats, blocks: Blocks
) -> tuple[list[tuple[str, Ints]], int]: ...
def overfull_face_count(*, positions: Floats, blocks: Blocks) -> int: ...
def nonconforming_faces(*, positions: Floats, blocks: Blocks) -> tuple[int, Ints]: ...
def connected_parts(*, positions: Floats, blocks: Blocks) -> Ints: ...
def cell_volumes(*, positions: Floats, blocks: Blocks) -> Floats: ...
def shape_qualities(*, positions: Floats, blocks: Blocks) -> Floats: ...
def jacobian_ranges(*, positions: Floats, blocks: Blocks) -> Floats: ...
def kernel_flags(*, instruction_set: str) -> str: ...
def models() -> list[tuple[str, str, list[str], list[str], dict[str, tuple[str, str]]]]: ...
def laws() -> list[tuple[str, dict[str, float], int, bool, list[int]]]: ...

class LoadedLaw:
    def __init__(self, *, path: str) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def instruction_set(self) -> str: ...
    def compute(self, *, parameters: Floats) -> Floats: ...
    def small_strain(self, *, parameters: Floats) -> tuple[float, float] | None: ...

class World:
    @property
    def blocks(self) -> int: ...
    @property
    def matrix_blocks(self) -> int: ...
    @property
    def elastic_blocks(self) -> list[tuple[str, str, str, int, int, int]]: ...
    @property
    def editable(self) -> bool: ...
    @property
    def mass(self) -> float: ...
    @property
    def threads(self) -> int: ...
    @property
    def instruction_set(self) -> str: ...

class Plane:
    """What holds across a surface: no stress, or no strain."""

    stress: ClassVar[Plane]
    strain: ClassVar[Plane]

class ModelUse:
    def __init__(
        self,
        *,
        name: str = "fem",
        rotation: str = "polar",
        tangent: str = "approximate",
        section: str = "whole",
        drilling: float = 1.0,
        equal_masses: bool = False,
        kept: Ints = ...,
    ) -> None: ...

class WorldBuilder:
    def __init__(
        self,
        *,
        threads: int = 1,
        editable: bool = False,
        links: bool = False,
        consistent_weight: bool = False,
    ) -> None: ...
    def add_body(self, *, name: str, positions: Floats, frames: bool = False) -> int: ...
    def add_elastic(
        self,
        *,
        body: str,
        cell_type: str,
        cells: Ints,
        cell_numbers: Ints,
        law: str,
        parameters: Mapping[str, Floats],
        density: Floats,
        quadrature: str = "full",
        reinforcements: Sequence[tuple[str, Mapping[str, Floats]]] = ...,
        loaded: LoadedLaw | None = None,
        cross_section: Floats = ...,
        plane: Plane = ...,
        model: ModelUse = ...,
    ) -> None: ...
    def add_points(
        self,
        *,
        body: str,
        shared: Sequence[tuple[str, int]],
        frames: Ints,
        weights: Floats,
        gradients: Floats,
        positions: Floats,
        volumes: Floats,
        law: str,
        parameters: Mapping[str, Floats],
        fibres: Mapping[str, Floats],
        loaded: LoadedLaw | None,
        density: float,
        model: ModelUse,
    ) -> None: ...
    def add_rayleigh(self, *, body: str, mass: float, stiffness: float) -> None: ...
    def add_viscosity(
        self,
        *,
        body: str,
        shear: float = 0.0,
        bulk: float = 0.0,
        centroid: float = 0.0,
        branches: Sequence[tuple[float, float]] = (),
    ) -> None: ...
    def add_gravity(self, *, acceleration: Floats) -> None: ...
    def add_load(
        self,
        *,
        name: str,
        body: str,
        nodes: Ints,
        forces: Floats,
        times: Floats,
        factors: Floats,
        moments: bool = False,
    ) -> None: ...
    def add_pressure(
        self,
        *,
        name: str,
        body: str,
        faces: list[tuple[str, Ints]],
        pressure: float,
        times: Floats,
        factors: Floats,
    ) -> None: ...
    def fix(self, *, body: str, nodes: Ints, axes: int = 7, rotations: bool = False) -> None: ...
    def prescribe(
        self,
        *,
        body: str,
        nodes: Ints,
        axes: int,
        times: Floats,
        displacements: Floats,
        angles: Floats,
        center: Floats,
        axis: Floats,
        rotations: bool = False,
    ) -> None: ...
    def build(self) -> World: ...

class Integrator: ...

class ExplicitEuler(Integrator):
    def __init__(self) -> None: ...

class SymplecticEuler(Integrator):
    def __init__(self) -> None: ...

class RungeKutta(Integrator):
    def __init__(self, *, order: int) -> None: ...

class ImplicitEuler(Integrator):
    def __init__(
        self,
        *,
        newton_iterations: int = 1,
        newton_tolerance: float = 1e-6,
        indefinite: str = "project",
    ) -> None: ...

class ImplicitMidpoint(Integrator):
    def __init__(
        self,
        *,
        newton_iterations: int = 1,
        newton_tolerance: float = 1e-6,
        indefinite: str = "project",
    ) -> None: ...

class EnergyMomentum(Integrator):
    def __init__(self, *, newton_iterations: int = 20, newton_tolerance: float = 1e-9) -> None: ...

class Bdf2(Integrator):
    def __init__(
        self,
        *,
        newton_iterations: int = 1,
        newton_tolerance: float = 1e-6,
        indefinite: str = "project",
    ) -> None: ...

class Newmark(Integrator):
    def __init__(
        self,
        *,
        beta: float = 0.25,
        gamma: float = 0.5,
        newton_iterations: int = 1,
        newton_tolerance: float = 1e-6,
        indefinite: str = "project",
    ) -> None: ...

class Bdf2FixedPoint(Integrator):
    def __init__(
        self, *, iterations: int = 50, tolerance: float = 1e-6, anderson: int = 0
    ) -> None: ...

class Static(Integrator):
    def __init__(
        self,
        *,
        newton_iterations: int,
        newton_tolerance: float,
        load_steps: int,
        total_iterations: int = 0,
        arc_length: bool = False,
    ) -> None: ...

class LinearSolver: ...

class ConjugateGradient(LinearSolver):
    def __init__(
        self,
        *,
        tolerance: float = 1e-6,
        iterations: int = 1000,
        preconditioner: str = "block_jacobi",
        precision: str = "double",
        matrix: str = "assembled",
    ) -> None: ...

class Cholesky(LinearSolver):
    def __init__(self) -> None: ...

class StepReport:
    @property
    def time(self) -> float: ...
    @property
    def newton_iterations(self) -> int: ...
    @property
    def solver_iterations(self) -> int: ...
    @property
    def residual(self) -> float: ...
    @property
    def indefinite(self) -> int: ...
    @property
    def converged(self) -> bool: ...
    @property
    def milliseconds(self) -> float: ...
    @property
    def message(self) -> str: ...

class Simulation:
    def __init__(
        self, *, world: World, integrator: Integrator, solver: LinearSolver | None
    ) -> None: ...
    def step(self, dt: float) -> StepReport: ...
    @property
    def time(self) -> float: ...
    @time.setter
    def time(self, value: float) -> None: ...
    @property
    def integrator_name(self) -> str: ...
    @property
    def solver_name(self) -> str: ...
    @property
    def positions(self) -> Floats: ...
    @property
    def velocities(self) -> Floats: ...
    def rotations(self, body: str) -> Floats: ...
    def points(self, body: str) -> Floats: ...
    def body_range(self, body: str) -> tuple[int, int]: ...
    def energy(self) -> dict[str, float]: ...
    def cell_fields(self, body: str) -> dict[str, Floats]: ...
    def inverted_cells(self, body: str) -> Ints: ...
    def profile_rows(self) -> list[tuple[str, str, int, float]]: ...
    def profile_solves(self) -> tuple[int, int, int, int, float]: ...
    def profile_steps(self) -> int: ...
    def profile_step_seconds(self) -> Floats: ...
    def profile_clear(self) -> None: ...
    def remove_cells(self, *, body: str, cells: Ints) -> None: ...
    def settle(self) -> None: ...
    def reactions(self) -> Floats: ...
    def solver_bytes(self) -> int: ...
    def stable_step(self) -> float: ...
    def largest_frequency(self) -> float: ...
    def remaining_cells(self, body: str) -> Ints: ...
    def snapshot(self) -> dict[str, Any]: ...
    def restore(self, snapshot: dict[str, Any]) -> None: ...
