"""check(): in plain words what a scene switches on and why, and what is absent."""

import pytest

import tissu as ts
from tissu import (
    ArrudaBoyce,
    BarMesh,
    Body,
    Box,
    Corotational,
    Fibres,
    Fixed,
    Frames,
    Hooke,
    ImplicitEuler,
    NodalLoad,
    Output,
    Rayleigh,
    Scene,
    Static,
    StVK,
)
from tissu.effects import absent_of, effects_of

BODY = Body(
    mesh=BarMesh(size=(2, 1, 1), cells=(2, 1, 1)), law=StVK(young=3e3, poisson=0.45), density=1e3
)
END = Box(None, (0, None, None))


def test_a_bare_scene():
    made = Scene(bodies={"bar": BODY}, step=ImplicitEuler(0.01))
    names = [effect.name for effect in effects_of(made)]
    assert names == ["elasticity of bar", "inertia", "linear solver"]
    absent = absent_of(made)
    assert {"viscosity", "gravity", "loads", "contact", "cutting", "haptics"} <= set(absent)
    assert "inertia" not in absent


def test_each_effect_says_which_field_asks_for_it():
    made = Scene(
        bodies={"bar": BODY.replace(viscosity=Rayleigh(mass=0.1))},
        gravity=(0, 0, -9.81),
        fixed=[Fixed("bar", on=END)],
        loads=[NodalLoad("bar", on=END, force=(0, 0, 1))],
        step=ImplicitEuler(0.01),
        editing=True,
    )
    check = made.check()
    assert check.ok
    assert [str(effect) for effect in check.effects] == [
        "elasticity of bar: bodies.bar.law is stvk with young 3000 Pa, poisson 0.45",
        "viscosity of bar: bodies.bar.viscosity is rayleigh, mass 0.1 1/s, stiffness 0 s",
        "gravity: gravity is (0, 0, -9.81) m/s^2",
        "fixed nodes of bar: fixed[0] holds 4 nodes (box) on xyz",
        "nodal load on bar: loads[0] acts on 4 nodes (box)",
        "inertia: step is implicit_euler with dt 0.01 s",
        "linear solver: step.solver is auto: it begins with what the first matrix makes cheapest "
        "for many solves, and changes where counted work says so",
        "cutting: editing leaves room for 25% of a body's nodes and 256 more",
    ]
    assert check.absent == [
        *("sheets", "lines", "frames", "connective tissue", "prescribed motion"),
        *("live leads", "grabs", "contact", "instruments", "tears", "haptics"),
    ]
    assert "Switched on:\n  - elasticity of bar" in str(check)
    assert "Problems" not in str(check)


def test_a_law_is_said_with_the_units_that_its_formula_declares():
    fibres = Fibres(k1="2 kPa", k2=0.8, direction=(1, 0, 0))
    law = ArrudaBoyce(mu="1 kPa", lambda_m=1.6, kappa=5e4, fibres=fibres)
    (effect,) = (e for e in BODY.replace(law=law).effects("bar") if "elasticity" in e.name)
    words = "arruda_boyce with mu 1000 Pa, lambda_m 1.6, kappa 50000 Pa, fibres k1 2000 Pa, k2 0.8"
    assert effect.why == f"bodies.bar.law is {words}"


@pytest.mark.parametrize(
    ("law", "model", "small"),
    [
        (Hooke(young=3e3, poisson=0.45), Frames(), True),
        (Hooke(young=3e3, poisson=0.45), Corotational(), False),
        (StVK(young=3e3, poisson=0.45), Frames(), False),
    ],
)
def test_a_law_that_strains_frames_as_they_turn_is_said(law, model, small):
    (effect,) = (e for e in BODY.replace(law=law, model=model).effects("b") if "elast" in e.name)
    assert effect.why.endswith(", for small turns only") == small


def test_problems_come_first():
    made = Scene(bodies={"bar": BODY}, step=Static())
    assert str(made.check()).startswith("Problems:\n  - bodies.bar: body 'bar' can move freely")
    assert "inertia" in made.check().absent


def test_results_asked_for_between_steps_are_noted():
    made = Scene(bodies={"bar": BODY}, step=ImplicitEuler(0.01), output=Output(every="1 ms"))
    text = "output.every: 0.001 s is shorter than the step of 0.01 s: each step is written"
    assert text in made.check().notes
    assert text not in made.replace(output=Output(every="10 ms")).check().notes


@pytest.mark.parametrize(
    ("field", "part"),
    [("contacts", ts.Contact(("a", "b"))), ("fixed", ts.Fixed("a", on=ts.Box()))],
)
def test_one_part_where_a_list_is_wanted_is_one_sentence(field, part):
    with pytest.raises(ts.SceneError) as refused:
        ts.Scene(bodies={}, step=ts.ImplicitEuler("1 ms"), **{field: part}).compile()
    name = type(part).__name__
    (found,) = [line for line in str(refused.value).splitlines() if f"{field}" in line]
    assert found.endswith(f"{field}: found one {name}; a list is accepted: [{name}(...)]")
