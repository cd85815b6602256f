"""Hexahedra cut into tetrahedra."""

import dataclasses

import numpy as np
import pytest

import tissu as ts


@pytest.mark.parametrize("seed", range(5))
def test_volume_surface_and_conformity_are_kept(seed):
    rng = np.random.default_rng(seed)
    hexahedra = ts.bar_mesh(size=(3, 2, 2), cells=(3, 2, 2), cell="hexahedron")
    # Any numbering of the nodes and any corner first must do.
    order = rng.permutation(hexahedra.node_count)
    where = np.argsort(order).astype(np.int32)
    (block,) = hexahedra.volume_blocks
    shuffled = dataclasses.replace(
        hexahedra,
        points=hexahedra.points[order],
        cells=(ts.CellBlock("hexahedron", where[block.nodes]),),
        regions={"left": [0, 3]},
    )
    cut = ts.into_tetrahedra(shuffled)
    assert cut.cell_count == 6 * 12
    assert cut.volume() == pytest.approx(12.0, rel=1e-14)
    assert cut.cell_volumes().min() > 0.1  # 1/6, all turned the right way
    assert len(cut.surface().triangles) == 2 * 2 * (3 * 2 + 3 * 2 + 2 * 2)
    assert cut.quality().closed
    assert set(cut.regions["left"]) == {*range(6), *range(18, 24)}


def test_a_mesh_without_volume_cells_is_refused():
    sheet = ts.bar_mesh(size=(1, 1, 0), cells=(2, 2, 0), cell="quad")
    with pytest.raises(ts.MeshError, match="found quad where volume cells are cut"):
        ts.into_tetrahedra(sheet)
