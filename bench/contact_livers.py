"""Two real livers that are pushed together, head-on and glancing: cases of bench/contact.py.

The mesh, `liver.msh` (Gmsh 1, centimetres, 596 tetrahedra), is from SOFA's repository, share/mesh.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np

import tissu as ts
from tissu.contact_cost.scenes import Case

HELD = 0.008  # of each, at the side away from the other [m]
DEEP = 0.01  # that they are pushed together [m]
CLEAR = 1e-3  # between them where they begin, as near as they come [m]
SECONDS = 0.4  # of the push; the run is twice as long


def turned(mesh: ts.Mesh) -> ts.Mesh:
    """The same liver upside down."""
    return ts.Mesh(points=mesh.points * (1.0, -1.0, -1.0), cells=mesh.cells)


def moved(mesh: ts.Mesh, way: np.ndarray) -> ts.Mesh:
    """The same liver elsewhere."""
    return ts.Mesh(points=mesh.points + way, cells=mesh.cells)


def scene(low: ts.Mesh, high: ts.Mesh, way: np.ndarray, *, contacts: bool = True) -> ts.Scene:
    """The lower liver is held below; the top of the upper one goes along `way`."""
    bottom, top = low.points[:, 2].min() + HELD, high.points[:, 2].max() - HELD
    law = ts.StableNeoHooke(young="5 kPa", poisson=0.45)
    soft = ts.Rayleigh(mass="10 1/s", stiffness="20 ms")
    bodies = {
        name: ts.Body(mesh=mesh, law=law, density="1.05 g/cm^3", viscosity=soft)
        for name, mesh in (("low", low), ("high", high))
    }
    return ts.Scene(
        bodies=bodies,
        contacts=[ts.Contact(("low", "high"), friction=0.3)] if contacts else (),
        fixed=[ts.Fixed("low", on=ts.Box(max=(None, None, bottom)))],
        prescribed=[
            ts.Prescribed(
                "high",
                on=ts.Box(min=(None, None, top)),
                times=(0, SECONDS),
                displacements=((0, 0, 0), tuple(way)),
            )
        ],
        step=ts.ImplicitEuler("10 ms"),
        duration=2 * SECONDS,
    )


def overlap(low: ts.Mesh, high: ts.Mesh) -> bool:
    """Whether they do where they are."""
    try:
        scene(low, high, np.zeros(3)).compile()
    except ts.TissuError:
        return True
    return False


def least_height(low: ts.Mesh, high: ts.Mesh) -> float:
    """By how much the upper one is to be raised so that it just clears the lower one [m]."""
    above = float(np.ptp(low.points[:, 2]) + np.ptp(high.points[:, 2]))
    below = 0.0
    while above - below > 0.1 * CLEAR:
        middle = 0.5 * (above + below)
        if overlap(low, moved(high, np.array([0.0, 0.0, middle]))):
            below = middle
        else:
            above = middle
    return above + CLEAR


def cases(folder: Path) -> Iterator[Case]:
    """Head-on and glancing, on the mesh as it is and with every edge halved."""
    liver = ts.read_mesh(folder / "liver.msh", unit="cm")
    low = moved(liver, -0.5 * (liver.points.min(axis=0) + liver.points.max(axis=0)))
    high = turned(low)
    width = float(np.ptp(low.points[:, 0]))
    for _ in range(2):
        height = least_height(low, high)
        cells = 2 * low.cell_count
        pushes = {
            "head-on": (np.array([0.0, 0.0, height]), np.array([0.0, 0.0, -CLEAR - DEEP])),
            "glancing": (np.array([-width, 0.0, height - DEEP]), np.array([width, 0.0, 0.0])),
        }
        for how, (place, way) in pushes.items():
            of = partial(scene, low, moved(high, place), way)
            name = f"two livers of {cells:,} cells pushed together by 1 cm, {how}, friction 0.3"
            yield Case(name, of, partial(of, contacts=False))
        low, high = ts.refined(low), ts.refined(high)
