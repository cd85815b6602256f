"""Input that no scene has: each a sentence, none a traceback, a wait or a silent wrong answer."""

import copy
import pickle

import numpy as np
import pytest

import tissu as ts

SCENE = """\
name: bar
bodies:
  bar:
    mesh: {type: bar, size: [0.2, 0.05, 0.05], cells: [2, 1, 1]}
    law: {type: stvk, young: 20 kPa, poisson: 0.4}
    density: 1000
fixed:
  - {body: bar, on: {type: box, min: [null, null, null], max: [1 mm, null, null]}}
step: {type: implicit_euler, dt: 10 ms}
duration: 20 ms
"""
BOX = "type: box, min: [null, null, null], max: [1 mm, null, null]"


def refusal(text):
    with pytest.raises(ts.SceneError) as refused:
        ts.Scene.from_yaml_text(text).compile()
    for problem in refused.value.problems:
        assert "\n" not in problem
        assert len(problem) < 1000
    return "\n".join(refused.value.problems)


def bomb(levels, width=10):
    """Lists of lists by aliases: width ** levels values in some hundred characters."""
    lines = ["a0: &a0 [x, x]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * width)}]" for n in range(1, levels + 1)]
    return "\n".join(lines)


def merges(levels, width=10):
    """The same by merged mappings."""
    lines = ["a0: &a0 {x: 1}"]
    lines += [
        f"a{n}: &a{n} {{<<: [{', '.join([f'*a{n - 1}'] * width)}]}}" for n in range(1, levels + 1)
    ]
    return "\n".join(lines)


DOCUMENTS = {
    "alias bomb": (bomb(30), "aliases that repeat more than 100000 values"),
    "merge bomb": (merges(30), "aliases that repeat more than 100000 values"),
    "bomb as key": (bomb(30) + "\n? *a30\n: 1", "aliases that repeat|a list or a mapping as a key"),
    "itself": ("a: &a [*a]", "an alias that contains itself"),
    "deep list": ("[" * 5000 + "]" * 5000, "more than 40 levels of nesting"),
    "deep mapping": ("{a: " * 5000 + "}" * 5000, "more than 40 levels of nesting"),
    "deep block": ("\n".join(" " * n + "a:" for n in range(500)), "more than 40 levels"),
    "list as key": ("? [a, b]\n: 1", "a list or a mapping as a key"),
    "NUL": ("name: a\0b", r":1: not valid YAML: found the character U\+0000"),
    "NUL below": ("a: 1\nname: a\0b", r":2: not valid YAML: found the character U\+0000"),
    "escaped NUL": ('name: "a\\0b"', r"found the character U\+0000 in a text"),
    "half a character": ('name: "\\ud800"', r"found the character U\+D800 in a text"),
    "escape": ('name: "\\e[2J"', r"found the character U\+001B in a text"),
    "odd date": ("name: !!timestamp 2001-99-99", "could not determine a constructor"),
    "date": ("name: !!timestamp later", "could not determine a constructor"),
    "program": ("name: !!python/object/apply:os.system [ls]", "could not determine a constr"),
    "binary": ("name: !!binary '!!'", "could not determine a constructor"),
    "no number": ("threads: !!int ''", "found '', which is not of the type int"),
    "no float": ("threads: !!float x", "found 'x', which is not of the type float"),
    "no bool": ("editing: !!bool maybe", "found 'maybe', which is not of the type bool"),
    "digits": ("threads: " + "9" * 5000, "found a number of 5000 digits"),
    "long key": ("? " + "x" * 5000 + "\n: 1", "found a key of 5000 characters"),
    "long text": ("name: " + "x" * 5000, "found a text of 5000 characters"),
    "long document": ("#" * (16 * 2**20 + 1), "at most 16777216 are accepted"),
    "empty": ("", "found nothing"),
    "two documents": ("a: 1\n---\nb: 1", "expected a single document"),
    "tag": ("!x {a: 1}", "could not determine a constructor"),
}


@pytest.mark.parametrize("case", DOCUMENTS)
def test_a_document_that_is_no_scene(case):
    text, said = DOCUMENTS[case]
    with pytest.raises(ts.SceneError, match=said) as refused:
        ts.Scene.from_yaml_text(text)
    (problem,) = refused.value.problems
    assert "\n" not in problem


def test_numbers_are_those_of_yaml_1_2():
    scene = ts.Scene.from_yaml_text(SCENE.replace("[2, 1, 1]", "[010, 1, 1]"))
    assert scene.bodies["bar"].mesh.cells == (10, 1, 1)


FIELDS = {
    "cells": ("[2, 1, 1]", "[99999999999999999999, 1, 1]", "found 99999999999999999999; whole"),
    "too many cells": ("[2, 1, 1]", "[1000000, 1000000, 1000000]", "take fewer cells"),
    "bar too big": ("[2, 1, 1]", "[2000000000, 1, 1]", "take fewer cells"),
    "threads": ("duration: 20 ms", "threads: 99999999999999999999", "at most 1024"),
    "iterations": ("10 ms}", f"10 ms, newton: {{iterations: {10**20}}}}}", "whole numbers up to"),
    "nodes": (BOX, f"type: nodes, ids: [{10**20}]", "found 1" + "0" * 20 + "; whole numbers"),
    "steps": ("dt: 10 ms", "dt: 1e-12", r"which is 2e\+10 steps; at most 1e\+09 are accepted"),
    "step of nothing": ("dt: 10 ms", "dt: 5e-324", "which is inf steps"),
    "long run": ("20 ms", "1e300 s", r"which is 1e\+302 steps"),
    "long name": ("name: bar", "name: " + "x" * 300, "found a name of 300 characters"),
    "long body": ("  bar:", "  ? " + "y" * 201 + "\n  :", "found a key of 201 characters"),
    "big number": ("20 kPa", "9" * 399, "young: found .* which is not finite|is not positive"),
    "unit": ("20 kPa", "1 10**10**10 Pa", "whose unit .* is not known"),
    "mesh": ("{type: bar, size: [0.2, 0.05, 0.05], cells: [2, 1, 1]}", "/dev/zero", "device"),
}


@pytest.mark.parametrize("case", FIELDS)
def test_a_field_that_no_scene_has(case):
    import re

    good, bad, said = FIELDS[case]
    assert good in SCENE
    assert re.search(said, refusal(SCENE.replace(good, bad)))


def test_names_made_in_python_are_refused_too():
    scene = ts.Scene.from_yaml_text(SCENE)
    for name, said in {"a\0b": "U\\+0000", "x" * 300: "300 characters"}.items():
        with pytest.raises(ts.SceneError, match=said):
            scene.replace(name=name)
        with pytest.raises(ts.SceneError, match=said):
            scene.replace(bodies={name: scene.bodies["bar"]}, fixed=[])


def test_parts_are_copied_and_simulations_are_not():
    scene = ts.Scene.from_yaml_text(SCENE)
    for made in (scene, scene.bodies["bar"], scene.step):
        assert copy.copy(made) == copy.deepcopy(made) == pickle.loads(pickle.dumps(made)) == made
    simulation = scene.compile()
    for attempt in (copy.copy, copy.deepcopy, pickle.dumps):
        with pytest.raises(
            ts.TissuError, match="a simulation cannot be copied or pickled; compile"
        ):
            attempt(simulation)


POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
MASKED = np.ma.masked_array([0, 1, 2, 3], mask=[0, 0, 0, 1])


@pytest.mark.parametrize(
    ("points", "cells", "regions", "said"),
    [
        (POINTS + 1j, [[0, 1, 2, 3]], {}, "found complex points"),
        (
            np.ma.masked_array(POINTS, mask=POINTS > 0.5),
            [[0, 1, 2, 3]],
            {},
            "masked points, 3 of 12",
        ),
        ([["a"] * 3] * 4, [[0, 1, 2, 3]], {}, "found points of type <U1"),
        ([[0, 0], [1, 2, 3]], [[0, 1, 2, 3]], {}, "rows of different lengths"),
        (POINTS, np.array([[0, 1, 2, 3 + 0j]]), {}, "found complex node numbers"),
        (POINTS, MASKED[None], {}, "masked node numbers, 1 of 4"),
        (POINTS, [[0, 1, 2, 3]], {"a": MASKED[3:]}, "masked cells of region 'a'"),
        (POINTS, [[0, 1, 2, 3]], {"a": [0j]}, "complex cells of region 'a'"),
    ],
)
def test_meshes_of_odd_arrays(points, cells, regions, said):
    with pytest.raises(ts.MeshError, match=said):
        ts.Mesh(points=points, cells=[("tetra", cells)], regions=regions)


def test_odd_arrays_elsewhere():
    with pytest.raises(ts.SceneError, match="masked values, 1 of 4"):
        ts.Nodes(MASKED)
    with pytest.raises(ts.SceneError, match="masked values"):  # masked meant open, without a word
        ts.Box(np.ma.masked_array([0.0, 0, 0], mask=[0, 1, 0]), (1, 1, 1))
    simulation = ts.Scene.from_yaml_text(SCENE + "editing: true\n").compile()
    for cells, said in (
        (MASKED, "masked"),
        ([1j], "complex"),
        ([[0, 1], [2]], "different lengths"),
    ):
        with pytest.raises(ts.ParameterError, match=said):
            simulation.remove_cells(body="bar", cells=cells)
    assert simulation.meshes["bar"].cell_count == 12


def test_runs_and_bars_that_do_not_end():
    simulation = ts.Scene.from_yaml_text(SCENE).compile()
    with pytest.raises(ts.ParameterError, match=r"more than 1e\+09 steps"):
        next(simulation.run("1e300 s"))
    for cells, cell in (((10**6, 10**6, 0), "quad"), ((10**12, 0, 0), "line")):
        size = [float(n > 0) for n in cells]
        with pytest.raises(ts.ParameterError, match="take fewer cells"):
            ts.bar_mesh(size=size, cells=cells, cell=cell)


@pytest.mark.parametrize("name", ["a\0b", "a" * 5000, "\ud800.vtu", "/dev/null"])
def test_meshes_of_odd_names(name):
    with pytest.raises(ts.MeshError) as refused:
        ts.read_mesh(name)
    str(refused.value).encode("utf-8")
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 1000
