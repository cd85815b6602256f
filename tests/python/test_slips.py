"""Slips of a newcomer: a sentence names the cure of each, without the phrases of pydantic."""

import numpy as np
import pytest

import tissu as ts

LIVER = """bodies:
  liver:
    mesh: {type: bar, size: [6 cm, 4 cm, 4 cm], cells: [3, 2, 2], cell: CELL}
    law: LAW
    model: MODEL
    density: 1 g/cm^3
"""
FIXED = "fixed:\n  - {body: liver, on: {type: plane, point: [0, 0, 0], normal: [1, 0, 0]}}\n"
STEP = "step: {type: implicit_euler, dt: 10 ms}\n"
SOFT = "{type: stable_neo_hooke, young: 20 kPa, poisson: 0.4}"
HOOKE = "{type: hooke, young: 20 kPa, poisson: 0.25}"
PROBE = """obstacles:
  probe: {type: capsule, ends: [[3 cm, 2 cm, 5 cm], [3 cm, 2 cm, 15 cm]], radius: 5 mm}
contacts:
  - {between: [liver, probe]}
trocars:
  right:
    port: {at: [3 cm, 2 cm, 12 cm], axis: [0, 0, -1]}
    device: {type: simulated, hand: HAND}
    tools: {0x51A0: probe}
"""
HAND = "{times: [0], points: [[0, 0, 5 cm]]}"


def scene(
    *more: str, cell: str = "hexahedron", law: str = SOFT, model: str = "fem", step: str = STEP
) -> str:
    """A block as YAML, held at one end unless `more` says how."""
    body = LIVER.replace("CELL", cell).replace("LAW", law).replace("MODEL", model)
    held = "" if any(text.startswith("fixed") for text in more) else FIXED
    return body + held + step + "".join(more)


def found(text: str) -> list[str]:
    """What is said of a scene, by reading it or by `check`."""
    try:
        return ts.Scene.from_yaml_text(text).check().problems
    except ts.SceneError as error:
        return error.problems


def newton(text: str) -> str:
    return f"step: {{type: implicit_euler, dt: 10 ms, newton: {text}}}\n"


LIST = "a list is accepted: write a dash before its keys"
SLIPS = {
    "one contact": (scene("contacts: {between: all}\n"), "contacts", LIST),
    "one support": (scene("fixed: {body: liver, on: {type: surface}}\n"), "fixed", LIST),
    "one tear": (
        scene("editing: true\ntear: {body: liver, strength: 3 kPa, length: 3 cm}\n"),
        "tear",
        LIST,
    ),
    "a name for a list": (
        scene("output: {every: 10 ms, fields: von_mises}\n"),
        "output.fields",
        "a list is accepted, such as ['von_mises']",
    ),
    "a whole number": (scene("threads: 1.5\n"), "threads", "a whole number is accepted"),
    "a word for a number": (scene("threads: two\n"), "threads", "a whole number is accepted"),
    "a flag": (scene("grabbing: 7\n"), "grabbing", "true or false is accepted"),
    "a text": (scene("name: [1]\n"), "name", "a text is accepted"),
    "two entries": (
        scene().replace("[3, 2, 2]", "[3, 2]"),
        "bodies.liver.mesh.cells[2]",
        "too few entries",
    ),
    "a file": (
        scene().replace("{type: bar,", "{file: 3,").split("size")[0].rstrip(" ,")
        + "}\n"
        + scene().split("\n", 3)[3],
        "bodies.liver.mesh.file",
        "the path of a file is accepted",
    ),
    "a tetrahedron": (scene(cell="tetrahedron"), "mesh.cell", "did you mean 'tetra'?"),
    "a cell of Abaqus": (scene(cell="C3D20"), "mesh.cell", "did you mean 'hexahedron20'?"),
    "a prism": (scene(cell="prism"), "mesh.cell", "did you mean 'wedge'?"),
    "a tolerance that is not tested": (
        scene(step=newton("{iterations: 1, tolerance: 1e-8}")),
        "step.newton.tolerance",
        "no tolerance is tested",
    ),
    "a hand without its file": (
        scene(PROBE.replace("HAND", "{path: nope.csv}")),
        "trocars.right.device.hand.path",
        "no such file is there",
    ),
    "a table of a soft law": (
        scene(PROBE.replace("HAND", HAND) + "    compliance: condensed\n"),
        "trocars.right.compliance",
        "take factor or warped",
    ),
    "a table of turning cells": (
        scene(
            PROBE.replace("HAND", HAND) + "    compliance: condensed\n",
            law=HOOKE,
            model="corotational",
        ),
        "trocars.right.compliance",
        "model corotational",
    ),
    "a tear of springs": (
        scene(
            "editing: true\ntear: [{body: liver, strength: 1 kPa, length: 3 cm}]\n",
            cell="tetra",
            law=HOOKE,
            model="mass_spring",
        ),
        "tear[0].body",
        "no stress to tear at",
    ),
}


@pytest.mark.parametrize("slip", SLIPS)
def test_a_slip_is_answered_by_its_cure(slip: str) -> None:
    text, place, cure = SLIPS[slip]
    said = found(text)
    assert any(place in one and cure in one for one in said), said
    raw = ("Input should", "Field required", "valid tuple", "valid integer", "valid boolean")
    assert not [one for one in said if any(phrase in one for phrase in raw)]


def test_what_the_slips_change_is_accepted_without_them() -> None:
    for text in (
        scene(step=newton("{iterations: 1}")),
        scene(step=newton("{iterations: 2, tolerance: 1e-8}")),
        scene(PROBE.replace("HAND", HAND), law=HOOKE) + "    compliance: condensed\n",
        scene("contacts: [{between: all}]\n", "threads: 2\n"),
    ):
        assert found(text) == []


def test_on_is_read_where_yaml_1_1_made_it_true() -> None:
    """PyYAML reads `on:` as true; a scene made of its data is the same."""
    import yaml

    old = yaml.safe_load(scene())
    assert True in old["fixed"][0]
    read = ts.Scene(**old)
    assert read == ts.Scene.from_yaml_text(scene())
    written = scene().replace(" on:", " true:")
    assert ts.Scene.from_yaml_text(written).fixed == read.fixed


@pytest.mark.parametrize(
    ("text", "note"),
    [
        (scene("gravity: [0, 0, -9810]\n"), "gravity: 9810 m/s^2 is more than ten times"),
        (
            scene(step="step: {type: implicit_euler, dt: 10}\n"),
            "step.dt: 10 s is longer than motions of tissue last",
        ),
        (scene("contact: {iterations: 30}\n"), "contact: without `contacts` nothing meets"),
    ],
)
def test_doubtful_numbers_are_noted_and_accepted(text: str, note: str) -> None:
    check = ts.Scene.from_yaml_text(text).check()
    assert check.ok
    assert any(note in one for one in check.notes)
    usual = ts.Scene.from_yaml_text(scene("gravity: [0, 0, -9.81]\n")).check()
    assert not any(note.split(":")[0] == one.split(":")[0] for one in usual.notes)


@pytest.mark.parametrize("name", ["bar.pdf", "bar"])
def test_a_picture_is_a_png(name: str, tmp_path) -> None:
    simulation = ts.Scene.from_yaml_text(scene()).compile()
    with pytest.raises(ts.ParameterError, match=r"\.png is accepted, such as .*bar\.png"):
        ts.draw(simulation, tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_the_plan_counts_no_room_for_cuts() -> None:
    plain = ts.Scene.from_yaml_text(scene()).compile()
    simulation = ts.Scene.from_yaml_text(scene("editing: true\n")).compile()
    nodes = simulation.meshes["liver"].node_count
    assert plain.plan().unknowns == simulation.plan().unknowns == 3 * nodes
    simulation.cut("liver", ts.Plane((0.031, 0, 0), (1, 0, 0)))
    made = len(simulation.positions["liver"]) - nodes
    assert made > 0
    assert simulation.plan().unknowns == 3 * (nodes + made)


def test_a_blade_that_is_not_finite_is_shown() -> None:
    simulation = ts.Scene.from_yaml_text(scene("editing: true\n")).compile()
    with pytest.raises(ts.ParameterError, match=r"nan.*finite"):
        simulation.cut("liver", ts.Disc((np.nan, 0, 0), (1, 0, 0), radius=0.01))


def test_equal_masses_are_named_as_scenes_write_them() -> None:
    text = scene(
        "editing: true\n", cell="tetra", law=HOOKE, model="{type: mass_spring, masses: equal}"
    )
    simulation = ts.Scene.from_yaml_text(text).compile()
    with pytest.raises(ts.ParameterError, match="take masses: volume"):
        simulation.cut("liver", ts.Plane((0.031, 0, 0), (1, 0, 0)))
