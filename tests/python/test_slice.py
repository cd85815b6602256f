"""The example with a slice in plane strain and a ligament of lines."""

from pathlib import Path

import numpy as np
import pytest

from tissu import Scene

FILE = Path(__file__).parents[2] / "examples" / "slice.yaml"


def test_the_example_runs():
    simulation = Scene.from_yaml(FILE).compile()
    assert all(report.converged for report in simulation.run())
    tissue = simulation.displacements("tissue")
    assert (tissue[:, 2] == 0).all()
    assert tissue[:, 1].min() == pytest.approx(
        -4e-3, rel=1e-12
    )  # as prescribed, and nowhere deeper
    bulge = np.abs(tissue[:, 0]).max()
    assert 0.5e-3 < bulge < 4e-3  # sideways: the tissue hardly shrinks
    ends = simulation.positions["ligament"]
    pieces = np.linalg.norm(np.diff(ends, axis=0), axis=1)
    assert (pieces > 10e-3).all()  # drawn out, and straight along the force in the end
    assert ends[-1, 1] < 10e-3
