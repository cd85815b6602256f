"""Forces of supports: they carry the weight, and the inertia of what is led."""

import numpy as np
import pytest

import tissu as ts

BAR = ts.BarMesh(size=(0.2, 0.1, 0.1), cells=(4, 2, 2), cell="hexahedron")
HELD = ts.Plane((0, 0, 0), (1, 0, 0))


def body(**changes):
    fields = {"mesh": BAR, "law": ts.StVK(young=1e5, poisson=0.3), "mass": 2.0}
    return ts.Body(**{**fields, **changes})


@pytest.mark.parametrize("model", ["fem", "condensed"])
def test_supports_carry_weight_and_loads(model):
    scene = ts.Scene(
        bodies={"bar": body(model=model, law_for_model="nearest")},
        gravity=(0, 0, -9.81),
        fixed=[ts.Fixed("bar", on=HELD)],
        loads=[ts.NodalLoad("bar", on=ts.Nodes([8]), force=(3, 0, 1))],
        step=ts.Static(solver=ts.Cholesky()),
    )
    simulation = scene.compile()
    simulation.step()
    found = simulation.reactions("bar")
    # Newton's tolerance of 1e-9 of the loads.
    assert found.sum(axis=0) == pytest.approx((-3, 0, 2 * 9.81 - 1), abs=1e-6)
    free = simulation.meshes["bar"].points[:, 0] > 1e-9
    assert not found[free].any()


def test_only_held_axes_give_a_force():
    scene = ts.Scene(
        bodies={"bar": body()},
        gravity=(0, 0, -9.81),
        fixed=[ts.Fixed("bar", on=HELD, axes="z"), ts.Fixed("bar", on=ts.Nodes([0]), axes="xy")],
        step=ts.ImplicitEuler("1 ms"),
        duration=0.01,
    )
    simulation = scene.compile()
    for _ in simulation.run():
        pass
    found = simulation.reactions("bar")
    others = np.arange(len(found)) != 0
    assert not found[others][:, :2].any()
    assert found[:, 2].any()


def test_a_led_body_is_driven_by_its_inertia():
    """All nodes move alike: from rest to 1 m/s in the first step of 10 ms, F = m a = 200 N."""
    every = ts.Box((None,) * 3, (None,) * 3)
    motion = ts.Prescribed("bar", on=every, times=[0, 1], displacements=[(0, 0, 0), (1, 0, 0)])
    scene = ts.Scene(
        bodies={"bar": body()}, prescribed=[motion], step=ts.ImplicitEuler("10 ms"), duration=1
    )
    simulation = scene.compile()
    simulation.step()
    assert simulation.reactions("bar").sum(axis=0) == pytest.approx((200, 0, 0), abs=1e-9)
    simulation.step()
    assert simulation.reactions("bar").sum(axis=0) == pytest.approx((0, 0, 0), abs=1e-9)
