"""Steps are linearised where parts turn to: what that saves, and what it leaves of turns."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import tissu as ts

METHODS: dict[str, Callable[..., ts.ImplicitEuler]] = {
    "implicit_euler": ts.ImplicitEuler,
    "bdf2": ts.BDF2,
    "newmark": ts.Newmark,
    "implicit_midpoint": ts.ImplicitMidpoint,
}
SOLVED = ts.Newton(iterations=20)
TETRA = ts.bar_mesh(size=(0.1, 0.04, 0.02), cells=(5, 2, 1), cell="tetra")
HEXA = ts.bar_mesh(size=(0.1, 0.04, 0.02), cells=(5, 2, 1), cell="hexahedron")
SHEET = ts.bar_mesh(size=(0.1, 0.04, 0), cells=(5, 2, 0), cell="triangle")
LINE = ts.bar_mesh(size=(0.1, 0, 0), cells=(8, 0, 0), cell="line")
STVK, HOOKE = ts.StVK(young=1e6, poisson=0.3), ts.Hooke(young=1e6, poisson=0.3)
RAYLEIGH, KELVIN_VOIGT = ts.Rayleigh(mass=0, stiffness=5e-3), ts.KelvinVoigt(eta=1e3, zeta=1e3)
ROUND = ts.Round(radius=3e-3)
KINDS = {
    "neo_hookean": ({"mesh": TETRA, "law": ts.StableNeoHooke(young=1e6, poisson=0.4)}, RAYLEIGH),
    "hexahedra": ({"mesh": HEXA, "law": STVK}, KELVIN_VOIGT),
    "corotational": ({"mesh": TETRA, "law": HOOKE, "model": "corotational"}, RAYLEIGH),
    "mass_spring": ({"mesh": TETRA, "law": HOOKE, "model": "mass_spring"}, KELVIN_VOIGT),
    "mass_link": ({"mesh": TETRA, "law": STVK, "model": "mass_link"}, RAYLEIGH),
    "sheet": ({"mesh": SHEET, "law": STVK, "thickness": 2e-3}, RAYLEIGH),
    "shell": ({"mesh": SHEET, "law": HOOKE, "model": "shell", "thickness": 2e-3}, RAYLEIGH),
    "rod": ({"mesh": LINE, "law": STVK, "model": "frames", "section": ROUND}, RAYLEIGH),
    "line": ({"mesh": LINE, "law": STVK, "section": ROUND}, RAYLEIGH),
}


def thrown(kind: str, viscosity: object = None) -> ts.Body:
    """A body of this kind that turns about an axis of none of its symmetries."""
    fields, _ = KINDS[kind]
    spin = (0, 0.5, 5) if kind in ("rod", "line") else (1, 2, 5)
    given = {} if viscosity is None else {"viscosity": viscosity}
    return ts.Body(density=1000, start=ts.Start(spin=spin), **fields, **given)


def energies(body: ts.Body, method: str, steps: int = 60) -> tuple[float, int]:
    """What is left of the energy after so many steps, and the linear systems that they solved."""
    scene = ts.Scene(bodies={"body": body}, step=METHODS[method](5e-3))
    simulation = scene.compile()
    before = simulation.energy()["total"]
    systems = 0
    for _ in range(steps):
        report = simulation.step()
        assert report.converged
        systems += report.newton_iterations
    return simulation.energy()["total"] / before, systems


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("kind", KINDS)
def test_a_turning_body_takes_one_system_a_step(method: str, kind: str) -> None:
    """As one that rests, and it has the energy that Newton's iteration leaves.

    At 5.5 rad/s and 5 ms, a body that is linearised where it was took three to four systems. The
    energies differ by what a step may leave: 3e-4 was the most of these 36 cases.
    """
    body = thrown(kind)
    left, systems = energies(body, method)
    assert systems == 60
    scene = ts.Scene(bodies={"body": body}, step=METHODS[method](5e-3, newton=SOLVED))
    simulation = scene.compile()
    before = simulation.energy()["total"]
    for _ in range(60):
        assert simulation.step().converged
    assert left == pytest.approx(simulation.energy()["total"] / before, abs=1e-3)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("kind", KINDS)
def test_viscosity_neither_drives_nor_brakes_a_turn(method: str, kind: str) -> None:
    """A rigid turn strains nothing, so that a viscous body has the energy of one without viscosity.

    The way of a step is a chord. At its end, its velocity squeezed what turns: by implicit Euler
    these bodies gained more than ten times their energy within 60 steps, by Newmark's method they
    lost 8 %. Viscosity takes what little energy the elastic vibration of the start has, up to
    0.6 % of the whole here.
    """
    _, viscosity = KINDS[kind]
    without, _ = energies(thrown(kind), method)
    damped, systems = energies(thrown(kind, viscosity), method)
    assert damped == pytest.approx(without, abs=6e-3)
    assert damped < 1.003  # the midpoint rule keeps the energy of linear bodies only
    assert systems == 60


@pytest.mark.parametrize("newton", [None, SOLVED], ids=["once", "newton"])
@pytest.mark.parametrize("method", ["implicit_euler", "bdf2", "newmark"])
def test_stiff_damping_does_not_feed_a_stiff_body(method: str, newton: ts.Newton | None) -> None:
    """1.6 MPa, 10 ms of Rayleigh's stiffness, 1.7 rad/s: the energy grew ten times in 40 steps."""
    mesh = ts.bar_mesh(size=(0.2, 0.1, 0.05), cells=(4, 2, 1), cell="hexahedron")
    spin = tuple(1.7 * np.array([0.1, 0.6, 0.79]))
    body = ts.Body(
        mesh=mesh,
        law=ts.StVK(young=1.6e6, poisson=0.3),
        density=1000,
        start=ts.Start(spin=spin),
        viscosity=ts.Rayleigh(mass=0, stiffness=1e-2),
    )
    scene = ts.Scene(bodies={"body": body}, step=METHODS[method](8.8e-3, newton=newton))
    simulation = scene.compile()
    energy = simulation.energy()["total"]
    for _ in range(40):
        assert simulation.step().converged
        now = simulation.energy()["total"]
        assert now <= energy * (1 + 1e-3)
        energy = now


@pytest.mark.parametrize("dt", [2e-3, 5e-3])
@pytest.mark.parametrize("method", ["implicit_euler", "bdf2", "newmark"])
def test_friction_on_a_turntable_is_the_centripetal_force(method: str, dt: float) -> None:
    """m w^2 r towards the axis: its mean to 0.5 %, and each step to 5 %.

    The table catches a block that rests, which slides out by 0.7 % of r and then vibrates: by up
    to 1.4 % in these six cases. BDF2 and Newmark's method average it to 0.3 % with 5 ms.
    Steps went in parts now and then, as what the linearisation left looked like contacts that do
    not settle. The chord of a step of another length has another direction, so the force of single
    steps was 25 % off by implicit Euler and 90 % by BDF2.
    """
    gap, rate = 2e-4, 4.0
    path = ts.Motion(
        times=(0, 100),
        rotation=ts.Rotation(axis=(0, 0, 1), center=(0, 0, 0), angles=(0, 100 * rate)),
    )
    mesh = ts.bar_mesh(
        size=(0.03, 0.03, 0.015), cells=(3, 3, 2), cell="hexahedron", origin=(0.07, -0.015, 0)
    )
    body = ts.Body(
        mesh=mesh,
        law=ts.StVK(young=2e5, poisson=0.3),
        density=1000,
        viscosity=ts.Rayleigh(mass=0, stiffness=2e-3),
    )
    simulation = ts.Scene(
        bodies={"block": body},
        obstacles={"table": ts.PlaneObstacle((0, 0, -gap), (0, 0, 1), motion=path)},
        contacts=[ts.Contact(("block", "table"), friction=0.6, gap=gap)],
        gravity=(0, 0, -9.81),
        step=METHODS[method](dt),
    ).compile()
    mass = simulation.mass_matrix().diagonal()[::3][:, None]
    radial, distances = [], []
    for _ in range(round(0.8 / dt)):
        assert simulation.step().converged
        centre = (mass * simulation.positions["block"]).sum(0)[:2] / mass.sum()
        distances.append(np.linalg.norm(centre))
        radial.append(simulation.force_on("block").force[:2] @ centre / distances[-1])
    half = len(radial) // 2
    settled = np.array(radial[half:])
    expected = -mass.sum() * rate**2 * np.mean(distances[half:])
    assert np.abs(settled - settled.mean()).max() < 0.05 * abs(expected)
    assert settled.mean() == pytest.approx(expected, rel=5e-3)


HELD = {
    "line": (ts.Nodes((0, 1, 2)), "x", (0, 3, 6)),
    "hinge": (ts.Box(max=(1e-6, None, 1e-6)), "xyz", (0, 10, 0)),
    "clamp": (ts.Box(max=(1e-6, None, None)), "xyz", (0, 0, 0)),
}


@pytest.mark.parametrize("method", ["implicit_euler", "bdf2", "newmark"])
@pytest.mark.parametrize("support", HELD)
@pytest.mark.parametrize("drift", [(1e-9, 0, 0), (0.2, 0.1, 0)])
def test_a_drift_of_support_and_body_changes_nothing(
    method: str, support: str, drift: tuple[float, float, float]
) -> None:
    """Galileo: against the support, the body moves as over one that rests, to 1 % of its way.

    The reactions of supports that move counted as acting, whatever they moved by: with 1e-9 m/s the
    body over the line had lost 44 % of its energy in 0.3 s and was 4.4 mm off.
    """
    held, axes, spin = HELD[support]
    body = ts.Body(mesh=HEXA, law=ts.StVK(young=1e6, poisson=0.3), density=1000)
    speed = np.array(drift)
    ends = ((0.0, 0.0, 0.0), tuple(10 * speed))

    def way(moves: bool) -> tuple[np.ndarray, float]:
        given = (
            {
                "prescribed": [
                    ts.Prescribed("b", on=held, axes=axes, times=(0, 10), displacements=ends)
                ]
            }
            if moves
            else {"fixed": [ts.Fixed("b", on=held, axes=axes)]}
        )
        simulation = ts.Scene(
            bodies={"b": body}, step=METHODS[method](4e-3), gravity=(0, 0, -9.81), **given
        ).compile()
        mass = simulation.mass_matrix().diagonal()[::3][:, None]
        x = simulation.positions["b"]
        about = (mass * x).sum(0) / mass.sum() if axes == "x" else np.zeros(3)
        turn = np.cross(spin, x - about)
        turn[~simulation.free_axes()[simulation.rows("b")]] = 0.0
        along = speed if moves else np.zeros(3)
        simulation.velocities["b"][:] = turn + along
        for _ in range(75):
            assert simulation.step().converged
        v = simulation.velocities["b"] - along
        energy = 0.5 * float((mass * v**2).sum()) + simulation.energy()["elastic"]
        return simulation.positions["b"] - simulation.time * along, energy

    (still, energy), (moved, other) = way(False), way(True)
    farthest = np.abs(still - body.mesh.points).max()
    assert np.abs(moved - still).max() < 1e-2 * farthest
    assert other == pytest.approx(energy, rel=1e-2)


def hinged() -> ts.Scene:
    """A viscous block that turns about one of its edges."""
    mesh = ts.bar_mesh(size=(0.2, 0.1, 0.05), cells=(4, 2, 1), cell="tetra")
    law, damped = ts.StableNeoHooke(young=1e6, poisson=0.4), ts.Rayleigh(mass=0, stiffness=2e-3)
    edge = ts.Fixed("b", on=ts.Box((-1e-3, -1e-3, -1e-3), (1e-3, 0.2, 1e-3)))
    body = ts.Body(mesh=mesh, law=law, density=1000, viscosity=damped)
    return ts.Scene(bodies={"b": body}, fixed=[edge], step=ts.ImplicitEuler(5e-3))


def test_reactions_are_the_change_of_momentum(tmp_path: Path) -> None:
    """Nothing else acts on the block: to 1e-3, as a linearised step leaves up to 2e-4 here.

    The reactions of viscous forces that the step does not have would be 60 % off. They are the same
    to the bit where a run goes on from a checkpoint.
    """
    simulation = hinged().compile()
    simulation.velocities["b"][:] = np.cross((0, 6.0, 0), simulation.positions["b"])
    mass = simulation.mass_matrix().diagonal()[::3][:, None]
    for _ in range(20):
        before = (mass * simulation.velocities["b"]).sum(0)
        assert simulation.step().converged
        force = ((mass * simulation.velocities["b"]).sum(0) - before) / 5e-3
        assert np.linalg.norm(simulation.reactions("b").sum(0) - force) < 1e-3 * np.linalg.norm(
            force
        )
    simulation.save_checkpoint(tmp_path / "middle")
    resumed = hinged().compile(checkpoint=tmp_path / "middle")
    np.testing.assert_array_equal(resumed.reactions("b"), simulation.reactions("b"))
    mark = simulation.mark()
    kept = simulation.reactions("b").copy()
    simulation.step()
    simulation.rewind(mark)
    np.testing.assert_array_equal(simulation.reactions("b"), kept)


@pytest.mark.parametrize("method", ["implicit_euler", "bdf2"])
def test_a_step_in_which_nothing_acts_leaves_nothing(method: str) -> None:
    """A tool comes near a body that rests: no step has left more than it was solved to.

    The bodies' own round-off was all that acted, and the report said that 16 times that was left.
    """
    body = ts.Body(
        mesh=ts.bar_mesh(size=(0.06, 0.06, 0.04), cells=(3, 3, 2), cell="hexahedron"),
        law=ts.StableNeoHooke(young=6e4, poisson=0.4),
        density=1000,
        viscosity=ts.KelvinVoigt(eta=20),
    )
    motion = ts.Motion(times=(0, 0.2), displacements=((0, 0, 0), (0, 0, -0.015)))
    tool = ts.CapsuleObstacle(((0.03, 0.03, 0.06), (0.03, 0.03, 0.16)), 0.01, motion=motion)
    simulation = ts.Scene(
        bodies={"block": body},
        fixed=[ts.Fixed("block", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        obstacles={"tool": tool},
        contacts=[ts.Contact(("block", "tool"), friction=0.4)],
        step=METHODS[method](5e-3),
    ).compile()
    for report in simulation.run(0.1):
        assert report.converged
        assert report.residual < 1e-2
