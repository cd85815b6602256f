"""Scenes with something wrong in them: values, keys, structure, bytes."""

from __future__ import annotations

import copy
import json
import math
import random
import re
from pathlib import Path

import yaml

import tissu as ts

BOX = {"type": "box", "min": [None, None, None], "max": ["1 mm", None, None]}
END = {"type": "box", "min": ["0.19 m", None, None], "max": [None, None, None]}
BASE = {
    "name": "bar",
    "bodies": {
        "bar": {
            "mesh": {"type": "bar", "size": [0.2, "5 cm", 0.05], "cells": [3, 1, 1]},
            "law": {"type": "stvk", "young": "20 kPa", "poisson": 0.4},
            "density": 1000,
            "viscosity": {"type": "rayleigh", "mass": 0.1, "stiffness": "1 ms"},
        }
    },
    "gravity": [0, 0, -9.81],
    "fixed": [{"body": "bar", "on": BOX}],
    "loads": [
        {"type": "nodal", "body": "bar", "on": END, "force": [0, 0, "-1 mN"]},
        {"type": "pressure", "body": "bar", "on": END, "pressure": "1 Pa"},
    ],
    "prescribed": [
        {
            "body": "bar",
            "on": {"type": "nodes", "ids": [15]},
            "times": [0, 1],
            "displacements": [[0, 0, 0], [0, 0, "1 mm"]],
        }
    ],
    "step": {
        "type": "implicit_euler",
        "dt": "10 ms",
        "newton": {"iterations": 3, "tolerance": 1e-6},
        "solver": {"type": "conjugate_gradient", "tolerance": 1e-6, "iterations": 50},
    },
    "duration": "20 ms",
    "threads": 1,
    "output": {"every": "10 ms"},
}
LAWS = [
    {"type": "hooke", "young": 1e4, "poisson": 0.3},
    {"type": "neo_hooke", "young": 1e4, "poisson": 0.3},
    {"type": "stable_neo_hooke", "young": 1e4, "poisson": 0.3},
    {"type": "mooney_rivlin", "c1": 1e3, "c2": 1e2, "kappa": 1e5},
    {"type": "yeoh", "c1": 1e3, "kappa": 1e5},
]
STEPS = [
    {"type": "static"},
    {"type": "bdf2", "dt": 0.01},
    {"type": "newmark", "dt": 0.01},
    {"type": "rk4", "dt": "auto"},
    {"type": "symplectic_euler", "dt": 1e-4},
]
CELLS = ["tetra", "tetra10", "hexahedron", "hexahedron20", "wedge", "pyramid"]
ODD = [
    *(None, True, "", " ", "x", "x" * 500, "µ", "\u202e", "a/b", "..", "/dev/null", "a\tb"),
    *(0, -1, 1, 3, 10**20, -(10**30), 0.5, -0.0, 1e-320, 1e-160, 1e160, 1e308, math.nan, math.inf),
    *("1 kPa", "-1 mm", "1 10**10**10 s", "1 furlong", "1e400 m", "nan", "1 m^99", "5 %", "auto"),
    *([], {}, [1, 2], [1, 2, 3], [None] * 3, [[0, 0, 0]], {"type": "x"}, {"a": {"b": []}}),
    *("static", "surface", "tetra", "fem", "condensed", "frames", "cholesky", "multigrid"),
]


NUMBER = re.compile(r"(-?\d+(?:\.\d+)?(?:e-?\d+)?)( .*)?$")


def places(data: object, path: tuple[object, ...] = ()) -> list[tuple[object, ...]]:
    """The paths of all values."""
    found = [path] if path else []
    items = (
        data.items()
        if isinstance(data, dict)
        else enumerate(data)
        if isinstance(data, list)
        else ()
    )
    for key, value in items:
        found += places(value, (*path, key))
    return found


def mutated(dice: random.Random) -> str:
    """The text of a scene with one to three things changed."""
    data = copy.deepcopy(BASE)
    body = data["bodies"]["bar"]
    if dice.random() < 0.5:
        body["law"] = dict(dice.choice(LAWS))
    if dice.random() < 0.5:
        data["step"] = dict(dice.choice(STEPS))
    if dice.random() < 0.5:
        body["mesh"]["cell"] = dice.choice(CELLS)
    for _ in range(dice.choice((1, 1, 1, 2, 3))):
        change(data, dice)
    if dice.random() < 0.5:
        text = yaml.safe_dump(data, allow_unicode=True, sort_keys=False)
    else:
        text = json.dumps(data)
    return scrambled(text, dice) if dice.random() < 0.15 else text


def change(data: object, dice: random.Random) -> None:
    """Replaces, removes, renames, doubles or moves one value."""
    all_places = places(data)
    *way, last = dice.choice(all_places)
    holder = data
    for key in way:
        holder = holder[key]
    kind = dice.random()
    number = NUMBER.match(str(holder[last])) if isinstance(holder[last], float | str) else None
    if number and dice.random() < 0.7:
        value = float(number[1]) * dice.choice((-1, 0, 1e-30, 1e-9, 0.01, 0.5, 2, 100, 1e9, 1e30))
        holder[last] = f"{value:.3g}{number[2] or ''}" if isinstance(holder[last], str) else value
    elif kind < 0.6:
        holder[last] = copy.deepcopy(dice.choice(ODD))
    elif kind < 0.75:
        del holder[last]
    elif kind < 0.85 and isinstance(holder, dict):
        holder[f"{last}"[:-1] + dice.choice("sxe")] = holder.pop(last)
    elif kind < 0.93:
        other = data
        for key in dice.choice(all_places):
            try:
                other = other[key]
            except (KeyError, IndexError, TypeError):
                break
        holder[last] = copy.deepcopy(other)
    else:
        holder[last] = [holder[last]]


def scrambled(text: str, dice: random.Random) -> str:
    """The text with some characters changed, cut out or put in."""
    letters = list(text)
    for _ in range(dice.randint(1, 6)):
        place = dice.randrange(len(letters))
        odd = dice.choice("{}[]:,&*!|>%@`\"'#-?\0\x07\ud800\n\t é0") * dice.choice((1, 1, 3, 60))
        letters[place : place + dice.randint(0, 3)] = odd
    return "".join(letters)


def attempt(seed: int, folder: Path) -> str:
    """One scene: read, checked, and where it is one, stepped twice; what came of it."""
    text = mutated(random.Random(seed))
    try:
        scene = ts.Scene.from_yaml_text(text, base=folder)
        check = scene.check()
        str(check)
        if check.problems:
            return sentences(check.problems)
        simulation = scene.compile()
        for _ in range(2):
            simulation.step()
        str(simulation.plan()), str(simulation.profile()), simulation.energy()
        return "stepped"
    except ts.SceneError as error:
        return sentences(error.problems)
    except ts.TissuError as error:
        return sentences([str(error)])


def sentences(problems: list[str]) -> str:
    """That all problems are sentences: one line each, not endless, and writable."""
    for problem in problems:
        assert problem.strip(), "an empty problem"
        assert "\n" not in problem, problem
        assert len(problem) < 3000, problem[:3000]
        problem.encode("utf-8")
    return "refused"
