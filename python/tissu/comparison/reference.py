"""What a comparison measures against: a richer run of the same scene, or another scene."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tissu.comparison.trace import Floats, Trace, trace
from tissu.errors import MeshError, ParameterError
from tissu.mesh import into_quadratic
from tissu.scene.model import FEM, Shell
from tissu.scene.step import Newton

if TYPE_CHECKING:
    from tissu.front import Scene
    from tissu.mesh import Mesh

_SAME = 1e-9  # of the extent: two points nearer than this are the same


def with_model(scene: Scene, model: object) -> Scene:
    """The scene with one model for all its bodies, which computes the nearest law it takes."""
    changes = {"model": model, "law_for_model": "nearest"}
    bodies = {name: body.replace(**changes) for name, body in scene.bodies.items()}
    return scene.replace(bodies=bodies)


def finest(scene: Scene, meshes: dict[str, Mesh]) -> tuple[Trace, str]:
    """The scene with continuum elements of second order, where its cells have them.

    Shells stay shells: elements of a continuum on their triangles are another body. Where a step
    that is linearised once does not bring it to the end, Newton's method is iterated.
    """
    bodies, words = {}, set()
    for name, body in scene.bodies.items():
        if isinstance(body.model, Shell):
            bodies[name] = body
            words.add("shell on the same mesh")
            continue
        changes: dict[str, object] = {"model": FEM()}
        try:
            if meshes[name].thin_blocks:
                raise MeshError("sheets and lines stay as they are")
            changes["mesh"] = into_quadratic(meshes[name])
            words.add("fem with elements of second order on the same cells")
        except MeshError:
            words.add("fem on the same mesh")
        bodies[name] = body.replace(**changes)
    rich = scene.replace(bodies=bodies)
    found = trace(rich)
    if found.stopped and getattr(scene.step, "newton", scene) is None:
        words.add("Newton iterated")
        found = trace(rich.replace(step=scene.step.replace(newton=Newton(iterations=20))))
    return found, ", ".join(sorted(words, reverse=True))


def errors(found: Trace, reference: Trace) -> tuple[float, float, float]:
    """How far the nodes are from where the reference has them.

    Returns:
        mean and largest distance over nodes and samples, and the reference's largest displacement
        [m].

    Raises:
        ParameterError: the reference lacks a body or some nodes, or was sampled at other times.
    """
    distances, largest = [], 0.0
    for name, moved in found.displacements.items():
        if name not in reference.displacements:
            raise ParameterError(f"the reference has no body '{name}'")
        count = len(moved)
        if count > len(reference.times) or not np.allclose(
            found.times, reference.times[:count], rtol=1e-9, atol=1e-12
        ):
            raise ParameterError(
                "the reference was sampled at other times; give it the same step and duration"
            )
        at = _places(found.rest[name], reference.rest[name], name)
        of_reference = reference.displacements[name][:count, at]
        distances.append(np.linalg.norm(moved - of_reference, axis=2).ravel())
        largest = max(largest, float(np.linalg.norm(of_reference, axis=2).max(initial=0.0)))
    every = np.concatenate(distances)
    if not every.size:
        return float("nan"), float("nan"), largest
    return float(every.mean()), float(every.max()), largest


def _places(points: Floats, of_reference: Floats, name: str) -> NDArray[np.intp]:
    """Numbers of the reference's nodes that stand where these do at rest."""
    if len(points) <= len(of_reference) and np.array_equal(points, of_reference[: len(points)]):
        return np.arange(len(points))
    extent = float(np.ptp(of_reference, axis=0).max())
    keys = {tuple(key): number for number, key in enumerate(_rounded(of_reference, extent))}
    found = [keys.get(tuple(key), -1) for key in _rounded(points, extent)]
    if min(found) < 0:
        missing = sum(number < 0 for number in found)
        raise ParameterError(
            f"the reference has no node where {missing} of the {len(points)} nodes of body "
            f"'{name}' are at rest; refine the mesh in whole parts, so that its nodes stay"
        )
    return np.array(found)


def _rounded(points: Floats, extent: float) -> NDArray[np.int64]:
    return np.rint(points / (_SAME * extent) / 64).astype(np.int64)
