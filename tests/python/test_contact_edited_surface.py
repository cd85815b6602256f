"""Surfaces of bodies that lost cells, beside those that the same cells have when compiled."""

import numpy as np
import pytest

import tissu as ts
from contact_edited import block, pressed
from tissu.compile.contact_surface import body_surface

rng = np.random.default_rng(7)


def edited(body, removed, **fields):
    """What the world meets of a body that lost cells, and what compilation makes of the others."""
    far = {"far": ts.PlaneObstacle((0, 0, -1), (0, 0, 1))}
    contacts = [ts.Contact(("block", "far"))]
    made = pressed(body=body, fixed=[], obstacles=far, contacts=contacts, **fields)
    simulation = made.compile()
    for cells in removed:
        simulation.remove_cells(body="block", cells=cells)
    triangles, edges, radius, closed = simulation._core.contact_surface("block")
    return triangles, edges, radius, closed, body_surface(simulation.meshes["block"], body)


def require_same(found):
    """In the same order too: which edits led there changes no bit of what follows."""
    triangles, edges, radius, closed, expected = found
    assert np.array_equal(triangles, expected.triangles)
    assert np.array_equal(edges, expected.edges)
    assert np.array_equal(radius, expected.radius)
    assert closed == expected.closed


CELLS = ["tetra", "hexahedron", "wedge", "tetra10", "hexahedron20", "hexahedron27", "wedge15"]


@pytest.mark.parametrize("cell", CELLS)
@pytest.mark.parametrize("cuts", [1, 3])
def test_a_volume_that_lost_cells(cell, cuts):
    body = block(cell=cell)
    count = body.mesh.mesh().cell_count
    found = edited(body, np.array_split(rng.permutation(count)[: count // 2], cuts))
    require_same(found)
    triangles, _, radius, closed, _ = found
    assert closed
    assert not len(radius)
    # Faces of the removed cells are gone and those of their neighbours there: it is closed.
    sides = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    assert (np.unique(sides, axis=0, return_counts=True)[1] % 2 == 0).all()


def test_the_order_of_cuts_changes_nothing():
    count = 27
    cells = rng.permutation(count)[:9]
    one = edited(block(), [cells])
    other = edited(block(), [[cell] for cell in cells[::-1]])
    for a, b in zip(one[:3], other[:3], strict=True):
        assert np.array_equal(a, b)


def with_sheets():
    """Eight hexahedra with a sheet on top, one inside, one beside; and lines in and outside."""
    bar = ts.bar_mesh(size=(0.1, 0.1, 0.1), cells=(2, 2, 2), cell="hexahedron")
    at = {tuple(np.round(p / 0.05).astype(int)): n for n, p in enumerate(bar.points)}
    top = [at[0, 0, 2], at[1, 0, 2], at[1, 1, 2], at[0, 1, 2]]
    inner = [at[1, 0, 0], at[1, 1, 0], at[1, 1, 1], at[1, 0, 1]]
    points = np.concatenate([bar.points, [[0.05, 0.05, 0.2], [0.05, 0.1, 0.2]]])
    cells = [
        *bar.cells,
        ("quad", np.array([top, inner])),
        ("triangle", np.array([[26, 24, 27]])),
        ("line", np.array([[0, 13], [13, 27], [27, 28]])),
    ]
    mesh = ts.Mesh(points=points, cells=cells)
    law = ts.StVK(young=2e4, poisson=0.3)
    return block(mesh=mesh, law=law, thickness=0.004, section="3 mm^2")


@pytest.mark.parametrize("removed", [[0], [1], [0, 1], [4], [8], [9], [10], [0, 9], [4, 10, 11]])
def test_sheets_and_lines_beside_it(removed):
    """Cells 0 to 7 are hexahedra, then come quads, the triangle and lines.

    The inner quad lies between cells 0 and 1: where one of these goes it comes to the surface.
    """
    require_same(edited(with_sheets(), [removed]))


def test_a_sheet_inside_comes_to_the_surface_with_its_thickness():
    body = with_sheets()
    before = edited(body, [])[2]
    after = edited(body, [[0]])[2]
    inner = body.mesh.cells[1].nodes[1]
    assert not before[inner].all()
    assert (after[inner] == 0.002).all()


def test_nodes_that_no_cell_uses_have_no_surface():
    simulation = pressed().compile()
    simulation.remove_cells(body="block", cells=range(18, 27))
    triangles = simulation._core.contact_surface("block")[0]
    used = np.unique(simulation.meshes["block"].volume_blocks[0].nodes)
    assert np.isin(triangles, used).all()
    assert len(used) < simulation.meshes["block"].node_count
