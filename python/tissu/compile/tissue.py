"""Connective tissue of a scene: sampled, and tied to the bodies that it lies between."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tissu import _core, sampling
from tissu.compile.prepared import Floats, Ints, KnownMesh, Prepared, PreparedTissue
from tissu.errors import ParameterError, TissuError
from tissu.mesh import CellBlock, Mesh
from tissu.sampling.poisson import poisson_search
from tissu.scene.unknown import Unknown
from tissu.ties import Carriers, Links, Weights, carried

if TYPE_CHECKING:
    from tissu.sampling import Region
    from tissu.scene.problem import Path
    from tissu.scene.tissue import Tissue


_NEAR_ENOUGH = 0.1
"""of the number of points that is asked for"""


def prepare_tissue(prepared: Prepared, name: str) -> None:
    """Sample a tissue and tie it; problems are told, and leave it out."""
    tissue, path = prepared.scene.tissue[name], ("tissue", name)
    try:
        made = _made(prepared, name, tissue)
    except TissuError as error:
        prepared.findings.problem(path, str(error))
        return
    except Unknown:
        return
    if made is not None:
        prepared.meshes[name] = KnownMesh(made.mesh)
        prepared.tissue[name] = made


def _made(prepared: Prepared, name: str, tissue: Tissue) -> PreparedTissue | None:
    if tissue.between is None:
        region: Region = _filled(tissue)
        held: list[tuple[str, Ints]] = []
    else:
        if any(body not in prepared.bodies for body in tissue.between):
            return None  # told already
        region, held = _between(prepared, tissue, ("tissue", name))
    frames, points = _sampled(region, tissue)
    _require_found(frames, points)
    volumes = sampling.point_volumes(region, points)
    density = tissue.density if tissue.mass is None else tissue.mass / float(volumes.sum())
    assert density is not None  # the tissue has one of both
    places = [prepared.bodies[body].mesh.points[nodes] for body, nodes in held]
    origins = np.ascontiguousarray(np.concatenate([frames, *places]))
    listened = _listened(tissue, name, origins, points)
    near = [(body, int(node)) for body, nodes in held for node in nodes]
    carriers = _carriers(prepared, [body for body, _ in held])
    weights, shared = carried(carriers, listened, len(frames), near, points)
    _require_ties(tissue, weights, len(frames), shared)
    _require_followed(weights, len(frames))
    links = Links(
        name=name,
        shape=tissue.shape,
        own=len(frames),
        origins=origins,
        near=near,
        points=np.ascontiguousarray(points),
        masses=float(density) * volumes,
        volumes=volumes,
        listened=listened,
        first=(weights, shared),
        carriers=carriers,
    )
    numbers = np.arange(len(frames), dtype=np.int32)[:, None]
    mesh = Mesh(points=frames, cells=(CellBlock("vertex", numbers),))
    return PreparedTissue(mesh, points, volumes, shared, weights, float(density), links)


def _require_found(frames: Floats, points: Floats) -> None:
    """A grid may have no place inside."""
    for found, what in ((frames, "frame"), (points, "point")):
        if not len(found):
            text = f"found no {what} of the grid inside; more {what}s are accepted, or "
            raise ParameterError(f"{text}sampling: poisson")


def _require_followed(weights: Weights, own: int) -> None:
    """Each of the tissue's own frames has a point."""
    idle = np.setdiff1d(np.arange(own), weights.frames)
    if len(idle):
        text = f"{len(idle)} of {own} frames have no point that listens to them; "
        raise ParameterError(f"{text}more points, or more neighbours, are accepted")


def _listened(tissue: Tissue, name: str, origins: Floats, points: Floats) -> Weights:
    """How the points listen to frames and to nodes of bodies."""
    return Weights(
        *_core.shape_weights(
            name=tissue.shape,
            neighbours=tissue.neighbours or 0,
            frames=origins,
            points=np.ascontiguousarray(points),
            body=name,
        )
    )


def _carriers(prepared: Prepared, bodies: list[str]) -> Carriers:
    """Those of the bodies whose nodes have no rotation."""
    riding = [name for name in bodies if not prepared.scene.bodies[name].has_rotations]
    return Carriers({name: prepared.bodies[name].mesh for name in riding})


def _filled(tissue: Tissue) -> Region:
    from tissu.compile.meshes import mesh_of

    return sampling.Surface.of(mesh_of(tissue.inside))


def _between(
    prepared: Prepared, tissue: Tissue, path: Path
) -> tuple[Region, list[tuple[str, Ints]]]:
    """The space between two bodies, and the nodes of each that it may hold."""
    assert tissue.between is not None
    if tissue.inside is not None:
        return _enclosing(prepared, tissue)
    assert tissue.reach is not None  # a rule of the scene
    meshes = [prepared.bodies[name].mesh for name in tissue.between]
    surfaces = [_surface_of(mesh) for mesh in meshes]
    held: list[Ints] = []
    for end, mesh in enumerate(meshes):
        if tissue.on is not None:
            nodes = tissue.on[end].nodes(mesh)
            nodes = np.intersect1d(nodes, mesh.surface().nodes).astype(np.int32)
        else:
            nodes = mesh.surface().nodes
            near = surfaces[1 - end].distance(mesh.points[nodes]) <= tissue.reach
            nodes = nodes[near]
        if not len(nodes):
            raise ParameterError(
                f"found no node of '{tissue.between[end]}' within the reach of {tissue.reach:g} m "
                f"of '{tissue.between[1 - end]}'; a longer reach is accepted"
            )
        held.append(nodes.astype(np.int32))
    chosen = (None, None) if tissue.on is None else (held[0], held[1])
    region = sampling.between(
        surfaces[0], surfaces[1], tissue.reach, nodes_a=chosen[0], nodes_b=chosen[1]
    )
    return region, list(zip(tissue.between, held, strict=True))


def _enclosing(prepared: Prepared, tissue: Tissue) -> tuple[Region, list[tuple[str, Ints]]]:
    """The inside of a surface, and the nodes of two bodies that lie in it (figure 10)."""
    region = _filled(tissue)
    held = []
    for end, name in enumerate(tissue.between or ()):
        mesh = prepared.bodies[name].mesh
        nodes = mesh.surface().nodes
        if tissue.on is not None:
            nodes = np.intersect1d(nodes, tissue.on[end].nodes(mesh))
        nodes = nodes[region.inside(mesh.points[nodes])].astype(np.int32)
        if not len(nodes):
            raise ParameterError(
                f"found no node of '{name}' inside the surface that the tissue fills; nodes that "
                "lie in it or on it are held: move the surface, or refine the body"
            )
        held.append((name, nodes))
    return region, held


def _surface_of(mesh: Mesh) -> sampling.Surface:
    """The closed surface of a body; of sheets that are closed, their own."""
    if mesh.volume_blocks:
        return sampling.Surface.of(mesh)
    return sampling.Surface(mesh.points, mesh.surface().triangles)


def _sampled(region: Region, tissue: Tissue) -> tuple[Floats, Floats]:
    """Frames and points inside the region, about as many as asked."""
    if tissue.sampling == "poisson":
        # n points in a volume are n^(-1/3) apart; the border takes its share, so twice.
        frames, distance = poisson_search(region, tissue.frames, seed=tissue.seed)
        points = frames
        for _ in range(3):
            distance *= (len(points) / tissue.points) ** (1.0 / 3.0)
            points = sampling.poisson_points(region, distance, seed=tissue.seed + 1)
            if abs(len(points) / tissue.points - 1.0) < _NEAR_ENOUGH:
                break
        return frames, points
    spacing = float(region.volume / tissue.frames) ** (1.0 / 3.0)
    sides = np.maximum(1, np.round((region.bounds[1] - region.bounds[0]) / spacing).astype(int) - 1)
    # As many points in every cell of the grid: what frames add to linear fields must be zero in the
    # mean of a cell, or it softens the tissue.
    inside = max(2, round((tissue.points / int(np.prod(sides))) ** (1.0 / 3.0)))
    edges = [np.linspace(a, b, n + 1) for a, b, n in zip(*region.bounds, sides, strict=True)]
    fine = [
        np.linspace(a, b, inside * n + 1) for a, b, n in zip(*region.bounds, sides, strict=True)
    ]
    return _grid(region, edges), _grid(region, [(e[1:] + e[:-1]) / 2 for e in fine])


def _grid(region: Region, axes: list[Floats]) -> Floats:
    """The points of a grid that lie inside."""
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    return np.asarray(grid[region.inside(grid)])


def _require_ties(
    tissue: Tissue, weights: Weights, own: int, shared: list[tuple[str, int]]
) -> None:
    """Tissue that lies between two bodies holds both."""
    used = np.unique(weights.frames)
    bodies = {shared[number - own][0] for number in used if number >= own}
    for body in tissue.between or ():
        if body not in bodies:
            text = f"no point listens to a node of '{body}', so that it is not tied; "
            raise ParameterError(f"{text}more points, more neighbours or fewer frames are accepted")
