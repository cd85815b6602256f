"""Sections of rods of frames, against Timoshenko's beam and Saint-Venant's torsion."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import tissu as ts

YOUNG, NU, LENGTH = 1e6, 0.3, 0.5
SHEAR = YOUNG / (2 * (1 + NU))
CELLS = 40
ALONG = (1.0, 0.0, 0.0)
# Cowper 1966, table 1, for nu = 0.3 by hand: 7.8 / 8.8, 13 / 15.3, and of a tube of m = 1 / 2
# 7.8 * 1.5625 / (8.8 * 1.5625 + 23.6 / 4).
K_ROUND, K_RECTANGLE, K_TUBE = 0.88636, 0.84967, 0.62023


def _rod(section: Any, along: Any = ALONG, **body: Any) -> ts.Body:
    ends = np.linspace(0.0, LENGTH, CELLS + 1)[:, None] * np.asarray(along)
    lines = np.stack([np.arange(CELLS), np.arange(1, CELLS + 1)], axis=1).astype(np.int32)
    mesh = ts.Mesh(points=ends, cells=(ts.CellBlock("line", lines),))
    given = {"model": "frames", "law": ts.StVK(young=YOUNG, poisson=NU), "density": 1000.0}
    return ts.Body(mesh=mesh, section=section, **{**given, **body})


def _loaded(body: ts.Body, **load: Any) -> ts.Simulation:
    """Clamped at the first node, loaded at the last."""
    kind = ts.Moment if "moment" in load else ts.NodalLoad
    simulation = ts.Scene(
        bodies={"rod": body},
        fixed=[ts.Fixed("rod", on=ts.Nodes([0]))],
        loads=[kind("rod", on=ts.Nodes([CELLS]), **load)],
        step=ts.Static(newton=ts.Newton(iterations=20, tolerance=1e-9), solver=ts.Cholesky()),
    ).compile()
    assert simulation.step().converged
    return simulation


def _sag(body: ts.Body, direction: Any, load: float) -> float:
    """Of the tip along a direction, under a load along it."""
    force = tuple(load * np.asarray(direction))
    return float(_loaded(body, force=force).displacements("rod")[CELLS] @ np.asarray(direction))


def _timoshenko(load: float, area: float, inertia: float, k: float) -> float:
    return load * LENGTH**3 / (3 * YOUNG * inertia) + load * LENGTH / (k * SHEAR * area)


RECTANGLE = ts.Rectangle(height=0.2, width=0.1, up=(0, 0, 1))
GENERAL = ts.GeneralSection(
    area=0.02, inertia_up=6e-5, inertia_across=2e-5, torsion=1e-5, shear_up=0.4, shear_across=0.7,
    up=(0, 0, 1),
)  # fmt: skip


@pytest.mark.parametrize(
    ("section", "up", "across"),
    [
        (RECTANGLE, (0.02, 0.1 * 0.2**3 / 12, K_RECTANGLE), (0.02, 0.2 * 0.1**3 / 12, K_RECTANGLE)),
        (ts.Round(radius=0.1), *2 * [(math.pi * 0.01, math.pi / 4 * 1e-4, K_ROUND)]),
        (math.pi * 0.01, *2 * [(math.pi * 0.01, math.pi / 4 * 1e-4, K_ROUND)]),
        (
            ts.Tube(outer=0.1, inner=0.05),
            *2 * [(math.pi * 0.0075, math.pi / 4 * (1e-4 - 0.0625e-4), K_TUBE)],
        ),
        (GENERAL, (0.02, 6e-5, 0.4), (0.02, 2e-5, 0.7)),
    ],
)
def test_a_short_cantilever_bends_and_shears_as_timoshenkos(
    section: Any, up: tuple[float, ...], across: tuple[float, ...]
) -> None:
    """P L^3 / (3 E I) + P L / (k G A) along both axes of the section, of small loads.

    Shear makes 5 to 20 % of it, so that a factor of one would miss by 1 to 10 %. 40 chords of a
    cubic curve are 1 / (4 n^2) = 0.016 % stiff; the sag is 1e-4 of the length.
    """
    for direction, (area, inertia, k) in (((0, 0, 1), up), ((0, 1, 0), across)):
        load = 1e-4 * LENGTH / _timoshenko(1.0, area, inertia, k)
        wanted = _timoshenko(load, area, inertia, k)
        assert _sag(_rod(section), direction, load) == pytest.approx(wanted, rel=5e-4)


@pytest.mark.parametrize(
    ("sides", "share"),
    [((1.0, 1.0), 0.1406), ((2.0, 1.0), 0.229), ((1.0, 3.0), 0.263), ((10.0, 1.0), 0.312)],
)
def test_a_rectangle_twists_by_saint_venants_constant(
    sides: tuple[float, float], share: float
) -> None:
    """J = share a b^3: Timoshenko and Goodier, Theory of Elasticity, section 109, three digits."""
    a, b = 0.01 * max(sides), 0.01 * min(sides)
    section = ts.Rectangle(height=0.01 * sides[0], width=0.01 * sides[1], up=(0, 0, 1))
    torsion = share * a * b**3
    moment = 1e-3 * SHEAR * torsion / LENGTH
    turn = _loaded(_rod(section), moment=(moment, 0, 0)).rotations("rod")[CELLS]
    assert math.asin(turn[2, 1]) == pytest.approx(1e-3, rel=2.5e-3)


@pytest.mark.parametrize(
    ("section", "torsion"),
    [
        (ts.Round(radius=0.01), math.pi / 2 * 1e-8),
        (ts.Tube(outer=0.01, inner=0.008), math.pi / 2 * (1e-8 - 0.4096e-8)),
        (GENERAL, 1e-5),
    ],
)
def test_other_sections_twist_by_theirs(section: Any, torsion: float) -> None:
    moment = 1e-3 * SHEAR * torsion / LENGTH
    turn = _loaded(_rod(section), moment=(moment, 0, 0)).rotations("rod")[CELLS]
    assert math.asin(turn[2, 1]) == pytest.approx(1e-3, rel=1e-5)


def test_the_height_stands_along_up_wherever_the_rod_lies() -> None:
    """A rod across space, whose `up` leans along it: only what of it is across counts."""
    along = np.array([1.0, 1.0, 0.0]) / math.sqrt(2)
    leaning = RECTANGLE.replace(up=tuple(np.array([0, 0, 3.0]) + 2.0 * along))
    load = 1e-3
    wanted = _timoshenko(load, 0.02, 0.1 * 0.2**3 / 12, K_RECTANGLE)
    assert _sag(_rod(leaning, along), (0, 0, 1), load) == pytest.approx(wanted, rel=5e-4)
    side = tuple(np.cross(along, (0, 0, 1)))
    wanted = _timoshenko(load, 0.02, 0.2 * 0.1**3 / 12, K_RECTANGLE)
    assert _sag(_rod(leaning, along), side, load) == pytest.approx(wanted, rel=5e-4)


def test_a_round_rod_is_the_same_as_a_general_one_of_its_numbers() -> None:
    """Large bending and twist: the law and not only its limit at rest."""
    radius = 0.02
    inertia = math.pi / 4 * radius**4
    general = ts.GeneralSection(
        area=math.pi * radius**2, inertia_up=inertia, inertia_across=inertia, torsion=2 * inertia,
        shear_up=7.8 / 8.8, shear_across=7.8 / 8.8, up=(0, 1, 1),
    )  # fmt: skip
    force = (0.1, 0.2, 0.3)
    ends = [
        _loaded(_rod(section), force=force).displacements("rod")
        for section in (ts.Round(radius=radius), general)
    ]
    assert np.abs(ends[0]).max() > 0.05
    # The four points stand on other axes: what they resolve of curvature to the fourth.
    assert ends[1] == pytest.approx(ends[0], abs=1e-3 * np.abs(ends[0]).max())


def test_a_frequency_of_bending_is_that_of_the_section() -> None:
    """The first frequency of a slender cantilever, 3.516 sqrt(E I / (rho A L^4))."""
    section = ts.Rectangle(height=0.01, width=0.005, up=(0, 0, 1))
    body = _rod(section, start=ts.Start(velocity=(0, 0, 1e-5)))
    simulation = ts.Scene(
        bodies={"rod": body},
        fixed=[ts.Fixed("rod", on=ts.Nodes([0]))],
        step=ts.ImplicitMidpoint(dt=2e-3, solver=ts.Cholesky(), newton=ts.Newton(iterations=10)),
    ).compile()
    omega = 3.516 * math.sqrt(YOUNG * 0.01**2 / 12 / (1000 * LENGTH**4))
    tips = []
    for _ in range(int(2 * math.pi / omega / 2e-3)):
        assert simulation.step().converged
        tips.append(simulation.displacements("rod")[CELLS, 2])
    # The tip comes back through zero after half a period; higher modes shift that by some percent.
    crossing = next(i for i, tip in enumerate(tips) if tip < 0)
    assert crossing * 2e-3 == pytest.approx(math.pi / omega, rel=0.05)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: ts.Tube(outer=0.1, inner=0.1), "an inner radius below the outer one is accepted"),
        (lambda: RECTANGLE.replace(up=(0, 0, 0)), "one across the lines is accepted"),
        (lambda: ts.Rectangle(height=0.1, width=0.1), "up"),
        (lambda: ts.Rectangle(height=0.1, width=-0.1, up=(0, 0, 1)), "width"),
        (lambda: GENERAL.replace(torsion=9e-5), "at most this moment is accepted"),
        (lambda: GENERAL.replace(torsion=8e-5), "above half of torsion"),
        (lambda: _rod(-1.0), "an area above 0 is accepted"),
        (lambda: _rod("3 mm"), "area"),
        (lambda: _rod({"type": "square"}), "round, rectangle, tube"),
    ],
)
def test_sections_that_cannot_be_are_refused(make: Any, words: str) -> None:
    with pytest.raises(ts.SceneError, match=words):
        make()


@pytest.mark.parametrize(
    ("body", "words"),
    [
        (_rod(RECTANGLE.replace(up=(1, 0, 0))), "found 40 lines along it"),
        (_rod(RECTANGLE, model=ts.Frames(section="middle")), "not round on points on the middle"),
    ],
)
def test_sections_that_do_not_fit_are_refused(body: ts.Body, words: str) -> None:
    scene = ts.Scene(
        bodies={"rod": body}, fixed=[ts.Fixed("rod", on=ts.Nodes([0]))], step=ts.Static()
    )
    with pytest.raises(ts.TissuError, match=words):
        scene.compile()


def test_sections_are_read_from_yaml_and_told() -> None:
    text = """
bodies:
  rod:
    mesh: {type: bar, size: [1, 0, 0], cells: [10, 0, 0], cell: line}
    model: frames
    law: {type: stvk, young: 1 MPa, poisson: 0.3}
    density: 1000
    section: {type: rectangle, height: 2 mm, width: 1 mm, up: [0, 0, 1]}
step: {type: implicit_euler, dt: 1 ms}
"""
    scene = ts.Scene.from_yaml_text(text)
    assert scene.bodies["rod"].section == ts.Rectangle(height=0.002, width=0.001, up=(0, 0, 1))
    assert ts.Scene.from_yaml_text(scene.to_yaml()) == scene
    told = " ".join(str(effect) for effect in scene.check().effects)
    assert "rectangle 0.002 x 0.001, up along (0, 0, 1), 2e-06 m^2" in told
    general = text.replace(
        "{type: rectangle, height: 2 mm, width: 1 mm, up: [0, 0, 1]}",
        "{type: general, area: 2 mm^2, inertia_up: 0.6 mm^4, inertia_across: 0.2 mm^4, "
        "torsion: 0.4 mm^4, shear_up: 0.8, shear_across: 0.8, up: [0, 0, 1]}",
    )
    section = ts.Scene.from_yaml_text(general).bodies["rod"].section
    assert isinstance(section, ts.GeneralSection)
    assert section.inertia_up == pytest.approx(6e-13)
