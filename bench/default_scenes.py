"""The scenes and the fixed choices against which bench/defaults.py holds `solver: auto`."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import tissu as ts

ROOT = Path(__file__).resolve().parents[1]
PERIOD, SWINGS, SHARE = 16, 800, 2e-3
"""steps in which supports go up and down, half periods of it, and the way as a share of the body"""
STVK = {"young": "50 kPa", "poisson": 0.3}
STIFFER = {"young": "200 kPa", "poisson": 0.3}
"""of long bars, in whose collapse at 50 kPa steps fail, now with one solver and now with another"""


def fixed(tolerance: float) -> dict[str, Any]:
    """Every fixed choice, with enough iterations for each."""
    gradient = ts.ConjugateGradient(tolerance=tolerance, iterations=20_000, precision="single")
    kinds = ("block_jacobi", "incomplete_cholesky", "multigrid")
    return {
        **{kind: gradient.replace(preconditioner=kind) for kind in kinds},
        "stale_cholesky": gradient.replace(preconditioner="stale_cholesky", precision="double"),
        "cholesky": ts.Cholesky(),
    }


def cells_for(unknowns: float, shape: tuple[float, float, float]) -> tuple[int, int, int]:
    """Cells along a bar whose edges are in the ratio of `shape`, for so many unknowns."""
    edge = (unknowns / 3 / np.prod(shape)) ** (1 / 3)
    first, second, third = (max(1, round(edge * side) - (side == 1.0)) for side in shape)
    return first, second, third


def shaken(scene: ts.Scene, extent: float) -> ts.Scene:
    """The scene with supports that go up and down in steps of time, so that it comes to no rest.

    What is at rest needs no iteration, and the times of its solves say nothing about a solver.
    """
    if isinstance(scene.step, ts.Static):
        return scene
    times = 0.5 * PERIOD * scene.step.dt * np.arange(SWINGS)
    heights = SHARE * extent * (np.arange(SWINGS) % 2)
    path = [(0.0, 0.0, height) for height in heights]
    moved = [
        ts.Prescribed(
            support.body, on=support.on, axes=support.axes, times=times, displacements=path
        )
        for support in scene.fixed
    ]
    return scene.replace(fixed=[], prescribed=[*scene.prescribed, *moved])


def held(mesh: Any, step: Any, *, law: Any = None, **body: Any) -> ts.Scene:
    """A body held at x = 0 that hangs by its weight, and is shaken in steps of time."""
    fields = {"law": law or ts.StVK(**STVK), "density": 1000.0, **body}  # type: ignore[arg-type]
    extent = max(mesh.size) if isinstance(mesh, ts.BarMesh) else float(np.ptp(mesh.points))
    scene = ts.Scene(
        bodies={"body": ts.Body(mesh=mesh, **fields)},
        gravity=(0, 0, -9.81),
        fixed=[ts.Fixed("body", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        step=step,
    )
    return shaken(scene, extent)


def bar(unknowns: float, step: Any, **body: Any) -> ts.Scene:
    """Eight times as long as wide, of 50 MPa: the bar of the docs."""
    mesh = ts.BarMesh(size=(8, 1, 1), cells=cells_for(unknowns, (8, 1, 1)))
    return held(mesh, step, law=ts.StVK(young="50 MPa", poisson=0.3), **body)


def cube(unknowns: float, step: Any, **body: Any) -> ts.Scene:
    """Of 10 cm, soft."""
    mesh = ts.BarMesh(size=(0.1, 0.1, 0.1), cells=cells_for(unknowns, (1, 1, 1)))
    return held(mesh, step, **body)


def hexahedra(unknowns: float, step: Any) -> ts.Scene:
    """The bar of hexahedra."""
    cells = cells_for(unknowns, (8, 1, 1))
    law = ts.StVK(young="50 MPa", poisson=0.3)
    return held(ts.BarMesh(size=(8, 1, 1), cells=cells, cell="hexahedron"), step, law=law)


def plate(unknowns: float, step: Any) -> ts.Scene:
    """A plate fifty times as wide as thick, two cells through."""
    side = max(3, round((unknowns / 9) ** 0.5) - 1)
    mesh = ts.BarMesh(size=(0.2, 0.2, 0.004), cells=(side, side, 2), cell="hexahedron")
    return held(mesh, step, law=ts.StVK(young="5 MPa", poisson=0.3))


def slivers(unknowns: float, step: Any) -> ts.Scene:
    """The cube with its layers pressed to a tenth towards the floor."""
    cells = cells_for(unknowns, (1, 1, 1))
    mesh = ts.bar_mesh(size=(0.1, 0.1, 0.1), cells=cells, cell="tetra")
    points = mesh.points.copy()
    points[:, 0] = 0.1 * (points[:, 0] / 0.1) ** 2.5
    return held(ts.Mesh(points=points, cells=mesh.cells), step)


def contrast(unknowns: float, step: Any) -> ts.Scene:
    """The cube with a core a million times as stiff."""
    core = ts.Box((0.04, 0.03, 0.03), (0.08, 0.07, 0.07))
    mesh = ts.BarMesh(
        size=(0.1, 0.1, 0.1), cells=cells_for(unknowns, (1, 1, 1)), regions={"core": core}
    )
    law = {
        "core": ts.StVK(young="50 GPa", poisson=0.3),
        "rest": ts.StVK(young="50 kPa", poisson=0.3),
    }
    return held(mesh, step, law=law)


def rubber(unknowns: float, step: Any) -> ts.Scene:
    """The cube of hexahedra with nu 0.499."""
    mesh = ts.BarMesh(size=(0.1, 0.1, 0.1), cells=cells_for(unknowns, (1, 1, 1)), cell="hexahedron")
    return held(mesh, step, law=ts.StVK(young="50 kPa", poisson=0.499))


def shell(unknowns: float, step: Any) -> ts.Scene:
    """A sheet of six degrees of freedom a node."""
    side = max(3, round((unknowns / 6) ** 0.5) - 1)
    mesh = ts.BarMesh(size=(0.2, 0.2, 0), cells=(side, side, 0), cell="triangle")
    law = ts.Hooke(young="5 MPa", poisson=0.3)
    return held(mesh, step, law=law, model="shell", thickness=0.004)


def frames(unknowns: float, step: Any) -> ts.Scene:
    """A bar of frames."""
    mesh = ts.BarMesh(
        size=(0.4, 0.1, 0.1), cells=cells_for(unknowns / 2, (4, 1, 1)), cell="hexahedron"
    )
    return held(mesh, step, law=ts.StVK(**STIFFER), model="frames")  # type: ignore[arg-type]


def condensed(unknowns: float, step: Any) -> ts.Scene:
    """A bar whose far half is condensed; the unknowns of the whole are counted."""
    cells = cells_for(unknowns, (2, 1, 1))
    near = ts.Box((None, None, None), (0.1001, None, None))
    mesh = ts.BarMesh(size=(0.2, 0.1, 0.1), cells=cells, cell="hexahedron", regions={"near": near})
    law = ts.Hooke(**STVK)  # type: ignore[arg-type]
    return held(mesh, step, law=law, model={"near": "fem", "rest": "condensed"})


def mixed(unknowns: float, step: Any) -> ts.Scene:
    """A bar of wedges, hexahedra and tetrahedra."""
    cells = cells_for(unknowns, (3, 1, 1))
    segments = "1 wedge6:stvk, 1 hex8:stvk, 1 tet4:stvk".replace("1 ", "")
    cells = (max(3, 3 * (cells[0] // 3)), *cells[1:])
    mesh = ts.BarMesh(size=(0.3, 0.1, 0.1), cells=cells, segments=segments)
    return held(mesh, step, law=ts.StVK(**STIFFER))  # type: ignore[arg-type]


def organ(_: float, step: Any) -> ts.Scene:
    """The organ of the examples: one size."""
    scene = ts.Scene.from_yaml(ROOT / "examples" / "organ.yaml")
    return shaken(scene.replace(step=step, output=None), 0.1)


def cut(unknowns: float, step: Any) -> ts.Scene:
    """The cube with `editing`: bench/defaults.py takes cells out while it runs."""
    return cube(unknowns, step).replace(editing=True)


def read_scenes(folder: Path | None) -> dict[str, Callable[[float, Any], ts.Scene]]:
    """The liver and the phantom, of one size each; bench/liver.py and phantom.py name meshes."""
    if folder is None:
        return {}
    import liver
    import phantom

    organ_of = liver.scene_of(ts.read_mesh(folder / "liver.msh", unit="cm"))
    hexahedra = ts.read_mesh(folder / "cylinder_Hexa.msh", unit="m")
    silicone = phantom.scene_of(hexahedra, "stvk")
    return {
        "liver": lambda _, step: shaken(organ_of.replace(step=step, output=None), 0.2),
        "phantom": lambda _, step: shaken(silicone.replace(step=step), 0.06),
    }


SCENES: dict[str, Callable[[float, Any], ts.Scene]] = {
    **{
        "bar": bar,
        "bar of hexahedra": hexahedra,
        "cube": cube,
        "organ": organ,
        "thin plate": plate,
    },
    **{"slivers": slivers, "contrast 1e6": contrast, "nu 0.499": rubber, "shell": shell},
    **{"frames": frames, "half condensed": condensed, "mixed cells": mixed, "cut": cut},
}
