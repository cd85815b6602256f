"""The surface of a tissue in contact: that which it fills, carried by its frames."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu import _core
from tissu.compile.contact_surface import Riders
from tissu.compile.mesh_surface import surface_of_mesh
from tissu.errors import TissuError
from tissu.ties import Weights, carried

if TYPE_CHECKING:
    from tissu.compile.contact_surface import ContactSurface
    from tissu.compile.prepared import Floats, Prepared


def tissue_surface(prepared: Prepared, name: str) -> ContactSurface | None:
    """The surface of `inside`; its vertices follow frames and nodes as points of the tissue do.

    Returns:
        None, and a problem, where there is none.
    """
    tissue, path = prepared.scene.tissue[name], ("tissue", name, "inside")
    surface = surface_of_mesh(tissue.inside, path, prepared.findings)
    if surface is None:
        return None
    links = prepared.tissue[name].links
    places = np.ascontiguousarray(surface.vertices)
    try:
        listened = Weights(
            *_core.shape_weights(
                name=links.shape,
                neighbours=tissue.neighbours or 0,
                frames=links.origins,
                points=places,
                body=name,
            )
        )
        weights, others = carried(links.carriers, listened, links.own, links.near, places)
    except TissuError as error:
        prepared.findings.problem(path, str(error))
        return None
    used = weights.weights != 0.0
    begin = np.concatenate([[0], np.cumsum(used.sum(axis=1))]).astype(np.int32)
    nodes = weights.frames[used].astype(np.int32)
    arms = np.repeat(places, np.diff(begin), axis=0) - _origins(prepared, name, others)[nodes]
    turns = _turns(prepared, links.own, others)[nodes]
    riders = Riders(
        begin=begin,
        nodes=nodes,
        weights=weights.weights[used],
        arms=np.ascontiguousarray(np.where(turns[:, None], arms, 0.0)),
        others=tuple(others),
    )
    return surface._replace(riders=riders)


def _origins(prepared: Prepared, name: str, others: list[tuple[str, int]]) -> Floats:
    """Where frames of a tissue, and nodes of bodies after them, are at rest."""
    links = prepared.tissue[name].links
    nodes = [prepared.bodies[body].mesh.points[node] for body, node in others]
    return np.concatenate([links.origins[: links.own], np.reshape(nodes, (-1, 3))])


def _turns(prepared: Prepared, own: int, others: list[tuple[str, int]]) -> np.ndarray:
    """Which of these have a rotation."""
    there = [prepared.scene.bodies[body].has_rotations for body, _ in others]
    return np.array([True] * own + there, dtype=bool)
