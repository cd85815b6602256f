"""Loads of nodes that several edits part: what a copy gets depends on what is left alone."""

import numpy as np
import pytest

import tissu as ts


def bar():
    """A bar with a load on its upper face; no gravity, so that forces at rest are the load."""
    body = ts.Body(
        mesh=ts.BarMesh(size=(0.12, 0.06, 0.06), cells=(6, 3, 3), cell="tetra"),
        law=ts.StableNeoHooke(young="20 kPa", poisson=0.4),
        density=1000.0,
    )
    return ts.Scene(
        bodies={"bar": body},
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        loads=[ts.NodalLoad("bar", on=ts.Plane((0, 0, 0.06), (0, 0, 1)), force=(0, 1, 0))],
        step=ts.ImplicitEuler("5 ms"),
        editing=ts.Editing(room=3.0),
    )


ACROSS, ALONG = ts.Plane((0.08, 0, 0), (1, 0, 0)), ts.Plane((0, 0.02, 0), (0, 1, 0))
"""Through nodes, whose material they part."""
BALL = ts.Sphere((0.07, 0.02, 0.06), 0.02)
EDITS = {
    "ablated, then cut": (BALL, ACROSS),
    "cut, then ablated": (ACROSS, BALL),
    "cut twice": (ACROSS, ALONG),
}


@pytest.mark.parametrize("edits", EDITS.values(), ids=EDITS)
def test_copies_share_a_load_as_they_share_the_mass(tmp_path, edits):
    """Against the mass matrix, and against a checkpoint, which makes all edits at once.

    Sums of shares are right to round-off: 1e-12 of the load.
    """
    scene = bar()
    simulation = scene.compile()
    for blade in edits:
        act = simulation.ablate if isinstance(blade, ts.Sphere) else simulation.cut
        act("bar", blade)
    force = simulation.forces()[:, 1].copy()
    assert force.sum() == pytest.approx(1.0, abs=1e-12)
    mass = simulation.mass_matrix().diagonal()[1::3]
    roots = simulation.born("bar")
    parted = 0
    for root in np.unique(roots):
        family = np.flatnonzero((roots == root) & (force[: len(roots)] > 1e-9))  # with material
        if len(family) < 2:
            continue
        parted += 1
        expected = force[family].sum() * mass[family] / mass[family].sum()
        assert force[family] == pytest.approx(expected, abs=1e-12)
    assert parted >= 2
    simulation.save_checkpoint(tmp_path / "edited")
    again = scene.compile(checkpoint=tmp_path / "edited")
    assert again.forces()[:, 1] == pytest.approx(force, abs=1e-12)
