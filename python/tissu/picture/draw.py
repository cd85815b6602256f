"""A simulation at rest and as it stands now, side by side."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tissu.errors import ParameterError
from tissu.mesh.thin import line_pieces
from tissu.picture import layout
from tissu.picture.camera import Camera, look_at
from tissu.picture.dots import dots
from tissu.picture.obstacles import Obstacles, obstacles_of, render_beside
from tissu.picture.rod import LINE, rods, rods_values
from tissu.picture.surface import CLAY, FINER, Layer, flatten, render_layer

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from tissu.simulation import Simulation

Array = NDArray[np.float64]
Ints = NDArray[np.int32]
Field = Literal["displacement", "von_mises"]

LABELS = {"displacement": "displacement", "von_mises": "von Mises stress"}


@dataclass(frozen=True, slots=True)
class Shape:
    """The surfaces of all bodies as one.

    Attributes:
        rest: (n,3) points at rest [m].
        now: (n,3) points now [m].
        triangles: (t,3) numbers of points.
        values: (n,) what is coloured, in SI units.
    """

    rest: Array
    now: Array
    triangles: NDArray[np.int64]
    values: Array


def draw(
    simulation: Simulation,
    path: str | PathLike[str],
    *,
    size: tuple[int, int] = (1600, 800),
    field: Field = "displacement",
    towards: ArrayLike | None = None,
) -> None:
    """Writes a PNG of the bodies at rest and now, same view and scale, coloured by a field.

    Obstacles are grey, and slightly transparent in front of a body.

    Args:
        simulation: what is drawn.
        path: the PNG file; its folder is made.
        size: width and height [pixels], at least 200 x 100.
        field: "displacement" [m] or "von_mises" [Pa], the latter averaged at the surface's points.
            A body with a `surface_of` is drawn by that mesh.
        towards: (3,) direction from the bodies to the viewer, such as (0, -1, 0); none: square
            onto their longest horizontal axis, turned by 28 degrees and raised by 22.

    Raises:
        ParameterError: an unknown field, von_mises of a model without stress, a picture too small
            for its text, or a direction that is not three finite numbers or is zero.
        TissuError: the file cannot be written.
    """
    if field not in LABELS:
        raise ParameterError(f"field '{field}'; accepted: {', '.join(LABELS)}")
    draw_shape(
        shape_of(simulation, field),
        path,
        title=simulation.scene.name,
        time=simulation.time,
        up=up_of(simulation),
        towards=towards,
        size=size,
        field=field,
        obstacles=obstacles_of(simulation),
    )


def up_of(simulation: Simulation) -> Array:
    """What points to the top: against gravity; without it z, or y of flat bodies."""
    gravity = simulation.scene.gravity
    if gravity is not None and np.any(gravity):
        return -np.asarray(gravity, dtype=np.float64)
    flat = all(np.ptp(mesh.points[:, 2]) == 0 for mesh in simulation.meshes.values())
    return np.array([0.0, 1.0, 0.0] if flat else [0.0, 0.0, 1.0])


def draw_shape(
    shape: Shape,
    path: str | PathLike[str],
    *,
    title: str,
    time: float,
    up: ArrayLike = (0.0, 0.0, 1.0),
    size: tuple[int, int] = (1600, 800),
    field: Field = "displacement",
    obstacles: Obstacles | None = None,
    towards: ArrayLike | None = None,
) -> None:
    """Writes a PNG of a shape at rest and deformed, and of obstacles; see `draw`."""
    if size[0] < 200 or size[1] < 100:
        found = f"{size[0]} x {size[1]} pixels"
        raise ParameterError(f"a picture of {found}; at least 200 x 100 is needed")
    figure, text = layout.sheet(size), layout.letters(size)
    left, wide, top = round(0.01 * size[0]), round(0.44 * size[0]), round(0.12 * size[1])
    panel_size = (wide, size[1] - top - round(0.02 * size[1]))
    seen = [shape.rest, shape.now]
    if obstacles is not None:
        seen += obstacles.in_view(np.concatenate(seen))
    camera = look_at(seen, size=panel_size, up=up, towards=towards)
    _panels(figure, shape, obstacles, camera, (left, top), field)

    shift = float(np.linalg.norm(shape.now - shape.rest, axis=1).max(initial=0.0))
    moved = f"moved by up to {layout.shown_length(shift)}"
    words = (title, "at rest"), (f"t = {time:.4g} s", moved)
    for k, (head, below) in enumerate(words):
        middle = (left + (k + 0.5) * wide) / size[0]
        figure.text(middle, 0.945, head, ha="center", fontsize=1.35 * text, color=layout.INK)
        figure.text(middle, 0.895, below, ha="center", fontsize=text, color=layout.FAINT)
    layout.save(figure, Path(path))


def _panels(
    figure: Figure,
    shape: Shape,
    obstacles: Obstacles | None,
    camera: Camera,
    corner: tuple[int, int],
    field: Field,
) -> None:
    """Both shapes from a corner of the sheet [pixels] on, and the colour bar beside them."""
    size = tuple(round(s * layout.DPI) for s in figure.get_size_inches())
    text, (left, top), wide = layout.letters((size[0], size[1])), corner, camera.size[0]
    factor, unit, limits = _scale(shape.values, field)
    colours, values, fine = layout.colours(), shape.values * factor, camera.enlarged(FINER)
    at_rest = render_layer(shape.rest, shape.triangles, None, camera=fine, colour=CLAY)
    deformed = render_layer(
        shape.now,
        shape.triangles,
        values,
        camera=fine,
        colour=CLAY,
        colormap=colours,
        limits=limits,
    )
    alone = flatten(at_rest.colour, at_rest.covered.astype(np.float64))
    first = layout.panel(figure, left, top, camera)
    layout.place(first, _beside(at_rest, obstacles, camera, rest=True), camera)
    layout.length_bar(first, camera, text)
    second = layout.panel(figure, left + wide, top, camera)
    layout.outline(second, alone[..., 3])
    layout.place(second, _beside(deformed, obstacles, camera, rest=False), camera)
    bar = ((left + 2 * wide) / size[0] + 0.012, 0.16, 0.014, 0.62)
    layout.colour_bar(figure, bar, limits, f"{LABELS[field]} [{unit}]", text, colours)


def _beside(body: Layer, obstacles: Obstacles | None, camera: Camera, *, rest: bool) -> Array:
    """A body, and the obstacles beside it, as RGBA (h,w,4)."""
    if obstacles is None:
        return flatten(body.colour, body.covered.astype(np.float64))
    points = obstacles.rest if rest else obstacles.now
    return render_beside(body, points, obstacles.triangles, camera=camera)


def shape_of(simulation: Simulation, field: Field) -> Shape:
    """The surfaces of all bodies of a simulation, and the field at their points."""
    parts: list[Shape] = []
    for name, mesh in simulation.meshes.items():
        if simulation.is_cut(name):
            parts.extend(_cut(simulation, name, field))
            continue
        if name in simulation.own_surfaces:
            parts.append(_own_surface(simulation, name, field))
            continue
        surface = mesh.surface()
        triangles = np.asarray(surface.triangles, dtype=np.int64)
        shift = np.asarray(simulation.displacements(name))
        now = np.asarray(simulation.positions[name])
        if field == "displacement":
            values = np.linalg.norm(shift, axis=1)
        else:
            every = _stress_of(simulation, name)
            values = _at_points(every[np.asarray(surface.cells)], triangles, now)
        used, numbers = np.unique(triangles, return_inverse=True)
        parts.append(
            Shape((now - shift)[used], now[used], numbers.reshape(triangles.shape), values[used])
        )
        ends, of_lines = line_pieces(mesh)
        if len(ends):
            radius = LINE * float(np.linalg.norm(np.ptp(now - shift, axis=0)))
            at_ends = values[ends]
            if field != "displacement":
                at_ends = np.repeat(every[of_lines][:, None], 2, axis=1)
            parts.append(_rods(now - shift, now, ends, at_ends, radius))
    for name in simulation.tissue:
        of_tissue = _met_tissue if name in simulation.own_surfaces else _tissue
        parts.append(of_tissue(simulation, name, field))
    return _joined(parts)


def _cut(simulation: Simulation, name: str, field: Field) -> Iterator[Shape]:
    """The surface of the material of a body that was cut, and its pieces of lines."""
    surface = simulation.surface(name)
    shift = surface.carried(np.asarray(simulation.displacements(name)))
    triangles, rest = np.asarray(surface.triangles, dtype=np.int64), surface.points - shift
    values = np.linalg.norm(shift, axis=1)
    ends = values[surface.lines]
    if field != "displacement":
        every, cells = _stress_of(simulation, name), simulation.remaining_cells(name)
        ends = np.tile(every[np.searchsorted(cells, surface.line_cell)], (2, 1)).T
        values = _at_points(every[np.searchsorted(cells, surface.cell)], triangles, surface.points)
    if len(triangles):
        yield Shape(rest, surface.points, triangles, values)
    if not len(surface.lines):
        return
    radius = LINE * float(np.linalg.norm(np.ptp(rest, axis=0)))
    yield _rods(rest, surface.points, surface.lines, ends, radius)


def _own_surface(simulation: Simulation, name: str, field: Field) -> Shape:
    """The mesh with which a body meets others, which its cells carry."""
    surface, mesh = simulation.contact_surface(name), simulation.meshes[name]
    if field == "displacement":
        values = np.linalg.norm(surface.points - surface.rest, axis=1)
    else:
        every, count = np.zeros(mesh.node_count), np.zeros(mesh.node_count)
        stress = _stress_of(simulation, name)
        first = 0
        for block in mesh.body_blocks:
            of_cells = stress[first : first + len(block.nodes)]
            np.add.at(every, block.nodes, of_cells[:, None])
            np.add.at(count, block.nodes, 1.0)
            first += len(block.nodes)
        values = surface.carried(every / np.maximum(count, 1.0))
    return Shape(surface.rest, surface.points, surface.triangles.astype(np.int64), values)


def _met_tissue(simulation: Simulation, name: str, field: Field) -> Shape:
    """The surface with which a tissue meets others, with the stress of the nearest points."""
    surface = simulation.contact_surface(name)
    if field == "displacement":
        values = np.linalg.norm(surface.points - surface.rest, axis=1)
    else:
        from scipy.spatial import cKDTree

        nearest = cKDTree(simulation.points(name, rest=True)).query(surface.rest)[1]
        values = np.asarray(_stress_of(simulation, name))[nearest]
    return Shape(surface.rest, surface.points, surface.triangles.astype(np.int64), values)


def _tissue(simulation: Simulation, name: str, field: Field) -> Shape:
    """The integration points of a tissue, half as wide as they are apart."""
    rest, now = simulation.points(name, rest=True), simulation.points(name)
    size = np.prod(np.maximum(np.ptp(rest, axis=0), 1e-9)) / len(rest)
    radius = 0.25 * float(size) ** (1.0 / 3.0)
    (before, triangles), (after, _) = dots(rest, radius), dots(now, radius)
    shift = np.linalg.norm(now - rest, axis=1)
    values = shift if field == "displacement" else _stress_of(simulation, name)
    return Shape(before, after, triangles, np.repeat(values, 6))


def _stress_of(simulation: Simulation, body: str) -> Array:
    fields = simulation.cell_fields(body)
    if "von_mises" not in fields:
        raise ParameterError(
            f"found the field von_mises of body '{body}', whose model has springs and no stress; "
            "displacement is accepted"
        )
    return fields["von_mises"]


def _rods(rest: Array, now: Array, ends: Ints, values: Array, radius: float) -> Shape:
    """Lines (k,2) as rods, with the values (k,2) at their ends."""
    before, after = rods(rest[ends], radius), rods(now[ends], radius)
    return Shape(before[0], after[0], before[1], rods_values(values))


def _joined(parts: Iterable[Shape]) -> Shape:
    parts = list(parts)
    starts = np.cumsum([0] + [len(p.rest) for p in parts])
    return Shape(
        np.vstack([p.rest for p in parts]),
        np.vstack([p.now for p in parts]),
        np.vstack([p.triangles + start for p, start in zip(parts, starts, strict=False)]),
        np.concatenate([p.values for p in parts]),
    )


def _at_points(cells: Array, triangles: NDArray[np.int64], points: Array) -> Array:
    """Values (t,) of triangles as means (n,) at points, weighted by area."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    area = np.repeat(np.linalg.norm(np.cross(b - a, c - a), axis=1), 3)
    corner = triangles.ravel()
    total = np.bincount(corner, area * np.repeat(cells, 3), minlength=len(points))
    weight = np.bincount(corner, area, minlength=len(points))
    return np.asarray(total / np.where(weight > 0, weight, 1.0))


def _scale(values: Array, field: Field) -> tuple[float, str, tuple[float, float]]:
    """Factor, unit and ends of the colour bar."""
    largest = float(values.max(initial=0.0))
    if largest <= 0:
        return (1e3, "mm", (0.0, 1.0)) if field == "displacement" else (1.0, "Pa", (0.0, 1.0))
    unit = layout.length_unit if field == "displacement" else layout.pressure_unit
    factor, name = unit(largest)
    return factor, name, (0.0, largest * factor)
