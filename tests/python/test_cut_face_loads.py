"""Dead loads on faces after cuts: each piece has the load of its own area of these faces."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tissu as ts
from cut_states import SOLVED

SIZE, DENSITY = (0.06, 0.03, 0.03), 1000.0
TRACTION = np.array([20.0, -10.0, -300.0])  # [Pa]
TOP = ts.Plane((0, 0, SIZE[2]), (0, 0, 1))
EXACT = 1e-12
"""Of the whole load: integrals of shape functions over parts of flat faces, but for round-off."""

CARRIERS = [
    *(
        (cell, "virtual")
        for cell in (
            "tetra",
            "hexahedron",
            "wedge",
            "pyramid",
            "tetra10",
            "hexahedron20",
            "hexahedron27",
            "wedge15",
            "pyramid13",
        )
    ),
    ("tetra", "subdivide"),
    ("tetra", "snap"),
]
LOADS = {"traction": TRACTION, "dead pressure": np.array([0.0, 0.0, -300.0])}


def _load(kind: str, body: str = "b", on: Any = TOP) -> Any:
    if kind == "traction":
        return ts.Traction(body, on=on, traction=tuple(TRACTION))
    return ts.Pressure(body, on=on, pressure=300.0, follows=False)


def _body(mesh: Any, **fields: Any) -> ts.Body:
    law = ts.StVK(young=1e4, poisson=0.3)
    return ts.Body(mesh=mesh, law=law, density=DENSITY, **fields)


def _scene(body: ts.Body, load: Any, method: Any = "virtual", dt: Any = "1 ms") -> ts.Scene:
    return ts.Scene(
        bodies={"b": body},
        loads=[load],
        step=ts.ImplicitEuler(dt, solver=ts.Cholesky(), newton=SOLVED),
        editing=ts.Editing(room=20.0, method=method),
    )


def _bar(cell: Any) -> ts.Body:
    return _body(ts.bar_mesh(size=SIZE, cells=(4, 2, 2), cell=cell))


def _nodes(simulation: ts.Simulation, piece: ts.Piece) -> Any:
    numbers = simulation.remaining_cells("b")
    blocks = simulation.meshes["b"].body_blocks
    rows = [row for block in blocks for row in block.nodes]
    own = [row for number, row in zip(numbers, rows, strict=True) if number in piece.cells]
    return np.unique(np.concatenate(own))


def _area(simulation: ts.Simulation, piece: ts.Piece) -> float:
    """Of the upper face at rest that a piece has [m2]: of its material, not of its nodes."""
    surface = simulation.surface("b")
    rest = surface.carried(simulation.meshes["b"].points)[surface.triangles]
    on = (np.abs(rest[:, :, 2] - SIZE[2]) < 1e-9).all(axis=1) & ~surface.cut
    on &= np.isin(surface.cell, piece.cells)
    sides = rest[on][:, 1:] - rest[on][:, :1]
    return float(0.5 * np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1).sum())


@pytest.mark.parametrize("kind", LOADS)
@pytest.mark.parametrize(("cell", "method"), CARRIERS)
def test_each_piece_has_the_load_of_its_own_area(cell: str, method: str, kind: str) -> None:
    random = np.random.default_rng(7)
    simulation = _scene(_bar(cell), _load(kind), method).compile()
    before = simulation.forces()[simulation.rows("b")].sum(axis=0)
    whole = float(np.abs(before).max())
    for _ in range(3):
        normal = random.standard_normal(3) * np.array([1, 0.5, 0.5])
        blade = ts.Plane((random.uniform(0.01, 0.05), 0.015, 0.015), tuple(normal))
        report = simulation.cut("b", blade)
        forces = simulation.forces()[simulation.rows("b")]
        np.testing.assert_allclose(forces.sum(axis=0), before, atol=EXACT * whole)
        places = simulation.meshes["b"].points
        torque = np.cross(places, forces).sum(axis=0)
        middle = np.array([0.5 * SIZE[0], 0.5 * SIZE[1], SIZE[2]])
        np.testing.assert_allclose(torque, np.cross(middle, before), atol=EXACT * whole)
        for piece in report.pieces:
            expected = LOADS[kind] * _area(simulation, piece)
            found = forces[_nodes(simulation, piece)].sum(axis=0)
            np.testing.assert_allclose(found, expected, atol=EXACT * whole)
    assert len(report.pieces) >= 4


@pytest.mark.parametrize("kind", LOADS)
@pytest.mark.parametrize(
    ("cell", "method"),
    [("tetra", "virtual"), ("hexahedron", "virtual"), ("tetra", "subdivide"), ("tetra", "snap")],
)
def test_a_slab_within_cells_moves_as_its_load_says(cell: str, method: str, kind: str) -> None:
    """Momentum is force times time. None of the slab's first nodes has material."""
    simulation = _scene(_bar(cell), _load(kind), method).compile()
    simulation.cut("b", ts.Plane((0.019, 0, 0), (1, 0, 0)))
    report = simulation.cut("b", ts.Plane((0.026, 0, 0), (1, 0, 0)))
    for _ in range(5):
        simulation.step()
    masses = simulation.mass_matrix().diagonal()[::3][simulation.rows("b")]
    widths = []
    for piece in report.pieces:
        nodes = _nodes(simulation, piece)
        momentum = masses[nodes] @ simulation.velocities["b"][nodes]
        widths.append(1e3 * piece.volume / (SIZE[1] * SIZE[2]))
        expected = 0.005 * LOADS[kind] * piece.volume / SIZE[2]
        np.testing.assert_allclose(momentum, expected, atol=1e-9 * np.abs(expected).max())
    assert sorted(widths) == pytest.approx([7, 19, 34])


@pytest.mark.parametrize("kind", LOADS)
@pytest.mark.parametrize("cell", ["tetra", "hexahedron", "hexahedron20"])
def test_a_cut_between_cells_gives_bodies_built_apart(cell: Any, kind: str) -> None:
    """Node by node, in 20 steps; Newton's tolerance is 1e-11 of the forces."""
    cut = _scene(_bar(cell), _load(kind), dt="2 ms").compile()
    report = cut.cut("b", ts.Plane((0.03, 0, 0), (1, 0, 0)))
    halves = {
        name: _body(
            ts.bar_mesh(size=(0.03, *SIZE[1:]), cells=(2, 2, 2), cell=cell, origin=(x, 0, 0))
        )
        for name, x in (("left", 0.0), ("right", 0.03))
    }
    apart = ts.Scene(
        bodies=halves,
        loads=[_load(kind, name) for name in halves],
        step=ts.ImplicitEuler("2 ms", solver=ts.Cholesky(), newton=SOLVED),
    ).compile()
    for _ in range(20):
        cut.step()
        apart.step()
    for piece in report.pieces:
        nodes = _nodes(cut, piece)
        rest, now = cut.meshes["b"].points[nodes], cut.positions["b"][nodes]
        name = "left" if rest[:, 0].mean() < 0.03 else "right"
        other = apart.meshes[name].points
        same = np.linalg.norm(rest[:, None] - other[None], axis=2).argmin(axis=1)
        moved = np.abs(now - rest).max()
        np.testing.assert_allclose(now, apart.positions[name][same], atol=1e-7 * moved)


@pytest.mark.parametrize("kind", LOADS)
@pytest.mark.parametrize("cell", ["hexahedron", "tetra10", "hexahedron20", "hexahedron27"])
def test_curved_faces_keep_the_whole_load(cell: Any, kind: str) -> None:
    mesh = ts.bar_mesh(size=SIZE, cells=(4, 2, 2), cell=cell)
    x, y, z = (6.0 * (mesh.points / SIZE)).T
    bent = np.stack([np.sin(y + z), np.sin(x + z), np.cos(x + y)], axis=1)
    body = _body(ts.Mesh(points=mesh.points + 0.002 * bent, cells=mesh.cells))
    simulation = _scene(body, _load(kind, on=ts.SurfaceNodes())).compile()
    before = simulation.forces()[simulation.rows("b")]
    for x_cut in (0.022, 0.027):
        simulation.cut("b", ts.Plane((x_cut, 0.015, 0.015), (1, 0.3, 0.2)))
        after = simulation.forces()[simulation.rows("b")].sum(axis=0)
        np.testing.assert_allclose(after, before.sum(axis=0), atol=1e-12 * np.abs(before).sum())


SHEETS = ("triangle", "quad", "triangle6", "quad8", "quad9")


@pytest.mark.parametrize("flat", [False, True])
@pytest.mark.parametrize("cell", SHEETS)
def test_sheets_and_rims_too(cell: Any, flat: bool) -> None:
    """A slab within cells, of a sheet in space and of a flat body whose rim is loaded."""
    width, thickness = 0.007, 2e-3
    mesh = ts.bar_mesh(size=(*SIZE[:2], 0), cells=(4, 2, 0), cell=cell)
    body = _body(mesh, thickness=thickness, **({"plane": "stress"} if flat else {}))
    on: Any = ts.Plane((0, SIZE[1], 0), (0, 1, 0)) if flat else ts.Box()
    load = ts.Traction("b", on=on, traction=(20.0, -10.0, 0.0))
    simulation = _scene(body, load).compile()
    simulation.cut("b", ts.Plane((0.019, 0, 0), (1, 0, 0)))
    report = simulation.cut("b", ts.Plane((0.019 + width, 0, 0), (1, 0, 0)))
    slab = min(report.pieces, key=lambda piece: piece.volume)
    area = width * (thickness if flat else SIZE[1])
    forces = simulation.forces()[simulation.rows("b")][_nodes(simulation, slab)]
    np.testing.assert_allclose(forces.sum(axis=0), area * np.array([20.0, -10.0, 0.0]), atol=1e-15)


@pytest.mark.parametrize(("cell", "method"), [CARRIERS[1], CARRIERS[4], *CARRIERS[-2:]])
def test_a_resumed_run_has_the_same_bits(cell: str, method: str, tmp_path: Path) -> None:
    """Edits in place leave no trace of those before: a checkpoint makes the body anew."""
    scene = _scene(_bar(cell), _load("traction"), method)
    live = scene.compile()
    for x in (0.019, 0.026):
        live.cut("b", ts.Plane((x, 0.015, 0.015), (1, 0.2, 0.1)))
        live.step()
    live.save_checkpoint(tmp_path / "there.ckpt")
    resumed = scene.compile(checkpoint=tmp_path / "there.ckpt")
    np.testing.assert_array_equal(resumed.forces(), live.forces())
    for simulation in (live, resumed):
        simulation.step()
    np.testing.assert_array_equal(resumed.positions["b"], live.positions["b"])
