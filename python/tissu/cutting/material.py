"""The material of a body: what is there of its cells once blades have parted some of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tissu.arrays import real_array
from tissu.cutting.spreading import spread
from tissu.errors import ParameterError
from tissu.mesh import CellBlock, Mesh
from tissu.mesh.cell import dimension

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

__all__ = ["Material", "MaterialSurface"]


@dataclass(frozen=True, slots=True, eq=False)
class MaterialSurface:
    """The surface of a body's material as it is now, cut faces included; all of a sheet or line.

    Attributes:
        points: present places (v, 3) [m].
        triangles: numbers of points (t, 3), anticlockwise seen from outside.
        cell: number (t,) of the cell that each triangle belongs to.
        cut: whether (t,) a cut opened it.
        lines: pieces (l, 2) of lines, numbers of points.
        line_cell: number (l,) of the cell that each piece belongs to.
        nodes: nodes of the body (v, 4) that carry each point, -1: none.
        weights: of these nodes (v, 4), which sum to one.
        numbers: of the points (v,), as `contacts().nodes` has them: the node that a point is, or
            -2 - r for point r of cut material.
    """

    points: Floats
    triangles: Ints
    cell: Ints
    cut: NDArray[np.bool_]
    lines: Ints
    line_cell: Ints
    nodes: Ints
    weights: Floats
    numbers: Ints

    def carried(self, values: Floats) -> Floats:
        """Values (v, ...) at the points of values (n, ...) at the nodes of the body."""
        return carried(self.nodes, self.weights, values)


@dataclass(frozen=True, slots=True, eq=False)
class Material:
    """The material of a body as a conforming mesh.

    Cells that no blade met are unchanged. Each other cell is replaced by the tetrahedra of its
    material, in a sheet by triangles, in lines by pieces.

    Attributes:
        mesh: at rest.
        points: where its points are now (v, 3) [m].
        cell: number (m,) of the cell of the body that each cell of the mesh is, or is a part of.
        nodes: nodes of the body (v, 4) that carry each point, -1: none.
        weights: of these nodes (v, 4), which sum to one.
        numbers: of the points (v,), as `contacts().nodes` has them: the node that a point is, or
            -2 - r for point r of cut material.
    """

    mesh: Mesh
    points: Floats
    cell: Ints
    nodes: Ints
    weights: Floats
    numbers: Ints

    def carried(self, values: Floats) -> Floats:
        """Values (v, ...) at the points of values (n, ...) at the nodes of the body."""
        return carried(self.nodes, self.weights, values)

    def spread(self, mesh: Mesh, cells: Ints, forces: Floats, now: Floats | None) -> Floats:
        """Forces (v, 3) on the points, with the sum of the forces on the nodes.

        Args:
            mesh: `meshes[body]`, of all nodes and cells of the body.
            cells: `remaining_cells(body)`.
            forces: on the nodes (n, 3) [N], such as reactions.
            now: where the nodes are (n, 3) [m], to keep the moment, too; None: it is not kept, as
                that of couples, which do not depend on the place.
        """
        return spread(self, mesh, cells, forces, now)


def carried(nodes: Ints, weights: Floats, values: Floats) -> Floats:
    """sum_k w_k values_k of each point, whose nodes are (v, 4), -1: none.

    Raises:
        ParameterError: values that are no numbers, or of fewer nodes than the points name.
    """
    given = real_array(values, "values")
    least = int(nodes.max(initial=-1)) + 1
    if given.ndim == 0 or len(given) < least:
        raise ParameterError(
            f"found values of shape {given.shape}; a row for each node of the body is accepted, at "
            f"least {least}"
        )
    return np.asarray(np.einsum("vk,vk...->v...", weights, given[np.maximum(nodes, 0)]))


def surface_now(found: Mapping[str, Any], now: Floats) -> MaterialSurface:
    """The surface that the core found, where the nodes (n, 3) are now."""
    return MaterialSurface(
        points=carried(found["nodes"], found["weights"], now),
        triangles=found["triangles"],
        cell=found["cell"],
        cut=found["cut"],
        lines=found["lines"],
        line_cell=found["line_cell"],
        nodes=found["nodes"],
        weights=found["weights"],
        numbers=_as_contacts(found["vertex_node"]),
    )


def material_now(found: Mapping[str, Any], rest: Floats, now: Floats) -> Material:
    """The material that the core found, where the nodes (n, 3) are at rest and now."""
    nodes, weights = found["nodes"], found["weights"]
    blocks = tuple(CellBlock(type=name, nodes=rows) for name, rows in found["blocks"])
    kinds = {dimension(block.type) for block in blocks}
    thin = tuple(m for m in (2, 1) if m in kinds)
    return Material(
        mesh=Mesh(points=carried(nodes, weights, rest), cells=blocks, thin=thin),
        points=carried(nodes, weights, now),
        cell=found["cell"],
        nodes=nodes,
        weights=weights,
        numbers=_as_contacts(found["vertex_node"]),
    )


def _as_contacts(vertices: Ints) -> Ints:
    """Nodes, and -1 - r for point r of cut material, as contacts number them: -1 is none there."""
    return np.asarray(vertices - (vertices < 0), dtype=np.int32)


def centres_of(material: Material) -> tuple[Floats, Ints]:
    """Centres (e, 3) of the material of each cell now [m], and the cells' numbers, ascending.

    Of a cell that no blade met it is the mean of its nodes.
    """
    weights, centres = [], []
    for block in material.mesh.body_blocks:
        corners = material.points[block.nodes]
        volumes = np.ones(len(corners))
        if block.type == "tetra":
            volumes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 6.0
        elif block.type == "triangle":
            sides = corners[:, 1:] - corners[:, :1]
            volumes = 0.5 * np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
        elif block.type == "line":
            volumes = np.linalg.norm(corners[:, 1] - corners[:, 0], axis=1)
        weights.append(np.maximum(volumes, 1e-300))
        centres.append(corners.mean(axis=1))
    weight, centre = np.concatenate(weights), np.concatenate(centres)
    numbers, of_cell = np.unique(material.cell, return_inverse=True)
    total = np.bincount(of_cell, weight)
    moments = [np.bincount(of_cell, weight * centre[:, axis]) / total for axis in range(3)]
    return np.stack(moments, axis=1), numbers.astype(np.int32)
