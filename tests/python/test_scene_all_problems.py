"""Every problem of a scene is told, once, with its place, whatever else is wrong with the scene.

A sound scene gets slips of every stage: keys, fields, rules between fields, names, mesh files,
meshes, regions and selections. Each pair of slips, and triples of them, must give exactly their own
problems: none missing, none said twice, and no second problem that is only a consequence.
"""

import dataclasses
import itertools
import subprocess
import sys
from dataclasses import dataclass

import numpy as np
import pytest

from tissu import BarMesh, Body, Box, Fixed, ImplicitEuler, Scene, Static, StVK
from tissu.errors import SceneError
from tissu.mesh import bar_mesh, write_mesh

TEXT = """\
bodies:
  liver:
    mesh: {file: bar.vtu, unit: m}
    law: {type: stvk, young: 4 kPa, poisson: 0.4}
    density: 1000
    # here a second mass may stand
  bone:
    mesh: {file: parts.vtu}
    law: {left: {type: hooke, young: 1 MPa, poisson: 0.3}, right: {type: mooney_rivlin,
          c1: 1 kPa, c2: 0, kappa: 1 MPa}}
    mass: 2
gravity: [0, 0, -9.81]
fixed:
  - {body: liver, on: {type: box, max: [0, null, null]}}
  - {body: bone, on: {type: region, name: left}, axes: xy}
prescribed:
  - {body: bone, on: {type: nodes, ids: [0, 3]}, times: [0, 1], displacements: [[0, 0, 0],
     [0, 0, 1 mm]], axes: z}
loads:
  - {type: pressure, body: liver, on: {type: surface}, pressure: 1 kPa, times: [0, 1],
     factors: [0, 1]}
  - {type: nodal, body: bone, on: {type: sphere, center: [2, 0, 0], radius: 1 cm}, force: [1, 0, 0]}
step: {type: implicit_euler, dt: 10 ms}
duration: 1 s
"""


@dataclass(frozen=True)
class Slip:
    """One mistake: what is written instead of what, where it is told, and with which words."""

    old: str
    new: str
    line: int
    place: str
    words: str
    hides: tuple[str, ...] = ()


LIVER = ("empty box", "box upside down", "outside of the mesh")  # cannot be asked of a lost mesh
BONE = ("node beyond", "unknown region", "law's region", "sphere beside", "two motions")
SLIPS = {
    "poisson": Slip("poisson: 0.4", "poisson: 0.7", 4, "bodies.liver.law.poisson", "0.7"),
    "wrong unit": Slip("4 kPa", "4 kg", 4, "bodies.liver.law.young", "which is a mass"),
    "both masses": Slip(
        "# here a second mass may stand", "mass: 3", 2, "bodies.liver", "both of density"
    ),
    "no mass": Slip("    mass: 2", "    # none", 7, "bodies.bone", "neither of density and mass"),
    "key": Slip("density:", "densty:", 5, "bodies.liver.densty", "did you mean 'density'"),
    "c1 + c2": Slip("c2: 0", "c2: -2 kPa", 9, "bodies.bone.law.right", "c1 + c2 = -1000"),
    "law's region": Slip("{left: {", "{lft: {", 9, "bodies.bone.law.lft", "no region 'lft'"),
    "type": Slip("type: hooke", "type: hoke", 9, "bodies.bone.law.left", "did you mean 'hooke'"),
    "no file": Slip(
        "parts.vtu", "part.vtu", 8, "bodies.bone.mesh", "part.vtu does not exist", BONE
    ),
    "bad file": Slip("bar.vtu", "bad.vtu", 3, "bodies.liver.mesh", "bad.vtu", LIVER),
    "inside out": Slip("bar.vtu", "turned.vtu", 3, "bodies.liver.mesh", "inside out"),
    "unused": Slip("parts.vtu", "unused.vtu", 8, "bodies.bone.mesh", "used by no volume cell"),
    "mesh's unit": Slip(
        "unit: m}", "unit: kPa}", 3, "bodies.liver.mesh.unit", "is a pressure", LIVER
    ),
    "mesh's key": Slip(
        "{file: parts", "{fil: parts", 8, "bodies.bone.mesh.fil", "did you mean 'file'", BONE
    ),
    "gravity": Slip("-9.81]", "-9.81 N]", 12, "gravity", "component z"),
    "empty box": Slip("max: [0, n", "max: [-1, n", 14, "fixed[0].on", "selects no node"),
    "box upside down": Slip(
        "max: [0, n", "min: [1, 0, 0], max: [0, n", 14, "fixed[0].on", "exchange them"
    ),
    "unknown body": Slip(
        "- {body: liver", "- {body: livr", 14, "fixed[0].body", "did you mean 'liver'", LIVER
    ),
    "unknown region": Slip(
        "name: left}, axes: xy", "name: lft}, axes: xy", 15, "fixed[1].on", "did you mean 'left'"
    ),
    "axes": Slip("axes: xy}", "axes: xw}", 15, "fixed[1].axes", "letters x, y, z"),
    "node beyond": Slip("ids: [0, 3]", "ids: [0, 3, 99]", 17, "prescribed[0].on", "node 99"),
    "uneven times": Slip("times: [0, 1], d", "times: [0], d", 17, "prescribed[0]", "for 1 time;"),
    "two motions": Slip("axes: z}", "axes: zx}", 17, "prescribed[0]", "held on x by fixed[1] too"),
    "no factors": Slip(
        ", times: [0, 1],\n     factors: [0, 1]}",
        ", times: [0, 1]\n  }",
        20,
        "loads[0]",
        "without fac",
    ),
    "load's type": Slip("type: nodal", "type: noda", 22, "loads[1]", "did you mean 'nodal'"),
    "sphere beside": Slip("center: [2,", "center: [3,", 22, "loads[1].on", "selects no node"),
    "step": Slip("10 ms", "0 ms", 23, "step.dt", "more than 0"),
    "duration": Slip("duration: 1 s", "duration: soon", 24, "duration", "begin with a number"),
    "twice": Slip("duration: 1 s", "duration: 1 s\nduration: 1 s", 25, "duration", "written twice"),
}
# A slip that leaves unknown what another one would be found by.
HIDES = {
    "key": ("both masses",),
    "load's type": ("sphere beside",),
    "unknown region": ("two motions",),
    "node beyond": ("two motions",),
    "axes": ("two motions",),
    "mesh's key": ("no file", "unused"),
    "box upside down": ("empty box",),
    "law's region": ("type",),
}


def hidden(one, other):
    return other in SLIPS[one].hides or other in HIDES.get(one, ())


def fit(names):
    """Whether the slips can stand in one scene beside each other and are all to be found."""
    text = TEXT
    for name in names:
        if text.count(SLIPS[name].old) != 1 or TEXT.count(SLIPS[name].old) != 1:
            return False
        text = text.replace(SLIPS[name].old, SLIPS[name].new)
    return not any(hidden(*pair) for pair in itertools.permutations(names, 2))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The meshes of the scene, good and bad."""
    where = tmp_path_factory.mktemp("scenes")
    bar = bar_mesh(size=(2, 1, 1), cells=(2, 1, 1))
    write_mesh(bar, where / "bar.vtu")
    (where / "bad.vtu").write_text("nonsense")
    parts = {"left": np.arange(6), "right": np.arange(6, 12)}
    write_mesh(dataclasses.replace(bar, regions=parts), where / "parts.vtu")
    points = np.concatenate([bar.points, [[0.5, 0.5, 0.5]]])
    write_mesh(dataclasses.replace(bar, points=points, regions=parts), where / "unused.vtu")
    hexahedra = bar_mesh(size=(2, 1, 1), cells=(2, 1, 1), cell="hexahedron")
    nodes = hexahedra.cells[0].nodes.copy()
    nodes[1, [0, 1]] = nodes[1, [1, 0]]  # two corners exchanged: folded, not reversed
    block = dataclasses.replace(hexahedra.cells[0], nodes=nodes)
    write_mesh(dataclasses.replace(hexahedra, cells=(block,)), where / "turned.vtu")
    return where


def written(names):
    text = TEXT
    for name in names:
        text = text.replace(SLIPS[name].old, SLIPS[name].new)
    return text


def found(text, folder):
    with pytest.raises(SceneError) as caught:
        Scene.from_yaml_text(text, base=folder).compile()
    return caught.value.problems


def missing(names, problems):
    """The slips that are not told exactly once at their place."""
    lost = []
    for name in names:
        slip = SLIPS[name]
        start = f"text:{slip.line}: {slip.place}: "
        if sum(p.startswith(start) and slip.words in p for p in problems) != 1:
            lost.append(name)
    return lost


def test_the_scene_without_slips_is_sound(folder):
    assert Scene.from_yaml_text(TEXT, base=folder).check().problems == []


@pytest.mark.parametrize("name", SLIPS)
def test_one_slip_is_one_problem(name, folder):
    problems = found(written([name]), folder)
    assert len(problems) == 1, problems
    assert missing([name], problems) == []


@pytest.mark.parametrize("name", SLIPS)
def test_two_slips_are_two_problems(name, folder):
    """Each slip with every later one that can stand beside it."""
    later = list(SLIPS)[list(SLIPS).index(name) + 1 :]
    for other in later:
        if not fit([name, other]):
            continue
        problems = found(written([name, other]), folder)
        assert len(problems) == 2, problems
        assert missing([name, other], problems) == [], problems


def test_three_slips_are_three_problems(folder):
    """A hundred triples, spread evenly over all that are possible."""
    triples = [names for names in itertools.combinations(SLIPS, 3) if fit(names)]
    assert len(triples) > 2000
    for names in triples[:: len(triples) // 100]:
        problems = found(written(names), folder)
        assert len(problems) == 3, (names, problems)
        assert missing(names, problems) == [], (names, problems)


def test_all_that_fit_together(folder):
    names = []
    for name in SLIPS:
        if fit([*names, name]):
            names.append(name)
    problems = found(written(names), folder)
    assert len(names) > 15
    assert missing(names, problems) == []
    assert len(problems) == len(names)
    lines = [int(problem.split(":")[1]) for problem in problems]
    assert lines == sorted(lines)


TRIPLE = """\
bodies:
  bar:
    mesh: {type: bar, size: [1, 1, 1], cells: [1, 1, 1]}
    law: {type: stvk, young: 4 kPa, poisson: 0.7}
    density: 1000
    mass: 3
fixed:
  - {body: bar, on: {type: box, min: [5, 5, 5], max: [6, 6, 6]}}
step: {type: implicit_euler, dt: 10 ms}
"""


@pytest.mark.parametrize("command", ["check", "run"])
def test_commands_tell_all_of_them(command, tmp_path):
    """`run` needs a duration too, which this scene lacks."""
    (tmp_path / "bar.yaml").write_text(TRIPLE)
    words = [sys.executable, "-m", "tissu.cli", command, "bar.yaml"]
    ended = subprocess.run(words, capture_output=True, text=True, cwd=tmp_path, timeout=60)
    assert ended.returncode == 2
    told = [line for line in ended.stderr.splitlines() if line.startswith("- ")]
    assert len(told) == (4 if command == "run" else 3)
    assert "bar.yaml:2: bodies.bar: found both of density and mass" in ended.stderr
    assert "bar.yaml:4: bodies.bar.law.poisson: found 0.7" in ended.stderr
    assert "bar.yaml:8: fixed[0].on: the box" in ended.stderr
    assert ("duration: is missing" in ended.stderr) == (command == "run")


def test_a_scene_made_in_python_tells_all_that_is_known():
    bar = {"mesh": BarMesh(size=(1, 1, 1), cells=(1, 1, 1)), "density": 1e3}
    soft = StVK(young=1e3, poisson=0.3)
    with pytest.raises(SceneError) as caught:
        Scene(
            bodies={"a": {**bar, "law": soft, "mass": 1}, "b": Body(**bar, law=soft)},
            fixed=[Fixed("b", on=Box((5, 5, 5), None)), Fixed("c", on=Box())],
            step=ImplicitEuler(0.01),
            threads=0,
        )
    told = caught.value.problems
    assert len(told) == 4
    assert told[0] == "Scene: threads: found 0; at least 1 is accepted"
    assert told[1].startswith("Scene: fixed[1].body: no body is named 'c'")
    assert told[2].startswith("Scene: bodies.a: found both of density and mass")
    assert told[3].startswith("Scene: fixed[0].on: the box")


def test_a_static_body_is_free_only_if_its_supports_are_known():
    bar = Body(
        mesh=BarMesh(size=(1, 1, 1), cells=(1, 1, 1)), law=StVK(young=1, poisson=0), density=1e3
    )
    nowhere = Fixed("a", on=Box((5, 5, 5), None))
    check = Scene(bodies={"a": bar, "b": bar}, fixed=[nowhere], step=Static()).check()
    assert len(check.problems) == 2
    assert "fixed[0].on: the box" in check.problems[0]
    assert check.problems[1].startswith("bodies.b: body 'b' can move freely")


def test_parts_with_problems_never_leave_the_reading():
    """Validation by pydantic itself refuses, with all problems and their places."""
    from pydantic import ValidationError

    law = {"type": "stvk", "young": -1, "poisson": 0.7}
    with pytest.raises(ValidationError) as caught:
        Body.model_validate({"mesh": "a.vtu", "law": law, "density": 1, "mass": 1})
    places = {error["loc"] for error in caught.value.errors()}
    assert places == {("law", "young"), ("law", "poisson"), ()}
