"""Hard cases with contact that move: momentum, energy, tools, and how scenes may begin."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest
from contact_runs import masses, ran, run
from outcome import CONTACT, case, with_method

import tissu as ts
from tissu.contact_cost.scenes import ball

METHODS = pytest.mark.parametrize("method", ["implicit_euler", "bdf2"])


def test_a_ball_stays_in_its_hollow_and_never_gains_energy() -> None:
    """It meets the wall within the first step."""
    result = ran("hollow")
    simulation = result.simulation
    assert result.reports[0].contacts > 0
    assert max(result.energies) <= 1.001 * result.energies[0]
    # The hollow's facets lie inside the sphere of its corners; every node of the ball inside them.
    assert np.linalg.norm(simulation.positions["ball"], axis=1).max() < 0.1
    assert not simulation.displacements("hollow").any()


@pytest.mark.parametrize("dt", ["10 ms", "1 ms"])
def test_a_ball_ten_times_faster_than_its_sound_is_stopped(dt: str) -> None:
    """In one step it would go by fifty of its cells: impacts are divided until nodes go by one.

    It is crushed, cells turn inside out, and steps do not converge. It loses energy.
    """
    scene = case("hollow", CONTACT)
    ball = scene.bodies["ball"].replace(law=ts.StableNeoHooke(young="100 kPa", poisson=0.4))
    scene = scene.replace(
        bodies={**scene.bodies, "ball": ball}, step=ts.ImplicitEuler(dt), duration="40 ms"
    )
    result = run(scene)
    assert result.reports[0].substeps > 1
    assert result.energies[-1] < 0.1 * result.energies[0]
    assert max(result.energies) <= 1.001 * result.energies[0]
    assert np.linalg.norm(result.simulation.positions["ball"], axis=1).max() < 0.1


@METHODS
def test_livers_keep_their_momentum_when_they_meet(method: str) -> None:
    """To round-off: no node is held or led, and the solves are exact."""
    simulation = with_method(case("livers_meet", CONTACT), method).compile()

    def momentum() -> np.ndarray:
        return sum(masses(simulation, b) @ simulation.velocities[b] for b in simulation.bodies)

    start, size, most = momentum(), 0.5 * masses(simulation, "low").sum(), 0.0
    for report in simulation.run():
        force, other = (simulation.force_on(body).force for body in ("low", "high"))
        most = max(most, np.abs(force).max())
        assert np.abs(force + other).max() <= 1e-9 * np.abs(force).max()
        assert np.abs(momentum() - start).max() < 1e-12 * size, report
        assert not any(len(simulation.inverted_cells(body)) for body in simulation.bodies)
    # They met: half of 1.6 kg at 0.5 m/s is turned round within 0.1 s.
    assert most > 5.0
    assert simulation.velocities["low"][:, 2].mean() < 0.0


@METHODS
def test_livers_pushed_together_press_alike(method: str) -> None:
    simulation = ran("livers", method).simulation
    force, other = (simulation.force_on(body).force for body in ("low", "high"))
    assert np.abs(force + other).max() <= 1e-9 * np.abs(force).max()
    assert 0.3 < -force[2] < 3.0
    found = simulation.contacts()
    normal = np.einsum("ij,ij->i", found.forces, found.normals)
    drag = np.linalg.norm(found.forces - normal[:, None] * found.normals, axis=1)
    assert (drag <= 0.3 * normal * (1 + 1e-9)).all()


@METHODS
def test_just_above_its_angle_a_block_slides_by_coulombs_law(method: str) -> None:
    """g (sin phi - mu cos phi) within 1 % of what drives it down; it begins to slide as a whole."""
    scene = with_method(case("slope_slides", CONTACT), method)
    simulation = scene.compile()
    for _ in simulation.run("2 s"):
        pass
    before = simulation.velocities["block"][:, 0].mean()
    for _ in simulation.run("1 s"):
        assert simulation.crossings() == []
    gain = simulation.velocities["block"][:, 0].mean() - before
    phi = 1.01 * math.atan(0.5)
    assert gain == pytest.approx(9.81 * (math.sin(phi) - 0.5 * math.cos(phi)), rel=1e-2)


def tool_low(simulation: ts.Simulation) -> float:
    """Height of the lowest point of the tool [m]."""
    return float(simulation.obstacle("tool").place_of((0.09, 0.11, 0.03))[2]) - 0.01


@METHODS
def test_a_tool_at_100_m_per_s_takes_the_sheet_along(method: str) -> None:
    """In steps of 0.05 ms, of 5 mm each."""
    result = ran("tool_shot", method)
    simulation = result.simulation
    assert tool_low(simulation) == pytest.approx(-0.03, abs=1e-12)
    sheet = simulation.positions["sheet"]
    assert sheet[:, 2].min() < -0.03
    # Its axis is audited; and no node is nearer to that than the radius and half the thickness.
    aside = sheet - (0.09, 0.11, -0.02)
    aside[:, 2] = np.minimum(aside[:, 2], 0.0)  # the axis goes up from there
    apart = np.linalg.norm(aside, axis=1)
    assert apart.min() > 0.0105
    # It does not press all the time: what it strikes flies ahead of it.
    assert sum(report.contacts > 0 for report in result.reports) > 150


@pytest.mark.parametrize("dt", ["0.5 ms", "10 ms"])
def test_in_one_step_it_goes_in_parts_or_is_refused_with_a_step_that_does(dt: str) -> None:
    """5 cm of a step: the sheet is before the tool, or nothing has moved and a dt is named."""
    scene = case("tool_shot", CONTACT).replace(step=ts.ImplicitEuler(dt))
    simulation = scene.compile()
    try:
        for _ in range(4):
            simulation.step()
            assert simulation.crossings() == []
    except ts.TissuError as error:
        assert re.search(r"dt", str(error))
    else:
        assert simulation.positions["sheet"][:, 2].min() < tool_low(simulation)
    assert simulation.crossings() == []
    assert np.isfinite(simulation.positions["sheet"]).all()


@METHODS
def test_a_rod_is_drawn_out_of_a_fold(method: str) -> None:
    """It opens the layers before it, rubs on them, and leaves them one above the other."""
    result = ran("fold_drawn", method)
    simulation = result.simulation
    assert sum(report.contacts > 0 for report in result.reports) > 10
    assert simulation.obstacle("rod").place_of((0.1, 0.0, 0.008))[0] == pytest.approx(-0.03)
    assert len(simulation.contacts()) == 0
    # The upper layer swings above the lower one, its length of 10 cm not turned over.
    upper = simulation.meshes["sheet"].points[:, 2] > 0.001
    heights = simulation.positions["sheet"][upper, 2]
    assert heights.min() > 0.002
    assert heights.max() < 0.06


def two(origin: tuple[float, float, float], size: float = 0.1) -> ts.Scene:
    """A block of 10 cm, and another one somewhere."""

    def block(at: tuple[float, float, float], edge: float) -> ts.Body:
        mesh = ts.BarMesh(size=(edge,) * 3, cells=(2, 2, 2), cell="hexahedron", origin=at)
        return ts.Body(mesh=mesh, law=ts.StVK(young=1e5, poisson=0.3), density=1000.0)

    return ts.Scene(
        bodies={"one": block((0, 0, 0), 0.1), "other": block(origin, size)},
        contacts=[ts.Contact(("one", "other"), friction=0.3, gap="1 mm")],
        step=ts.ImplicitEuler("10 ms"),
        duration=0.5,
    )


@pytest.mark.parametrize("origin", [(0.03, 0.02, 0.05), (0.0, 0.0, 0.0)])
def test_an_overlap_is_refused_with_names_and_count(origin: tuple[float, float, float]) -> None:
    """Half in each other, and in the very same place."""
    with pytest.raises(ts.SceneError) as refused:
        two(origin).compile()
    assert re.search(r'"one" and "other" in \d+ places', str(refused.value))


@pytest.mark.parametrize(("origin", "size"), [((0, 0, 0.1), 0.1), ((0.02, 0.03, 0.1), 0.05)])
def test_faces_that_coincide_are_moved_apart(
    origin: tuple[float, float, float], size: float
) -> None:
    """By no more than the gap; then the rest of it pushes them slowly."""
    simulation = two(origin, size).compile()
    assert simulation.crossings() == []
    for body in simulation.bodies:
        moved = simulation.positions[body] - simulation.meshes[body].points
        assert 0.0 <= np.abs(moved).max() <= 1e-3
    below = simulation.positions["one"][:, 2].max()
    assert simulation.positions["other"][:, 2].min() > below
    result = run(two(origin, size))
    assert result.outcome.crossings == 0
    # A gap of 1 mm that is made good in a step of 10 ms: 0.1 m/s between the two.
    fastest = max(np.abs(result.simulation.velocities[b]).max() for b in ("one", "other"))
    assert fastest < 0.1


def test_one_inside_the_other_without_touching_stays_there() -> None:
    """No surface crosses: the scene is run as it is."""
    result = run(two((0.04, 0.04, 0.04), 0.02))
    assert result.outcome.crossings == 0
    assert max(report.contacts for report in result.reports) == 0
    assert result.outcome.bound < 1e-12


def test_a_ball_at_100_m_s_is_stopped_by_a_slab() -> None:
    """Its blow is taken in many parts, none of which goes on as the one before did.

    Parts that were linearised where the ball would have turned to ended in values that fly out of
    the scene.
    """
    simulation = ball().scene().compile()
    before = simulation.energy()["total"]
    for _ in range(2):
        simulation.step()
        assert simulation.crossings() == []
        assert simulation.energy()["total"] < 0.1 * before
