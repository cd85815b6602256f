"""Flat bodies in contact: their rims meet planes, round things and each other, in their plane."""

import numpy as np
import pytest

import tissu as ts
from contact_audit import GRAVITY, audited, damped
from contact_static import pushed
from test_contact_balance import momentum
from tissu.errors import SceneError

THICK = 0.02
"""of the bodies [m]"""
SIDE = 0.1
"""[m]"""
WEIGHT = 1000.0 * GRAVITY * SIDE * SIDE * THICK
"""of a block [N]"""
IMPLICIT = ("augmented", "barrier", "penalty")
EXPLICIT = ("impulse", "penalty", "geometric")
FLOOR = ts.PlaneObstacle((0, 0, 0), (0, 1, 0))
BLOCK = ts.BarMesh(size=(1, 1, 1), cells=(1, 1, 1))


def flat(origin=(0, 0), *, cells=(4, 4), cell="quad", size=(SIDE, SIDE), **fields):
    """A square of 10 cm in the plane z = 0."""
    mesh = ts.BarMesh(size=(*size, 0), cells=(*cells, 0), cell=cell, origin=(*origin, 0))
    given = {"law": ts.StVK(young=2e4, poisson=0.3), "density": 1000.0, "plane": "strain"}
    return ts.Body(**({"mesh": mesh, "thickness": THICK} | given | fields))


def resting(name="auto", body=None, **fields):
    """A square that falls by 1 mm on a floor."""
    given = {
        "bodies": {"square": body or flat((0, 1e-3), viscosity=damped(20.0, 1e-4))},
        "obstacles": {"floor": FLOOR},
        "contacts": [ts.Contact(("square", "floor"), friction=0.3)],
        "contact": ts.ContactSettings(method=name),
        "gravity": (0, -GRAVITY, 0),
        "step": ts.ImplicitEuler("5 ms"),
    }
    return ts.Scene(**(given | fields))


def colliding(step, name="auto", threads=1):
    """Two squares that meet off centre at 2 m/s, the corner of one on the side of the other."""
    return ts.Scene(
        bodies={
            "left": flat(start=ts.Start(velocity=(1, 0, 0))),
            "right": flat((0.102, 0.031), cells=(3, 3), start=ts.Start(velocity=(-1, 0, 0))),
        },
        contacts=[ts.Contact(("left", "right"), friction=0.3, gap=4e-4)],
        contact=ts.ContactSettings(method=name),
        step=step,
        threads=threads,
    )


@pytest.mark.parametrize("cell", ["quad", "triangle", "quad8", "triangle6"])
@pytest.mark.parametrize("plane", ["strain", "stress"])
def test_a_square_rests_with_its_weight(plane, cell):
    """1e-3: what is left of its swing."""
    body = flat((0, 1e-3), cell=cell, plane=plane, viscosity=damped(20.0, 1e-4))
    simulation = resting(body=body).compile()
    audited(simulation, 160)
    force = simulation.force_on("floor").force
    assert force == pytest.approx([0, -WEIGHT, 0], abs=1e-3 * WEIGHT)
    assert simulation.positions["square"][:, 1].min() > 0.0
    assert np.ptp(simulation.positions["square"][:, 2]) == 0.0


@pytest.mark.parametrize(
    ("step", "name"),
    [(ts.ImplicitEuler("5 ms"), name) for name in IMPLICIT]
    + [(ts.SymplecticEuler(), name) for name in EXPLICIT],
)
def test_every_response_holds_a_square(step, name):
    """The mean of 0.1 s counts; geometric lifts what is deep without a force, and holds to 5 %."""
    simulation = resting(name, step=step).compile()
    forces = []
    while simulation.time < 0.8:
        report = simulation.step()
        assert simulation.crossings() == []
        assert report.converged
        if simulation.time > 0.7:
            forces.append(simulation.force_on("floor").force)
    share = 5e-2 if name == "geometric" else 5e-3
    assert np.mean(forces, axis=0) == pytest.approx([0, -WEIGHT, 0], abs=share * WEIGHT)


def test_squares_stand_on_each_other():
    """Each joint bears the weight above it; nodes of one rim stand between those of the other."""
    firm = {"law": ts.StVK(young=4e5, poisson=0.3), "viscosity": damped(20.0, 1e-3)}
    bodies = {
        "low": flat((0, 4e-4), **firm),
        "high": flat((0.013, SIDE + 8e-4), cells=(3, 3), **firm),
    }
    contacts = [ts.Contact(("low", ("floor", "high")), friction=0.5, gap=4e-4)]
    simulation = resting(bodies=bodies, contacts=contacts).compile()
    audited(simulation, 200)
    low, high = (simulation.force_on(name).force for name in ("low", "high"))
    assert high == pytest.approx([0, WEIGHT, 0], abs=2e-3 * WEIGHT)
    assert low == pytest.approx([0, WEIGHT, 0], abs=2e-3 * WEIGHT)
    assert simulation.force_on("floor").force + low + high == pytest.approx(
        np.zeros(3), abs=1e-9 * WEIGHT
    )


@pytest.mark.parametrize(
    ("step", "name", "tolerance"),
    [
        (ts.ImplicitEuler("2 ms"), "augmented", 1e-6),
        (ts.ImplicitEuler("2 ms"), "barrier", 1e-6),
        (ts.SymplecticEuler(), "impulse", 1e-12),
        (ts.SymplecticEuler(), "penalty", 1e-12),
        (ts.SymplecticEuler(), "geometric", 1e-12),
    ],
)
def test_a_collision_keeps_momentum(step, name, tolerance):
    """Linear momentum to round-off, in implicit steps to the tolerance of the linear solver."""
    simulation = colliding(step, name).compile()
    touched = 0
    while simulation.time < 0.04:
        report = simulation.step()
        assert simulation.crossings() == [], report
        touched += report.contacts
    assert touched
    mass = 1000.0 * SIDE * SIDE * THICK
    assert momentum(simulation) == pytest.approx(np.zeros(3), abs=tolerance * mass)
    assert simulation.velocities["left"][:, 0].mean() < 0.0


def test_a_pressed_strip_bears_the_homogeneous_force():
    """Plane strain without friction: F = E / (1 - nu^2) (1 - h / L) times the area across."""
    press = ts.Motion(times=(0, 1), displacements=((0, 0, 0), (0, -0.0055, 0)))
    low = 2e-4
    scene = ts.Scene(
        bodies={"strip": flat((0, low), law=ts.Hooke(young=1e4, poisson=0.3))},
        obstacles={
            "floor": FLOOR,
            "plate": ts.PlaneObstacle((0, 0.1005, 0), (0, -1, 0), motion=press),
        },
        contacts=[ts.Contact(("strip", ("floor", "plate")), gap=1e-4)],
        fixed=[ts.Fixed("strip", on=ts.Nodes((12,)), axes="x")],
        step=ts.Static(load_steps=1),
    )
    simulation = scene.compile()
    pushed(simulation)
    height = np.ptp(simulation.positions["strip"][:, 1])
    assert height < 0.096
    wanted = 1e4 / (1 - 0.3**2) * (1.0 - height / SIDE) * SIDE * THICK
    assert simulation.force_on("plate").force[1] == pytest.approx(wanted, rel=1e-3)


def test_a_ball_presses_a_square():
    """A round thing in the plane: the force along z is zero, and the support bears the rest."""
    path = ts.Motion(times=(0, 1), displacements=((0, 0, 0), (0, -0.05, 0)))
    scene = resting(
        body=flat(cells=(8, 8), viscosity=damped(5.0, 1e-3)),
        obstacles={"floor": ts.SphereObstacle((0.05, 0.126, 0), 0.025, motion=path)},
        fixed=[ts.Fixed("square", on=ts.Plane((0, 0, 0), (0, 1, 0)))],
        gravity=None,
    )
    simulation = scene.compile()
    audited(simulation, 40)
    force = simulation.force_on("floor").force
    assert force[1] > 0.1
    assert force[2] == 0.0
    middle = np.array([0.05, 0.126 - 0.01, 0])
    distance = np.linalg.norm(simulation.positions["square"] - middle, axis=1)
    assert distance.min() > 0.0249


def test_a_bracket_closes_on_itself():
    """The two jaws of a C meet, and nothing crosses."""
    mesh = ts.bar_mesh(size=(0.12, 0.1, 0), cells=(12, 10, 0), cell="quad")
    block = mesh.cells[0]
    middle = mesh.points[block.nodes].mean(axis=1)
    slot = (middle[:, 0] > 0.03) & (np.abs(middle[:, 1] - 0.05) < 0.011)
    cut = ts.Mesh(points=mesh.points, cells=(ts.CellBlock("quad", block.nodes[~slot]),))
    cut = cut.without_unused_nodes()
    top = np.flatnonzero((cut.points[:, 1] > 0.0999) & (cut.points[:, 0] > 0.08))
    body = flat(viscosity=damped(20.0, 1e-3)).replace(mesh=cut)
    scene = ts.Scene(
        bodies={"jaws": body},
        contacts=[ts.SelfContact("jaws", friction=0.2)],
        fixed=[ts.Fixed("jaws", on=ts.Plane((0, 0, 0), (0, 1, 0)))],
        loads=[ts.NodalLoad("jaws", on=ts.Nodes(tuple(top.tolist())), force=(0, -1.5, 0))],
        step=ts.ImplicitEuler("5 ms"),
    )
    simulation = scene.compile()
    most = 0
    for _ in range(80):
        report = simulation.step()
        assert simulation.crossings() == [], report
        most = max(most, report.contacts)
    assert most > 0


@pytest.mark.parametrize("step", [ts.ImplicitEuler("2 ms"), ts.SymplecticEuler("0.2 ms")])
def test_threads_and_a_run_that_is_resumed_change_no_bit(step, tmp_path):
    ends = []
    for threads in (1, 2):
        simulation = colliding(step, threads=threads).compile()
        while not len(simulation.contacts()):
            audited(simulation, 1)
        simulation.save_checkpoint(tmp_path / "middle.ckpt")
        audited(simulation, 10)
        ends.append(simulation.positions["left"].tobytes())
    again = colliding(step).compile(checkpoint=tmp_path / "middle.ckpt")
    audited(again, 10)
    ends.append(again.positions["left"].tobytes())
    assert ends[0] == ends[1] == ends[2]


# The start.


def test_squares_that_touch_are_moved_apart():
    """By at most their gap: side on side, where rims share points."""
    bodies = {"low": flat(), "high": flat((0.02, SIDE), cells=(3, 3))}
    contacts = [ts.Contact(("low", ("floor", "high")), gap=4e-4)]
    simulation = resting(bodies=bodies, contacts=contacts).compile()
    assert simulation.crossings() == []
    for name in bodies:
        moved = np.abs(simulation.displacements(name))
        assert 0.0 < moved.max() <= 4e-4 * (1 + 1e-9)
        assert moved[:, 2].max() == 0.0
    audited(simulation, 20)


def test_squares_that_overlap_are_refused():
    bodies = {"low": flat(), "high": flat((0.02, 0.08))}
    contacts = [ts.Contact(("low", "high"))]
    with pytest.raises(SceneError, match=r'overlap at the start: "low" and "high" in 2 places'):
        resting(bodies=bodies, contacts=contacts, obstacles={}, gravity=None).compile()


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        (
            {"contacts": [ts.Contact(("square", "floor"), stiffness=1e6)],
             "contact": ts.ContactSettings(method="penalty")},
            "whose rim has no area",
        ),
        (
            {"contact": ts.ContactSettings(surface_of={"square": BLOCK})},
            "no volume cells to carry a surface",
        ),
    ],
)  # fmt: skip
def test_what_is_refused(fields, words):
    with pytest.raises(SceneError, match=words):
        resting(**fields).compile()
