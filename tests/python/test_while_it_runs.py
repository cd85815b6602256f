"""The examples of docs/while-it-runs.md run as they stand there."""

import re
from pathlib import Path

import numpy as np
import pytest

import tissu as ts

PAGE = (Path(__file__).parents[2] / "docs" / "while-it-runs.md").read_text(encoding="utf-8")
EXAMPLES = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)


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
        fixed=[ts.Fixed("liver", on=ts.Plane((0, 0, 0), (0, 0, 1)))],
        loads=[ts.NodalLoad("liver", on=end, force=(0, 0, 0), name="pull")],
        step=ts.ImplicitEuler("10 ms"),
        grabbing=True,
    ).compile()


def test_there_are_two():
    assert len(EXAMPLES) == 2


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
