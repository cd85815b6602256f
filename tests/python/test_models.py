"""Every model in a scene, against closed forms, the same mesh's continuum elements, and references."""

from pathlib import Path

import numpy as np
import pytest

import tissu as ts

FOLDER = Path(__file__).parents[1] / "reference"
SIDE, YOUNG = 0.05, 20e3  # m, Pa: the cube of Chendeb 2007, section 3.5.1
NEWTON = ts.Newton(iterations=40, tolerance=1e-10)
STVK = ["fem", "mass-link", "mass-tensor"]  # three forms of one energy


def low(axis):
    """The plane where a coordinate is zero: a plane of symmetry."""
    return ts.Box((None,) * 3, tuple(1e-9 if i == axis else None for i in range(3)))


def stretched_cube(model, poisson, F, law=ts.StVK):
    """The cube between symmetry planes, its top led to the stretch F.

    Its force along z [N], its stretch across, and how far from homogeneous it is [m].
    """
    mesh = ts.bar_mesh(size=(SIDE,) * 3, cells=(2, 2, 2), cell="tetra")
    top = ts.Box((None, None, SIDE - 1e-9), (None,) * 3)
    steps = int(np.ceil(abs(F - 1) / 0.08))
    times = np.linspace(0, steps, steps + 1)
    scene = ts.Scene(
        bodies={
            "cube": ts.Body(
                mesh=mesh, law=law(young=YOUNG, poisson=poisson), mass=1.0, model=model
            )
        },
        fixed=[ts.Fixed("cube", on=low(i), axes="xyz"[i]) for i in range(3)],
        prescribed=[
            ts.Prescribed(
                "cube",
                on=top,
                times=list(times),
                displacements=[(0, 0, (F - 1) * SIDE * t / steps) for t in times],
                axes="z",
            )
        ],
        step=ts.Static(solver=ts.Cholesky(), newton=NEWTON),
        duration=steps,
    )
    simulation = scene.compile()
    for report in simulation.run():
        assert report.converged, report
    found = simulation.positions["cube"]
    stretch = found.max(axis=0) / SIDE
    force = simulation.reactions("cube")[mesh.points[:, 2] > SIDE - 1e-9, 2].sum()
    return force, stretch[:2], np.abs(found - mesh.points * [*stretch[:2], F]).max()


@pytest.mark.parametrize("model", STVK)
@pytest.mark.parametrize(
    ("poisson", "F"),
    [(0.3, f) for f in (0.61, 0.7, 0.85, 1.25, 1.6, 2.0)]
    + [(0.45, f) for f in (0.61, 0.7, 1.25, 1.6, 1.78)],
)
def test_the_stretched_cube_meets_the_closed_form_of_the_paper(model, poisson, F):
    """P = E/2 F (F^2 - 1), lateral^2 = 1 - nu (F^2 - 1): to Newton's tolerance, not to 0.1 %."""
    force, across, off = stretched_cube(model, poisson, F)
    assert force == pytest.approx(SIDE**2 * YOUNG / 2 * F * (F**2 - 1), rel=1e-8)
    assert across == pytest.approx(np.sqrt(1 - poisson * (F**2 - 1)), rel=1e-8)
    assert off < 1e-8 * SIDE
