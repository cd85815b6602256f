"""Tears at the end of a step: discs open where the material is pulled too much."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu import _core
from tissu.cutting.material import centres_of
from tissu.cutting.overstress import Overstress, front_of, front_of_sheet, overstressed
from tissu.errors import ParameterError

if TYPE_CHECKING:
    from tissu import _core as core
    from tissu.cutting.report import CutReport
    from tissu.scene.tear import Tear
    from tissu.simulation.simulation import Simulation

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

RADIUS = 1.5
"""of the disc that opens, as a share of the tear's length"""
_NEAR_FRONT = 2.0
"""distance at which a tear goes on from a front, as a share of its length"""
_NEAREST = 0.3
"""A tear goes to the end of an edge within this share of it: it leaves no thin bridges."""
_SAME_PLANE = 0.9
"""cosine between the normal of a cut and the pull, above which it goes straight on"""
_BEHIND = 0.2
"""distance behind a front at which a tear that goes on begins, as a share of its length"""
_SIDES = 16


def tear_after_step(simulation: Simulation) -> tuple[CutReport, ...]:
    """What tears of the scene open now.

    Raises:
        ParameterError: the step was taken, and a tear is refused.
    """
    reports: list[CutReport] = []
    for number, tear in enumerate(simulation.scene.tear):
        try:
            reports += _torn(simulation, tear)
        except ParameterError as error:
            raise ParameterError(
                f"tear[{number}]: step {simulation._steps} was taken, and what would tear at its "
                f"end is refused: {error}"
            ) from None
    return tuple(reports)


def _torn(simulation: Simulation, tear: Tear) -> list[CutReport]:
    body = tear.body
    stress = simulation.field("cauchy_stress", "cells", body)
    if not (np.linalg.norm(np.nan_to_num(stress), axis=(1, 2)) > tear.strength).any():
        return []
    points = simulation.integration_points(body)
    volumes = np.bincount(points.cells, points.volumes, len(stress)).astype(np.float64)
    centres, _ = centres_of(simulation.material(body))
    places = overstressed(
        centres,
        stress,
        volumes,
        strength=tear.strength,
        length=tear.length,
        apart=2.0 * RADIUS * tear.length,  # two discs do not overlap
        most=tear.per_step,
    )
    front = _front(simulation, body) if places else None
    reports = []
    for sweep in _openings(places, front, tear.length):
        report = simulation._cut_along(body, sweep, by="tear", nearest=_NEAREST)
        if report.cells_cut or report.unresolved:
            reports.append(report)
    return reports


@dataclass(frozen=True, slots=True, eq=False)
class _Front:
    """The edges at the fronts of the cuts of a body now; in a sheet the points.

    Attributes:
        middles: (k, 3) [m].
        ahead: direction from the cut into the material (k, 3), of length one.
        normals: of the cut at each (k, 3), of length one.
    """

    middles: Floats
    ahead: Floats
    normals: Floats


def _front(simulation: Simulation, body: str) -> _Front | None:
    """The fronts of the cuts of a body now; None: there is none."""
    surface = simulation.surface(body)
    if not len(surface.triangles):  # a cut line has ends and no front
        return None
    rest = surface.carried(simulation.meshes[body].points)
    if not simulation.meshes[body].volume_blocks:
        return _front_of_sheet(surface.triangles.astype(np.int64), surface.points, rest)
    found = front_of(surface.triangles.astype(np.int64), surface.cut, rest)
    if not len(found):
        return None
    a, b, c, d = (surface.points[found[:, i]] for i in range(4))
    middles, behind = 0.5 * (a + b), 0.5 * (c + d)
    along = _unit(b - a)
    ahead = middles - behind
    ahead = _unit(ahead - np.einsum("ki,ki->k", ahead, along)[:, None] * along)
    return _Front(middles, ahead, _unit(np.cross(along, ahead)))


def _front_of_sheet(triangles: Ints, points: Floats, rest: Floats) -> _Front | None:
    found = front_of_sheet(triangles, rest)
    if not len(found):
        return None
    corners = points[triangles]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(points)
    for k in range(3):
        np.add.at(normals, triangles[:, k], across)
    ahead = _unit(points[found[:, 0]] - 0.5 * (points[found[:, 1]] + points[found[:, 2]]))
    return _Front(points[found[:, 0]], ahead, _unit(np.cross(ahead, normals[found[:, 0]])))


def _unit(vectors: Floats) -> Floats:
    lengths = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.asarray(vectors / np.maximum(lengths, 1e-300))


def _openings(places: list[Overstress], front: _Front | None, length: float) -> list[core.Sweep]:
    """The surface that opens at each place: a disc, or what of one lies ahead of a front.

    Where fronts are near, those alone open: what a front takes up relieves the rest.
    """
    at_front = []
    for one in places:
        if front is None:
            break
        distances = np.linalg.norm(front.middles - one.place, axis=1)
        nearest = int(np.argmin(distances))
        if distances[nearest] <= _NEAR_FRONT * length:
            at_front.append(_ahead(front, nearest, one.normal, length))
    if at_front:
        return at_front
    radius = RADIUS * length
    return [_core.disc_sweep(center=p.place, normal=p.normal, radius=radius) for p in places]


def _ahead(front: _Front, edge: int, pulled: Floats, length: float) -> core.Sweep:
    """The half of a disc around an edge of a front that lies ahead of it.

    It goes on in the plane of the cut, unless the material is pulled in another direction. It
    begins a little behind the front, so that nothing stays whole between the two.
    """
    ahead, normal = front.ahead[edge], front.normals[edge]
    if abs(float(pulled @ normal)) < _SAME_PLANE:
        across = np.cross(pulled, ahead)
        if (
            np.linalg.norm(across) < _SAME_PLANE
        ):  # it is pulled along the cut, which goes no further
            return _core.disc_sweep(
                center=front.middles[edge], normal=pulled, radius=RADIUS * length
            )
        normal = pulled
        ahead = _unit(ahead - (ahead @ normal) * normal)
    across = np.cross(normal, ahead)
    angles = np.linspace(-0.5 * np.pi, 0.5 * np.pi, _SIDES + 1)
    rim = np.outer(np.cos(angles), ahead) + np.outer(np.sin(angles), across)
    middle = front.middles[edge] - _BEHIND * length * ahead
    points = np.concatenate([middle[None], middle + RADIUS * length * rim])
    corners = np.arange(1, _SIDES + 1)
    triangles = np.stack([np.zeros_like(corners), corners, corners + 1], axis=1)
    return _core.triangles_sweep(points=points, triangles=triangles.astype(np.int32))
