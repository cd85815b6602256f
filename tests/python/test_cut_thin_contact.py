"""Sheets, shells and lines that are cut while they lie on a table or another body."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, audited, block, damped

GAP = 2e-4
"""[m]"""
KINDS = ("membrane", "shell", "line")
ACROSS = ts.Plane((0.047, 0, 0), (1, 0.1, 0))


def thin(kind: str, height: float, **fields: Any) -> ts.Body:
    """A strip or a thread of 10 cm at a height."""
    lines = kind == "line"
    size, cells = ((0.1, 0, 0), (16, 0, 0)) if lines else ((0.1, 0.03, 0), (16, 4, 0))
    made = {"section": "3 mm^2"} if lines else {"thickness": "2 mm"}
    if kind == "shell":
        made["model"] = "shell"
    flat = ts.bar_mesh(size=size, cells=cells, cell="line" if lines else "triangle")
    mesh = ts.Mesh(
        points=flat.points + np.array((0.0, 0.0, height)),
        cells={b.type: b.nodes for b in flat.cells},
        thin=(1,) if lines else (2,),
    )
    law = ts.Hooke(young=1e5, poisson=0.3)
    return ts.Body(**({"mesh": mesh, "law": law, "density": 1000.0} | made | fields))


def lying(kind: str, **changes: Any) -> ts.Scene:
    """It lies on a table, by its half thickness and the gap above it."""
    half = np.sqrt(3e-6 / np.pi) if kind == "line" else 1e-3
    given = {
        "bodies": {"thin": thin(kind, half + GAP, viscosity=damped())},
        "gravity": (0, 0, -GRAVITY),
        "obstacles": {"table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        "contacts": [ts.Contact(("thin", "table"), friction=0.3, gap=GAP)],
        "step": ts.ImplicitEuler("5 ms"),
        "editing": True,
    }
    return ts.Scene(**(given | changes))


@pytest.mark.parametrize("kind", KINDS)
def test_contacts_of_what_stays_keep_their_forces_to_the_bit(kind: str) -> None:
    simulation = lying(kind).compile()
    audited(simulation, 20)
    before = simulation.contacts()
    report = simulation.cut("thin", ACROSS)
    assert len(report.pieces) == 2
    assert simulation.crossings() == []
    after = simulation.contacts()
    was = {tuple(n): f for n, f in zip(before.nodes.tolist(), before.forces, strict=True)}
    assert len(after) > 0.5 * len(was)
    for nodes, force in zip(after.nodes.tolist(), after.forces, strict=True):
        assert np.array_equal(force, was[tuple(nodes)])
    audited(simulation, 20)
    weight = GRAVITY * sum(piece.mass for piece in report.pieces)
    assert simulation.force_on("table").force[2] == pytest.approx(-weight, rel=1e-3)


@pytest.mark.parametrize("kind", KINDS)
def test_momentum_is_conserved_when_it_is_cut_on_another_body(kind: str) -> None:
    """It flies onto a block that nothing holds, is cut there and goes on."""
    solver = ts.ConjugateGradient(tolerance=1e-12)
    made = lying(
        kind,
        bodies={
            "thin": thin(kind, 2.5e-3, start=ts.Start(velocity=(0.05, 0.0, -0.3))),
            "block": block((0.02, -0.02, -0.03), size=(0.06, 0.06, 0.03), young=2e4),
        },
        gravity=None,
        obstacles={},
        contacts=[ts.Contact(("thin", "block"), friction=0.3, gap=GAP)],
        step=ts.ImplicitEuler("2 ms", solver=solver),
    )
    simulation = made.compile()

    def momentum() -> Any:
        return sum(simulation._core.totals(body)["momentum"] for body in ("thin", "block"))

    first = momentum()
    met = 0
    for number in range(40):
        if number == 8:
            assert len(simulation.cut("thin", ACROSS).pieces) == 2
            assert simulation.crossings() == []
        simulation.step()
        assert simulation.crossings() == []
        assert momentum() == pytest.approx(first, abs=1e-9 * np.linalg.norm(first))
        met += len(simulation.contacts()) > 0
    assert met > 2


@pytest.mark.parametrize("kind", KINDS)
def test_a_checkpoint_after_a_cut_goes_on_with_the_same_bits(kind: str, tmp_path: Any) -> None:
    made = lying(kind)
    simulation = made.compile()
    audited(simulation, 5)
    simulation.cut("thin", ACROSS)
    audited(simulation, 5)
    simulation.save_checkpoint(tmp_path / "cut.ckpt")
    other = made.compile(checkpoint=tmp_path / "cut.ckpt")
    for one in (simulation, other):
        audited(one, 10)
    assert len(simulation.contacts()) > 4
    assert np.array_equal(simulation.positions["thin"], other.positions["thin"])
    assert np.array_equal(simulation.contacts().forces, other.contacts().forces)
