"""Bodies of frames, against beams, rods and plates, and what they refuse."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import tissu as ts

STEEL = ts.StVK(young=200e9, poisson=0.3)
NEWTON = ts.Newton(iterations=30, tolerance=1e-9)


def _static(**fields: Any) -> ts.Simulation:
    simulation = ts.Scene(step=ts.Static(newton=NEWTON, solver=ts.Cholesky()), **fields).compile()
    assert simulation.step().converged
    return simulation


def _bar(cells: tuple[int, int, int], size: tuple[float, float, float], **body: Any) -> ts.Body:
    return ts.Body(
        mesh=ts.BarMesh(size=size, cells=cells, cell=body.pop("cell", "hexahedron")),
        model=ts.Frames(**body.pop("frames", {})),
        **{"law": STEEL, "density": 7800.0, **body},
    )


def _root(body: str = "bar", **fields: Any) -> ts.Fixed:
    return ts.Fixed(body, on=ts.Plane((0, 0, 0), (1, 0, 0)), **fields)


@pytest.mark.parametrize(
    ("cells", "least", "most"), [((24, 2, 2), 0.93, 1.0), ((48, 4, 4), 0.98, 1.0)]
)
def test_steel_cantilever_nears_the_converged_solution_from_below(
    cells: tuple[int, int, int], least: float, most: float
) -> None:
    """Case B: 16 x 0.5 x 0.5 m under its weight sinks by 0.15017 m (reference, CalculiX)."""
    bar = _static(
        bodies={"bar": _bar(cells, (16, 0.5, 0.5))}, fixed=[_root()], gravity=(0, -9.81, 0)
    )
    sag = -bar.displacements("bar")[:, 1].min()
    assert least < sag / 0.15017 < most


def test_a_line_bends_and_twists_as_a_round_rod() -> None:
    """E I and G J of a round section of radius r: I = A^2 / (4 pi), J = A^2 / (2 pi)."""
    length, area, young, nu = 1.0, math.pi * 0.02**2, 1e6, 0.3
    line = _bar(
        (20, 0, 0), (length, 0, 0), cell="line", section=area, density=1000.0,
        law=ts.StVK(young=young, poisson=nu),
    )  # fmt: skip
    end = ts.Plane((length, 0, 0), (1, 0, 0))
    inertia = area**2 / (4 * math.pi)
    load = 1e-4
    bent = _static(
        bodies={"bar": line},
        fixed=[_root()],
        loads=[ts.NodalLoad("bar", on=end, force=(0, 0, load))],
    )
    # Timoshenko: P L^3 / (3 E I) + P L / (G A); the shear's part is 0.1 % here. 20 chords of a
    # cubic curve are 1 / (4 n^2) = 0.06 % stiff.
    wanted = load * length**3 / (3 * young * inertia)
    assert bent.displacements("bar")[-1, 2] == pytest.approx(wanted, rel=3e-3)
    moment = 1e-6
    twisted = _static(
        bodies={"bar": line},
        fixed=[_root()],
        loads=[ts.Moment("bar", on=end, moment=(moment, 0, 0))],
    )
    turn = twisted.rotations("bar")[-1]
    shear = young / (2 * (1 + nu))
    assert math.asin(turn[2, 1]) == pytest.approx(moment * length / (shear * 2 * inertia), rel=1e-3)


def test_a_sheet_bends_as_a_plate() -> None:
    """A strip held at one edge under a load at the other; nu = 0, so that E h^3 / 12 holds."""
    young, h, width, length = 1e6, 0.02, 0.2, 1.0
    sheet = _bar(
        (20, 4, 0), (length, width, 0), cell="quad", thickness=h, density=1000.0,
        law=ts.StVK(young=young, poisson=0.0),
    )  # fmt: skip
    load = 1e-4
    strip = _static(
        bodies={"bar": sheet},
        fixed=[_root()],
        loads=[ts.NodalLoad("bar", on=ts.Plane((length, 0, 0), (1, 0, 0)), force=(0, 0, load))],
    )
    wanted = 4 * load * length**3 / (young * width * h**3)
    edge = strip.displacements("bar")[np.isclose(strip.meshes["bar"].points[:, 0], length), 2]
    assert edge.mean() == pytest.approx(wanted, rel=1e-2)


def test_half_a_turn_twists_every_frame_of_the_published_line() -> None:
    """bosman2014, figure 5: ten frames on a line, the last turned by half a turn."""
    line = _bar((9, 0, 0), (1, 0, 0), cell="line", section=1e-4, density=1000.0,
                law=ts.StVK(young=25e3, poisson=0.3))  # fmt: skip
    scene = ts.Scene(
        bodies={"bar": line},
        fixed=[_root()],
        prescribed=[
            ts.Prescribed(
                "bar",
                on=ts.Plane((1, 0, 0), (1, 0, 0)),
                times=(0, 1),
                rotation=ts.Rotation(axis=(1, 0, 0), angles=(0, math.pi)),
            )
        ],
        step=ts.ImplicitEuler(dt=0.02, newton=ts.Newton(iterations=10)),
        duration=3,
    )
    simulation = scene.compile()
    assert all(report.converged for report in simulation.run())
    rotations = simulation.rotations("bar")
    angles = np.unwrap(np.arctan2(rotations[:, 2, 1], rotations[:, 1, 1]))
    assert np.allclose(angles, np.linspace(0, math.pi, 10), atol=0.02)
    assert np.abs(simulation.displacements("bar")).max() < 1e-3


def test_the_published_sheet_stays_stable() -> None:
    """bosman2014, figure 4: 91 coplanar frames, 1024 points, 300 N, E = 25 kPa, two edges fixed."""
    sheet = _bar((12, 6, 0), (2, 1, 0), cell="quad", thickness=0.05, density=1000.0,
                 law=ts.StVK(young=25e3, poisson=0.3), quadrature="over")  # fmt: skip
    scene = ts.Scene(
        bodies={"bar": sheet},
        fixed=[_root(), ts.Fixed("bar", on=ts.Plane((2, 0, 0), (1, 0, 0)))],
        loads=[ts.NodalLoad("bar", on=ts.Box((0.8, 0.3, -1), (1.2, 0.7, 1)), force=(0, 0, -300))],
        step=ts.ImplicitEuler(dt=0.02),
        duration=2,
    )
    simulation = scene.compile()
    assert simulation.meshes["bar"].node_count == 91
    assert all(report.converged for report in simulation.run())
    drop = -simulation.displacements("bar")[:, 2]
    assert 0.05 < drop.max() < 1.0
    assert drop == pytest.approx(drop[::-1], abs=1e-6 * drop.max())  # symmetric as the load


def test_rotations_that_are_let_go_turn() -> None:
    """A rod held at its end like a hinge falls as a pendulum; clamped it stays."""
    rod = _bar((4, 0, 0), (1, 0, 0), cell="line", section=1e-4, density=1000.0,
               law=ts.StVK(young=1e10, poisson=0.3))  # fmt: skip
    for rotations, least in (("free", 0.5), ("held", 0.0)):
        scene = ts.Scene(
            bodies={"bar": rod},
            fixed=[_root(rotations=rotations)],
            gravity=(0, 0, -9.81),
            step=ts.ImplicitEuler(dt=0.005, newton=ts.Newton(iterations=10)),
            duration=0.3,
        )
        simulation = scene.compile()
        assert all(report.converged for report in simulation.run())
        drop = -simulation.displacements("bar")[-1, 2]
        # A rod's end: 3/4 g t^2 = 0.66 m for a small angle; less as it turns.
        assert drop > 0.5 if least else drop < 0.1


def test_frames_refuse_what_they_are_not() -> None:
    cube = ts.Body(mesh=ts.BarMesh(size=(1, 1, 1), cells=(1, 1, 1)), law=STEEL, density=1000.0)
    scene = ts.Scene(
        bodies={"cube": cube},
        fixed=[_root("cube")],
        loads=[ts.Moment("cube", on=ts.Plane((1, 0, 0), (1, 0, 0)), moment=(1, 0, 0))],
        step=ts.Static(),
    )
    with pytest.raises(ts.SceneError, match="whose nodes have no rotation"):
        scene.compile()
    plain = ts.Scene(bodies={"cube": cube}, fixed=[_root("cube")], step=ts.Static()).compile()
    with pytest.raises(ts.ParameterError, match="no rotation"):
        plain.rotations("cube")
    with pytest.raises(ts.ParameterError, match="no points"):
        plain.points("cube")
    frames = _bar((1, 1, 1), (1, 1, 1))
    viscous = frames.replace(viscosity=ts.KelvinVoigt(eta=1.0))
    with pytest.raises(ts.SceneError, match="rayleigh is accepted"):
        ts.Scene(bodies={"bar": viscous}, fixed=[_root()], step=ts.Static()).compile()


def test_volumes_of_frames_with_whole_levers_are_noted() -> None:
    body = _bar((4, 1, 1), (4, 1, 1))
    scene = ts.Scene(bodies={"bar": body}, fixed=[_root()], step=ts.Static())
    (note,) = [note for note in scene.check().notes if "frames" in note]
    assert note.startswith("bodies.bar: volumes of frames with whole levers have many equilibria")
    assert "lever: half" in note
    moving = scene.replace(step=ts.ImplicitEuler(dt=0.01))
    assert note in moving.check().notes
    half = scene.replace(bodies={"bar": body.replace(model=ts.Frames(lever="half"))})
    meshed = scene.replace(bodies={"bar": body.replace(model="fem")})
    cells = [("line", [[i, i + 1] for i in range(4)])]
    line = ts.Mesh(points=np.linspace((0, 0, 0), (4, 0, 0), 5), cells=cells)
    rod = ts.Body(mesh=line, law=STEEL, density=7800.0, section="1 cm^2", model="frames")
    thin = scene.replace(bodies={"bar": rod})
    for other in (half, meshed, thin):
        assert other.check().ok
        assert not [note for note in other.check().notes if "volumes of frames" in note]
