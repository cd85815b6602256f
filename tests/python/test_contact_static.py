"""Static steps with contact against closed forms: weights, friction, pressing, contrasts."""

import math

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, between, block, weight
from contact_static import TOLERANCE, pushed
from tissu.errors import SceneError, TissuError

GAP = 1e-3
"""[m]"""


def on_a_table(tangent=0.0, *, friction=0.0, height=GAP, step=None, **fields):
    """A cube of 1 kg on a plane; gravity leans by an angle, downhill along x."""
    phi = math.atan(tangent)
    return ts.Scene(
        bodies={"cube": block((0, 0, height))},
        obstacles={"table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[ts.Contact(("cube", "table"), friction=friction, gap=GAP)],
        gravity=(GRAVITY * math.sin(phi), 0, -GRAVITY * math.cos(phi)),
        step=step or ts.Static(),
        **fields,
    )


@pytest.mark.parametrize("friction", [0.0, 0.5])
@pytest.mark.parametrize("height", [0.0, GAP, 0.02])
def test_a_cube_that_nothing_else_holds_rests_on_a_table(height, friction):
    """It falls there first; the table carries its weight, to the step's tolerance of 1e-6."""
    simulation = on_a_table(friction=friction, height=height).compile()
    for _ in range(2):
        pushed(simulation)
        force = simulation.force_on("table").force
        assert force == pytest.approx([0, 0, -weight()], abs=TOLERANCE * weight())
        assert simulation.positions["cube"][:, 2].min() == pytest.approx(GAP, abs=1e-3 * GAP)


def test_below_the_angle_of_friction_a_slope_holds_it():
    simulation = on_a_table(0.45, friction=0.5).compile()
    phi = math.atan(0.45)
    expected = [weight() * math.sin(phi), 0, -weight() * math.cos(phi)]
    pushed(simulation)
    start = simulation.positions["cube"].copy()
    for _ in range(3):
        pushed(simulation)
        assert simulation.force_on("table").force == pytest.approx(expected, abs=2e-6 * weight())
    assert np.abs(simulation.positions["cube"] - start).max() < 1e-6  # a thousandth of the gap


def test_above_it_nothing_holds_it_which_is_said():
    simulation = on_a_table(0.55, friction=0.5).compile()
    before = simulation.positions["cube"].copy()
    with pytest.raises(TissuError, match="no equilibrium was found") as error:
        simulation.step()
    assert "neither supports nor contacts hold it" in str(error.value)
    assert "\n" not in str(error.value)
    assert np.array_equal(simulation.positions["cube"], before)
    assert simulation.time == 0.0
    assert simulation.crossings() == []


def uniaxial(law, stretch):
    """First Piola stress [Pa] of stable neo-Hooke that is free sideways, and its stretch there."""
    lame, mu = law.small_strain()
    mu_s, lambda_s = 4 / 3 * mu, lame + 5 / 6 * mu
    alpha = 1 + 3 * mu_s / (4 * lambda_s)

    def stress(a, b, c):
        shear = mu_s * a * (1 - 1 / (a * a + b * b + c * c + 1))
        return shear + lambda_s * (a * b * c - alpha) * b * c

    low, high = 0.5, 3.0
    for _ in range(100):
        side = 0.5 * (low + high)
        low, high = (low, side) if stress(side, side, stretch) > 0 else (side, high)
    return stress(stretch, low, low), low


SIDE = 0.1
"""[m]"""


def between_plates(
    friction=0.0, *, share=0.5, gap=2e-4, law=None, cells=(4, 4, 4), symmetric=True, **fields
):
    """A cube between two plates, of which the high one comes down within a second."""
    law = law or ts.StableNeoHooke(young=1e5, poisson=0.45)
    down = ts.Motion(times=(0, 1), displacements=((0, 0, 0), (0, 0, -share * SIDE)))
    sides = [
        ts.Fixed("cube", on=ts.Plane(point=(0, 0, 0), normal=(1, 0, 0)), axes="x"),
        ts.Fixed("cube", on=ts.Plane(point=(0, 0, 0), normal=(0, 1, 0)), axes="y"),
    ]
    given = {
        "bodies": {"cube": block((0, 0, gap), cells=cells, law=law)},
        "obstacles": {
            "low": ts.PlaneObstacle((0, 0, 0), (0, 0, 1)),
            "high": ts.PlaneObstacle((0, 0, SIDE + 2 * gap), (0, 0, -1), motion=down),
        },
        "contacts": [ts.Contact(("cube", ("low", "high")), friction=friction, gap=gap)],
        "fixed": sides if symmetric else [],
        "step": ts.Static(),
    }
    return ts.Scene(**(given | fields))


def plate_forces(simulation):
    return simulation.force_on("low").force, simulation.force_on("high").force


def test_a_block_pressed_to_half_its_height_without_friction():
    """Homogeneous: closed form. 1e-4: its height is known to 4e-6 of it, by the depth's tolerance.

    At half its height the stress grows by 4.5 times what the height shrinks by.
    """
    scene = between_plates()
    simulation = scene.compile()
    pushed(simulation)
    rest, now = simulation.meshes["cube"].points, simulation.positions["cube"]
    stress, side = uniaxial(scene.bodies["cube"].law, 0.5)
    low, high = plate_forces(simulation)
    assert high == pytest.approx([0, 0, -stress * SIDE**2], abs=1e-4 * abs(stress) * SIDE**2)
    assert low + high == pytest.approx([0, 0, 0], abs=TOLERANCE * abs(high[2]))
    assert now[:, 0] == pytest.approx(side * rest[:, 0], abs=1e-4 * SIDE)


def test_a_block_that_sticks_bulges_and_is_pressed_harder():
    """Without any support: friction alone keeps it in its place."""
    free, stuck = between_plates(), between_plates(10.0, symmetric=False)
    simulation = stuck.compile()
    pushed(simulation)
    low, high = plate_forces(simulation)
    assert low + high == pytest.approx([0, 0, 0], abs=TOLERANCE * high[2])
    stress, side = uniaxial(free.bodies["cube"].law, 0.5)
    assert high[2] > -1.02 * stress * SIDE**2
    rest, now = simulation.meshes["cube"].points, simulation.positions["cube"]
    ends = rest[:, 2] > rest[:, 2].max() - 1e-9
    assert np.ptp(now[ends, 0]) == pytest.approx(SIDE, rel=0.02)  # they stick
    assert np.ptp(now[:, 0]) > side * SIDE
    assert not len(simulation.inverted_cells("cube"))


@pytest.mark.parametrize("friction", [0.1, 0.3])
def test_sliding_friction_lies_between(friction):
    """Every contact is in Coulomb's disk (`pushed`); many slide, on its border."""
    simulation = between_plates(friction, share=0.3).compile()
    pushed(simulation)
    found = simulation.contacts()
    normal = np.abs(found.forces[:, 2])
    along = np.hypot(found.forces[:, 0], found.forces[:, 1])
    sliding = along >= friction * normal * (1 - 1e-3)
    assert 9 <= sliding.sum() <= 49
    stress, _ = uniaxial(simulation.scene.bodies["cube"].law, 0.7)
    assert simulation.force_on("high").force[2] > -stress * SIDE**2


def test_in_ten_steps_as_in_one():
    """Without friction an equilibrium does not depend on its way: 1e-5, ten times the tolerance."""
    at_once, by_steps = between_plates().compile(), between_plates().compile()
    pushed(at_once)
    for _ in range(10):
        pushed_by = by_steps.step(0.1)
        assert pushed_by.converged
        assert by_steps.crossings() == []
    here, there = at_once.positions["cube"], by_steps.positions["cube"]
    assert here == pytest.approx(there, abs=1e-5 * SIDE)


def stacked(young=(1e5, 1e5), density=(1000, 1000), friction=0.3, **fields):
    """Two cubes on a table, one on the other, that supports do not hold."""
    cubes = {
        name: ts.Body(
            mesh=ts.BarMesh(size=(SIDE,) * 3, cells=(2, 2, 2), origin=(0, 0, z)),
            law=ts.StVK(young=young[i], poisson=0.3),
            density=density[i],
        )
        for i, (name, z) in enumerate({"under": GAP, "over": SIDE + 2 * GAP}.items())
    }
    return ts.Scene(
        bodies=cubes,
        obstacles={"table": ts.PlaneObstacle((0, 0, 0), (0, 0, 1))},
        contacts=[
            ts.Contact(("under", "table"), friction=friction, gap=GAP),
            ts.Contact(("over", "under"), friction=friction, gap=GAP),
        ],
        gravity=(0, 0, -GRAVITY),
        step=ts.Static(),
        **fields,
    )


CONTRASTS = {
    "alike": ((1e5, 1e5), (1000, 1000)),
    "heavy on light": ((1e6, 1e6), (10, 10_000)),
    "light on heavy": ((1e6, 1e6), (10_000, 100)),
    "stiff on soft": ((1e5, 1e11), (1000, 1000)),
    "soft on stiff": ((1e11, 1e5), (1000, 1000)),
}


@pytest.mark.parametrize("name", CONTRASTS)
def test_a_stack_carries_its_weights(name):
    """Masses and stiffnesses far apart: each joint carries what is above it, to 1e-5 of it."""
    young, density = CONTRASTS[name]
    simulation = stacked(young, density).compile()
    pushed(simulation)
    over = density[1] * GRAVITY * SIDE**3
    total = over + density[0] * GRAVITY * SIDE**3
    joint = between(simulation, "over", "under")
    assert joint == pytest.approx([0, 0, over], abs=1e-5 * total)
    table = simulation.force_on("table").force
    assert table == pytest.approx([0, 0, -total], abs=1e-5 * total)


def patch(**fields):
    """Two blocks of matching meshes, pressed together by a plate, free to widen."""
    gap = 1e-4
    half = {
        "cells": (4, 4, 2),
        "size": (SIDE, SIDE, SIDE / 2),
        "law": ts.StVK(young=1e5, poisson=0.3),
    }
    down = ts.Motion(times=(0, 1), displacements=((0, 0, 0), (0, 0, -0.02 * SIDE)))
    bodies = {"a": block((0, 0, gap), **half), "b": block((0, 0, SIDE / 2 + 2 * gap), **half)}
    sides = [
        ts.Fixed(b, on=ts.Plane(point=(0, 0, 0), normal=normal), axes=axis)
        for b in bodies
        for axis, normal in {"x": (1, 0, 0), "y": (0, 1, 0)}.items()
    ]
    return ts.Scene(
        bodies=bodies,
        obstacles={
            "low": ts.PlaneObstacle((0, 0, 0), (0, 0, 1)),
            "high": ts.PlaneObstacle((0, 0, SIDE + 3 * gap), (0, 0, -1), motion=down),
        },
        contacts=[
            ts.Contact(("a", "low"), gap=gap),
            ts.Contact(("b", "high"), gap=gap),
            ts.Contact(("b", "a"), gap=gap),
        ],
        fixed=sides,
        step=ts.Static(),
        **fields,
    )


@pytest.mark.parametrize("cells", [2, 3, 4])
@pytest.mark.parametrize("friction", [0.3, 1.0])
@pytest.mark.parametrize("young", [(20e3, 40e3), (40e3, 20e3), (20e3, 20e3)])
def test_a_soft_block_rests_on_one_whose_mesh_matches(cells, friction, young):
    """Its nodes stand on nodes, whose normals turn as they move: looks go round in circles."""
    side, gap = 0.05, 2e-4
    upper, lower = (
        ts.Body(
            mesh=ts.BarMesh(
                size=(side,) * 3, cells=(cells,) * 3, cell="hexahedron", origin=(0, 0, z)
            ),
            law=ts.StableNeoHooke(young=modulus, poisson=0.4),
            density=1000.0,
        )
        for z, modulus in zip((side + gap, 0.0), young, strict=True)
    )
    simulation = ts.Scene(
        bodies={"upper": upper, "lower": lower},
        gravity=(0, 0, -9.81),
        fixed=[ts.Fixed("lower", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        contacts=[ts.Contact(("upper", "lower"), friction=friction)],
        step=ts.Static(),
    ).compile()
    assert simulation.step().converged
    assert simulation.crossings() == []
    weight = 9.81 * 1000.0 * side**3
    np.testing.assert_allclose(
        simulation.force_on("upper").force, (0, 0, weight), atol=1e-4 * weight
    )


def test_the_patch_test_of_matching_meshes():
    """One stress in both blocks, at every point, within 3e-3: forces are settled to 1e-3.

    The normal between two nodes that face each other turns by their offset sideways over the gap.
    """
    simulation = patch().compile()
    pushed(simulation)
    stresses = [simulation.field("cauchy_stress", at="points", body=body) for body in ("a", "b")]
    stress = np.concatenate(stresses)
    area = np.ptp(simulation.positions["b"], axis=0)[:2].prod()
    expected = np.zeros((3, 3))
    expected[2, 2] = -simulation.force_on("high").force[2] / area
    assert np.abs(stress - expected).max() <= 3e-3 * abs(expected[2, 2])


@pytest.mark.parametrize("threads", [2, 4])
def test_any_number_of_threads_gives_the_same_bits(threads):
    def bits(**fields):
        simulation = stacked(**fields).compile()
        pushed(simulation)
        found = simulation.contacts()
        arrays = [simulation.positions[b] for b in simulation.bodies]
        return b"".join(np.ascontiguousarray(a).tobytes() for a in [*arrays, found.forces])

    assert bits(threads=threads) == bits()


def test_what_no_contact_can_hold_is_refused():
    scene = stacked()
    with pytest.raises(SceneError, match="body 'over' can move freely on some axis") as error:
        scene.replace(contacts=scene.contacts[:1]).compile()
    assert str(error.value).count("\n") == 1  # one problem
    with pytest.raises(SceneError, match=r"step.arc_length: found true with contacts"):
        scene.replace(step=ts.Static(arc_length=True)).compile()


def test_plates_that_leave_no_room_are_refused_and_leave_the_state_whole():
    simulation = between_plates(share=1.2).compile()
    before = simulation.positions["cube"].copy()
    with pytest.raises(TissuError, match="no equilibrium was found beyond") as error:
        simulation.step()
    assert "\n" not in str(error.value)
    assert np.array_equal(simulation.positions["cube"], before)
    assert simulation.crossings() == []
