"""The scenes: each with its contact, and without it as something that steps the same cells."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from tissu import scene as parts
from tissu.front import Scene
from tissu.mesh import Mesh, bar_mesh

GRAVITY = 9.81  # m/s2
DENSITY = 1000.0  # kg/m3
SIDE = 0.05  # m, of a cube
MU = 0.5
DOWN = (0.0, 0.0, -GRAVITY)
FLOOR = {"floor": parts.PlaneObstacle((0, 0, 0), (0, 0, 1))}
WINDOW = 50  # steps at the end, in which what should rest rests


@dataclass(frozen=True)
class Case:
    """A scene and what is asked of it.

    Attributes:
        name: what it is called.
        scene: with its contact.
        without: the same bodies without contact; nodes that would rest on something are held.
        force: what the floor should carry at the end [N]; None: not asked.
        joints: between which bodies the weight above should go, lowest first.
        slides: acceleration along x that it should have [m/s2]; 0: it sticks; None: not asked.
        dt: of a step [s].
    """

    name: str
    scene: Callable[[], Scene]
    without: Callable[[], Scene]
    force: float | None = None
    joints: tuple[str, ...] = ()
    slides: float | None = None
    dt: float = 0.01


def _block(mesh: parts.BarMesh | Mesh, *, young: str = "100 kPa", **fields: object) -> parts.Body:
    law = parts.StableNeoHooke(young=young, poisson=0.3)
    damped = parts.Rayleigh(mass=2.0, stiffness=0.005)
    given: dict[str, object] = {"law": law, "density": DENSITY, "viscosity": damped}
    return parts.Body(**{"mesh": mesh, **given, **fields})  # type: ignore[arg-type]


def _cube(cells: int, height: float) -> parts.Body:
    size = (SIDE, SIDE, SIDE)
    split = {"cells": (cells, cells, cells), "cell": "tetra", "origin": (0, 0, height)}
    return _block(parts.BarMesh(size=size, **split))  # type: ignore[arg-type]


def _held(bodies: dict[str, parts.Body], bottoms: dict[str, float], **fields: object) -> Scene:
    """The bodies without contact, the bottom of each held."""
    fixed = [parts.Fixed(name, on=parts.Plane((0, 0, z), (0, 0, 1))) for name, z in bottoms.items()]
    return _stepped(bodies, fixed=fixed, **fields)


def _stepped(bodies: dict[str, parts.Body], **fields: object) -> Scene:
    given = {"gravity": DOWN, "step": parts.ImplicitEuler("10 ms"), **fields}
    return Scene(bodies=bodies, **given)  # type: ignore[arg-type]


def _met(bodies: dict[str, parts.Body], friction: float, **fields: object) -> Scene:
    every = [parts.Contact("all", friction=friction)]
    return _stepped(bodies, **{"obstacles": FLOOR, "contacts": every, **fields})


def cube() -> Case:
    """A cube of 1,296 tetrahedra that falls 2 cm."""
    bodies, low = {"cube": _cube(6, 0.02)}, {"cube": 0.02}
    return Case(
        "cube of 1,296 cells, dropped 2 cm on a plane",
        lambda: _met(bodies, 0.0, duration=1.5),
        lambda: _held(bodies, low, duration=0.5),
        force=DENSITY * SIDE**3 * GRAVITY,
    )


def stack() -> Case:
    """Five cubes of 384 tetrahedra, each 1 mm above the one below."""
    heights = {f"cube {k + 1}": 0.001 + k * (SIDE + 0.001) for k in range(5)}
    bodies = {name: _cube(4, z) for name, z in heights.items()}
    return Case(
        "stack of 5 cubes of 384 cells",
        lambda: _met(bodies, MU, duration=3.0),
        lambda: _held(bodies, heights, duration=0.5),
        force=5 * DENSITY * SIDE**3 * GRAVITY,
        joints=tuple(bodies),
    )


def slope(tangent: float) -> Case:
    """A block on a plane of friction 0.5, on which gravity leans."""
    low = 0.001
    shape = {"cells": (4, 4, 2), "cell": "hexahedron", "origin": (0, 0, low)}
    # Damping in proportion to the mass would hold back what slides.
    damped = parts.Rayleigh(mass=0.0, stiffness=0.01)
    block = _block(parts.BarMesh(size=(0.1, 0.1, 0.05), **shape), viscosity=damped)  # type: ignore[arg-type]
    bodies = {"block": block}
    cosine = 1.0 / np.hypot(1.0, tangent)
    leaning = {"gravity": (GRAVITY * cosine * tangent, 0, -GRAVITY * cosine)}
    return Case(
        f"slope of tan {tangent}, friction {MU}",
        lambda: _met(bodies, MU, duration=2.0, **leaning),
        lambda: _held(bodies, {"block": low}, duration=0.5, **leaning),
        force=DENSITY * 5e-4 * GRAVITY * cosine,
        slides=GRAVITY * cosine * max(0.0, tangent - MU),
    )


def bar(drop: float) -> Case:
    """A bar of 10,368 tetrahedra above a table."""
    shape = {"cells": (48, 6, 6), "cell": "tetra", "origin": (0, 0, drop)}
    bodies = {"bar": _block(parts.BarMesh(size=(0.4, 0.05, 0.05), **shape))}  # type: ignore[arg-type]
    how = "resting on a table" if drop < 0.01 else f"dropped {drop} m on a table"
    return Case(
        f"bar of 10,368 cells, {how}",
        lambda: _met(bodies, 0.0, duration=1.0 if drop < 0.01 else 1.5),
        lambda: _held(bodies, {"bar": drop}, duration=0.3),
        force=DENSITY * 1e-3 * GRAVITY,
    )


def fold() -> Case:
    """A sheet of 5,000 triangles, whose end is led round onto the part that is held."""
    flat = parts.BarMesh(size=(0.2, 0.05, 0), cells=(100, 25, 0), cell="triangle")
    law = parts.Hooke(young="30 kPa", poisson=0.3)
    damped = parts.Rayleigh(mass=5.0, stiffness=0.01)
    sheet = parts.Body(
        mesh=flat, model="shell", law=law, density=1100.0, thickness=0.002, viscosity=damped
    )
    half = parts.Rotation(axis=(0, -1, 0), center=(0.13, 0, 0.0012), angles=(0, "180 deg"))
    end, still = parts.Plane((0.2, 0, 0), (1, 0, 0)), ((0, 0, 0), (0, 0, 0))
    lead = parts.Prescribed("sheet", on=end, times=(0, 0.3), displacements=still, rotation=half)
    given = {
        "fixed": [parts.Fixed("sheet", on=parts.Box(max=(0.05, None, None)))],
        "prescribed": [lead],
        "duration": 0.5,
    }
    table = {"floor": parts.PlaneObstacle((0, 0, -0.0012), (0, 0, 1))}
    return Case(
        "sheet of 5,000 triangles, turned over onto itself",
        lambda: _met({"sheet": sheet}, 0.3, **{**given, "obstacles": table}),
        lambda: _stepped({"sheet": sheet}, **given),
    )


def ball() -> Case:
    """A ball at 100 m/s against a thin slab that is held at its rim."""
    cells = bar_mesh(size=(2, 2, 2), cells=(6, 6, 6), origin=(-1, -1, -1))
    rounded = cells.points * (
        np.abs(cells.points).max(axis=1, keepdims=True)
        / np.maximum(np.linalg.norm(cells.points, axis=1, keepdims=True), 1e-12)
    )
    mesh = Mesh(points=0.01 * rounded + np.array([0.0, 0.0, 0.03]), cells=cells.cells)
    shape = {"cells": (20, 20, 1), "cell": "tetra", "origin": (-0.1, -0.1, 0)}
    slab = _block(parts.BarMesh(size=(0.2, 0.2, 0.005), **shape), young="20 kPa")  # type: ignore[arg-type]
    thrown = _block(mesh, start=parts.Start(velocity=(0, 0, -100.0)))
    bodies = {"slab": slab, "ball": thrown}
    rim = [
        parts.Fixed("slab", on=parts.Plane(tuple(0.1 * s * axis), tuple(axis)))
        for axis in np.eye(3)[:2]
        for s in (-1.0, 1.0)
    ]
    given = {"gravity": None, "fixed": rim, "duration": 0.3}
    met = [parts.Contact(("ball", "slab"))]
    return Case(
        "ball at 100 m/s against a slab of 5 mm",
        lambda: _stepped(bodies, contacts=met, **given),
        lambda: _stepped(bodies, **given),
    )


CASES: dict[str, Callable[[], Case]] = {
    "cube": cube,
    "stack": stack,
    "stick": lambda: slope(0.45),
    "slide": lambda: slope(0.55),
    "rest": lambda: bar(0.001),
    "drop": lambda: bar(0.5),
    "fold": fold,
    "ball": ball,
}
