"""A pressure stays on the faces that it acts on when these are cut; opened faces carry none."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tissu as ts
from cut_states import shaken
from same_ends import require_same_ends, steps

ROUND_OFF = 1e-12
"""Of sums over some hundred numbers: a few hundred times the spacing of doubles."""
PRESSURE = 3000.0
TOP = ts.Plane((0, 0, 0.04), (0, 0, 1))
LAW = ts.StVK(young=2e5, poisson=0.3)


def bar(cell: str = "tetra") -> ts.Body:
    mesh = ts.bar_mesh(size=(0.2, 0.06, 0.04), cells=(8, 3, 2), cell=cell)
    return ts.Body(mesh=mesh, law=LAW, density=1000.0)


def sheet() -> ts.Body:
    mesh = ts.bar_mesh(size=(0.2, 0.06, 0), cells=(12, 4, 0), cell="triangle")
    return ts.Body(mesh=mesh, law=LAW, density=1000.0, thickness=2e-3)


def scene(body: ts.Body, **changes: Any) -> ts.Scene:
    on = TOP if body.thickness is None else ts.Box(min=(-1, -1, -1))
    return ts.Scene(
        **{
            "bodies": {"body": body},
            "loads": [ts.Pressure("body", on=on, pressure=PRESSURE)],
            "step": ts.ImplicitEuler("2 ms"),
            "editing": ts.Editing(room="3000 %"),
        }
        | changes
    )


def resultants(simulation: ts.Simulation) -> np.ndarray[Any, Any]:
    """Force and moment of all forces about the origin (6,); those inside sum to zero."""
    forces = simulation.forces()[simulation.rows("body")]
    return np.append(forces.sum(axis=0), np.cross(simulation.positions["body"], forces).sum(axis=0))


def random_blade(random: np.random.Generator, body: ts.Body) -> Any:
    thick = 0.04 if body.thickness is None else 0.002
    center = random.uniform((0, 0, 0), (0.2, 0.06, thick))
    normal = random.standard_normal(3)
    if random.random() < 0.3:  # along faces of cells at rest
        normal = np.eye(3)[random.integers(2)]
    if random.random() < 0.3:
        return ts.Plane(tuple(center), tuple(normal))
    return ts.Disc(center, normal, random.uniform(0.01, 0.05))


@pytest.mark.parametrize("body", [bar(), bar("hexahedron"), bar("wedge"), sheet()])
@pytest.mark.parametrize("shake", [False, True])
def test_random_cuts_keep_the_resultants(body: ts.Body, shake: bool) -> None:
    """Force and moment, of bent quads too."""
    random = np.random.default_rng(7)
    simulation = scene(body).compile()
    if shake:
        shaken(simulation, 3)
    before, cut = resultants(simulation), 0
    size = PRESSURE * 0.2 * 0.06
    assert np.abs(before[:3]).max() > 0.5 * size
    for _ in range(10):
        report = simulation.cut("body", random_blade(random, body))
        cut += report.cells_cut > 0
        after = resultants(simulation)
        np.testing.assert_allclose(after, before, rtol=0, atol=ROUND_OFF * size)
    assert cut >= 5


@pytest.mark.parametrize("body", [bar(), bar("hexahedron"), sheet()])
def test_each_piece_bears_the_pressure_on_its_own_face_and_none_on_the_cut(body: ts.Body) -> None:
    simulation = scene(body).compile()
    report = simulation.cut("body", ts.Plane((0.137, 0, 0), (1, 0, 0)))
    forces = simulation.forces()[simulation.rows("body")]
    assert len(report.pieces) == 2
    down = -PRESSURE if body.thickness is None else PRESSURE * np.sign(forces[:, 2].sum())
    for piece, length in zip(report.pieces, (0.137, 0.063), strict=True):
        found = np.zeros(3)
        for block in simulation.meshes["body"].body_blocks:
            inside = np.isin(simulation.remaining_cells("body"), piece.cells)
            found = forces[np.unique(block.nodes[inside])].sum(axis=0)
        np.testing.assert_allclose(found, (0, 0, down * 0.06 * length), rtol=0, atol=1e-9)


@pytest.mark.parametrize("body", [bar(), sheet()])
def test_a_cell_that_is_divided_and_not_parted_has_the_forces_and_stiffness_as_before(
    body: ts.Body,
) -> None:
    """Parts of a flat face give its nodes what it gave itself: linear functions are exact."""
    simulation = shaken(scene(body).compile(), 5)
    first = np.array(simulation.forces()), simulation.stiffness()
    height = 0.04 if body.thickness is None else 0.0
    sharp = ts.Disc((0.1, -0.02, height), (1.0, 0.2, 0.1), "36 mm")
    report = simulation.cut("body", sharp)
    count = len(simulation.positions["body"])
    born = simulation.born("body")
    assert report.cells_cut > 0
    forces = simulation.forces()[simulation.rows("body")]
    summed = np.zeros((born.max() + 1, 3))
    np.add.at(summed, born, forces)
    size = np.abs(first[0]).max()
    rows = simulation.rows("body").start
    expected = first[0][rows : rows + len(summed)]
    np.testing.assert_allclose(summed, expected, rtol=0, atol=1e-11 * size)
    now, then = simulation.stiffness(), first[1]
    gather = np.zeros((3 * len(summed), 3 * count))
    for node, root in enumerate(born):
        for axis in range(3):
            gather[3 * root + axis, 3 * node + axis] = 1.0
    part = slice(3 * rows, 3 * (rows + count))
    found = gather @ now[part, part].toarray() @ gather.T
    old = then.toarray()[3 * rows : 3 * rows + len(found), 3 * rows : 3 * rows + len(found)]
    np.testing.assert_allclose(found, old, rtol=0, atol=1e-11 * np.abs(old).max())


def test_a_cut_body_under_pressure_goes_on_with_the_same_bits(tmp_path: Path) -> None:
    held = [ts.Fixed("body", on=ts.Plane((x, 0, 0), (1, 0, 0))) for x in (0, 0.2)]
    runs = [scene(bar(), fixed=held, threads=threads).compile() for threads in (1, 2)]
    blade = ts.Plane((0.09, 0, 0), (1.0, 0.2, 0.1))
    for simulation in runs:
        simulation.step()
        simulation.cut("body", blade)
        for _ in range(3):
            assert simulation.step().converged
    require_same_ends(runs, "body", steps(3), tmp_path)


def test_a_pressure_is_changed_after_a_cut_as_before() -> None:
    simulation = scene(bar()).compile()
    whole = resultants(simulation)
    simulation.load(0).pressure = 3.0 * PRESSURE
    simulation.cut("body", ts.Plane((0.09, 0, 0), (1.0, 0.2, 0.1)))
    np.testing.assert_allclose(resultants(simulation), 3.0 * whole, rtol=0, atol=1e-10)
    simulation.load(0).pressure = 2.0 * PRESSURE
    np.testing.assert_allclose(resultants(simulation), 2.0 * whole, rtol=0, atol=1e-10)


def test_cells_that_go_take_their_pressure_along() -> None:
    simulation = scene(bar("hexahedron")).compile()
    simulation.cut("body", ts.Disc((0.1, 0.03, 0.04), (0, 1, 0), "1 cm"))
    before = resultants(simulation)[2]
    simulation.ablate("body", ts.Box(min=(0.15, -1, -1), max=(0.175, 1, 1)))
    assert resultants(simulation)[2] - before == pytest.approx(PRESSURE * 0.025 * 0.06, rel=1e-9)
    (numbers,) = [simulation.remaining_cells("body")]
    simulation.remove_cells(body="body", cells=numbers[:1])
    assert simulation.step().converged


def test_curved_faces_and_edges_are_refused_in_a_sentence() -> None:
    curved = scene(bar("tetra10")).compile()
    with pytest.raises(ts.ParameterError, match="faces of type triangle6, which are curved"):
        curved.cut("body", ts.Plane((0.1, 0, 0), (1, 0, 0)))
    flat = sheet().replace(plane="stress")
    rim = [ts.Pressure("body", on=ts.Plane((0, 0, 0), (1, 0, 0)), pressure=PRESSURE)]
    with pytest.raises(ts.ParameterError, match="acts on edges of a flat body"):
        scene(flat, loads=rim).compile().cut("body", ts.Plane((0.1, 0, 0), (1, 0, 0)))
