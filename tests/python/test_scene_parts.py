"""Parts of a scene made in Python: positional forms, frozen, all problems at once, nearest keys."""

import numpy as np
import pytest

import tissu as ts
from tissu import (
    BarMesh,
    Body,
    Box,
    ConjugateGradient,
    Contact,
    Fibres,
    Fixed,
    Hooke,
    ImplicitEuler,
    MeshFile,
    MooneyRivlin,
    Newton,
    NodalLoad,
    Nodes,
    Plane,
    Prescribed,
    Pressure,
    Rayleigh,
    Region,
    Rotation,
    Scene,
    Sphere,
    Static,
    StVK,
    SurfaceNodes,
    Traction,
)
from tissu.errors import SceneError

BAR = BarMesh(size=(1, 1, 1), cells=(1, 1, 1))
SOFT = StVK(young=3e3, poisson=0.45)


def body(**changes):
    return Body(**{"mesh": BAR, "law": SOFT, "density": 1060.0, **changes})


def scene(**changes):
    return Scene(**{"bodies": {"liver": body()}, "step": ImplicitEuler(dt=0.01), **changes})


def problems(make):
    with pytest.raises(SceneError) as caught:
        make()
    return caught.value.problems


def test_positional_forms_of_the_design():
    fixed = Fixed("liver", on=Box((0, 0, 0), (0.1, 0.1, 0.01)))
    assert fixed.body == "liver"
    assert fixed.on == Box(min=(0, 0, 0), max=(0.1, 0.1, 0.01))
    assert Sphere((0, 0, 0), "1 cm").radius == 0.01
    assert Plane((0, 0, 0), (0, 0, 1)).tolerance is None
    assert Nodes(np.array([1, 2])).ids == (1, 2)
    assert Region("capsule").name == "capsule"
    assert MeshFile("a.vtu").file.name == "a.vtu"
    assert ImplicitEuler("10 ms").dt == 0.01
    with pytest.raises(TypeError, match="twice"):
        Region("a", name="a")
    with pytest.raises(TypeError, match="Region: found 2 values without a name; name may be"):
        Region("a", "b")
    with pytest.raises(TypeError, match=r"did you mean Contact\(\('liver', 'table'\)\)\?"):
        Contact("liver", "table")
    with pytest.raises(TypeError, match="Body: found 1 value without a name; all fields"):
        Body("liver")
    with pytest.raises(TypeError, match="body may be given so, and all other fields by"):
        Fixed("liver", Box(), "xy")


def test_scene_of_the_design():
    laws = {"parenchyma": StVK(young=3e3, poisson=0.45), "capsule": Hooke(young=2e4, poisson=0.4)}
    made = scene(
        bodies={"liver": body(law=laws)},
        fixed=[Fixed("liver", on=Box((0, 0, 0), (0.1, 0.1, 0.01)))],
        gravity=(0.0, 0.0, -9.81),
        step=ImplicitEuler(dt=0.01, solver=ConjugateGradient(tolerance=1e-6)),
    )
    assert made.gravity == (0.0, 0.0, -9.81)
    assert list(made.bodies["liver"].laws()) == ["parenchyma", "capsule"]


def test_parts_are_frozen():
    with pytest.raises(ValueError, match="frozen"):
        SOFT.young = 1.0


def test_replace_validates_again():
    made = scene()
    assert made.replace(threads=4).threads == 4
    assert problems(lambda: made.replace(threads=0)) == [
        "Scene: threads: found 0; at least 1 is accepted"
    ]


def test_all_problems_at_once():
    found = problems(
        lambda: Scene(
            bodies={
                "liver": {
                    "mesh": {"fil": "a.vtu"},
                    "law": {
                        "a": {"type": "hooke", "young": "4 mm", "poisson": 0.3},
                        "b": {"type": "x"},
                    },
                    "density": -1,
                }
            },
            fixed=[{"body": "livr", "on": {"type": "spere"}}],
            gravity=[0, 0, "-9 N"],
            step={"type": "implicit_euler", "dt": 0},
            durtion=2,
        )
    )
    text = "\n".join(found)
    assert len(found) == 9
    assert "bodies.liver.mesh.fil: unknown key; did you mean 'file'?" in text
    assert "bodies.liver.law.a.young: found '4 mm', which is a length" in text
    assert "bodies.liver.law.b: unknown type 'x'. Accepted types: hooke, stvk" in text
    assert "bodies.liver.density: found -1; more than 0 is accepted" in text
    assert "gravity: component z: found '-9 N', which is a force" in text
    assert "fixed[0].on: unknown type 'spere'; did you mean 'sphere'?" in text
    assert "fixed[0].body: no body is named 'livr'; did you mean 'liver'? Bodies: liver" in text
    assert "step.dt: found 0; more than 0 is accepted" in text
    assert "durtion: unknown key; did you mean 'duration'?" in text


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Hooke(young="-4 kPa", poisson=0.3), "young: found '-4 kPa'; more than 0"),
        (lambda: Hooke(young=1, poisson=0.5), "poisson: found 0.5; a number between -1 and 0.5"),
        (lambda: Hooke(young=1, poisson=-1), "both excluded"),
        (lambda: body(density=None), "found neither of density and mass"),
        (lambda: body(mass=1), "found both of density and mass"),
        (lambda: body(law={}), "`type` is missing; accepted types: hooke, stvk"),
        (lambda: body(law=3), "found 3; a mapping with a `type` is accepted"),
        (lambda: body(mesh=3), "accepted types: bar"),
        (lambda: body(viscosity=Rayleigh()), "leave viscosity out"),
        (lambda: MeshFile("a", unit="kPa"), "which is a pressure; a length is accepted"),
        (lambda: BarMesh(size=(1, 0, 1), cells=(1, 1, 1)), "three positive lengths"),
        (
            lambda: BarMesh(size=(1, 1, 1), cells=(1, 1, 1), cell="wedge", split="five"),
            "split five of cells of type wedge; only tetra and tetra10 are split",
        ),
        (lambda: Box([None, 1]), r"min: found \[null, 1\]; three components"),
        (lambda: Fixed("a", on=None), "on: found null; a mapping with a `type`"),
        (lambda: BarMesh(size=(1, 1, 1), cells=(1, 0, 1)), r"cells: found \(1, 0, 1\) .*; three"),
        (lambda: Box((1, 0, 0), (0, 1, 1)), "min 1 m above max 0 m on axis x"),
        (lambda: Plane((0, 0, 0), (0, 0, 0)), "a direction is accepted"),
        (lambda: Fixed("a", on=SurfaceNodes(), axes="xw"), "letters x, y, z"),
        (lambda: scene(bodies={}), "found no body, no tissue and no obstacle with a mass"),
        (lambda: scene(step=3), "accepted types: explicit_euler, .*implicit_euler, .*static"),
        (lambda: Static(newton=Newton(iterations=0)), "iterations: found 0; at least 1"),
        (lambda: ConjugateGradient(tolerance=2), "less than 1"),
    ],
)
def test_one_sentence_for_each_slip(make, message):
    import re

    assert re.search(message, "\n".join(problems(make)))


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"times": [0, 0], "displacements": [[0, 0, 0]] * 2}, "0 s after 0 s"),
        ({"times": [], "displacements": []}, "found no time"),
        ({"times": [0, 1]}, "neither displacements nor rotation"),
        ({"times": [0, 1], "displacements": [[0, 0, 0]]}, "1 displacement for 2 times"),
        (
            {"times": [0, 1], "rotation": Rotation(axis=(1, 0, 0), angles=[0])},
            "1 rotation angle for 2 times",
        ),
    ],
)
def test_prescribed_motion_is_complete(fields, message):
    assert message in problems(lambda: Prescribed("a", on=SurfaceNodes(), **fields))[0]


@pytest.mark.parametrize(
    "load",
    [
        lambda **f: NodalLoad("a", on=SurfaceNodes(), force=(0, 0, "1 N"), **f),
        lambda **f: Traction("a", on=SurfaceNodes(), traction=(0, 0, "1 kPa"), **f),
        lambda **f: Pressure("a", on=SurfaceNodes(), pressure="1 kPa", **f),
    ],
)
def test_load_series(load):
    assert load(times=["0 s", "1 ms"], factors=[0, 1]).times == (0.0, 0.001)
    assert "times without factors" in problems(lambda: load(times=[0]))[0]
    assert "factors without times" in problems(lambda: load(factors=[0]))[0]
    assert "1 factor for 2 times" in problems(lambda: load(times=[0, 1], factors=[0]))[0]


def test_a_field_that_is_missing_or_misspelt_is_one_problem():
    assert problems(lambda: MeshFile()) == ["MeshFile: file: is missing: path of the mesh file"]
    assert problems(lambda: MeshFile(fil="a.vtu")) == [
        "MeshFile: fil: unknown key; did you mean 'file'? Accepted: file, unit, scale, regions"
    ]
    near = problems(lambda: MeshFile(files="b.vtu", file="a.vtu"))
    assert near == [
        "MeshFile: files: unknown key; did you mean 'file'? Accepted: file, unit, scale, regions"
    ]


def test_laws_that_the_core_would_refuse():
    still = problems(lambda: Fibres(k1=1, k2=1, direction=(0, 0, 0)))
    assert "found the direction (0, 0, 0)" in still[0]
    soft = problems(lambda: MooneyRivlin(c1=1, c2=-1, kappa=1))
    assert "found c1 + c2 = 0; a sum above 0 (half the shear modulus) is accepted" in soft[0]


def test_unknown_body_in_python():
    found = problems(lambda: scene(fixed=[Fixed("livr", on=SurfaceNodes())]))
    assert found == [
        "Scene: fixed[0].body: no body is named 'livr'; did you mean 'liver'? Bodies: liver"
    ]


def test_a_word_that_is_not_on_the_list_gets_the_nearest():
    with pytest.raises(SceneError, match=r"found 'hexa'; accepted: .*; did you mean 'hexahedron'"):
        Scene.from_yaml_text(
            """
bodies:
  bar:
    mesh: {type: bar, size: [2, 1, 1], cells: [2, 1, 1], cell: hexa}
    law: {type: stvk, young: 1 kPa, poisson: 0.3}
    density: 1000
step: {type: static}
"""
        ).compile()


@pytest.mark.parametrize("value", [True, np.True_])
def test_true_and_false_are_no_whole_numbers(value):
    """Python counts them as 1 and 0."""
    words = f"found {value}; a whole number is accepted"
    with pytest.raises(ts.SceneError, match=f"iterations: {words}"):
        ts.ContactSettings(iterations=value)
    with pytest.raises(ts.SceneError, match=f"iterations: {words}"):
        ts.Newton(iterations=value)
    with pytest.raises(ts.SceneError, match=f"cells: {words}"):
        ts.BarMesh(size=(1, 1, 1), cells=(2, value, 2))
    with pytest.raises(ts.SceneError, match="seed: found False; a whole number is accepted"):
        ts.Start(seed=False)
    assert ts.ContactSettings(iterations=np.int64(3)).iterations == 3
    assert ts.ContactSettings(travel=bool(value)).travel is bool(value)


def test_a_mask_is_no_list_of_nodes():
    """It would select the nodes 0 and 1."""
    with pytest.raises(ts.SceneError, match="ids: found True; a whole number is accepted"):
        ts.Nodes(ids=np.array([False, True, True])[1:])
