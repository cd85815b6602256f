"""A blade whose border lies in the cells around it opens faces and parts nothing: it is said."""

from __future__ import annotations

import numpy as np
import pytest

import tissu as ts

SIZE = (0.06, 0.04, 0.025)


def compiled(cell, *, flat=False, method="virtual"):
    size, cells = (*SIZE[:2], 0.0 if flat else SIZE[2]), (8, 5, 0 if flat else 3)
    law = ts.StVK(young=1e4, poisson=0.4) if flat else ts.StableNeoHooke(young=1e4, poisson=0.4)
    body = ts.Body(
        mesh=ts.BarMesh(size=size, cells=cells, cell=cell),
        law=law,
        density=1000.0,
        **({"thickness": 1e-3} if flat else {}),
    )
    return ts.Scene(
        bodies={"a": body},
        fixed=[ts.Fixed("a", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        step=ts.ImplicitEuler(0.01),
        editing=ts.Editing(method=method),
    ).compile()


@pytest.mark.parametrize(
    ("cell", "flat"),
    [
        ("hexahedron", False),
        ("wedge", False),
        ("tetra", False),
        ("quad", True),
        ("triangle", True),
    ],
)
def test_it_is_said_exactly_where_the_stiffness_stays(cell, flat):
    """Of 40 discs each; walls that part change the stiffness matrix, or its size."""
    simulation = compiled(cell, flat=flat)
    whole = simulation.mark()
    before = simulation.stiffness()
    rng = np.random.default_rng(17)
    in_vain = 0
    for _ in range(40):
        centre = (rng.uniform(0.012, 0.05), rng.uniform(0.008, 0.032), 0.0 if flat else SIZE[2])
        normal = (1.0, rng.uniform(-0.5, 0.5), 0.0)
        report = simulation.cut("a", ts.Disc(centre, normal, rng.uniform(0.006, 0.016)))
        after = simulation.stiffness()
        stays = (
            after.shape == before.shape and abs(after - before).max() <= 1e-12 * abs(before).max()
        )
        assert report.parts_nothing == (stays and report.cells_cut > 0)
        if report.parts_nothing:
            in_vain += 1
            assert report.nodes_new == 0
            assert len(report.unresolved) >= report.cells_cut
            assert "parts nothing" in str(report)
        simulation.rewind(whole)
    assert in_vain > 0


def test_a_slit_as_long_as_one_cell_names_all_that_it_met():
    """It crosses one hexahedron whole, whose nodes belong to neighbours that it crosses in part."""
    simulation = compiled("hexahedron")
    z = SIZE[2]
    slit = [[(0.02, 0.02 + 0.01 * u, z - 0.013), (0.02, 0.02 + 0.01 * u, 0.05)] for u in (-1, 0, 1)]
    report = simulation.cut("a", ts.Sweep(slit))
    assert report.parts_nothing
    assert report.area > 1e-4
    assert len(report.unresolved) == report.cells_cut == 6
    assert {why for _, why in report.unresolved} == {
        "the blade ends inside the cell and parts nothing"
    }


def test_a_divided_edge_that_parts_nothing_is_said_too():
    """A slit across one edge of a sheet: two triangles are divided, and the cut has two tips."""
    simulation = compiled("triangle", flat=True, method="subdivide")
    middle = 0.5 * (np.array((0.03, 0.016, 0.0)) + np.array((0.0375, 0.016, 0.0)))
    slit = [[tuple(middle + np.array((0.0, y, z))) for z in (-0.01, 0.01)] for y in (-1e-3, 1e-3)]
    report = simulation.cut("a", ts.Sweep(slit))
    assert report.cells_cut == 2
    assert report.parts_nothing
    assert len(report.unresolved) == 2


def test_a_whole_cut_and_a_miss_part_or_meet():
    simulation = compiled("hexahedron")
    across = simulation.cut("a", ts.Plane((0.03, 0.0, 0.0), (1.0, 0.1, 0.0)))
    assert not across.parts_nothing
    assert len(across.pieces) == 2
    beside = simulation.cut("a", ts.Disc((0.5, 0.5, 0.5), (1, 0, 0), 0.01))
    assert beside.met_nothing
    assert not beside.parts_nothing
