"""The examples of docs/guide/while-it-runs.md run as they stand there."""

import re
from pathlib import Path

import numpy as np
import pytest

import tissu as ts

PAGE = (Path(__file__).parents[2] / "docs/guide/while-it-runs.md").read_text(encoding="utf-8")
START, *EXAMPLES = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)


@pytest.fixture
def simulation():
    end = ts.Plane((0, 0, 0.1), (0, 0, 1))
    liver = ts.Body(
        mesh=ts.BarMesh(size=(0.1, 0.1, 0.1), cells=(2, 4, 4), cell="hexahedron"),
        law=ts.StVK(young="5 kPa", poisson=0.4),
        density=1050,
    )
    return ts.Scene(
        bodies={"liver": liver},
        fixed=[ts.Fixed("liver", on=ts.Plane((0, 0, 0), (0, 0, 1)), name="hand")],
        loads=[ts.NodalLoad("liver", on=end, force=(0, 0, 0), name="pull")],
        step=ts.ImplicitEuler("10 ms"),
        grabbing=True,
    ).compile()


def test_there_are_three():
    assert len(EXAMPLES) == 3


def test_the_page_runs_from_its_first_block_on():
    names = {}
    exec(compile("\n".join([START, *EXAMPLES]), "while-it-runs.md", "exec"), names)
    assert names["simulation"].step().converged


@pytest.mark.parametrize("example", EXAMPLES)
def test_the_example_runs(simulation, example):
    names = {"simulation": simulation}
    exec(compile(example, "while-it-runs.md", "exec"), names)
    assert simulation.step().converged


def test_the_load_of_the_page_pulls(simulation):
    pull = EXAMPLES[0].split("pull.factor")[0]
    exec(compile(pull, "while-it-runs.md", "exec"), {"simulation": simulation})
    for _ in range(20):
        simulation.step()
    assert simulation.displacements("liver")[:, 0].max() > 1e-5
    assert np.abs(simulation.load("pull").force - (0.02, 0, 0)).max() < 1e-15


def test_the_lead_of_the_page_goes_there(simulation):
    names = {"simulation": simulation}
    exec(compile(EXAMPLES[2].split("simulation.step()")[0], "while-it-runs.md", "exec"), names)
    for _ in range(5):
        simulation.step()
    hand = names["hand"]
    rest = simulation.meshes["liver"].points[hand.nodes]
    assert hand.positions[:, 2] == pytest.approx(rest[:, 2] + 0.01, abs=1e-15)
    about = np.linalg.norm(hand.positions[:, :2] - rest[:, :2], axis=1)
    radius = np.linalg.norm(rest[:, :2] - 0.05, axis=1)
    assert about == pytest.approx(2 * radius * np.sin(np.pi / 12), abs=1e-14)
