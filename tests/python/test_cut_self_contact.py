"""Sheets and lines that meet themselves while they are cut."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, audited, damped

THICKNESS = 2e-3
"""[m]"""
GAP = 2e-4
"""[m]"""
LENGTH, WIDTH, HEIGHT = 0.1, 0.04, 0.02
"""of a sheet that is folded at rest, and of the fold [m]"""


def folded(along: int = 8, across: int = 4) -> ts.Mesh:
    """A sheet that runs along x at z = 0, turns back on half a circle and runs back above."""
    radius = HEIGHT / 2
    turn = 6
    straight = np.linspace(0.0, LENGTH, along + 1)
    angles = np.linspace(0.0, np.pi, turn + 1)[1:-1]
    below = np.stack([straight, np.zeros(along + 1)], axis=1)
    bend = np.stack([LENGTH + radius * np.sin(angles), radius - radius * np.cos(angles)], axis=1)
    profile = np.concatenate([below, bend, below[::-1] + np.array((0.0, HEIGHT))])
    flat = ts.bar_mesh(
        size=(len(profile) - 1, WIDTH, 0), cells=(len(profile) - 1, across, 0), cell="triangle"
    )
    place = profile[np.rint(flat.points[:, 0]).astype(int)]
    points = np.stack([place[:, 0], flat.points[:, 1], place[:, 1]], axis=1)
    return ts.Mesh(points=points, cells={b.type: b.nodes for b in flat.cells}, thin=(2,))


def fold(**changes: Any) -> ts.Scene:
    """A shell folded over itself, whose lower part is held."""
    body = ts.Body(
        mesh=folded(),
        model="shell",
        law=ts.Hooke(young="100 kPa", poisson=0.3),
        density=1000.0,
        thickness=THICKNESS,
        viscosity=damped(),
    )
    given = {
        "bodies": {"sheet": body},
        "gravity": (0, 0, -GRAVITY),
        "contacts": [ts.SelfContact("sheet", friction=0.3, gap=GAP)],
        "fixed": [ts.Fixed("sheet", on=ts.Box(max=(None, None, 1e-6)))],
        "step": ts.ImplicitEuler("5 ms"),
        "editing": ts.Editing(room="200 %"),
    }
    return ts.Scene(**(given | changes))


def upper(x: float, lean: float = 0.0) -> ts.Triangles:
    """A blade across the upper part alone."""
    low, high, wide = HEIGHT / 2, 2 * HEIGHT, WIDTH
    ends = [(x - lean, -wide, z) for z in (low, high)] + [
        (x + lean, 2 * wide, z) for z in (high, low)
    ]
    return ts.Triangles(ends, [(0, 1, 2), (0, 2, 3)])


def joint(simulation: ts.Simulation, body: str = "sheet") -> Any:
    """The force that the lower one of a body's two pieces bears in contact with the upper [N]."""
    found = simulation.contacts()
    own = (found.pairs == found.surfaces.index(body)).all(axis=1)
    upward = np.sign(found.normals[own][:, 2:])
    return -(found.forces[own] * upward).sum(axis=0)


def energy(simulation: ts.Simulation) -> float:
    return float(simulation.energy()["total"])


def test_a_piece_of_a_folded_sheet_falls_on_the_other_half_and_weighs_what_it_weighs() -> None:
    bend = ts.Fixed("sheet", on=ts.Box(min=(0.074, None, None)))  # from a row of nodes on
    made = fold()
    simulation = made.replace(fixed=[*made.fixed, bend]).compile()
    report = simulation.cut("sheet", upper(0.07, 0.004))
    assert simulation.crossings() == []
    (piece,) = (piece for piece in report.pieces if not piece.held)
    audited(simulation, 160)
    bears = -joint(simulation)
    assert bears[2] == pytest.approx(GRAVITY * piece.mass, rel=2e-3)
    # It lies a thickness and a gap above the lower half.
    surface = simulation.surface("sheet")
    lying = surface.points[surface.points[:, 0] < 0.05]
    above = lying[lying[:, 2] > 1e-4]
    assert above[:, 2].min() > 0.9 * (THICKNESS + GAP)
    assert above[:, 2].min() < 1.2 * (THICKNESS + GAP)


def window(**changes: Any) -> ts.Scene:
    """A soft sheet in a frame, level, above a table."""
    body = ts.Body(
        mesh=ts.bar_mesh(size=(0.12, 0.12, 0), cells=(12, 12, 0), cell="triangle"),
        model="shell",
        law=ts.Hooke(young="100 kPa", poisson=0.3),
        density=1000.0,
        thickness=THICKNESS,
        viscosity=damped(),
    )
    rim = [
        ts.Fixed("sheet", on=ts.Plane(point, normal))
        for point in ((0, 0, 0), (0.12, 0.12, 0))
        for normal in ((1, 0, 0), (0, 1, 0))
    ]
    given = {
        "bodies": {"sheet": body},
        "gravity": (0, 0, -GRAVITY),
        "obstacles": {"table": ts.PlaneObstacle((0, 0, -0.04), (0, 0, 1))},
        "contacts": [
            ts.Contact(("sheet", "table"), friction=0.3, gap=GAP),
            ts.SelfContact("sheet", friction=0.3, gap=GAP),
        ],
        "fixed": rim,
        "step": ts.ImplicitEuler("5 ms"),
        "editing": ts.Editing(room="400 %"),
    }
    return ts.Scene(**(given | changes))


FLAP = ts.Sweep(
    [
        [(x, y, -0.03), (x, y, 0.03)]
        for x, y in ((0.033, 0.034), (0.094, 0.034), (0.094, 0.087), (0.033, 0.087))
    ]
)
"""Three sides of a flap, which stays joined along x = 3.3 cm."""


def test_a_flap_that_is_cut_into_a_sheet_hangs_down_onto_a_table() -> None:
    """Its edges leave those of the window; energy never grows, and nothing crosses.

    Forces and systems end at tolerances: it may grow by a hundred-thousandth of what was lost.
    """
    simulation = window().compile()
    audited(simulation, 40)
    before = energy(simulation)
    report = simulation.cut("sheet", FLAP)
    assert len(report.pieces) == 1
    assert simulation.crossings() == []
    assert energy(simulation) == pytest.approx(before, rel=1e-12)
    last = before
    for _ in range(160):
        audited(simulation, 1)
        now = energy(simulation)
        assert now <= last + 1e-5 * (before - now)
        last = now
    lowest = simulation.surface("sheet").points[:, 2].min()
    assert lowest == pytest.approx(-0.04 + THICKNESS / 2 + GAP, abs=THICKNESS / 4)
    assert simulation.force_on("table").force[2] < -1e-3


def test_a_cut_conserves_momentum_and_energy_and_what_follows_does_too() -> None:
    """A fold without a support that flies and turns; its parts meet after the cut."""
    solver = ts.ConjugateGradient(tolerance=1e-12)
    made = fold(fixed=[], gravity=(0, 0, 0), step=ts.ImplicitEuler("5 ms", solver=solver))
    sheet = made.bodies["sheet"].replace(viscosity=None)
    simulation = made.replace(bodies={"sheet": sheet}).compile()
    points = simulation.positions["sheet"]
    velocities = simulation.velocities["sheet"]
    velocities[:] = (0.3, 0.0, 0.1)
    velocities[points[:, 2] > 0.015, 2] -= 0.4
    audited(simulation, 4)
    before, momentum = energy(simulation), simulation._core.totals("sheet")["momentum"]
    scale = np.linalg.norm(momentum)
    report = simulation.cut("sheet", upper(0.07, 0.004))
    assert len(report.pieces) == 2
    assert energy(simulation) == pytest.approx(before, rel=1e-12)
    met, last = 0, before
    for _ in range(80):
        audited(simulation, 1)
        found = simulation._core.totals("sheet")["momentum"]
        assert found == pytest.approx(momentum, abs=1e-9 * scale)
        now = energy(simulation)
        assert now <= last * (1.0 + 1e-9)
        met, last = met + (len(simulation.contacts()) > 0), now
    assert met > 5


@pytest.mark.parametrize("through", ["cells", "nodes"])
def test_contacts_of_what_stays_keep_their_forces_to_the_bit(through: str) -> None:
    """A piece lies on the lower half when its end is cut off.

    Nodes on the edge of the cut keep their numbers, but contact meets them elsewhere from then on.
    """
    simulation = fold().compile()
    simulation.cut("sheet", upper(0.07))
    audited(simulation, 120)
    before = simulation.contacts()
    ends = simulation.positions["sheet"].copy()
    rest = simulation.meshes["sheet"].points
    row = np.flatnonzero((abs(rest[:, 0] - LENGTH / 8) < 1e-9) & (rest[:, 2] > HEIGHT / 2))
    assert len(row) == 5
    x = ends[row, 0].mean() - (5e-4 if through == "cells" else 0.0)
    # The blade reaches from the middle of the gap upwards, as the piece lies.
    z = THICKNESS / 2
    blade = [(x, -1, z), (x, 1, z), (x, 1, 1), (x, -1, 1)]
    simulation.cut("sheet", ts.Triangles(blade, [(0, 1, 2), (0, 2, 3)]))
    assert len(simulation.pieces("sheet")) == 3
    after = simulation.contacts()
    assert np.array_equal(simulation.positions["sheet"][: len(ends)], ends)
    was, stays = by_nodes(before), by_nodes(after)
    assert len(was) > len(stays) > 20
    for key, force in stays.items():
        assert np.array_equal(force, was[key])
    away = {key for key in was if all(node >= 0 and ends[node, 0] > 0.03 for node, _ in key)}
    assert away <= set(stays)
    assert len(away) > 10
    on_edge = set(row.tolist())
    assert any(node in on_edge for key in was for node, _ in key)
    if through == "nodes":
        assert not any(node in on_edge for key in stays for node, _ in key)
    audited(simulation, 20)


def by_nodes(found: ts.Contacts) -> dict[frozenset[tuple[int, float]], Any]:
    """The force of each contact on the side with the lowest node, by nodes and weights."""
    forces = {}
    for nodes, weights, force in zip(found.nodes, found.weights, found.forces, strict=True):
        there = {int(n): float(w) for n, w in zip(nodes, weights, strict=True) if n != -1}
        sign = np.sign(there[min(there)])
        forces[frozenset((n, sign * w) for n, w in there.items())] = sign * force
    return forces


def run_with_cut(threads: int, *, way: str) -> ts.Simulation:
    """Straight on, or after a rewind."""
    simulation = fold(threads=threads).compile()
    audited(simulation, 5)
    simulation.cut("sheet", upper(0.07, 0.004))
    audited(simulation, 15)
    mark = simulation.mark()
    if way == "rewind":
        simulation.cut("sheet", upper(0.04))
        audited(simulation, 5)
        simulation.rewind(mark)
    audited(simulation, 15)
    return simulation


def test_bits_are_the_same_on_two_threads_after_a_rewind_and_from_a_checkpoint(
    tmp_path: Any,
) -> None:
    one = run_with_cut(1, way="straight")
    assert len(one.contacts()) > 4
    for other in (run_with_cut(2, way="straight"), run_with_cut(1, way="rewind")):
        assert np.array_equal(one.positions["sheet"], other.positions["sheet"])
        assert np.array_equal(one.contacts().forces, other.contacts().forces)
    one.save_checkpoint(tmp_path / "cut.ckpt")
    other = fold(threads=1).compile(checkpoint=tmp_path / "cut.ckpt")
    for simulation in (one, other):
        audited(simulation, 10)
    assert np.array_equal(one.positions["sheet"], other.positions["sheet"])
    assert np.array_equal(one.contacts().forces, other.contacts().forces)


@pytest.mark.parametrize("kind", ["sheet", "line"])
def test_edges_of_a_cut_that_are_pressed_together_bear_what_the_material_bears(kind: str) -> None:
    """A strip and a thread are cut and shortened: E A strain, as if they were whole.

    The force acts a depth inside each edge, so that twice the depth of the length is not strained.
    """
    length, young, way = 0.2, 1e5, 1e-3
    lines = kind == "line"
    section = THICKNESS * WIDTH if not lines else np.pi * (THICKNESS / 2) ** 2
    body = ts.Body(
        mesh=ts.bar_mesh(
            size=(length, 0.0 if lines else WIDTH, 0),
            cells=(20, 0 if lines else 4, 0),
            cell="line" if lines else "triangle",
        ),
        law=ts.Hooke(young=young, poisson=0.0),
        density=1000.0,
        viscosity=damped(),
        **({"section": section} if lines else {"thickness": THICKNESS, "model": "shell"}),
    )
    ends = [
        ts.Prescribed(
            "strip",
            on=ts.Plane((x, 0, 0), (1, 0, 0)),
            times=(0, 0.5),
            displacements=((0, 0, 0), (sign * way / 2, 0, 0)),
        )
        for x, sign in ((0.0, 1.0), (length, -1.0))
    ]
    simulation = ts.Scene(
        bodies={"strip": body},
        contacts=[ts.SelfContact("strip", gap=GAP)],
        prescribed=ends,
        step=ts.ImplicitEuler("5 ms"),
        editing=True,
    ).compile()
    report = simulation.cut("strip", ts.Disc((0.09, 0, 0), (1, 0, 0), 0.1))
    assert len(report.pieces) == 2
    audited(simulation, 200)
    found = simulation.contacts()
    through = np.abs((found.forces * np.sign(found.normals[:, :1]))[:, 0].sum())
    depth = (THICKNESS / 2 + GAP / 2) / 0.99
    expected = young * section * way / (length - 2 * depth)
    assert through == pytest.approx(expected, rel=2e-2)
    x = simulation.surface("strip").points[:, 0]
    assert x.min() == pytest.approx(way / 2)
