"""Rotations held by axis (planes of symmetry), and led where the place is free."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import tissu as ts

STEP = ts.Static(solver=ts.Cholesky(), newton=ts.Newton(iterations=30, tolerance=1e-10))
LAW = ts.Hooke(young=1e6, poisson=0.3)


def _static(**fields: Any) -> ts.Simulation:
    simulation = ts.Scene(**{"step": STEP, **fields}).compile()
    assert simulation.step().converged
    return simulation


def _at(x: float) -> ts.Plane:
    return ts.Plane((x, 0, 0), (1, 0, 0))


def _plate(points: Any, triangles: Any, model: str) -> ts.Body:
    mesh = ts.Mesh(points=points, cells=(ts.CellBlock("triangle", triangles),))
    return ts.Body(mesh=mesh, model=model, law=_law(model), thickness=0.02, density=1000.0)


def _law(model: str) -> ts.Law:
    return LAW if model == "shell" else ts.StVK(young=1e6, poisson=0.3)


def _mirrored(points: Any, triangles: Any, axis: int) -> tuple[Any, Any]:
    """A mesh and its mirror image across the plane where the axis is zero, as one."""
    image = points.copy()
    image[:, axis] *= -1
    number = np.arange(len(points)) + len(points)
    on = np.isclose(points[:, axis], 0)
    number[on] = np.flatnonzero(on)
    kept = np.ones(2 * len(points), dtype=bool)
    kept[len(points) :][on] = False
    renumber = np.cumsum(kept) - 1
    both = np.vstack([triangles, number[triangles][:, ::-1]])
    return np.vstack([points, image])[kept], renumber[both]


def _quarter(radius: float | None) -> tuple[Any, Any]:
    """A quarter of a square plate of 1 m, or of a cylinder's roof of that arc."""
    mesh = ts.BarMesh(size=(0.5, 0.5, 0), cells=(4, 4, 0), cell="triangle").mesh()
    points = np.array(mesh.points)
    if radius is not None:
        angle = points[:, 1] / radius
        points[:, 1], points[:, 2] = radius * np.sin(angle), radius * (np.cos(angle) - 1)
    return points, np.array(mesh.cells[0].nodes)


@pytest.mark.parametrize("model", ["shell", "frames"])
@pytest.mark.parametrize("radius", [None, 0.6])
@pytest.mark.parametrize("moving", [False, True])
def test_a_quarter_with_planes_of_symmetry_is_the_whole(
    model: str, radius: float | None, moving: bool
) -> None:
    """Held at its ends across x, under its weight: the quarter does what the whole mirrored does.

    They are the same equations, so that they agree to the tolerance of Newton's iteration. The
    weight bends the plate by more than its thickness: rotations are large enough to count.
    """
    points, triangles = _quarter(radius)
    whole = _mirrored(*_mirrored(points, triangles, 0), 1)
    fields: dict[str, Any] = {"gravity": (0, 0, -9.81)}
    if moving:
        newton = ts.Newton(iterations=20, tolerance=1e-10)
        fields["step"] = ts.ImplicitEuler(dt=0.01, newton=newton, solver=ts.Cholesky())
    ends = [ts.Fixed("plate", on=_at(0.5)), ts.Fixed("plate", on=_at(-0.5))]
    planes = [
        ts.Fixed("plate", on=_at(0), axes="x", rotations="yz"),
        ts.Fixed("plate", on=ts.Plane((0, 0, 0), (0, 1, 0)), axes="y", rotations="xz"),
    ]
    of_whole = _static(bodies={"plate": _plate(*whole, model)}, fixed=ends, **fields)
    of_quarter = _static(
        bodies={"plate": _plate(points, triangles, model)}, fixed=[ends[0], *planes], **fields
    )
    for _ in range(4 if moving else 0):
        of_whole.step()
        of_quarter.step()
    there, here = of_whole.displacements("plate"), of_quarter.displacements("plate")
    size = np.abs(there).max()
    assert size > (1e-3 if moving else 0.01 if radius is None else 1e-4)
    for point, moved in zip(points, here, strict=True):
        same = np.flatnonzero(np.linalg.norm(whole[0] - point, axis=1) < 1e-9)
        assert moved == pytest.approx(there[same[0]], abs=1e-6 * size)


def _rod(cells: int = 40) -> ts.Body:
    """A rod of 1 m along x with a round section of 2 cm."""
    mesh = ts.BarMesh(size=(1, 0, 0), cells=(cells, 0, 0), cell="line")
    section = math.pi * 0.01**2
    return ts.Body(mesh=mesh, model="frames", law=_law("frames"), section=section, density=1000.0)


@pytest.mark.parametrize("moving", [False, True])
def test_half_a_beam_with_a_plane_of_symmetry_is_the_whole(moving: bool) -> None:
    """A rod between two clamps under its weight, by more than its radius, and its half.

    Node by node the same equations, so that they agree to the tolerance of Newton's iteration.
    """
    whole = _rod().replace(mesh=ts.BarMesh(size=(2, 0, 0), cells=(40, 0, 0), cell="line"))
    half = _rod(20)
    fields: dict[str, Any] = {"gravity": (0, 0, -0.1)}
    if moving:
        newton = ts.Newton(iterations=20, tolerance=1e-10)
        fields["step"] = ts.ImplicitEuler(dt=0.1, newton=newton, solver=ts.Cholesky())
    plane = ts.Fixed("rod", on=_at(1), axes="x", rotations="yz")
    of_whole = _static(
        bodies={"rod": whole},
        fixed=[ts.Fixed("rod", on=_at(0)), ts.Fixed("rod", on=_at(2))],
        **fields,
    )
    of_half = _static(bodies={"rod": half}, fixed=[ts.Fixed("rod", on=_at(0)), plane], **fields)
    for _ in range(10 if moving else 0):
        of_whole.step()
        of_half.step()
    there, here = of_whole.displacements("rod")[:21], of_half.displacements("rod")
    size = np.abs(there).max()
    assert size > 0.02
    assert here == pytest.approx(there, abs=1e-6 * size)
    there, here = of_whole.rotations("rod")[:21], of_half.rotations("rod")
    assert here == pytest.approx(there, abs=1e-6)
    if not moving:  # the plane takes the moment of the other half
        middle = of_whole.reactions("rod", moments=True)[0]
        assert of_half.reactions("rod", moments=True)[0] == pytest.approx(
            middle, rel=1e-6, abs=1e-9
        )
        assert abs(of_half.reactions("rod", moments=True)[-1, 1]) > 0.1 * abs(middle[1])


def _led(angle: float, **fields: Any) -> ts.Prescribed:
    turn = ts.Rotation(axis=(0, -1, 0), angles=(0, angle))
    return ts.Prescribed("rod", on=_at(1), times=(0, 1), rotation=turn, **fields)


@pytest.mark.parametrize("moving", [False, True])
def test_a_rotation_led_at_a_free_end_bends_a_rod_to_an_arc(moving: bool) -> None:
    """Only a moment acts on the rod: an arc of angle a, radius L / a, and M = E I a / L."""
    angle = 1.0
    step: ts.Step = STEP
    if moving:  # it comes to rest after the end has turned: its slowest mode is damped critically
        newton = ts.Newton(iterations=20, tolerance=1e-10)
        step = ts.ImplicitEuler(dt=0.1, newton=newton, solver=ts.Cholesky())
    scene = ts.Scene(
        bodies={"rod": _rod().replace(viscosity=ts.Rayleigh(mass=1.8) if moving else None)},
        fixed=[ts.Fixed("rod", on=_at(0))],
        prescribed=[_led(angle, axes="free", rotations="held")],
        step=step,
        duration=30.0 if moving else 1.0,
    )
    simulation = scene.compile()
    assert all(report.converged for report in simulation.run())
    tip = simulation.displacements("rod")[-1]
    arc = (math.sin(angle) / angle - 1, 0, (1 - math.cos(angle)) / angle)
    # 40 chords of an arc are shorter than it by (a / n)^2 / 24; strain of the axis of
    # (r / R)^2 / 2 comes of curvature in St-Venant-Kirchhoff's law. Both are below 1e-4.
    assert tip == pytest.approx(arc, abs=2e-4)
    assert np.allclose(simulation.rotations("rod")[-1] @ (1, 0, 0), (math.cos(1), 0, math.sin(1)))
    moment = simulation.reactions("rod", moments=True)[-1]
    stiffness = 1e6 * math.pi * 0.01**4 / 4
    assert moment == pytest.approx((0, -stiffness * angle, 0), abs=5e-3 * stiffness)


@pytest.mark.parametrize("model", ["shell", "frames"])
def test_a_rotation_led_at_a_free_edge_bends_a_strip_to_an_arc(model: str) -> None:
    """As the rod: E h^3 / 12 a / L is the moment of a strip of width 1 without Poisson's ratio."""
    angle, width, thickness = 1.0, 0.1, 0.02
    mesh = ts.BarMesh(size=(1, width, 0), cells=(40, 2, 0), cell="triangle")
    law = ts.Hooke(young=1e6, poisson=0) if model == "shell" else ts.StVK(young=1e6, poisson=0)
    body = ts.Body(mesh=mesh, model=model, law=law, thickness=thickness, density=1000.0)
    strip = _static(
        bodies={"rod": body},
        fixed=[ts.Fixed("rod", on=_at(0))],
        prescribed=[_led(angle, axes="free", rotations="held")],
    )
    end = np.isclose(strip.meshes["rod"].points[:, 0], 1)
    arc = (math.sin(angle) / angle - 1, 0, (1 - math.cos(angle)) / angle)
    # Chords are shorter than the arc by (a / n)^2 / 24; a strain of the middle of (h / R)^2 / 24
    # comes of curvature in St-Venant-Kirchhoff's law.
    assert strip.displacements("rod")[end].mean(axis=0) == pytest.approx(arc, abs=2e-4)
    moment = strip.reactions("rod", moments=True)[end].sum(axis=0)
    stiffness = 1e6 * width * thickness**3 / 12
    assert moment == pytest.approx((0, -stiffness * angle, 0), abs=5e-3 * stiffness)


def test_a_guided_end_moves_without_turning() -> None:
    """Clamped at one end, the other does not turn: P L^3 / (12 E I), and P L / 2 there."""
    load = 1e-5
    rod = _static(
        bodies={"rod": _rod()},
        fixed=[
            ts.Fixed("rod", on=_at(0)),
            ts.Fixed("rod", on=_at(1), axes="free", rotations="y"),
        ],
        loads=[ts.NodalLoad("rod", on=_at(1), force=(0, 0, load))],
    )
    stiffness = 1e6 * math.pi * 0.01**4 / 4
    # The shear's part is 12 E I / (G A L^2) = 0.08 %; 40 chords are 1 / n^2 = 0.06 % stiff.
    sag = rod.displacements("rod")[-1, 2]
    assert sag == pytest.approx(load / (12 * stiffness), rel=2e-3)
    assert rod.reactions("rod", moments=True)[-1, 1] == pytest.approx(load / 2, rel=1e-3)


@pytest.mark.parametrize(
    ("support", "words"),
    [
        (ts.Fixed("rod", on=_at(1), axes="free", rotations="held"), "held against turning"),
        (_led(1.0, axes="x", rotations="held"), "held against turning about xyz"),
    ],
)
def test_a_rotation_is_led_once(support: ts.Fixed | ts.Prescribed, words: str) -> None:
    groups: dict[str, Any] = {"prescribed": [_led(1.0, axes="free", rotations="held")]}
    group = "fixed" if isinstance(support, ts.Fixed) else "prescribed"
    groups[group] = [*groups.get(group, []), support]
    with pytest.raises(ts.SceneError, match=words):
        ts.Scene(bodies={"rod": _rod()}, step=ts.ImplicitEuler(dt=0.1), **groups).compile()


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"axes": "free"}, "nothing is held"),
        ({"axes": "free", "rotations": "free"}, "nothing is held"),
        ({"axes": "fre"}, "or free"),
        ({"rotations": "yy"}, "held, free, or letters out of x, y, z, each once"),
        ({"rotations": "yz"}, "found rotations yz beside a rotation"),
        ({"axes": "free", "rotations": "held", "displacements": [(0, 0, 0)] * 2}, "axes free"),
    ],
)
def test_what_holds_nothing_or_too_much_is_refused(fields: dict[str, Any], words: str) -> None:
    with pytest.raises(ts.SceneError, match=words):
        _led(1.0, **fields)


def test_rotations_of_nodes_without_them_are_refused() -> None:
    cube = ts.Body(mesh=ts.BarMesh(size=(1, 1, 1), cells=(1, 1, 1)), law=LAW, density=1000.0)
    for held in ("held", "yz"):
        fixed = [ts.Fixed("cube", on=_at(0), rotations=held)]
        scene = ts.Scene(bodies={"cube": cube}, fixed=fixed, step=STEP)
        with pytest.raises(ts.SceneError, match=f"rotations {held} on 'cube', whose nodes have no"):
            scene.compile()
