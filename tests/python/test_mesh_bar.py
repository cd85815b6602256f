"""Bars: the splits, and the meshes that the reference values were computed on."""

from __future__ import annotations

import copy
import dataclasses
import pickle

import numpy as np
import pytest

from mesh_data import shared
from tissu.errors import ParameterError
from tissu.mesh import bar_mesh
from tissu.mesh.cell import handled_types
from tissu.mesh.surface import edge_faults, enclosed_volume

KINDS = [("tetra", "five"), ("tetra", "six_mirrored"), *((cell, "six") for cell in handled_types())]


# Triangles on a side of a grid cell towards z, towards x and y: 2 halves of a quad; of its nodes, 8
# between 9, which two triangles of 6 have too, 6 between 8.
PER_SIDE = {
    "tetra10": (8, 8),
    "hexahedron20": (6, 6),
    "hexahedron27": (8, 8),
    "wedge15": (8, 6),
    "pyramid13": (6, 6),
}


@pytest.mark.parametrize(("cell", "split"), KINDS)
def test_volumes_add_up_and_faces_match(cell: str, split: str) -> None:
    mesh = bar_mesh(size=(4, 2, 1), cells=(4, 3, 2), cell=cell, split=split, origin=(-1, 0, 5))
    surface = mesh.surface()
    assert (mesh.cell_volumes() > 0).all()
    assert mesh.volume() == pytest.approx(8.0, rel=1e-13)
    assert enclosed_volume(mesh.points, surface.triangles) == pytest.approx(8.0, rel=1e-13)
    across, around = PER_SIDE.get(cell, (2, 2))
    assert len(surface.triangles) == 2 * (4 * 3 * across + (3 * 2 + 4 * 2) * around)
    assert edge_faults(surface.triangles) == (0, 0)
    assert euler_characteristic(surface.triangles) == 2
    assert mesh.quality().nonconforming_faces == 0
    assert len(mesh.unused_nodes) == 0
    np.testing.assert_array_equal(mesh.bounds, [[-1, 0, 5], [3, 2, 6]])


@pytest.mark.parametrize("split", ["five", "six_mirrored"])
def test_mirrored_splits_are_symmetric(split: str) -> None:
    mesh = bar_mesh(size=(4, 2, 2), cells=(4, 2, 2), split=split, origin=(0, -1, -1))
    assert_same_cells(
        mesh.points, mesh.cells[0].nodes, mesh.points * [1, 1, -1], mesh.cells[0].nodes
    )


def test_six_is_not_symmetric() -> None:
    mesh = bar_mesh(size=(4, 2, 2), cells=(4, 2, 2), split="six", origin=(0, -1, -1))
    mirrored = canonical(mesh.points * [1, 1, -1], mesh.cells[0].nodes)
    assert not np.array_equal(canonical(mesh.points, mesh.cells[0].nodes), mirrored)


@pytest.mark.parametrize(
    ("kind", "cell", "split"),
    [("tet4", "tetra", "six"), ("tet4_5", "tetra", "five"), ("hex8", "hexahedron", "six")],
)
@pytest.mark.parametrize("cells", [(12, 2, 2), (24, 4, 4)])
def test_reference_meshes_are_reproduced(
    kind: str, cell: str, split: str, cells: tuple[int, int, int]
) -> None:
    name = f"A_mesh_{'x'.join(map(str, cells))}_{kind}_nu00.npz"
    with np.load(shared("reference", name)) as reference:
        nodes, elements = reference["nodes"], reference["elements"]
    mesh = bar_mesh(size=(8, 1, 1), cells=cells, cell=cell, split=split, origin=(0, -0.5, -0.5))
    np.testing.assert_allclose(mesh.points, nodes, atol=1e-12)  # the numbering too
    assert_same_cells(mesh.points, mesh.cells[0].nodes, nodes, elements)


@pytest.mark.parametrize(
    ("arguments", "found"),
    [
        ({"size": (1, 0, 1), "cells": (1, 1, 1)}, "positive"),
        ({"size": (1, float("nan"), 1), "cells": (1, 1, 1)}, "finite"),
        ({"size": (1, 1), "cells": (1, 1, 1)}, "three numbers"),
        ({"size": (1, 1, 1), "cells": (1, 1, 0)}, "from 1 on"),
        ({"size": (1, 1, 1), "cells": (1, 1, 1.5)}, "whole numbers"),
        ({"size": (1, 1, 1), "cells": (3000, 3000, 3000)}, "32-bit"),
        ({"size": (1, 1, 1), "cells": (1, 1, 1), "cell": "wedge18"}, "'wedge18'"),
        ({"size": (1, 1, 1), "cells": (1, 1, 1), "split": "seven"}, "'seven'"),
    ],
)
def test_wrong_arguments_are_refused(arguments: dict, found: str) -> None:
    with pytest.raises(ParameterError, match=found):
        bar_mesh(**arguments)


def euler_characteristic(triangles: np.ndarray) -> int:
    """Nodes - edges + triangles; 2 for a surface like a sphere."""
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    return len(np.unique(triangles)) - len(np.unique(edges, axis=0)) + len(triangles)


def canonical(points: np.ndarray, cells: np.ndarray) -> np.ndarray:
    """The set of cells, told by the positions of their nodes."""
    order = np.lexsort(np.round(points, 9).T + 0.0)
    place = np.empty(len(points), dtype=int)
    place[order] = np.arange(len(points))
    rows = np.sort(place[cells], axis=1)
    return rows[np.lexsort(rows.T)]


def assert_same_cells(
    points: np.ndarray, cells: np.ndarray, other_points: np.ndarray, other_cells: np.ndarray
) -> None:
    np.testing.assert_array_equal(canonical(points, cells), canonical(other_points, other_cells))


def test_a_mesh_is_pickled_and_copied_whole():
    mesh = bar_mesh(size=(3, 1, 1), cells=(3, 1, 1))
    mesh = dataclasses.replace(mesh, regions={"left": [0, 2]}, notes=("made by hand",))
    for again in (pickle.loads(pickle.dumps(mesh)), copy.deepcopy(mesh)):
        assert np.array_equal(again.points, mesh.points)
        assert [block.type for block in again.cells] == [block.type for block in mesh.cells]
        assert np.array_equal(again.cells[0].nodes, mesh.cells[0].nodes)
        assert list(again.regions["left"]) == [0, 2]
        assert again.notes == mesh.notes
