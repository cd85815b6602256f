"""A compiled scene runs, and the same scene from YAML runs the same."""

import numpy as np
import pytest

from tissu import (
    BarMesh,
    Body,
    Box,
    Cholesky,
    Fixed,
    ImplicitEuler,
    Newton,
    NodalLoad,
    Prescribed,
    Rotation,
    Scene,
    Static,
    StVK,
    Traction,
)
from tissu.errors import ParameterError

BODY = Body(
    mesh=BarMesh(size=(0.4, 0.1, 0.1), cells=(4, 1, 1)),
    law=StVK(young=1e5, poisson=0.3),
    density=1e3,
)
LEFT, RIGHT = Box(None, (0, None, None)), Box((0.4, None, None), None)


def bar(**changes):
    fields = {
        "bodies": {"bar": BODY},
        "fixed": [Fixed("bar", on=LEFT)],
        "gravity": (0, 0, -9.81),
        "step": ImplicitEuler(0.01),
    }
    return Scene(**{**fields, **changes})


def test_a_bar_sags_and_its_fixed_end_stays():
    simulation = bar().compile()
    rest = simulation.positions["bar"].copy()
    for _ in range(10):
        assert simulation.step().converged
    moved = simulation.positions["bar"] - rest
    fixed = rest[:, 0] == 0
    assert (moved[fixed] == 0).all()
    assert (moved[rest[:, 0] > 0.3, 2] < -1e-3).all()


def test_yaml_runs_the_same_bits():
    one, two = bar().compile(), Scene.from_yaml_text(bar().to_yaml()).compile()
    for _ in range(3):
        one.step()
        two.step()
    assert (one.positions["bar"] == two.positions["bar"]).all()


def test_prescribed_quarter_turn():
    turn = Rotation(axis=(1, 0, 0), center=(0, 0.05, 0.05), angles=[0, "90 deg"])
    moved = Prescribed("bar", on=RIGHT, times=[0, 0.1], rotation=turn)
    simulation = bar(gravity=None, prescribed=[moved]).compile()
    rest = simulation.positions["bar"].copy()
    for _ in range(12):
        simulation.step()
    end = rest[:, 0] > 0.39
    y, z = rest[end, 1] - 0.05, rest[end, 2] - 0.05
    turned = np.stack([rest[end, 0], 0.05 - z, 0.05 + y], axis=1)
    np.testing.assert_allclose(simulation.positions["bar"][end], turned, atol=1e-12)


def test_static_bar_under_a_small_pull_follows_hooke():
    """Extension of a bar with nu = 0: F L / (E A)."""
    step = Static(newton=Newton(iterations=20, tolerance=1e-10), solver=Cholesky())
    body = BODY.replace(law=StVK(young=1e5, poisson=0.0), mesh=BODY.mesh.replace(cell="hexahedron"))
    pull = NodalLoad("bar", on=RIGHT, force=("1 mN", 0, 0))
    simulation = bar(bodies={"bar": body}, gravity=None, loads=[pull], step=step).compile()
    rest = simulation.positions["bar"].copy()
    assert simulation.step().converged
    extension = (simulation.positions["bar"] - rest)[rest[:, 0] > 0.39, 0]
    np.testing.assert_allclose(extension, 1e-3 * 0.4 / (1e5 * 0.01), rtol=1e-4)


def test_the_plan_names_what_runs_and_what_does_not():
    plan = str(bar().compile().plan())
    for word in ("elasticity of bar", "gravity", "fixed nodes of bar", "viscosity", "contact"):
        assert word in plan


@pytest.mark.parametrize("cell", ["tetra", "hexahedron"])
def test_uniform_traction_stretches_uniformly(cell):
    young, stretch = 1e5, 1.2
    pull = young / 2 * stretch * (stretch**2 - 1)  # P11 of StVK, Poisson's ratio 0
    body = Body(
        mesh=BarMesh(size=(0.4, 0.1, 0.1), cells=(4, 2, 2), cell=cell),
        law=StVK(young=young, poisson=0.0),
        density=1e3,
    )
    simulation = bar(
        bodies={"bar": body},
        gravity=None,
        loads=[Traction("bar", on=RIGHT, traction=(pull, 0, 0))],
        step=Static(newton=Newton(iterations=50, tolerance=1e-12), solver=Cholesky()),
    ).compile()
    rest = simulation.positions["bar"].copy()
    simulation.step()
    expected = rest * (stretch, 1, 1)
    assert np.abs(simulation.positions["bar"] - expected).max() < 1e-9


def test_repr_is_one_line_that_says_what_it_is():
    simulation = bar(name="beam").compile()
    for _ in simulation.run(0.03):
        pass
    assert repr(simulation) == (
        "Simulation('beam', t = 0.03 s after 3 steps; bar: 20 nodes, 24 cells; "
        "implicit_euler dt 0.01 s)"
    )
    still = repr(bar(step=Static()).compile())
    assert still.endswith("t = 0 s after 0 steps; bar: 20 nodes, 24 cells; static)")


@pytest.mark.parametrize("asked", ["displacements", "rotations", "reactions", "cell_fields"])
def test_a_body_that_is_not_there_is_named_with_those_that_are(asked):
    made = bar().compile()
    with pytest.raises(ParameterError, match="found body 'liver'; accepted: bar"):
        getattr(made, asked)("liver")
