"""Repairs of the bar of bench/seed_cuts.py after cuts that cross each other, and a new mesh."""

from __future__ import annotations

from typing import Any

import numpy as np
from carriers import SIZE
from seed_bar import bad, bar, blades

import tissu as ts
from tissu.cutting.quality import Quality, quality_of

ROUNDS, PLANES = 10, 4

Array = np.ndarray[Any, Any]


def crossed(
    method: str, repair: ts.Repair | None, first: int = 0, count: int = PLANES
) -> tuple[ts.Simulation, list[ts.CutReport]]:
    """Planes through the bar one after the other."""
    simulation = bar(method, repair=repair)
    planes = blades()[first : first + count]
    return simulation, [simulation.cut("bar", ts.Plane(*plane)) for plane in planes]


def repaired(method: str, repair: ts.Repair | None) -> list[str]:
    """What is left after planes that cross each other, and what was done about it."""
    cells = short = flat = 0
    shape = radii = 1.0
    made, volume = np.zeros(3, dtype=int), 0.0
    for turn in range(ROUNDS):
        simulation, reports = crossed(method, repair, PLANES * turn)
        quality = simulation.quality("bar", rest=True)
        cells += len(quality.volume)
        short += int(quality.has_short_edge.sum())
        flat += int(quality.is_flat.sum())
        shape, radii = min(shape, quality.shape.min()), min(radii, quality.radii.min())
        volume = max(volume, abs(quality.volume.sum() / SIZE.prod() - 1.0))
        for report in reports:
            if report.repairs is not None:
                done = report.repairs
                made += (done.collapses, done.flips, done.moves)
    return [
        method + (", repaired" if repair else ""),
        f"{cells / ROUNDS:.0f}",
        f"{short / ROUNDS:.1f}",
        f"{flat / ROUNDS:.1f}",
        f"{shape:.3f}",
        f"{radii:.3f}",
        *(f"{count / ROUNDS:.1f}" for count in made),
        f"{volume:.0e}",
    ]


def collapsed() -> list[list[str]]:
    """The first collapse of a short edge: the bar before it and after it."""
    for turn in range(ROUNDS):
        for count in range(1, PLANES + 1):
            simulation, reports = crossed("subdivide", ts.Repair(most=1), PLANES * turn, count)
            done = reports[-1].repairs
            if done is None or not done.collapses:
                continue
            before, _ = crossed("subdivide", ts.Repair(most=1), PLANES * turn, count - 1)
            before = without_repair(before, blades()[PLANES * turn + count - 1])
            return [of_collapse("before", before), of_collapse("after", simulation)]
    raise RuntimeError("no edge was collapsed")


def without_repair(simulation: ts.Simulation, plane: tuple[Array, Array]) -> ts.Simulation:
    """One more cut, after which nothing is repaired."""
    editing = simulation.scene.editing
    assert editing is not None
    object.__setattr__(
        simulation, "scene", simulation.scene.replace(editing=editing.replace(repair=None))
    )
    simulation.cut("bar", ts.Plane(*plane))
    return simulation


def of_collapse(name: str, simulation: ts.Simulation) -> list[str]:
    """Cells and their worst measures."""
    quality = simulation.quality("bar", rest=True)
    return [
        name,
        str(len(quality.volume)),
        str(int(quality.has_short_edge.sum())),
        f"{quality.edges.min():.3f}",
        f"{quality.shape.min():.3f}",
        f"{quality.radii.min():.3f}",
        f"{1e6 * quality.volume.sum():.9f}",
    ]


def new_mesh(simulation: ts.Simulation) -> tuple[Quality, list[str]]:
    """A Delaunay mesh of the nodes around bad cells, in place of the cells there."""
    from scipy.spatial import Delaunay

    points = np.asarray(simulation.meshes["bar"].points)
    cells = np.concatenate([block.nodes for block in simulation.meshes["bar"].body_blocks])
    quality = simulation.quality("bar", rest=True)
    near = np.isin(cells, cells[quality.has_short_edge | quality.is_flat]).any(axis=1)
    kept, lost, off = [cells[~near]], 0, 0.0
    for patch in parts(cells[near]):
        nodes = np.unique(patch)
        made = nodes[Delaunay(points[nodes]).simplices]
        volumes = np.linalg.det(points[made[:, 1:]] - points[made[:, :1]])
        made = np.where((volumes < 0)[:, None], made[:, [0, 1, 3, 2]], made)
        made = made[(np.abs(volumes) > 1e-18) & inside(points[made].mean(axis=1), points[patch])]
        lost += len(border(patch) - border(made))
        whole = np.linalg.det(points[patch[:, 1:]] - points[patch[:, :1]]).sum()
        off += abs(np.linalg.det(points[made[:, 1:]] - points[made[:, :1]]).sum() - whole) / 6
        kept.append(made)
    remade = quality_of(points[np.concatenate(kept)])
    return remade, [
        str(bad(quality)),
        str(bad(remade)),
        str(lost),
        f"{100 * off / SIZE.prod():.2f} %",
    ]


def parts(cells: Array) -> list[Array]:
    """Cells that faces join."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    faces = np.sort(np.concatenate([np.delete(cells, i, axis=1) for i in range(4)]), axis=1)
    number = np.unique(faces, axis=0, return_inverse=True)[1].reshape(-1)
    owner = np.tile(np.arange(len(cells)), 4)
    shape = (len(cells), int(number.max()) + 1)
    of_face = coo_array((np.ones(len(owner)), (owner, number)), shape=shape)
    count, label = connected_components(of_face @ of_face.T, directed=False)
    return [cells[label == i] for i in range(count)]


def border(cells: Array) -> set[tuple[int, ...]]:
    """Faces that one cell alone has."""
    faces = np.sort(np.concatenate([np.delete(cells, i, axis=1) for i in range(4)]), axis=1)
    found, counts = np.unique(faces, axis=0, return_counts=True)
    return set(map(tuple, found[counts == 1].tolist()))


def inside(places: Array, corners: Array) -> Array:
    """Whether places (n, 3) lie in one of the tetrahedra (m, 4, 3)."""
    inverse = np.linalg.inv(np.swapaxes(corners[:, 1:] - corners[:, :1], 1, 2))
    weights = np.einsum("cij,ncj->nci", inverse, places[:, None] - corners[None, :, 0])
    return np.asarray(
        ((weights > -1e-9).all(axis=2) & (weights.sum(axis=2) < 1 + 1e-9)).any(axis=1)
    )
