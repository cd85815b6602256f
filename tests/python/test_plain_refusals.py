"""What Python code gives by mistake is refused in one sentence that says what is accepted."""

import re

import pytest

import tissu as ts
from tissu.errors import LawError, MeshError, ParameterError

BAR = {"size": (0.2, 0.1, 0.1), "cells": (2, 1, 1)}
PAIRS = "a list of pairs (cell type, label) is accepted, such as [('hex8', 'a')]"
SCENE = ts.Scene(
    name="block",
    bodies={
        "block": ts.Body(
            mesh=ts.BarMesh(**BAR),
            law=ts.StVK(young=1000, poisson=0.3),
            density=1000,
        )
    },
    step=ts.ImplicitEuler(dt=0.01),
    duration=0.01,
)


def segments(value):
    return lambda: ts.mixed_bar_mesh(**BAR, segments=value)


def law(name):
    return lambda: ts.law(name, energy=0, parameters={"mu": "Pa"})


@pytest.mark.parametrize(
    ("call", "kind", "words"),
    [
        (law(None), LawError, "found None as the name of a law; a text is accepted"),
        (law(3), LawError, "found 3 as the name of a law; a text is accepted, such as 'gent'."),
        (segments("hex8:a, tet4:b"), ParameterError, f"segments 'hex8:a, tet4:b'; {PAIRS}"),
        (segments(["hex8"]), ParameterError, f"found the segment 'hex8'; {PAIRS}"),
        (segments([("hex8", 3)]), ParameterError, f"found the segment ('hex8', 3); {PAIRS}"),
        (segments(3), ParameterError, f"found the segments 3; {PAIRS}"),
        (lambda: ts.read_mesh(3), MeshError, "found 3; the path of a mesh file is accepted"),
        (lambda: ts.read_law(3), LawError, "found 3; the path of a Python file with the formula"),
        (lambda: ts.refined(3), MeshError, "found 3; a Mesh is accepted"),
        (lambda: ts.compare(3), ParameterError, "compare: found 3; a Scene is accepted"),
        (lambda: ts.advise(3), ParameterError, "advise: found 3; a Scene is accepted"),
        (lambda: ts.compare("a.yaml"), ParameterError, "compare: found 'a.yaml'; a Scene is"),
        (
            lambda: ts.compare(SCENE, models="fem"),
            ParameterError,
            "found the models 'fem'; a list is accepted, such as ['fem']",
        ),
        (lambda: ts.compare(SCENE, models=3), ParameterError, "found the models 3; a list is"),
        (
            lambda: ts.compare(SCENE, models=["fem", "FEM", "fem"]),
            ParameterError,
            "unknown model 'FEM'",
        ),
        (
            lambda: ts.compare(SCENE, models=["fem", "fem"]),
            ParameterError,
            "found the model fem twice; each is accepted once",
        ),
        (
            lambda: ts.advise(SCENE, models="fem"),
            ParameterError,
            "found the models 'fem'; a list of names is accepted, such as ['fem']",
        ),
    ],
)
def test_one_sentence(call, kind, words):
    with pytest.raises(kind, match=re.escape(words)):
        call()
