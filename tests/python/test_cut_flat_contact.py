"""Flat bodies that are cut while they touch: their rims follow the cuts."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, audited, damped
from test_contact_flat import SIDE, WEIGHT, flat, resting
from tissu.compile.contact_surface import body_surface

GAP = 4e-4
"""[m]"""


def square(origin: tuple[float, float] = (0, 0), *, z: float = 0.0, **fields: Any) -> ts.Body:
    """A square of 10 cm in a plane across z, with damping."""
    body = flat(origin, viscosity=damped(20.0, 1e-3), **fields)
    mesh = body.mesh.mesh()
    points = mesh.points + np.array((0.0, 0.0, z))
    return body.replace(
        mesh=ts.Mesh(points=points, cells={b.type: b.nodes for b in mesh.cells}, thin=(2,))
    )


def standing(body: ts.Body | None = None, **changes: Any) -> ts.Scene:
    """A square that is held at its bottom and meets itself."""
    given = {
        "bodies": {"square": body or square()},
        "obstacles": {},
        "contacts": [ts.SelfContact("square", friction=0.3, gap=GAP)],
        "fixed": [ts.Fixed("square", on=ts.Plane((0, 0, 0), (0, 1, 0)))],
        "editing": ts.Editing(room="200 %"),
    }
    return resting(**(given | changes))


def across(height: float, lean: float = 0.0) -> ts.Plane:
    return ts.Plane((0, height, 0), (lean, 1, 0))


def joint(simulation: ts.Simulation) -> Any:
    """The force of the upper one of two pieces on the lower [N]."""
    found = simulation.contacts()
    upward = np.sign(found.normals[:, 1:2])
    return -(found.forces * upward).sum(axis=0)


@pytest.mark.parametrize(
    ("cell", "method"), [("quad", "virtual"), ("triangle", "virtual"), ("triangle", "subdivide")]
)
@pytest.mark.parametrize("z", [0.0, 0.013])
def test_a_piece_rests_on_the_body_that_it_was_cut_from(cell: str, method: str, z: float) -> None:
    editing = ts.Editing(method=method, room="400 %")
    simulation = standing(square(cell=cell, z=z), editing=editing).compile()
    audited(simulation, 60)
    report = simulation.cut("square", across(0.041, 0.1))
    assert simulation.crossings() == []
    (piece,) = (piece for piece in report.pieces if not piece.held)
    audited(simulation, 160)
    assert -joint(simulation)[1] == pytest.approx(GRAVITY * piece.mass, rel=2e-3)


@pytest.mark.parametrize("method", ["impulse", "penalty", "geometric"])
def test_a_piece_rests_in_explicit_steps(method: str) -> None:
    """To 2 %: it vibrates, and single steps bear more or less than the weight."""
    settings = ts.ContactSettings(method=method)
    simulation = standing(step=ts.SymplecticEuler(), contact=settings).compile()
    report = simulation.cut("square", across(0.041, 0.1))
    (piece,) = (piece for piece in report.pieces if not piece.held)
    forces = []
    while simulation.time < 0.3:
        simulation.step()
        assert simulation.crossings() == []
        if simulation.time > 0.15:
            forces.append(-joint(simulation)[1])
    assert np.mean(forces) == pytest.approx(GRAVITY * piece.mass, rel=0.02)


def crossings_of_pieces(z: float) -> int:
    """Of a square across z whose upper piece is put into the lower one."""
    simulation = standing(square(z=z)).compile()
    simulation.cut("square", across(0.041, 0.1))
    assert simulation.crossings() == []
    (upper,) = (piece for piece in simulation.pieces("square") if not piece.held)
    (block,) = simulation.meshes["square"].body_blocks
    own = np.isin(simulation.remaining_cells("square"), upper.cells)
    simulation.positions["square"][np.unique(block.nodes[own]), 1] -= 0.01
    return len(simulation.crossings())


def test_rims_that_cross_are_found_whatever_their_z() -> None:
    """Several nodes carry a point of a cut, so that its z is theirs to round-off only."""
    assert crossings_of_pieces(0.0) == crossings_of_pieces(0.1) == 2


def test_a_square_that_is_cut_on_a_floor_weighs_what_it_weighs() -> None:
    """Both parts of a square without a support, which does not meet itself."""
    simulation = resting(body=square((0, 1e-3)), editing=True).compile()
    audited(simulation, 60)
    before = simulation.contacts()
    report = simulation.cut("square", ts.Plane((0.047, 0, 0), (1, 0.1, 0)))
    assert len(report.pieces) == 2
    after = simulation.contacts()
    known = {tuple(n): f for n, f in zip(before.nodes.tolist(), before.forces, strict=True)}
    kept = [n for n in after.nodes.tolist() if tuple(n) in known]
    assert len(kept) >= 3
    for nodes, force in zip(after.nodes.tolist(), after.forces, strict=True):
        assert np.array_equal(force, known[tuple(nodes)])
    audited(simulation, 160)
    assert simulation.force_on("floor").force[1] == pytest.approx(-WEIGHT, rel=2e-3)


def squeezed(*, cut: bool, **changes: Any) -> float:
    """What the sides of a square with a slit bear that are pressed together by 8 % [N]."""
    sides = [
        ts.Prescribed(
            "square",
            on=ts.Plane((x, 0, 0), (1, 0, 0)),
            axes="xy",
            times=(0, 0.3),
            displacements=((0, 0, 0), (way, 0, 0)),
        )
        for x, way in ((0.0, 4e-3), (SIDE, -4e-3))
    ]
    below = ts.PlaneObstacle((0, -1, 0), (0, 1, 0))
    free = {"gravity": None, "prescribed": sides, "fixed": [], "obstacles": {"floor": below}}
    simulation = standing(square(cells=(8, 8)), **free, **changes).compile()
    if cut:
        report = simulation.cut("square", ts.Disc((0.047, SIDE, 0), (1, 0.1, 0), 0.06))
        assert len(report.pieces) == 1
    audited(simulation, 100)
    return float(simulation.reactions("square")[:, 0].clip(min=0.0).sum())


def test_a_slit_that_is_pressed_together_bears_as_if_it_were_whole() -> None:
    """To 2 %: its walls bear in points. Without contact it bears a third less."""
    whole = squeezed(cut=False)
    assert squeezed(cut=True) == pytest.approx(whole, rel=0.02)
    apart = [ts.Contact(("square", "floor"))]
    assert squeezed(cut=True, contacts=apart) < 0.75 * whole


@pytest.mark.parametrize("way", ["threads", "rewind", "checkpoint"])
def test_bits_are_the_same(way: str, tmp_path: Any) -> None:
    def run(threads: int = 1, *, rewound: bool = False) -> ts.Simulation:
        simulation = standing(threads=threads).compile()
        audited(simulation, 5)
        simulation.cut("square", across(0.041, 0.1))
        audited(simulation, 10)
        mark = simulation.mark()
        if rewound:
            simulation.cut("square", ts.Plane((0.04, 0, 0), (1, 0, 0)))
            audited(simulation, 5)
            simulation.rewind(mark)
        audited(simulation, 10)
        return simulation

    one = run()
    assert len(one.contacts()) > 2
    if way == "checkpoint":
        one.save_checkpoint(tmp_path / "cut.ckpt")
        other = standing(threads=1).compile(checkpoint=tmp_path / "cut.ckpt")
        for simulation in (one, other):
            audited(simulation, 10)
    else:
        other = run(2) if way == "threads" else run(rewound=True)
    assert np.array_equal(one.positions["square"], other.positions["square"])
    assert np.array_equal(one.contacts().forces, other.contacts().forces)


@pytest.mark.parametrize("cell", ["quad", "triangle", "quad8", "quad9", "triangle6"])
def test_a_square_that_lost_cells_has_the_rim_of_the_others(cell: str) -> None:
    """In the order that compilation has: which edits led there changes no bit."""
    body = flat(cell=cell)
    simulation = standing(
        body,
        obstacles={"floor": ts.PlaneObstacle((0, -1, 0), (0, 1, 0))},
        contacts=[ts.Contact(("square", "floor"))],
        fixed=[],
    ).compile()
    rng = np.random.default_rng(7)
    for cells in np.array_split(rng.permutation(body.mesh.mesh().cell_count)[:7], 2):
        simulation.remove_cells(body="square", cells=cells)
    triangles, edges, radius, closed = simulation._core.contact_surface("square")
    expected = body_surface(simulation.meshes["square"], body)
    assert len(triangles) == 0
    assert len(radius) == 0
    assert closed == expected.closed
    assert np.array_equal(edges, expected.edges)
