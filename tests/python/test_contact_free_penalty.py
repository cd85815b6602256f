"""Springs of the method penalty before obstacles with a mass."""

import pytest

import tissu as ts

RADIUS, MASS, SPEED = 0.01, 0.02, 0.05


def ball(height, **fields):
    return ts.SphereObstacle((0.03, 0.03, height), radius=RADIUS, mass=MASS, **fields)


def pad(young, **fields):
    mesh = ts.BarMesh(size=(0.06, 0.06, 0.02), cells=(6, 6, 2), **fields)
    return ts.Body(mesh=mesh, law=ts.StVK(young=young, poisson=0.3), density=1000.0)


def thrown(e, method="penalty", step=None, bodies=None, between=("ball", "table")):
    table = ts.PlaneObstacle((0, 0, 0), (0, 0, 1))
    return ts.Scene(
        bodies={"far": pad("10 kPa", origin=(1, 1, 1))} if bodies is None else bodies,
        obstacles={"table": table, "ball": ball(RADIUS + 0.002, velocity=(0, 0, -SPEED))},
        contacts=[ts.Contact(between, restitution=e)],
        contact=ts.ContactSettings(method=method),
        step=step or ts.SymplecticEuler(1e-5),
    )


@pytest.mark.parametrize("e", [0.2, 0.5, 0.8, 1.0])
def test_a_free_ball_leaves_a_plane_with_its_restitution(e):
    simulation = thrown(e).compile()
    for _ in simulation.run(0.1):
        pass
    # As of the damper of a node: steps of 1e-5 s are a hundredth of the spring's period.
    assert simulation.rigid("ball").velocity[2] / SPEED == pytest.approx(e, abs=2e-3)


@pytest.mark.parametrize(
    "changes",
    [{"step": ts.ImplicitEuler("1 ms")}, {"step": ts.BDF2("1 ms")}, {"bodies": {}},
     {"step": ts.ImplicitEuler("1 ms"), "between": ("far", "ball")},
     {"bodies": {}, "between": "all"}],
)  # fmt: skip
def test_restitution_without_springs_is_refused(changes):
    sentence = "found 0.5, but 'ball' has a mass and the method penalty has no springs for it in "
    with pytest.raises(ts.SceneError, match=sentence):
        thrown(0.5, **changes).compile()
