"""Parameters set while it runs: from then on it is a new scene with those values."""

import numpy as np
import pytest

import tissu as ts

BAR = ts.BarMesh(size=(0.1, 0.02, 0.02), cells=(5, 2, 2), cell="tetra")
STEPS = {
    "implicit_euler": ts.ImplicitEuler("10 ms"),
    "newton": ts.ImplicitEuler("10 ms", newton=ts.Newton()),
    "newmark": ts.Newmark("10 ms"),
    "bdf2": ts.BDF2("10 ms"),
    "rk4": ts.RK4("0.2 ms"),
    "cholesky": ts.ImplicitEuler("10 ms", solver=ts.Cholesky()),
}


def scene(step=STEPS["implicit_euler"], *, law=None, viscosity=None, **fields):
    body = ts.Body(
        mesh=fields.pop("mesh", BAR),
        law=law or ts.StVK(young="5 kPa", poisson=0.4),
        density=1000,
        viscosity=viscosity,
    )
    given = {
        "gravity": (0, 0, -9.81),
        "fixed": [ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)))],
        **fields,
    }
    return ts.Scene(bodies={"bar": body}, step=step, **given)


def after(simulation, count):
    for _ in range(count):
        simulation.step()
    return simulation.positions["bar"].copy()


def taken_up(simulation, other):
    """A new simulation of another scene, in the state in which this one stands."""
    found = other.compile()
    found._core.restore(simulation._core.snapshot())
    return found


CHANGES = [
    ("bodies.bar.law.young", 9e3, {"law": ts.StVK(young=9e3, poisson=0.4)}),
    ("bodies.bar.law.poisson", 0.2, {"law": ts.StVK(young=5e3, poisson=0.2)}),
    ("gravity.z", 3.0, {"gravity": (0, 0, 3.0)}),
    ("gravity.x", -2.0, {"gravity": (-2.0, 0, -9.81)}),
]


@pytest.mark.parametrize("step", STEPS.values(), ids=STEPS)
@pytest.mark.parametrize(("name", "value", "fields"), CHANGES, ids=[c[0] for c in CHANGES])
def test_it_goes_on_as_a_new_scene_with_the_value_would(step, name, value, fields):
    """Bit for bit: the new scene takes up time, positions, velocities and what methods remember."""
    simulation = scene(step).compile()
    after(simulation, 7)
    other = taken_up(simulation, scene(step, **fields))
    before = simulation.positions["bar"].copy()
    simulation.parameters[name] = value
    assert np.array_equal(before, simulation.positions["bar"])  # nothing jumps
    assert np.array_equal(after(simulation, 7), after(other, 7))
    plain = taken_up(simulation, scene(step))
    assert not np.array_equal(after(simulation, 3), after(plain, 3))  # the value matters


VISCOSITIES = [
    ("mass", ts.Rayleigh(mass=1, stiffness=0.02), ts.Rayleigh(mass=8, stiffness=0.02), 8),
    ("stiffness", ts.Rayleigh(mass=1, stiffness=0.02), ts.Rayleigh(mass=1, stiffness=0.1), 0.1),
    ("eta", ts.KelvinVoigt(eta=10), ts.KelvinVoigt(eta=80), 80),
    ("zeta", ts.KelvinVoigt(eta=10), ts.KelvinVoigt(eta=10, zeta=50), 50),
    ("coefficient", ts.Centroid(coefficient=1e5), ts.Centroid(coefficient=9e5), 9e5),
    (
        "branches.0.weight",
        ts.Prony(branches=[ts.PronyBranch(weight=0.5, time=0.1)]),
        ts.Prony(branches=[ts.PronyBranch(weight=2.0, time=0.1)]),
        2.0,
    ),
    (
        "branches.0.time",
        ts.Prony(branches=[ts.PronyBranch(weight=0.5, time=0.1)]),
        ts.Prony(branches=[ts.PronyBranch(weight=0.5, time=0.4)]),
        0.4,
    ),
]


@pytest.mark.parametrize(
    ("name", "then", "now", "value"), VISCOSITIES, ids=[v[0] for v in VISCOSITIES]
)
def test_damping_changes_with_all_that_it_remembers(name, then, now, value):
    simulation = scene(viscosity=then).compile()
    after(simulation, 8)
    other = taken_up(simulation, scene(viscosity=now))
    simulation.parameters[f"bodies.bar.viscosity.{name}"] = value
    assert np.array_equal(after(simulation, 8), after(other, 8))


def test_cells_that_were_removed_stay_removed():
    simulation = scene(editing=True, viscosity=VISCOSITIES[-1][1]).compile()
    after(simulation, 4)
    simulation.remove_cells(body="bar", cells=[3, 50, 51])
    after(simulation, 4)
    stiffer = scene(editing=True, viscosity=VISCOSITIES[-1][1], law=ts.StVK(young=9e3, poisson=0.4))
    other = taken_up(simulation, stiffer)
    simulation.parameters["bodies.bar.law.young"] = 9e3
    assert simulation.meshes["bar"].cell_count == simulation._rest["bar"].cell_count - 3
    assert set(range(60)) - set(simulation.remaining_cells("bar")) == {3, 50, 51}
    assert np.array_equal(after(simulation, 6), after(other, 6))


def test_a_view_of_the_positions_follows_and_units_are_read():
    simulation = scene().compile()
    kept = simulation.positions["bar"]
    simulation.parameters["bodies.bar.law.young"] = "7 kPa"
    assert simulation.parameters["bodies.bar.law.young"] == 7000.0
    assert simulation.scene.bodies["bar"].law.young == 7000.0
    after(simulation, 3)
    assert kept is simulation.positions["bar"]
    assert np.abs(kept - simulation.meshes["bar"].points).max() > 1e-6


def test_numbers_have_the_names_and_units_of_the_scene():
    end = ts.Plane((0.1, 0, 0), (1, 0, 0))
    loads = [
        ts.NodalLoad("bar", on=end, force=(0, 0, 0.1), name="pull"),
        ts.Pressure("bar", on=end, pressure=10.0),
    ]
    parameters = scene(loads=loads, viscosity=ts.KelvinVoigt(eta=3.0)).compile().parameters
    told = {p.name: (p.value, p.unit) for p in parameters.all()}
    assert told == {
        "gravity.x": (0.0, "m/s^2"),
        "gravity.y": (0.0, "m/s^2"),
        "gravity.z": (-9.81, "m/s^2"),
        "bodies.bar.law.young": (5000.0, "Pa"),
        "bodies.bar.law.poisson": (0.4, ""),
        "bodies.bar.viscosity.eta": (3.0, "Pa s"),
        "bodies.bar.viscosity.zeta": (0.0, "Pa s"),
        "loads.pull.force.x": (0.0, "N"),
        "loads.pull.force.y": (0.0, "N"),
        "loads.pull.force.z": (0.1, "N"),
        "loads.pull.factor": (1.0, ""),
        "loads.1.pressure": (10.0, "Pa"),
        "loads.1.factor": (1.0, ""),
    }
    about = parameters.about("bodies.bar.law.poisson")
    assert (about.least, about.most) == (-1.0, 0.5)


def test_a_load_is_set_as_the_live_load_is():
    end = ts.Plane((0.1, 0, 0), (1, 0, 0))
    loads = [ts.NodalLoad("bar", on=end, force=(0, 0, 0.1), name="pull")]
    one, other = scene(loads=loads).compile(), scene(loads=loads).compile()
    one.parameters["loads.pull.force.y"] = "50 mN"
    one.parameters["loads.pull.factor"] = 0.5
    other.load("pull").force = (0, 0.05, 0.1)
    other.load("pull").factor = 0.5
    assert np.array_equal(after(one, 5), after(other, 5))


def test_what_is_refused_changes_nothing():
    simulation = scene(STEPS["rk4"]).compile()
    after(simulation, 5)
    twin = taken_up(simulation, scene(STEPS["rk4"]))
    with pytest.raises(ts.SceneError, match="more than 0 is accepted"):
        simulation.parameters["bodies.bar.law.young"] = -1.0
    with pytest.raises(ts.SceneError, match="is stable up to"):
        simulation.parameters["bodies.bar.law.young"] = 1e9
    with pytest.raises(ts.ParameterError, match=r"did you mean 'bodies\.bar\.law\.young'"):
        simulation.parameters["bodies.bar.law.yong"] = 1.0
    with pytest.raises(ts.ParameterError, match="another value is accepted"):
        del simulation.parameters["gravity.z"]
    assert simulation.parameters["bodies.bar.law.young"] == 5000.0
    assert np.array_equal(after(simulation, 5), after(twin, 5))


def test_reset_begins_again_with_the_parameters_of_now():
    simulation = scene(editing=True, grabbing=True).compile()
    after(simulation, 5)
    simulation.remove_cells(body="bar", cells=[0, 1])
    simulation.drag("bar", (0.1, 0, 0))
    simulation.parameters["bodies.bar.law.young"] = 9e3
    after(simulation, 5)
    simulation.reset()
    assert (simulation.time, simulation.grabs) == (0.0, ())
    new = scene(editing=True, grabbing=True, law=ts.StVK(young=9e3, poisson=0.4)).compile()
    assert simulation.meshes["bar"].cell_count == new.meshes["bar"].cell_count
    assert np.array_equal(after(simulation, 8), after(new, 8))
    assert simulation.step().number == 9


def test_grabbing_that_is_allowed_later_changes_no_bit_until_a_point_is_grabbed():
    one, other = scene(editing=True).compile(), scene(editing=True).compile()
    after(one, 4), after(other, 4)
    for simulation in (one, other):
        simulation.remove_cells(body="bar", cells=[7])
    one.allow_grabbing()
    other._core.snapshot()  # its solver begins anew as well
    assert one.scene.grabbing
    assert np.array_equal(after(one, 4), after(other, 4))
    grab = one.drag("bar", (0.1, 0.01, 0.01), stiffness="5 N/m")
    grab.target = grab.position + np.array([0, 0, 0.05])
    assert after(one, 10)[:, 2].min() > after(other, 10)[:, 2].min() + 1e-2


def test_names_that_are_given_later_change_no_bit_and_leads_outlive_a_change():
    one, other = scene().compile(), scene().compile()
    after(one, 4), after(other, 4)
    one.allow_touch()
    other._core.snapshot()  # its solver begins anew as well
    assert one.scene.fixed[0].name == "fixed[0]" and one.scene.grabbing
    assert np.array_equal(after(one, 4), after(other, 4))
    one.lead("fixed[0]").move((0.01, 0, 0), over="100 ms")
    after(one, 3)
    named = scene(
        law=ts.StVK(young=9e3, poisson=0.4),
        fixed=[ts.Fixed("bar", on=ts.Plane((0, 0, 0), (1, 0, 0)), name="fixed[0]")],
        grabbing=True,
    )
    new = taken_up(one, named)
    one.parameters["bodies.bar.law.young"] = 9e3
    assert np.array_equal(after(one, 10), after(new, 10))
    assert np.allclose(one.lead("fixed[0]").positions[:, 0], 0.01, atol=1e-15)


def test_each_step_is_told_to_those_that_ask():
    simulation, told = scene().compile(), []
    end = simulation.on_step(told.append)
    simulation.on_step(lambda report: told.append(report.number))
    first = simulation.step()
    assert told == [first, 1]
    end()
    simulation.step()
    assert told == [first, 1, 2]
