"""Pairs that may meet are taken over from search to search; a new list gives the same steps."""

from __future__ import annotations

import numpy as np

import tissu
from tissu import scene as parts


def folding_sheet() -> tissu.Scene:
    """A sheet whose end is led over itself: each step searches anew, and pairs come and go."""
    lead = parts.Prescribed(
        "sheet",
        on=parts.Plane((0.2, 0, 0), (1, 0, 0)),
        times=(0, 0.3),
        displacements=((0, 0, 0), (0, 0, 0)),
        rotation=parts.Rotation(axis=(0, -1, 0), center=(0.13, 0, 0.0012), angles=(0, "180 deg")),
    )
    sheet = parts.Body(
        mesh=parts.BarMesh(size=(0.2, 0.03, 0), cells=(40, 6, 0), cell="triangle"),
        model="shell",
        law=parts.Hooke(young="30 kPa", poisson=0.3),
        density=1100.0,
        thickness=0.002,
        viscosity=parts.Rayleigh(mass=5.0, stiffness=0.01),
    )
    return tissu.Scene(
        bodies={"sheet": sheet},
        fixed=[parts.Fixed("sheet", on=parts.Box(max=(0.05, None, None)))],
        prescribed=[lead],
        obstacles={"floor": parts.PlaneObstacle((0, 0, -0.0012), (0, 0, 1))},
        contacts=[parts.Contact("all", friction=0.3), parts.SelfContact("sheet", friction=0.3)],
        gravity=(0, 0, -9.81),
        step=parts.ImplicitEuler("10 ms", solver=parts.Cholesky()),
        threads=1,
    )


def test_a_list_taken_over_is_the_list_made_anew(tmp_path):
    """A simulation that a checkpoint begins has no search before to take pairs from."""
    scene = folding_sheet()
    simulation = scene.compile()
    touched = 0
    for number in range(33):
        path = tmp_path / "before.ckpt"
        compared = number >= 24 and number % 4 == 0
        if compared:
            simulation.save_checkpoint(path)
        simulation.step()
        assert len(simulation.crossings()) == 0
        pairs = simulation.contacts().pairs
        touched = max(touched, int((pairs[:, 0] == pairs[:, 1]).sum()))
        if not compared:
            continue
        other = scene.compile(checkpoint=path)
        other.step()
        for name, places in simulation.positions.items():
            np.testing.assert_array_equal(other.positions[name], places)
    assert touched > 10  # of the sheet with itself
