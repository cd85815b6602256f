"""Collapsed cells, slivers, and pyramids near their tips: refused by number, or they rest."""

import numpy as np
import pytest

import tissu as ts

LAW = ts.StVK(young=3e3, poisson=0.3)
LAMBDA, MU = 3e3 * 0.3 / (1.3 * 0.4), 3e3 / 2.6
BASE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
CELLS = [
    *("tetra", "tetra10", "hexahedron", "hexahedron20", "hexahedron27"),
    *("wedge", "wedge15", "pyramid", "pyramid13"),
]
ROOT = ts.Box((None, None, None), (1e-9, None, None))
# Ends of edges of the far face of a bar of two cubes, (from, onto).
EDGE = [((2, 0, 1), (2, 0, 0))]
LINE = [*EDGE, ((2, 1, 1), (2, 1, 0))]
POINT = [*EDGE, ((2, 1, 1), (2, 0, 0)), ((2, 1, 0), (2, 0, 0))]
FLAT = [((2, y, z), (1, y, z)) for y in (0, 1) for z in (0, 1)]


def raised(mesh, cell):
    if cell.isalpha():
        return mesh
    return ts.into_quadratic(mesh, centres=cell == "hexahedron27")


def collapsed(cell, pairs, *, numbers=False):
    """A bar of two cubes with a collapsed far face: in place, or one node named for another."""
    mesh = ts.bar_mesh(size=(2, 1, 1), cells=(2, 1, 1), cell=cell.rstrip("0123456789"))
    points, nodes = mesh.points.copy(), mesh.cells[0].nodes.copy()
    for old, new in pairs:
        a, b = (int(np.abs(mesh.points - at).sum(axis=1).argmin()) for at in (old, new))
        if numbers:
            nodes[nodes == a] = nodes[nodes == b][0]
        points[a] = points[b]
    block = ts.CellBlock(mesh.cells[0].type, nodes)
    return raised(ts.Mesh(points=points, cells=(block,)).without_unused_nodes(), cell)


def pyramid(cell, tip, base=BASE):
    block = ts.CellBlock("pyramid", [range(5)])
    return raised(ts.Mesh(points=[*base, tip], cells=(block,)), cell)


def scene_of(mesh, *, on=ROOT):
    newton = ts.Newton(iterations=30, tolerance=1e-9)
    return ts.Scene(
        bodies={"body": ts.Body(mesh=mesh, law=LAW, density=1e3)},
        fixed=[ts.Fixed("body", on=on)],
        gravity=(0, 0, -0.1),
        step=ts.Static(newton=newton, solver=ts.Cholesky()),
    )


def refusal(mesh):
    with pytest.raises(ts.SceneError) as refused:
        scene_of(mesh).compile()
    return str(refused.value)


@pytest.mark.parametrize("pairs", [EDGE, LINE, POINT], ids=["edge", "line", "point"])
@pytest.mark.parametrize("cell", ["hexahedron", "wedge"])
def test_a_node_named_twice_is_refused_with_the_cell(cell, pairs):
    mesh = collapsed(cell, pairs, numbers=True)
    twice = [i for i, row in enumerate(mesh.cells[0].nodes) if len(set(row)) < len(row)]
    found = f"1 {cell} cell names" if len(twice) == 1 else f"{len(twice)} {cell} cells name"
    assert f"{found} a node twice (first: {', '.join(map(str, twice))})" in refusal(mesh)


@pytest.mark.parametrize(
    ("mesh", "said"),
    [
        (collapsed("hexahedron", FLAT), "1 of 2 cells is without volume (first: 1)"),
        (collapsed("hexahedron20", FLAT), "1 of 2 cells is without volume (first: 1)"),
        (collapsed("hexahedron27", FLAT), "1 of 2 cells is without volume (first: 1)"),
        (collapsed("wedge", FLAT), "2 of 4 cells are without volume (first: 2, 3)"),
        (collapsed("wedge", POINT), "1 of 4 cells is without volume (first: 2)"),
        (collapsed("wedge15", POINT), "1 of 4 cells is without volume (first: 2)"),
        (pyramid("pyramid", (0.5, 0.5, 0.0)), "1 of 1 cell is without volume (first: 0)"),
        (pyramid("pyramid13", (0.5, 0.5, 0.0)), "1 of 1 cell is without volume (first: 0)"),
        (pyramid("pyramid", (0.5, 0.5, 1e-13)), "1 of 1 cell is without volume (first: 0)"),
        (pyramid("pyramid", (0.5, 0.5, -0.5)), "1 of 1 cell is inside out (first: 0)"),
        (pyramid("pyramid13", (0.5, 0.5, -0.5)), "1 of 1 cell is inside out (first: 0)"),
        # The base folded along its diagonal: two halves that cancel.
        (
            pyramid("pyramid", (0.5, 0.5, 1.0), [BASE[0], BASE[1], BASE[0], BASE[3]]),
            "1 of 1 cell is inside out (first: 0)",
        ),
    ],
)
def test_cells_without_volume_or_inside_out_are_refused_by_number(mesh, said):
    text = refusal(mesh)
    assert said in text
    assert "cells of positive volume are accepted" in text


# Volume of the far cube with its far face collapsed: prism 1/2, pyramid 1/3; edge: the trilinear
# map's integral 3/4 (hexahedron), and 5/6 for two wedges, one of them whole.
IN_PLACE = [
    *((cell, EDGE, 3 / 4) for cell in ("hexahedron", "hexahedron20", "hexahedron27")),
    *((cell, LINE, 1 / 2) for cell in ("hexahedron", "hexahedron20", "hexahedron27")),
    *((cell, POINT, 1 / 3) for cell in ("hexahedron", "hexahedron20", "hexahedron27")),
    *((cell, EDGE, 5 / 6) for cell in ("wedge", "wedge15")),
    *((cell, LINE, 1 / 2) for cell in ("wedge", "wedge15")),
]
IDS = [f"{cell}-{('edge', 'line', 'point')[len(pairs) - 1]}" for cell, pairs, _ in IN_PLACE]


@pytest.mark.parametrize(("cell", "pairs", "volume"), IN_PLACE, ids=IDS)
def test_nodes_in_one_place_are_noted_and_the_body_rests(cell, pairs, volume):
    mesh = collapsed(cell, pairs)
    assert mesh.volume() == pytest.approx(1 + volume, rel=1e-12)
    simulation = scene_of(mesh).compile()
    assert any("among the cells, with a shape quality below" in n for n in simulation.plan().notes)
    # Constant strain: energy density times volume, though the Jacobian vanishes at an edge.
    F = np.array([[1.1, 0.05, 0.0], [0.02, 0.95, -0.03], [0.0, 0.04, 1.05]])
    E = (F.T @ F - np.eye(3)) / 2
    W = LAMBDA / 2 * np.trace(E) ** 2 + MU * np.trace(E @ E)
    rest = simulation.positions["body"].copy()
    simulation.positions["body"][:] = rest @ F.T
    assert simulation.energy()["elastic"] == pytest.approx(W * mesh.volume(), rel=1e-12)
    simulation.positions["body"][:] = rest
    assert simulation.step().converged
    moved = simulation.displacements("body")
    assert np.isfinite(moved).all()
    assert 0.01 < np.abs(moved).max() < 1.0  # it sags, by less than its length
    assert simulation.cell_fields("body")["volume_ratio"].min() > 0.5


@pytest.mark.parametrize("height", [1e-3, 1e-6, 1e-9])
@pytest.mark.parametrize("cell", CELLS)
def test_slivers_carry_constant_strain(cell, height):
    # The lower half of the cells of a cube is pressed into a layer of `height`. The cube stays
    # between sliding planes and is pulled: the answer is one stretch everywhere.
    linear = ts.bar_mesh(size=(1, 1, 1), cells=(2, 2, 2), cell=cell.rstrip("0123456789"))
    points = linear.points.copy()
    z = points[:, 2]
    points[:, 2] = np.where(z <= 0.5, 2 * height * z, height + (2 * z - 1) * (1 - height))
    mesh = raised(ts.Mesh(points=points, cells=linear.cells), cell)
    assert mesh.quality().size_ratio == pytest.approx(height, rel=0.01)
    planes = [
        ts.Box(*(tuple(a if i == axis else None for i in range(3)) for a in (-1e-12, 1e-12)))
        for axis in range(3)
    ]
    far = ts.Box((1 - 1e-9, None, None), (None, None, None))
    pull = {"times": [0, 1], "displacements": [(0, 0, 0), (0.1, 0, 0)]}
    scene = ts.Scene(
        bodies={"body": ts.Body(mesh=mesh, law=LAW, density=1e3)},
        fixed=[ts.Fixed("body", on=on, axes="xyz"[i]) for i, on in enumerate(planes)],
        prescribed=[ts.Prescribed("body", on=far, axes="x", **pull)],
        step=ts.Static(newton=ts.Newton(iterations=30, tolerance=1e-10), solver=ts.Cholesky()),
    )
    simulation = scene.compile()
    report = simulation.step()
    moved = simulation.positions["body"]
    assert report.converged, report
    side = np.sqrt(1 - 0.3 * (1.1**2 - 1))  # E_yy = -nu E_xx
    off = np.abs(moved - mesh.points * (1.1, side, side)).max()
    # Places are known to 1e-16 m, strains of the layer to 1e-16 / height, 1e-7 at worst: Newton
    # stops where forces are nothing but that, some 1e-5 of the load; what is left of 0.1 m is
    # another digit or two of its last, quadratic step. Ten times what it leaves.
    assert off < 1e-9


@pytest.mark.parametrize("raise_by", [0.2, 0.3])
def test_pyramids_with_edges_bent_to_the_tip_rest(raise_by):
    # Beyond 1/4 the map folds back at the tip itself (dz/dt = 1 - 4 raise_by there). Cells are
    # judged where they are integrated, and no quadrature point lies at the tip: both run.
    mesh = pyramid("pyramid13", (0.5, 0.5, 1.0))
    points = mesh.points.copy()
    points[mesh.cells[0].nodes[0, 9:], 2] += raise_by
    simulation = scene_of(
        ts.Mesh(points=points, cells=mesh.cells), on=ts.Box((None,) * 3, (None, None, 1e-9))
    ).compile()
    report = simulation.step()
    assert report.converged, report
    assert np.abs(simulation.displacements("body")).max() < 0.2
    assert simulation.cell_fields("body")["volume_ratio"].min() > 0.8


@pytest.mark.parametrize("cell", ["pyramid", "pyramid13"])
def test_pyramids_pressed_flat_are_finite_and_come_back(cell):
    # Their shape functions have the denominator 1 - z: no point may lie at the tip. Tips pressed
    # onto the base, and through it, give finite forces with a law that allows inversion.
    law = ts.StableNeoHooke(young=3e3, poisson=0.3)
    mesh = ts.bar_mesh(size=(1, 1, 1), cells=(1, 1, 1), cell=cell)
    viscosity = ts.Rayleigh(mass=5.0, stiffness=0.02)
    scene = ts.Scene(
        bodies={"body": ts.Body(mesh=mesh, law=law, density=1e3, viscosity=viscosity)},
        fixed=[ts.Fixed("body", on=ts.Nodes(range(8)))],
        step=ts.ImplicitEuler(dt=0.02, newton=ts.Newton(iterations=20), solver=ts.Cholesky()),
    )
    tip = mesh.cells[0].nodes[0, 4]
    for height in (0.0, -0.25):
        simulation = scene.compile()
        simulation.positions["body"][tip] = (0.5, 0.5, height)
        before = simulation.energy()["elastic"]
        assert np.isfinite(before)
        for report in simulation.run(3.0):
            assert report.converged, report
        # Damped by 5 / s of mass and more by stiffness: amplitudes fall by exp(-7.5), energies by
        # its square, 3e-7; a margin of 30 for the turmoil of the first steps.
        assert simulation.energy()["total"] < 1e-5 * before
        assert np.abs(simulation.displacements("body")).max() < 1e-2
