"""Tears at the end of a step: discs open where the material is pulled too much."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu import _core
from tissu.cutting.material import centres_of
from tissu.cutting.overstress import Overstress, front_of, overstressed
from tissu.errors import ParameterError

if TYPE_CHECKING:
    from tissu.cutting.report import CutReport
    from tissu.scene.tear import Tear
    from tissu.simulation.simulation import Simulation

Floats = NDArray[np.float64]

RADIUS = 1.5
"""of the disc that opens, as a share of the tear's length"""
_NEAR_FRONT = 2.0
"""distance at which a tear goes on from a front, as a share of its length"""


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
        apart=RADIUS * tear.length,
        most=tear.per_step,
    )
    front = _front(simulation, body) if places else np.empty((0, 3))
    reports = []
    for one in places:
        sweep = _core.disc_sweep(
            center=_center(one, front, tear.length),
            normal=one.normal,
            radius=RADIUS * tear.length,
        )
        report = simulation._cut_along(body, sweep, by="tear")
        if report.cells_cut or report.unresolved:
            reports.append(report)
    return reports


def _front(simulation: Simulation, body: str) -> Floats:
    """The middles (k, 3) of the edges at the fronts of the cuts of a body now [m]."""
    surface = simulation.surface(body)
    rest = surface.carried(simulation.meshes[body].points)
    edges = front_of(surface.triangles.astype(np.int64), surface.cut, rest)
    return np.asarray(surface.points[edges].mean(axis=1))


def _center(place: Overstress, front: Floats, length: float) -> Floats:
    """The middle of a disc (3,): its plane goes through the front of a cut that is near."""
    if not len(front):
        return place.place
    distances = np.linalg.norm(front - place.place, axis=1)
    nearest = int(np.argmin(distances))
    if distances[nearest] > _NEAR_FRONT * length:
        return place.place
    height = float((front[nearest] - place.place) @ place.normal)
    return np.asarray(place.place + height * place.normal)
